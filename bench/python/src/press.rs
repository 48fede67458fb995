//! Balls of a row that press on each other.

use epas_friction::Error;
use epas_friction::train::{IMPEDANCE_RANGE, LARGEST_FREE_SPEED, Press};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::blocks::{Block, Kernel};
use crate::errors::{Refused, refused};
use crate::memory::room;
use crate::numbers::{arguments, within};

/// Most balls of a row.
const MOST: usize = 64;

/// Forces between the balls of rows that touch: which of them press on the one in front, and how hard.
///
/// A ball alone runs at its free speed; a net push ``P`` makes it run at ``free_speed + P / impedance``; no ball passes through
/// another. The forces are the multipliers of an isotonic regression, found in one exact pass.
///
/// Args:
///     free_speed: deviation from nominal rolling over the nominal speed, -1 to 1, shape (..., n): 2 to 64 balls, rear to front.
///     impedance: net push over the change of speed that it makes, 1e-9 to 1e9, the same shape or one that broadcasts.
///
/// Returns:
///     ndarray: force between each ball and the one in front, in the unit of the impedance, float32, shape (..., n - 1).
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays, or another number of balls.
#[pyfunction]
pub fn contact_forces<'py>(
    py: Python<'py>,
    free_speed: Bound<'py, PyAny>,
    impedance: Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let arguments = arguments(py, ["free_speed", "impedance"], [&free_speed, &impedance])?;
    let mut shape = arguments.shape().to_vec();
    let balls = match shape.last_mut() {
        Some(balls) if (2..=MOST).contains(balls) => {
            *balls -= 1;
            *balls + 1
        }
        _ => {
            let message =
                format!("a row has 2 to {MOST} balls along the last axis; the shape is {shape:?}");
            return Err(refused(py, Refused::shape("free_speed", message)));
        }
    };
    let mut forces = room(arguments.len() / balls * (balls - 1))?;
    let rows = Rows {
        row: Row::new(balls).map_err(|error| refused(py, error))?,
        forces: &mut forces,
    };
    arguments.map_blocks::<f32, _, 0>(py, rows)?;
    shaped(py, forces, &shape)
}

/// Rows one after the other, with the forces that were found.
struct Rows<'a> {
    row: Row,
    forces: &'a mut Vec<f32>,
}

impl Kernel<f32, 2, 0> for Rows<'_> {
    fn one(&mut self, [speed, impedance]: [f32; 2]) -> Result<[f32; 0], Refused> {
        let fastest = f64::from(LARGEST_FREE_SPEED);
        within("free_speed", speed.into(), -fastest, fastest)?;
        let (least, most) = IMPEDANCE_RANGE;
        within("impedance", impedance.into(), least.into(), most.into())?;
        self.row.add(&[speed], &[impedance], self.forces);
        Ok([])
    }

    /// All balls of a block, which begins and ends anywhere in a row.
    fn block(&mut self, block: &mut Block<'_, f32, 2, 0>) -> bool {
        let [speeds, impedances] = block.inputs;
        let (least, most) = IMPEDANCE_RANGE;
        let good = speeds.iter().all(|speed| speed.abs() <= LARGEST_FREE_SPEED)
            && impedances
                .iter()
                .all(|impedance| (least..=most).contains(impedance));
        if good {
            self.row.add(speeds, impedances, self.forces);
        }
        good
    }
}

/// A row that is filled with balls as they come.
struct Row {
    place: usize,
    free: Vec<f32>,
    impedance: Vec<f32>,
    room: Vec<f32>,
    press: Press<MOST>,
}

impl Row {
    /// A row of so many balls.
    fn new(balls: usize) -> Result<Self, Error> {
        let mut room = vec![0.0; balls];
        if let Some(last) = room.last_mut() {
            *last = f32::INFINITY;
        }
        Ok(Self {
            place: 0,
            free: vec![0.0; balls],
            impedance: vec![1.0; balls],
            room,
            press: Press::with_balls(balls)?,
        })
    }

    /// Takes in balls; the last one of a row lets them press.
    fn add(&mut self, mut speeds: &[f32], mut impedances: &[f32], forces: &mut Vec<f32>) {
        while !speeds.is_empty() {
            let end = self.free.len().min(self.place + speeds.len());
            let count = end - self.place;
            self.free[self.place..end].copy_from_slice(&speeds[..count]);
            self.impedance[self.place..end].copy_from_slice(&impedances[..count]);
            (speeds, impedances) = (&speeds[count..], &impedances[count..]);
            self.place = end;
            if end == self.free.len() {
                self.place = 0;
                self.press.solve(&self.free, &self.impedance, &self.room);
                forces.extend(self.press.forces().take(end - 1));
            }
        }
    }
}
