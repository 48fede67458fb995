//! What firmware takes of a trace without a design: the numbers of the scene `LoadProportionalScrew`, and those of the rig.

use crate::answer::Estimate;
use crate::estimator::terms::Term;
use crate::trace::Coordinate;
use crate::trace::channels::range;
use crate::without_design::models::reversal_speed;
use crate::without_design::slide::{Beside, Prepared};
use epas_page::failure::Failure;

const INERTIA: &str = "inertia";
const DRAG: &str = "viscous_friction";
const LEVEL: &str = "coulomb_friction";
const OFFSET: &str = "offset";

/// Factor by which firmware believes in more than the trace has.
const ROOM: f64 = 2.0;

/// Numbers of a drive without a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    coordinate: Coordinate,
    estimates: Vec<Estimate>,
    /// Terms of the load.
    load: Vec<Term>,
    /// Speed over which friction reverses, where the trace tells it, rad/s.
    reversal_speed: Option<f64>,
    /// Largest speed, rad/s, and load.
    largest: [f64; 2],
}

/// What the scene is set up with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Torque of a unit of load, m; 1 where the load is a torque.
    pub load_lever: f64,
    /// Friction torque without a load, N m.
    pub coulomb_friction: f64,
    /// Friction torque over the speed, N m s/rad.
    pub viscous_friction: f64,
    /// Losses of driving and back-driving over the load's torque.
    pub losses: [f64; 2],
    /// Which of them the trace told.
    pub told: [bool; 2],
    /// Speed over which friction reverses, rad/s, and whether the trace told it.
    pub reversal_speed: (f64, bool),
    /// Largest speed, rad/s, load, and friction torque, N m, that firmware believes.
    pub limits: [f64; 3],
    /// Inertia, kg m^2.
    pub inertia: f64,
    /// Torque that is always there, N m.
    pub offset: f64,
}

impl Drive {
    /// What an estimate of a trace tells.
    pub fn of(prepared: &Prepared<'_>, beside: &Beside, told: &[Estimate]) -> Self {
        let largest = |values: &[f64]| {
            let (low, high) = range(values);
            high.max(-low)
        };
        let slides = told.iter().any(|one| one.name == LEVEL);
        Self {
            coordinate: prepared.trace.coordinate,
            estimates: told.to_vec(),
            load: beside.load.clone(),
            reversal_speed: slides
                .then(|| reversal_speed(prepared, beside).ok().flatten())
                .flatten(),
            largest: [
                largest(&prepared.motion.speed),
                prepared.trace.load.as_deref().map_or(0.0, largest),
            ],
        }
    }

    /// What the scene is set up with.
    ///
    /// # Errors
    /// What the trace does not tell, or tells as something that the scene cannot have.
    pub fn numbers(&self) -> Result<Numbers, Failure> {
        if self.coordinate != Coordinate::Rotation {
            return Err(Failure::Data(
                "constants without a design are those of an angle and a torque, and the trace is of a travel and a force: give motor_torque and an angle, or the design".into(),
            ));
        }
        let coulomb_friction = self.value(LEVEL)?;
        let viscous_friction = self.value(DRAG)?;
        let load_lever = if self.load.contains(&Term::Gain) {
            self.value("load_gain")?
        } else {
            1.0
        };
        let (losses, told) = if self.load.contains(&Term::Loss) {
            ([self.value("load_loss")? / load_lever; 2], [true; 2])
        } else {
            let terms = [Term::Driving, Term::BackDriving];
            let told = terms.map(|term| self.load.contains(&term));
            let mut losses = [0.0; 2];
            for ((loss, term), told) in losses.iter_mut().zip(terms).zip(told) {
                if told {
                    *loss = self.value(term.name(self.coordinate))?;
                }
            }
            (losses, told)
        };
        let [speed, load] = self.largest.map(|largest| ROOM * largest);
        // A trace without a load has no limit of one.
        let load = if load > 0.0 { load } else { 1e3 };
        let friction = coulomb_friction
            + viscous_friction * speed
            + losses[0].max(losses[1]) * load_lever * load;
        Ok(Numbers {
            load_lever,
            coulomb_friction,
            viscous_friction,
            losses,
            told,
            reversal_speed: match self.reversal_speed {
                Some(speed) => (speed, true),
                None => (1e-3 * self.largest[0], false),
            },
            limits: [speed, load, ROOM * friction],
            inertia: self.value(INERTIA)?,
            offset: self.value(OFFSET)?,
        })
    }

    /// An estimate that firmware may have.
    fn value(&self, name: &str) -> Result<f64, Failure> {
        let refused = |why: &str| {
            let name = name.replace('_', " ");
            Err(Failure::Data(format!("no constants: the {name} {why}")))
        };
        let Some(found) = self.estimates.iter().find(|found| found.name == name) else {
            return refused("is not told by the trace");
        };
        if found.at_bound {
            return refused("ended at its bound");
        }
        if found.value < 0.0 && name != OFFSET {
            return refused("is below zero");
        }
        Ok(found.value)
    }
}
