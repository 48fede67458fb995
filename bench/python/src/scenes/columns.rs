//! Outputs of scenes over a trace, as one list for each name.

use epas_cli::bindings::TickOutputs;
use epas_friction::Regime;
use pyo3::prelude::*;

use crate::arrays::{Arguments, shaped};
use crate::blocks::Real;
use crate::memory::room;
use crate::results::result;

/// A regime as a number of `results.Regime`.
pub const fn regime(regime: Regime) -> u8 {
    match regime {
        Regime::Standing => 0,
        Regime::Driving => 1,
        Regime::BackDriving => 2,
        Regime::Locked => 3,
    }
}

/// Outputs of a scene, which Python has as a tuple for one tick and as arrays for a trace.
pub trait Columns: Send + Sized {
    /// Room for so many ticks.
    fn with_capacity(ticks: usize) -> PyResult<Self>;

    /// A tick more.
    fn push(&mut self, outputs: &TickOutputs);

    /// As arrays.
    fn run(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>>;

    /// One tick.
    fn tick<'py>(py: Python<'py>, outputs: &TickOutputs) -> PyResult<Bound<'py, PyAny>>;

    /// Every tick of a trace, without the interpreter's lock.
    fn of<T: Real, const I: usize>(
        py: Python<'_>,
        trace: &Arguments<'_, I>,
        mut step: impl FnMut([T; I]) -> TickOutputs + Send,
    ) -> PyResult<Self> {
        let mut columns = Self::with_capacity(trace.len())?;
        trace.each(py, |values| {
            columns.push(&step(values));
            Ok(())
        })?;
        Ok(columns)
    }
}

/// A regime and a set of faults as Python knows them.
fn flags(
    py: Python<'_>,
    regime: Regime,
    faults: epas_friction::Faults,
) -> PyResult<[Bound<'_, PyAny>; 2]> {
    Ok([
        result(py, "Regime", (self::regime(regime),))?,
        result(py, "Faults", (faults.bits(),))?,
    ])
}

/// Lists of one scene's outputs: name, type, and how each is taken from a tick.
macro_rules! columns {
    ($(#[$doc:meta])* $name:ident, $run:literal, $tick:literal:
     $($field:ident: $kind:ty,)*) => {
        $(#[$doc])*
        pub struct $name {
            $($field: Vec<$kind>,)*
            regime: Vec<u8>,
            faults: Vec<u16>,
        }

        impl Columns for $name {
            fn with_capacity(ticks: usize) -> PyResult<Self> {
                Ok(Self {
                    $($field: room(ticks)?,)*
                    regime: room(ticks)?,
                    faults: room(ticks)?,
                })
            }

            fn push(&mut self, outputs: &TickOutputs) {
                $(self.$field.push(outputs.$field);)*
                self.regime.push(regime(outputs.regime));
                self.faults.push(outputs.faults.bits());
            }

            fn run(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
                let shape = [self.regime.len()];
                result(py, $run, (
                    $(shaped(py, self.$field, &shape)?,)*
                    shaped(py, self.regime, &shape)?,
                    shaped(py, self.faults, &shape)?,
                ))
            }

            fn tick<'py>(py: Python<'py>, outputs: &TickOutputs) -> PyResult<Bound<'py, PyAny>> {
                let [regime, faults] = flags(py, outputs.regime, outputs.faults)?;
                result(py, $tick, ($(outputs.$field,)* regime, faults))
            }
        }
    };
}

columns! {
    /// Of a ball screw.
    ScrewColumns, "Run", "Outputs":
    friction: f32,
    load_torque: f32,
    efficiency: f32,
}

columns! {
    /// Of a ball screw whose balls press on each other.
    UncagedColumns, "UncagedRun", "UncagedOutputs":
    friction: f32,
    groove: f32,
    ball: f32,
    load_torque: f32,
    contacts: u8,
    largest_contact_force: f32,
}

columns! {
    /// Of a linear bearing.
    LinearColumns, "LinearRun", "LinearOutputs":
    friction: f32,
    groove: f32,
    ball: f32,
    contacts: u8,
    largest_contact_force: f32,
}
