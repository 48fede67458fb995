//! A caged screw with memory: by its design alone, or as a measured trace has told it, with breakaway angle, friction coefficient by
//! speed and direction, and backlash.

use epas_friction::law::Elements;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientModel};
use epas_friction::law::memory::Hysteresis;
use epas_friction::law::motion::{NutAngle, Steady};
use epas_friction::scene::{WithMemory, WithMemoryConfiguration};
use epas_friction::{
    CagedBallScrew, CagedBallScrewConfiguration, Error, FrictionModel, Inputs, Outputs,
};

use super::memory::{self, Remembered};
use super::summary::Lines;
use crate::calibrate::firmware::{ELEMENTS, ElementsNumbers, Numbers};
use crate::designs::Design;
use crate::designs::calibration::ElementsName;
use crate::failure::Failure;

/// A screw that remembers, whatever its elements, its sensor and its coefficient are.
pub trait Remembers: Clone + Send + Sync {
    /// What it says to a moment with a reading of its sensor.
    fn step(&mut self, inputs: Inputs, reading: f32) -> Outputs;
    /// What it says to a reading between two moments.
    fn between(&mut self, reading: f32) -> Outputs;
    /// Back to the state before the first tick.
    fn reset(&mut self);
    /// Consecutive ticks with a fault.
    fn faulted_ticks(&self) -> u32;
}

impl<E, A, L> Remembers for FrictionModel<WithMemory<CagedBallScrew, E, A, L>>
where
    E: Elements + Copy,
    A: NutAngle<Reading = f32> + Copy,
    L: CoefficientModel,
    Self: Clone + Send + Sync,
{
    fn step(&mut self, inputs: Inputs, reading: f32) -> Outputs {
        Self::step(self, memory::fresh(inputs, reading))
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
    A: NutAngle<Reading = f32, State: Send + Sync> + Copy + Send + Sync + 'static,
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

impl<A: NutAngle<Reading = f32> + Copy + 'static> Built<'_, A> {
    fn with<E: Hysteresis + Elements + Copy + 'static, U: Use>(
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
