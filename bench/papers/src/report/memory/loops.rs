//! Loops as pictures.

use super::PAIRS;
use crate::peers::candidates::{Candidate, ours, published};
use crate::peers::paths::{Course, exact};
use crate::peers::torques;
use epas_bench::report::draw::{chart, figure};
use epas_page::document::Block;
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

const POINTS: [f64; 12] = [
    0.0, 0.8, -0.1, 0.4, -0.1, 0.4, 0.1, 0.3, 0.1, 0.9, -1.0, 1.2,
];

fn named(candidates: Vec<Candidate>, start: &str) -> Result<Candidate, Failure> {
    candidates
        .into_iter()
        .find(|candidate| candidate.name.starts_with(start))
        .ok_or_else(|| Failure::Data(format!("no law is called {start}")))
}

pub fn picture() -> Result<Block, Failure> {
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
        let series = vec![
            Series::new("exact", 0, Mark::Line, over_angle(truth.clone())),
            Series::new(&law.name, 1, Mark::Dashed, over_angle(found)),
        ];
        let x = Axis::linear("angle over the breakaway angle").between(-1.1, 1.3);
        let y = Axis::linear("torque over the limit").between(-1.1, 1.1);
        panels.push(chart(title, x, y, series));
    }
    Ok(figure(
        "memory_loops",
        "Torque over angle, with small loops inside large ones: exactly, by elements that remember, and by laws whose state is one number.",
        PAIRS,
        panels,
    ))
}
