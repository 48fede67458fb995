//! A drive of a minute in f64: on-centre weave, parking and turns of some milliradians, with friction by the exact hysteresis
//! whose level changes; and what sensors make of it.

use std::f64::consts::TAU;

use epas_friction::adaptation::{Adaptation, AdaptationConfiguration, AdaptationInputs, Adapted};
use epas_friction::law::memory::{MemoryState, Part, ProportionalElements, SLIP_8};
use epas_friction::law::{Elements, FrictionLevel, SlidingLimits};
use epas_friction::{Faults, Regime};
use epas_reference::presliding::tables::SLIP_10;
use epas_reference::presliding::{Limits, elements};

use epas_testkit::random::Random;

/// Time of a tick of the drive, s.
pub const TICK: f64 = 1e-3;
/// Ticks from one update to the next, and its time, s.
pub const EVERY: usize = 10;
pub const UPDATE: f32 = 0.01;
/// Seconds of a drive.
pub const DRIVE: f64 = 60.0;

/// Breakaway angle, rad, and friction at the preload, N m.
const BREAKAWAY: f64 = 2e-3;
const PRELOADED: f64 = 0.025;

/// Lead over a turn, m, of a lead of 7 mm.
const REDUCED_LEAD: f64 = 7e-3 / TAU;

#[derive(Clone, Copy, Debug, Default)]
pub struct Truth {
    /// Drag, N m s/rad.
    pub drag: f64,
    /// Offset of the motor's torque, N m.
    pub offset: f64,
    /// Part of the load that the load channel does not show.
    pub load_error: f64,
    pub noise: f64,
}

#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub speed: f64,
    pub turn: f64,
    pub load: f64,
}

/// Nut angle, rad, and axial load, N, at a time, s: in every 12 s five of weave, four of parking, three of micro-motion.
fn motion(time: f64) -> (f64, f64) {
    let phase = time % 12.0;
    let round = (time / 12.0).floor();
    let weave = 0.8 * (TAU * 0.2 * time).sin() + 0.3 * (TAU * 1.5 * time + 0.3).sin();
    if phase < 5.0 {
        (weave, 900.0 * (TAU * 0.2 * time - 0.2).sin())
    } else if phase < 9.0 {
        let parking = 28.0 * (1.0 - (TAU * 0.25 * (phase - 5.0)).cos());
        (weave + parking, 2800.0 * (TAU * 0.25 * (phase - 5.0)).sin())
    } else {
        let micro = 4e-3 * (TAU * (1.0 + 0.3 * round) * phase).sin();
        (micro, 400.0 * (TAU * 0.1 * time).sin())
    }
}

pub fn samples(seconds: f64) -> impl Iterator<Item = Sample> {
    let ticks = (seconds / TICK) as u64;
    let mut last = motion(0.0).0;
    (1..=ticks).map(move |tick| {
        let (angle, load) = motion(tick as f64 * TICK);
        let turn = angle - last;
        last = angle;
        let turn = if turn.abs() > 0.2 { 0.0 } else { turn };
        Sample {
            speed: turn / TICK,
            turn,
            load,
        }
    })
}

/// Limits of sliding, N m, with a preload that both loads open: larger where the load drives.
pub fn limits(load: f64) -> Limits {
    let whole = PRELOADED + 1.1e-5 * load.abs();
    Limits {
        forward: whole + 4e-7 * load,
        backward: whole - 4e-7 * load,
    }
}

#[derive(Clone, Debug, Default)]
pub struct Left {
    pub level: f64,
    /// Root mean square of true friction less that of the model, N m, with the levels found, and without.
    pub adapted: f64,
    pub without: f64,
    pub last: Option<Adapted>,
    pub errors: Vec<f64>,
}

/// A drive with a level that changes with time, s. With `applied` the model runs with the levels found.
pub fn drive(
    configuration: &AdaptationConfiguration,
    truth: Truth,
    level: impl Fn(f64) -> f64,
    seconds: f64,
    applied: bool,
) -> Left {
    let mut adaptation = Adaptation::new(configuration).unwrap();
    let mut random = Random(11);
    let mut exact = SLIP_10.elements();
    let part = Part {
        backbone: &SLIP_8.elements,
        share: 1.0,
        breakaway_angle: BREAKAWAY as f32,
    };
    let model = ProportionalElements::<8>::new(PRELOADED as f32, &[part]).unwrap();
    let (mut with, mut plain) = (MemoryState::VIRGIN, MemoryState::VIRGIN);
    let (mut sums, mut left) = ([0.0; 3], Left::default());
    let mut means = [0.0_f64; 4];
    for (tick, sample) in samples(seconds).enumerate() {
        let time = tick as f64 * TICK;
        let full = limits(sample.load);
        let friction = torque(&mut exact, sample.turn, full.times(level(time)));
        let nominal = sliding(full, sample.load);
        let found = if applied {
            adaptation.level()
        } else {
            FrictionLevel::ONE
        };
        let turn = sample.turn as f32;
        let scaled = nominal.times(&found);
        let modelled = model.follow(&mut with, turn, &scaled);
        let unadapted = model.follow(&mut plain, turn, &nominal);
        let limit = if modelled < 0.0 {
            scaled.backward
        } else {
            scaled.forward
        };
        let load_torque = sample.load * REDUCED_LEAD;
        let shown = friction
            + truth.drag * sample.speed
            + truth.offset
            + truth.load_error * load_torque
            + truth.noise * normal(&mut random);
        for (mean, value) in
            means
                .iter_mut()
                .zip([shown, f64::from(modelled), sample.speed, load_torque])
        {
            *mean += value / EVERY as f64;
        }
        sums[1] += (friction - f64::from(modelled)).powi(2);
        sums[2] += (friction - f64::from(unadapted)).powi(2);
        if (tick + 1) % EVERY == 0 {
            let [observed, mean_model, nut_speed, load_torque] = means.map(|mean| mean as f32);
            means = [0.0; 4];
            let adapted = adaptation.update(&AdaptationInputs {
                observed,
                modelled: mean_model,
                lubricant_drag: 0.0,
                level: found,
                nut_speed,
                load_torque,
                regime: if modelled.abs() < 0.99 * limit {
                    Regime::Standing
                } else {
                    Regime::Driving
                },
                faults: Faults::NONE,
                saturated: false,
            });
            let true_level = level(time);
            for found in [adapted.estimates.forward, adapted.estimates.backward] {
                let error = f64::from(found) - true_level;
                sums[0] += error * error / 2.0;
                left.errors.push(error);
            }
            left.last = Some(adapted);
        }
    }
    let ticks = seconds / TICK;
    left.level = (sums[0] / (ticks / EVERY as f64)).sqrt();
    left.adapted = (sums[1] / ticks).sqrt();
    left.without = (sums[2] / ticks).sqrt();
    left
}

/// Exact friction, N m, of elements in units of the preload's friction and breakaway angle.
fn torque(exact: &mut elements::Elements, turn: f64, limits: Limits) -> f64 {
    PRELOADED * exact.follow(turn / BREAKAWAY, limits.times(1.0 / PRELOADED), 1.0)
}

fn sliding(limits: Limits, load: f64) -> SlidingLimits {
    SlidingLimits {
        forward: limits.forward as f32,
        backward: limits.backward as f32,
        load: load.abs() as f32,
    }
}

pub fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.between(0.0, 1.0)).sum::<f64>() - 6.0
}

pub fn configuration(forgetting_time: f32) -> AdaptationConfiguration {
    AdaptationConfiguration {
        forgetting_time,
        ..AdaptationConfiguration::every(UPDATE)
    }
}

pub const fn sound(observed: f32, modelled: f32, nut_speed: f32) -> AdaptationInputs {
    AdaptationInputs {
        observed,
        modelled,
        lubricant_drag: 0.0,
        level: FrictionLevel::ONE,
        nut_speed,
        load_torque: 0.0,
        regime: Regime::Driving,
        faults: Faults::NONE,
        saturated: false,
    }
}
