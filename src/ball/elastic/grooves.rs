//! Both grooves of a ball screw, as an elastic ball meets them.

use super::equations::Motion;
use crate::contact::slip_map::looped::LoopSlipMap;
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::ranges;

/// Grooves of a ball screw with their elastic contacts; lengths over the ball radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ElasticGrooves {
    pub(super) screw: ElasticGroove,
    pub(super) nut: ElasticGroove,
    /// Cosine and sine of the nominal contact angle.
    pub(super) cos: f32,
    pub(super) sin: f32,
    /// Radius of the path of the balls.
    pub(super) path: f32,
    pub(super) sin_lead: f32,
    pub(super) cos_lead: f32,
    pub(super) ball_radius: f32,
    /// 1 / ball radius, 1/m; 1 / cosine of the lead angle; load of a main contact over the axial one.
    pub(super) per_radius: f32,
    pub(super) per_cos_lead: f32,
    pub(super) per_axial_load: f32,
    /// Angular velocity of the orbit about the axis across track and radius, over the speed along the track.
    pub(super) orbit: f32,
}

/// One groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ElasticGroove {
    pub(super) map: LoopSlipMap,
    /// Distance of the arcs' centres from the centre of the ball that touches both without load.
    pub(super) centre: f32,
    /// Load to the power 2/3 over deflection, `N^(2/3)`.
    pub(super) stiffness: f32,
    pub(super) per_stiffness: f32,
    /// Semi-major axis at one newton, `N^(-1/3)`.
    pub(super) semi_major: f32,
    /// Angular velocity over the nut's: 0 of the screw, 1 of the nut.
    pub(super) turning: f32,
    /// Its motion as the ball's: angular velocity across the track and about it, speed along it.
    pub(super) base: Motion,
}

impl ElasticGroove {
    const fn new(design: &BallScrew, groove: Groove, turning: f32) -> Result<Self, Error> {
        let contact = HertzContact::of(design, groove);
        let radius = design.ball_radius();
        let cos_lead = design.cos_lead_angle();
        let sin_lead = cos_lead * design.tan_lead_angle();
        Ok(Self {
            map: attempt!(LoopSlipMap::new(contact.axis_ratio())),
            centre: design.clearance(groove) / radius,
            stiffness: radius / contact.deflection_coefficient(),
            per_stiffness: contact.deflection_coefficient() / radius,
            semi_major: contact.semi_major_coefficient() / radius,
            turning,
            base: Motion {
                speed: turning * design.path_in_ball_radii(),
                x: 0.0,
                y: turning * sin_lead,
                z: turning * cos_lead,
            },
        })
    }
}

impl ElasticGrooves {
    /// Folds the constants of a design: places of the arcs, Hertz constants and maps of friction over slip and spin of both
    /// grooves.
    ///
    /// ```text
    /// F = (delta/c)^(3/2)         a = a_1 F^(1/3)         q = r_m/cos(alpha)
    /// ```
    ///
    /// with the deflection `delta`, m, of a contact under the load `F`, N, its semi-major axis `a`, m, and `c`, `a_1` by
    /// [`HertzContact`] at the nominal contact angle. Deviations turn the arcs and leave these as they are.
    ///
    /// For set-up, or in a constant; errors are those of [`HertzContact`] and of the maps, which
    /// [`SCREW_RENEWAL`](crate::promises::SCREW_RENEWAL) has in it.
    ///
    /// Source: Lin 2019, eqs. (2.14), (B.1), (B.11).
    ///
    /// # Errors
    /// [`Error`] naming `contact_angle` (0.05 to 1.5) or `axis_ratio`.
    pub const fn new(design: &BallScrew) -> Result<Self, Error> {
        attempt!(
            ranges::ROLLING_CONTACT_ANGLE
                .checked("contact_angle", design.parameters().contact_angle)
        );
        let cos_lead = design.cos_lead_angle();
        Ok(Self {
            screw: attempt!(ElasticGroove::new(design, Groove::Screw, 0.0)),
            nut: attempt!(ElasticGroove::new(design, Groove::Nut, 1.0)),
            cos: design.contact_angle().cos,
            sin: design.contact_angle().sin,
            path: design.path_in_ball_radii(),
            sin_lead: cos_lead * design.tan_lead_angle(),
            cos_lead,
            orbit: cos_lead * cos_lead * design.ball_radius() / design.pitch_radius(),
            ball_radius: design.ball_radius(),
            per_radius: 1.0 / design.ball_radius(),
            per_cos_lead: 1.0 / cos_lead,
            per_axial_load: 1.0 / design.axial_per_normal(),
        })
    }
}
