//! The friction coefficient by a rational form: its parameters, the law that they fold into, and the law at one temperature.

use super::drag::RollingDrag;
use super::model::DirectionalCoefficient;
use super::viscosity::{TEMPERATURE, Viscosity, fifth_root};
use crate::error::{Error, Range, attempt, in_range};
use crate::ranges;

/// Least and largest half-share speed, rad/s, at every temperature: beyond either end friction is nearly that of a full film, or of none.
const HALF_SHARE_SPEED: Range = Range::new(1e-3, 1e4);

const DIRECTION: Range = Range::new(0.1, 10.0);

/// Churning torque over viscosity and speed, m³.
const CHURNING: Range = Range::new(0.0, 1.0);

/// Parameters of a friction coefficient; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CoefficientParameters {
    /// Coefficient `mu_b` at standstill, 1e-6 to 1: boundary lubrication, asperities carry.
    pub boundary: f32,
    /// Coefficient `mu_f` at high speed, 1e-6 to 1: a film carries.
    pub full_film: f32,
    /// Speed of the nut at which half of the difference is gone, at the reference temperature, rad/s, 1e-3 to 1e4: in proportion to
    /// 1/(viscosity x pitch radius) and to roughness to the power of 3/2.
    pub half_share_speed: f32,
    /// Temperature of the half-share speed, K, from 10 K above the pole of the viscosity's formula to 500.
    pub reference_temperature: f32,
    /// The lubricant's viscosity by temperature.
    pub viscosity: Viscosity,
    /// Factor of both coefficients in the positive direction, 0.1 to 10; the product is within 1e-6 to 1.
    pub forward: f32,
    /// Factor in the negative direction.
    pub backward: f32,
    /// Torque of churned lubricant over its viscosity and the nut's speed, m³, 0 to 1, beside the coefficient.
    pub churning: f32,
    /// Lubricant drag of the rolling contacts, beside the coefficient.
    pub drag: RollingDrag,
}

/// Friction coefficient by speed, temperature and direction: constants.
///
/// ```text
/// mu(omega_N, Theta) = d [mu_f + (mu_b - mu_f)/(1 + |omega_N|/w_m(Theta))]
/// w_m(Theta) = w_ref ((Theta - Theta_s)/(Theta_ref - Theta_s))^5
/// ```
///
/// `d` is the factor of the direction, `Theta` the temperature, `Theta_s` the pole of [`Viscosity`]: the speed at which a
/// film has formed goes with the inverse of the viscosity. `w_m` stays within 1e-3 to 1e4 rad/s, the temperature between
/// [`Viscosity::floor`] and 500 K. Where both coefficients are equal, and the direction's factors 1, the coefficient is that number, to the bit.
///
/// Largest errors over the difference of both coefficients, 0.1 to 500 rad/s, against the film's thickness by Hamrock and Dowson
/// 1977 with the asperities' share `1/(1 + film/roughness)^2` of Olver and Spikes 1998: the form alone 0.068 (rms 0.039), with
/// the default viscosity's own error 0.080 from -20 to 120 degrees Celsius and 0.057 below. Starvation, thinning by shear, and
/// the growth of friction at rest are in neither.
///
/// ```
/// use epas_friction::defaults;
/// use epas_friction::law::coefficient::CoefficientLaw;
/// let law = CoefficientLaw::new(&defaults::COEFFICIENT)?;
/// let (cold, warm) = (law.at_temperature(253.15), law.at_temperature(353.15));
/// // At 5 rad/s a cold film carries, a warm one does not; cold grease resists rolling.
/// assert!(cold.at(5.0) < 0.065 && warm.at(5.0) > 0.115);
/// assert!(cold.drag_torque(5.0, 5e3, 0.0) > 20.0 * warm.drag_torque(5.0, 5e3, 0.0));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CoefficientLaw {
    forward: Sides,
    backward: Sides,
    /// `w_ref^(1/5)/(Theta_ref - Theta_s)`: its product with `Theta - Theta_s`, to the power of 5, is the half-share speed.
    scale: f32,
    /// `Theta_s`, K.
    pole: f32,
    /// Scaled distance from the pole at the coldest and at the warmest temperature.
    ends: [f32; 2],
    /// Churning torque over the speed, times the half-share speed, N m.
    churning: f32,
    drag: RollingDrag,
    /// `(eta_ref w_ref)^(-4/5)`: times the fourth power of the scaled distance from the pole it is `eta^-0.8`.
    fluidity: f32,
}

impl CoefficientParameters {
    /// One coefficient at every speed and temperature, in both directions, without churning and drag.
    #[must_use]
    pub const fn constant(friction: f32, viscosity: Viscosity) -> Self {
        Self {
            boundary: friction,
            full_film: friction,
            half_share_speed: 1.0,
            reference_temperature: 293.15,
            viscosity,
            forward: 1.0,
            backward: 1.0,
            churning: 0.0,
            drag: RollingDrag::NONE,
        }
    }
}

/// Temperatures above the viscosity's pole, times `scale`, between which the half-share speed stays within its range.
const fn ends(viscosity: &Viscosity, scale: f32) -> [f32; 2] {
    let pole = viscosity.pole();
    let coldest = (pole + fifth_root(HALF_SHARE_SPEED.minimum) / scale).max(viscosity.floor());
    let warmest = (pole + fifth_root(HALF_SHARE_SPEED.maximum) / scale).min(TEMPERATURE.maximum);
    [scale * (coldest - pole), scale * (warmest - pole)]
}

impl CoefficientLaw {
    /// Checks and folds a law.
    pub const fn new(parameters: &CoefficientParameters) -> Result<Self, Error> {
        let CoefficientParameters {
            boundary,
            full_film,
            half_share_speed,
            reference_temperature,
            viscosity,
            forward,
            backward,
            churning,
            drag,
        } = *parameters;
        attempt!(ranges::FRICTION.checked("boundary", boundary));
        attempt!(ranges::FRICTION.checked("full_film", full_film));
        let speed = attempt!(HALF_SHARE_SPEED.checked("half_share_speed", half_share_speed));
        let (floor, most) = (viscosity.floor(), TEMPERATURE.maximum);
        let reference = reference_temperature;
        attempt!(in_range("reference_temperature", reference, floor, most));
        attempt!(DIRECTION.checked("forward", forward));
        attempt!(DIRECTION.checked("backward", backward));
        let churning = attempt!(CHURNING.checked("churning", churning));
        let drag = attempt!(drag.checked());
        let pole = viscosity.pole();
        let scale = fifth_root(speed) / (reference - pole);
        let stiffness = viscosity.at(reference) * speed;
        let root = fifth_root(stiffness);
        Ok(Self {
            forward: attempt!(Sides::new(parameters, forward)),
            backward: attempt!(Sides::new(parameters, backward)),
            scale,
            pole,
            ends: ends(&viscosity, scale),
            churning: churning * stiffness,
            drag,
            fluidity: 1.0 / (root * root * (root * root)),
        })
    }

    /// One coefficient, 1e-6 to 1, at every speed and temperature, without churning.
    pub const fn constant(friction: f32) -> Result<Self, Error> {
        // Its lubricant has no effect.
        let viscosity = attempt!(Viscosity::through((313.15, 0.1), (373.15, 0.01), 233.15));
        Self::new(&CoefficientParameters::constant(friction, viscosity))
    }

    /// What [`Self::at_temperature`] computes with beside coefficients and drag, for a program in another language: scale, pole, both ends,
    /// churning, fluidity.
    #[doc(hidden)]
    #[must_use]
    pub const fn numbers(&self) -> [f32; 6] {
        let [coldest, warmest] = self.ends;
        [
            self.scale,
            self.pole,
            coldest,
            warmest,
            self.churning,
            self.fluidity,
        ]
    }

    /// Least and largest coefficient that the law gives, in either direction.
    pub const fn extremes(&self) -> (f32, f32) {
        let (low, high) = self.forward.ends();
        let (other_low, other_high) = self.backward.ends();
        (low.min(other_low), high.max(other_high))
    }

    /// The law at a temperature, K; below [`Viscosity::floor`], above 500 K and beyond the range of the half-share speed as there, NaN as the
    /// warmest. Cost: 5 multiplications and 1 division.
    #[inline]
    pub const fn at_temperature(&self, temperature: f32) -> CoefficientAtTemperature {
        let [coldest, warmest] = self.ends;
        let ratio = self.scale * (temperature - self.pole);
        let ratio = if ratio < warmest { ratio } else { warmest };
        // False for what is colder; NaN has become the warmest.
        let ratio = if ratio > coldest { ratio } else { coldest };
        let square = ratio * ratio;
        let half_share_speed = square * square * ratio;
        CoefficientAtTemperature {
            forward: self.forward,
            backward: self.backward,
            half_share_speed,
            churning: self.churning / half_share_speed,
            drag: self.drag,
            fluidity: self.fluidity * (square * square),
        }
    }
}

const LARGEST_SPEED: f32 = 1e6;

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Sides {
    full_film: f32,
    /// Boundary less full film.
    difference: f32,
}

/// Friction coefficient by speed and direction at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CoefficientAtTemperature {
    pub(super) forward: Sides,
    pub(super) backward: Sides,
    /// `w_m`, rad/s.
    pub(super) half_share_speed: f32,
    /// Churning torque over the speed, N m s.
    pub(super) churning: f32,
    pub(super) drag: RollingDrag,
    /// `eta^-0.8` with the viscosity in Pa s.
    pub(super) fluidity: f32,
}

impl Sides {
    pub(super) const fn new(
        parameters: &CoefficientParameters,
        factor: f32,
    ) -> Result<Self, Error> {
        let boundary = attempt!(ranges::FRICTION.checked("boundary", factor * parameters.boundary));
        let full_film =
            attempt!(ranges::FRICTION.checked("full_film", factor * parameters.full_film));
        Ok(Self {
            full_film,
            difference: boundary - full_film,
        })
    }

    pub(super) const fn ends(&self) -> (f32, f32) {
        let boundary = self.full_film + self.difference;
        if self.difference < 0.0 {
            (boundary, self.full_film)
        } else {
            (self.full_film, boundary)
        }
    }

    #[inline]
    const fn at(&self, share: f32) -> f32 {
        self.full_film + self.difference * share
    }
}

impl CoefficientAtTemperature {
    /// Friction coefficient at a speed of the nut, rad/s, in its direction; standstill and NaN count as forward, infinity as a full film.
    /// Monotone in the speed's size, also in f32. Cost: one division, 43 modelled cycles; 70 with [`CoefficientLaw::at_temperature`].
    #[inline]
    pub const fn at(&self, speed: f32) -> f32 {
        let sides = if speed < 0.0 {
            &self.backward
        } else {
            &self.forward
        };
        sides.at(self.share(speed))
    }

    /// Friction coefficients that either direction would have at a speed of this size.
    #[inline]
    pub const fn both(&self, speed: f32) -> DirectionalCoefficient {
        let share = self.share(speed);
        DirectionalCoefficient {
            forward: self.forward.at(share),
            backward: self.backward.at(share),
        }
    }

    /// Torque of churned lubricant, N m, with the sign of the speed that it opposes, rad/s, up to 1e6; NaN gives 0.
    #[inline]
    pub const fn churning_torque(&self, speed: f32) -> f32 {
        self.churning * within_speeds(speed)
    }

    /// Torque of viscous drag, N m, with the sign of the speed that it opposes, rad/s: of churned lubricant
    /// ([`Self::churning_torque`]) and of rolling contacts ([`RollingDrag`]) under an axial load and a preload's lift-off load, N, both not
    /// negative. Cost: two square roots, one division, 9 other operations.
    #[inline]
    pub fn drag_torque(&self, speed: f32, load: f32, lift_off: f32) -> f32 {
        let speed = within_speeds(speed);
        let rolling = self.drag.at(self.fluidity, speed.abs(), [load, lift_off]);
        self.churning * speed + rolling.copysign(speed)
    }

    /// Whether the drag of rolling contacts was fitted at a speed, rad/s ([`RollingDrag::FITTED_SPEED`]); a law without that drag holds at every speed.
    #[inline]
    #[must_use]
    pub const fn holds_drag(&self, speed: f32) -> bool {
        !(speed.abs() > RollingDrag::FITTED_SPEED && self.drag.torque > 0.0)
    }

    /// Drag of the rolling contacts, without a temperature.
    pub const fn drag(&self) -> RollingDrag {
        self.drag
    }

    /// Speed at which half of the difference is gone, rad/s.
    pub const fn half_share_speed(&self) -> f32 {
        self.half_share_speed
    }

    /// Steepest change of the coefficient with the speed, s/rad, at standstill; above 0 where friction rises.
    pub const fn steepest(&self) -> f32 {
        let difference = if self.forward.difference.abs() > self.backward.difference.abs() {
            self.forward.difference
        } else {
            self.backward.difference
        };
        -difference / self.half_share_speed
    }

    /// Part of the difference that is left at a speed: 1 at standstill, one half at the half-share speed.
    #[inline]
    const fn share(&self, speed: f32) -> f32 {
        let half = self.half_share_speed;
        let sum = half + speed.abs();
        half / if speed.is_nan() { half } else { sum }
    }
}

/// A speed within 1e6 rad/s; NaN gives 0.
#[inline]
const fn within_speeds(speed: f32) -> f32 {
    if speed >= LARGEST_SPEED {
        LARGEST_SPEED
    } else if speed <= -LARGEST_SPEED {
        -LARGEST_SPEED
    } else if speed >= 0.0 || speed < 0.0 {
        speed
    } else {
        0.0
    }
}
