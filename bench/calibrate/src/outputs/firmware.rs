//! What firmware takes of a calibrated design: the screw with the values that a fit found, and the law of its friction coefficient.

use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters, RollingDrag};
use epas_friction::{Error, defaults};

use crate::screw::friction::{ElementsKind, Reference};
use crate::screw::quantities::Values;
use epas_design::c99::Elements;
use epas_design::files::Design;
use epas_design::files::calibration::REFERENCE_TEMPERATURE;
use epas_page::failure::Failure;

pub use crate::screw::friction::{ELEMENTS, Screw};

/// What firmware takes of a design beyond its configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// The screw as a fit has it.
    pub screw: Screw,
    /// Its calibrated values.
    pub values: Values,
    /// Friction coefficient by speed, temperature and direction, where it is not one number.
    pub law: Option<CoefficientParameters>,
    /// Gross sliding at the elements' reference load, where their breakaway angle was calibrated.
    pub reference: Option<Reference>,
}

impl Numbers {
    /// Those of a design.
    pub fn of(design: &Design) -> Result<Self, Failure> {
        let (screw, values) = calibrated(design);
        let refused = |failure: Failure| failure.of("calibration").of(&design.name);
        let told = design.calibrated.as_ref();
        let remembers = told.is_some_and(|told| told.breakaway_angle.is_some());
        let reference = remembers.then(|| screw.reference(&values)).transpose();
        Ok(Self {
            screw,
            values,
            law: law(design)?,
            reference: reference.map_err(refused)?,
        })
    }

    /// Elements of the memory, of the kind that was calibrated.
    pub fn elements(&self, reference: &Reference) -> Result<Elements, Error> {
        let (screw, values) = (&self.screw, &self.values);
        Ok(match screw.elements {
            ElementsKind::Proportional => {
                Elements::Proportional(screw.proportional(values, reference)?)
            }
            ElementsKind::LoadExact => Elements::LoadExact(screw.load_exact(values, reference)?),
            ElementsKind::Preloaded => Elements::Preloaded(screw.preloaded(values, reference)?),
        })
    }

    /// Turn that the balls go back with, over two, rad.
    pub fn play(&self, reference: &Reference) -> Result<f32, Error> {
        Ok(self.elements(reference)?.breakaway())
    }
}

/// The friction coefficient's law of a design: that of its calibration where that has one, the default's where it runs by it.
pub fn law(design: &Design) -> Result<Option<CoefficientParameters>, Failure> {
    if design.by_default_law {
        let law = design.default_coefficient();
        return law
            .map(Some)
            .map_err(|error| Failure::Data(error.to_string()));
    }
    let Some(told) = design.calibrated.as_ref().filter(|told| told.has_law()) else {
        return Ok(None);
    };
    let (screw, values) = calibrated(design);
    let caged = &design.caged;
    let law = || {
        let drag = match told.rolling_drag {
            Some(factor) => RollingDrag::of(&caged.design, caged.loaded_balls, defaults::FLOODING)?
                .times(factor),
            None => RollingDrag::NONE,
        };
        let law = CoefficientParameters {
            viscosity: screw.viscosity(&values)?,
            churning: told.churning.unwrap_or(0.0),
            drag,
            ..screw.coefficient(&values)
        };
        CoefficientLaw::new(&law).map(|_| law)
    };
    law()
        .map(Some)
        .map_err(|error| Failure::Data(format!("{}: calibration: {error}", design.name)))
}

/// Least and largest friction coefficient of a design with its calibration.
pub fn coefficients(design: &Design) -> Result<(f32, f32), Failure> {
    let friction = design.caged.friction;
    let Some(law) = law(design)? else {
        return Ok((friction, friction));
    };
    let (least, largest) = CoefficientLaw::new(&law)?.extremes();
    // The law's own rounding may leave the design's coefficient out.
    Ok((least.min(friction), largest.max(friction)))
}

/// A design as a fit has it, with what its calibration tells.
fn calibrated(design: &Design) -> (Screw, Values) {
    let caged = &design.caged;
    let told = design.calibrated.clone().unwrap_or_default();
    let or = |value: Option<f32>, other: f32| f64::from(value.unwrap_or(other));
    let screw = Screw {
        caged: *caged,
        elements: told.elements.unwrap_or(ElementsKind::Proportional),
        preloaded: false,
        reference_temperature: or(told.reference_temperature, REFERENCE_TEMPERATURE),
        reference_load: or(told.reference_load, 0.0),
        largest_load: or(told.largest_load, 0.0),
    };
    let mut values = Values::of(caged);
    for (value, told) in [
        (&mut values.full_film_ratio, told.full_film_ratio),
        (&mut values.half_share_speed, told.half_share_speed),
        (&mut values.viscosity_pole, told.viscosity_pole),
        (&mut values.direction_asymmetry, told.direction_asymmetry),
        (&mut values.breakaway_angle, told.breakaway_angle),
        (&mut values.backlash, told.backlash),
    ] {
        *value = told.map_or(*value, f64::from);
    }
    (screw, values)
}
