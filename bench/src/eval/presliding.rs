//! `presliding`: friction with a memory along a path of angles.
//!
//! `exact` is what the elements stand for: Masing's rules by a stack of turning points where limits are constant; under load-exact limits
//! 4000 elements, as the stored cases were made with, within 7e-7 of the closed form there
//! ([`answers`](epas_reference::presliding::answers)).

use std::num::NonZeroUsize;

use epas_friction::law::SlidingLimits;
use epas_friction::law::memory::{
    BackboneElement, Hysteresis, LoadExactElements, Part, ProportionalElements, SLIP_4, SLIP_6,
    SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
};
use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::{self, Answers, answers};
use epas_reference::presliding::tables::{self, Table};
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

/// Load-exact elements of a request.
const EIGHT: NonZeroUsize = NonZeroUsize::new(8).unwrap();

/// Most values of `angle`.
const LONGEST: usize = 100_000;

/// Most that an angle may be, over the breakaway angle; and a load and a limit, over the reference.
const LARGEST: f64 = 1e6;

/// Every table by its name, the crate's and the reference's.
const TABLES: [(&str, (&[BackboneElement], Table)); 8] = [
    ("slip4", (&SLIP_4.elements, tables::SLIP_4)),
    ("slip6", (&SLIP_6.elements, tables::SLIP_6)),
    ("slip8", (&SLIP_8.elements, tables::SLIP_8)),
    ("slip10", (&SLIP_10.elements, tables::SLIP_10)),
    ("spin4", (&SPIN_4.elements, tables::SPIN_4)),
    ("spin6", (&SPIN_6.elements, tables::SPIN_6)),
    ("spin8", (&SPIN_8.elements, tables::SPIN_8)),
    ("spin10", (&SPIN_10.elements, tables::SPIN_10)),
];

#[derive(Clone, Copy)]
enum Form {
    Proportional,
    LoadExact,
}

#[derive(Serialize)]
struct Torques {
    torque: Vec<f64>,
}

#[derive(Serialize)]
struct Reference {
    torque: Vec<f64>,
    /// None where elements in proportion follow a load.
    exact: Option<Vec<f64>>,
}

/// Angles over the breakaway angle, loads over the reference, one a tick; and either limit over the load.
struct Path {
    angles: Vec<f64>,
    /// None for the reference load throughout.
    loads: Option<Vec<f64>>,
    limit_ratio: [f64; 2],
}

impl Path {
    fn take(fields: &mut Fields) -> Result<Self, BadField> {
        let angles = fields.list("angle", LONGEST)?;
        for &angle in &angles {
            in_range("angle", angle, -LARGEST, LARGEST)?;
        }
        let loads = match fields.optional_list("load", LONGEST)? {
            Some(loads) if loads.len() == angles.len() => Some(loads),
            Some(loads) => {
                let message = format!("{} values; angle has {}", loads.len(), angles.len());
                return Err(BadField::new("load", message));
            }
            None => None,
        };
        for &load in loads.iter().flatten() {
            in_range("load", load, 0.0, LARGEST)?;
        }
        let limit_ratio = fields.numbers("limit_ratio")?;
        for ratio in limit_ratio {
            in_range("limit_ratio", ratio, 0.0, LARGEST)?;
        }
        Ok(Self {
            angles,
            loads,
            limit_ratio,
        })
    }

    /// Friction at each angle, by the crate: turns are differences of angles.
    fn torques<E: Hysteresis>(&self, elements: &E) -> Torques {
        let mut state = E::VIRGIN;
        let loads = self.loads.as_deref().unwrap_or(&[]).iter().skip(1);
        let loads = loads.copied().chain(std::iter::repeat(1.0));
        let ticks = self.angles.windows(2).zip(loads);
        let torques = ticks.map(|(angles, load)| {
            let [forward, backward] = self.limit_ratio.map(|ratio| (ratio * load) as f32);
            let limits = SlidingLimits {
                forward,
                backward,
                load: load as f32,
            };
            let turn = angles.last().unwrap_or(&0.0) - angles.first().unwrap_or(&0.0);
            f64::from(elements.follow(&mut state, turn as f32, &limits))
        });
        Torques {
            torque: std::iter::once(0.0).chain(torques).collect(),
        }
    }

    /// Friction at each angle, by the reference.
    fn reference(&self, form: &answers::Form) -> Reference {
        let [forward, backward] = self.limit_ratio;
        let path = answers::Path {
            angle: &self.angles,
            load: self.loads.as_deref(),
            ratio: Limits { forward, backward },
        };
        let Answers { torque, exact } = answers(&path, form);
        Reference { torque, exact }
    }

    fn proportional(&self, backbone: &[BackboneElement]) -> Result<Torques, BadField> {
        let parts = [Part {
            backbone,
            share: 1.0,
            breakaway_angle: 1.0,
        }];
        Ok(match backbone.len() {
            4 => self.torques(&ProportionalElements::<4>::new(1.0, &parts)?),
            6 => self.torques(&ProportionalElements::<6>::new(1.0, &parts)?),
            8 => self.torques(&ProportionalElements::<8>::new(1.0, &parts)?),
            _ => self.torques(&ProportionalElements::<10>::new(1.0, &parts)?),
        })
    }
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let form = fields.choice(
        "form",
        &[
            ("proportional", Form::Proportional),
            ("load_exact", Form::LoadExact),
        ],
    )?;
    let path = Path::take(&mut fields)?;
    let (in_loop, reference) = match form {
        Form::Proportional => {
            let (backbone, table) = fields.choice("table", &TABLES)?;
            fields.finish()?;
            let form = answers::Form::Proportional(table);
            (path.proportional(backbone)?, path.reference(&form))
        }
        Form::LoadExact => {
            let largest_load = fields.number("largest_load")?;
            fields.finish()?;
            let elements = LoadExactElements::<8>::new(1.0, 1.0, largest_load as f32)?;
            let form = answers::Form::LoadExact {
                count: EIGHT,
                largest_load,
            };
            (path.torques(&elements), path.reference(&form))
        }
    };
    Answer::both(&in_loop, &reference)
}
