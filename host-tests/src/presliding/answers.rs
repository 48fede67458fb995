//! Torque over a whole path: what a request asks for, and what a stored case holds.

use std::num::NonZeroUsize;

use super::Limits;
use super::elements::Elements;
use super::load_exact::LoadExact;
use super::masing::Masing;
use super::tables::Table;

/// A path in angle and load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path<'a> {
    /// Angles, over the breakaway angle; the first is the start, where nothing is remembered.
    pub angle: &'a [f64],
    /// Loads, over the reference load, as many as angles; one where there are none.
    pub load: Option<&'a [f64]>,
    /// Limits over the load.
    pub ratio: Limits,
}

/// Elements of the dense answer under a load that changes: as many as the stored cases were made with.
pub const DENSE: usize = 4000;

/// How elements divide the limit among themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// In proportion, by a table.
    Proportional(Table),
    /// As a Hertzian contact does, up to a largest load.
    LoadExact {
        /// Elements.
        count: NonZeroUsize,
        /// Largest load, over the reference load.
        largest_load: f64,
    },
}

impl Form {
    /// Elements with nothing remembered.
    pub fn elements(&self) -> Elements {
        match *self {
            Self::Proportional(table) => table.elements(),
            Self::LoadExact {
                count,
                largest_load,
            } => Elements::load_exact(count, largest_load),
        }
    }
}

/// A tick of a path: turn, limits and load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Turn since the tick before.
    pub turn: f64,
    /// Limits of sliding.
    pub limits: Limits,
    /// Load.
    pub load: f64,
}

impl Path<'_> {
    /// The ticks after the start.
    pub fn ticks(&self) -> impl Iterator<Item = Tick> {
        let loads = self.load.unwrap_or(&[]).iter().copied().skip(1);
        let turns = self.angle.iter().zip(self.angle.iter().skip(1));
        turns
            .map(|(before, after)| after - before)
            .zip(loads.chain(std::iter::repeat(1.0)))
            .map(|(turn, load)| Tick {
                turn,
                limits: self.ratio.times(load),
                load,
            })
    }

    /// Torques of elements: one for every angle, the first zero.
    pub fn torque(&self, mut elements: Elements) -> Vec<f64> {
        let follow = |tick: Tick| elements.follow(tick.turn, tick.limits, tick.load);
        std::iter::once(0.0)
            .chain(self.ticks().map(follow))
            .collect()
    }

    /// Torques that the elements of `form` stand for: by the stack of turning points under constant limits in proportion, by the broken line under
    /// limits of a Hertzian contact. None for elements in proportion under a load: what they stand for is not one law.
    pub fn exact(&self, form: &Form) -> Option<Vec<f64>> {
        let torques: Vec<f64> = match form {
            Form::Proportional(table) => {
                if self.load.is_some() {
                    return None;
                }
                let start = self.angle.first().copied().unwrap_or(0.0);
                let mut exact = Masing::new(table.backbone, self.ratio);
                let rest = self.angle.iter().skip(1);
                rest.map(|angle| exact.follow(angle - start)).collect()
            }
            Form::LoadExact { .. } => {
                let mut exact = LoadExact::new();
                self.ticks()
                    .map(|tick| exact.follow(tick.turn, self.ratio, tick.load))
                    .collect()
            }
        };
        Some(std::iter::once(0.0).chain(torques).collect())
    }
}

/// Answers to one request.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// Torques of the elements.
    pub torque: Vec<f64>,
    /// Torques that they stand for.
    pub exact: Option<Vec<f64>>,
}

/// Torques over a path by the elements of `form`, and what these stand for. Under a Hertzian contact's limits the exact torques are those
/// of [`DENSE`] elements up to the form's largest load, as in the stored cases: within 7e-7 of the closed form ([`Path::exact`]) there.
pub fn answers(path: &Path<'_>, form: &Form) -> Answers {
    Answers {
        torque: path.torque(form.elements()),
        exact: match *form {
            Form::Proportional(_) => path.exact(form),
            Form::LoadExact { largest_load, .. } => {
                Some(path.torque(Elements::dense(DENSE, largest_load)))
            }
        },
    }
}

/// Work that friction takes over a path: torque at the end of each tick times its turn.
pub fn work(path: &Path<'_>, torque: &[f64]) -> f64 {
    path.ticks()
        .zip(torque.iter().skip(1))
        .map(|(tick, torque)| tick.turn * torque)
        .sum()
}
