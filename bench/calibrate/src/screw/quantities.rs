//! Everything of a screw that a trace may tell: names, units, bounds.

use epas_design::CagedDesign;
use epas_friction::defaults;

use crate::fit::problem::Scale;

/// Values of everything that the model of a screw on a rig has, estimated or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    /// Friction coefficient of ball and groove at standstill: boundary lubrication.
    pub friction: f64,
    /// Friction coefficient on a full film over that at standstill.
    pub full_film_ratio: f64,
    /// Nut speed at which half of the difference is gone, at the reference temperature, rad/s.
    pub half_share_speed: f64,
    /// Temperature at which the lubricant's viscosity has its pole, K.
    pub viscosity_pole: f64,
    /// Coefficients are `1 + this` times as large in the positive direction, `1 - this` in the negative one.
    pub direction_asymmetry: f64,
    /// Share of the elastic energy that a rolling contact loses.
    pub hysteresis_loss: f64,
    /// Drag of the lubricant on one contact under 100 N, N.
    pub lubricant_drag: f64,
    /// Force of each contact without a load, N.
    pub preload: f64,
    /// Turn from no friction to full sliding at the reference load, rad.
    pub breakaway_angle: f64,
    /// Free play between the sensor's angle and the nut's, rad.
    pub backlash: f64,
    /// Inertia of all that turns, about the nut's axis, kg m².
    pub inertia: f64,
    /// Drag without a load over the speed, N m s.
    pub drag: f64,
    /// Torque of churned lubricant over its viscosity and the nut's speed, m³.
    pub churning: f64,
    /// Lubricant drag of the rolling contacts over that of the default grease.
    pub rolling_drag: f64,
    /// Torque that the motor's channel shows without any, N m.
    pub offset: f64,
    /// Torque of the load over `lead/2 pi` times the measured load.
    pub gain: f64,
    /// Waves of the friction over a turn at the reference load, N m: cosine and sine of the first order, then of the second.
    pub harmonics: [f64; 4],
}

impl Values {
    /// Those of a design; what a design does not know is that of a mechanism without.
    pub fn of(caged: &CagedDesign) -> Self {
        Self {
            friction: caged.friction.into(),
            full_film_ratio: 1.0,
            half_share_speed: 1.0,
            viscosity_pole: defaults::VISCOSITY.pole().into(),
            direction_asymmetry: 0.0,
            hysteresis_loss: caged.rolling_resistance.hysteresis_loss.into(),
            lubricant_drag: caged.rolling_resistance.lubricant_drag.into(),
            preload: 0.0,
            breakaway_angle: 1.0,
            backlash: 0.0,
            inertia: 0.0,
            drag: 0.0,
            churning: 0.0,
            rolling_drag: 0.0,
            offset: 0.0,
            gain: 1.0,
            harmonics: [0.0; 4],
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    pub name: &'static str,
    pub unit: &'static str,
    pub kind: Kind,
    pub of: fn(&mut Values) -> &mut f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Nonlinear(Scale),
    /// As what multiplies a factor; its least value.
    Linear(Factor, f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    Acceleration,
    Speed,
    Viscosity,
    /// Lubricant drag of rolling contacts under the default grease.
    RollingDrag,
    One,
    Load,
    /// Sum of both flanks' loads over that at the reference load, times cosine and sine of one angle, then of two.
    Wave(usize),
}

/// All of them, in the order in which they are told: what does not enter linearly first.
pub const QUANTITIES: [Quantity; 20] = {
    use Factor::{Acceleration, Load, One, RollingDrag, Speed, Viscosity, Wave};
    use Kind::{Linear, Nonlinear};
    const FREE: f64 = f64::NEG_INFINITY;
    const LOGARITHM: Kind = Nonlinear(Scale::Logarithmic);
    const VALUE: Kind = Nonlinear(Scale::Linear);
    [
        quantity("friction", "", LOGARITHM, |v| &mut v.friction),
        quantity("full_film_ratio", "", VALUE, |v| &mut v.full_film_ratio),
        quantity("half_share_speed", "rad/s", LOGARITHM, |v| {
            &mut v.half_share_speed
        }),
        quantity("viscosity_pole", "K", VALUE, |v| &mut v.viscosity_pole),
        quantity("direction_asymmetry", "", VALUE, |v| {
            &mut v.direction_asymmetry
        }),
        quantity("hysteresis_loss", "", VALUE, |v| &mut v.hysteresis_loss),
        quantity("lubricant_drag", "N", VALUE, |v| &mut v.lubricant_drag),
        quantity("preload", "N", LOGARITHM, |v| &mut v.preload),
        quantity("breakaway_angle", "rad", LOGARITHM, |v| {
            &mut v.breakaway_angle
        }),
        quantity("backlash", "rad", VALUE, |v| &mut v.backlash),
        quantity("inertia", "kg m^2", Linear(Acceleration, 0.0), |v| {
            &mut v.inertia
        }),
        quantity("drag", "N m s/rad", Linear(Speed, FREE), |v| &mut v.drag),
        quantity("churning", "m^3", Linear(Viscosity, 0.0), |v| {
            &mut v.churning
        }),
        quantity("rolling_drag", "", Linear(RollingDrag, 0.0), |v| {
            &mut v.rolling_drag
        }),
        quantity("offset", "N m", Linear(One, FREE), |v| &mut v.offset),
        quantity("gain", "", Linear(Load, FREE), |v| &mut v.gain),
        quantity("cosine_1", "N m", Linear(Wave(0), FREE), |v| {
            &mut v.harmonics[0]
        }),
        quantity("sine_1", "N m", Linear(Wave(1), FREE), |v| {
            &mut v.harmonics[1]
        }),
        quantity("cosine_2", "N m", Linear(Wave(2), FREE), |v| {
            &mut v.harmonics[2]
        }),
        quantity("sine_2", "N m", Linear(Wave(3), FREE), |v| {
            &mut v.harmonics[3]
        }),
    ]
};

const fn quantity(
    name: &'static str,
    unit: &'static str,
    kind: Kind,
    of: fn(&mut Values) -> &mut f64,
) -> Quantity {
    Quantity {
        name,
        unit,
        kind,
        of,
    }
}

impl Quantity {
    pub fn named(name: &str) -> Option<&'static Self> {
        QUANTITIES.iter().find(|quantity| quantity.name == name)
    }

    pub fn value(&self, values: &Values) -> f64 {
        let mut values = *values;
        *(self.of)(&mut values)
    }

    #[must_use]
    pub fn with(&self, value: f64, values: &Values) -> Values {
        let mut values = *values;
        *(self.of)(&mut values) = value;
        values
    }

    pub const fn factor(&self) -> Option<Factor> {
        match self.kind {
            Kind::Linear(factor, _) => Some(factor),
            Kind::Nonlinear(_) => None,
        }
    }
}

pub const HARMONICS: &str = "harmonics";

pub fn names() -> impl Iterator<Item = &'static str> {
    QUANTITIES.iter().map(|quantity| quantity.name)
}

/// Standard deviation of the pole of a lubricant's viscosity, K, where nobody has told the lubricant: oils with viscosity indices of 0 to 140
/// have it at 178 to 227 K, by their viscosities at 40 and 100 degrees Celsius, and an even spread over these has 14 K.
const POLE_DEVIATION: f64 = 15.0;

/// Standard deviation of what is assumed of a quantity that others depend on, where it is neither estimated nor set.
pub fn assumed_deviation(name: &str) -> Option<f64> {
    (name == "viscosity_pole").then_some(POLE_DEVIATION)
}

#[cfg(test)]
mod tests {
    use epas_friction::law::coefficient::{OilData, Viscosity};

    use super::{POLE_DEVIATION, defaults};

    /// Oils of viscosity indices 0, 50 and 100 with 8.86 mm²/s at 100 degrees Celsius (the worked example of ASTM D2270 has 119.94 and
    /// 69.48 mm²/s at 40 degrees for 0 and 100, from which 94.71 follows for 50), and synthetic ones of about 140 and 150: within two
    /// standard deviations of the assumed pole, and as far apart as an even spread has it.
    #[test]
    fn poles_of_oils_lie_about_the_assumed_one() {
        let pole = |cold: f32, warm: f32| {
            let oil = OilData {
                kinematic_viscosity_40: 1e-6 * cold,
                kinematic_viscosity_100: 1e-6 * warm,
                density: 850.0,
                pour_point: 233.15,
            };
            f64::from(Viscosity::of_oil(&oil).unwrap().pole())
        };
        let poles = [
            pole(119.94, 8.86),
            pole(94.71, 8.86),
            pole(69.48, 8.86),
            pole(48.0, 8.0),
            pole(100.0, 14.5),
        ];
        let assumed = f64::from(defaults::COEFFICIENT.viscosity.pole());
        for pole in poles {
            assert!((pole - assumed).abs() < 2.0 * POLE_DEVIATION, "{poles:?}");
        }
        let spread = (poles[0] - poles[3]) / 12_f64.sqrt();
        assert!((spread - POLE_DEVIATION).abs() < 2.0, "{poles:?}");
    }
}
