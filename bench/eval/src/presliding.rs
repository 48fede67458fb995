//! `presliding`: friction with a memory along a path of angles.
//!
//! `exact` is what the elements stand for: Masing's rules by a stack of turning points where limits are constant; with load-exact elements the answer of
//! 4000 of them, as the stored cases were made with, within 7e-7 of the closed form there (`epas_reference::presliding::load_exact`).

use std::iter::repeat;
use std::num::NonZeroUsize;

use epas_friction::law::SlidingLimits;
use epas_friction::law::memory::{
    BackboneElement, Hysteresis, LoadExactElements, Part, ProportionalElements, SLIP_4, SLIP_6,
    SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
};
use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::{Form as Asked, Path as Ticks, answers};
use epas_reference::presliding::tables::Table;
use serde::Serialize;

use super::fields::{BadField, Fields, in_range};
use super::model::{Answer, Both};

/// Most values of `angle`.
const LONGEST: usize = 100_000;

/// Most that an angle may be, over the breakaway angle; and a load and a limit, over the reference.
const LARGEST: f64 = 1e6;

const TABLES: [(&str, &[BackboneElement]); 8] = [
    ("slip4", &SLIP_4.elements),
    ("slip6", &SLIP_6.elements),
    ("slip8", &SLIP_8.elements),
    ("slip10", &SLIP_10.elements),
    ("spin4", &SPIN_4.elements),
    ("spin6", &SPIN_6.elements),
    ("spin8", &SPIN_8.elements),
    ("spin10", &SPIN_10.elements),
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
struct Exact {
    torque: Vec<f64>,
    exact: Option<Vec<f64>>,
}

/// Elements of the load-exact form.
const BY_LOAD: NonZeroUsize = NonZeroUsize::new(8).unwrap();

/// Angles over the breakaway angle, loads over the reference, one a tick; and either limit over the load.
struct Path {
    angles: Vec<f64>,
    loads: Option<Vec<f64>>,
    limit_ratio: [f64; 2],
}

impl Path {
    fn take(fields: &mut Fields) -> Result<Self, BadField> {
        let angles = fields.list("angle", LONGEST)?;
        for &angle in &angles {
            in_range("angle", angle, -LARGEST, LARGEST)?;
        }
        let loads = fields.optional_list("load", LONGEST)?;
        let given = loads.as_ref().map_or(angles.len(), Vec::len);
        if given != angles.len() {
            let message = format!("{given} values; angle has {}", angles.len());
            return Err(BadField::new("load", message));
        }
        for &load in loads.iter().flatten() {
            in_range("load", load, 0.0, LARGEST)?;
        }
        let limit_ratio = fields.get::<[f64; 2]>("limit_ratio")?;
        for ratio in limit_ratio {
            in_range("limit_ratio", ratio, 0.0, LARGEST)?;
        }
        Ok(Self {
            angles,
            loads,
            limit_ratio,
        })
    }

    fn exact(&self, form: &Asked) -> Exact {
        let [forward, backward] = self.limit_ratio;
        let ticks = Ticks {
            angle: &self.angles,
            load: self.loads.as_deref(),
            ratio: Limits { forward, backward },
        };
        let found = answers(&ticks, form);
        Exact {
            torque: found.torque,
            exact: found.exact,
        }
    }

    /// Friction at each angle, by the crate: turns are differences of angles.
    fn torques<E: Hysteresis>(&self, elements: &E) -> Torques {
        let mut state = E::VIRGIN;
        let loads = self.loads.iter().flatten().copied().skip(1);
        let ticks = self.angles.windows(2).zip(loads.chain(repeat(1.0)));
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
    let forms = [
        ("proportional", Form::Proportional),
        ("load_exact", Form::LoadExact),
    ];
    let form = fields.choice("form", &forms)?;
    let path = Path::take(&mut fields)?;
    match form {
        Form::Proportional => {
            let names = TABLES.map(|(name, elements)| (name, (name, elements)));
            let (name, elements) = fields.choice("table", &names)?;
            fields.finish()?;
            let table = Table::named(name)
                .ok_or_else(|| BadField::new("table", "is unknown to the reference"))?;
            Both {
                in_loop: path.proportional(elements)?,
                reference: path.exact(&Asked::Proportional(table)),
            }
            .json()
        }
        Form::LoadExact => {
            let largest_load = fields.get::<f64>("largest_load")?;
            fields.finish()?;
            let elements = LoadExactElements::<8>::new(1.0, 1.0, largest_load as f32)?;
            let asked = Asked::LoadExact {
                count: BY_LOAD,
                largest_load,
            };
            Both {
                in_loop: path.torques(&elements),
                reference: path.exact(&asked),
            }
            .json()
        }
    }
}
