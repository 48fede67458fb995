//! Efficiency: the crate's closed forms against the reference.

use epas_friction::efficiency::EfficiencyGeometry;
use epas_reference::efficiency::Screw;

use super::statistics::{Errors, evenly};
use epas_page::failure::Failure;

/// Ball radius over pitch radius of the screw of Lin, Velinsky, Ravani 1994.
const BALL_RATIO: f64 = 4.37 / 24.3;

/// Errors in f32 over friction 0.001 to 0.3, lead angles 1 to 60 and contact angles 10 to 80 degrees:
/// rolling (3), sliding (14) and the loss of (14) relative to itself.
pub fn form_errors(quick: bool) -> Result<[Errors; 3], Failure> {
    let steps = if quick { 12 } else { 40 };
    let mut errors = [Errors::default(); 3];
    for lead in evenly(1.0, 60.0, steps) {
        for contact in evenly(10.0, 80.0, steps) {
            let [lead, contact] = [lead, contact].map(|degrees| degrees.to_radians() as f32);
            let fast = EfficiencyGeometry::new(lead, contact, BALL_RATIO as f32)?;
            for friction in evenly(0.001, 0.3, steps) {
                let f = friction as f32;
                let exact = Screw {
                    lead_angle: f64::from(lead),
                    contact_angle: f64::from(contact),
                    friction: f64::from(f),
                    ball_ratio: f64::from(fast.ball_ratio()),
                    rolling_tangent: 0.0,
                };
                if exact.sliding_drive() > 0.0 && exact.rolling_screw() > 0.0 {
                    errors[0]
                        .add(f64::from(fast.rolling_efficiency(f, 0.0)) - exact.rolling_screw());
                    errors[1].add(f64::from(fast.sliding_efficiency(f)) - exact.sliding_drive());
                    errors[2].add(f64::from(fast.sliding_loss(f)) / exact.loss_drive() - 1.0);
                }
            }
        }
    }
    Ok(errors)
}
