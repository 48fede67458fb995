//! Friction coefficient by speed, temperature and direction.

use crate::refusals::{assert_refused, assert_refused_at};
use epas_friction::defaults;
use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, OilData, TemperatureFade, Viscosity,
};
use epas_reference::coefficient::{BearingMixture, FilmContact, Vogel, Walther, coefficient};
use epas_reference::promises;

use epas_testkit::errors::Errors;

const OIL: Vogel = Vogel {
    viscosity_40: 0.088,
    viscosity_100: 0.0095,
    offset: 150.0,
};

/// Zero of the Celsius scale, K.
const ZERO: f64 = 273.15;

/// The default's coefficients with a mineral oil and the half-share speed of its film, for which the coefficients are tabulated.
const MINERAL: CoefficientParameters = CoefficientParameters {
    half_share_speed: 4.9,
    viscosity: defaults::VISCOSITY,
    ..defaults::COEFFICIENT
};

/// The screw of Lin 2019, Table 4.1, under 1 kN: 71 balls at 45 degrees, contact with the screw.
fn film() -> FilmContact {
    let (pitch, lead, ball) = (14.5e-3_f64, 7e-3, 2e-3);
    let cos_lead = (lead / (std::f64::consts::TAU * pitch)).atan().cos();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let bend = half * cos_lead * cos_lead / pitch;
    FilmContact {
        rolling_radius: 1.0 / (1.0 / ball + bend / (1.0 - ball * bend)),
        ellipticity: 1.0 / 0.172_786,
        load: 1000.0 / (71.0 * cos_lead * half),
        contact_modulus: 210e9 / (2.0 * (1.0 - 0.28 * 0.28)),
        pressure_viscosity: 20e-9,
        roughness: 0.15e-6,
    }
}

/// Mean speed of the surfaces over the nut's speed: half the pitch radius, m.
const ENTRAINMENT: f64 = 14.5e-3 / 2.0;

/// The full law at a nut speed, rad/s, and a temperature, degrees Celsius.
fn full_law(speed: f64, celsius: f64) -> f64 {
    let asperities = film().asperities(OIL.at(celsius), ENTRAINMENT * speed);
    coefficient(0.12, 0.05, asperities)
}

fn kelvin(celsius: f64) -> f32 {
    (celsius + ZERO) as f32
}

fn at_celsius(law: &CoefficientLaw, speed: f64, celsius: f64) -> f64 {
    f64::from(law.at_temperature(kelvin(celsius)).at(speed as f32))
}

#[test]
fn the_reference_has_the_tabulated_coefficients() {
    let speeds = [0.1, 1.0, 5.0, 20.0, 100.0, 200.0];
    for (celsius, row) in [
        (-20.0, [0.094, 0.064, 0.053, 0.051, 0.050, 0.050]),
        (20.0, [0.116, 0.104, 0.085, 0.066, 0.054, 0.052]),
        (80.0, [0.119, 0.117, 0.111, 0.101, 0.081, 0.071]),
    ] {
        for (speed, printed) in speeds.into_iter().zip(row) {
            let error = (full_law(speed, celsius) - printed).abs();
            assert!(error < 5e-4, "{celsius} C, {speed} rad/s: {error}");
        }
    }
    for (celsius, printed) in [(-20.0, 0.20), (20.0, 4.9), (80.0, 73.0)] {
        // Measured: 0.73 %, of figures with two digits.
        let found = film().half_share_speed(OIL.at(celsius)) / ENTRAINMENT;
        assert!(
            (found / printed - 1.0_f64).abs() < 0.015,
            "{celsius} C: {found}"
        );
    }
}

/// The form against the full law, over the difference of both coefficients, 0.1 to 500 rad/s; at 20 degrees with the half-share
/// speed of the law, then with the default's formula of the viscosity over -20 to 120 degrees.
#[test]
fn the_rational_form_is_near_the_full_law() {
    let law = CoefficientLaw::new(&MINERAL).unwrap();
    let speeds = || (0..=80).map(|step| 0.1 * 5000_f64.powf(f64::from(step) / 80.0));
    let mut alone = Errors::of("rational form of the coefficient, 20 C");
    for speed in speeds() {
        let error = (at_celsius(&law, speed, 20.0) - full_law(speed, 20.0)) / 0.07;
        alone.add_at(error, speed);
    }
    let (mut both, mut warming) = (Errors::default(), Errors::default());
    let mut cold = Errors::of("rational form and viscosity, -40 to -20 C");
    for celsius in (-40..=120).step_by(5) {
        let is_cold = celsius < -20;
        let celsius = f64::from(celsius);
        let kept = law.at_temperature(kelvin(celsius));
        for speed in speeds() {
            let full = full_law(speed, celsius);
            let line = || format!("{celsius} C {speed} rad/s");
            let anew = (at_celsius(&law, speed, celsius) - full) / 0.07;
            if is_cold {
                cold.add_case(anew, line);
                continue;
            }
            warming.add_case(anew, line);
            both.add_case((f64::from(kept.at(speed as f32)) - full) / 0.07, line);
        }
    }
    for errors in [alone, cold] {
        errors.assert_measured();
    }
    both.assert_promised(promises::of("friction_coefficient"));
    warming.assert_promised(promises::of("friction_coefficient_warming"));
}

/// Measured, over the exact law, as the table of `Viscosity` prints it, with two decimals: half a unit. The pole to a tenth of a degree.
#[test]
fn viscosities_by_two_points() {
    let worst = |found: &Viscosity, oil: &dyn Fn(f64) -> f64, from: i32, to: i32| {
        (from..=to)
            .map(|celsius| {
                let celsius = f64::from(celsius);
                (f64::from(found.at(kelvin(celsius))) / oil(celsius) - 1.0).abs()
            })
            .fold(0.0, f64::max)
    };
    let ranges = [(0, 100), (-20, 120), (-40, 120)];
    let vogel = |celsius: f64| OIL.at(celsius);
    let two = defaults::VISCOSITY;
    // The same with the pole at -64 degrees, and the level that errs least from -20 to 120.
    let power = |celsius: f64| (celsius + 64.0).powi(-5);
    let levels = (-20..=120).map(|celsius| vogel(celsius.into()) / power(celsius.into()));
    let (low, high) = levels.fold((f64::MAX, 0.0_f64), |(low, high), level| {
        (low.min(level), high.max(level))
    });
    let curve = |celsius: f64| (2.0 * low * high / (low + high) * power(celsius)) as f32;
    let fitted = Viscosity::through(
        (kelvin(40.0), curve(40.0)),
        (kelvin(100.0), curve(100.0)),
        228.15,
    )
    .unwrap();
    let mineral = Walther {
        viscosity_40: 100.0,
        viscosity_100: 11.2,
    };
    let synthetic = Walther {
        viscosity_40: 100.0,
        viscosity_100: 14.5,
    };
    let dense = |celsius: f64| 880.0 * (1.0 - 6.5e-4 * (celsius - 15.0)) * 1e-6;
    let oil = |walther: Walther| {
        Viscosity::of_oil(&OilData {
            kinematic_viscosity_40: walther.viscosity_40 as f32 * 1e-6,
            kinematic_viscosity_100: walther.viscosity_100 as f32 * 1e-6,
            density: 880.0,
            pour_point: 228.15,
        })
        .unwrap()
    };
    let near = {
        let at = |celsius: f64| (mineral.at(celsius) * dense(celsius)) as f32;
        Viscosity::through((kelvin(0.0), at(0.0)), (kelvin(40.0), at(40.0)), 228.15).unwrap()
    };
    let (mineral_oil, synthetic_oil) = (oil(mineral), oil(synthetic));
    let mineral = |celsius: f64| mineral.at(celsius) * dense(celsius);
    let synthetic = |celsius: f64| synthetic.at(celsius) * dense(celsius);
    for ((from, to), printed) in ranges.into_iter().zip([
        [0.12, 0.05, 0.43, 0.35],
        [0.16, 0.06, 0.67, 0.59],
        [0.16, 0.87, 0.81, 0.77],
    ]) {
        let found = [
            worst(&two, &vogel, from, to),
            worst(&fitted, &vogel, from, to),
            worst(&mineral_oil, &mineral, from, to),
            worst(&synthetic_oil, &synthetic, from, to),
        ];
        for (found, printed) in found.into_iter().zip(printed) {
            assert!((found - printed).abs() < 5e-3, "{found} for {printed}");
        }
    }
    let near = worst(&near, &mineral, -20, 60);
    assert!((near - 0.2).abs() < 5e-3, "{near}");
    assert!((two.pole() - 273.15 + 67.0).abs() < 0.05);
}

/// -60 to 150 degrees, 0 to 500 rad/s and beyond: finite, between both coefficients, falling with the speed and rising with the
/// temperature where friction falls with speed, and the other way round where it rises. In f32 to the last bit in the speed,
/// within two of them in the temperature.
#[test]
fn sweeps_are_monotone() {
    for (boundary, full_film) in [(0.12_f32, 0.05), (0.08, 0.15), (0.1, 0.1)] {
        let law = CoefficientLaw::new(&CoefficientParameters {
            boundary,
            full_film,
            ..MINERAL
        })
        .unwrap();
        let sign = (boundary - full_film).signum() * f32::from(boundary != full_film);
        let (low, high) = (boundary.min(full_film), boundary.max(full_film));
        let speeds: Vec<f32> = (0..=2000_u16)
            .map(|step| 500.0 * (f32::from(step) / 2000.0).powi(3))
            .chain([1e3, 1e4, 1e6, f32::MAX, f32::INFINITY])
            .collect();
        let mut colder: Option<Vec<f32>> = None;
        for half_degrees in -120..=300_i16 {
            let now = law.at_temperature(kelvin(0.5 * f64::from(half_degrees)));
            let row: Vec<f32> = speeds.iter().map(|speed| now.at(*speed)).collect();
            assert!((row[0] - boundary).abs() <= f32::EPSILON * boundary);
            for (pair, speed) in row.windows(2).zip(&speeds) {
                assert!(
                    sign * (pair[1] - pair[0]) <= 0.0,
                    "{half_degrees} {speed}: {pair:?}"
                );
            }
            for (mu, speed) in row.iter().zip(&speeds) {
                assert!(
                    *mu >= low * (1.0 - 1e-7) && *mu <= high * (1.0 + 1e-7),
                    "{mu}"
                );
                assert_eq!(now.at(-speed), *mu);
            }
            if let Some(colder) = colder {
                for (warm, cold) in row.iter().zip(&colder) {
                    assert!(sign * (warm - cold) >= -2.0 * f32::EPSILON * high);
                }
            }
            colder = Some(row);
        }
    }
}

#[test]
fn equal_coefficients_are_constant() {
    for friction in [1e-6_f32, 0.05, 0.1, 0.123_456_79, 1.0] {
        let parameters = CoefficientParameters::constant(friction, defaults::VISCOSITY);
        let law = CoefficientLaw::new(&parameters).unwrap();
        for temperature in [0.0, 200.0, 293.15, 400.0, 1e9, f32::NAN, f32::NEG_INFINITY] {
            let now = law.at_temperature(temperature);
            for speed in [
                0.0,
                -0.0,
                1e-40,
                0.3,
                -17.0,
                500.0,
                1e6,
                f32::INFINITY,
                f32::NAN,
            ] {
                assert_eq!(now.at(speed).to_bits(), friction.to_bits());
                let both = now.both(speed);
                assert_eq!([both.forward, both.backward], [friction; 2]);
                assert_eq!(now.churning_torque(speed), 0.0);
            }
        }
    }
}

/// The default's lubricant: 48 and 8.0 mm²/s at 40 and 100 degrees and 19,000 at -40, density 833 kg/m³ at 15 less 0.65 a degree.
#[test]
fn default_grease_is_a_poly_alpha_olefin() {
    let grease = defaults::STEERING_GREASE;
    let printed = [
        (-40.0, 19_000.0, 0.02),
        (40.0, 48.0, 0.01),
        (100.0, 8.0, 0.26),
    ];
    for (celsius, kinematic, most) in printed {
        let exact = kinematic * 1e-6 * (833.0 - 0.65 * (celsius - 15.0));
        let found = f64::from(grease.at(kelvin(celsius)));
        assert!(
            (found / exact - 1.0).abs() < most,
            "{celsius} C: {found} {exact}"
        );
    }
    let walther = Walther {
        viscosity_40: 48.0,
        viscosity_100: 8.0,
    };
    let exact = walther.at(20.0) * 1e-6 * 830.0;
    let found = f64::from(grease.at(kelvin(20.0)));
    assert!((found / exact - 1.0).abs() < 0.03, "{found} {exact}");
}

/// The default half-share speed is that of SKF's mixture of boundary and film friction on a pitch circle of 29 mm with the default grease at 20
/// degrees: within the rounding of its fourth digit. A film by Hamrock and Dowson has it within a factor of three: at 0.08 to 0.15 um of roughness.
#[test]
fn default_half_share_speed_is_of_skf_mixture() {
    let law = defaults::COEFFICIENT;
    let celsius = f64::from(law.reference_temperature) - ZERO;
    let viscosity = f64::from(law.viscosity.at(law.reference_temperature));
    let density = f64::from(defaults::STEERING_GREASE_DENSITY) * (1.0 - 6.5e-4 * (celsius - 15.0));
    let mixture = BearingMixture {
        mean_diameter: 29e-3,
        kinematic_viscosity: viscosity / density,
    };
    let speed = mixture.half_share_speed();
    let film = |roughness: f64| {
        let film = FilmContact {
            roughness,
            ..film()
        };
        film.half_share_speed(viscosity) / ENTRAINMENT
    };
    let films = [0.08e-6, 0.15e-6].map(film);
    assert!(
        (speed - f64::from(law.half_share_speed)).abs() < 5e-3,
        "{speed}"
    );
    assert!((mixture.boundary_share(speed) - 0.5).abs() < 1e-12);
    assert!(
        films
            .iter()
            .all(|film| *film > speed / 3.3 && *film < speed),
        "{films:?}"
    );
    // SKF's share and the law's, over the speed: as the default says of them.
    let differences = (1..=2000).map(|step| {
        let ratio = 0.01 * f64::from(step);
        mixture.boundary_share(ratio * speed) - 1.0 / (1.0 + ratio)
    });
    let (least, most) = differences.fold((0.0_f64, 0.0_f64), |(least, most), difference| {
        (least.min(difference), most.max(difference))
    });
    assert!(
        (least + 0.21).abs() < 5e-3 && (most - 0.11).abs() < 5e-3,
        "{least} {most}"
    );
}

/// NaN is standstill, or the warmest temperature; what lies beyond counts as the end. The half-share speed keeps its range.
#[test]
fn faulty_inputs() {
    let law = CoefficientLaw::new(&CoefficientParameters {
        churning: 1e-3,
        ..MINERAL
    })
    .unwrap();
    let now = law.at_temperature(293.15);
    let warmest = law.at_temperature(500.0);
    assert_eq!(law.at_temperature(f32::NAN), warmest);
    assert_eq!(law.at_temperature(-f32::NAN), warmest);
    assert_eq!(law.at_temperature(f32::INFINITY), warmest);
    let coldest = law.at_temperature(defaults::VISCOSITY.floor());
    for cold in [f32::NEG_INFINITY, -40.0, 0.0, 20.0, 200.0] {
        assert_eq!(law.at_temperature(cold), coldest);
    }
    for half_share_speed in [1e-3, 1e4] {
        let law = CoefficientLaw::new(&CoefficientParameters {
            half_share_speed,
            ..MINERAL
        })
        .unwrap();
        for temperature in [0.0, 250.0, 293.15, 400.0, 1e3] {
            let speed = law.at_temperature(temperature).half_share_speed();
            assert!(
                (9.999e-4..=1.0001e4).contains(&speed),
                "{temperature}: {speed}"
            );
        }
    }
    assert_eq!(now.at(f32::NAN), now.at(0.0));
    assert_eq!(now.at(f32::INFINITY), 0.05);
    assert_eq!(now.at(f32::NEG_INFINITY), 0.05);
    assert_eq!(now.churning_torque(f32::NAN), 0.0);
    assert_eq!(now.churning_torque(f32::INFINITY), now.churning_torque(1e6));
    assert_eq!(now.churning_torque(-3.0), -now.churning_torque(3.0));
    // Viscosity times the constant: b eta w. Measured: 7.7e-8.
    let exact = 1e-3 * f64::from(defaults::VISCOSITY.at(353.15)) * 7.0;
    let found = f64::from(law.at_temperature(353.15).churning_torque(7.0));
    assert!((found / exact - 1.0).abs() < 2.4e-7, "{found} {exact}");
}

#[test]
fn directions_differ() {
    let law = CoefficientLaw::new(&CoefficientParameters {
        forward: 1.25,
        backward: 0.5,
        ..MINERAL
    })
    .unwrap();
    let plain = CoefficientLaw::new(&MINERAL).unwrap();
    for speed in [0.0, 0.1, 3.0, 70.0] {
        let (now, alike) = (
            law.at_temperature(300.0),
            plain.at_temperature(300.0).at(speed),
        );
        let both = now.both(-speed);
        // Measured: 1.2e-7 and 0.0: roundings of two products and a sum on either side.
        assert!((both.forward / (1.25 * alike) - 1.0).abs() < 3e-7);
        assert!((both.backward / (0.5 * alike) - 1.0).abs() < 3e-7);
        assert_eq!(now.at(speed), both.forward);
        assert!(speed == 0.0 || now.at(-speed) == both.backward);
    }
}

/// Steepest at standstill, by differences of a hundredth of the half-share speed (which leave 1 %).
#[test]
fn the_slope_is_bounded() {
    let law = CoefficientLaw::new(&CoefficientParameters {
        boundary: 0.1,
        full_film: 0.05,
        half_share_speed: 5.0,
        ..MINERAL
    })
    .unwrap();
    let now = law.at_temperature(293.15);
    assert!((now.half_share_speed() - 5.0).abs() < 8e-6);
    let step = 0.05;
    let slopes = (0..400_u16).map(|n| {
        let speed = step * f32::from(n);
        (now.at(speed + step) - now.at(speed)) / step
    });
    let steepest = slopes.fold(0.0, f32::min);
    assert!(steepest >= now.steepest() && steepest < 0.98 * now.steepest());
    let rising = CoefficientLaw::new(&CoefficientParameters {
        boundary: 0.05,
        full_film: 0.1,
        ..MINERAL
    })
    .unwrap()
    .at_temperature(293.15);
    assert!(rising.steepest() > 0.0);
}

#[test]
fn errors_name_the_field() {
    const BAD: &[f32] = &[-1.0, 0.0, 2e5];
    #[rustfmt::skip]
    assert_refused(
        &MINERAL,
        CoefficientLaw::new,
        &[
            ("boundary", |p, v| p.boundary = v, BAD),
            ("full_film", |p, v| p.full_film = v, BAD),
            ("half_share_speed", |p, v| p.half_share_speed = v, BAD),
            // Degrees Celsius in the place of kelvins.
            ("reference_temperature", |p, v| p.reference_temperature = v, &[-1.0, 0.0, 2e5, 20.0]),
            ("forward", |p, v| p.forward = v, BAD),
            ("backward", |p, v| p.backward = v, BAD),
        ],
    );
    assert_refused_at(
        &MINERAL,
        CoefficientLaw::new,
        &[
            ("churning", |p, v| p.churning = v, &[-1.0]),
            // Ten times 0.12 is no coefficient.
            ("boundary", |p, v| p.forward = v, &[10.0]),
        ],
    );
    // Centistokes in the place of m²/s, swapped viscosities, degrees Celsius.
    let oil = OilData {
        kinematic_viscosity_40: 100e-6,
        kinematic_viscosity_100: 11e-6,
        density: 880.0,
        pour_point: 240.0,
    };
    #[rustfmt::skip]
    assert_refused_at(
        &oil,
        Viscosity::of_oil,
        &[
            ("kinematic_viscosity_100", |p, v| p.kinematic_viscosity_100 = v, &[11.0]),
            ("kinematic_viscosity_40", |p, v| p.kinematic_viscosity_40 = v, &[11e-6]),
            ("density", |p, v| p.density = v, &[0.88]),
            ("pour_point", |p, v| p.pour_point = v, &[-33.0]),
        ],
    );
    #[rustfmt::skip]
    assert_refused_at(
        &((313.15, 0.1), (373.15, 0.01), 230.0),
        |&(cold, warm, pour)| Viscosity::through(cold, warm, pour),
        &[
            ("temperature", |(cold, _, _), v| cold.0 = v, &[40.0, 373.15]),
            ("viscosity", |(cold, _, _), v| cold.1 = v, &[0.001]),
            ("viscosity", |(cold, warm, _), v| (*cold, *warm) = ((313.15, v), (323.15, 0.1)), &[3.3, 1e3]),
            ("pour_point", |(_, _, pour), v| *pour = v, &[330.0]),
        ],
    );
    assert_refused_at(
        &(300.0, 1.0, 1.0),
        |&(fallback, hold, fade)| TemperatureFade::new(fallback, hold, fade),
        &[
            ("fallback_temperature", |p, v| p.0 = v, &[20.0]),
            ("hold_time", |p, v| p.1 = v, &[-1.0]),
            ("fade_time", |p, v| p.2 = v, &[0.0]),
        ],
    );
}

/// The formula goes through both points wherever set-up takes them: temperatures 10 to 350 K apart, the ratio of the viscosities
/// from 1.5 to that of a pole 10 K below the colder one.
#[test]
fn viscosities_go_through_their_points() {
    let mut worst = 0.0_f64;
    for cold in [150.0_f32, 200.0, 313.15, 400.0, 490.0] {
        for apart in [10.0_f32, 20.0, 60.0, 150.0, 300.0, 320.0, 350.0] {
            let warm = cold + apart;
            if warm > 500.0 {
                continue;
            }
            let most = (1.0 + (warm - cold) / 10.0).powi(5);
            for step in 0..=50_u8 {
                // A millionth within the ends, which have roundings of their own.
                let part = (f32::from(step) / 50.0).clamp(1e-6, 1.0 - 1e-6);
                let ratio = 1.5 * (most / 1.5).powf(part);
                let (stiff, thin) = (1.2e-4 * ratio, 1.2e-4);
                let oil = Viscosity::through((cold, stiff), (warm, thin), 150.0).unwrap();
                for (temperature, viscosity) in [(cold, stiff), (warm, thin)] {
                    let error = f64::from(oil.at(temperature)) / f64::from(viscosity) - 1.0;
                    worst = worst.max(error.abs());
                }
                assert!(
                    f64::from(cold) - f64::from(oil.pole()) > 9.999,
                    "{cold} {warm} {ratio}: {}",
                    oil.pole()
                );
            }
        }
    }
    // Derived: 10 K from a pole below 512 K, which is rounded to 1.5e-5 K, five times over; twice that for the roundings of the rest.
    assert!(worst < 1.6e-5, "{worst:e}");
}

/// Fresh as it is, old the fallback, a straight line between; never outside of both.
#[test]
fn an_old_temperature_fades() {
    let fade = TemperatureFade::new(353.15, 2.0, 8.0).unwrap();
    for age in [f32::NEG_INFINITY, -1.0, 0.0, 1.0, 2.0] {
        assert_eq!(fade.at(280.0, age), 280.0);
    }
    for age in [10.0, 11.0, 1e9, f32::INFINITY, f32::NAN] {
        assert_eq!(fade.at(280.0, age), 353.15);
    }
    for reading in [f32::NAN, f32::INFINITY, 20.0, -40.0] {
        assert_eq!(fade.at(reading, 0.0), 353.15);
    }
    let mut last = 280.0;
    for step in 0..=100_u8 {
        let now = fade.at(280.0, 0.1 * f32::from(step));
        assert!(now >= last && now <= 353.15, "{now}");
        last = now;
    }
}
