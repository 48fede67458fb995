//! A caged screw with memory: by its design alone, or as a measured trace has told it, with breakaway angle, friction coefficient by
//! speed and direction, and backlash.

use epas_design::CagedDesign;
use epas_design::caged::NODES;
use epas_friction::law::Elements;
use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::law::memory::Hysteresis;
use epas_friction::law::motion::NutAngle;
use epas_friction::scene::{
    CagedBallScrew, ClosedFormScrew, CoefficientFor, Sliding, StoredScene, WithMemory,
    WithMemoryConfiguration, WithMemoryInputs,
};
use epas_friction::stored::{Fingerprinted, Stored};
use epas_friction::{Error, FrictionModel, Inputs, Outputs, Refusal, Scene};

use super::encoder;
use super::memory::{self, Remembered};
use super::summary::Lines;
use epas_calibrate::outputs::firmware::{self, ELEMENTS, Numbers};
use epas_design::caged_scene::CagedScene;
use epas_design::files::Design;
use epas_design::files::calibration::ElementsName;
use epas_page::failure::Failure;

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

/// A screw whose balls do not touch, that a memory is put around: by a folded block or a closed form.
pub trait CagedScrew:
    StoredScene
    + Sliding<
        Inputs = Inputs,
        Outputs = Outputs,
        Constants: Copy + Send + Sync,
        State: Send + Sync,
        Friction: Stored + Default + Send + Sync,
    > + Copy
    + Send
    + Sync
    + 'static
{
}

impl<const N: usize> CagedScrew for CagedBallScrew<N> {}

impl CagedScrew for ClosedFormScrew {}

impl<S, E, A, L> Remembers for FrictionModel<WithMemory<S, E, A, L>>
where
    S: CagedScrew,
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

/// A design with a sensor, its step, rad, and a mean size of the load, N.
struct Wanted<'a, A> {
    design: &'a Design,
    mean_load: f32,
    angle: A,
    step: f32,
}

/// Builds the screw of a design for a sensor behind a dead band of its step, rad, and a mean size of the load, N, and does something with it;
/// what the summary tells of it beside that.
///
/// The screw is folded for the friction coefficients that its calibration has.
///
/// # Errors
/// What the crate refuses, or cannot be folded.
pub fn remembering<A, U>(
    design: &Design,
    mean_load: f32,
    (angle, step): (A, f32),
    then: U,
) -> Result<(U::Made, Lines), Failure>
where
    A: Sensor,
    U: Use,
{
    let wanted = Wanted {
        design,
        mean_load,
        angle,
        step,
    };
    match scene(design)? {
        CagedScene::One(block) => wanted.around::<CagedBallScrew, _>(block, then),
        CagedScene::Range(block) => wanted.around::<CagedBallScrew<NODES>, _>(block, then),
        CagedScene::ClosedForm(form) => wanted.around::<ClosedFormScrew, _>(form, then),
    }
}

/// What a memory is put around: a scene for the friction coefficients of the design's calibration.
///
/// # Errors
/// What the crate refuses, or cannot be folded.
pub fn scene(design: &Design) -> Result<CagedScene, Failure> {
    Ok(CagedScene::with_coefficients(
        design,
        coefficients(design)?,
    )?)
}

/// Least and largest friction coefficient of a design with its calibration.
///
/// # Errors
/// What the crate refuses.
pub fn coefficients(design: &Design) -> Result<(f32, f32), Failure> {
    let friction = design.caged.friction;
    let Some(law) = firmware::law(design)? else {
        return Ok((friction, friction));
    };
    let (least, largest) = CoefficientLaw::new(&law)?.extremes();
    // The law's own rounding may leave the design's coefficient out.
    Ok((least.min(friction), largest.max(friction)))
}

/// The friction coefficient of a calibrated design.
fn law(design: &Design, numbers: &Numbers) -> Result<CoefficientLaw, Error> {
    match &numbers.law {
        Some(law) => CoefficientLaw::new(law),
        None => CoefficientLaw::constant(design.caged.friction),
    }
}

fn refused(design: &Design, error: &Error) -> Failure {
    Failure::Data(format!("{}: {error}", design.name))
}

impl<A: Sensor> Wanted<'_, A> {
    fn around<S: CagedScrew, U: Use>(
        &self,
        scene: S::Configuration,
        then: U,
    ) -> Result<(U::Made, Lines), Failure>
    where
        S::Configuration: Copy,
    {
        let Self {
            design,
            mean_load,
            angle,
            step,
        } = *self;
        let refused = |error: Error| refused(design, &error);
        let by_design = || by_design(&design.caged, mean_load).map_err(refused);
        let calibrated = design.calibrated.as_ref();
        let backlash = calibrated.and_then(|found| found.backlash).unwrap_or(0.0);
        let angle = encoder::behind(angle, step, backlash).map_err(refused)?;
        if calibrated.is_none() && !design.by_default_law {
            let remembered = by_design()?;
            let whole = memory::configuration(scene, &remembered, angle, design.caged.friction);
            let model =
                whole.and_then(|whole| FrictionModel::<WithMemory<S, _, _, _>>::new(&whole));
            return Ok((then.with(model.map_err(refused)?), remembered.lines));
        }
        let numbers = Numbers::of(design)?;
        let built = Built {
            scene,
            angle,
            law: law(design, &numbers).map_err(refused)?,
        };
        match &numbers.reference {
            None => {
                let remembered = by_design()?;
                let elements = (remembered.elements, remembered.reference_load);
                Ok((
                    built.with::<S, _, _>(elements, then).map_err(refused)?,
                    remembered.lines,
                ))
            }
            Some(reference) => {
                let Numbers { screw, values, .. } = &numbers;
                let load = reference.load;
                let made = match screw.elements {
                    ElementsName::Proportional => screw
                        .proportional(values, reference)
                        .and_then(|elements| built.with::<S, _, _>((elements, load), then)),
                    ElementsName::LoadExact => screw
                        .load_exact(values, reference)
                        .and_then(|elements| built.with::<S, _, _>((elements, load), then)),
                    ElementsName::Preloaded => screw
                        .preloaded(values, reference)
                        .and_then(|elements| built.with::<S, _, _>((elements, load), then)),
                };
                Ok((
                    made.map_err(refused)?,
                    lines(values.breakaway_angle, reference.torque),
                ))
            }
        }
    }
}

/// A scene with a sensor and a friction coefficient.
struct Built<C, A> {
    scene: C,
    angle: A,
    law: CoefficientLaw,
}

impl<C: Copy, A: Sensor> Built<C, A> {
    fn with<S, E, U>(&self, elements: (E, f32), then: U) -> Result<U::Made, Error>
    where
        S: CagedScrew + Scene<Configuration = C>,
        E: Hysteresis + Elements<State: Stored> + Fingerprinted + Copy + 'static,
        U: Use,
        FrictionModel<WithMemory<S, E, A, CoefficientLaw>>: Clone + Send + Sync,
    {
        let whole: WithMemoryConfiguration<C, E, A, CoefficientLaw> =
            memory::with_coefficient(self.scene, elements, self.angle, self.law);
        Ok(then.with(FrictionModel::<WithMemory<S, E, A, _>>::new(&whole)?))
    }
}

/// Elements of a design under a load, N.
fn by_design(caged: &CagedDesign, mean_load: f32) -> Result<Remembered, Error> {
    let CagedDesign {
        ref design,
        friction,
        clearance,
        rolling_resistance,
        loaded_balls,
        ..
    } = *caged;
    memory::Screw {
        design,
        friction,
        clearance,
        rolling_resistance,
        loaded_balls: f32::from(loaded_balls),
    }
    .remembered(mean_load)
}

fn lines(breakaway_angle: f64, torque: f32) -> Lines {
    let mut lines = Lines::default();
    lines.add(
        "memory",
        format!(
            "{ELEMENTS} elements as calibrated, full sliding after {:.4} mrad at {torque:.4} N m",
            1e3 * breakaway_angle,
        ),
    );
    lines
}
