//! Balls of a row that press on each other.

use epas_friction::train::{IMPEDANCE_RANGE, LARGEST_FREE_SPEED, Press};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::errors::{Refused, refused};
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
    let mut forces = Vec::with_capacity(arguments.len() / balls * (balls - 1));
    let mut row = row(balls);
    arguments.each(py, |[speed, impedance]: [f32; 2]| {
        let fastest = f64::from(LARGEST_FREE_SPEED);
        within("free_speed", speed.into(), -fastest, fastest)?;
        let (least, most) = IMPEDANCE_RANGE;
        within("impedance", impedance.into(), least.into(), most.into())?;
        row.add(speed, impedance, &mut forces);
        Ok(())
    })?;
    shaped(py, forces, &shape)
}

/// A row that is filled ball by ball.
trait Row: Send {
    /// Takes in a ball; the last one of a row lets them press.
    fn add(&mut self, speed: f32, impedance: f32, forces: &mut Vec<f32>);
}

/// A row of so many balls.
fn row(balls: usize) -> Box<dyn Row> {
    match balls {
        0..=8 => Box::new(RowOf::<8>::new(balls)),
        9..=16 => Box::new(RowOf::<16>::new(balls)),
        17..=24 => Box::new(RowOf::<24>::new(balls)),
        25..=32 => Box::new(RowOf::<32>::new(balls)),
        33..=40 => Box::new(RowOf::<40>::new(balls)),
        41..=48 => Box::new(RowOf::<48>::new(balls)),
        _ => Box::new(RowOf::<MOST>::new(balls)),
    }
}

/// A row with room for `N` balls; what is beyond its balls touches nothing.
struct RowOf<const N: usize> {
    balls: usize,
    place: usize,
    free: [f32; N],
    impedance: [f32; N],
    room: [f32; N],
    press: Press<N>,
}

impl<const N: usize> RowOf<N> {
    fn new(balls: usize) -> Self {
        let mut room = [f32::INFINITY; N];
        room[..balls - 1].fill(0.0);
        Self {
            balls,
            place: 0,
            free: [0.0; N],
            impedance: [1.0; N],
            room,
            press: Press::new(),
        }
    }
}

impl<const N: usize> Row for RowOf<N> {
    fn add(&mut self, speed: f32, impedance: f32, forces: &mut Vec<f32>) {
        self.free[self.place] = speed;
        self.impedance[self.place] = impedance;
        self.place += 1;
        if self.place == self.balls {
            self.place = 0;
            self.press.solve(&self.free, &self.impedance, &self.room);
            forces.extend(self.press.forces().take(self.balls - 1));
        }
    }
}
