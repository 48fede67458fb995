//! A ball screw by its catalogue numbers.

use super::profile::{
    BALL_RADIUS, ContactAngle, Groove, GrooveProfile, GrooveSize, HelixPath, LARGEST_CONTACT_ANGLE,
    LEAD, PITCH_RADIUS, SMALLEST_AREA,
};
use crate::error::{Error, attempt, in_range};
use crate::material::Material;
use crate::math::constant;
use crate::math::elliptic::arc_sine;
use core::f32::consts::{FRAC_PI_2, TAU};

/// Numbers of a ball screw in a catalogue or a drawing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallScrewParameters {
    /// Radius `r_m` of the cylinder on which the ball centres run, m, 1e-3 to 0.5.
    pub pitch_radius: f32,
    /// Axial travel of the nut in one turn, m, 0 to 0.2; 0 is a ball bearing.
    pub lead: f32,
    /// Ball radius `r_b`, m, 1e-4 to 0.05, up to 0.9 of the pitch radius.
    pub ball_radius: f32,
    /// Size of the screw's groove.
    pub screw_groove: GrooveSize,
    /// Size of the nut's groove.
    pub nut_groove: GrooveSize,
    /// Nominal contact angle `beta_0`, rad, 0.01 to [`LARGEST_CONTACT_ANGLE`].
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of screw and nut.
    pub groove_material: Material,
}

impl BallScrewParameters {
    /// Checks all but the sizes of the grooves.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        attempt!(PITCH_RADIUS.checked("pitch_radius", self.pitch_radius));
        attempt!(LEAD.checked("lead", self.lead));
        let (smallest, track) = (BALL_RADIUS.minimum, 0.9 * self.pitch_radius);
        let largest = track.min(BALL_RADIUS.maximum);
        attempt!(in_range("ball_radius", self.ball_radius, smallest, largest));
        let (angle, largest) = (self.contact_angle, LARGEST_CONTACT_ANGLE);
        attempt!(in_range("contact_angle", angle, 0.01, largest));
        attempt!(self.ball_material.checked());
        attempt!(self.groove_material.checked());
        Ok(())
    }
}

/// A ball screw whose every number has been checked; at set-up, or in a constant, which stops the compiler at a wrong number.
///
/// ```
/// use epas_friction::{BallScrew, BallScrewParameters, GrooveSize, Material};
///
/// let design = BallScrew::new(BallScrewParameters {
///     pitch_radius: 16.5e-3,
///     lead: 20e-3,
///     ball_radius: 2.778e-3,
///     screw_groove: GrooveSize::Conformity(0.56),
///     nut_groove: GrooveSize::Conformity(0.56),
///     contact_angle: 45f32.to_radians(),
///     ball_material: Material::STEEL,
///     groove_material: Material::STEEL,
/// })?;
/// assert!((design.tan_lead_angle() - 0.192915).abs() < 1e-6);
///
/// let mut wrong = *design.parameters();
/// wrong.lead = -1.0;
/// assert_eq!(BallScrew::new(wrong).unwrap_err().field(), "lead");
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallScrew {
    parameters: BallScrewParameters,
    path: HelixPath,
    tan_lead_angle: f32,
    contact_angle: ContactAngle,
    screw: Section,
    nut: Section,
}

/// A groove's profile and the excess of its radius over the ball's.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Section {
    profile: GrooveProfile,
    clearance: f32,
}

impl Section {
    const fn new(
        size: GrooveSize,
        ball_radius: f32,
        contact_angle: ContactAngle,
    ) -> Result<Self, Error> {
        let (radius, clearance) = attempt!(size.radius_and_clearance(ball_radius));
        Ok(Self {
            profile: GrooveProfile::new(radius, clearance, contact_angle),
            clearance,
        })
    }
}

impl BallScrew {
    /// Checks every field and folds the constants.
    pub const fn new(parameters: BallScrewParameters) -> Result<Self, Error> {
        let BallScrewParameters {
            pitch_radius,
            lead,
            ball_radius,
            ..
        } = parameters;
        attempt!(parameters.checked());
        let contact_angle = ContactAngle::new(parameters.contact_angle);
        let (screw, nut) = (parameters.screw_groove, parameters.nut_groove);
        let screw = attempt!(Section::new(screw, ball_radius, contact_angle));
        let nut = attempt!(Section::new(nut, ball_radius, contact_angle));
        let path = HelixPath::from_lead(pitch_radius, lead);
        attempt!(refuse_folded(&path, &screw.profile));

        Ok(Self {
            parameters,
            path,
            tan_lead_angle: lead / (TAU * pitch_radius),
            contact_angle,
            screw,
            nut,
        })
    }

    /// Parameters of the design.
    pub const fn parameters(&self) -> &BallScrewParameters {
        &self.parameters
    }

    /// Radius `r_m` of the cylinder on which the ball centres run, m.
    pub const fn pitch_radius(&self) -> f32 {
        self.parameters.pitch_radius
    }

    /// Axial travel in one turn, m.
    pub const fn lead(&self) -> f32 {
        self.parameters.lead
    }

    /// Ball radius `r_b`, m.
    pub const fn ball_radius(&self) -> f32 {
        self.parameters.ball_radius
    }

    /// Ball radius over pitch radius.
    #[inline]
    pub const fn ball_ratio(&self) -> f32 {
        self.parameters.ball_radius / self.parameters.pitch_radius
    }

    /// Tangent of the lead angle, `lead / (2 pi pitch_radius)`.
    pub const fn tan_lead_angle(&self) -> f32 {
        self.tan_lead_angle
    }

    /// Lead angle, rad (Lin 2019, eqs. (2.5), (3.63)), within 2e-7. For set-up and constants.
    pub const fn lead_angle(&self) -> f32 {
        let (tan, cos) = (self.tan_lead_angle, self.cos_lead_angle());
        // By the smaller of sine and cosine, which fixes the angle better.
        if tan <= 1.0 {
            arc_sine(tan * cos)
        } else {
            FRAC_PI_2 - arc_sine(cos)
        }
    }

    /// Cosine of the lead angle. For set-up and constants.
    pub const fn cos_lead_angle(&self) -> f32 {
        1.0 / constant::sqrt(1.0 + self.tan_lead_angle * self.tan_lead_angle)
    }

    /// Path radius `r_m / cos(alpha)`, m: `L/(2 pi)` with the `L` of Lin 2019, eq. (3.66). For set-up.
    pub const fn path_radius(&self) -> f32 {
        self.parameters.pitch_radius / self.cos_lead_angle()
    }

    /// Axial travel over the angle of a turn, `lead / 2 pi`, m (Lin 2019, eqs. (2.2), (3.55)).
    #[inline]
    pub const fn reduced_lead(&self) -> f32 {
        self.parameters.lead / TAU
    }

    /// Axial force over the contact force of a ball, `sin(beta) cos(alpha)`. For set-up.
    pub const fn axial_per_normal(&self) -> f32 {
        self.contact_angle.sin * self.cos_lead_angle()
    }

    /// Curvature and torsion of the path of the ball centres.
    pub const fn path(&self) -> &HelixPath {
        &self.path
    }

    /// Nominal contact angle, by its cosine and sine.
    pub const fn contact_angle(&self) -> ContactAngle {
        self.contact_angle
    }

    /// Section of one groove.
    #[inline]
    pub const fn profile(&self, groove: Groove) -> &GrooveProfile {
        &self.section(groove).profile
    }

    /// Groove radius less ball radius, m, without the cancellation of their difference.
    #[inline]
    pub const fn clearance(&self, groove: Groove) -> f32 {
        self.section(groove).clearance
    }

    /// Mass of one ball, kg.
    pub const fn ball_mass(&self) -> f32 {
        let radius = self.parameters.ball_radius;
        const VOLUME: f32 = 2.0 / 3.0 * TAU;
        self.parameters.ball_material.density * VOLUME * radius * radius * radius
    }

    const fn section(&self, groove: Groove) -> &Section {
        match groove {
            Groove::Screw => &self.screw,
            Groove::Nut => &self.nut,
        }
    }
}

/// The surface is regular while `A = 1 + kappa H - kappa r_s cos(beta) > 0`; the bottom of the groove (`cos(beta) = 1`) folds first.
const fn refuse_folded(path: &HelixPath, screw: &GrooveProfile) -> Result<(), Error> {
    let largest = (1.0 - SMALLEST_AREA) / path.curvature + screw.offset_h;
    if screw.groove_radius < largest {
        Ok(())
    } else {
        let radius = screw.groove_radius;
        Err(Error::folded("groove_radius", radius, 0.0, largest))
    }
}
