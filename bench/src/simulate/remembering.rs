//! A caged screw with memory: by its design alone, or as a measured trace has told it, with breakaway angle, friction coefficient by
//! speed and direction, and backlash.

use epas_friction::law::Elements;
use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::law::memory::Hysteresis;
use epas_friction::law::motion::{NutAngle, Steady};
use epas_friction::scene::{CoefficientFor, WithMemory, WithMemoryConfiguration, WithMemoryInputs};
use epas_friction::stored::{Fingerprinted, Stored};
use epas_friction::{
    CagedBallScrew, CagedBallScrewConfiguration, Error, FrictionModel, Inputs, Outputs, Refusal,
};

use super::memory::{self, Remembered};
use super::summary::Lines;
use crate::calibrate::outputs::firmware::{ELEMENTS, ElementsNumbers, Numbers};
use crate::designs::Design;
use crate::designs::calibration::ElementsName;
use crate::failure::Failure;

/// A screw that remembers, whatever its elements, its sensor and its coefficient are.
pub trait Remembers: Clone + Send + Sync {
    /// What it says to a moment with a reading of its sensor, at a temperature, K.
    fn step_at(&mut self, inputs: Inputs, reading: f32, temperature: f32) -> Outputs;

    /// The same at the temperature of every simulation.
    fn step(&mut self, inputs: Inputs, reading: f32) -> Outputs {
        self.step_at(inputs, reading, memory::TEMPERATURE)
    }

    /// Its state as a block.
    ///
    /// # Errors
    /// What the crate refuses.
    fn export(&self) -> Result<Vec<u8>, Refusal>;

    /// Takes the state of a block over, its sensor's last reading too.
    ///
    /// # Errors
    /// What the crate refuses; the state is as it was.
    fn import(&mut self, block: &[u8]) -> Result<(), Refusal>;
    /// What it says to a reading between two moments.
    fn between(&mut self, reading: f32) -> Outputs;
    /// Back to the state before the first tick.
    fn reset(&mut self);
    /// Consecutive ticks with a fault.
    fn faulted_ticks(&self) -> u32;
}

impl<E, A, L> Remembers for FrictionModel<WithMemory<CagedBallScrew, E, A, L>>
where
    E: Elements<State: Stored> + Fingerprinted + Copy,
    A: Sensor,
    L: CoefficientFor<Inputs>,
    Self: Clone + Send + Sync,
{
    fn step_at(&mut self, inputs: Inputs, reading: f32, temperature: f32) -> Outputs {
        let inputs = WithMemoryInputs {
            temperature,
            ..memory::fresh(inputs, reading)
        };
        Self::step(self, inputs)
    }

    fn between(&mut self, reading: f32) -> Outputs {
        Self::between(self, reading)
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Self::faulted_ticks(self)
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        let mut block = vec![0; Self::STATE_BYTES];
        Self::export(self, &mut block)?;
        Ok(block)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        self.import_with_reading(block)
    }
}

/// A sensor of an angle or a speed whose last reading can be kept.
pub trait Sensor:
    NutAngle<Reading = f32, State: Stored + Send + Sync> + Fingerprinted + Copy + Send + Sync + 'static
{
}

impl<
    A: NutAngle<Reading = f32, State: Stored + Send + Sync>
        + Fingerprinted
        + Copy
        + Send
        + Sync
        + 'static,
> Sensor for A
{
}

/// What is done with such a screw.
pub trait Use {
    /// What comes of it.
    type Made;

    /// Does it.
    fn with(self, screw: impl Remembers + 'static) -> Self::Made;
}

/// A design with a sensor.
struct Built<'a, A> {
    design: &'a Design,
    angle: A,
}

/// Builds the screw of a design for a sensor and a mean size of the load, N, and does something with it; what the summary tells of
/// it beside that.
///
/// # Errors
/// What the crate refuses.
pub fn remembering<A, U>(
    design: &Design,
    mean_load: f32,
    angle: A,
    then: U,
) -> Result<(U::Made, Lines), Failure>
where
    A: Sensor,
    U: Use,
{
    let refused = |error: Error| Failure::Data(format!("{}: {error}", design.name));
    let configuration = &design.configuration;
    let by_design = || by_design(configuration, mean_load).map_err(refused);
    let Some(calibrated) = &design.calibrated else {
        let remembered = by_design()?;
        let whole =
            memory::configuration(*configuration, &remembered, angle, configuration.friction);
        let model = whole.and_then(|whole| FrictionModel::new(&whole));
        return Ok((then.with(model.map_err(refused)?), remembered.lines));
    };
    let numbers = Numbers::of(design)?;
    let backlash = calibrated.backlash.unwrap_or(0.0);
    let built = Built {
        design,
        angle: Steady::new(angle, 0.5 * backlash).map_err(refused)?,
    };
    let law = match &numbers.law {
        Some(law) => law.law(),
        None => CoefficientLaw::constant(configuration.friction),
    }
    .map_err(refused)?;
    match &numbers.elements {
        None => {
            let remembered = by_design()?;
            let elements = (remembered.elements, remembered.reference_load);
            Ok((
                built.with(elements, law, then).map_err(refused)?,
                remembered.lines,
            ))
        }
        Some(told) => {
            let made = match told.kind {
                ElementsName::Proportional => told
                    .proportional()
                    .and_then(|elements| built.with((elements, told.load), law, then)),
                ElementsName::LoadExact => told
                    .load_exact()
                    .and_then(|elements| built.with((elements, told.load), law, then)),
                ElementsName::Preloaded => told
                    .preloaded()
                    .and_then(|elements| built.with((elements, told.load), law, then)),
            };
            Ok((made.map_err(refused)?, lines(told)))
        }
    }
}

impl<A: Sensor> Built<'_, A> {
    fn with<E: Hysteresis + Elements<State: Stored> + Fingerprinted + Copy + 'static, U: Use>(
        &self,
        elements: (E, f32),
        law: CoefficientLaw,
        then: U,
    ) -> Result<U::Made, Error>
    where
        FrictionModel<WithMemory<CagedBallScrew, E, A, CoefficientLaw>>: Clone + Send + Sync,
    {
        let whole: WithMemoryConfiguration<CagedBallScrewConfiguration, E, A, CoefficientLaw> =
            memory::with_coefficient(self.design.configuration, elements, self.angle, law);
        Ok(
            then.with(FrictionModel::<WithMemory<CagedBallScrew, E, A, _>>::new(
                &whole,
            )?),
        )
    }
}

/// Elements of a configuration's design under a load, N.
fn by_design(
    configuration: &CagedBallScrewConfiguration,
    mean_load: f32,
) -> Result<Remembered, Error> {
    let CagedBallScrewConfiguration {
        ref design,
        friction,
        clearance,
        rolling_resistance,
        loaded_balls,
        ..
    } = *configuration;
    memory::Screw {
        design,
        friction,
        clearance,
        rolling_resistance,
        loaded_balls: f32::from(loaded_balls),
    }
    .remembered(mean_load)
}

fn lines(told: &ElementsNumbers) -> Lines {
    let mut lines = Lines::default();
    lines.add(
        "memory",
        format!(
            "{ELEMENTS} elements as calibrated, full sliding after {:.4} mrad at {:.4} N m",
            1e3 * told.breakaway_angle,
            told.torque
        ),
    );
    lines
}
