//! Which manoeuvre tells a parameter of a screw best: `calibrate --wanted`.

use std::cell::RefCell;
use std::io::{self, Write};

use crate::experiment::manoeuvre::{Manoeuvre, Reach};
use crate::experiment::{Ranked, rank};
use crate::fit::problem::Separable;
use crate::screw::Request;
use crate::screw::choice::{Start, Wanted};
use crate::screw::evidence::Evidence;
use crate::screw::exact::Spacing;
use crate::screw::problem::ScrewProblem;
use crate::signals::{Motion, Rows};
use crate::trace::{Coordinate, Repairs, Trace};
use epas_design::files::Design;
use epas_page::failure::Failure;

/// What is estimated beside the wanted parameter.
const BESIDE: [&str; 9] = [
    "friction",
    "full_film_ratio",
    "half_share_speed",
    "preload",
    "breakaway_angle",
    "inertia",
    "drag",
    "offset",
    "gain",
];

/// Noise of a row, N m: a hundredth of the torque of a steering gear at its rack force.
const NOISE: f64 = 5e-3;

/// Tick of the manoeuvres, s.
const STEP: f64 = 1e-3;

/// What the mechanism can do: a rack of 75 mm to each side.
fn reach(design: &Design) -> Reach {
    let load = 2.8e3_f64.min(0.9 * f64::from(design.caged.limits.axial_load));
    Reach {
        angle: 0.075 / f64::from(design.screw().lead()) * std::f64::consts::TAU,
        speed: 45.0_f64.min(0.9 * f64::from(design.caged.limits.nut_speed)),
        load,
        temperature: [293.15, 333.15],
        travel: 2e-3,
    }
}

/// A manoeuvre as the trace that it would give, without the torque.
fn trace(manoeuvre: Manoeuvre, reach: &Reach) -> Trace {
    let course = manoeuvre.course(STEP, reach);
    Trace {
        name: manoeuvre.name().into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step: STEP,
        effort: vec![0.0; course.position.len()],
        position: course.position,
        resolution: 0.0,
        position_summed: false,
        speed: None,
        reference_position: None,
        load: Some(course.load),
        load_is_effort: false,
        known: None,
        temperature: Some(course.temperature),
        left_out: Vec::new(),
        origins: crate::trace::Origins::default(),
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

/// A manoeuvre's problem. It refers to its trace for ever: seven of them are made in the life of the program.
fn problem(
    design: &Design,
    wanted: &Wanted,
    manoeuvre: Manoeuvre,
    reach: &Reach,
) -> Result<Box<dyn Separable>, Failure> {
    let request = Request::default();
    let trace: &'static Trace = Box::leak(Box::new(trace(manoeuvre, reach)));
    let motion: &'static Motion = Box::leak(Box::new(Motion::of(trace, &request.smoothing)?));
    let rows: &'static Rows = Box::leak(Box::new(Rows::new(trace.step, &request.rows)?));
    let smoothing = request.smoothing.filter(trace.step)?;
    let mut evidence = Evidence::of(trace, motion);
    // All problems have the same parameters and starts.
    evidence.load = Some([-reach.load, reach.load]);
    evidence.temperature = Some(reach.temperature);
    evidence.speeds = [1e-2 * reach.speed, reach.speed];
    let Start {
        screw,
        values,
        choice,
    } = Start::of(design, &evidence, wanted)?;
    let measured = (trace, motion, rows);
    Ok(Box::new(ScrewProblem::new(
        screw,
        measured,
        &smoothing,
        values,
        choice,
        Spacing::FINE,
    )?))
}

/// Prints the manoeuvres, the best first.
///
/// # Errors
/// A name that no parameter has.
pub fn tell(design: &Design, name: &str) -> Result<(), Failure> {
    let (ranked, reach) = ranked(design, name)?;
    print(&mut io::stdout().lock(), name, &ranked, &reach)
}

/// The manoeuvres with what each would tell, and what the mechanism can do.
fn ranked(design: &Design, name: &str) -> Result<(Vec<Ranked>, Reach), Failure> {
    let mut estimate: Vec<String> = BESIDE.map(String::from).to_vec();
    if !estimate.iter().any(|known| known == name) {
        estimate.push(name.into());
    }
    let wanted = Wanted {
        estimate: Some(estimate),
        ..Wanted::default()
    };
    let reach = reach(design);
    let mut problems = Vec::new();
    for manoeuvre in Manoeuvre::ALL {
        problems.push((manoeuvre, problem(design, &wanted, manoeuvre, &reach)?));
    }
    let problems = RefCell::new(problems);
    // Each manoeuvre is asked for once.
    let make = |wanted: &Manoeuvre| -> Box<dyn Separable> {
        let mut left = problems.borrow_mut();
        let found = left.iter().position(|(known, _)| known == wanted);
        left.swap_remove(found.unwrap_or(0)).1
    };
    let ranked = rank(name, &Manoeuvre::ALL, &make, &[NOISE * NOISE])?;
    Ok((ranked, reach))
}

fn print(
    out: &mut impl Write,
    name: &str,
    ranked: &[Ranked],
    reach: &Reach,
) -> Result<(), Failure> {
    writeln!(
        out,
        "Manoeuvres that tell {name}, the best first; intervals (95 %) with a noise of {:.1} mN m",
        1e3 * NOISE
    )?;
    for entry in ranked {
        let Ranked {
            manoeuvre,
            value,
            low,
            high,
            hidden_by,
            companion,
            ..
        } = entry;
        writeln!(
            out,
            "\n{} ({:.0} s): {}",
            manoeuvre.name(),
            manoeuvre.duration(),
            manoeuvre.instruction(reach)
        )?;
        writeln!(
            out,
            "  {value:.4e} would be told as {low:.4e} to {high:.4e}"
        )?;
        if let Some((other, correlation)) = hidden_by {
            writeln!(
                out,
                "  hidden most by {other} (correlation {correlation:.3})"
            )?;
        }
        if let Some((other, width)) = companion {
            writeln!(
                out,
                "  with {} as well: half of the interval {width:.3}",
                other.name()
            )?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use epas_design::files::DesignSource;

    #[test]
    fn a_breakaway_angle_is_told_by_reversals_and_not_by_a_spin_down() {
        let design = "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap();
        let mut text = Vec::new();
        let found = ranked(&design, "breakaway_angle").unwrap();
        print(&mut text, "breakaway_angle", &found.0, &found.1).unwrap();
        let order: Vec<Manoeuvre> = found.0.iter().map(|entry| entry.manoeuvre).collect();
        assert_eq!(order[0], Manoeuvre::MicroReversals);
        assert_eq!(*order.last().unwrap(), Manoeuvre::SpinDown);
        assert!(ranked(&design, "no_such_parameter").is_err());
    }
}
