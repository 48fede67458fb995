//! What scenes put out over a trace, as one list for each name.

use epas_friction::{LinearOutputs, Outputs, Regime, UncagedOutputs};
use pyo3::prelude::*;

use crate::arrays::shaped;
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
    /// Outputs of a tick.
    type Outputs: Copy + Send;

    /// Room for so many ticks.
    ///
    /// # Errors
    /// `MemoryError` where there is none.
    fn with_capacity(ticks: usize) -> PyResult<Self>;

    /// A tick more.
    fn push(&mut self, outputs: &Self::Outputs);

    /// As arrays.
    ///
    /// # Errors
    /// None that is known.
    fn run(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>>;

    /// One tick.
    ///
    /// # Errors
    /// None that is known.
    fn tick<'py>(py: Python<'py>, outputs: &Self::Outputs) -> PyResult<Bound<'py, PyAny>>;
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
    ($(#[$doc:meta])* $name:ident of $outputs:ty, $run:literal, $tick:literal:
     $($field:ident: $kind:ty,)*) => {
        $(#[$doc])*
        pub struct $name {
            $($field: Vec<$kind>,)*
            regime: Vec<u8>,
            faults: Vec<u16>,
        }

        impl Columns for $name {
            type Outputs = $outputs;

            fn with_capacity(ticks: usize) -> PyResult<Self> {
                Ok(Self {
                    $($field: room(ticks)?,)*
                    regime: room(ticks)?,
                    faults: room(ticks)?,
                })
            }

            fn push(&mut self, outputs: &$outputs) {
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

            fn tick<'py>(py: Python<'py>, outputs: &$outputs) -> PyResult<Bound<'py, PyAny>> {
                let [regime, faults] = flags(py, outputs.regime, outputs.faults)?;
                result(py, $tick, ($(outputs.$field,)* regime, faults))
            }
        }
    };
}

columns! {
    /// Of a ball screw.
    ScrewColumns of Outputs, "Run", "Outputs":
    friction_torque: f32,
    load_torque: f32,
    efficiency: f32,
}

columns! {
    /// Of a ball screw whose balls press on each other.
    UncagedColumns of UncagedOutputs, "UncagedRun", "UncagedOutputs":
    friction_torque: f32,
    groove_torque: f32,
    ball_torque: f32,
    load_torque: f32,
    contacts: u8,
    largest_contact_force: f32,
}

columns! {
    /// Of a linear bearing.
    LinearColumns of LinearOutputs, "LinearRun", "LinearOutputs":
    friction_force: f32,
    groove_force: f32,
    ball_force: f32,
    contacts: u8,
    largest_contact_force: f32,
}
