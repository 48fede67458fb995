//! Friction torque of gross sliding over load and friction coefficient, by the exact ball.
//!
//! A ball is solved exactly ([`LoadedScrew`]) at a grid of loads and coefficients; between them a cubic runs through four loads,
//! and a polynomial through all coefficients. `bench/rig/tests` compares it with balls that are solved off the grid.

use super::parameters::Screw;
use epas_reference::error::{ReferenceError, within};
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;

/// Loads of each sign: from nearly none to the largest.
const LOADS: usize = 80;

/// Friction coefficients of the grid.
const COEFFICIENTS: usize = 5;

/// Smallest load over the largest.
const SMALLEST: f64 = 1e-4;

/// Friction torque of a screw that slides everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct SlidingTorque {
    coefficients: [f64; COEFFICIENTS],
    /// Size of the load, N, rising.
    loads: Vec<f64>,
    /// Torques, N m, of a load that opposes the motion and of one that assists it: by load, then by coefficient.
    torques: [Vec<[f64; COEFFICIENTS]>; 2],
    preloaded: bool,
}

impl SlidingTorque {
    /// Solves the grid, in parallel.
    ///
    /// # Errors
    /// [`ReferenceError`] naming an input out of range, or of a ball whose balance is not found.
    pub fn new(screw: &Screw, coefficients: [f64; 2]) -> Result<Self, ReferenceError> {
        let [least, largest] = coefficients;
        within("least coefficient", least, 1e-3, 0.5)?;
        within("largest coefficient", largest, least, 0.5)?;
        within("largest_load", screw.largest_load, 1.0, 1e6)?;
        let coefficients = steps(least, largest);
        let loads = loads(screw);
        let clearance = screw.clearance()?;
        let screws: Vec<LoadedScrew> = [1.0, -1.0]
            .iter()
            .flat_map(|side| loads.iter().map(move |load| side * load))
            .flat_map(|axial_load| {
                coefficients.map(|friction| LoadedScrew {
                    axial_load,
                    ..screw.loaded(friction, clearance)
                })
            })
            .collect();
        let found = LoadedScrew::solve_all(&screws, &|| ())
            .into_iter()
            .map(|friction| friction.map(|friction| friction.torque()))
            .collect::<Result<Vec<f64>, _>>()?;
        let rows: Vec<[f64; COEFFICIENTS]> = found.as_chunks().0.to_vec();
        let (drive, backdrive) = rows.split_at(loads.len());
        Ok(Self {
            coefficients,
            torques: [drive.to_vec(), backdrive.to_vec()],
            preloaded: screw.axial_preload > 0.0,
            loads,
        })
    }

    /// Torque against a motion that a load opposes (above zero) or assists, N m.
    #[must_use]
    pub fn at(&self, opposing_load: f64, coefficient: f64) -> f64 {
        let [drive, backdrive] = &self.torques;
        let law = if opposing_load < 0.0 {
            backdrive
        } else {
            drive
        };
        let load = opposing_load.abs();
        let (below, [low, high]) = linear(&self.coefficients, coefficient);
        let torque = |row: &[f64; COEFFICIENTS]| low * row[below] + high * row[below + 1];
        let smallest = self.loads[0];
        if load < smallest {
            let at_smallest = torque(&law[0]);
            if !self.preloaded {
                return at_smallest * load / smallest;
            }
            // Through no load the torque of one direction becomes that of the other.
            let without = 0.5 * (torque(&drive[0]) + torque(&backdrive[0]));
            return without + (at_smallest - without) * load / smallest;
        }
        let above = self.loads.partition_point(|known| *known < load);
        let first = above.saturating_sub(2).min(self.loads.len() - 4);
        let (places, rows) = (&self.loads[first..first + 4], &law[first..first + 4]);
        let places = [places[0], places[1], places[2], places[3]];
        lagrange(&places, load)
            .iter()
            .zip(rows)
            .map(|(weight, row)| weight * torque(row))
            .sum()
    }
}

/// Loads that lie closer where the friction of a preload bends.
fn loads(screw: &Screw) -> Vec<f64> {
    let largest = screw.largest_load;
    let bend = if screw.axial_preload > 0.0 {
        (2.0 * screw.axial_preload / largest).min(1.0)
    } else {
        1e-3
    };
    let reach = (1.0 / bend).asinh();
    let start = (SMALLEST / bend).asinh();
    (0..LOADS)
        .map(|number| {
            let place = start + (reach - start) * number as f64 / (LOADS - 1) as f64;
            largest * bend * place.sinh()
        })
        .collect()
}

/// Coefficients at even steps.
fn steps(least: f64, largest: f64) -> [f64; COEFFICIENTS] {
    // Neighbours must differ.
    let width = (largest - least).max(1e-3 * largest);
    std::array::from_fn(|number| least + width * number as f64 / (COEFFICIENTS - 1) as f64)
}

/// Weights of the two neighbours of a place on even steps.
fn linear(places: &[f64; COEFFICIENTS], place: f64) -> (usize, [f64; 2]) {
    let step = places[1] - places[0];
    let along = (place - places[0]) / step;
    let below = along.floor().clamp(0.0, (COEFFICIENTS - 2) as f64);
    (below as usize, [1.0 + below - along, along - below])
}

/// Weights of values at `places` for the value of their polynomial at `place`.
fn lagrange<const N: usize>(places: &[f64; N], place: f64) -> [f64; N] {
    std::array::from_fn(|own| {
        (0..N)
            .filter(|other| *other != own)
            .map(|other| (place - places[other]) / (places[own] - places[other]))
            .product()
    })
}
