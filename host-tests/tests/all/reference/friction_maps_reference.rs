//! Force, moment and power of one contact: three evaluations of the same integrals, and the laws they obey.

use super::area::friction_over_area;
use epas_reference::friction::maps::FrictionMap;
use epas_reference::friction::patch::{Patch, PatchVelocity};
use epas_testkit::golden::{file as golden, list_of as list};
use epas_testkit::measured;
use epas_testkit::random::Random;

/// The stored maps were computed with 30 digits; what remains is the rounding of a few hundred terms here.
#[test]
fn maps_agree_with_high_precision_values() {
    for case in golden("friction")["maps"].as_array().unwrap() {
        let k = case["k"].as_f64().unwrap();
        let map = FrictionMap::new(k).unwrap();
        let near = |name: &str, x: f64, error: f64| {
            let case = format_args!("k = {k}, offset = {x}");
            measured::assert_at(&format!("friction maps, {name}"), error, case);
        };
        for (name, value) in ["p0", "p2", "p4"].into_iter().zip(map.coefficients()) {
            near("coefficients", 0.0, value - case[name].as_f64().unwrap());
        }
        let columns = ["kappa", "f", "M", "P", "df"].map(|name| list(&case[name]));
        for (i, &x) in columns[0].iter().enumerate() {
            let here = map.at(x);
            let mirrored = map.at(-x);
            assert_eq!(here.force, -mirrored.force);
            assert_eq!(here.power, mirrored.power);
            for (name, value, stored) in [
                ("force", here.force, columns[1][i]),
                ("moment", here.moment, columns[2][i]),
                ("power", here.power, columns[3][i]),
                ("slope", here.slope, columns[4][i]),
            ] {
                near(name, x, (value - stored) / (1.0 + x));
            }
        }
    }
}

#[test]
fn area_quadrature_confirms_the_general_reduction() {
    let patch = Patch {
        semi_major: 0.26e-3,
        semi_minor: 0.055e-3,
        friction_limit: 3.6,
    };
    let (a, b) = (patch.semi_major, patch.semi_minor);
    for (e, angle) in [
        (0.0, 0.0),
        (0.3, 0.7),
        (0.8, 2.1),
        (0.99, 1.2),
        (1.0, 0.4),
        (1.02, 2.5),
        (1.7, 1.0),
        (30.0, 0.2),
    ] {
        for spin in [4.0, -4.0] {
            let (x, y): (f64, f64) = (e * f64::cos(angle) * a, e * f64::sin(angle) * b);
            let velocity = PatchVelocity {
                slip_major: spin * y,
                slip_minor: -spin * x,
                spin,
            };
            let (power, gradient) = friction_over_area(&patch, velocity);
            let exact = patch.friction(velocity);
            let near = |what: &str, error: f64| {
                let case = format_args!("e = {e}, angle = {angle}, spin = {spin}: {what}");
                measured::assert_at("area quadrature, any direction", error, case);
            };
            let limit = patch.friction_limit;
            for (i, scale) in [limit, limit, limit * a].into_iter().enumerate() {
                near("friction", (gradient[i] - exact.gradient[i]) / scale);
            }
            near(
                "power",
                (power - exact.power) / (limit * a * 4.0 * (1.0 + e)),
            );
        }
    }
}

#[test]
fn reduction_and_maps_agree_where_both_hold() {
    for k in [0.1, 0.25, 0.5, 1.0] {
        let map = FrictionMap::new(k).unwrap();
        let patch = Patch {
            semi_major: 2.0,
            semi_minor: 2.0 * k,
            friction_limit: 3.0,
        };
        for exponent in -12..=24 {
            let x = 10_f64.powf(0.25 * f64::from(exponent));
            let value = map.at(x);
            let exact = patch.friction(PatchVelocity {
                slip_major: 0.0,
                slip_minor: x * 5.0 * 2.0,
                spin: 5.0,
            });
            let errors = [
                exact.gradient[1] / 3.0 - value.force,
                exact.gradient[2] / 6.0 - value.moment,
                (exact.power / (6.0 * 5.0) - value.power) / (1.0 + x),
                exact.gradient[0] / 3.0,
            ];
            for error in errors {
                let case = format_args!("k = {k}, offset = {x}: {errors:?}");
                measured::assert_at("reduction and maps", error, case);
            }
        }
    }
}

#[test]
fn stored_friction_of_the_ball_screw_contact() {
    // Stored with 12 digits from a 48-point rule; mm, N, rad/s. [N, a, b, mu, V1, V2, w] -> [f1, f2, M, P]
    for case in golden("ballscrew")["friction"].as_array().unwrap() {
        let args = list(&case["args"]);
        let out = list(&case["out"]);
        let patch = Patch {
            semi_major: args[1],
            semi_minor: args[2],
            friction_limit: args[0] * args[3],
        };
        let velocity = PatchVelocity {
            slip_major: args[4],
            slip_minor: args[5],
            spin: args[6],
        };
        let here = patch.friction(velocity);
        let [major, minor, moment] = here.gradient;
        let values = [-major, -minor, -moment, here.power];
        for (value, stored) in values.iter().zip(&out) {
            let case = format_args!("{args:?}: {values:?}, stored {out:?}");
            measured::assert_at("friction of the contacts of a screw", value - stored, case);
        }
    }
}

/// Energy: the power is minus force times slip minus moment times spin (degree one), and is never negative.
/// Convexity: the Hessian is that of the gradient (finite differences), has no negative eigenvalue, and vanishes along the velocity.
#[test]
fn power_is_convex_and_homogeneous() {
    let patch = Patch {
        semi_major: 0.3e-3,
        semi_minor: 0.08e-3,
        friction_limit: 5.0,
    };
    let a = patch.semi_major;
    let mut random = Random(1);
    for _ in 0..200 {
        let scale = 10_f64.powf(2.0 * random.signed());
        let v = [
            scale * a * random.signed(),
            scale * a * random.signed(),
            random.signed(),
        ];
        let velocity = |v: [f64; 3]| PatchVelocity {
            slip_major: v[0],
            slip_minor: v[1],
            spin: v[2],
        };
        let here = patch.friction(velocity(v));
        let energy: f64 = here.gradient.iter().zip(v).map(|(f, v)| f * v).sum();
        assert!(here.power > 0.0);
        let near = |name: &str, error: f64| measured::assert_at(name, error, format_args!("{v:?}"));
        near("power of a contact, homogeneous", energy / here.power - 1.0);
        let lengths = [1.0, 1.0, 1.0 / a];
        let speed = v[0].hypot(v[1]).hypot(a * v[2]);
        for i in 0..3 {
            let along: f64 = here.hessian[i].iter().zip(v).map(|(h, v)| h * v).sum();
            let along = along * lengths[i] / patch.friction_limit;
            near("Hessian of a contact along its velocity", along);
            for j in 0..3 {
                let step = 1e-5 * speed * lengths[j];
                let (mut up, mut down) = (v, v);
                up[j] += step;
                down[j] -= step;
                let slope = (patch.friction(velocity(up)).gradient[i]
                    - patch.friction(velocity(down)).gradient[i])
                    / (2.0 * step);
                let error = (slope - here.hessian[i][j]).abs() * lengths[i] * lengths[j] * speed
                    / patch.friction_limit;
                near("Hessian of a contact by differences", error);
            }
        }
        let h = nalgebra::Matrix3::from_fn(|i, j| here.hessian[i][j] * lengths[i] * lengths[j]);
        let eigen = h.symmetric_eigenvalues();
        assert!(eigen.min() > -2e-15 * eigen.max(), "{v:?}: {eigen}");
    }
}

#[test]
fn limits_and_bad_input_of_the_maps() {
    for axis_ratio in [0.0, 1.1, f64::NAN] {
        assert!(FrictionMap::new(axis_ratio).is_err(), "{axis_ratio}");
    }
    let map = FrictionMap::new(0.25).unwrap();
    let sliding = map.at(f64::INFINITY);
    assert_eq!((sliding.force, sliding.moment), (1.0, 0.0));
    assert!(map.at(f64::NAN).force.is_nan());
    // Far away: force 1 - q/x^2, moment 2 q/x with q = k^2/10, next terms of order x^-4 and x^-3.
    let (x, q) = (1e4, 0.00625);
    assert!((map.at(x).moment * x / (2.0 * q) - 1.0).abs() < 1e-8);
    // A difference of 6e-11 from one is known to 1.1e-16 of one, twice: 4e-6 at worst.
    assert!(((1.0 - map.at(x).force) * x * x / q - 1.0).abs() < 1e-6);
    // The slope stays continuous where the closed form takes over, and the circle is the limit of the ellipse.
    // A slope below one times 1e-12.
    assert!((map.at(1.0).force - map.at(1.0 + 1e-12).force).abs() < 1e-12);
    let [circle, near] = [1.0, 1.0 - 1e-9].map(|axis_ratio| FrictionMap::new(axis_ratio).unwrap());
    for x in [0.0, 0.5, 1.5, 10.0] {
        // Measured: 1.3e-10, an eighth of what the axis ratios differ by.
        assert!((circle.at(x).force - near.at(x).force).abs() < 2e-10);
    }
    // Circle: kf = 3 pi/8 and k3 = 3 pi/32. Measured: 0.0; a unit of the last place is 2.2e-16.
    assert!((circle.initial_slope() - 0.375 * std::f64::consts::PI).abs() < 7e-16);
    let friction = |friction_limit, slip_major, slip_minor| {
        let patch = Patch {
            semi_major: 1.0,
            semi_minor: 0.3,
            friction_limit,
        };
        patch.friction(PatchVelocity {
            slip_major,
            slip_minor,
            spin: 0.0,
        })
    };
    let rest = friction(1.0, 0.0, 0.0);
    assert_eq!((rest.power, rest.gradient), (0.0, [0.0; 3]));
    assert_eq!(friction(0.0, 1.0, 0.0).power, 0.0);
    let sliding = friction(2.0, 3.0, -4.0);
    assert!(
        (sliding.power - 10.0).abs() < 1e-14 && (sliding.gradient[1] + 1.6).abs() < 1e-14,
        "{sliding:?}"
    );
}
