//! Friction of a screw along a trace: the exact ball of the reference, behind the memory that the firmware runs.
//!
//! One formula, in one place: values of a calibration become a design here, and nowhere else. Firmware evaluates a block that is folded for
//! that design, whose certificate says how far it is from the exact ball.

use std::sync::Arc;

use epas_design::CagedDesign;
pub use epas_design::files::calibration::ElementsName as ElementsKind;
use epas_friction::law::Elements;
use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, DirectionalCoefficient, RollingDrag, Viscosity,
};
use epas_friction::law::memory::{
    LoadExactElements, Part, PreloadedElements, ProportionalElements, SLIP_8,
};
use epas_friction::scene::SlidingFriction;
use epas_friction::{Clearance, Error, RollingResistance};

use super::exact::{ExactLaw, Grid, Spacing};
use super::quantities::Values;
use epas_page::failure::Failure;

/// Elements of every calibrated memory.
pub const ELEMENTS: usize = 8;

/// Distance of the second point of a viscosity from the reference temperature, K.
const SECOND: f32 = 60.0;

/// Viscosity at the reference temperature, Pa s, where only its growth matters.
const VISCOSITY: f32 = 0.1;

/// Coldest temperature of a lubricant, K.
pub const COLDEST: f32 = 150.0;

/// What of a screw is not estimated from a trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Its design; friction, fit and rolling resistance are replaced.
    pub caged: CagedDesign,
    /// How elements follow the load.
    pub elements: ElementsKind,
    /// Whether the fit is that of the preload; else it is the design's own.
    pub preloaded: bool,
    /// Temperature of the half-share speed, K.
    pub reference_temperature: f64,
    /// Axial load of the breakaway angle, N, not below 0.
    pub reference_load: f64,
    /// Largest axial load of the trace, N.
    pub largest_load: f64,
}

/// Gross sliding with the coefficient at standstill, at the reference load and at the largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Mean friction of both directions, N m.
    pub torque: f32,
    /// Load of the elements there, N.
    pub load: f32,
    /// That at the largest load over it.
    pub largest_load: f32,
}

impl Screw {
    /// The design with the values' friction, fit and rolling resistance.
    pub fn scene(&self, values: &Values) -> Result<CagedDesign, Error> {
        let design = self.caged.design;
        CagedDesign {
            friction: values.friction as f32,
            rolling_resistance: RollingResistance {
                hysteresis_loss: values.hysteresis_loss as f32,
                lubricant_drag: values.lubricant_drag as f32,
            },
            clearance: if self.preloaded {
                Clearance::of_preload(&design, values.preload as f32)?
            } else {
                self.caged.clearance
            },
            ..self.caged
        }
        .checked()
    }

    /// Law of the friction coefficient. Churned lubricant counts as a torque of its own.
    pub fn coefficient(&self, values: &Values) -> CoefficientParameters {
        CoefficientParameters {
            boundary: values.friction as f32,
            full_film: (values.full_film_ratio * values.friction) as f32,
            half_share_speed: values.half_share_speed as f32,
            reference_temperature: self.reference_temperature as f32,
            viscosity: self
                .viscosity(values)
                .unwrap_or(epas_friction::defaults::VISCOSITY),
            forward: (1.0 + values.direction_asymmetry) as f32,
            backward: (1.0 - values.direction_asymmetry) as f32,
            churning: 0.0,
            drag: RollingDrag::NONE,
        }
    }

    /// A viscosity with the values' pole.
    pub fn viscosity(&self, values: &Values) -> Result<Viscosity, Error> {
        let [cold, warm] = self.viscosities(values);
        Viscosity::through(cold, warm, COLDEST)
    }

    /// Two temperatures, K, with viscosities, Pa s, that have the values' pole: in proportion to the power -5 of the distance from it.
    pub fn viscosities(&self, values: &Values) -> [(f32, f32); 2] {
        let (reference, pole) = (
            self.reference_temperature as f32,
            values.viscosity_pole as f32,
        );
        let ratio = (reference - pole) / (reference + SECOND - pole);
        [
            (reference, VISCOSITY),
            (reference + SECOND, VISCOSITY * ratio.powi(5)),
        ]
    }

    /// The exact ball, solved for what a fit asks for, from these values on.
    pub fn grid(&self, values: &Values, spacing: Spacing) -> Result<Arc<Grid>, Failure> {
        let largest = self.largest_load.max(self.reference_load);
        Ok(Grid::of(&self.scene(values)?, largest, spacing)?)
    }

    /// Gross sliding at the reference load.
    pub fn reference(&self, values: &Values) -> Result<Reference, Failure> {
        let friction = values.friction as f32;
        let grid = self.grid(values, Spacing::WRITTEN)?;
        let law = grid.law(&self.scene(values)?, (friction, friction))?;
        Ok(self.reference_of(&law, values))
    }

    /// The same by a law that there is.
    fn reference_of(&self, law: &ExactLaw, values: &Values) -> Reference {
        let friction = DirectionalCoefficient {
            forward: values.friction as f32,
            backward: values.friction as f32,
        };
        let limits = |load: f64| law.friction(load as f32, friction);
        let largest = limits(self.largest_load);
        let SlidingFriction {
            forward,
            backward,
            load,
        } = limits(self.reference_load);
        Reference {
            torque: 0.5 * (forward + backward),
            load,
            largest_load: largest.load / load,
        }
    }

    /// Elements in constant shares of the friction.
    pub fn proportional(
        &self,
        values: &Values,
        reference: &Reference,
    ) -> Result<ProportionalElements<ELEMENTS>, Error> {
        let whole = Part {
            backbone: &SLIP_8.elements,
            share: 1.0,
            breakaway_angle: values.breakaway_angle as f32,
        };
        ProportionalElements::new(reference.torque, &[whole])
    }

    /// Elements that come into contact with the load.
    pub fn load_exact(
        &self,
        values: &Values,
        reference: &Reference,
    ) -> Result<LoadExactElements<ELEMENTS>, Error> {
        LoadExactElements::new(
            reference.torque,
            values.breakaway_angle as f32,
            reference.largest_load,
        )
    }

    /// Elements that come into contact with the load that both flanks share.
    pub fn preloaded(
        &self,
        values: &Values,
        reference: &Reference,
    ) -> Result<PreloadedElements<LoadExactElements<ELEMENTS>>, Error> {
        let shared = Reference {
            largest_load: self.largest_load_of_elements(reference),
            ..*reference
        };
        Ok(PreloadedElements::new(self.load_exact(values, &shared)?))
    }

    /// Largest load of the elements over that at the reference.
    pub fn largest_load_of_elements(&self, reference: &Reference) -> f32 {
        match self.elements {
            ElementsKind::Preloaded => PreloadedElements::new(()).shared(reference.largest_load),
            _ => reference.largest_load,
        }
    }

    /// The law of these values: for all friction coefficients that they take.
    pub fn law(&self, values: &Values, grid: &Grid) -> Result<ExactLaw, Failure> {
        let (least, largest) = CoefficientLaw::new(&self.coefficient(values))?.extremes();
        let own = values.friction as f32;
        let coefficients = (least.min(own), largest.max(own));
        Ok(grid.law(&self.scene(values)?, coefficients)?)
    }

    /// Friction torque at every sample, N m, by the exact ball.
    pub fn friction(
        &self,
        values: &Values,
        course: &Course,
        grid: &Grid,
    ) -> Result<Vec<f64>, Failure> {
        let law = &self.law(values, grid)?;
        let reference = self.reference_of(law, values);
        let coefficient = CoefficientLaw::new(&self.coefficient(values))?;
        let stepped = Stepped {
            law,
            coefficient,
            reference_load: reference.load,
            half_backlash: 0.5 * values.backlash,
        };
        Ok(match self.elements {
            ElementsKind::Proportional => {
                stepped.along(&self.proportional(values, &reference)?, course)
            }
            ElementsKind::Preloaded => stepped.along(&self.preloaded(values, &reference)?, course),
            ElementsKind::LoadExact => stepped.along(&self.load_exact(values, &reference)?, course),
        })
    }
}

/// What the model is told at every sample; all of one length.
#[derive(Clone, Debug)]
pub struct Course {
    /// Angle of the nut's sensor, rad.
    pub angle: Vec<f64>,
    /// Speed, rad/s.
    pub speed: Vec<f64>,
    /// Axial load, N: one without noise, which would cut what elements hold before they slide, whenever it lowers their limits.
    pub load: Option<Vec<f64>>,
    /// Temperature, K.
    pub temperature: Vec<f64>,
}

/// What a memory is stepped with: friction of gross sliding in both directions at every sample, and the turn behind the backlash.
struct Stepped<'a> {
    law: &'a ExactLaw,
    coefficient: CoefficientLaw,
    reference_load: f32,
    half_backlash: f64,
}

impl Stepped<'_> {
    /// Friction torque at every sample, N m, at rest before the first.
    fn along<E: Elements>(&self, elements: &E, course: &Course) -> Vec<f64> {
        let mut state = E::VIRGIN;
        let mut angle = course.angle.first().copied().unwrap_or(0.0);
        let samples = course
            .angle
            .iter()
            .zip(&course.speed)
            .zip(&course.temperature);
        samples
            .enumerate()
            .map(|(sample, ((reading, speed), temperature))| {
                let last = angle;
                angle = angle
                    .max(reading - self.half_backlash)
                    .min(reading + self.half_backlash);
                let now = self.coefficient.at_temperature(*temperature as f32);
                let load = course.load.as_ref().map_or(0.0, |load| load[sample]);
                let full = self.law.friction(load as f32, now.both(*speed as f32));
                let limits = full.limits(1.0 / self.reference_load);
                elements
                    .follow(&mut state, (angle - last) as f32, &limits)
                    .into()
            })
            .collect()
    }
}
