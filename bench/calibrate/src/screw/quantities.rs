//! Everything of a screw that a trace may tell: names, units, bounds.

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

/// A quantity that does not enter linearly.
#[derive(Clone, Copy, Debug)]
pub struct Nonlinear {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// How it is stepped.
    pub scale: Scale,
    /// Its place.
    pub of: fn(&mut Values) -> &mut f64,
}

/// A quantity that enters linearly.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Smallest and largest value.
    pub bounds: (f64, f64),
    /// What it multiplies.
    pub factor: Factor,
    /// Its place.
    pub of: fn(&mut Values) -> &mut f64,
}

/// What a linear quantity multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// Acceleration.
    Acceleration,
    /// Speed.
    Speed,
    /// Speed times viscosity.
    Viscosity,
    /// Lubricant drag of rolling contacts under the default grease.
    RollingDrag,
    /// One.
    One,
    /// Torque of the load without friction.
    Load,
    /// Sum of both flanks' loads over that at the reference load, times the cosine of so many angles.
    Cosine(u8),
    /// The same with the sine.
    Sine(u8),
}

/// The nonlinear ones, in the order in which they are told.
pub const NONLINEAR: [Nonlinear; 10] = [
    nonlinear("friction", "", Scale::Logarithmic, |v| &mut v.friction),
    nonlinear("full_film_ratio", "", Scale::Linear, |v| {
        &mut v.full_film_ratio
    }),
    nonlinear("half_share_speed", "rad/s", Scale::Logarithmic, |v| {
        &mut v.half_share_speed
    }),
    nonlinear("viscosity_pole", "K", Scale::Linear, |v| {
        &mut v.viscosity_pole
    }),
    nonlinear("direction_asymmetry", "", Scale::Linear, |v| {
        &mut v.direction_asymmetry
    }),
    nonlinear("hysteresis_loss", "", Scale::Linear, |v| {
        &mut v.hysteresis_loss
    }),
    nonlinear("lubricant_drag", "N", Scale::Linear, |v| {
        &mut v.lubricant_drag
    }),
    nonlinear("preload", "N", Scale::Logarithmic, |v| &mut v.preload),
    nonlinear("breakaway_angle", "rad", Scale::Logarithmic, |v| {
        &mut v.breakaway_angle
    }),
    nonlinear("backlash", "rad", Scale::Linear, |v| &mut v.backlash),
];

/// The linear ones, in the order in which they are told.
pub const LINEAR: [Linear; 10] = {
    use Factor::{Acceleration, Cosine, Load, One, RollingDrag, Sine, Speed, Viscosity};
    const FREE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
    const POSITIVE: (f64, f64) = (0.0, f64::INFINITY);
    [
        linear("inertia", "kg m^2", POSITIVE, Acceleration, |v| {
            &mut v.inertia
        }),
        linear("drag", "N m s/rad", FREE, Speed, |v| &mut v.drag),
        linear("churning", "m^3", POSITIVE, Viscosity, |v| &mut v.churning),
        linear("rolling_drag", "", POSITIVE, RollingDrag, |v| {
            &mut v.rolling_drag
        }),
        linear("offset", "N m", FREE, One, |v| &mut v.offset),
        linear("gain", "", FREE, Load, |v| &mut v.gain),
        linear("cosine_1", "N m", FREE, Cosine(1), |v| {
            let [first, ..] = &mut v.harmonics;
            first
        }),
        linear("sine_1", "N m", FREE, Sine(1), |v| {
            let [_, second, ..] = &mut v.harmonics;
            second
        }),
        linear("cosine_2", "N m", FREE, Cosine(2), |v| {
            let [_, _, third, _] = &mut v.harmonics;
            third
        }),
        linear("sine_2", "N m", FREE, Sine(2), |v| {
            let [.., last] = &mut v.harmonics;
            last
        }),
    ]
};

/// Standard deviation of the pole of a lubricant's viscosity, K, where nobody has told the lubricant: oils with viscosity indices of 0 to 140
/// have it at 178 to 227 K, by their viscosities at 40 and 100 degrees Celsius, and an even spread over these has 14 K.
const POLE_DEVIATION: f64 = 15.0;

/// Standard deviation of what is assumed of a quantity that others depend on, where it is neither estimated nor set.
pub fn assumed_deviation(name: &str) -> Option<f64> {
    (name == "viscosity_pole").then_some(POLE_DEVIATION)
}

/// Word that stands for all waves over the turn in a request.
pub const HARMONICS: &str = "harmonics";

const fn nonlinear(
    name: &'static str,
    unit: &'static str,
    scale: Scale,
    of: fn(&mut Values) -> &mut f64,
) -> Nonlinear {
    Nonlinear {
        name,
        unit,
        scale,
        of,
    }
}

const fn linear(
    name: &'static str,
    unit: &'static str,
    bounds: (f64, f64),
    factor: Factor,
    of: fn(&mut Values) -> &mut f64,
) -> Linear {
    Linear {
        name,
        unit,
        bounds,
        factor,
        of,
    }
}

impl Nonlinear {
    /// The one of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        NONLINEAR.iter().find(|quantity| quantity.name == name)
    }

    /// Its value.
    pub fn value(&self, values: &Values) -> f64 {
        let mut values = *values;
        *(self.of)(&mut values)
    }
}

impl Linear {
    /// The one of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        LINEAR.iter().find(|quantity| quantity.name == name)
    }

    /// Its value.
    pub fn value(&self, values: &Values) -> f64 {
        let mut values = *values;
        *(self.of)(&mut values)
    }
}

impl Factor {
    /// Whether it is a wave over the turn.
    pub const fn is_wave(self) -> bool {
        matches!(self, Self::Cosine(_) | Self::Sine(_))
    }
}

/// Names of everything, for a request that is wrong.
pub fn names() -> impl Iterator<Item = &'static str> {
    let nonlinear = NONLINEAR.iter().map(|quantity| quantity.name);
    nonlinear.chain(LINEAR.iter().map(|quantity| quantity.name))
}

/// Name, unit and value of everything.
pub fn all(values: &Values) -> impl Iterator<Item = (&'static str, &'static str, f64)> {
    let nonlinear = NONLINEAR
        .iter()
        .map(|of| (of.name, of.unit, of.value(values)));
    let linear = LINEAR.iter().map(|of| (of.name, of.unit, of.value(values)));
    nonlinear.chain(linear)
}

#[cfg(test)]
mod tests {
    use epas_friction::defaults;
    use epas_friction::law::coefficient::{OilData, Viscosity};

    use super::POLE_DEVIATION;

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
