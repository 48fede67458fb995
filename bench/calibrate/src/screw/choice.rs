//! What is estimated of a screw, from which start and within which bounds.
//!
//! By default it is what the trace can tell: each quantity has a condition on what the trace excites. A request names quantities
//! itself, or sets some of them.

use epas_design::breakaway::{Breakaway, BreakawayConfiguration, ScrewContacts};
use epas_friction::Clearance;
use epas_friction::defaults;

use super::evidence::Evidence;
use super::friction::{ElementsKind, Screw};
use super::problem::Choice;
use super::quantities::{Factor, HARMONICS, Kind, QUANTITIES, Quantity, Values, names};
use crate::fit::problem::{Parameter, Scale};
use epas_design::files::Design;
use epas_design::files::coefficient::half_share_speed;
use epas_page::failure::Failure;

/// What is wanted of a calibration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Names of what is estimated; `None` for what the trace can tell.
    pub estimate: Option<Vec<String>>,
    /// Names with values of what is not.
    pub fix: Vec<(String, f64)>,
    /// Elements of the memory; `None` for what suits the preload.
    pub elements: Option<ElementsKind>,
}

/// Names that can be set but are never estimated.
const REFERENCE_TEMPERATURE: &str = "reference_temperature";
const REFERENCE_LOAD: &str = "reference_load";

/// Bounds of the friction coefficient, of its ratio on a full film and of its asymmetry: their product stays below 0.5.
const FRICTION: (f64, f64) = (0.005, 0.25);
const FULL_FILM_RATIO: (f64, f64) = (0.1, 1.5);
const ASYMMETRY: (f64, f64) = (-0.3, 0.3);
/// Bounds of rolling resistance and backlash.
const HYSTERESIS_LOSS: (f64, f64) = (0.0, 0.2);
const LUBRICANT_DRAG: (f64, f64) = (0.0, 2.0);
const BACKLASH: (f64, f64) = (0.0, 0.1);
/// Half-share speeds, rad/s, and how far beyond the speeds of the trace they may lie.
const HALF_SHARE_SPEED: (f64, f64) = (0.02, 500.0);
const BEYOND_SPEEDS: f64 = 20.0;
/// Distance of the viscosity's pole below the coldest temperature, K: least and most.
const BELOW_COLDEST: (f64, f64) = (15.0, 250.0);
/// Preloads and breakaway angles over their start.
const PRELOAD: f64 = 30.0;
const BREAKAWAY: f64 = 50.0;
/// Tightest fit over the ball radius, just inside the crate's own limit.
const TIGHTEST: f32 = -0.0199;
/// Axial preload to begin with over the largest load, where the design has none.
const FIRST_PRELOAD: f64 = 0.2;
/// Least load of a contact for which a breakaway angle is designed, N.
const LEAST_LOAD: f32 = 0.1;

/// What the trace must excite for a quantity to be estimated by default.
pub mod needs {
    /// Speed that a tenth of the samples exceed over the one that a tenth stay below.
    pub const SPEEDS: f64 = 8.0;
    /// Range of the load's size over its largest.
    pub const LOAD_VARIATION: f64 = 0.3;
    /// Temperature range, K.
    pub const TEMPERATURE: f64 = 30.0;
    /// Turns of the direction.
    pub const REVERSALS: usize = 4;
    /// Angle, rad.
    pub const TURN: f64 = std::f64::consts::TAU;
    /// Acceleration over its noise.
    pub const ACCELERATION: f64 = 2.0;
}

/// A screw with start values and a choice.
#[derive(Clone, Debug)]
pub struct Start {
    /// The screw.
    pub screw: Screw,
    /// Values to begin with.
    pub values: Values,
    /// What is estimated.
    pub choice: Choice,
}

impl Start {
    /// From a design, for a trace.
    pub fn of(design: &Design, evidence: &Evidence, wanted: &Wanted) -> Result<Self, Failure> {
        let (mut screw, mut values) = begin(design, evidence, wanted)?;
        for (name, value) in &wanted.fix {
            if let Some(of) = Quantity::named(name) {
                values = of.with(*value, &values);
            }
        }
        if let Some(elements) = wanted.elements {
            screw.elements = elements;
        }
        let fixed = |name: &str| wanted.fix.iter().any(|(fixed, _)| fixed == name);
        let mut choice = Choice {
            nonlinear: Vec::new(),
            linear: Vec::new(),
        };
        for of in &QUANTITIES {
            let factor = of.factor();
            let wave = matches!(factor, Some(Factor::Wave(_)));
            let asked = |asked: &String| asked == of.name || wave && asked == HARMONICS;
            let told = || match factor {
                Some(factor) => tells_linear(factor, evidence),
                None => tells(of.name, evidence, &screw, &fixed),
            };
            let wanted = wanted.estimate.as_ref();
            if fixed(of.name) || !wanted.map_or_else(told, |list| list.iter().any(asked)) {
                continue;
            }
            match of.kind {
                Kind::Linear(..) => choice.linear.push(of),
                Kind::Nonlinear(scale) => {
                    let parameter = parameter(of, scale, &values, &screw, evidence)?;
                    choice.nonlinear.push((parameter, of));
                }
            }
        }
        if choice.nonlinear.is_empty() && choice.linear.is_empty() {
            return Err(Failure::Data("nothing is left to be estimated".into()));
        }
        Ok(Self {
            screw,
            values,
            choice,
        })
    }
}

fn known(name: &str) -> bool {
    names().any(|known| known == name)
}

fn unknown(name: &str) -> Failure {
    let known: Vec<&str> = names().collect();
    Failure::Data(format!("{name}: unknown; known are {}", known.join(", ")))
}

pub(crate) fn check_names(wanted: &Wanted) -> Result<(), Failure> {
    for name in wanted.estimate.iter().flatten() {
        if !known(name) && name != HARMONICS {
            return Err(unknown(name));
        }
        if wanted.fix.iter().any(|(fixed, _)| fixed == name) {
            return Err(Failure::Data(format!("{name} is both estimated and fixed")));
        }
    }
    for (name, value) in &wanted.fix {
        if !known(name) && name != REFERENCE_TEMPERATURE && name != REFERENCE_LOAD {
            return Err(unknown(name));
        }
        if !value.is_finite() {
            return Err(Failure::Data(format!(
                "{name} = {value} is NaN or infinite"
            )));
        }
    }
    Ok(())
}

fn begin(
    design: &Design,
    evidence: &Evidence,
    wanted: &Wanted,
) -> Result<(Screw, Values), Failure> {
    let caged = design.caged;
    let set = |name: &str| {
        let mut pairs = wanted.fix.iter();
        pairs
            .find(|(fixed, _)| fixed == name)
            .map(|(_, value)| *value)
    };
    let gap = caged.clearance.gap();
    let asked = |list: &Vec<String>| list.iter().any(|name| name == "preload");
    let asked = wanted.estimate.as_ref().is_some_and(asked) || set("preload").is_some();
    let preloaded =
        gap < 0.0 || asked || gap == 0.0 && wanted.estimate.is_none() && varies(evidence);
    if !preloaded && evidence.load.is_none() {
        return Err(Failure::Data(
            "without an axial load and without a preload the screw's friction cannot be told: add a column axial_load, or a preload to the design"
                .into(),
        ));
    }
    let mut screw = Screw {
        caged,
        elements: ElementsKind::LoadExact,
        preloaded,
        reference_temperature: set(REFERENCE_TEMPERATURE)
            .unwrap_or(f64::from(defaults::COEFFICIENT.reference_temperature)),
        reference_load: 0.0,
        largest_load: evidence.largest_load(),
    };
    let own = f64::from(caged.clearance.preload(&caged.design));
    let preload = if own > 0.0 {
        own
    } else {
        FIRST_PRELOAD * evidence.largest_load() / screw.axial_per_contact()
    };
    let coefficient = &defaults::COEFFICIENT;
    let mut values = Values {
        full_film_ratio: f64::from(coefficient.full_film / coefficient.boundary),
        half_share_speed: half_share_speed(&caged.design).into(),
        viscosity_pole: coefficient.viscosity.pole().into(),
        preload: set("preload").unwrap_or(preload),
        ..Values::of(&caged)
    };
    if !preloaded {
        screw.reference_load = 0.5 * evidence.largest_load();
    }
    if let Some(load) = set(REFERENCE_LOAD) {
        screw.reference_load = load;
    }
    if preloaded && screw.reference_load == 0.0 {
        screw.elements = ElementsKind::Preloaded;
    }
    values.breakaway_angle = screw.designed_breakaway(&values)?;
    Ok((screw, values))
}

fn varies(evidence: &Evidence) -> bool {
    evidence.load_variation() >= needs::LOAD_VARIATION
}

fn tells(name: &str, evidence: &Evidence, screw: &Screw, fixed: &dyn Fn(&str) -> bool) -> bool {
    let [slow, fast] = evidence.speeds;
    let speeds = fast >= needs::SPEEDS * slow && fast > 0.0;
    match name {
        "friction" => true,
        "full_film_ratio" | "half_share_speed" => speeds,
        "viscosity_pole" => speeds && evidence.temperature_range() >= needs::TEMPERATURE,
        "direction_asymmetry" => evidence.both_ways() && varies(evidence),
        // The level of the load's channel cannot be told from the friction that grows with the load.
        "hysteresis_loss" => fixed("gain") && varies(evidence),
        "preload" => screw.preloaded && varies(evidence),
        "breakaway_angle" => evidence.reversals >= needs::REVERSALS,
        _ => false,
    }
}

fn tells_linear(factor: Factor, evidence: &Evidence) -> bool {
    let [slow, fast] = evidence.speeds;
    match factor {
        Factor::Acceleration => evidence.acceleration >= needs::ACCELERATION,
        Factor::Speed => fast > 2.0 * slow,
        Factor::One => evidence.both_ways(),
        Factor::Load => varies(evidence),
        Factor::Wave(_) => evidence.range >= needs::TURN,
        Factor::Viscosity => false,
        // At one temperature it cannot be told from the drag and the film.
        Factor::RollingDrag => {
            fast > 2.0 * slow && evidence.temperature_range() >= needs::TEMPERATURE
        }
    }
}

fn parameter(
    of: &Quantity,
    scale: Scale,
    values: &Values,
    screw: &Screw,
    evidence: &Evidence,
) -> Result<Parameter, Failure> {
    let start = of.value(values);
    let [slow, fast] = evidence.speeds;
    let coldest = evidence
        .temperature
        .map_or(screw.reference_temperature, |[low, _]| {
            low.min(screw.reference_temperature)
        });
    let (low, high) = match of.name {
        "friction" => FRICTION,
        "full_film_ratio" => FULL_FILM_RATIO,
        "half_share_speed" => (
            HALF_SHARE_SPEED.0.max((slow / BEYOND_SPEEDS).min(start)),
            HALF_SHARE_SPEED.1.min((fast * BEYOND_SPEEDS).max(start)),
        ),
        "viscosity_pole" => (coldest - BELOW_COLDEST.1, coldest - BELOW_COLDEST.0),
        "direction_asymmetry" => ASYMMETRY,
        "hysteresis_loss" => HYSTERESIS_LOSS,
        "lubricant_drag" => LUBRICANT_DRAG,
        "preload" => {
            let design = &screw.caged.design;
            let tightest = Clearance::new(TIGHTEST * design.ball_radius())
                .map_err(|error| Failure::Data(error.to_string()))?;
            let hardest = f64::from(tightest.preload(design));
            let high = (start * PRELOAD).min(hardest);
            ((start / PRELOAD).max(2e-3).min(0.5 * high), high)
        }
        "breakaway_angle" => ((start / BREAKAWAY).max(1e-6), (start * BREAKAWAY).min(10.0)),
        _ => BACKLASH,
    };
    Ok(Parameter {
        name: of.name,
        unit: of.unit,
        start: start.max(low).min(high),
        low,
        high,
        scale,
    })
}

impl Screw {
    /// Axial force of a flank over the preload of a contact.
    pub fn axial_per_contact(&self) -> f64 {
        let design = &self.caged.design;
        let slope = design.contact_angle().sin * design.cos_lead_angle();
        f64::from(self.caged.loaded_balls) * f64::from(slope)
    }

    /// Axial preload of each flank, N.
    pub fn axial_preload(&self, values: &Values) -> f64 {
        if self.preloaded {
            self.axial_per_contact() * values.preload
        } else {
            0.0
        }
    }

    /// Breakaway angle of the design at the reference load, rad: 1.5 times torque over initial stiffness.
    fn designed_breakaway(&self, values: &Values) -> Result<f64, Failure> {
        let scene = self
            .scene(values)
            .map_err(|error| Failure::Data(error.to_string()))?;
        let contacts = ScrewContacts::of(&scene.design);
        let load = contacts.preloaded(
            self.reference_load as f32,
            scene.loaded_balls,
            scene.clearance,
        );
        let breakaway = Breakaway::of(
            &scene.design,
            &BreakawayConfiguration {
                friction: scene.friction,
                clearance: scene.clearance,
                rolling_resistance: scene.rolling_resistance,
                loaded_balls: scene.loaded_balls,
                contact_load: load.max(LEAST_LOAD),
            },
        )
        .map_err(|error| Failure::Data(error.to_string()))?;
        Ok(f64::from(1.5 * breakaway.torque / breakaway.stiffness()))
    }
}
