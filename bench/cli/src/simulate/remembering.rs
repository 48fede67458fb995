//! A caged screw with memory: by its design alone, or as a measured trace has told it, with breakaway angle, friction coefficient by
//! speed and direction, and backlash.

use epas_design::CagedDesign;
use epas_design::c99::Elements as Calibrated;
use epas_design::caged::{Block, NODES};
use epas_friction::law::Elements;
use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::law::memory::Hysteresis;
use epas_friction::scene::{CagedBallScrew, ClosedFormScrew, WithMemory};
use epas_friction::stored::{Fingerprinted, Stored};
use epas_friction::{Error, FrictionModel, Inputs, Scene};

use super::encoder;
use super::memory::{self, Remembered};
use super::summary::Lines;
use crate::model::{Built, HostScene, Model, Sensor};
use epas_calibrate::outputs::firmware::{self, ELEMENTS, Numbers};
use epas_design::caged_scene::CagedScene;
use epas_design::files::Design;
use epas_page::failure::Failure;

/// A design with a sensor, its step, rad, and a mean size of the load, N.
struct Wanted<'a, A> {
    design: &'a Design,
    mean_load: f32,
    angle: A,
    step: f32,
}

/// A caged screw with memory.
pub struct Remembering {
    /// It.
    pub model: Box<dyn Model>,
    /// What the summary tells of it.
    pub lines: Lines,
    /// Load at which its elements are exact, N, where they follow the load in proportion.
    pub proportional_at: Option<f32>,
}

/// The screw of a design for a sensor behind a dead band of its step, rad, and a mean size of the load, N.
///
/// The screw is folded for the friction coefficients that its calibration has.
pub fn remembering<A: Sensor>(
    design: &Design,
    mean_load: f32,
    (angle, step): (A, f32),
) -> Result<Remembering, Failure> {
    let wanted = Wanted {
        design,
        mean_load,
        angle,
        step,
    };
    match scene(design)? {
        CagedScene::Folded(Block::One(block)) => wanted.around::<CagedBallScrew>(block),
        CagedScene::Folded(Block::Range(block)) => wanted.around::<CagedBallScrew<NODES>>(block),
        CagedScene::ClosedForm(form) => wanted.around::<ClosedFormScrew>(form),
    }
}

/// What a memory is put around: a scene for the friction coefficients of the design's calibration.
pub fn scene(design: &Design) -> Result<CagedScene, Failure> {
    Ok(CagedScene::with_coefficients(
        design,
        firmware::coefficients(design)?,
    )?)
}

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
    fn around<S>(&self, scene: S::Configuration) -> Result<Remembering, Failure>
    where
        S: HostScene<Configuration: Copy> + Scene<Inputs = Inputs>,
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
            return Ok(remembered.around(Box::new(model.map_err(refused)?)));
        }
        let numbers = Numbers::of(design)?;
        let law = law(design, &numbers).map_err(refused)?;
        let Some(reference) = &numbers.reference else {
            let remembered = by_design()?;
            let elements = (remembered.elements, remembered.reference_load);
            let model = calibrated_model::<S, _, _>(scene, elements, angle, law);
            return Ok(remembered.around(model.map_err(refused)?));
        };
        let load = reference.load;
        let elements = numbers.elements(reference).map_err(refused)?;
        let made = match elements {
            Calibrated::Proportional(made) => {
                calibrated_model::<S, _, _>(scene, (made, load), angle, law)
            }
            Calibrated::LoadExact(made) => {
                calibrated_model::<S, _, _>(scene, (made, load), angle, law)
            }
            Calibrated::Preloaded(made) => {
                calibrated_model::<S, _, _>(scene, (made, load), angle, law)
            }
        };
        let proportional = matches!(elements, Calibrated::Proportional(_));
        Ok(Remembering {
            model: made.map_err(refused)?,
            lines: lines(numbers.values.breakaway_angle, reference.torque),
            proportional_at: proportional.then_some(load),
        })
    }
}

impl Remembered {
    fn around(self, model: Box<dyn Model>) -> Remembering {
        Remembering {
            model,
            lines: self.lines,
            proportional_at: Some(self.reference_load),
        }
    }
}

fn calibrated_model<S, E, A>(
    scene: S::Configuration,
    elements: (E, f32),
    angle: A,
    law: CoefficientLaw,
) -> Built
where
    S: HostScene + Scene<Inputs = Inputs>,
    E: Hysteresis + Elements<State: Stored> + Fingerprinted + Copy + 'static,
    A: Sensor,
    FrictionModel<WithMemory<S, E, A, CoefficientLaw>>: Copy + Send + Sync,
{
    let whole = memory::with_coefficient(scene, elements, angle, law);
    Ok(Box::new(FrictionModel::<WithMemory<S, E, A, _>>::new(
        &whole,
    )?))
}

/// Elements of a design under a load, N.
pub fn by_design(caged: &CagedDesign, mean_load: f32) -> Result<Remembered, Error> {
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
