//! Rolling resistance of one contact: what a contact loses that rolls without any slip, by **elastic hysteresis** and by **drag of the
//! lubricant**.
//!
//! Both are forces that resist the contact's travel along its track: loss = force x rolling speed, the speed at which the groove's surface
//! runs past the contact. They are too small (1e-5 to 1e-4 of the load) to change how a ball moves.
//!
//! Sources: Greenwood, Minshall and Tabor 1961, Proc. Roy. Soc. A 259, with Johnson 1985, Contact Mechanics, section 9.2 (hysteresis of an
//! elliptical contact); Houpert 2002, Tribology Transactions 45 (lubricant drag of a point contact).

use std::f64::consts::TAU;

use super::ball_screw_row::RowBallMotion;
use crate::curvature::Groove;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// Load to which the lubricant's drag refers, N.
pub const DRAG_LOAD: f64 = 100.0;

/// Rolling resistance of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingResistance {
    /// Share of the elastic energy that is lost while the contact passes, 0 to 0.2.
    pub hysteresis_loss: f64,
    /// Lubricant's drag on one contact under [`DRAG_LOAD`], N, 0 to 10.
    pub lubricant_drag: f64,
}

impl RollingResistance {
    /// No resistance.
    pub const NONE: Self = Self {
        hysteresis_loss: 0.0,
        lubricant_drag: 0.0,
    };

    /// Hardened steel without lubricant drag: a share of 0.01, where Johnson gives "of the order of one per cent" for metals below yield.
    pub const STEEL: Self = Self {
        hysteresis_loss: 0.01,
        lubricant_drag: 0.0,
    };

    /// Refuses what is out of range.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("hysteresis_loss", self.hysteresis_loss, 0.0, 0.2)?;
        within("lubricant_drag", self.lubricant_drag, 0.0, 10.0)?;
        Ok(())
    }

    /// Force of hysteresis against the travel of a contact, N: `3/16 loss N b/R_x`, with the semi-axis `b` along the
    /// track and the relative radius `R_x` of both bodies along the track.
    ///
    /// The pressure of the front half does the work `N 3 b/16` for each radian by which the surfaces close in on each
    /// other, and they do so by `1/R_x` radians a metre.
    ///
    /// Source: Johnson 1985, section 9.2, after Greenwood, Minshall, Tabor 1961: moment `3/16 loss b N`.
    pub fn hysteresis_force(&self, load: f64, semi_minor: f64, rolling_radius: f64) -> f64 {
        3.0 / 16.0 * self.hysteresis_loss * load * semi_minor / rolling_radius
    }

    /// Force of the lubricant against the travel of a contact, N: in proportion to the root of the load, which lies
    /// between the powers 0.47 of Houpert's formula and 0.54 of SKF's for ball bearings.
    pub fn lubricant_force(&self, load: f64) -> f64 {
        self.lubricant_drag * (load / DRAG_LOAD).sqrt()
    }
}

/// A lubricated point contact, for [`Self::drag`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricatedContact {
    /// Relative radius along the track, m.
    pub rolling_radius: f64,
    /// Relative radius across the track, m.
    pub cross_radius: f64,
    /// Contact modulus `E*`, Pa.
    pub contact_modulus: f64,
    /// Viscosity of the (base) oil at the contact's temperature and ambient pressure, Pa s.
    pub viscosity: f64,
    /// Growth of the viscosity's logarithm with pressure, 1/Pa; 2e-8 for mineral oil.
    pub pressure_viscosity: f64,
}

impl LubricatedContact {
    /// Contact of a ball with one groove of a ball screw.
    pub fn of(
        design: &BallScrewDesign,
        groove: Groove,
        viscosity: f64,
        pressure_viscosity: f64,
    ) -> Result<Self, ReferenceError> {
        let [rolling_radius, cross_radius] = relative_radii(design, groove)?;
        Ok(Self {
            rolling_radius,
            cross_radius,
            contact_modulus: design.ball.contact_modulus(&design.groove),
            viscosity,
            pressure_viscosity,
        })
    }

    /// Drag under a load, N, at a rolling speed, m/s: `F = 2.86 E' R_x² k^0.348 G^0.022 U^0.66 W^0.47` with `E' = 2
    /// E*`, `k = R_y/R_x`, `G = E'` times the pressure viscosity, `U = viscosity speed/(E' R_x)`, `W = N/(E' R_x²)`.
    ///
    /// Source: Houpert 2002, for fully flooded, isothermal contacts; [`RollingResistance::lubricant_drag`] is this at [`DRAG_LOAD`].
    pub fn drag(&self, load: f64, rolling_speed: f64) -> f64 {
        let modulus = 2.0 * self.contact_modulus;
        let rx = self.rolling_radius;
        let speed = self.viscosity * rolling_speed.abs() / (modulus * rx);
        2.86 * modulus
            * rx.powi(2)
            * (self.cross_radius / rx).powf(0.348)
            * (modulus * self.pressure_viscosity).powf(0.022)
            * speed.powf(0.66)
            * (load / (modulus * rx.powi(2))).powf(0.47)
    }
}

/// Relative radii of ball and groove along and across the track at the nominal contact angle, m.
pub fn relative_radii(
    design: &BallScrewDesign,
    groove: Groove,
) -> Result<[f64; 2], ReferenceError> {
    design.contact(groove)?;
    let curvatures = design.surface(groove).principal(design.contact_angle);
    let ball = 1.0 / design.ball_radius;
    Ok([
        1.0 / (ball + curvatures.kappa1),
        1.0 / (ball + curvatures.kappa2),
    ])
}

/// Power that one ball of a ball screw loses by rolling resistance, W: by hysteresis and by the lubricant, of all its contacts.
///
/// The groove's surface runs past a contact by `|w_B - w_k| (L/2 pi + R_B cos a n_x)`, with `w_k` zero for the screw
/// and the nut's speed for the nut.
pub fn rolling_losses(
    design: &BallScrewDesign,
    resistance: &RollingResistance,
    ball: &RowBallMotion,
    nut_speed: f64,
) -> Result<[f64; 2], ReferenceError> {
    resistance.check()?;
    let radii = [
        relative_radii(design, Groove::Screw)?[0],
        relative_radii(design, Groove::Nut)?[0],
    ];
    let path = design.pitch_radius.hypot(design.lead / TAU);
    let cos_a = design.pitch_radius / path;
    let mut losses = [0.0; 2];
    for friction in &ball.motion.contacts {
        let contact = friction.contact;
        let on_nut = contact.groove.on_nut();
        let (sx, _) = contact.groove.signs();
        let past = ball.motion.orbital_speed - if on_nut { nut_speed } else { 0.0 };
        let arm = path + design.ball_radius * cos_a * sx * contact.contact_angle.cos();
        let rolling_speed = past.abs() * arm;
        let ellipse = contact.ellipse;
        let semi_minor =
            ellipse.axis_ratio * ellipse.semi_major_constant * contact.load.max(0.0).cbrt();
        let radius = radii[usize::from(on_nut)];
        losses[0] += resistance.hysteresis_force(contact.load, semi_minor, radius) * rolling_speed;
        losses[1] += resistance.lubricant_force(contact.load) * rolling_speed;
    }
    Ok(losses)
}
