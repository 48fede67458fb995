//! Loops and drift as pictures.

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::Tick;

use super::panel::PANEL;
use crate::peers::candidates::{Candidate, ours, published};
use crate::peers::compare::turn_to;
use crate::peers::fit::exact;
use crate::peers::paths::Course;
use crate::peers::torques;
use epas_page::document::Figure;
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// Strokes with small loops inside large ones.
const POINTS: [f64; 12] = [
    0.0, 0.8, -0.1, 0.4, -0.1, 0.4, 0.1, 0.3, 0.1, 0.9, -1.0, 1.2,
];

fn named(candidates: Vec<Candidate>, start: &str) -> Result<Candidate, Failure> {
    candidates
        .into_iter()
        .find(|candidate| candidate.name.starts_with(start))
        .ok_or_else(|| Failure::Data(format!("no law is called {start}")))
}

/// Torque over angle.
pub fn picture() -> Result<Figure, Failure> {
    let course = Course::strokes(&POINTS, 60);
    let truth = exact(&course.angle);
    let over_angle = |torque: Vec<f64>| course.angle.iter().copied().zip(torque).collect();
    let mut panels = Vec::new();
    for (title, law) in [
        ("This crate, 8 elements", named(ours(), "this crate, 8")?),
        ("LuGre", named(published(), "Dahl, LuGre")?),
        ("Elasto-plastic", named(published(), "elasto-plastic")?),
        ("Dahl, exponent 1/3", named(published(), "Dahl, exponent")?),
    ] {
        let found = torques(law.start()?.as_mut(), &course.path());
        panels.push(Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("angle over the breakaway angle").between(-1.1, 1.3),
            y: Axis::linear("torque over the limit").between(-1.1, 1.1),
            series: vec![
                Series::new("exact", 0, Mark::Line, over_angle(truth.clone())),
                Series::new(&law.name, 1, Mark::Dashed, over_angle(found)),
            ],
            notes: Vec::new(),
        }));
    }
    Ok(Figure {
        name: "memory_loops",
        caption: "Torque over angle, with small loops inside large ones: exactly, by elements that remember, and by laws whose state is one number.".into(),
        panels,
        columns: 2,
        size: PANEL,
    })
}

/// Angle over the cycles of a torque that swings below breakaway.
pub fn drift() -> Result<Figure, Failure> {
    const CYCLES: u32 = 10;
    let mut series = Vec::new();
    for (colour, law) in [
        named(ours(), "this crate, 8")?,
        named(published(), "Dahl, LuGre")?,
        named(published(), "Dahl, exponent")?,
        named(published(), "elasto-plastic, sticks to 0.7")?,
    ]
    .into_iter()
    .enumerate()
    {
        let mut state = law.start()?;
        let mut angle = turn_to(state.as_mut(), 0.85);
        let mut points = vec![(0.0, angle)];
        for cycle in 1..=CYCLES {
            angle += turn_to(state.as_mut(), 0.15);
            points.push((f64::from(cycle) - 0.5, angle));
            angle += turn_to(state.as_mut(), 0.85);
            points.push((f64::from(cycle), angle));
        }
        series.push(Series::new(&law.name, colour, Mark::Line, points));
        // What is held at the end is still what was asked for.
        let held = state.follow(&Tick {
            turn: 0.0,
            limits: Limits::UNIT,
            load: 1.0,
        });
        debug_assert!((held - 0.85).abs() < 1e-3);
    }
    Ok(Figure {
        name: "memory_drift",
        caption: "Angle under a torque that swings between 0.15 and 0.85 of the limit: a nut that is held creeps away by laws whose small loops do not close.".into(),
        panels: vec![Panel::Chart(Chart {
            title: "Drift below breakaway".into(),
            x: Axis::linear("cycles of the torque"),
            y: Axis::linear("angle over the breakaway angle"),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (2 * PANEL.0, PANEL.1),
    })
}
