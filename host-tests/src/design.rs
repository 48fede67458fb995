//! Designs by the numbers on their drawings, and the Hertzian contacts that follow from them: groove surface, principal curvatures,
//! relative curvatures of ball and groove, contact modulus, exact ellipse.

use std::f64::consts::{FRAC_PI_4, TAU};

use crate::curvature::{Groove, Surface};
use crate::error::{ReferenceError, within};
use crate::hertz::Hertz;
use crate::material::Elastic;

/// A ball screw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallScrewDesign {
    /// Radius of the ball centres' helix, m.
    pub pitch_radius: f64,
    /// Advance of the nut per turn, m; 0 for a ring.
    pub lead: f64,
    /// Ball radius, m.
    pub ball_radius: f64,
    /// Radius of the screw's groove arcs, m, more than the ball's.
    pub screw_groove_radius: f64,
    /// Radius of the nut's groove arcs, m, more than the ball's.
    pub nut_groove_radius: f64,
    /// Contact angle at which a ball without play lies in its grooves, rad, 0 to pi/2.
    pub contact_angle: f64,
    /// Material of the balls.
    pub ball: Elastic,
    /// Material of screw and nut.
    pub groove: Elastic,
}

impl BallScrewDesign {
    /// The ball screw of Lin 2019, Tables 2.1 and 3.6. The groove radius is that of Table 2.1: that of Table 3.6, 0.56 ball diameters,
    /// is 4 % less.
    pub const LIN: Self = Self {
        pitch_radius: 16.5e-3,
        lead: 20e-3,
        ball_radius: 2.778e-3,
        screw_groove_radius: 3.254e-3,
        nut_groove_radius: 3.254e-3,
        contact_angle: FRAC_PI_4,
        ball: Elastic::STEEL,
        groove: Elastic::STEEL,
    };

    /// Lead angle, rad.
    pub fn lead_angle(&self) -> f64 {
        (self.lead / TAU).atan2(self.pitch_radius)
    }

    /// Refuses grooves that a ball does not run in as the elastic models take it: radii of 1.001 to 2 ball radii.
    pub fn check_grooves(&self) -> Result<(), ReferenceError> {
        check_groove_radii(
            self.ball_radius,
            [self.screw_groove_radius, self.nut_groove_radius],
        )
    }

    /// Surface of one groove, whose arc meets the ball at the nominal contact angle.
    pub fn surface(&self, groove: Groove) -> Surface {
        let groove_radius = match groove {
            Groove::Screw => self.screw_groove_radius,
            Groove::Nut => self.nut_groove_radius,
        };
        let excess = groove_radius - self.ball_radius;
        Surface {
            groove,
            pitch_radius: self.pitch_radius,
            lead_angle: self.lead_angle(),
            groove_radius,
            offset_h: excess * self.contact_angle.cos(),
            offset_l: excess * self.contact_angle.sin(),
        }
    }

    /// Contact of a ball with one groove at the nominal contact angle.
    pub fn contact(&self, groove: Groove) -> Result<Hertz, ReferenceError> {
        self.contact_at(groove, self.contact_angle)
    }

    /// Contact of a ball that touches the same groove surface at another contact angle, rad.
    pub fn contact_at(&self, groove: Groove, contact_angle: f64) -> Result<Hertz, ReferenceError> {
        within("ball_radius", self.ball_radius, 1e-9, 1e9)?;
        let surface = self.surface(groove);
        surface.check(contact_angle)?;
        let curvatures = surface.principal(contact_angle);
        let ball = 1.0 / self.ball_radius;
        Hertz::new(
            1.0 / (ball + curvatures.kappa1),
            1.0 / (ball + curvatures.kappa2),
            self.ball.contact_modulus(&self.groove),
        )
    }
}

pub(crate) fn check_groove_radii(
    ball_radius: f64,
    [screw, nut]: [f64; 2],
) -> Result<(), ReferenceError> {
    let [least, largest] = [1.001, 2.0].map(|part| part * ball_radius);
    within("screw_groove_radius", screw, least, largest)?;
    within("nut_groove_radius", nut, least, largest)?;
    Ok(())
}

/// A linear bearing: straight grooves with circular arcs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearBearingDesign {
    /// Ball radius, m.
    pub ball_radius: f64,
    /// Radius of the groove arcs, m, more than the ball's.
    pub groove_radius: f64,
    /// Material of the balls.
    pub ball: Elastic,
    /// Material of rail and carriage.
    pub groove: Elastic,
}

impl LinearBearingDesign {
    /// Contact of a ball with any of its four arcs: relative radii `r_B` along the straight track and `r_B r_G / (r_G - r_B)` across it.
    pub fn contact(&self) -> Result<Hertz, ReferenceError> {
        let (ball, groove) = (self.ball_radius, self.groove_radius);
        within("ball_radius", ball, 1e-9, 1e9)?;
        Hertz::new(
            ball,
            ball * groove / (groove - ball),
            self.ball.contact_modulus(&self.groove),
        )
    }
}
