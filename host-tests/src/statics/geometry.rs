//! Geometry of the ball path and of the four arcs of a gothic-arch groove.

use nalgebra::{Matrix2x3, Vector2, Vector3};

use crate::error::{ReferenceError, within};

/// One of the four arcs that a ball can touch; lists of four have their order.
pub use crate::friction::ball_screw_ball::Groove as Contact;

/// Signs of the arc centre's coordinates: outward and along the screw.
pub(super) const fn centre_signs(contact: Contact) -> [f64; 2] {
    let (outward, along) = contact.signs();
    [-outward, -along]
}

/// Nominal geometry of a single-start, right-handed ball screw with gothic-arch grooves. A lead of zero is a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Pitch radius `R_P`, m.
    pub pitch_radius: f64,
    /// Lead `p`, m.
    pub lead: f64,
    /// Ball radius `r_B`, m.
    pub ball_radius: f64,
    /// Radius `r_G` of the groove's arcs, m.
    pub groove_radius: f64,
    /// Nominal contact angle `beta`, rad, from the radial direction.
    pub contact_angle: f64,
}

impl Geometry {
    /// Refuses numbers that describe no ball screw.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("pitch_radius", self.pitch_radius, 1e-4, 10.0)?;
        within("lead", self.lead, 0.0, 10.0 * self.pitch_radius)?;
        within(
            "ball_radius",
            self.ball_radius,
            1e-5,
            0.9 * self.pitch_radius,
        )?;
        within(
            "groove_radius",
            self.groove_radius,
            self.ball_radius * 1.000_1,
            self.ball_radius * 10.0,
        )?;
        within("contact_angle", self.contact_angle, 0.01, 1.56)?;
        Ok(())
    }

    /// Advance of the ball path per radian, m: eq. (2.2).
    pub fn advance(&self) -> f64 {
        self.lead / std::f64::consts::TAU
    }

    /// Lead angle `alpha`, rad: eq. (2.5).
    pub fn lead_angle(&self) -> f64 {
        (self.advance() / self.pitch_radius).atan()
    }

    /// Distance `r_G - r_B` of the arc's centre from the nominal ball centre, m.
    pub fn excess(&self) -> f64 {
        self.groove_radius - self.ball_radius
    }

    /// Rows are the unit vectors `x3` (outward) and `z3` (across the groove) at an azimuth.
    pub fn section_axes(&self, azimuth: f64) -> Matrix2x3<f64> {
        let (sin, cos) = azimuth.sin_cos();
        let (sin_lead, cos_lead) = self.lead_angle().sin_cos();
        Matrix2x3::new(cos, sin, 0.0, sin * sin_lead, -cos * sin_lead, cos_lead)
    }

    /// Centre of an arc from the nominal ball centre, m, in the section: eq. (2.4).
    pub fn arc_centre(&self, contact: Contact) -> Vector2<f64> {
        let [outward, along] = centre_signs(contact);
        let (sin, cos) = self.contact_angle.sin_cos();
        self.excess() * Vector2::new(outward * cos, along * sin)
    }

    /// Nominal contact point, m: its radial vector from the screw's axis (no `z` part), and its `z` from the ball centre's.
    pub fn contact_point(&self, contact: Contact, azimuth: f64) -> (Vector3<f64>, f64) {
        let [outward, along] = centre_signs(contact);
        let (sin, cos) = self.contact_angle.sin_cos();
        let in_section = -self.ball_radius * Vector2::new(outward * cos, along * sin);
        let from_ball = self.section_axes(azimuth).transpose() * in_section;
        let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
        let radial = Vector3::new(
            self.pitch_radius * cos_azimuth + from_ball.x,
            self.pitch_radius * sin_azimuth + from_ball.y,
            0.0,
        );
        (radial, from_ball.z)
    }
}
