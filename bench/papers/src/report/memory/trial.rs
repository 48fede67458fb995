//! What is left of the friction where a calibrated model compensates it.

mod gear;
mod rivals;

use epas_rig::parameters::Parameters;
use rayon::prelude::*;

use super::WIDE;
use epas_bench::report::draw::{chart, figure, table};
use epas_calibrate::screw::choice::Wanted;
use epas_calibrate::screw::exact::Spacing;
use epas_calibrate::screw::friction::{Course, ElementsKind};
use epas_calibrate::screw::{Request, calibrate};
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};
use gear::Gear;
use rivals::Rival;

/// Names of this crate's rows.
const LOAD_EXACT: &str = "this crate with memory, 8 load-exact elements, calibrated";
const PROPORTIONAL: &str = "this crate with memory, 8 elements in proportion, calibrated";

/// How much is tried.
struct Size {
    /// Length of the course over that of the vehicle's.
    length: f64,
    /// Elements of this crate.
    elements: &'static [(&'static str, ElementsKind)],
    /// What of the screw is estimated; all that the trace can tell where there are no names.
    estimated: &'static [&'static str],
}

impl Size {
    const WHOLE: Self = Self {
        length: 1.0,
        elements: &[
            (LOAD_EXACT, ElementsKind::Preloaded),
            (PROPORTIONAL, ElementsKind::Proportional),
        ],
        estimated: &[],
    };

    const QUICK: Self = Self {
        length: 0.3,
        elements: &[(LOAD_EXACT, ElementsKind::Preloaded)],
        estimated: &[
            "friction",
            "full_film_ratio",
            "half_share_speed",
            "preload",
            "breakaway_angle",
            "inertia",
            "drag",
            "offset",
            "gain",
        ],
    };
}

/// A model over the trace that was not fitted.
struct Tried {
    name: &'static str,
    friction: Vec<f64>,
    /// Rms of the true friction less this, N m: weave, parking, micro, all.
    residual: [f64; 4],
}

/// Table and picture.
pub fn blocks(quick: bool) -> Result<Vec<Block>, Failure> {
    let size = if quick { Size::QUICK } else { Size::WHOLE };
    let mut rows = Vec::new();
    if !quick {
        let same = Gear::new(Parameters::default(), size.length)?;
        rows.extend(table_rows("of this crate's form", &tried(&same, &size)?));
    }
    let other = Gear::new(Parameters::other_physics(), size.length)?;
    let tried = tried(&other, &size)?;
    rows.extend(table_rows("another physics", &tried));
    let columns = [
        "true friction",
        "model",
        "weave, mN m",
        "parking, mN m",
        "micro, mN m",
        "all, mN m",
        "all, % of the friction",
    ];
    Ok(vec![
        Block::Table(table(
            "memory_trial",
            "Rms of the true friction less a model's, on a synthetic trace that was not fitted, with what a control unit knows: counted angles (14 bits behind a ratio of 2.5), a speed that \
             tracks them with 40 Hz, a load with 8 N of noise. Every model is fitted to the torque of another trace of the same gear (noise 1 %), beside inertia, drag, offset, \
             gain of the load and waves over the turn. Another physics: a film by Hamrock and Dowson with Vogel's oil, two fifths of the torque by spin over twice the breakaway angle, a seal of 4 mN m, a third \
             wave, half of the rolling resistance; no model here has that form",
            &columns,
            rows,
        )),
        picture(&other, &tried),
    ])
}

/// Every model on a gear; none first.
fn tried(gear: &Gear, size: &Size) -> Result<Vec<Tried>, Failure> {
    let entry = |name, friction: Vec<f64>| Tried {
        name,
        residual: gear.residual(&friction),
        friction,
    };
    // Fits share nothing: side by side on the cores that there are.
    let rivals = [Rival::BySpeed, Rival::LuGre, Rival::LuGreOnContacts];
    let (rivals, screws): (Vec<_>, Vec<_>) = rayon::join(
        || {
            rivals
                .par_iter()
                .map(|rival| Ok(entry(rival.name(), rival.tried(gear)?)))
                .collect()
        },
        || {
            size.elements
                .par_iter()
                .map(|&(name, elements)| {
                    let wanted = Wanted {
                        elements: Some(elements),
                        estimate: (!size.estimated.is_empty())
                            .then(|| size.estimated.iter().map(ToString::to_string).collect()),
                        ..Wanted::default()
                    };
                    Ok(entry(name, calibrated(gear, wanted)?))
                })
                .collect()
        },
    );
    let none = entry("none", vec![0.0; gear.in_loop.0.len()]);
    [Ok(none)].into_iter().chain(rivals).chain(screws).collect()
}

/// Friction of the calibrated screw over the trace that was not fitted, N m.
fn calibrated(gear: &Gear, wanted: Wanted) -> Result<Vec<f64>, Failure> {
    let request = Request {
        wanted,
        without_models: true,
        ..Request::default()
    };
    let found = calibrate(&gear.trace, &gear.design, &request)?;
    let (trace, speed) = &gear.in_loop;
    let course = Course {
        angle: trace.position.clone(),
        speed: speed.clone(),
        load: trace.load.clone(),
        temperature: trace.temperature.clone().unwrap_or_default(),
    };
    let grid = found.screw.grid(&found.values, Spacing::FINE)?;
    found.screw.friction(&found.values, &course, &grid)
}

fn table_rows(physics: &str, tried: &[Tried]) -> Vec<Vec<Cell>> {
    let whole = tried.first().map_or(f64::NAN, |none| none.residual[3]);
    tried
        .iter()
        .map(|entry| {
            let mut cells = vec![Cell::from(physics), Cell::from(entry.name)];
            cells.extend(entry.residual.map(|rms| Cell::fixed(1e3 * rms, 1)));
            cells.push(Cell::fixed(100.0 * entry.residual[3] / whole, 1));
            cells
        })
        .collect()
}

/// Friction over a few seconds of small strokes.
fn picture(gear: &Gear, tried: &[Tried]) -> Block {
    let glimpse: Vec<(usize, f64, f64)> = gear.glimpse().collect();
    let truth = glimpse.iter().map(|(_, time, torque)| (*time, *torque));
    let mut series = vec![Series::new("true", 0, Mark::Line, truth.collect())];
    for (colour, name) in [
        (1, LOAD_EXACT),
        (2, Rival::LuGreOnContacts.name()),
        (3, Rival::BySpeed.name()),
    ] {
        for entry in tried.iter().filter(|entry| entry.name == name) {
            let points = glimpse
                .iter()
                .filter_map(|(sample, time, _)| Some((*time, *entry.friction.get(*sample)?)));
            series.push(Series::new(name, colour, Mark::Line, points.collect()));
        }
    }
    let x = Axis::linear("time (s)");
    let y = Axis::linear("friction torque (N m)");
    figure(
        "memory_trial_picture",
        "Friction of the other physics and what the models make of it: strokes of some milliradians, not fitted.",
        WIDE,
        vec![chart("Compensation of small strokes", x, y, series)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left, % of the friction: that of a model by its name.
    fn left(tried: &[Tried]) -> impl Fn(&str) -> f64 {
        let whole = tried[0].residual[3];
        for entry in tried {
            let share = 100.0 * entry.residual[3] / whole;
            println!("{}: {:.4?} N m, {share:.1} %", entry.name, entry.residual);
        }
        move |name| {
            let entry = tried.iter().find(|entry| entry.name == name).unwrap();
            100.0 * entry.residual[3] / whole
        }
    }

    /// As in the report's quick run, from a trace of 18 s.
    #[test]
    fn a_calibrated_memory_leaves_the_least_of_another_physics() {
        let gear = Gear::new(Parameters::other_physics(), Size::QUICK.length).unwrap();
        let tried = tried(&gear, &Size::QUICK).unwrap();
        let left = left(&tried);
        // Measured: 6.1, 11.0, 12.8 and 51.4 %.
        assert!(left(LOAD_EXACT) < 7.0);
        assert!(left(Rival::LuGre.name()) > 9.0);
        assert!(left(Rival::LuGreOnContacts.name()) > 9.0);
        assert!(left(Rival::BySpeed.name()) > 40.0);
    }

    /// The whole trial: some minutes without optimisation. Measured, % left by load-exact elements, elements in proportion, LuGre on the
    /// contacts, LuGre, by speed: 2.0, 2.5, 11.1, 17.7, 55.7 of this crate's form; 5.6, 5.3, 11.1, 17.2, 51.8 of another physics.
    #[test]
    #[ignore = "fits of 60 s traces"]
    fn a_calibrated_memory_leaves_seven_per_cent_at_most() {
        for (parameters, most) in [
            (Parameters::default(), 3.0),
            (Parameters::other_physics(), 7.0),
        ] {
            let gear = Gear::new(parameters, 1.0).unwrap();
            let tried = tried(&gear, &Size::WHOLE).unwrap();
            let left = left(&tried);
            for name in [LOAD_EXACT, PROPORTIONAL] {
                assert!(left(name) < most, "{name}: {}", left(name));
            }
            for rival in [Rival::BySpeed, Rival::LuGre, Rival::LuGreOnContacts] {
                assert!(left(rival.name()) > most, "{}", rival.name());
            }
        }
    }
}
