//! The four-force start: a motion from one linear problem.

use super::ball::FourPointBall;
use super::contacts::FourPointContacts;
use super::motion::{BallMotion, BallState};
use crate::refined::symmetric::{System, Vector};

/// Below this ratio of the weaker to the stronger diagonal's load, the start also tries two-point
/// rolling. The switch itself lies below 0.06 for contact angle deviations up to 3 degrees: from 0.04 to 0.5 all
/// results are the same, at 0.02 the start is off by 3.9e-2.
const WEAK_DIAGONAL: f32 = 0.1;

impl FourPointBall {
    /// Motion from a linear problem: the four-force start.
    ///
    /// The least `sum a_i² V_i²`: friction forces linear in the slip, each contact with its exact angle
    /// and its own load (Lin 2019, eqs. (3.37), (3.38) and (3.41), without the approximations that follow them;
    /// `a²` stands for `F^(2/3)`). **Corrected:** in (3.41) the numerator and the first term of the denominator are the sine of
    /// `beta_BL + eta_BL + beta_BR + eta_BR`. Where one diagonal carries less than a tenth of the other, the two
    /// states in which the stronger diagonal rolls without slip and one of its contacts without spin are
    /// tried as well, and the least dissipation wins.
    ///
    /// Largest error of the speed deviation for side-force ratios up to 0.8 and contact angle deviations
    /// up to 3 degrees: 5.6e-3 of `v/2`. Cost: 1070 modelled cycles, 3700 with a weak diagonal.
    #[must_use]
    pub fn start(&self, contacts: &FourPointContacts) -> BallState {
        let slip_weights = contacts.contact.map(|contact| {
            if contact.friction > 0.0 {
                contact.semi_major * contact.semi_major
            } else {
                0.0
            }
        });
        let mut best = least_squares(contacts, &slip_weights, &[0.0; 4]);
        let [bottom_left, bottom_right, top_right, top_left] =
            contacts.contact.map(|contact| contact.friction);
        let up = bottom_left + top_right;
        let down = bottom_right + top_left;
        let (weak, strong, rolling) = if up < down {
            (up, down, [0.0, 1.0, 0.0, 1.0])
        } else {
            (down, up, [1.0, 0.0, 1.0, 0.0])
        };
        if weak < WEAK_DIAGONAL * strong {
            let [left, right, _, _] = rolling;
            let (mut least, _) = self.dissipation(contacts, best);
            for spinless in [[left, right, 0.0, 0.0], [0.0, 0.0, left, right]] {
                let candidate = least_squares(contacts, &rolling, &spinless);
                let (dissipation, _) = self.dissipation(contacts, candidate);
                if dissipation < least {
                    least = dissipation;
                    best = candidate;
                }
            }
        }
        let (_, power) = self.dissipation(contacts, best);
        BallState {
            motion: best,
            speed_deviation: self.speed_deviation(best.speed),
            compliance: 0.0,
            friction_force: power,
        }
    }
}

/// The motion with the least sum of weighted squares of slip and spin.
fn least_squares(
    contacts: &FourPointContacts,
    slip_weights: &[f32; 4],
    spin_weights: &[f32; 4],
) -> BallMotion {
    let mut system = System::EMPTY;
    let weights = slip_weights.iter().zip(spin_weights);
    for (contact, (&slip_weight, &spin_weight)) in contacts.contact.iter().zip(weights) {
        let (roll, yaw) = contact.arm;
        let (slip, spin) = (slip_weight * contact.slip, spin_weight * contact.spin);
        system.right.roll -= slip * roll + spin * yaw;
        system.right.yaw -= slip * yaw - spin * roll;
        system.right.speed -= slip;
        system.add_slip(slip_weight, roll, yaw);
        system.add_spin(spin_weight, yaw, -roll);
    }
    let Vector { roll, yaw, speed } = system.factors().solve(system.right);
    BallMotion { speed, roll, yaw }
}
