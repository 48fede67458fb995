//! Friction of a Hertzian contact that slips in any direction and spins, in closed form.

use super::far::FarField;
use super::near::NearField;
use super::nodes::FAR;
use super::potential::Potential;
use crate::contact::integrals::checked_axis_ratio;
use crate::error::{Error, attempt};
use crate::math;

/// Dissipation of one contact with slip along both axes and spin: exact.
///
/// A contact of ball and groove with semi-axes `a >= b = k a` slips with `V_1` along its major axis
/// (across the ball path), with `V_2` along its minor axis (along the path) and spins with `w`. Its power
/// loss is the mean distance of the velocity centre from the points of the ellipse, weighed by the
/// pressure:
///
/// ```text
/// D = mu F a |w| P(x, z)        x = V_2/(a w)        z = V_1/(a w)
/// P = 3/16 (C0 + 2 C1 x² + 2 C2 z² - C3 x⁴ - 2 C4 x² z² - C5 z⁴)
/// ```
///
/// The Laplacian of a distance is its reciprocal, and the mean of the reciprocal is the potential of a
/// Hertzian pressure, an integral over the confocal ellipses. Integrated twice:
///
/// ```text
/// C1 = ∫ T/(1 + s)   C2 = ∫ T/(k² + s)   C3 = ∫ T/(1 + s)²   C4 = ∫ T/((1 + s)(k² + s))
/// C5 = ∫ T/(k² + s)²    T = sqrt(s/((1 + s)(k² + s)))    s from lambda to infinity
/// ```
///
/// `lambda` is the largest root of `x²/(1 + lambda) + z²/(k² + lambda) = 1`, zero inside the ellipse: there
/// `P` is a polynomial. By parts all follow from `C1` and `C2`. The derivatives of `P` by `lambda` vanish up
/// to the second, so that force and Hessian are those of the polynomial as well. These are the integrals
/// (3.16)-(3.18) and (3.68) of Lin 2019, which that dissertation evaluates by quadrature.
///
/// `C1` and `C2` are combinations of Carlson's integrals; they and `C5` are found at set-up and interpolated in
/// `sqrt(lambda)/(sqrt(lambda) + sqrt(k))`. Beyond two semi-major axes two terms of the multipole series
/// serve.
///
/// Input: axis ratio 0.02 to 0.95 at set-up; slips and spins up to 1e15 in the loop.
///
/// Largest errors against quadrature of the contact integral, axis ratios 0.05 to 0.95, slips of any direction
/// from 1e-4 to 1e4 semi-major axes times the spin (rms in brackets): forces 3.1e-4 (1.2e-5) of their limit,
/// moment 3.1e-4 (1.5e-5) of `mu F a`, power 1.4e-4 (9e-6) of itself, second derivatives 3.7e-3 (1.8e-4) of the
/// sum of those by the two slips. From an axis ratio of 0.2 on forces are within 6e-5; at 0.02 within 1e-3.
/// The largest ones arise where the far field takes over.
///
/// Cost in the loop: three square roots and two divisions inside the contact, four and three outside, where
/// three polynomials of ten terms are evaluated.
///
/// ```
/// use epas_friction::contact::SlipMap;
/// let map = SlipMap::new(0.25)?;
/// let (semi_major, spin) = (2e-4, 20.0);
/// let spinning = map.dissipation(0.0, 0.0, spin, semi_major, 0.0);
/// assert!((spinning.moment / semi_major - 0.4021).abs() < 1e-4); // 3/8 E
/// let sliding = map.dissipation(3.0, 4.0, 0.0, semi_major, 0.0);
/// assert!((sliding.across - 0.6).abs() < 1e-5 && (sliding.along - 0.8).abs() < 1e-5);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipMap {
    axis_ratio: f32,
    near: NearField,
    far: FarField,
}

/// One contact at given slip and spin, over `mu F`.
///
/// The Hessian of the potential by slip and spin is the form with the three stiffnesses of `dV_1 - tilt_across
/// dw` and `dV_2 - tilt_along dw`, plus `stick dw²`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipFriction {
    /// The potential, m/s; with no stick spin the power loss.
    pub potential: f32,
    /// Power loss, m/s: forces times slips and moment times spin.
    pub power: f32,
    /// Derivative by the slip across the track, -1 to 1.
    pub across: f32,
    /// Derivative by the slip along the track, -1 to 1.
    pub along: f32,
    /// Derivative by the spin, m.
    pub moment: f32,
    /// Second derivative by the slip across the track, s/m.
    pub stiffness_across: f32,
    /// Mixed second derivative by the two slips, s/m.
    pub stiffness_mixed: f32,
    /// Second derivative by the slip along the track, s/m.
    pub stiffness_along: f32,
    /// Slip across the track that keeps the velocity centre where it is, per spin, m.
    pub tilt_across: f32,
    /// Slip along the track that keeps the velocity centre where it is, per spin, m.
    pub tilt_along: f32,
    /// What the stick treatment adds along the spin, m s.
    pub stick: f32,
    /// `a W`: slip along the track that carries the velocity centre to the end of the ellipse, m/s.
    pub end_speed: f32,
}

impl SlipMap {
    /// Maps of a contact with the axis ratio `b/a`. For set-up: it evaluates elliptic integrals at eleven places.
    ///
    /// # Errors
    /// [`Error`] naming `axis_ratio` where it is not within 0.02 to 0.95.
    pub const fn new(axis_ratio: f32) -> Result<Self, Error> {
        let axis_ratio = attempt!(checked_axis_ratio(axis_ratio));
        Ok(Self {
            axis_ratio,
            near: NearField::new(axis_ratio),
            far: FarField::new(axis_ratio * axis_ratio),
        })
    }

    /// Axis ratio of the ellipse.
    #[inline]
    #[must_use]
    pub const fn axis_ratio(&self) -> f32 {
        self.axis_ratio
    }

    /// Friction over `mu F` at a slip across and along the track, m/s, and a spin, rad/s, of a contact with the
    /// semi-major axis `a`, m, with stick treated smoothly as in
    /// [`FrictionMap::dissipation`](crate::contact::FrictionMap::dissipation): `|w|` becomes
    /// `W = sqrt(w² + stick_spin²)` in the potential.
    ///
    /// Slips are those at the contact's centre. The friction force on the ball is `-mu F across`,
    /// `-mu F along`, the moment `-mu F moment`. `semi_major` must be positive. Of slips that are infinite or no
    /// number the forces are those of sliding; potential and power then are none either.
    #[inline]
    #[must_use]
    pub fn dissipation(
        &self,
        across: f32,
        along: f32,
        spin: f32,
        semi_major: f32,
        stick_spin: f32,
    ) -> SlipFriction {
        let stick2 = stick_spin * stick_spin + 1e-30;
        let end_speed = semi_major * math::sqrt(spin * spin + stick2);
        let inverse_end_speed = 1.0 / end_speed;
        let inverse_spin = semi_major * inverse_end_speed;
        let inverse_spin2 = inverse_spin * inverse_spin;
        let at = self.potential(along * inverse_end_speed, across * inverse_end_speed);

        let sliding = across * at.across + along * at.along;
        let arm = semi_major * at.moment;
        let spin_moment = arm * spin * inverse_spin;
        let tilt = spin * inverse_spin2;
        SlipFriction {
            potential: sliding + end_speed * at.moment,
            power: sliding + spin_moment * spin,
            across: at.across,
            along: at.along,
            moment: spin_moment,
            stiffness_across: at.across_across * inverse_end_speed,
            stiffness_mixed: at.mixed * inverse_end_speed,
            stiffness_along: at.along_along * inverse_end_speed,
            tilt_across: across * tilt,
            tilt_along: along * tilt,
            stick: arm * stick2 * inverse_spin * inverse_spin2,
            end_speed,
        }
    }

    /// Friction force over `mu F` under a slip across the track, where the spin gives the end of the major axis the speed
    /// `end_speed = a |w|`.
    #[inline]
    pub(crate) fn share_across(&self, slip: f32, end_speed: f32) -> f32 {
        let place = slip / end_speed;
        let square = place * place;
        if square <= FAR {
            self.near.share_across(place, square)
        } else {
            self.far
                .potential(0.0, place, square, self.near.square())
                .across
        }
    }

    /// The potential where the velocity centre lies at this place, over the semi-major axis, along and across the track.
    #[inline]
    fn potential(&self, along: f32, across: f32) -> Potential {
        let squares = (along * along, across * across);
        let distance2 = squares.0 + squares.1;
        // False for NaN.
        if distance2 <= FAR {
            self.near.potential(along, across, squares, distance2)
        } else {
            self.far
                .potential(along, across, distance2, self.near.square())
        }
    }
}
