use std::f64::consts::TAU;

use super::*;
use crate::simulate::caged::Caged;
use crate::simulate::memory::MemorySettings;
use crate::simulate::samples::ScrewSample;
use crate::simulate::scene::Row;
use crate::simulate::scene::Scene as _;
use crate::simulate::trace::Temperature;
use crate::simulate::uncaged::Uncaged;
use epas_design::files::DesignSource;

/// Of an encoder of 14 bits on a motor that makes 2.5 turns in one of the nut, rad of the nut.
const STEP: f64 = TAU / 16384.0 / 2.5;
const TICK: f64 = 1e-3;
/// Axial load, N.
const LOAD: f64 = 5e3;
/// More than that of either screw, which `simulate` prints, rad.
const LARGEST_BREAKAWAY: f64 = 0.1;

/// Steps at which an encoder stands: it turns by 3000, thirty a tick, and then flickers by one.
fn counts() -> Vec<i32> {
    let mut flicker = 0x9E37_u32;
    (0..2000)
        .map(|tick| {
            flicker = flicker.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let still = i32::from(flicker >> 31 == 1);
            if tick < 100 { 30 * tick } else { 3000 + still }
        })
        .collect()
}

/// A trace of such steps: speeds are their differences, with or without the position beside them.
fn trace(counts: &[i32], position: bool) -> Trace<ScrewSample> {
    let mut last = counts[0];
    let samples = counts.iter().enumerate().map(|(tick, &count)| {
        let turn = f64::from(count - std::mem::replace(&mut last, count)) * STEP;
        ScrewSample {
            time: TICK * tick as f64,
            nut_speed: turn / TICK,
            axial_load: LOAD,
            nut_position: if position {
                f64::from(count) * STEP
            } else {
                0.0
            },
        }
    });
    Trace {
        name: "flicker".into(),
        samples: samples.collect(),
    }
}

/// Friction torque over a trace, behind a dead band of a step or what the trace has.
fn friction(trace: &Trace<ScrewSample>, asked: Option<f64>) -> Vec<f32> {
    let source: DesignSource = "lin-4.1".parse().unwrap();
    let mut scene = Caged {
        design: source.load().unwrap(),
        memory: Some(MemorySettings::default()),
        temperature: false,
    };
    scene.set_memory(MemorySettings {
        encoder: EncoderStep::of(asked, trace),
        reference_load: None,
    });
    let (rows, _) = scene.rows(trace, &Temperature::None, None, &|| ()).unwrap();
    rows.iter().map(|row| row.outputs.friction).collect()
}

/// The same of a row of balls, which follows the speed of its ticks.
fn friction_of_row(trace: &Trace<ScrewSample>, asked: Option<f64>) -> Vec<f32> {
    let source: DesignSource = "lin-3.6".parse().unwrap();
    let design = source.load().unwrap();
    let mut scene = Uncaged {
        balls: design.uncaged.unwrap(),
        design,
        memory: Some(MemorySettings::default()),
    };
    scene.set_memory(MemorySettings {
        encoder: EncoderStep::of(asked, trace),
        reference_load: None,
    });
    let (rows, _) = scene.rows(trace, &Temperature::None, None, &|| ()).unwrap();
    let torque = |row: &Row<ScrewSample>| row.outputs.friction;
    rows.iter().map(torque).collect()
}

fn range(torque: &[f32]) -> f32 {
    let (low, high) = torque
        .iter()
        .fold((f32::MAX, f32::MIN), |(low, high), &torque| {
            (low.min(torque), high.max(torque))
        });
    high - low
}

/// One step of flicker at rest: the dead band is as wide as the step and its roundings. Once the flicker has been at both its ends no turn comes
/// through, and friction stands to the bit. Without it friction falls by a step at least: from full sliding F by `F step / breakaway`, because
/// friction after a reversal is concave; the row's balls slide at 0.3 N m too.
#[test]
fn flicker_at_rest_moves_no_friction() {
    let [alone, beside] = [false, true].map(|position| trace(&counts(), position));
    let least = 0.3 * (STEP / LARGEST_BREAKAWAY) as f32;
    for (what, friction, trace) in [
        ("caged", friction as fn(&_, _) -> _, &alone),
        ("caged, with a position", friction, &beside),
        ("row", friction_of_row, &alone),
    ] {
        let [with, without] = [None, Some(0.0)].map(|asked| friction(trace, asked));
        assert_eq!(range(&with[150..]), 0.0, "{what}");
        assert!(with[99] > 0.3, "{what}: {}", with[99]);
        let moved = range(&without[150..]);
        assert!(moved > least, "{what}: {moved} {least}");
    }
}

/// A speed with noise of its own in every tick walks where the nut rests; the angle beside it does not, and friction that follows it stands.
#[test]
fn a_position_in_the_trace_is_followed_in_place_of_the_speed() {
    let mut noisy = trace(&counts(), true);
    for (index, sample) in noisy.samples.iter_mut().enumerate() {
        sample.nut_speed += f64::from(index as u32 * 7919 % 13) * STEP / TICK / 13.0;
    }
    assert_eq!(range(&friction(&noisy, None)[150..]), 0.0);
    let mut turning = trace(&counts(), true);
    for sample in &mut turning.samples {
        sample.nut_position = (sample.nut_position + 3.0).rem_euclid(TAU);
    }
    let joined = friction(&trace(&counts(), true), None);
    for (turning, joined) in friction(&turning, None).iter().zip(joined) {
        // Angles near a turn are rounded to 2.4e-7 rad, at 2 kN m/rad.
        assert!((turning - joined).abs() < 1e-3, "{turning} {joined}");
    }
}

/// The step is that of the flicker of the position where a trace has one, else of the speed; what is asked for comes first.
#[test]
fn the_step_of_a_trace_is_found() {
    let found = |trace: &Trace<ScrewSample>, asked| EncoderStep::of(asked, trace);
    for position in [false, true] {
        let flickers = trace(&counts(), position);
        let own = found(&flickers, None);
        assert!((own.step / STEP - 1.0).abs() < 1e-6, "{own:?}");
        let origin = if position {
            Origin::Position
        } else {
            Origin::Speed
        };
        assert_eq!(own.origin, origin);
        assert_eq!(found(&flickers, Some(1e-3)).size(), 1e-3);
        assert_eq!(found(&flickers, Some(0.0)).size(), 0.0);
    }
}

/// Motion is no flicker: speeds of a square wave, and of an encoder that turns slowly or to and fro by more than a step.
#[test]
fn motion_has_no_step() {
    let square: Vec<i32> = (0..2000).map(|tick| (tick / 10 % 2) * 10).collect();
    let triangle: Vec<i32> = (0..2000).map(|tick: i32| (tick % 20 - 10).abs()).collect();
    let slow: Vec<i32> = (0..2000).map(|tick| tick / 7).collect();
    let noise: Vec<i32> = {
        let mut random = 7_u32;
        (0..2000)
            .map(|_| {
                random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                i32::try_from(random >> 28).unwrap()
            })
            .collect()
    };
    for counts in [&triangle, &slow, &noise] {
        for position in [false, true] {
            let found = EncoderStep::of(None, &trace(counts, position));
            assert_eq!(found, EncoderStep::default());
        }
    }
    // Ten steps at once, to and fro: that is flicker between two angles.
    let found = EncoderStep::of(None, &trace(&square, false));
    assert!((found.step / (10.0 * STEP) - 1.0).abs() < 1e-9);
}
