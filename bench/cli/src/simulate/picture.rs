//! The picture of a run: what acts, what the motor has to do, friction with its parts and its error, and what holds when.

use std::path::Path;

use epas_friction::Regime;

use super::summary::regime_name;
use epas_page::failure::Failure;
use epas_page::plot::{
    Axis, BUCKETS, Chart, Mark, Panel, Series, Strip, render, thin_to, zoomable,
};

/// Buckets of rows of a page, in which a reader looks closer.
const FINE: usize = 4 * BUCKETS;

/// Width and height of a panel, pixels.
const PANEL: (u32, u32) = (1000, 250);

#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Place along the horizontal axis.
    pub place: f64,
    pub load: f64,
    pub side: Option<f64>,
    pub speed: f64,
    /// Motor torque without inertia, where a motor drives: that of the load and of friction.
    pub motor: Option<f64>,
    pub friction: f64,
    pub parts: Option<[f64; 2]>,
    /// Promised largest error of the friction, where it holds.
    pub error: Option<f64>,
    pub reference: Option<f64>,
    pub regime: Regime,
    pub flagged: bool,
}

/// What stands beside the axes.
pub struct Labels {
    pub title: String,
    pub place: &'static str,
    pub loads: [&'static str; 2],
    pub speed: &'static str,
    pub friction: (&'static str, &'static str),
    pub parts: [&'static str; 2],
    pub error: String,
    pub reference: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Svg,
    /// A page in which a reader looks closer.
    Page,
}

impl Form {
    /// By the ending of a file: a page for `.html`, else a picture.
    pub fn of(path: &Path) -> Self {
        match path.extension() {
            Some(ending) if ending.eq_ignore_ascii_case("html") => Self::Page,
            _ => Self::Svg,
        }
    }

    pub fn curve<Row>(
        self,
        rows: &[Row],
        place: &dyn Fn(&Row) -> f64,
        value: &dyn Fn(&Row) -> f64,
    ) -> Vec<(f64, f64)> {
        let buckets = if self == Self::Svg { BUCKETS } else { FINE };
        thin_to(buckets, rows, place, value)
    }

    pub fn draw(self, title: &str, panels: &[Panel]) -> Result<String, Failure> {
        match self {
            Self::Svg => render(panels, 1, PANEL),
            Self::Page => zoomable(title, panels),
        }
    }
}

pub fn ends(moments: &[Moment]) -> (f64, f64) {
    moments
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), moment| {
            (low.min(moment.place), high.max(moment.place))
        })
}

pub fn chart(
    title: &str,
    place: &str,
    ends: (f64, f64),
    label: &str,
    series: Vec<Series>,
) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x: Axis::linear(place).between(ends.0, ends.1),
        y: Axis::linear(label),
        series,
        notes: Vec::new(),
    })
}

pub fn panels(labels: &Labels, moments: &[Moment], form: Form) -> Vec<Panel> {
    let curve = |value: &dyn Fn(&Moment) -> f64| form.curve(moments, &|row| row.place, value);
    let line = |name: &str, colour, value: &dyn Fn(&Moment) -> f64| {
        Series::new(name, colour, Mark::Line, curve(value))
    };
    let ends = ends(moments);
    let panel = |title: &str, label: &str, series| chart(title, labels.place, ends, label, series);
    let of = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let has = |value: &dyn Fn(&Moment) -> bool| moments.iter().any(value);

    let [load, side] = labels.loads;
    let mut panels = vec![panel(
        &labels.title,
        load,
        vec![line("", 0, &|row| row.load)],
    )];
    if has(&|row| row.side.is_some()) {
        panels.push(panel("", side, vec![line("", 0, &|row| of(row.side))]));
    }
    panels.push(panel("", labels.speed, vec![line("", 2, &|row| row.speed)]));
    if has(&|row| row.motor.is_some()) {
        let motor = vec![
            line("load and friction", 1, &|row| of(row.motor)),
            Series::new(
                "load alone",
                6,
                Mark::Dashed,
                curve(&|row| of(row.motor) - row.friction),
            ),
        ];
        panels.push(panel("", "motor torque (N m)", motor));
    }
    let (name, unit) = labels.friction;
    let label = format!("{name} ({unit})");
    let friction = panel("", &label, friction(labels, moments, form));
    panels.push(friction.tall());
    // A small error hides under the line of the friction itself.
    let around = |row: &Moment| (0.0, row.error);
    let mut errors = band(&labels.error, moments, form, &around);
    if has(&|row| row.reference.is_some()) {
        let difference = curve(&|row| row.friction - of(row.reference));
        let name = format!("model less {}", labels.reference);
        errors.push(Series::new(&name, 3, Mark::Line, difference));
    }
    if !errors.is_empty() {
        panels.push(panel("", &format!("error ({unit})"), errors));
    }
    panels.push(Panel::Strip(regimes(labels.place, moments, ends)));
    panels
}

/// Friction with its parts and its error; the reference has a panel of its own.
fn friction(labels: &Labels, moments: &[Moment], form: Form) -> Vec<Series> {
    let curve = |value: &dyn Fn(&Moment) -> f64| form.curve(moments, &|row| row.place, value);
    let around = |row: &Moment| (row.friction, row.error);
    let mut series = band(&labels.error, moments, form, &around);
    if moments.iter().any(|row| row.parts.is_some()) {
        for (index, (name, colour)) in labels.parts.into_iter().zip([0, 1]).enumerate() {
            let part = curve(&|row| row.parts.map_or(f64::NAN, |parts| parts[index]));
            series.push(Series::new(name, colour, Mark::Line, part));
        }
        series.push(Series::new(
            "sum",
            6,
            Mark::Line,
            curve(&|row| row.friction),
        ));
    } else {
        series.push(Series::new("", 6, Mark::Line, curve(&|row| row.friction)));
    }
    series
}

/// The error around a value, one area for each stretch in which it is promised.
fn band(
    name: &str,
    moments: &[Moment],
    form: Form,
    around: &dyn Fn(&Moment) -> (f64, Option<f64>),
) -> Vec<Series> {
    let stretches = moments.chunk_by(|one, other| one.error.is_some() == other.error.is_some());
    let mut name = name;
    let mut series = Vec::new();
    for stretch in stretches.filter(|rows| rows.first().is_some_and(|row| row.error.is_some())) {
        let edge = |sign: f64| {
            let value = move |row: &Moment| {
                let (middle, error) = around(row);
                middle + sign * error.unwrap_or(0.0)
            };
            form.curve(stretch, &|row| row.place, &value)
        };
        let mut points = edge(1.0);
        points.extend(edge(-1.0).into_iter().rev());
        series.push(Series::new(name, 6, Mark::Band, points));
        name = "";
    }
    series
}

/// What holds when, and where a fault is flagged.
fn regimes(place: &str, moments: &[Moment], ends: (f64, f64)) -> Strip {
    const REGIMES: [Regime; 4] = [
        Regime::Standing,
        Regime::Driving,
        Regime::BackDriving,
        Regime::Locked,
    ];
    let mut states: Vec<String> = Vec::new();
    let mut stretches = Vec::new();
    let mut add = |name: &str, holds: &dyn Fn(&Moment) -> bool| {
        let index = states.len();
        let mut start = None;
        let before = stretches.len();
        for moment in moments {
            match (holds(moment), start) {
                (true, None) => start = Some(moment.place),
                (false, Some(from)) => {
                    stretches.push((index, from, moment.place));
                    start = None;
                }
                _ => {}
            }
        }
        stretches.extend(start.map(|from| (index, from, ends.1)));
        if stretches.len() > before {
            states.push(name.into());
        }
    };
    for regime in REGIMES {
        add(regime_name(regime), &|moment| moment.regime == regime);
    }
    add("flagged", &|moment| moment.flagged);
    Strip {
        x: Axis::linear(place).between(ends.0, ends.1),
        states,
        stretches,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(place: f64, regime: Regime) -> Moment {
        Moment {
            place,
            load: 1.0,
            side: None,
            speed: 1.0,
            motor: Some(3.0),
            friction: 1.0,
            parts: Some([0.75, 0.25]),
            error: (place < 2.5).then_some(0.5),
            reference: None,
            regime,
            flagged: false,
        }
    }

    fn labels() -> Labels {
        Labels {
            title: "parking".into(),
            place: "time (s)",
            loads: ["axial load (N)", ""],
            speed: "nut speed (rad/s)",
            friction: ("friction torque", "N m"),
            parts: ["slip", "rolling"],
            error: "error".into(),
            reference: "",
        }
    }

    #[test]
    fn a_run_shows_its_regimes_and_where_the_error_is_promised() {
        let moments: Vec<_> = [0.0, 1.0, 2.0, 3.0]
            .into_iter()
            .map(|place| {
                let regime = if place < 2.0 {
                    Regime::Driving
                } else {
                    Regime::BackDriving
                };
                moment(place, regime)
            })
            .collect();
        let panels = panels(&labels(), &moments, Form::Svg);
        let Some(Panel::Strip(strip)) = panels.last() else {
            panic!("no strip");
        };
        assert_eq!(strip.states, ["driving", "back-driving"]);
        assert_eq!(strip.stretches, [(0, 0.0, 2.0), (1, 2.0, 3.0)]);
        let Some(Panel::Tall(chart)) = panels.get(3) else {
            panic!("no friction");
        };
        // Up along one edge and back along the other, where the error is promised.
        let band = &chart.series[0];
        assert_eq!(band.mark, Mark::Band);
        assert_eq!(
            band.points,
            [
                (0.0, 1.5),
                (1.0, 1.5),
                (2.0, 1.5),
                (2.0, 0.5),
                (1.0, 0.5),
                (0.0, 0.5)
            ]
        );
    }

    #[test]
    fn a_page_is_asked_for_by_its_ending() {
        assert_eq!(Form::of(Path::new("a/run.HTML")), Form::Page);
        assert_eq!(Form::of(Path::new("run.svg")), Form::Svg);
    }
}
