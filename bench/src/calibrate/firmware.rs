//! What firmware takes of a calibrated design, as plain numbers: the law of the friction coefficient and the elements.

use epas_friction::law::SlidingLimits;
use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, DirectionalCoefficient, Viscosity,
};
use epas_friction::law::memory::{
    Hysteresis, LoadExactElements, Part, ProportionalElements, SLIP_8,
};
use epas_friction::scene::{Inputs, Scene, Sliding};
use epas_friction::{CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, Error};

use crate::designs::Design;
use crate::designs::calibration::{Calibrated, REFERENCE_TEMPERATURE};
use crate::failure::Failure;

/// Elements of every calibrated memory.
pub const ELEMENTS: usize = 8;

/// Points of the default lubricant's viscosity, K and Pa s, and its pour point, K: those of `defaults::VISCOSITY`.
const OIL: ([(f32, f32); 2], f32) = ([(313.15, 0.088), (373.15, 0.0095)], 228.15);

/// Viscosity at the reference temperature, Pa s, of an oil of which only the pole is known, and the coldest temperature, K, down
/// to which it holds: only ratios of viscosities have an effect.
const ONLY_POLE: (f32, f32) = (0.1, 150.0);

/// Distance of the second point of such a viscosity, K.
const SECOND: f32 = 60.0;

/// Ticks after which both directions of a caged screw have been looked up.
const LOOKED_UP: usize = 8;

/// What firmware takes of a design beyond its configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// Friction coefficient by speed and direction, where it is not one number.
    pub law: Option<LawNumbers>,
    /// Elements, where their breakaway angle was calibrated.
    pub elements: Option<ElementsNumbers>,
    /// Temperature at which the calibration holds, K.
    pub reference_temperature: f32,
}

/// What a coefficient law is made from; as in [`CoefficientParameters`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawNumbers {
    /// At standstill.
    pub boundary: f32,
    /// At high speed.
    pub full_film: f32,
    /// Speed at which half of the difference is gone, rad/s.
    pub half_share_speed: f32,
    /// Temperature of that speed, K.
    pub reference_temperature: f32,
    /// Temperatures, K, with viscosities, Pa s.
    pub viscosity: [(f32, f32); 2],
    /// Temperature below which the viscosity does not change, K.
    pub pour_point: f32,
    /// Factor in the positive direction.
    pub forward: f32,
    /// Factor in the negative direction.
    pub backward: f32,
    /// Torque of churned lubricant over its viscosity and the speed, m³.
    pub churning: f32,
}

/// What elements are made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementsNumbers {
    /// Friction of gross sliding at the reference load, mean of both directions, N m.
    pub torque: f32,
    /// Turn from no friction to full sliding there, rad.
    pub breakaway_angle: f32,
    /// Load of the elements there: sum of both flanks' loads, N.
    pub load: f32,
    /// That at the largest load over it, where elements follow the load exactly.
    pub largest_load: Option<f32>,
    /// Turn that the balls go back with, over two, rad.
    pub play: f32,
}

impl Numbers {
    /// Those of a design.
    ///
    /// # Errors
    /// What the crate refuses.
    pub fn of(design: &Design) -> Result<Self, Failure> {
        let refused =
            |error: Error| Failure::Data(format!("{}: calibration: {error}", design.name));
        let configuration = &design.configuration;
        let calibrated = design.calibrated.clone().unwrap_or_default();
        let law = calibrated
            .has_law()
            .then(|| LawNumbers::of(configuration.friction, &calibrated));
        if let Some(law) = &law {
            law.law().map_err(refused)?;
        }
        let elements = calibrated
            .breakaway_angle
            .map(|breakaway_angle| ElementsNumbers::of(configuration, &calibrated, breakaway_angle))
            .transpose()
            .map_err(refused)?;
        Ok(Self {
            law,
            elements,
            reference_temperature: calibrated
                .reference_temperature
                .unwrap_or(REFERENCE_TEMPERATURE),
        })
    }
}

impl LawNumbers {
    fn of(friction: f32, calibrated: &Calibrated) -> Self {
        let reference = calibrated
            .reference_temperature
            .unwrap_or(REFERENCE_TEMPERATURE);
        let asymmetry = calibrated.direction_asymmetry.unwrap_or(0.0);
        let (viscosity, pour_point) = calibrated.viscosity_pole.map_or(OIL, |pole| {
            let ratio = (reference - pole) / (reference + SECOND - pole);
            let (viscosity, coldest) = ONLY_POLE;
            let second = (reference + SECOND, viscosity * ratio.powi(5));
            ([(reference, viscosity), second], coldest)
        });
        Self {
            boundary: friction,
            full_film: friction * calibrated.full_film_ratio.unwrap_or(1.0),
            half_share_speed: calibrated.half_share_speed.unwrap_or(1.0),
            reference_temperature: reference,
            viscosity,
            pour_point,
            forward: 1.0 + asymmetry,
            backward: 1.0 - asymmetry,
            churning: calibrated.churning.unwrap_or(0.0),
        }
    }

    /// The law.
    ///
    /// # Errors
    /// [`Error`] naming a number out of range.
    pub fn law(&self) -> Result<CoefficientLaw, Error> {
        let [cold, warm] = self.viscosity;
        CoefficientLaw::new(&CoefficientParameters {
            boundary: self.boundary,
            full_film: self.full_film,
            half_share_speed: self.half_share_speed,
            reference_temperature: self.reference_temperature,
            viscosity: Viscosity::through(cold, warm, self.pour_point)?,
            forward: self.forward,
            backward: self.backward,
            churning: self.churning,
        })
    }
}

impl ElementsNumbers {
    fn of(
        configuration: &CagedBallScrewConfiguration,
        calibrated: &Calibrated,
        breakaway_angle: f32,
    ) -> Result<Self, Error> {
        let constants = CagedConstants::new(configuration)?;
        let at = |load| sliding(&constants, configuration.friction, load);
        let reference = at(calibrated.reference_load.unwrap_or(0.0));
        let mut numbers = Self {
            torque: 0.5 * (reference.forward + reference.backward),
            breakaway_angle,
            load: reference.load,
            largest_load: calibrated
                .largest_load
                .map(|load| at(load).load / reference.load),
            play: 0.0,
        };
        numbers.play = match numbers.largest_load {
            None => numbers.proportional()?.breakaway(),
            Some(largest) => numbers.load_exact(largest)?.breakaway(),
        };
        Ok(numbers)
    }

    /// Elements in constant shares of the friction.
    ///
    /// # Errors
    /// [`Error`] naming a number out of range.
    pub fn proportional(&self) -> Result<ProportionalElements<ELEMENTS>, Error> {
        let whole = Part {
            backbone: &SLIP_8.elements,
            share: 1.0,
            breakaway_angle: self.breakaway_angle,
        };
        ProportionalElements::new(self.torque, &[whole])
    }

    /// Elements that come into contact with loads up to so many times the reference.
    ///
    /// # Errors
    /// [`Error`] naming a number out of range.
    pub fn load_exact(&self, largest_load: f32) -> Result<LoadExactElements<ELEMENTS>, Error> {
        LoadExactElements::new(self.torque, self.breakaway_angle, largest_load)
    }
}

/// Gross sliding with one friction coefficient under an axial load, N.
fn sliding(constants: &CagedConstants, friction: f32, axial_load: f32) -> SlidingLimits {
    let mut state = CagedBallScrew::initial_state(constants);
    let mut recent = CagedBallScrew::recent(constants, &state);
    let both = DirectionalCoefficient {
        forward: friction,
        backward: friction,
    };
    let inputs = Inputs {
        nut_speed: 1.0,
        axial_load,
    };
    let mut full = || CagedBallScrew::full(constants, &mut state, &mut recent, None, inputs, both);
    for _ in 1..LOOKED_UP {
        full();
    }
    CagedBallScrew::limits(&full())
}
