//! Friction of a contact that slips in any direction and spins, against quadrature.

use epas_friction::SlipMap;
use epas_reference::friction::patch::{Patch, PatchVelocity};

struct Worst {
    name: &'static str,
    bound: f64,
    max: f64,
    sum: f64,
    square: f64,
    count: f64,
}

impl Worst {
    fn of(name: &'static str, bound: f64) -> Self {
        Self {
            name,
            bound,
            max: 0.0,
            sum: 0.0,
            square: 0.0,
            count: 0.0,
        }
    }
    fn add(&mut self, error: f64, case: &str) {
        let _ = case;
        self.max = self.max.max(error.abs());
        self.sum += error;
        self.square += error * error;
        self.count += 1.0;
    }
}

impl Drop for Worst {
    fn drop(&mut self) {
        println!(
            "{}: max {:.1e} rms {:.1e} mean {:+.1e} of {}",
            self.name,
            self.max,
            (self.square / self.count).sqrt(),
            self.sum / self.count,
            self.count
        );
    }
}

#[test]
fn forces_moment_and_hessian_are_those_of_the_contact_integral() {
    for k in [0.02_f32, 0.05, 0.1, 0.2321, 0.35, 0.5, 0.8, 0.95] {
        println!("k {k}");
        let mut power = Worst::of("power", 1.0);
        let mut force = Worst::of("force", 1.0);
        let mut moment = Worst::of("moment", 1.0);
        let mut stiffness = Worst::of("stiffness", 10.0);
        let map = SlipMap::new(k).unwrap();
        let patch = Patch {
            semi_major: 1.0,
            semi_minor: f64::from(k),
            friction_limit: 1.0,
        };
        for i in 0..=80 {
            // Distances of the velocity centre from 1e-4 to 1e4 semi-major axes.
            let distance = 10f64.powf(-4.0 + 0.1 * f64::from(i));
            for j in 0..=12 {
                let angle = std::f64::consts::TAU * f64::from(j) / 48.0;
                for spin in [1.0_f64, -2.0] {
                    let (z, x) = (distance * angle.sin() * 1.0, distance * angle.cos() * 1.0);
                    let (across, along, w) = (z as f32, x as f32, spin as f32);
                    let case = format!("axis ratio {k}, slip {across:e} {along:e}, spin {w}");
                    let exact = patch.friction(PatchVelocity {
                        slip_major: f64::from(across),
                        slip_minor: f64::from(along),
                        spin: f64::from(w),
                    });
                    let fast = map.dissipation(across, along, w, 1.0, 0.0);
                    power.add(f64::from(fast.power) / exact.power - 1.0, &case);
                    force.add(f64::from(fast.across) - exact.gradient[0], &case);
                    force.add(f64::from(fast.along) - exact.gradient[1], &case);
                    moment.add(f64::from(fast.moment) - exact.gradient[2], &case);
                    let size = exact.hessian[0][0] + exact.hessian[1][1];
                    stiffness.add(
                        (f64::from(fast.stiffness_across) - exact.hessian[0][0]) / size,
                        &case,
                    );
                    stiffness.add(
                        (f64::from(fast.stiffness_along) - exact.hessian[1][1]) / size,
                        &case,
                    );
                    stiffness.add(
                        (f64::from(fast.stiffness_mixed) - exact.hessian[0][1]) / size,
                        &case,
                    );
                    let tilt = -(f64::from(fast.stiffness_across) * f64::from(fast.tilt_across)
                        + f64::from(fast.stiffness_mixed) * f64::from(fast.tilt_along));
                    stiffness.add(
                        (tilt - exact.hessian[0][2]) / (size * (1.0 + distance)),
                        &case,
                    );
                }
            }
        }
    }
}
