//! What a law makes of the same paths: loops, drift, energy, ticks.

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::{Path, Tick};
use epas_reference::presliding::load_exact::LoadExact;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::candidates::{Candidate, under_load};
use super::fit::{AMPLITUDES, exact, rms};
use super::paths::{Course, STREAM};
use super::{Law, torques};
use crate::failure::Failure;

/// What a law makes of paths under constant limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Area of the loops at [`AMPLITUDES`], relative error.
    pub areas: [f64; 4],
    /// Error over random strokes, rms and largest, of the limit.
    pub random: (f64, f64),
    /// Torque by which a small loop misses its start: the first time, and after five loops.
    pub opening: (f64, f64),
    /// Creep of the angle in a cycle of the torque, over the breakaway angle: torques of 0.3 +- 0.2 and of 0.5 +- 0.35.
    pub drift: [f64; 2],
    /// Largest turn in a tick with which steady sliding comes to the limit; none where any does.
    pub largest_turn: Option<f64>,
    /// Least work less gain of stored energy in a tick, limits changing.
    pub least_loss: f64,
}

impl Comparison {
    /// Compares one law.
    pub fn new(candidate: &Candidate) -> Result<Self, Failure> {
        let mut areas = [0.0; 4];
        for (area, amplitude) in areas.iter_mut().zip(AMPLITUDES) {
            *area = area_error(candidate, amplitude)?;
        }
        let course = Course::random(1, 2.0, 1.0, None);
        let truth = exact(&course.angle);
        let found = torques(candidate.start()?.as_mut(), &course.path());
        let largest = found
            .iter()
            .zip(&truth)
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max);
        Ok(Self {
            areas,
            random: (rms(&found, &truth), largest),
            opening: opening(candidate)?,
            drift: [drift(candidate, 0.3, 0.2)?, drift(candidate, 0.5, 0.35)?],
            largest_turn: largest_turn(candidate)?,
            least_loss: least_loss(candidate.start()?.as_mut(), 100_000),
        })
    }
}

/// Area of the last of three loops.
fn area(angle: &[f64], torque: &[f64], ticks: usize) -> f64 {
    let last = angle.len() - 4 * ticks - 1;
    let (angle, torque) = (&angle[last..], &torque[last..]);
    angle
        .windows(2)
        .zip(torque.windows(2))
        .map(|(angle, torque)| 0.5 * (torque[0] + torque[1]) * (angle[1] - angle[0]))
        .sum()
}

fn area_error(candidate: &Candidate, amplitude: f64) -> Result<f64, Failure> {
    const TICKS: usize = 500;
    let course = Course::cycles(amplitude, 3, TICKS);
    let found = torques(candidate.start()?.as_mut(), &course.path());
    let truth = area(&course.angle, &exact(&course.angle), TICKS);
    Ok(area(&course.angle, &found, TICKS) / truth - 1.0)
}

/// From 0.8 back to -0.1, and from there five times to 0.4 and back: what is missed is the torque at -0.1.
fn opening(candidate: &Candidate) -> Result<(f64, f64), Failure> {
    const TICKS: usize = 500;
    let mut points = vec![0.0, 0.8, -0.1];
    for _ in 0..5 {
        points.extend([0.4, -0.1]);
    }
    let course = Course::strokes(&points, TICKS);
    let found = torques(candidate.start()?.as_mut(), &course.path());
    let lows: Vec<f64> = found
        .iter()
        .skip(2 * TICKS)
        .step_by(2 * TICKS)
        .copied()
        .collect();
    let miss = |loops: usize| {
        let ends = lows.get(loops).zip(lows.first());
        ends.map_or(f64::NAN, |(end, start)| (end - start).abs())
    };
    Ok((miss(1), miss(5)))
}

/// A tick under unit limits and the reference load.
fn tick(turn: f64) -> Tick {
    Tick {
        turn,
        limits: Limits::UNIT,
        load: 1.0,
    }
}

/// Turns until the torque reaches `target`; the whole turn. What is left below the resolution of an f32 is taken along the last slope.
pub fn turn_to(law: &mut dyn Law, target: f64) -> f64 {
    const STEP: f64 = 2e-4;
    const RESOLUTION: f64 = 2e-7;
    let mut torque = law.follow(&tick(0.0));
    let way = (target - torque).signum();
    let mut whole = 0.0;
    let mut slope: f64 = 1.5;
    for _ in 0..1_000_000 {
        let left = way * (target - torque);
        if left <= RESOLUTION {
            return whole + way * left / slope;
        }
        // A little less than to the target: a step beyond would have to go back, which is another branch.
        let turn = way * (0.99 * left / slope).min(STEP);
        let after = law.follow(&tick(turn));
        if turn.abs() > 1e-5 {
            slope = ((after - torque) / turn).abs();
        }
        torque = after;
        whole += turn;
    }
    whole
}

fn drift(candidate: &Candidate, mean: f64, swing: f64) -> Result<f64, Failure> {
    const CYCLES: usize = 12;
    let mut law = candidate.start()?;
    turn_to(law.as_mut(), mean + swing);
    let cycle = |law: &mut dyn Law| turn_to(law, mean - swing) + turn_to(law, mean + swing);
    // What the first loading leaves is no drift.
    cycle(law.as_mut());
    let sum: f64 = (0..CYCLES).map(|_| cycle(law.as_mut())).sum();
    Ok(sum / CYCLES as f64)
}

fn largest_turn(candidate: &Candidate) -> Result<Option<f64>, Failure> {
    const BEYOND: f64 = 1e3;
    let settles = |turn: f64| -> Result<bool, Failure> {
        let mut law = candidate.start()?;
        let mut torque = 0.0;
        for _ in 0..2000.max((20.0 / turn) as usize) {
            torque = law.follow(&tick(turn));
        }
        Ok((torque - 1.0).abs() < 0.01)
    };
    if settles(BEYOND)? {
        return Ok(None);
    }
    let (mut low, mut high) = (1e-3_f64, BEYOND);
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if settles(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(Some(low))
}

/// Least work less gain of stored energy over random ticks; loads and limits of 0.1 to 3.
pub fn least_loss(law: &mut dyn Law, ticks: usize) -> f64 {
    let mut random = Pcg64::new(7, STREAM);
    let mut energy = 0.0;
    let mut least = f64::INFINITY;
    for _ in 0..ticks {
        let load = random.random_range(0.1..=3.0);
        let turn = random.random_range(-0.3..=0.3);
        let torque = law.follow(&Tick {
            turn,
            limits: Limits::UNIT.times(load),
            load,
        });
        let stored = law.energy();
        least = least.min(torque * turn - (stored - energy));
        energy = stored;
    }
    least
}

/// Work in a cycle that goes out by 0.2 under a low load and back under a high one: load 1 less and more 0.8. What is negative comes out of nothing.
pub fn work_of_a_load_cycle(law: &mut dyn Law) -> f64 {
    const TICKS: u32 = 400;
    const CYCLES: u32 = 6;
    let course = load_cycle(TICKS, CYCLES);
    let torque = torques(law, &course.path());
    let path = course.path();
    let pieces = path.ticks().zip(torque.windows(2));
    let last = (TICKS * (CYCLES - 1)) as usize;
    pieces
        .skip(last)
        .map(|(tick, torque)| 0.5 * (torque[0] + torque[1]) * tick.turn)
        .sum()
}

/// A cycle in angle and load: out by 0.2 under a load of 1 less up to 0.8, back under 1 and up to 0.8 more.
pub fn load_cycle(ticks: u32, cycles: u32) -> Course {
    let phases =
        (0..=ticks * cycles).map(|tick| std::f64::consts::TAU * f64::from(tick) / f64::from(ticks));
    let (angle, load) = phases
        .map(|phase| (0.1 * (1.0 - phase.cos()), 1.0 - 0.8 * phase.sin()))
        .unzip();
    Course {
        angle,
        load: Some(load),
    }
}

/// Exact torques under a load.
pub fn exact_under_load(path: &Path<'_>) -> Vec<f64> {
    let mut exact = LoadExact::new();
    let rest = path
        .ticks()
        .map(|tick| exact.follow(tick.turn, path.ratio, tick.load));
    std::iter::once(0.0).chain(rest).collect()
}

/// Rms errors of the laws under a load, over the rms of the exact torque, over random strokes up to `amplitude` long within half of it to both sides.
pub fn errors_under_load(
    amplitude: f64,
    loads: (f64, f64),
) -> Result<Vec<(&'static str, f64)>, Failure> {
    let course = Course::random(2, amplitude, 0.5 * amplitude, Some(loads));
    let truth = exact_under_load(&course.path());
    let size = rms(&truth, &vec![0.0; truth.len()]);
    under_load(loads.1)
        .into_iter()
        .map(|(name, law)| {
            let found = torques(law?.as_mut(), &course.path());
            Ok((name, rms(&found, &truth) / size))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::candidates::{best, ours, published};

    fn all() -> Vec<(String, Comparison)> {
        let mut laws = published();
        laws.extend(best().unwrap());
        laws.extend(ours());
        laws.iter()
            .map(|law| (law.name.clone(), Comparison::new(law).unwrap()))
            .collect()
    }

    #[test]
    fn explore() {
        for (name, c) in all() {
            println!("{name} {c:?}");
        }
        for (range, a) in [
            ((0.9, 1.1), 1.0),
            ((0.5, 1.6), 0.3),
            ((0.5, 1.6), 1.0),
            ((0.5, 1.6), 3.0),
            ((0.1, 4.0), 0.3),
            ((0.1, 4.0), 1.0),
            ((0.1, 4.0), 3.0_f64),
        ] {
            println!(
                "{range:?} {a} {:?}",
                errors_under_load(a, range)
                    .unwrap()
                    .iter()
                    .map(|x| (1e3 * x.1).round() / 10.0)
                    .collect::<Vec<_>>()
            );
        }
        use crate::peers::noise;
        for b in [1e-3, 2e-3, 5e-3] {
            let c = &ours()[2];
            let r = noise::by_angle(c.start().unwrap().as_mut(), b).unwrap();
            println!(
                "counts {b} {} rest {} {}",
                noise::error_of_counts(|| c.start(), b).unwrap(),
                r.changes,
                r.largest_step
            );
        }
        for w in [0.01, 0.05, 0.1, 0.2, 0.5] {
            let r = noise::by_speed(w).unwrap();
            println!("speed {w} {} {}", r.changes, r.largest_step);
        }
        for (name, law) in under_load(1.8) {
            println!("{name} {:e}", work_of_a_load_cycle(law.unwrap().as_mut()));
        }
        for (name, law) in under_load(3.0) {
            println!("{name} {:e}", least_loss(law.unwrap().as_mut(), 200_000));
        }
    }
}
