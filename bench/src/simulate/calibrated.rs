//! A caged screw with memory as a measured trace has told it: breakaway angle, friction coefficient by speed and direction,
//! backlash.

use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::law::memory::LoadExactElements;
use epas_friction::law::motion::{Steady, WrappedAngle};
use epas_friction::scene::WithMemory;
use epas_friction::{CagedBallScrew, FrictionModel, Inputs, Outputs};

use super::memory::{self, ELEMENTS, Elements, Remembered};
use super::summary::Lines;
use crate::calibrate::firmware::Numbers;
use crate::designs::Design;
use crate::failure::Failure;

/// A screw with such elements.
type Screw<E> = FrictionModel<WithMemory<CagedBallScrew, E, Steady<WrappedAngle>, CoefficientLaw>>;

/// The model, by its elements.
#[expect(clippy::large_enum_variant, reason = "one of it is built")]
pub enum CalibratedScrew {
    /// Elements in constant shares of the friction.
    Proportional(Screw<Elements>),
    /// Elements that come into contact with the load.
    LoadExact(Screw<LoadExactElements<ELEMENTS>>),
}

impl CalibratedScrew {
    /// The screw of a design, and what the summary tells of it; without a calibrated breakaway angle with the elements that
    /// its design gives.
    ///
    /// # Errors
    /// What the crate refuses.
    pub fn new(
        design: &Design,
        by_design: impl FnOnce() -> Result<Remembered, Failure>,
    ) -> Result<(Self, Lines), Failure> {
        let numbers = Numbers::of(design)?;
        let refused = |error| Failure::Data(format!("{}: calibration: {error}", design.name));
        let friction = design.configuration.friction;
        let backlash = design
            .calibrated
            .as_ref()
            .and_then(|calibrated| calibrated.backlash)
            .unwrap_or(0.0);
        let sensor = memory::angle()
            .and_then(|angle| Steady::new(angle, 0.5 * backlash))
            .map_err(refused)?;
        let law = match &numbers.law {
            Some(law) => law.law(),
            None => CoefficientLaw::constant(friction),
        }
        .map_err(refused)?;
        let Some(told) = numbers.elements else {
            let Remembered {
                elements,
                reference_load,
                lines,
            } = by_design()?;
            let whole = memory::with_coefficient(
                design.configuration,
                (elements, reference_load),
                sensor,
                law,
            );
            let model = FrictionModel::new(&whole).map_err(refused)?;
            return Ok((Self::Proportional(model), lines));
        };
        let mut lines = Lines::default();
        lines.add(
            "memory",
            format!(
                "{ELEMENTS} elements as calibrated, full sliding after {:.4} mrad at {:.4} N m",
                1e3 * told.breakaway_angle,
                told.torque
            ),
        );
        let scene = design.configuration;
        let model = match told.largest_load {
            None => {
                let elements = told.proportional().map_err(refused)?;
                let whole = memory::with_coefficient(scene, (elements, told.load), sensor, law);
                Self::Proportional(FrictionModel::new(&whole).map_err(refused)?)
            }
            Some(largest) => {
                let elements = told.load_exact(largest).map_err(refused)?;
                let whole = memory::with_coefficient(scene, (elements, told.load), sensor, law);
                Self::LoadExact(FrictionModel::new(&whole).map_err(refused)?)
            }
        };
        Ok((model, lines))
    }

    /// What it says to a moment at an angle of the nut, rad, within half a turn either way.
    pub fn step(&mut self, inputs: Inputs, angle: f32) -> Outputs {
        let inputs = memory::fresh(inputs, angle);
        match self {
            Self::Proportional(model) => model.step(inputs),
            Self::LoadExact(model) => model.step(inputs),
        }
    }
}
