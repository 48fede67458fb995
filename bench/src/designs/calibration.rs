//! Table `[calibration]` of a design file: what a measured trace has told of a screw beyond its own keys.

use epas_friction::defaults;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters};
use serde::Deserialize;

/// Table `[calibration]`, as it is written.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CalibrationTable {
    /// Friction coefficient at high speed.
    full_film: Option<f32>,
    /// Nut speed at which half of the difference is gone, rad/s.
    half_share_speed: Option<f32>,
    /// Temperature of the half-share speed, K.
    reference_temperature: Option<f32>,
    /// Factor of both coefficients in the positive direction.
    forward: Option<f32>,
    /// The same in the negative one.
    backward: Option<f32>,
    /// Turn from no friction to full sliding at the reference load, rad.
    breakaway_angle: Option<f32>,
    /// Axial load of the breakaway angle, N.
    reference_load: Option<f32>,
    /// Inertia of all that turns, kg m².
    inertia: Option<f32>,
    /// Drag without load over the speed, N m s/rad.
    drag: Option<f32>,
    /// Offset of the torque, N m.
    offset: Option<f32>,
    /// Torque of the axial load over that of a screw without friction.
    gain: Option<f32>,
    /// Free play of the nut, rad.
    backlash: Option<f32>,
    /// Waves of the torque over a turn.
    harmonics: Option<Vec<Harmonic>>,
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

/// What a trace has told of a screw beside its design, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibrated {
    /// Friction coefficient by speed and direction; none where it is one number.
    pub coefficient: Option<CoefficientParameters>,
    /// Turn from no friction to full sliding, rad.
    pub breakaway_angle: Option<f32>,
    /// Axial load of the breakaway angle, N, 0 to 1e6.
    pub reference_load: Option<f32>,
    /// Inertia of all that turns, kg m², 1e-9 to 1e3.
    pub inertia: Option<f32>,
    /// Drag without load over the speed, N m s/rad, -1e3 to 1e3.
    pub drag: Option<f32>,
    /// Offset of the torque, N m, -1e3 to 1e3.
    pub offset: Option<f32>,
    /// Torque of the axial load over that of a screw without friction, 0.1 to 10.
    pub gain: Option<f32>,
    /// Free play of the nut, rad, 0 to 10.
    pub backlash: Option<f32>,
    /// Waves of the torque over a turn.
    pub harmonics: Vec<Harmonic>,
}

/// Amplitudes, offset and drag: those of the limits of a torque, far above any screw's.
const TORQUE: (f32, f32) = (-1e3, 1e3);

/// Temperature at which everything that a design file does not say holds, K.
const TEMPERATURE: f32 = 293.15;

/// A value within its range.
fn checked(field: &str, value: f32, (low, high): (f32, f32)) -> Result<f32, String> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(format!(
            "{field} = {value} is out of range; allowed: {low} to {high}"
        ))
    }
}

impl CalibrationTable {
    /// What the table says of a screw with this friction coefficient at standstill.
    ///
    /// # Errors
    /// The field that is out of range.
    pub fn checked(self, friction: f32) -> Result<Calibrated, String> {
        let within = |field: &str, value: Option<f32>, range| {
            value.map(|value| checked(field, value, range)).transpose()
        };
        let coefficient = self.coefficient(friction)?;
        let harmonics = self.harmonics.unwrap_or_default();
        for wave in &harmonics {
            if !(1..=64).contains(&wave.order) {
                let order = wave.order;
                return Err(format!("order = {order} is out of range; allowed: 1 to 64"));
            }
            checked("cosine", wave.cosine, TORQUE)?;
            checked("sine", wave.sine, TORQUE)?;
        }
        Ok(Calibrated {
            coefficient,
            breakaway_angle: within("breakaway_angle", self.breakaway_angle, (1e-9, 1e3))?,
            reference_load: within("reference_load", self.reference_load, (0.0, 1e6))?,
            inertia: within("inertia", self.inertia, (1e-9, 1e3))?,
            drag: within("drag", self.drag, TORQUE)?,
            offset: within("offset", self.offset, TORQUE)?,
            gain: within("gain", self.gain, (0.1, 10.0))?,
            backlash: within("backlash", self.backlash, (0.0, 10.0))?,
            harmonics,
        })
    }

    /// The law of the friction coefficient, where one of its keys is there.
    fn coefficient(&self, friction: f32) -> Result<Option<CoefficientParameters>, String> {
        let Self {
            full_film,
            half_share_speed,
            reference_temperature,
            forward,
            backward,
            ..
        } = *self;
        match (full_film, half_share_speed) {
            (Some(_), None) => return Err("half_share_speed is missing beside full_film".into()),
            (None, Some(_)) => return Err("full_film is missing beside half_share_speed".into()),
            (None, None) if forward.is_none() && backward.is_none() => {
                return match reference_temperature {
                    None => Ok(None),
                    Some(_) => Err(
                        "reference_temperature is that of half_share_speed, which is missing"
                            .into(),
                    ),
                };
            }
            _ => {}
        }
        let parameters = CoefficientParameters {
            boundary: friction,
            full_film: full_film.unwrap_or(friction),
            half_share_speed: half_share_speed.unwrap_or(1.0),
            reference_temperature: reference_temperature.unwrap_or(TEMPERATURE),
            viscosity: defaults::VISCOSITY,
            forward: forward.unwrap_or(1.0),
            backward: backward.unwrap_or(1.0),
            churning: 0.0,
        };
        CoefficientLaw::new(&parameters).map_err(|error| error.to_string())?;
        Ok(Some(parameters))
    }
}
