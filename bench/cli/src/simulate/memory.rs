//! Friction that remembers, for every scene of a simulation: elements by the design, at the trace's mean load.

use epas_design::breakaway::{
    BearingBreakaway, Breakaway, BreakawayConfiguration, BreakawayPart, Mechanism, ScrewContacts,
    Tables,
};
use epas_friction::law::coefficient::{CoefficientModel, OneCoefficient, TemperatureFade};
use epas_friction::law::memory::{Hysteresis, SLIP_4, SPIN_4, SPIN_8};
use epas_friction::law::motion::{Deadband, SpeedOverTick, WrappedAngle, WrappedAngleParameters};
use epas_friction::scene::{Freshness, WithMemoryConfiguration};
use epas_friction::{BallScrew, Clearance, Error, LinearBearingConfiguration, RollingResistance};

use super::encoder::{self, EncoderStep};
use super::summary::Lines;
use super::trace::{Sample, Trace};
use crate::model::{ELEMENTS, Elements, TEMPERATURE};
use epas_design::files::Design;
use epas_page::failure::Failure;

/// What stands in for a temperature that is too old: the same one.
const FADE: TemperatureFade = match TemperatureFade::new(TEMPERATURE, 1.0, 1.0) {
    Ok(fade) => fade,
    Err(_) => TemperatureFade::DEFAULT,
};

/// Least load of a contact for which elements are designed, N.
const LEAST_LOAD: f32 = 0.1;

/// What elements of a screw follow from.
pub struct Screw<'a> {
    pub design: &'a BallScrew,
    pub friction: f32,
    pub clearance: Clearance,
    pub rolling_resistance: RollingResistance,
    pub loaded_balls: f32,
}

/// Elements with the lines that tell of them.
pub struct Remembered {
    pub elements: Elements,
    /// Load at which they are designed, N.
    pub reference_load: f32,
    /// Step of the encoder whose noise they do not follow, rad (m); 0 without.
    pub encoder_step: f32,
    pub lines: Lines,
}

/// Loads over the reference load for which the error of [`ProportionalElements`](epas_friction::law::memory::ProportionalElements) is known to be
/// small.
const NEAR: std::ops::RangeInclusive<f64> = 0.5..=1.6;

/// What friction that remembers takes of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MemorySettings {
    /// Step of the encoder whose noise it does not follow.
    pub encoder: EncoderStep,
    /// Load at which elements of the design are exact, N; without, the mean size of the trace's.
    pub reference_load: Option<f32>,
}

/// An axial load (normal load of a bearing) at which elements are designed, N.
pub fn reference_load(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if (1e-3..=1e6).contains(&value) => Ok(value),
        _ => Err("a reference load is 1e-3 to 1e6 N".into()),
    }
}

impl MemorySettings {
    /// The load at which elements are designed for the loads of a trace, N.
    pub fn load(self, loads: impl ExactSizeIterator<Item = f64>) -> f32 {
        self.reference_load.unwrap_or_else(|| {
            let samples = loads.len() as f64;
            (loads.map(f64::abs).sum::<f64>() / samples) as f32
        })
    }

    /// Elements of a design over a trace, behind the step of its encoder, rad or m.
    pub fn over<S: Sample>(
        self,
        trace: &Trace<S>,
        unit: &str,
        at: impl FnOnce(f32) -> Result<Remembered, Error>,
    ) -> Result<Remembered, Failure> {
        let loads = trace.samples.iter().map(Sample::load);
        let mut remembered = at(self.load(loads.clone()))?;
        remembered.encoder_step = self.encoder.size();
        let lines = &mut remembered.lines;
        lines.add_some("encoder", self.encoder.told(unit));
        lines.add_some(FAR, far(loads, remembered.reference_load, OPTION));
        Ok(remembered)
    }

    /// The line of [`far`] of a caged screw whose elements are exact at this load, where they follow the load in proportion; refuses a reference load
    /// beside that of a calibration.
    pub fn far(
        self,
        design: &Design,
        loads: impl ExactSizeIterator<Item = f64>,
        proportional_at: Option<f32>,
    ) -> Result<Option<String>, Failure> {
        let calibrated = design.calibrated.as_ref();
        let calibrated = calibrated.is_some_and(|found| found.breakaway_angle.is_some());
        if calibrated && self.reference_load.is_some() {
            return Err(Failure::Data(format!(
                "{}: --reference-load: the breakaway angle of [calibration] is that at its own reference_load",
                design.name
            )));
        }
        let cure = if calibrated {
            "elements = \"load_exact\" in [calibration] serve any load"
        } else {
            OPTION
        };
        Ok(proportional_at.and_then(|load| far(loads, load, cure)))
    }
}

/// What takes another reference load than the mean of the trace.
const OPTION: &str = "--reference-load takes the load at which reversals count, and does not follow the trace's mean";

/// Name of the line of [`far`].
pub const FAR: &str = "memory and load";

/// The share of loads at which elements in proportion that are exact at this one are off; none where there are few.
fn far(
    loads: impl ExactSizeIterator<Item = f64>,
    reference_load: f32,
    cure: &str,
) -> Option<String> {
    const FEW: f64 = 0.01;
    let all = loads.len() as f64;
    let off = loads.filter(|load| !NEAR.contains(&(load.abs() / f64::from(reference_load))));
    let share = off.count() as f64 / all;
    (share > FEW).then(|| {
        format!(
            "{:.0} % of the samples are outside {} to {} of reference_load = {reference_load:.0} N, where the way to full sliding is off: {cure}",
            100.0 * share,
            NEAR.start(),
            NEAR.end(),
        )
    })
}

impl Screw<'_> {
    /// Its elements at an axial load, N.
    pub fn remembered(&self, axial_load: f32) -> Result<Remembered, Error> {
        let loaded_balls = self.loaded_balls.round().max(1.0) as u16;
        let contacts = ScrewContacts::of(self.design);
        let contact_load = contacts.preloaded(axial_load, loaded_balls, self.clearance);
        let breakaway = Breakaway::of(
            self.design,
            &BreakawayConfiguration {
                friction: self.friction,
                clearance: self.clearance,
                rolling_resistance: self.rolling_resistance,
                loaded_balls,
                contact_load: contact_load.max(LEAST_LOAD),
            },
        )?;
        let elements = breakaway.elements(&Tables {
            slip: &SLIP_4.elements,
            spin: &SPIN_4.elements,
            rolling_resistance: &[],
        })?;
        let mut lines = Lines::default();
        tell(
            &mut lines,
            (&elements, breakaway.torque),
            &breakaway.parts(),
            &format!(
                "{:.1} N a contact, reference_load = {:.0} N of the screw",
                contact_load.max(LEAST_LOAD),
                axial_load.max(1e-3)
            ),
            ("N m/rad", "mrad", "N m"),
        );
        Ok(Remembered {
            elements,
            reference_load: axial_load.max(1e-3),
            encoder_step: 0.0,
            lines,
        })
    }
}

/// Elements of a linear bearing under a normal load, N, shared by so many balls.
pub fn of_bearing(
    configuration: &LinearBearingConfiguration,
    loaded_balls: f32,
    normal_load: f32,
) -> Result<Remembered, Error> {
    let loaded_balls = loaded_balls.round().max(1.0) as u16;
    let cos = configuration.bearing.contact_angle().cos;
    let load = (0.5 * normal_load / (f32::from(loaded_balls) * cos)).max(LEAST_LOAD);
    let breakaway = BearingBreakaway::of(
        &configuration.bearing,
        configuration.friction,
        RollingResistance::NONE,
        loaded_balls,
        [load; 2],
    )?;
    let elements = breakaway.elements(&Tables {
        slip: &[],
        spin: &SPIN_8.elements,
        rolling_resistance: &[],
    })?;
    let mut lines = Lines::default();
    tell(
        &mut lines,
        (&elements, breakaway.force),
        &breakaway.parts(),
        &format!("{load:.1} N a contact, reference_load = {normal_load:.0} N of the carriage"),
        ("N/m", "mm", "N"),
    );
    Ok(Remembered {
        elements,
        reference_load: normal_load.max(1e-3),
        encoder_step: 0.0,
        lines,
    })
}

fn tell(
    lines: &mut Lines,
    (elements, sliding): (&Elements, f32),
    parts: &[BreakawayPart],
    at: &str,
    (stiffness, motion, unit): (&str, &str, &str),
) {
    lines.add(
        "memory",
        format!(
            "{ELEMENTS} elements, initial stiffness {:.4} {stiffness}, full sliding after {:.4} {motion} with {sliding:.4} {unit}, at {at}",
            elements.initial_stiffness(),
            1e3 * elements.breakaway(),
        ),
    );
    for part in parts {
        let name = match part.mechanism {
            Mechanism::Slip => "  slip across the path",
            Mechanism::Spin => "  spin",
            Mechanism::RollingResistance => "  rolling resistance (left out)",
        };
        if part.share > 0.0 {
            lines.add(
                name,
                format!(
                    "{:.1} % of the friction, breakaway angle {:.4} {motion}",
                    100.0 * part.share,
                    1e3 * part.breakaway_angle
                ),
            );
        }
    }
}

/// A scene with these elements and one friction coefficient; balls turn round once the elements have.
pub fn configuration<C, A>(
    scene: C,
    remembered: &Remembered,
    angle: A,
    friction: f32,
) -> Result<WithMemoryConfiguration<C, Elements, A, OneCoefficient>, Error> {
    let elements = (remembered.elements, remembered.reference_load);
    let coefficient = OneCoefficient::new(friction)?;
    Ok(with_coefficient(scene, elements, angle, coefficient))
}

/// A scene with elements, the load at which they are designed, N, and any model of the friction coefficient.
pub fn with_coefficient<C, E: Hysteresis, A, L: CoefficientModel>(
    scene: C,
    (elements, reference_load): (E, f32),
    angle: A,
    coefficient: L,
) -> WithMemoryConfiguration<C, E, A, L> {
    WithMemoryConfiguration {
        scene,
        play: elements.breakaway(),
        elements,
        angle,
        reference_load,
        coefficient,
        temperature: FADE,
        freshness: Freshness::DEFAULT,
    }
}

/// A sensor of a speed that has a tick, s.
pub fn speed(tick: f32) -> Result<SpeedOverTick, Error> {
    SpeedOverTick::new(tick, 1e3)
}

/// The same behind a dead band of an encoder's step, rad (m), for a row of balls.
pub fn rows_speed(tick: f32, step: f32) -> Result<Deadband<SpeedOverTick>, Error> {
    encoder::behind(speed(tick)?, step, 0.0)
}

/// A sensor of an angle of half a turn either way, rad.
pub fn angle() -> Result<WrappedAngle, Error> {
    WrappedAngle::new(WrappedAngleParameters {
        lowest: -std::f32::consts::PI,
        period: std::f32::consts::TAU,
        largest_turn: std::f32::consts::PI,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::caged::Caged;
    use crate::simulate::samples::ScrewSample;
    use crate::simulate::scene::Scene as _;
    use crate::simulate::trace::Temperature;
    use epas_design::files::DesignSource;

    /// Friction after a reversal under the second of two loads, of the whole trace and of its second half, with the lines of the whole.
    fn last(reference_load: Option<f32>) -> ([f32; 2], Lines) {
        let sample = |tick: u16| {
            let speed = if tick < 1990 { 10.0 } else { -0.05 };
            let load = if tick < 1000 { 500.0 } else { 8e3 };
            ScrewSample::new(1e-3 * f64::from(tick), speed, load)
        };
        let design: DesignSource = "lin-4.1".parse().unwrap();
        let mut scene = Caged {
            design: design.load().unwrap(),
            memory: Some(MemorySettings::default()),
            temperature: false,
        };
        scene.set_memory(MemorySettings {
            reference_load,
            ..MemorySettings::default()
        });
        let mut lines = Lines::default();
        let friction = [1000, 0].map(|first| {
            let samples = (first..2000).map(sample).collect();
            let name = "steps".into();
            let (rows, told) = scene
                .rows(&Trace { name, samples }, &Temperature::None, None, &|| ())
                .unwrap();
            lines = told;
            rows.last().unwrap().outputs.friction
        });
        (friction, lines)
    }

    /// With a reference load of its own a part of a trace has the friction of the whole; with the mean of its loads it has not, and the summary
    /// says how many samples are far from it.
    #[test]
    fn a_reference_load_is_independent_of_the_trace() {
        let ([part, whole], lines) = last(None);
        assert!((part / whole - 1.0).abs() > 0.02, "{part} {whole}");
        let mut said = Vec::new();
        lines.print(&mut said).unwrap();
        let said = String::from_utf8(said).unwrap();
        assert!(
            said.contains("100 % of the samples are outside 0.5 to 1.6"),
            "{said}"
        );
        let ([part, whole], _) = last(Some(8e3));
        // Both ends of a way of 5e-4 rad are rounded to 2.4e-7 rad.
        assert!((part / whole - 1.0).abs() < 1e-3, "{part} {whole}");
    }

    /// A calibrated breakaway angle has its own reference load, and no other one beside it.
    #[test]
    fn a_calibration_has_its_own_reference_load() {
        let design = "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.785\n\
                      [calibration]\nbreakaway_angle = 1e-3\nreference_load = 3e3\n";
        let design = epas_design::files::read(design, "gear").unwrap();
        let far = |reference_load| {
            let settings = MemorySettings {
                reference_load,
                ..MemorySettings::default()
            };
            settings.far(&design, [3e3, -9e3].into_iter(), Some(3e3))
        };
        assert!(far(None).unwrap().unwrap().contains("50 % of the samples"));
        let refused = far(Some(5e3)).unwrap_err();
        assert!(refused.message().contains("its own reference_load"));
    }
}
