//! Mean slip of a contact ellipse as a sum over lines: the blend between the two limits of a line.

use std::f64::consts::{FRAC_PI_2, PI};

use epas_friction::fits::friction_power::{BLEND, KINK, LINES};

/// Lines of the exact mean and points of each: within 1e-4 at the kink where the slip vanishes.
const POINTS: usize = 160;

/// A slip field `(along - y, across + x)` over an ellipse with the semi-axes `ratio` along x and 1 along y: spin 1.
struct Field {
    along: f64,
    across: f64,
    ratio: f64,
}

impl Field {
    /// Mean sliding speed under Hertz' pressure, by the midpoint rule in the angle along each line and in `y`.
    fn exact(&self) -> f64 {
        let mut sum = 0.0;
        for line in 0..POINTS {
            let y = 2.0 * (line as f64 + 0.5) / POINTS as f64 - 1.0;
            let reach = self.ratio * (1.0 - y * y).sqrt();
            let mut mean = 0.0;
            for point in 0..POINTS {
                let angle = PI * ((point as f64 + 0.5) / POINTS as f64 - 0.5);
                let x = reach * angle.sin();
                mean += angle.cos().powi(2) * (self.along - y).hypot(self.across + x);
            }
            sum += (1.0 - y * y) * mean;
        }
        3.0 * sum / (POINTS * POINTS) as f64
    }

    /// The formula of `FrictionPower`, with the blend to be chosen.
    fn formula(&self, blend: f64) -> f64 {
        let mut sum = 0.0;
        for (node, weight) in LINES {
            for y in [f64::from(node), -f64::from(node)] {
                let along = (self.along - y).powi(2);
                let middle = along + self.across * self.across;
                let rim = self.ratio * self.ratio * (1.0 - y * y);
                let blended = blend * rim;
                let shift = rim * (blended * f64::from(KINK) + 0.25 * along) / (blended + middle);
                sum += f64::from(weight) * (middle + shift).sqrt();
            }
        }
        sum
    }
}

/// The formula meets both limits with any blend; in between its error goes from one sign to the other as the blend
/// grows.
#[test]
fn the_blend_has_about_the_least_largest_error() {
    let mut fields = Vec::new();
    for ratio in [0.05, 0.1, 0.2, 0.4, 0.7, 1.0] {
        for direction in 0..=8 {
            let (across, along) = (FRAC_PI_2 * f64::from(direction) / 8.0).sin_cos();
            for size in 0..=24 {
                let slip = 10.0_f64.powf(f64::from(size) / 8.0 - 2.0);
                let field = Field {
                    along: slip * along,
                    across: slip * across,
                    ratio,
                };
                fields.push((field.exact(), field));
            }
        }
    }
    let worst = |blend| {
        let error = |(exact, field): &(f64, Field)| (field.formula(blend) / exact - 1.0).abs();
        fields.iter().map(error).fold(0.0, f64::max)
    };
    let stored = worst(f64::from(BLEND));
    let scan = [0.1, 0.2, 0.25, 0.35, 0.4, 0.6].map(worst);
    println!("{BLEND}: {stored:.4}; 0.1, 0.2, 0.25, 0.35, 0.4, 0.6: {scan:.4?}");
    let [narrow, flat @ ..] = scan;
    // Measured: 2.2 % from 0.2 to 0.6, 3.7 % at 0.1.
    assert!(stored < 0.023 && narrow > 1.5 * stored);
    for other in flat {
        assert!(stored < 1.01 * other);
    }
}
