//! Closed forms for a ball of a ball screw with a pinned third contact: orbital speed, spin, loads, compliance, losses.
//!
//! They follow from equations (3.65) to (3.76) of the dissertation where the friction across the track closes a light third contact which
//! stops the slip along the track there. Good to 1 per cent in the orbital speeds' differences and 5 per cent in the contact force while
//! the third contact is pinned (deviations that load it, up to 50 N per ball at a friction of 0.1).

use super::ball_screw_ball::ScrewTrack;
use super::contact_law::HertzLaw;
use super::linear_ball::EllipseLaw;
use super::patch::{Patch, PatchVelocity};
use crate::error::{ReferenceError, within};

/// Which contacts carry the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// Two contacts that roll.
    TwoPoint,
    /// The main pair, and a third contact on the other flank of the screw.
    ThirdOnScrew,
    /// The main pair, and a third contact on the other flank of the nut.
    ThirdOnNut,
}

impl Support {
    /// The third contact that closes in a groove without play.
    ///
    /// With the nut turning forward, the friction forces across the track push the ball to SL under an SR-NL load and to NL under an
    /// SL-NR load; backward, to the nut's and the screw's other flank.
    ///
    /// `axial_load` is the screw's force on the ball along z: positive for SL-NR.
    pub fn of(axial_load: f64, nut_speed: f64) -> Self {
        if (axial_load < 0.0) == (nut_speed > 0.0) {
            Self::ThirdOnScrew
        } else {
            Self::ThirdOnNut
        }
    }
}

/// Contact angles of main pair and third contact, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactAngles {
    /// Loaded contact on the screw.
    pub screw: f64,
    /// Loaded contact on the nut.
    pub nut: f64,
    /// Third contact; without meaning in two-point contact.
    pub third: f64,
}

/// Orbital speed over the nut's speed.
///
/// With `r = R_B R_P/(L/2 pi)^2`:
/// third on the screw: `(1 + r cos b_N)/(1 + cos(b_N - (b_S - b_3)/2)/cos((b_S + b_3)/2))`;
/// third on the nut: `(C + r cos b_S)/(1 + C)`, `C = cos(b_S - (b_N - b_3)/2)/cos((b_N + b_3)/2)`;
/// two-point: `(1 + r cos((b_S + b_N)/2))/2`.
pub fn speed_ratio(track: &ScrewTrack, support: Support, angles: ContactAngles) -> f64 {
    let path = track.path_radius();
    let r = track.ball_radius * track.pitch_radius / (path * path);
    let ContactAngles { screw, nut, third } = angles;
    match support {
        Support::TwoPoint => 0.5 * (1.0 + r * (0.5 * (screw + nut)).cos()),
        Support::ThirdOnScrew => {
            let c = (nut - 0.5 * (screw - third)).cos() / (0.5 * (screw + third)).cos();
            (1.0 + r * nut.cos()) / (1.0 + c)
        }
        Support::ThirdOnNut => {
            let c = (screw - 0.5 * (nut - third)).cos() / (0.5 * (nut + third)).cos();
            (c + r * screw.cos()) / (1.0 + c)
        }
    }
}

/// A ball carried by two main contacts and a pinned third one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreePointBall {
    /// Orbital speed, rad/s.
    pub orbital_speed: f64,
    /// Spin about z in space, rad/s.
    pub spin: f64,
    /// Load of each main contact, N.
    pub main_load: f64,
    /// Load of the third contact, N.
    pub third_load: f64,
    /// Speed along the track lost per newton of ball-to-ball force, m/(s N).
    pub compliance: f64,
    /// Power lost in the two main contacts, W.
    pub main_loss: f64,
    /// Power lost in the third contact, W.
    pub third_loss: f64,
}

impl ThreePointBall {
    /// Power lost in the grooves, W.
    pub fn groove_loss(&self) -> f64 {
        self.main_loss + self.third_loss
    }
}

/// Contact laws and friction of a ball in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreePointModel {
    /// Track.
    pub track: ScrewTrack,
    /// Contact law on the screw.
    pub screw: HertzLaw,
    /// Contact law on the nut.
    pub nut: HertzLaw,
    /// Friction coefficient of the grooves.
    pub friction: f64,
    /// Nominal contact angle of loads and spins, rad.
    pub contact_angle: f64,
}

impl ThreePointModel {
    /// Speed, loads, compliance and loss of a ball.
    ///
    /// The slip across the track is `V_1 = R_B w_N sin a/2` in each main contact. The third contact does not slip along the track,
    /// which gives the ball's spin: `Om_z = w_B L/(2 pi R_B cos b)` with that contact on the screw, and the mirror image on the nut.
    /// Loads:
    /// `N = F/(sin b cos a)/(1 - phi mu)`, `N_3 = 2 phi mu N` with `phi` the mean of the two main contacts' share of sliding
    /// friction. Compliance: `Y = (1/kappa_S + 1/kappa_N)/4` with `kappa` the slope of the friction force along the track by the slip.
    /// `phi`, `kappa` and the loss come from the exact integrals of [`Patch::friction`].
    pub fn ball(
        &self,
        support: Support,
        angles: ContactAngles,
        axial_load: f64,
        nut_speed: f64,
    ) -> Result<ThreePointBall, ReferenceError> {
        self.track.check()?;
        let mu = within("friction", self.friction, 1e-6, 0.5)?;
        let load = within("axial_load", axial_load.abs(), 1e-9, 1e9)?;
        within("nut_speed", nut_speed, -1e6, 1e6)?;
        let angle = within("contact_angle", self.contact_angle, 0.05, 1.5)?;
        for value in [angles.screw, angles.nut, angles.third] {
            within("angles", value, 0.05, 1.5)?;
        }
        if nut_speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        if support == Support::TwoPoint {
            return Err(ReferenceError::Undriven);
        }
        let track = &self.track;
        let (sin_a, cos_a) = track.lead_angle();
        let (sin_b, cos_b) = angle.sin_cos();
        let (r, path) = (track.ball_radius, track.path_radius());
        let orbital_speed = speed_ratio(track, support, angles) * nut_speed;
        let across = 0.5 * r * nut_speed * sin_a;
        let spin = match support {
            Support::ThirdOnNut => {
                nut_speed * cos_a + (nut_speed - orbital_speed) * path / (r * cos_b)
            }
            _ => orbital_speed * path / (r * cos_b),
        };
        let spins = [spin * sin_b, (spin - nut_speed * cos_a) * sin_b];
        let contact = |ellipse: EllipseLaw, normal: f64, slip: f64, spin: f64| {
            let a = ellipse.semi_major_constant * normal.cbrt();
            let patch = Patch {
                semi_major: a,
                semi_minor: a * ellipse.axis_ratio,
                friction_limit: mu * normal,
            };
            patch.friction(PatchVelocity {
                slip_major: slip,
                slip_minor: 0.0,
                spin,
            })
        };
        let ellipses = [self.screw.ellipse, self.nut.ellipse];
        let mut share = 0.5;
        let mut main_load = load / (sin_b * cos_a);
        for _ in 0..60 {
            main_load = load / (sin_b * cos_a) / (1.0 - share * mu);
            let next = ellipses
                .iter()
                .zip(spins)
                .map(|(ellipse, spin)| {
                    contact(*ellipse, main_load, across, spin).gradient[0].abs() / (mu * main_load)
                })
                .sum::<f64>()
                / 2.0;
            let change = (next - share).abs();
            share = next;
            if change < 1e-14 {
                break;
            }
        }
        let main = [0, 1].map(|i| contact(ellipses[i], main_load, across, spins[i]));
        let third_load = 2.0 * share * mu * main_load;
        let third = match support {
            Support::ThirdOnNut => contact(ellipses[1], third_load, across, spins[1]),
            _ => contact(ellipses[0], third_load, across, spins[0]),
        };
        Ok(ThreePointBall {
            orbital_speed,
            spin,
            main_load,
            third_load,
            compliance: main.iter().map(|c| 0.25 / c.hessian[1][1]).sum(),
            main_loss: main[0].power + main[1].power,
            third_loss: third.power,
        })
    }

    /// Force between two balls that touch, the first behind: `max(0, (v_1 - v_2)/(Y_1 + Y_2))`, `v = w_B L/2 pi`; speeds counted in the direction of orbiting.
    pub fn contact_force(&self, rear: &ThreePointBall, front: &ThreePointBall) -> f64 {
        let difference = (rear.orbital_speed - front.orbital_speed) * rear.orbital_speed.signum();
        (difference * self.track.path_radius() / (rear.compliance + front.compliance)).max(0.0)
    }
}
