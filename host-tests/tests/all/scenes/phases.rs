//! Where the groove that passes by stands, how far a circuit reaches, and how long its ticks may be.

use epas_testkit::gears::{linear_inputs, screw_inputs};
use std::f32::consts::TAU;

use epas_friction::{
    DeviationMap, Error, FrictionModel, LinearBearing, LinearBearingConfiguration,
    LinearBearingParameters, LinearBearingTrain, UncagedBallScrewConfiguration,
};

use epas_testkit::gears::{
    self, LINEAR_BALLS, SCREW_BALLS, UncagedConfiguration, UncagedScrew, wave,
};

type Linear = LinearBearingTrain<LINEAR_BALLS>;
type Uncaged = UncagedScrew<SCREW_BALLS>;

fn from_angle(angle: f32) -> Vec<f32> {
    let configuration = UncagedBallScrewConfiguration {
        screw_deviation: wave(2, 1, 0.0, gears::BALL_RANGE.law.deviations[0]),
        nut_deviation: &DeviationMap::NONE,
        return_length: 0.0,
        turns: 2.53,
        ..gears::uncaged()
    };
    let mut model = FrictionModel::<Uncaged>::new(&configuration).unwrap();
    model.set_nut_angle(angle);
    let inputs = screw_inputs(30.0, 3000.0);
    (0..600)
        .map(|_| model.step(inputs).friction_torque)
        .collect()
}

fn from_position(position: f32, (cosine, sine): (f32, f32)) -> Vec<f32> {
    let configuration = LinearBearingConfiguration {
        rail_deviation: wave(1, 1, cosine, sine),
        ..gears::linear()
    };
    let mut model = FrictionModel::<Linear>::new(&configuration).unwrap();
    model.set_carriage_position(position);
    let inputs = linear_inputs(1.0, 3000.0, 1000.0);
    (0..600)
        .map(|_| model.step(inputs).friction_force)
        .collect()
}

fn difference(one: &[f32], other: &[f32]) -> f32 {
    let largest = one.iter().fold(0.0_f32, |most, one| most.max(one.abs()));
    let pairs = one.iter().zip(other);
    pairs.fold(0.0_f32, |most, (one, other)| most.max((one - other).abs())) / largest
}

/// Rounding of an angle of 30 rad is 1e-6 of a wave. Measured: 2e-7, and 0.035 where the groove is half a period off.
#[test]
fn a_groove_is_the_same_a_period_on() {
    let angle = 1.1;
    let here = from_angle(angle);
    assert!(difference(&here, &from_angle(angle + 4.0 * TAU)) < 7e-7);
    assert!(difference(&here, &from_angle(angle - 2.0 * TAU)) < 7e-7);
    assert!(difference(&here, &from_angle(angle + TAU)) > 1e-3);
}

/// A quarter of a wavelength turns a sine into a cosine. Measured: 0, as 5 and a quarter are exact in f32, and 0.083 between sine
/// and cosine.
#[test]
fn a_rail_is_the_same_a_wavelength_on() {
    let wavelength = gears::linear().wavelength;
    let (sine, cosine) = ((0.0, 0.03), (0.03, 0.0));
    let here = from_position(0.0, sine);
    assert!(difference(&here, &from_position(5.0 * wavelength, sine)) < 2e-7);
    let quarter = from_position(0.25 * wavelength, sine);
    assert!(difference(&quarter, &from_position(0.0, cosine)) < 2e-7);
    assert!(difference(&here, &quarter) > 1e-5);
}

fn range<T>(made: &Result<T, Error>) -> (&'static str, f32, f32) {
    match made {
        Err(Error::OutOfRange { field, allowed, .. }) => (*field, allowed.minimum, allowed.maximum),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("taken"),
    }
}

fn close(found: (&str, f32, f32), field: &str, border: f64, is_least: bool) {
    let (named, least, most) = found;
    let found = f64::from(if is_least { least } else { most });
    assert_eq!(named, field);
    // Five operations with a rounding error of 6e-8 each.
    assert!(
        (found / border - 1.0).abs() < 3e-7,
        "{field}: {found} {border}"
    );
}

/// A bearing's circuit: at most 250 loaded lengths of return and 1000 wavelengths; in a tick balls travel 0.03 of their track at
/// most, and the rail passes by 0.499 of its period.
#[test]
fn a_bearing_is_as_long_and_its_ticks_as_short_as_promised() {
    let with = |change: &dyn Fn(&mut LinearBearingConfiguration)| {
        let mut configuration = gears::linear();
        change(&mut configuration);
        range(&FrictionModel::<Linear>::new(&configuration))
    };
    let loaded = f64::from(gears::linear().loaded_length);
    let found = with(&|c| (c.return_length, c.wavelength) = (31.0, 1.0));
    close(found, "return_length", 250.0 * loaded, false);
    let found = with(&|c| (c.return_length, c.wavelength) = (1.0, 1e-3));
    close(found, "wavelength", (loaded + 1.0) / 1000.0, true);
    let found = with(&|c| c.tick = 0.5);
    close(found, "tick", 0.03 * (loaded + 0.05) / (0.5 * 3.0), false);
    let found = with(&|c| (c.loaded_length, c.return_length, c.tick) = (1.0, 1.0, 0.02));
    close(found, "tick", 0.499 * 0.06 / 3.0, false);
    let found = with(&|c| {
        (c.loaded_length, c.return_length, c.tick) = (1.0, 1.0, 0.03);
        c.rail_deviation = wave(2, 1, 0.0, 0.01);
    });
    close(found, "tick", 0.499 * 0.12 / 3.0, false);
}

/// A screw's circuit: 1000 turns of the track at most, and in a tick the screw passes by 0.499 of its period, here of a turn.
#[test]
fn a_screw_is_as_long_and_its_ticks_as_short_as_promised() {
    let configuration = gears::uncaged();
    let (turns, per_turn) = (
        f64::from(configuration.turns),
        f64::from(TAU) * f64::from(configuration.folded.path_radius),
    );
    let small = gears::changed(configuration.folded, |folded| {
        (folded.ball_radius, folded.path_radius, folded.speed) = (1e-4, 1e-3, 5e-4);
    });
    let small_turn = f64::from(TAU) * f64::from(small.path_radius);
    let short = UncagedBallScrewConfiguration {
        folded: small,
        return_length: 9.0,
        ..configuration
    };
    let found = range(&FrictionModel::<Uncaged>::new(&short));
    close(found, "return_length", (1000.0 - turns) * small_turn, false);
    let few = UncagedBallScrewConfiguration {
        turns: 0.2,
        return_length: 9.0,
        ..configuration
    };
    let found = range(&FrictionModel::<Uncaged>::new(&few));
    close(found, "return_length", 250.0 * 0.2 * per_turn, false);
    let mut slow = gears::uncaged();
    slow.tick = 0.9;
    slow.return_length = 5.0;
    slow.folded = gears::changed(slow.folded, |folded| folded.limits.nut_speed = 10.0);
    let found = range(&FrictionModel::<Uncaged>::new(&slow));
    close(found, "tick", 0.499 * f64::from(TAU) / 10.0, false);
}

/// Grooves deviate by what a ball was folded for at most, here 10 degrees on the screw and 5 in the nut: so much is taken, and a thousandth
/// more refused.
#[test]
fn grooves_deviate_by_as_much_as_a_ball_was_folded_for() {
    let largest = [10_f32, 5.0].map(f32::to_radians);
    let even = gears::even();
    let folded = gears::changed(even.folded, |folded| folded.law.deviations = largest);
    let with = |screw_deviation, nut_deviation| {
        FrictionModel::<Uncaged>::new(&UncagedConfiguration {
            folded,
            screw_deviation,
            nut_deviation,
            ..even
        })
    };
    let none = &DeviationMap::NONE;
    let [screw, nut] = largest.map(|size| wave(1, 1, 0.0, size));
    assert!(with(screw, none).is_ok() && with(none, nut).is_ok() && with(screw, nut).is_ok());
    // A map keeps its largest sample to four roundings.
    let borders = largest.map(|size| f64::from(size) * (1.0 + 4.0 * f64::from(f32::EPSILON)));
    let [screw, nut] = largest.map(|size| wave(1, 1, 0.0, 1.001 * size));
    let found = range(&with(screw, none));
    close(found, "screw_deviation", borders[0], false);
    close(range(&with(none, nut)), "nut_deviation", borders[1], false);
}

/// Grooves of a bearing deviate by half the contact angle at most, here 10 degrees of 20: so much is taken, and a thousandth more refused.
#[test]
fn straight_grooves_deviate_by_as_much_as_promised() {
    let largest = 10_f32.to_radians();
    let more = 1.001 * largest;
    let [taken, refused] = [largest, more].map(|size| wave(1, 1, 0.0, size));
    let none = &DeviationMap::NONE;
    // A map keeps its largest sample to four roundings.
    let border = f64::from(largest) * (1.0 + 4.0 * f64::from(f32::EPSILON));
    let mut bearing = gears::linear();
    bearing.bearing = LinearBearing::new(LinearBearingParameters {
        contact_angle: 2.0 * largest,
        ..*bearing.bearing.parameters()
    })
    .unwrap();
    let with = |rail_deviation, carriage_deviation| {
        let configuration = LinearBearingConfiguration {
            rail_deviation,
            carriage_deviation,
            ..bearing
        };
        FrictionModel::<Linear>::new(&configuration)
    };
    assert!(with(taken, none).is_ok() && with(none, taken).is_ok());
    close(range(&with(refused, none)), "rail_deviation", border, false);
    close(
        range(&with(none, refused)),
        "carriage_deviation",
        border,
        false,
    );
}
