//! What the kinematics of one ball are set up from.

use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::constant;
use crate::ranges;

/// Geometry and state of one ball with a contact on the screw and one on the nut.
///
/// The fields are the symbols of Alberdi et al., section 2, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KinematicsParameters {
    /// Diameter of the ball (`D`), m; 2e-5 to 2.
    pub ball_diameter: f32,
    /// Radius of the helix of ball centres (`r_m`), m; 1e-4 to 10.
    pub pitch_radius: f32,
    /// Lead angle of that helix (`psi`), rad; -1.2 to 1.2. Positive for a right-hand thread, 0 for a
    /// ball bearing.
    pub lead_angle: f32,
    /// Radius of the groove's profile on the screw (`r_i`), m; 0.5 to 2 ball diameters.
    pub groove_radius_screw: f32,
    /// Radius of the groove's profile on the nut (`r_o`), m; 0.5 to 2 ball diameters.
    pub groove_radius_nut: f32,
    /// Contact angle on the screw (`alpha_i`), rad, from the radial direction; -pi/2 to pi/2.
    /// Positive where the screw pushes the ball along its axis (the paper's case).
    pub contact_angle_screw: f32,
    /// Contact angle on the nut (`alpha_o`), rad; -pi/2 to pi/2.
    pub contact_angle_nut: f32,
    /// Pitch angle of the ball's axis of rotation (`beta`), rad; -pi/2 to pi/2.
    pub pitch_angle: f32,
    /// Yaw angle of the ball's axis of rotation (`beta'`), rad; -0.5 to 0.5. Customary: 0.
    pub yaw_angle: f32,
    /// Distance from the ball's centre at which rolling slip vanishes at the screw (`r'_i`), m; 0.5
    /// to 2 ball radii. Customary: the ball's radius.
    pub rolling_radius_screw: f32,
    /// The same at the nut (`r'_o`), m; 0.5 to 2 ball radii.
    pub rolling_radius_nut: f32,
    /// Semi-major axis of the contact ellipse on the screw (`a_H`), m; 0 to 0.3 ball radii.
    pub semi_major_screw: f32,
    /// Semi-minor axis of the contact ellipse on the screw (`b_H`), m; 0 to the semi-major axis.
    pub semi_minor_screw: f32,
    /// Semi-major axis of the contact ellipse on the nut, m; 0 to 0.3 ball radii.
    pub semi_major_nut: f32,
    /// Semi-minor axis of the contact ellipse on the nut, m; 0 to the semi-major axis.
    pub semi_minor_nut: f32,
}

impl KinematicsParameters {
    /// Those of a validated design whose balls carry the contact forces `load_screw` and `load_nut`, N, 0 to 1e7, at its
    /// nominal contact angle. For set-up; a constant can take them.
    ///
    /// Ellipses are those of [`HertzContact`] under these forces. The ball's rotation is the customary one: pitch angle
    /// equal to the contact angle, no yaw, rolling radii equal to the
    /// ball's radius. Any field may be changed afterwards.
    ///
    /// ```
    /// use epas_friction::CATALOGUE;
    /// use epas_friction::kinematics::{ContactKinematics, KinematicsParameters};
    /// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
    /// let kinematics = ContactKinematics::new(&KinematicsParameters::of(&design, 100.0, 100.0)?)?;
    /// let ball = kinematics.tick(104.72); // 1000 revolutions a minute
    /// assert!((ball.orbital_speed / 104.72 - 0.43).abs() < 0.01);
    /// # Ok::<(), epas_friction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error`] naming `load_screw` or `load_nut`. A load whose ellipse is too large for the ball, or a lead that is too
    /// steep, is refused by [`ContactKinematics::new`](super::ContactKinematics::new).
    pub const fn of(design: &BallScrew, load_screw: f32, load_nut: f32) -> Result<Self, Error> {
        let load_screw = attempt!(ranges::LOAD.checked("load_screw", load_screw));
        let load_nut = attempt!(ranges::LOAD.checked("load_nut", load_nut));
        let screw = HertzContact::of(design, Groove::Screw);
        let nut = HertzContact::of(design, Groove::Nut);
        let (root_screw, root_nut) = (constant::cbrt(load_screw), constant::cbrt(load_nut));
        let contact_angle = design.parameters().contact_angle;
        Ok(Self {
            ball_diameter: 2.0 * design.ball_radius(),
            pitch_radius: design.pitch_radius(),
            lead_angle: design.lead_angle(),
            groove_radius_screw: design.profile(Groove::Screw).groove_radius,
            groove_radius_nut: design.profile(Groove::Nut).groove_radius,
            contact_angle_screw: contact_angle,
            contact_angle_nut: contact_angle,
            pitch_angle: contact_angle,
            yaw_angle: 0.0,
            rolling_radius_screw: design.ball_radius(),
            rolling_radius_nut: design.ball_radius(),
            semi_major_screw: screw.semi_major_coefficient() * root_screw,
            semi_minor_screw: screw.semi_minor_coefficient() * root_screw,
            semi_major_nut: nut.semi_major_coefficient() * root_nut,
            semi_minor_nut: nut.semi_minor_coefficient() * root_nut,
        })
    }

    pub(super) const fn screw(&self) -> EllipticContact {
        EllipticContact {
            contact_angle: self.contact_angle_screw,
            semi_major: self.semi_major_screw,
            semi_minor: self.semi_minor_screw,
        }
    }

    pub(super) const fn nut(&self) -> EllipticContact {
        EllipticContact {
            contact_angle: self.contact_angle_nut,
            semi_major: self.semi_major_nut,
            semi_minor: self.semi_minor_nut,
        }
    }
}

/// What load changes at one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EllipticContact {
    /// Contact angle, rad; -pi/2 to pi/2.
    pub contact_angle: f32,
    /// Semi-major axis of the contact ellipse, m; 0 to 0.3 ball radii.
    pub semi_major: f32,
    /// Semi-minor axis of the contact ellipse, m; 0 to the semi-major axis.
    pub semi_minor: f32,
}
