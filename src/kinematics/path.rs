//! Parameters of a ball between its grooves, path of its centre, direction of rolling.

use crate::error::{Error, Range, all_in_range, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::{self, constant};
use crate::ranges;
use core::f32::consts::FRAC_PI_2;

/// Geometry and state of one ball with a contact on the screw and one on the nut; symbols of Alberdi et al., section 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KinematicsParameters {
    /// Diameter of the ball (`D`), m; 2e-5 to 2.
    pub ball_diameter: f32,
    /// Radius of the helix of ball centres (`r_m`), m; 1e-4 to 10.
    pub pitch_radius: f32,
    /// Lead angle of that helix (`psi`), rad; -1.2 to 1.2, positive for a right-hand thread.
    pub lead_angle: f32,
    /// Radius of the groove's profile on the screw (`r_i`), m; 0.5 to 2 ball diameters.
    pub groove_radius_screw: f32,
    /// Radius of the groove's profile on the nut (`r_o`), m; 0.5 to 2 ball diameters.
    pub groove_radius_nut: f32,
    /// Contact angle on the screw (`alpha_i`), rad, from the radial direction; -pi/2 to pi/2, positive where the screw pushes the ball along its axis.
    pub contact_angle_screw: f32,
    /// Contact angle on the nut (`alpha_o`), rad; -pi/2 to pi/2.
    pub contact_angle_nut: f32,
    /// Pitch angle of the ball's axis of rotation (`beta`), rad; -pi/2 to pi/2.
    pub pitch_angle: f32,
    /// Yaw angle of the ball's axis of rotation (`beta'`), rad; -0.5 to 0.5.
    pub yaw_angle: f32,
    /// Distance from the ball's centre at which rolling slip vanishes at the screw (`r'_i`), m; 0.5 to 2 ball radii.
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
    /// Those of a validated design whose balls carry the contact forces `load_screw` and `load_nut`, N, 0 to 1e7, at its nominal contact angle, with
    /// ellipses of [`HertzContact`] and the customary rotation; for constants too.
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

    const fn checked(&self) -> Result<(), Error> {
        let p = self;
        let ball_radius = 0.5 * p.ball_diameter;
        let (narrowest, widest) = (ball_radius, 2.0 * p.ball_diameter);
        let (shortest, longest) = (0.5 * ball_radius, p.ball_diameter);
        let (right, largest_ellipse) = (FRAC_PI_2, LARGEST_ELLIPSE * ball_radius);
        attempt!(BALL_DIAMETER.checked("ball_diameter", p.ball_diameter));
        attempt!(ranges::PITCH_RADIUS.checked("pitch_radius", p.pitch_radius));
        all_in_range(&[
            ("lead_angle", p.lead_angle, -1.2, 1.2),
            (
                "groove_radius_screw",
                p.groove_radius_screw,
                narrowest,
                widest,
            ),
            ("groove_radius_nut", p.groove_radius_nut, narrowest, widest),
            ("contact_angle_screw", p.contact_angle_screw, -right, right),
            ("contact_angle_nut", p.contact_angle_nut, -right, right),
            ("pitch_angle", p.pitch_angle, -right, right),
            ("yaw_angle", p.yaw_angle, -0.5, 0.5),
            (
                "rolling_radius_screw",
                p.rolling_radius_screw,
                shortest,
                longest,
            ),
            (
                "rolling_radius_nut",
                p.rolling_radius_nut,
                shortest,
                longest,
            ),
            ("semi_major_screw", p.semi_major_screw, 0.0, largest_ellipse),
            (
                "semi_minor_screw",
                p.semi_minor_screw,
                0.0,
                p.semi_major_screw,
            ),
            ("semi_major_nut", p.semi_major_nut, 0.0, largest_ellipse),
            ("semi_minor_nut", p.semi_minor_nut, 0.0, p.semi_major_nut),
        ])
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

/// Contact angle and ellipse under a load.
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

const BALL_DIAMETER: Range = Range::new(
    2.0 * ranges::BALL_RADIUS.minimum,
    2.0 * ranges::BALL_RADIUS.maximum,
);

/// Largest semi-major axis over the ball's radius, for Hertz' half-space.
#[doc(hidden)]
pub const LARGEST_ELLIPSE: f32 = 0.3;

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct GroovePath {
    /// `q / r'`: path radius over rolling radius.
    pub path_over_rolling: f32,
    /// `r'`, m.
    pub rolling_radius: f32,
    /// `r' - D/2`, m; exact in f32 because the two are within a factor of two (Sterbenz).
    pub rolling_excess: f32,
    /// Half the curvature of the deformed surface, `1 / (2 R)`, 1/m; eq. (15).
    pub half_curvature: f32,
    /// Sagitta of ball and deformed surface over the ellipse, `D/2 - S(0)` with `S` of eq. (14), as a polynomial in `(a / (D/2))^2`.
    pub deficit: [f32; 3],
}

/// `z^4` for `z` from 0 to 0.09, the square of [`LARGEST_ELLIPSE`], by `z`, `z^2` and `z^3`: Chebyshev's polynomial of the fourth degree with its
/// first zero at 0, within 6e-7.
#[doc(hidden)]
pub const FOURTH_POWER: [f32; 3] = {
    // Half the interval, and its middle.
    let half = 0.09 / (1.0 + 0.923_879_5);
    let middle = 0.09 - half;
    [
        4.0 * middle * middle * middle - 2.0 * half * half * middle,
        half * half - 6.0 * middle * middle,
        4.0 * middle,
    ]
};

impl GroovePath {
    const fn new(
        path_radius: f32,
        ball_radius: f32,
        groove_radius: f32,
        rolling_radius: f32,
    ) -> Self {
        let ball_diameter = 2.0 * ball_radius;
        // rho = (D/2) / R = (2 r + D) / (4 r); 1 - rho from 2 r - D, which is exact for D/2 <= 2 r <= 2 D.
        let gap = (2.0 * groove_radius - ball_diameter) / (4.0 * groove_radius);
        let rho = (2.0 * groove_radius + ball_diameter) / (4.0 * groove_radius);
        let rho_2 = rho * rho;
        let rho_4 = rho_2 * rho_2;
        // D/2 - S(0) = [u - sqrt(u^2 - a^2)] - [R - sqrt(R^2 - a^2)] from (14) by 1 - sqrt(1 - z) =
        // z/2 + z^2/8 + z^3/16 + 5 z^4/128 + ..., and 1 - rho^(2n-1) = (1 - rho)(1 + rho + ...).
        let sum_3 = 1.0 + rho + rho_2;
        let sum_5 = sum_3 + rho_2 * rho + rho_4;
        let sum_7 = sum_5 + rho_4 * rho + rho_4 * rho_2;
        let scale = ball_radius * gap;
        let fourth = sum_7 * 0.0390625;
        Self {
            path_over_rolling: path_radius / rolling_radius,
            rolling_radius,
            rolling_excess: rolling_radius - ball_radius,
            half_curvature: 0.5 * rho / ball_radius,
            deficit: [
                scale * (0.5 + fourth * FOURTH_POWER[0]),
                scale * (sum_3 * 0.125 + fourth * FOURTH_POWER[1]),
                scale * (sum_5 * 0.0625 + fourth * FOURTH_POWER[2]),
            ],
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Path {
    /// `sin psi`.
    pub sin_lead: f32,
    /// `cos psi`.
    pub cos_lead: f32,
    /// `q = r_m / cos psi`, m.
    pub radius: f32,
    /// `q / 2`, m.
    pub half_radius: f32,
    /// `h = cos beta cos beta'`: direction of the axis of rotation against the binormal.
    pub axis_binormal: f32,
    /// `t = cos beta sin beta'`: along the path.
    pub axis_tangent: f32,
    /// `sin beta`: against the normal.
    pub axis_normal: f32,
    /// `1 / (D/2)^2`, 1/m^2.
    pub inverse_ball_radius_squared: f32,
    /// Largest semi-major axis, m.
    pub largest_ellipse: f32,
    pub screw: GroovePath,
    pub nut: GroovePath,
}

impl Path {
    pub const fn new(parameters: &KinematicsParameters) -> Result<Self, Error> {
        let p = parameters;
        attempt!(p.checked());
        let ball_radius = 0.5 * p.ball_diameter;
        let largest_ellipse = LARGEST_ELLIPSE * ball_radius;
        let (sin_lead, cos_lead) = constant::sin_cos(p.lead_angle);
        let (sin_pitch, cos_pitch) = constant::sin_cos(p.pitch_angle);
        let (sin_yaw, cos_yaw) = constant::sin_cos(p.yaw_angle);
        let radius = p.pitch_radius / cos_lead;
        Ok(Self {
            sin_lead,
            cos_lead,
            radius,
            half_radius: 0.5 * radius,
            axis_binormal: cos_pitch * cos_yaw,
            axis_tangent: cos_pitch * sin_yaw,
            axis_normal: sin_pitch,
            inverse_ball_radius_squared: 1.0 / (ball_radius * ball_radius),
            largest_ellipse,
            screw: GroovePath::new(
                radius,
                ball_radius,
                p.groove_radius_screw,
                p.rolling_radius_screw,
            ),
            nut: GroovePath::new(
                radius,
                ball_radius,
                p.groove_radius_nut,
                p.rolling_radius_nut,
            ),
        })
    }

    #[inline]
    pub fn accepts(&self, contact: EllipticContact) -> bool {
        // Bits of positive numbers are in their order, with NaN and negative numbers beyond them.
        let (semi_major, semi_minor) = (contact.semi_major.to_bits(), contact.semi_minor.to_bits());
        contact.contact_angle.abs().to_bits() <= FRAC_PI_2.to_bits()
            && (semi_major <= self.largest_ellipse.to_bits() && semi_minor <= semi_major
                || self.accepts_zeros(contact))
    }

    #[cold]
    #[inline(never)]
    fn accepts_zeros(&self, contact: EllipticContact) -> bool {
        // Written so that a comparison with NaN refuses.
        contact.semi_major <= self.largest_ellipse
            && contact.semi_minor <= contact.semi_major
            && contact.semi_minor >= 0.0
    }
}

/// Least `b_k`, the speed of the ball's surface at the contact in units of `omega_R r'_k`: below it (an axis of rotation within 15° of the contact
/// normal) the ball drills more than it rolls.
pub(super) const LEAST_GRIP: f32 = 0.25;
/// Least part of `q = r_m / cos psi` that `A_k` may keep.
const LEAST_REACH: f32 = 0.1;

/// A contact angle, resolved against path and axis of rotation.
pub(super) struct Direction {
    pub sine: f32,
    pub cosine: f32,
    /// `A_k / r'_k`.
    pub reach: f32,
    /// `b_k`.
    pub grip: f32,
    /// Semi-axes of the ellipse, m.
    pub semi_major: f32,
    pub semi_minor: f32,
}

impl Direction {
    /// True where the ball's surface moves fast enough at the contact to roll there.
    #[inline]
    pub const fn grips(&self) -> bool {
        self.grip >= LEAST_GRIP
    }

    /// True where the ball's path does not fold past the axis.
    #[inline]
    pub const fn reaches(&self, groove_path: &GroovePath) -> bool {
        self.reach >= LEAST_REACH * groove_path.path_over_rolling
    }
}

impl Path {
    /// Resolves one contact.
    #[inline]
    pub fn direction(
        &self,
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        let sin_cos = math::sin_cos(contact.contact_angle);
        self.resolved(sin_cos, groove_path, contact, groove)
    }

    /// [`Self::direction`] by the kernel that a constant can take.
    pub const fn constant_direction(
        &self,
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        let sin_cos = constant::sin_cos(contact.contact_angle);
        self.resolved(sin_cos, groove_path, contact, groove)
    }

    #[inline]
    const fn resolved(
        &self,
        (sine, cosine): (f32, f32),
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        Direction {
            sine,
            cosine,
            reach: groove_path.path_over_rolling - groove.sign() * self.cos_lead * cosine,
            grip: self.axis_binormal * cosine + self.axis_normal * sine,
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
        }
    }

    /// Directions of both contacts, or the field that keeps the ball from rolling.
    pub const fn checked_directions(
        &self,
        parameters: &KinematicsParameters,
    ) -> Result<(Direction, Direction), Error> {
        let screw = self.constant_direction(&self.screw, parameters.screw(), Groove::Screw);
        let nut = self.constant_direction(&self.nut, parameters.nut(), Groove::Nut);
        attempt!(self.check(&screw, &self.screw, Groove::Screw, parameters));
        attempt!(self.check(&nut, &self.nut, Groove::Nut, parameters));
        Ok((screw, nut))
    }

    const fn check(
        &self,
        direction: &Direction,
        groove_path: &GroovePath,
        groove: Groove,
        parameters: &KinematicsParameters,
    ) -> Result<(), Error> {
        let (angle_field, angle, radius_field) = match groove {
            Groove::Screw => (
                "contact_angle_screw",
                parameters.contact_angle_screw,
                "rolling_radius_screw",
            ),
            Groove::Nut => (
                "contact_angle_nut",
                parameters.contact_angle_nut,
                "rolling_radius_nut",
            ),
        };
        if !direction.grips() {
            return Err(Error::OutOfRange {
                field: angle_field,
                value: angle,
                allowed: Range::new(
                    self.last_grip(parameters.pitch_angle, -FRAC_PI_2),
                    self.last_grip(parameters.pitch_angle, FRAC_PI_2),
                ),
            });
        }
        if !direction.reaches(groove_path) {
            // A >= 0.1 q, that is r' cos(alpha) cos^2(psi) <= 0.9 r_m, with q = r_m / cos(psi).
            let limit =
                (1.0 - LEAST_REACH) * self.radius / (self.cos_lead * direction.cosine.abs());
            return Err(Error::folded(
                radius_field,
                groove_path.rolling_radius,
                0.25 * parameters.ball_diameter,
                limit,
            ));
        }
        Ok(())
    }

    /// The contact angle, rad, next to `bound` at which the ball still grips: `b = h cos(alpha) + sin(beta) sin(alpha)` is a cosine about the pitch
    /// angle, above 0.87 there, and halving the way to the bound finds the one end.
    const fn last_grip(&self, pitch_angle: f32, bound: f32) -> f32 {
        const HALVINGS: u32 = 24;
        if self.grip_at(bound) >= LEAST_GRIP {
            return bound;
        }
        let (mut inside, mut outside) = (pitch_angle, bound);
        let mut halving = 0;
        while halving < HALVINGS {
            let middle = 0.5 * (inside + outside);
            if self.grip_at(middle) >= LEAST_GRIP {
                inside = middle;
            } else {
                outside = middle;
            }
            halving += 1;
        }
        inside
    }

    const fn grip_at(&self, contact_angle: f32) -> f32 {
        let (sine, cosine) = constant::sin_cos(contact_angle);
        self.axis_binormal * cosine + self.axis_normal * sine
    }
}
