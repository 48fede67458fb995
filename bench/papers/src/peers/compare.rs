//! What a law makes of the same paths: loops, drift, energy, ticks.

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::{Path, Tick};
use epas_reference::presliding::load_exact::LoadExact;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::candidates::{Candidate, under_load};
use super::paths::{AMPLITUDES, Course, STREAM, exact, rms};
use super::{Law, torques};
use epas_page::failure::Failure;

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
    pub largest_turn: Option<f64>,
    pub least_loss: f64,
}

impl Comparison {
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

pub fn exact_under_load(path: &Path<'_>) -> Vec<f64> {
    let mut exact = LoadExact::new();
    let rest = path
        .ticks()
        .map(|tick| exact.follow(tick.turn, path.ratio, tick.load));
    std::iter::once(0.0).chain(rest).collect()
}

pub const LOAD_CASES: [((f64, f64), f64); 7] = [
    ((0.9, 1.1), 1.0),
    ((0.5, 1.6), 0.3),
    ((0.5, 1.6), 1.0),
    ((0.5, 1.6), 3.0),
    ((0.1, 4.0), 0.3),
    ((0.1, 4.0), 1.0),
    ((0.1, 4.0), 3.0),
];

/// Rms errors of the laws under a load, over the rms of the exact torque, over random strokes up to `amplitude` long within half of it to both sides.
pub fn errors_under_load(amplitude: f64, loads: (f64, f64)) -> Result<Vec<(String, f64)>, Failure> {
    let course = Course::random(2, amplitude, 0.5 * amplitude, Some(loads));
    let truth = exact_under_load(&course.path());
    let size = rms(&truth, &vec![0.0; truth.len()]);
    under_load(loads.1)
        .into_iter()
        .map(|law| {
            let found = torques(law.start()?.as_mut(), &course.path());
            Ok((law.name, rms(&found, &truth) / size))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::candidates::{
        BEST, LOAD_EXACT, MULTIPLIED, PROPORTIONAL, best, ours, published,
    };

    /// What is expected of a law, known apart from this program, from other code with random strokes of its own: areas in per cent, rms
    /// over random strokes in per cent, openings, drift.
    type Expected = (&'static str, [f64; 4], f64, (f64, f64), [f64; 2]);

    const BRISTLES: ([f64; 4], f64, (f64, f64), [f64; 2]) = (
        [413.0, 228.0, 98.0, 6.0],
        39.0,
        (0.155, 0.20),
        [0.185, 0.84],
    );
    const NONE: (f64, f64) = (0.0, 0.0);

    #[rustfmt::skip]
    const EXPECTED: [Expected; 8] = [
        ("Dahl, LuGre, implicit", BRISTLES.0, BRISTLES.1, BRISTLES.2, BRISTLES.3),
        ("LuGre, explicit", BRISTLES.0, BRISTLES.1, BRISTLES.2, BRISTLES.3),
        ("Dahl, exponent 1/3, explicit", [95.0, 82.0, 83.0, 8.0], 29.0, (0.048, 0.11), [0.0574, 0.2056]),
        ("elasto-plastic, sticks to 0.7", [-100.0, 23.0, 64.0, 5.0], 13.0, NONE, [0.0, 0.0203]),
        ("elasto-plastic, sticks to 0.3", [-91.0, 73.0, 58.0, 3.0], 19.0, (0.004, 0.0194), [0.00409, 0.2109]),
        ("this crate, 4 elements", [-26.0, 0.4, -1.3, -0.1], 0.64, NONE, [0.0; 2]),
        ("this crate, 6 elements", [0.1, -2.0, -0.6, -0.1], 0.31, NONE, [0.0; 2]),
        ("this crate, 8 elements", [-6.0, -1.3, -0.3, 0.0], 0.19, NONE, [0.0; 2]),
    ];

    #[test]
    fn laws_reproduce_the_known_figures() {
        let mut laws = published();
        laws.extend(ours());
        for (name, areas, rms, opening, drift) in EXPECTED {
            let law = laws.iter().find(|law| law.name == name).unwrap();
            let found = Comparison::new(law).unwrap();
            let near = |found: f64, expected: f64, room: f64| {
                assert!(
                    (found - expected).abs() < room,
                    "{name}: {found} {expected}"
                );
            };
            for (found, expected) in found.areas.iter().zip(areas) {
                // Printed in whole per cents or tenths; explicit steps err by their size, 6e-4 of a breakaway angle against an area of 0.02.
                let digit = if expected.abs() > 10.0 { 1.2 } else { 0.6 };
                near(100.0 * found, expected, digit);
            }
            // Other random strokes: the known figure's path is not known. Measured: 5 % less to 42 % more.
            let ratio = 100.0 * found.random.0 / rms;
            assert!((0.85..1.45).contains(&ratio), "{name}: {ratio}");
            // Three digits.
            near(found.opening.0, opening.0, 2.5e-3);
            near(found.opening.1, opening.1, 2.5e-3);
            for (found, expected) in found.drift.iter().zip(drift) {
                near(*found, expected, 2e-7 + 2e-3 * expected);
            }
        }
    }

    #[test]
    fn only_implicit_steps_and_elements_take_any_tick() {
        for law in published().iter().chain(&ours()) {
            let largest = Comparison::new(law).unwrap().largest_turn;
            match law.name.as_str() {
                // An explicit step of dT = 1.5 dtheta (1 - T) is stable to 2 / 1.5.
                "LuGre, explicit" => assert!((largest.unwrap() - 4.0 / 3.0).abs() < 0.01),
                "Dahl, exponent 1/3, explicit" => assert!(largest.unwrap() < 0.1),
                _ => assert_eq!(largest, None, "{}", law.name),
            }
        }
    }

    #[test]
    fn multiplied_bristles_give_out_energy_and_elements_do_not() {
        for (one, other) in under_load(3.0).iter().zip(under_load(1.8)) {
            let name = &one.name;
            let least = least_loss(one.start().unwrap().as_mut(), 200_000);
            let work = work_of_a_load_cycle(other.start().unwrap().as_mut());
            if name == MULTIPLIED {
                // Known: 0.035 of limit times breakaway angle a cycle.
                assert!((work + 0.035).abs() < 0.001, "{work}");
                assert!(least < -0.28, "{least}");
            } else {
                assert!(work > 0.0, "{name}: {work}");
                // A stored energy of at most 3 x 3 in f32: 9 x 6e-8.
                assert!(least > -5e-7, "{name}: {least}");
            }
        }
    }

    /// Known figures, per cent, from other random paths; load-exact ones are met within a factor of 2.3, in proportion within 1.6. Multiplied ones depend
    /// on the path most: only that they are worst is held.
    #[test]
    fn errors_under_load_are_those_known() {
        let proportional = [1.2, 7.1, 8.2, 7.2, 27.0, 19.0, 16.0];
        let load_exact = [2.5, 8.1, 3.8, 1.3, 19.0, 5.8, 2.2];
        let multiplied = [2.1, 23.0, 16.0, 15.0, 38.0, 44.0, 40.0];
        for (index, (loads, amplitude)) in LOAD_CASES.into_iter().enumerate() {
            let found = errors_under_load(amplitude, loads).unwrap();
            let of =
                |wanted: &str| 100.0 * found.iter().find(|(name, _)| *name == wanted).unwrap().1;
            let near = |found: f64, known: f64, factor: f64| {
                assert!(
                    (known / factor..known * factor).contains(&found),
                    "{loads:?} {amplitude}: {found} {known}"
                );
            };
            near(of(PROPORTIONAL), proportional[index], 1.6);
            near(of(LOAD_EXACT), load_exact[index], 2.3);
            near(of(MULTIPLIED), multiplied[index], 2.6);
            assert!(of(MULTIPLIED) > of(LOAD_EXACT));
            assert!(of(MULTIPLIED) > of(PROPORTIONAL));
            // More elements are better, but where hardly any slips.
            assert!(
                of("load-exact, 10") < of("load-exact, 6") && of(LOAD_EXACT) < of("load-exact, 4")
            );
        }
    }

    /// No constants make a law of one state remember: fitted ones still miss random strokes by 10 % and more, elements by less than 1 %.
    #[test]
    fn the_best_constants_do_not_help_a_law_without_memory() {
        for law in best() {
            let found = Comparison::new(&law).unwrap().random.0;
            if law.name.starts_with("generalized") {
                // Four elements with an optimum of their own: 0.0076 beside the crate's 0.0078.
                assert!(found < 0.009, "{found}");
            } else {
                assert!(found > 0.1, "{}: {found}", law.name);
            }
        }
    }

    /// Each of the best constants, 5 % larger or smaller, does worse over the loops that they are the best of.
    #[test]
    fn the_best_constants_are_the_best() {
        for (name, _, constants, make) in BEST {
            let error = |constants: &[f64]| {
                let squares = AMPLITUDES.map(|amplitude| {
                    let course = Course::cycles(amplitude, 2, 40);
                    let found = torques(make(constants).as_mut(), &course.path());
                    rms(&found, &exact(&course.angle)).powi(2)
                });
                squares.iter().sum::<f64>()
            };
            for place in 0..constants.len() {
                for factor in [0.95, 1.05] {
                    let mut other = constants.to_vec();
                    other[place] *= factor;
                    assert!(error(&other) > error(constants), "{name}, {place}");
                }
            }
        }
    }
}
