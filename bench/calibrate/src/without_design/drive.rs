//! What firmware takes of a trace without a design: the numbers of the scene `LoadProportionalScrew`, and those of the rig.

use crate::fit::separable::{FitSettings, fit};
use crate::fit::uncertainty::{Interval, Uncertainty};
use crate::trace::Coordinate;
use crate::trace::channels::range;
use crate::without_design::choice::{LOAD_PROPORTIONAL, Prepared};
use crate::without_design::slide::{DRAG, GAIN, INERTIA, LEVEL, LOSS, LOSSES, OFFSET};
use crate::without_design::terms::{LoadTerm, Terms};
use epas_page::failure::Failure;

/// Factor by which firmware believes in more than the trace has.
const ROOM: f64 = 2.0;

/// Numbers of a drive without a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    coordinate: Coordinate,
    /// Estimates, by name.
    intervals: Vec<Interval>,
    load: LoadTerm,
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
    /// What a plain model of a trace tells.
    pub fn of(prepared: &Prepared<'_>, terms: Terms, sure: &Uncertainty) -> Self {
        let largest = |values: &[f64]| {
            let (low, high) = range(values);
            high.max(-low)
        };
        Self {
            coordinate: prepared.trace.coordinate,
            intervals: sure.intervals.clone(),
            load: terms.load,
            reversal_speed: reversal_speed(prepared, terms),
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
        let load_lever = match self.load {
            LoadTerm::None | LoadTerm::Losses { .. } => 1.0,
            LoadTerm::Gain | LoadTerm::LossAlike => self.value(GAIN)?,
        };
        let (losses, told) = if self.load == LoadTerm::LossAlike {
            let loss = self.value(LOSS)? / load_lever;
            ([loss; 2], [true; 2])
        } else {
            let told = self.load.losses();
            let mut losses = [0.0; 2];
            for ((loss, name), told) in losses.iter_mut().zip(LOSSES).zip(told) {
                if told {
                    *loss = self.value(name)?;
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
            inertia: self.value(INERTIA[0])?,
            offset: self.value(OFFSET)?,
        })
    }

    /// An estimate that firmware may have.
    fn value(&self, name: &str) -> Result<f64, Failure> {
        let refused = |why: &str| {
            let name = name.replace('_', " ");
            Err(Failure::Data(format!("no constants: the {name} {why}")))
        };
        let Some(found) = self.intervals.iter().find(|found| found.name == name) else {
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

/// The speed over which friction reverses, by the whole trace; `None` where it is sharper than the trace shows.
fn reversal_speed(prepared: &Prepared<'_>, terms: Terms) -> Option<f64> {
    if terms.one_speed {
        return None;
    }
    let slide = prepared.slide(LOAD_PROPORTIONAL, terms);
    let settings = FitSettings {
        robust: false,
        ..FitSettings::default()
    };
    let found = fit(&slide, &settings).ok()?;
    let speed = found.nonlinear.first().copied()?;
    found.at_bound.is_empty().then_some(speed)
}
