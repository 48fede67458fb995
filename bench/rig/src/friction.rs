//! Friction of the rig's screw: gross sliding by the exact ball, remembered by many elements.

use std::num::NonZeroUsize;

use crate::parameters::{Coefficient, Parameters, Screw, ZERO_CELSIUS};
use epas_reference::coefficient::{FilmContact, coefficient};
use epas_reference::curvature::Groove;
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::relative_radii;
use epas_reference::presliding::Limits;
use epas_reference::presliding::backbone::Backbone;
use epas_reference::presliding::elements::Elements;

/// Elements of slip under a changing load.
const SLIPPING: NonZeroUsize = NonZeroUsize::new(60).expect("60");

/// Elements of another backbone.
const OTHERS: usize = 60;

/// Angle, over the breakaway angle, at which the last element of spin slips; its backbone lies 2e-4 below one there.
const LAST_SPIN: f64 = 33.0;

/// Loads of each sign in the grid of the sliding torque: from nearly none to the largest.
const LOADS: usize = 80;

/// Friction coefficients of that grid.
const COEFFICIENTS: usize = 5;

/// Smallest load over the largest.
const SMALLEST: f64 = 1e-4;

/// What friction depends on at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    /// Turn since the last tick, rad.
    pub turn: f64,
    /// Speed of the nut, rad/s.
    pub speed: f64,
    /// Axial load, N.
    pub load: f64,
    /// Temperature, K.
    pub temperature: f64,
}

/// Friction of gross sliding of a rig.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sliding {
    torque: SlidingTorque,
    pub parameters: Parameters,
    /// Contact of a film, and the mean speed of its surfaces over the nut's, m.
    contact: FilmContact,
    entrainment: f64,
    /// Sum of both flanks at the reference load, N, and the limit of sliding there, N m.
    reference: [f64; 2],
}

impl Sliding {
    /// Solves what depends on no trace.
    pub fn new(parameters: Parameters) -> Result<Self, ReferenceError> {
        let screw = parameters.screw;
        let (boundary, full_film) = (parameters.boundary, parameters.full_film);
        let [forward, backward] = parameters.directions;
        let [weak, strong] = [forward.min(backward), forward.max(backward)];
        let coefficients = [
            weak * boundary.min(full_film),
            strong * boundary.max(full_film),
        ];
        let torque = SlidingTorque::new(&screw, coefficients)?;
        let load = parameters.reference_axial_load;
        let sum = screw.flank_sum(load);
        let limit = 0.5 * (torque.at(load, boundary) + torque.at(-load, boundary));
        let design = &screw.design;
        let [pressure_viscosity, roughness] = match parameters.coefficient {
            Coefficient::Rational { .. } => [0.0; 2],
            Coefficient::Film {
                pressure_viscosity,
                roughness,
                ..
            } => [pressure_viscosity, roughness],
        };
        let contact = FilmContact {
            rolling_radius: relative_radii(design, Groove::Screw)?[0],
            ellipticity: 1.0 / design.contact(Groove::Screw)?.axis_ratio,
            load: 1.0,
            contact_modulus: design.ball.contact_modulus(&design.groove),
            pressure_viscosity,
            roughness,
        };
        Ok(Self {
            torque,
            contact,
            // A ball's centre has half of the nut's speed, and so have the surfaces in its frame.
            entrainment: 0.5 * design.pitch_radius,
            parameters,
            reference: [sum, limit],
        })
    }

    /// Friction coefficient without the factor of a direction.
    fn coefficient(&self, state: &State) -> f64 {
        let screw = &self.parameters.screw;
        let asperities = match self.parameters.coefficient {
            Coefficient::Rational {
                half_share_speed,
                reference_temperature,
                pole,
            } => {
                let ratio = (state.temperature - pole) / (reference_temperature - pole);
                1.0 / (1.0 + state.speed.abs() / (half_share_speed * ratio.powi(5)))
            }
            Coefficient::Film { oil, .. } => {
                // Of the flank that carries more.
                let flank = 0.5 * (screw.flank_sum(state.load) + state.load.abs());
                let contact = FilmContact {
                    load: screw.contact_force(flank).max(1e-3),
                    ..self.contact
                };
                let viscosity = oil.at(state.temperature - ZERO_CELSIUS);
                contact.asperities(viscosity, self.entrainment * state.speed.abs())
            }
        };
        coefficient(
            self.parameters.boundary,
            self.parameters.full_film,
            asperities,
        )
    }

    /// Torque of gross sliding forward and backward, both as positive numbers, N m.
    pub fn limits(&self, state: &State) -> Limits {
        let coefficient = self.coefficient(state);
        let [forward, backward] = self.parameters.directions;
        Limits {
            forward: self.torque.at(state.load, forward * coefficient),
            backward: self.torque.at(-state.load, backward * coefficient),
        }
    }
}

/// Friction torque of a screw that slides everywhere: the exact ball at a grid of loads and coefficients; between them a cubic through four
/// loads, and a line between two coefficients.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SlidingTorque {
    coefficients: [f64; COEFFICIENTS],
    /// Size of the load, N, rising.
    loads: Vec<f64>,
    /// Torques, N m, of a load that opposes the motion and of one that assists it: by load, then by coefficient.
    torques: [Vec<[f64; COEFFICIENTS]>; 2],
    preloaded: bool,
}

impl SlidingTorque {
    /// Solves the grid, in parallel.
    pub fn new(screw: &Screw, [least, largest]: [f64; 2]) -> Result<Self, ReferenceError> {
        // Neighbours must differ.
        let width = (largest - least).max(1e-3 * largest);
        let coefficients: [f64; COEFFICIENTS] =
            std::array::from_fn(|number| least + width * number as f64 / (COEFFICIENTS - 1) as f64);
        let loads = loads(screw);
        let clearance = screw.clearance()?;
        let screws: Vec<LoadedScrew> = [1.0, -1.0]
            .iter()
            .flat_map(|side| loads.iter().map(move |load| side * load))
            .flat_map(|load| coefficients.map(|friction| screw.loaded(load, friction, clearance)))
            .collect();
        let found = LoadedScrew::solve_all(&screws, &|| ())
            .into_iter()
            .map(|friction| friction.map(|friction| friction.torque()))
            .collect::<Result<Vec<f64>, _>>()?;
        let (drive, backdrive) = found.as_chunks().0.split_at(loads.len());
        Ok(Self {
            coefficients,
            torques: [drive.to_vec(), backdrive.to_vec()],
            preloaded: screw.axial_preload > 0.0,
            loads,
        })
    }

    /// Torque against a motion that a load opposes (above zero) or assists, N m.
    pub fn at(&self, opposing_load: f64, coefficient: f64) -> f64 {
        let [drive, backdrive] = &self.torques;
        let law = if opposing_load < 0.0 {
            backdrive
        } else {
            drive
        };
        let load = opposing_load.abs();
        let step = self.coefficients[1] - self.coefficients[0];
        let along = (coefficient - self.coefficients[0]) / step;
        let below = along.floor().clamp(0.0, (COEFFICIENTS - 2) as f64);
        let (place, low, high) = (below as usize, 1.0 + below - along, along - below);
        let torque = |row: &[f64; COEFFICIENTS]| low * row[place] + high * row[place + 1];
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
        let places = &self.loads[first..first + 4];
        // Lagrange's weights of four values for that of their polynomial.
        let weight = |own: usize| -> f64 {
            let others = (0..4).filter(|other| *other != own);
            others
                .map(|other| (load - places[other]) / (places[own] - places[other]))
                .product()
        };
        (0..4)
            .map(|own| weight(own) * torque(&law[first + own]))
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
    let (reach, start) = ((1.0 / bend).asinh(), (SMALLEST / bend).asinh());
    let place = |number| start + (reach - start) * number as f64 / (LOADS - 1) as f64;
    (0..LOADS)
        .map(|number| largest * bend * place(number).sinh())
        .collect()
}

/// What the screw remembers.
pub(crate) struct Memory<'a> {
    sliding: &'a Sliding,
    slip: Elements,
    spin: Elements,
    seal: Elements,
}

impl<'a> Memory<'a> {
    /// Nothing remembered.
    pub fn new(sliding: &'a Sliding) -> Self {
        let screw = &sliding.parameters.screw;
        let largest = screw.flank_sum(screw.largest_load) / sliding.reference[0];
        Self {
            sliding,
            slip: Elements::load_exact(SLIPPING, 1.02 * largest.max(1.0)),
            spin: chords(Backbone::Spin, LAST_SPIN),
            seal: chords(Backbone::Slip, 1.0),
        }
    }

    /// Friction torque after a turn, N m.
    pub fn follow(&mut self, state: &State) -> f64 {
        let parameters = &self.sliding.parameters;
        let [reference_sum, reference_limit] = self.sliding.reference;
        let limits = self.sliding.limits(state).times(1.0 / reference_limit);
        let load = parameters.screw.flank_sum(state.load) / reference_sum;
        let turn = state.turn / parameters.breakaway;
        let mut torque = self.slip.follow(turn, limits, load);
        if let Some([share, travel]) = parameters.spinning {
            torque = (1.0 - share) * torque + share * self.spin.follow(turn / travel, limits, load);
        }
        torque *= reference_limit;
        if let Some([seal, breakaway]) = parameters.seal {
            torque += seal * self.seal.follow(state.turn / breakaway, Limits::UNIT, 1.0);
        }
        torque
    }
}

/// Many elements whose broken line lies on a backbone, up to an angle where all slip.
fn chords(backbone: Backbone, last: f64) -> Elements {
    // Finer where the backbone bends: by a power of the place, the more the longer it is.
    let power = 1.0 + last.ln() / 2.0;
    let angle = |number| {
        let place = f64::from(number) / OTHERS as f64;
        // Slip ends with a vertical curvature, spin bends at once.
        if last > 1.0 {
            last * place.powf(power)
        } else {
            1.0 - (1.0 - place).powf(4.0 / 3.0)
        }
    };
    let angles: Vec<f64> = (1..=OTHERS as u32).map(angle).collect();
    let whole = backbone.torque(last);
    let mut slopes = Vec::with_capacity(OTHERS + 1);
    let mut corner = (0.0, 0.0);
    for angle in &angles {
        let next = (*angle, backbone.torque(*angle) / whole);
        slopes.push((next.1 - corner.1) / (next.0 - corner.0));
        corner = next;
    }
    slopes.push(0.0);
    let shares = angles.iter().zip(slopes.windows(2));
    let shares: Vec<f64> = shares
        .map(|(angle, slopes)| (slopes[0] - slopes[1]) * angle)
        .collect();
    Elements::proportional(&angles, &shares)
}
