//! The firmware's friction task on the host: its calibration page and its reaction to what is missing.

use epas_firmware::friction_task::FAST_TICK;
use epas_firmware::friction_task::gear::constants;
use epas_firmware::friction_task::page::{CALIBRATION, Calibration, CalibrationPage, Refused};
use epas_firmware::friction_task::reaction::{Reaction, ReactionParameters};

/// The reference with one number changed.
fn with(index: usize, value: f32) -> Calibration {
    let mut words = Calibration::REFERENCE.words();
    words[index] = value.to_bits();
    Calibration::of_words(words)
}

/// No bit of a page can be wrong alone: a checksum of 32 bits finds any one.
#[test]
fn every_wrong_bit_of_a_page_is_found() {
    let page = CalibrationPage::REFERENCE;
    assert_eq!(page.checked(), Ok(Calibration::REFERENCE));
    for bit in 0..32 {
        let layout = page.layout ^ (1 << bit);
        assert_eq!(
            CalibrationPage { layout, ..page }.checked(),
            Err(Refused::Layout)
        );
        let checksum = page.checksum ^ (1 << bit);
        assert_eq!(
            CalibrationPage { checksum, ..page }.checked(),
            Err(Refused::Checksum)
        );
        for index in 0..Calibration::LENGTH {
            let mut words = page.numbers.words();
            words[index] ^= 1 << bit;
            let numbers = Calibration::of_words(words);
            assert_eq!(
                CalibrationPage { numbers, ..page }.checked(),
                Err(Refused::Checksum)
            );
        }
    }
}

/// Limits of the table are those of the page, and the model takes every number at either of its limits; the two that go together with
/// another one are refused by the model where that stays.
#[test]
fn limits_of_the_page_are_within_those_of_the_model() {
    for (index, field) in CALIBRATION.iter().enumerate() {
        for (value, beyond) in [
            (field.minimum, field.minimum.next_down()),
            (field.maximum, field.maximum.next_up()),
        ] {
            let place = u32::try_from(index).unwrap();
            for wrong in [beyond, f32::NAN, f32::INFINITY] {
                assert_eq!(
                    CalibrationPage::of(with(index, wrong)).checked(),
                    Err(Refused::Range(place)),
                    "{} = {wrong}",
                    field.name
                );
            }
            let numbers = CalibrationPage::of(with(index, value)).checked().unwrap();
            // The play has to cover 4 % of the breakaway angle.
            let together = match field.name {
                "breakaway_angle" => value > 0.004,
                "angle_play" => value < 2e-4,
                _ => false,
            };
            let refused = constants(&numbers).err().map(|error| error.field());
            assert_eq!(
                refused,
                together.then_some("play"),
                "{} = {value}",
                field.name
            );
        }
    }
}

/// Held, faded in its time, back in its time; and no step beyond the slew, whatever the model says.
#[test]
fn torque_is_held_fades_and_comes_back() {
    let parameters = ReactionParameters::of(&Calibration::REFERENCE);
    let mut reaction = Reaction::START;
    let mut last = 0.0;
    let mut tick = |friction: Option<f32>, known: bool| {
        let torque = reaction.torque(friction, known, &parameters);
        // Torques are below 4 N m, and their difference is rounded once: 2^-22 N m.
        assert!((torque - last).abs() <= parameters.largest_step + 2.4e-7);
        last = torque;
        torque
    };
    let ticks = |time: f32| (time / FAST_TICK).round() as u32;
    let Calibration {
        share,
        torque_hold,
        torque_fade,
        ..
    } = Calibration::REFERENCE;
    for _ in 0..=ticks(torque_fade) {
        tick(Some(1.0), true);
    }
    assert_eq!(tick(Some(1.0), true), share);
    // A model in other hands keeps the torque.
    assert_eq!(tick(None, true), share);
    for _ in 0..ticks(torque_hold) {
        assert_eq!(tick(Some(1.0), false), share);
    }
    // Half of the fade, to within two ticks: sums of the hold and the part are rounded.
    for _ in 0..ticks(0.5 * torque_fade) {
        tick(Some(1.0), false);
    }
    let half = tick(Some(1.0), false);
    assert!((half - 0.5 * share).abs() < 2.5 * share * parameters.fade_step);
    for _ in 0..ticks(torque_fade) {
        tick(Some(1.0), false);
    }
    assert_eq!(tick(Some(1.0), false), 0.0);
    for _ in 0..=ticks(torque_fade) {
        tick(Some(1.0), true);
    }
    assert_eq!(tick(Some(1.0), true), share);
    // A friction that turns round at once does so by the slew alone.
    let steps = (2.0 * share / parameters.largest_step).ceil() as u32;
    for _ in 0..=steps {
        tick(Some(-1.0), true);
    }
    assert_eq!(tick(Some(-1.0), true), -share);
}
