//! Models of friction that are calibrated to one synthetic trace and scored on another of the same gear.

use std::io::Cursor;

use epas_calibrate::answer::ModelScore;
use epas_calibrate::screw::{Request, calibrate};
use epas_calibrate::trace::Trace;
use epas_calibrate::trace::columns::{Frame, from_reader};
use epas_design::files::{Design, DesignSource};
use epas_rig::Rig;
use epas_rig::course::Course;
use epas_rig::parameters::Parameters;
use rayon::prelude::*;

use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

const SEEDS: [u64; 2] = [0, 5];

/// Parts of the vehicle's course over their 20 s.
fn length(quick: bool) -> f64 {
    if quick { 0.3 } else { 1.0 }
}

pub fn blocks(quick: bool) -> Result<Vec<Block>, Failure> {
    let gears = [
        ("of this crate's form", Parameters::default()),
        ("another physics", Parameters::other_physics()),
    ];
    let first = usize::from(quick);
    let scores = gears[first..]
        .par_iter()
        .map(|(physics, gear)| Ok((*physics, scores(gear, length(quick))?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    let rows = scores.iter().flat_map(|(physics, scores)| {
        scores.iter().map(|score| {
            let cycles = score.cycles.map_or(f64::NAN, f64::from);
            vec![
                Cell::from(*physics),
                score.name.as_str().into(),
                Cell::fixed(score.parameters as f64, 0),
                Cell::fixed(1e3 * left(score), 2),
                Cell::fixed(cycles, 0),
            ]
        })
    });
    let columns = "true friction | model | parameters | torque left, mN m | cycles";
    Ok(vec![Block::Table(table(
        "memory_trial",
        "Models as `epas calibrate` fits them to a synthetic trace of a gear, scored on another trace of the same gear: rms of the motor torque that a model \
         leaves. Laws of the literature follow the load that both flanks share, their preload fitted. Another physics: a film by Hamrock and \
         Dowson with Vogel's oil, two fifths of the torque by spin over twice the breakaway angle, a seal of 4 mN m, a third wave, half of the rolling \
         resistance; no model here has that form",
        columns,
        rows.collect(),
    ))])
}

/// Torque left on the trace that was not fitted, rms, N m.
fn left(score: &ModelScore) -> f64 {
    score.residual_unseen.unwrap_or(f64::NAN)
}

fn scores(gear: &Parameters, length: f64) -> Result<Vec<ModelScore>, Failure> {
    let source: DesignSource = "lin-4.1".parse().map_err(Failure::Data)?;
    let design = source.load()?;
    let rig = Rig::new(gear.clone())?;
    let course = Course::vehicle().times(length);
    let [fitted, unseen] = SEEDS.map(|seed| trace(&rig, &course, seed, &design));
    let request = Request {
        unseen: Some(unseen?),
        ..Request::default()
    };
    Ok(calibrate(&fitted?, &design, &request)?.answer.models)
}

fn trace(rig: &Rig, course: &Course, seed: u64, design: &Design) -> Result<Trace, Failure> {
    let mut text = Vec::new();
    let csv = |error: std::fmt::Arguments<'_>| Failure::Data(format!("a synthetic trace: {error}"));
    rig.run(course, seed)?
        .write_csv(&mut text)
        .map_err(|error| csv(format_args!("{error}")))?;
    let frame = Frame::of(design, None);
    from_reader(Cursor::new(text), "rig", Some(&frame))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As in the report's quick run, from traces of 18 s.
    #[test]
    fn a_calibrated_memory_leaves_the_least_of_another_physics() {
        let scores = scores(&Parameters::other_physics(), length(true)).unwrap();
        for score in &scores {
            println!("{}: {:.5} N m", score.name, left(score));
        }
        let (own, others) = scores.split_last().unwrap();
        assert_eq!(own.name, "this crate, with memory");
        assert_eq!(others.len(), 5);
        for other in others {
            // Measured: LuGre leaves 1.58 times as much.
            assert!(left(other) > 1.4 * left(own), "{}", other.name);
        }
    }
}
