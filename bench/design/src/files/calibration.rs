//! Table `[calibration]` of a design file: what a measured trace has told of a screw beyond the keys of its design.

use serde::Deserialize;

/// What a measured trace has told of a screw; what is not there is as without a calibration.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibrated {
    /// Friction coefficient on a full film over that at standstill, which is the design's `friction`; 1e-3 to 1e3.
    pub full_film_ratio: Option<f32>,
    /// Nut speed at which half of the difference is gone, at the reference temperature, rad/s, 1e-3 to 1e4.
    pub half_share_speed: Option<f32>,
    /// Temperature of the half-share speed, K, 160 to 500.
    pub reference_temperature: Option<f32>,
    /// Temperature at which the lubricant's viscosity has its pole, K, 1 to 490, at least 10 below the reference temperature.
    pub viscosity_pole: Option<f32>,
    /// Coefficients are `1 + this` times as large in the positive direction, `1 - this` in the negative one; -0.9 to 0.9.
    pub direction_asymmetry: Option<f32>,
    /// Turn from no friction to full sliding at the reference load, rad, 1e-9 to 1e3.
    pub breakaway_angle: Option<f32>,
    /// Axial load of the breakaway angle, N, 0 to 1e6.
    pub reference_load: Option<f32>,
    /// How elements of the memory follow the load; in proportion where it is not there.
    pub elements: Option<ElementsName>,
    /// Largest axial load up to which elements come into contact with it, N, 1e-3 to 1e6: where they do not follow in proportion.
    pub largest_load: Option<f32>,
    /// Free play between the sensor's angle and the nut's, rad, 0 to 10.
    pub backlash: Option<f32>,
    /// Inertia of all that turns, about the nut's axis, kg m², 0 to 1e3.
    pub inertia: Option<f32>,
    /// Drag without a load over the speed, N m s/rad, -1e3 to 1e3.
    pub drag: Option<f32>,
    /// Torque of churned lubricant over its viscosity and the nut's speed, m³, 0 to 1.
    pub churning: Option<f32>,
    /// Lubricant drag of the rolling contacts over that of the default grease, 0 to 100; none where it is not there.
    pub rolling_drag: Option<f32>,
    /// Torque that the motor's channel shows without any, N m, -1e3 to 1e3.
    pub offset: Option<f32>,
    /// Torque of the load over that of a screw without friction, -10 to 10.
    pub gain: Option<f32>,
    /// Waves of the torque over a turn, at the reference load.
    #[serde(default)]
    pub harmonics: Vec<Harmonic>,
}

/// How elements follow the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ElementsName {
    /// Constant shares of the friction of gross sliding: a preloaded screw.
    Proportional,
    /// Springs that come into contact with the load: any load, without a preload.
    LoadExact,
    /// The same at the load that both flanks of a preloaded nut share; at a reference load of none.
    Preloaded,
}

/// A wave of the friction torque over the turn of the nut.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Harmonic {
    /// Waves in a turn, 1 to 64.
    pub order: u8,
    /// Amplitude with the cosine of the angle, N m, -1e3 to 1e3.
    #[serde(default)]
    pub cosine: f32,
    /// Amplitude with the sine, N m, -1e3 to 1e3.
    #[serde(default)]
    pub sine: f32,
}

/// Torques over what they belong to: those of the limits of a design, far above any screw's.
const TORQUE: (f32, f32) = (-1e3, 1e3);

/// Reference temperature where a file gives none, K: that of the default lubricant.
pub const REFERENCE_TEMPERATURE: f32 = epas_friction::defaults::COEFFICIENT.reference_temperature;

/// Least distance of the viscosity's pole below the reference temperature, K.
const ABOVE_POLE: f32 = 10.0;

/// Fails where a value is out of its range or no number.
fn check(field: &str, value: f32, (low, high): (f32, f32)) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!(
            "{field} = {value} is out of range; allowed: {low} to {high}"
        ))
    }
}

/// Temperatures of a screw, K.
pub const TEMPERATURES: (f32, f32) = (160.0, 500.0);

impl Calibrated {
    /// The same, checked.
    pub fn checked(self) -> Result<Self, String> {
        let ranges = [
            ("full_film_ratio", self.full_film_ratio, (1e-3, 1e3)),
            ("half_share_speed", self.half_share_speed, (1e-3, 1e4)),
            (
                "reference_temperature",
                self.reference_temperature,
                TEMPERATURES,
            ),
            ("viscosity_pole", self.viscosity_pole, (1.0, 490.0)),
            ("direction_asymmetry", self.direction_asymmetry, (-0.9, 0.9)),
            ("breakaway_angle", self.breakaway_angle, (1e-9, 1e3)),
            ("reference_load", self.reference_load, (0.0, 1e6)),
            ("largest_load", self.largest_load, (1e-3, 1e6)),
            ("backlash", self.backlash, (0.0, 10.0)),
            ("inertia", self.inertia, (0.0, 1e3)),
            ("drag", self.drag, TORQUE),
            ("churning", self.churning, (0.0, 1.0)),
            ("rolling_drag", self.rolling_drag, (0.0, 100.0)),
            ("offset", self.offset, TORQUE),
            ("gain", self.gain, (-10.0, 10.0)),
        ];
        for (field, value, range) in ranges {
            value.map_or(Ok(()), |value| check(field, value, range))?;
        }
        for wave in &self.harmonics {
            check("order", wave.order.into(), (1.0, 64.0))?;
            check("cosine", wave.cosine, TORQUE)?;
            check("sine", wave.sine, TORQUE)?;
        }
        let film = ("full_film_ratio", self.full_film_ratio.is_some());
        let speed = ("half_share_speed", self.half_share_speed.is_some());
        let angle = ("breakaway_angle", self.breakaway_angle.is_some());
        let load = ("largest_load", self.largest_load.is_some());
        for ((field, there), (other, beside)) in [(speed, film), (film, speed), (angle, load)] {
            if beside && !there {
                return Err(format!("{field} is missing beside {other}"));
            }
        }
        let exact = self
            .elements
            .is_some_and(|elements| elements != ElementsName::Proportional);
        if exact != self.largest_load.is_some() {
            return Err("largest_load is that of elements that do not follow the load in proportion: both or none".into());
        }
        let reference = self.reference_temperature.unwrap_or(REFERENCE_TEMPERATURE);
        if let Some(pole) = self.viscosity_pole {
            check("viscosity_pole", pole, (1.0, reference - ABOVE_POLE))?;
        }
        Ok(self)
    }

    /// Keys with which friction that remembers follows it, those that are there: those of the memory, and of the law with it.
    pub fn remembered(&self, with_law: bool) -> Vec<&'static str> {
        [
            (true, "full_film_ratio", self.full_film_ratio),
            (true, "half_share_speed", self.half_share_speed),
            (true, "viscosity_pole", self.viscosity_pole),
            (true, "direction_asymmetry", self.direction_asymmetry),
            (false, "breakaway_angle", self.breakaway_angle),
            (false, "backlash", self.backlash),
            (true, "churning", self.churning),
            (true, "rolling_drag", self.rolling_drag),
        ]
        .into_iter()
        .filter(|(of_law, _, value)| value.is_some() && (with_law || !of_law))
        .map(|(_, key, _)| key)
        .collect()
    }

    /// Whether friction follows the temperature.
    pub fn follows_temperature(&self) -> bool {
        let drags = |of: Option<f32>| of.is_some_and(|of| of > 0.0);
        self.full_film_ratio.is_some()
            || drags(self.rolling_drag)
            || (self.has_law() && drags(self.churning))
    }

    /// Whether friction follows speed or direction.
    pub const fn has_law(&self) -> bool {
        self.full_film_ratio.is_some()
            || self.direction_asymmetry.is_some()
            || self.rolling_drag.is_some()
    }
}
