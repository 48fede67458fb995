//! Friction of a contact that slips in any direction and spins, against quadrature.

use crate::kit::errors::Errors;
use epas_friction::contact::SlipMap;
use epas_reference::friction::patch::{Patch, PatchFriction, PatchVelocity};
use std::f64::consts::TAU;

/// Patches with semi-major axis and friction one; slips over the spin from 1e-4 to 1e4 semi-major axes.
fn sweep(axis_ratio: f32, mut check: impl FnMut([f32; 3], &PatchFriction, &str)) {
    let patch = Patch {
        semi_major: 1.0,
        semi_minor: f64::from(axis_ratio),
        friction_limit: 1.0,
    };
    for distance in (0..=80).map(|i| 10_f64.powf(-4.0 + 0.1 * f64::from(i))) {
        for angle in (0..12).map(|j| TAU * f64::from(j) / 44.0) {
            for (spin, turn) in [(1.0_f32, 1.0), (-2.0, -1.0)] {
                let across = (turn * distance * angle.sin()) as f32;
                let along = (distance * angle.cos()) as f32;
                let exact = patch.friction(PatchVelocity {
                    slip_major: f64::from(across),
                    slip_minor: f64::from(along),
                    spin: f64::from(spin),
                });
                let case = format!(
                    "axis ratio {axis_ratio}, slip {across:e} across {along:e} along, spin {spin}"
                );
                check([across, along, spin], &exact, &case);
            }
        }
    }
}

#[test]
fn forces_moment_power_and_stiffness_are_those_of_the_contact_integral() {
    let mut power = Errors::of("slip map, power, relative");
    let mut force = Errors::of("slip map, force over its limit");
    let mut moment = Errors::of("slip map, moment over that of sliding at the semi-major axis");
    let mut stiffness = Errors::of("slip map, stiffness over the sum of both");
    for axis_ratio in [0.05_f32, 0.1, 0.2321, 0.35, 0.5, 0.8, 0.95] {
        let map = SlipMap::new(axis_ratio).unwrap();
        sweep(axis_ratio, |[across, along, spin], exact, case| {
            let fast = map.dissipation(across, along, spin, 1.0, 0.0);
            power.add_at(f64::from(fast.power) / exact.power - 1.0, case);
            power.add_at(f64::from(fast.potential) / exact.power - 1.0, case);
            let [by_across, by_along, by_spin] = exact.gradient;
            force.add_at(f64::from(fast.across) - by_across, case);
            force.add_at(f64::from(fast.along) - by_along, case);
            moment.add_at(f64::from(fast.moment) - by_spin, case);

            let exact = &exact.hessian;
            let size = exact[0][0] + exact[1][1];
            for (fast, exact) in [
                (fast.stiffness_across, exact[0][0]),
                (fast.stiffness_mixed, exact[0][1]),
                (fast.stiffness_along, exact[1][1]),
            ] {
                stiffness.add_at((f64::from(fast) - exact) / size, case);
            }
            // The column of the spin follows from the tilts.
            let distance = 1.0 + f64::from(across.hypot(along) / spin.abs());
            let (first, second) = (f64::from(fast.tilt_across), f64::from(fast.tilt_along));
            let by_spin = -f64::from(fast.stiffness_across) * first
                - f64::from(fast.stiffness_mixed) * second;
            stiffness.add_at((by_spin - exact[0][2]) / (size * distance), case);
        });
    }
    for errors in [power, force, moment, stiffness] {
        errors.assert_measured();
    }
}

/// Forces are the slopes of the potential, with the stick treatment too: one convex function.
#[test]
fn forces_are_slopes_of_the_potential() {
    let map = SlipMap::new(0.25).unwrap();
    let stick = 0.3;
    for spin in [0.0_f32, 0.1, 1.0] {
        for distance in [0.05_f32, 0.2, 0.7, 1.4, 3.0] {
            for angle in [0.1_f32, 0.6, 1.2] {
                let (across, along) = (distance * angle.sin(), distance * angle.cos());
                let at = |x: f32, z: f32, w: f32| {
                    f64::from(map.dissipation(z, x, w, 1.0, stick).potential)
                };
                let here = map.dissipation(across, along, spin, 1.0, stick);
                // Rounding of the potential (3e-7) over the step, 6e-5, and a sixth of the third derivative times the step's
                // square. Measured: 3.1e-4.
                let step = 0.005_f32;
                let width = 2.0 * f64::from(step);
                let slopes = [
                    (
                        here.across,
                        at(along, across + step, spin) - at(along, across - step, spin),
                    ),
                    (
                        here.along,
                        at(along + step, across, spin) - at(along - step, across, spin),
                    ),
                    (
                        here.moment,
                        at(along, across, spin + step) - at(along, across, spin - step),
                    ),
                ];
                for (given, difference) in slopes {
                    assert!(
                        (f64::from(given) - difference / width).abs() < 7e-4,
                        "{across} {along} {spin}: {given} {}",
                        difference / width
                    );
                }
            }
        }
    }
}

/// A contact that hardly spins slides: its friction goes against its slip, however far away that is.
#[test]
fn friction_of_a_far_slip_keeps_its_direction() {
    let map = SlipMap::new(0.3).unwrap();
    let at = |across: f32, along: f32| {
        let friction = map.dissipation(across, along, 1.0, 1.0, 0.0);
        [friction.across, friction.along]
    };
    for distance in [2e3, 1e5, 1e8, 1e18, 1e30] {
        for (across, along) in [(0.6, 0.8), (-0.8, 0.6), (0.0, -1.0), (1.0, 0.0)] {
            let found = at(distance * across, distance * along);
            // The next term of the series is 1/distance², 3e-7; three roundings.
            for (found, direction) in found.into_iter().zip([across, along]) {
                assert!(
                    (found - direction).abs() < 1e-6,
                    "{across} {along} {distance}: {found}"
                );
            }
        }
    }
    // Without bound along, and what is no number as if it slid across.
    let infinite = f32::INFINITY;
    for (across, along, direction) in [
        (5.0, infinite, [0.0, 1.0]),
        (5.0, -infinite, [0.0, -1.0]),
        (-infinite, 5.0, [-1.0, 0.0]),
        (f32::NAN, f32::NAN, [1.0, 0.0]),
    ] {
        assert_eq!(at(across, along), direction, "{across} {along}");
    }
}

/// Every slip and spin, rest and infinity among them, gives finite friction within its limit.
#[test]
fn hostile_slips_and_spins() {
    let odd = [0.0, -0.0, 1e-30, 1.0, -1e6, 1e15, f32::INFINITY, f32::NAN];
    for axis_ratio in [0.02, 0.2, 0.95] {
        let map = SlipMap::new(axis_ratio).unwrap();
        for across in odd {
            for along in odd {
                for spin in [0.0, -1e-20, 1.0, 1e10] {
                    let at = map.dissipation(across, along, spin, 1e-3, 0.01);
                    assert!(
                        at.across.abs() < 1.01 && at.along.abs() < 1.01 && at.moment.is_finite(),
                        "{across} {along} {spin}: {at:?}"
                    );
                }
            }
        }
    }
    for axis_ratio in [0.0, 0.019, 0.96, f32::NAN] {
        let error = SlipMap::new(axis_ratio).unwrap_err();
        assert_eq!(error.field(), "axis_ratio");
    }
}
