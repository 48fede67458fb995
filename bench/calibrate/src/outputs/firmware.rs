//! What firmware takes of a calibrated design, as plain numbers: the law of the friction coefficient and the elements.

use epas_design::CagedDesign;
use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, RollingDrag, Viscosity,
};
use epas_friction::law::memory::{
    Hysteresis, LoadExactElements, Part, PreloadedElements, ProportionalElements, SLIP_8,
};
use epas_friction::{Error, defaults};

use crate::screw::friction::{ElementsKind, Screw};
use crate::screw::quantities::Values;
use epas_design::files::Design;
use epas_design::files::calibration::{Calibrated, ElementsName, REFERENCE_TEMPERATURE};
use epas_page::failure::Failure;

/// Elements of every calibrated memory.
pub const ELEMENTS: usize = 8;

/// Viscosity at the reference temperature, Pa s, and the coldest temperature, K, down to which it holds: that of the default grease at 20
/// degrees Celsius, which the factor of the lubricant drag stands for; the coefficient follows ratios of viscosities alone.
const VISCOSITY: (f32, f32) = (0.1, 150.0);

/// Distance of the second point of the viscosity, K.
const SECOND: f32 = 60.0;

/// What gross sliding does not follow from.
const NOTHING: Values = Values {
    friction: 0.0,
    full_film_ratio: 1.0,
    half_share_speed: 1.0,
    viscosity_pole: 0.0,
    direction_asymmetry: 0.0,
    hysteresis_loss: 0.0,
    lubricant_drag: 0.0,
    preload: 0.0,
    breakaway_angle: 1.0,
    backlash: 0.0,
    inertia: 0.0,
    drag: 0.0,
    churning: 0.0,
    rolling_drag: 0.0,
    offset: 0.0,
    gain: 1.0,
    harmonics: [0.0; 4],
};

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
    /// Lubricant drag of the rolling contacts.
    pub drag: RollingDrag,
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
    /// How they follow the load.
    pub kind: ElementsName,
    /// Their largest load over that, where they do not follow in proportion.
    pub largest_load: f32,
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
        let caged = &design.caged;
        let calibrated = design.calibrated.clone().unwrap_or_default();
        let law = calibrated
            .has_law()
            .then(|| LawNumbers::of(caged, &calibrated))
            .transpose()
            .map_err(refused)?;
        if let Some(law) = &law {
            law.law().map_err(refused)?;
        }
        let elements = calibrated
            .breakaway_angle
            .map(|breakaway_angle| ElementsNumbers::of(caged, &calibrated, breakaway_angle))
            .transpose()
            .map_err(|failure| failure.of("calibration").of(&design.name))?;
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
    /// Those of a calibration of a screw, whose friction coefficient is that at standstill.
    ///
    /// # Errors
    /// [`Error`] naming `loaded_balls`.
    pub fn of(caged: &CagedDesign, calibrated: &Calibrated) -> Result<Self, Error> {
        let friction = caged.friction;
        let drag = match calibrated.rolling_drag {
            Some(factor) => RollingDrag::of(&caged.design, caged.loaded_balls, defaults::FLOODING)?
                .times(factor),
            None => RollingDrag::NONE,
        };
        let reference = calibrated
            .reference_temperature
            .unwrap_or(REFERENCE_TEMPERATURE);
        let asymmetry = calibrated.direction_asymmetry.unwrap_or(0.0);
        let pole = calibrated
            .viscosity_pole
            .unwrap_or(defaults::VISCOSITY.pole());
        let ratio = (reference - pole) / (reference + SECOND - pole);
        let (viscosity, pour_point) = VISCOSITY;
        let warm = (reference + SECOND, viscosity * ratio.powi(5));
        Ok(Self {
            boundary: friction,
            full_film: friction * calibrated.full_film_ratio.unwrap_or(1.0),
            half_share_speed: calibrated.half_share_speed.unwrap_or(1.0),
            reference_temperature: reference,
            viscosity: [(reference, viscosity), warm],
            pour_point,
            forward: 1.0 + asymmetry,
            backward: 1.0 - asymmetry,
            churning: calibrated.churning.unwrap_or(0.0),
            drag,
        })
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
            drag: self.drag,
        })
    }
}

impl ElementsNumbers {
    fn of(
        caged: &CagedDesign,
        calibrated: &Calibrated,
        breakaway_angle: f32,
    ) -> Result<Self, Failure> {
        let kind = calibrated.elements.unwrap_or(ElementsName::Proportional);
        let screw = Screw {
            caged: *caged,
            elements: match kind {
                ElementsName::Proportional => ElementsKind::Proportional,
                ElementsName::LoadExact => ElementsKind::LoadExact,
                ElementsName::Preloaded => ElementsKind::Preloaded,
            },
            preloaded: false,
            reference_temperature: REFERENCE_TEMPERATURE.into(),
            reference_load: calibrated.reference_load.unwrap_or(0.0).into(),
            largest_load: calibrated.largest_load.unwrap_or(0.0).into(),
        };
        let rolling = &caged.rolling_resistance;
        let reference = screw.reference(&Values {
            friction: caged.friction.into(),
            hysteresis_loss: rolling.hysteresis_loss.into(),
            lubricant_drag: rolling.lubricant_drag.into(),
            ..NOTHING
        })?;
        let mut numbers = Self {
            torque: reference.torque,
            breakaway_angle,
            load: reference.load,
            kind,
            largest_load: screw.largest_load_of_elements(&reference),
            play: 0.0,
        };
        numbers.play = match kind {
            ElementsName::Proportional => numbers.proportional()?.breakaway(),
            ElementsName::LoadExact => numbers.load_exact()?.breakaway(),
            ElementsName::Preloaded => numbers.preloaded()?.breakaway(),
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

    /// Elements that come into contact with the load.
    ///
    /// # Errors
    /// [`Error`] naming a number out of range.
    pub fn load_exact(&self) -> Result<LoadExactElements<ELEMENTS>, Error> {
        LoadExactElements::new(self.torque, self.breakaway_angle, self.largest_load)
    }

    /// Elements that come into contact with the load that both flanks share.
    ///
    /// # Errors
    /// [`Error`] naming a number out of range.
    pub fn preloaded(&self) -> Result<PreloadedElements<LoadExactElements<ELEMENTS>>, Error> {
        Ok(PreloadedElements::new(self.load_exact()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epas_design::files::read;

    /// One formula in two forms: what a calibration runs, and what it is written as.
    #[test]
    fn firmware_has_the_law_and_the_elements_that_were_fitted() {
        let text = "nominal_diameter = 0.032\nlead = 0.02\nball_diameter = 6.35e-3\nconformity = 0.528\n\
                    contact_angle = 0.7853982\nfriction = 0.115\npreload = 17\nloaded_balls = 40\n[calibration]\n\
                    full_film_ratio = 0.5\nhalf_share_speed = 6\nreference_temperature = 303\nviscosity_pole = 210\n\
                    direction_asymmetry = 0.03125\nbreakaway_angle = 2e-3\n";
        let values = Values {
            friction: 0.115,
            full_film_ratio: 0.5,
            half_share_speed: 6.0,
            viscosity_pole: 210.0,
            direction_asymmetry: 0.03125,
            hysteresis_loss: defaults::ROLLING_RESISTANCE.hysteresis_loss.into(),
            preload: 17.0,
            breakaway_angle: 2e-3,
            ..NOTHING
        };
        for (elements, lines) in [
            (ElementsKind::Proportional, ""),
            (
                ElementsKind::LoadExact,
                "elements = \"load_exact\"\nlargest_load = 3000\n",
            ),
            (
                ElementsKind::Preloaded,
                "elements = \"preloaded\"\nlargest_load = 3000\n",
            ),
        ] {
            let design = read(&format!("{text}{lines}"), "design").unwrap();
            let numbers = Numbers::of(&design).unwrap();
            let screw = Screw {
                caged: design.caged,
                elements,
                preloaded: true,
                reference_temperature: 303.0,
                reference_load: 0.0,
                largest_load: 3000.0,
            };
            let law = CoefficientLaw::new(&screw.coefficient(&values)).unwrap();
            assert_eq!(numbers.law.unwrap().law().unwrap(), law);
            let told = numbers.elements.unwrap();
            let reference = screw.reference(&values).unwrap();
            assert_eq!(told.load, reference.load);
            match elements {
                ElementsKind::Proportional => assert_eq!(
                    told.proportional().unwrap(),
                    screw.proportional(&values, &reference).unwrap()
                ),
                ElementsKind::LoadExact => assert_eq!(
                    told.load_exact().unwrap(),
                    screw.load_exact(&values, &reference).unwrap()
                ),
                ElementsKind::Preloaded => assert_eq!(
                    told.preloaded().unwrap(),
                    screw.preloaded(&values, &reference).unwrap()
                ),
            }
        }
    }
}
