//! Friction of the rig's screw: gross sliding by the exact ball, remembered by many elements.

use std::num::NonZeroUsize;

use super::parameters::{Coefficient, Parameters, Screw, Seal, Spinning, ZERO_CELSIUS};
use super::sliding::SlidingTorque;
use epas_reference::coefficient::{FilmContact, Vogel, coefficient};
use epas_reference::curvature::Groove;
use epas_reference::error::{ReferenceError, within};
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

/// What friction depends on at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
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
pub struct Sliding {
    torque: SlidingTorque,
    screw: Screw,
    boundary: f64,
    full_film: f64,
    directions: [f64; 2],
    coefficient: Law,
    /// Sum of both flanks at the reference load, N, and the limit of sliding there, N m.
    reference: [f64; 2],
}

/// Coefficient's law with what follows from the screw.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Law {
    Rational {
        half_share_speed: f64,
        reference_temperature: f64,
        pole: f64,
    },
    Film {
        oil: Vogel,
        contact: FilmContact,
        /// Mean speed of the surfaces over the nut's, m.
        entrainment: f64,
    },
}

impl Sliding {
    /// Solves what depends on no trace.
    ///
    /// # Errors
    /// [`ReferenceError`] naming a parameter out of range.
    pub fn new(parameters: &Parameters) -> Result<Self, ReferenceError> {
        let Parameters {
            screw,
            boundary,
            full_film,
            directions,
            ..
        } = *parameters;
        let [weak, strong] = [
            directions[0].min(directions[1]),
            directions[0].max(directions[1]),
        ];
        within("directions", weak, 0.1, 10.0)?;
        within("directions", strong, 0.1, 10.0)?;
        let coefficients = [
            weak * boundary.min(full_film),
            strong * boundary.max(full_film),
        ];
        let torque = SlidingTorque::new(&screw, coefficients)?;
        let load = parameters.reference_axial_load;
        let sum = within(
            "reference_axial_load",
            screw.flank_sum(load),
            1e-3,
            screw.largest_load,
        )?;
        let limit = 0.5 * (torque.at(load, boundary) + torque.at(-load, boundary));
        Ok(Self {
            torque,
            screw,
            boundary,
            full_film,
            directions,
            coefficient: Law::new(&screw, parameters.coefficient)?,
            reference: [sum, limit],
        })
    }

    /// Friction coefficient without the factor of a direction.
    #[must_use]
    pub fn coefficient(&self, state: &State) -> f64 {
        let asperities = match self.coefficient {
            Law::Rational {
                half_share_speed,
                reference_temperature,
                pole,
            } => {
                let ratio = (state.temperature - pole) / (reference_temperature - pole);
                1.0 / (1.0 + state.speed.abs() / (half_share_speed * ratio.powi(5)))
            }
            Law::Film {
                oil,
                contact,
                entrainment,
            } => {
                // Of the flank that carries more.
                let flank = 0.5 * (self.screw.flank_sum(state.load) + state.load.abs());
                let contact = FilmContact {
                    load: self.screw.contact_force(flank).max(1e-3),
                    ..contact
                };
                let viscosity = oil.at(state.temperature - ZERO_CELSIUS);
                contact.asperities(viscosity, entrainment * state.speed.abs())
            }
        };
        coefficient(self.boundary, self.full_film, asperities)
    }

    /// Torque of gross sliding forward and backward, both as positive numbers, N m.
    #[must_use]
    pub fn limits(&self, state: &State) -> Limits {
        let coefficient = self.coefficient(state);
        let [forward, backward] = self.directions;
        Limits {
            forward: self.torque.at(state.load, forward * coefficient),
            backward: self.torque.at(-state.load, backward * coefficient),
        }
    }
}

impl Law {
    fn new(screw: &Screw, coefficient: Coefficient) -> Result<Self, ReferenceError> {
        Ok(match coefficient {
            Coefficient::Rational {
                half_share_speed,
                reference_temperature,
                pole,
            } => Self::Rational {
                half_share_speed: within("half_share_speed", half_share_speed, 1e-6, 1e6)?,
                reference_temperature: within(
                    "reference_temperature",
                    reference_temperature,
                    pole + 1.0,
                    1e3,
                )?,
                pole,
            },
            Coefficient::Film {
                oil,
                pressure_viscosity,
                roughness,
            } => Self::Film {
                oil,
                contact: FilmContact {
                    rolling_radius: relative_radii(&screw.design, Groove::Screw)?[0],
                    ellipticity: 1.0 / screw.design.contact(Groove::Screw)?.axis_ratio,
                    load: 1.0,
                    contact_modulus: screw.design.ball.contact_modulus(&screw.design.groove),
                    pressure_viscosity: within(
                        "pressure_viscosity",
                        pressure_viscosity,
                        1e-10,
                        1e-6,
                    )?,
                    roughness: within("roughness", roughness, 1e-9, 1e-4)?,
                },
                // A ball's centre has half of the nut's speed, and so have the surfaces in its frame.
                entrainment: 0.5 * screw.design.pitch_radius,
            },
        })
    }
}

/// What the screw remembers.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    breakaway: f64,
    slip: Elements,
    spin: Option<(Spinning, Elements)>,
    seal: Option<(Seal, Elements)>,
}

impl Memory {
    /// Nothing remembered.
    ///
    /// # Errors
    /// [`ReferenceError`] naming a parameter out of range.
    pub fn new(parameters: &Parameters, sliding: &Sliding) -> Result<Self, ReferenceError> {
        let breakaway = within("breakaway", parameters.breakaway, 1e-6, 1.0)?;
        let screw = &parameters.screw;
        let largest = screw.flank_sum(screw.largest_load) / sliding.reference[0];
        let spin = match parameters.spinning {
            Some(spinning) => {
                within("share", spinning.share, 0.0, 1.0)?;
                within("travel", spinning.travel, 1e-3, 1e3)?;
                Some((spinning, chords(Backbone::Spin, LAST_SPIN)))
            }
            None => None,
        };
        let seal = match parameters.seal {
            Some(seal) => {
                within("torque", seal.torque, 0.0, 1e3)?;
                within("breakaway", seal.breakaway, 1e-6, 1.0)?;
                Some((seal, chords(Backbone::Slip, 1.0)))
            }
            None => None,
        };
        Ok(Self {
            breakaway,
            slip: Elements::load_exact(SLIPPING, 1.02 * largest.max(1.0)),
            spin,
            seal,
        })
    }

    /// Friction torque after a turn, N m.
    pub fn follow(&mut self, sliding: &Sliding, state: &State) -> f64 {
        let [reference_sum, reference_limit] = sliding.reference;
        let limits = sliding.limits(state).times(1.0 / reference_limit);
        let load = sliding.screw.flank_sum(state.load) / reference_sum;
        let turn = state.turn / self.breakaway;
        let mut torque = self.slip.follow(turn, limits, load);
        if let Some((Spinning { share, travel }, elements)) = &mut self.spin {
            torque =
                (1.0 - *share) * torque + *share * elements.follow(turn / *travel, limits, load);
        }
        torque *= reference_limit;
        if let Some((seal, elements)) = &mut self.seal {
            torque += seal.torque * elements.follow(state.turn / seal.breakaway, Limits::UNIT, 1.0);
        }
        torque
    }
}

/// Many elements whose broken line lies on a backbone, up to an angle where all slip.
fn chords(backbone: Backbone, last: f64) -> Elements {
    // Finer where the backbone bends: by a power of the place, the more the longer it is.
    let power = 1.0 + last.ln() / 2.0;
    let angles: Vec<f64> = (1..=OTHERS)
        .map(|number| {
            let place = number as f64 / OTHERS as f64;
            // Slip ends with a vertical curvature, spin bends at once.
            if last > 1.0 {
                last * place.powf(power)
            } else {
                1.0 - (1.0 - place).powf(4.0 / 3.0)
            }
        })
        .collect();
    let whole = backbone.torque(last);
    let mut slopes = Vec::with_capacity(OTHERS + 1);
    let mut corner = (0.0, 0.0);
    for angle in &angles {
        let next = (*angle, backbone.torque(*angle) / whole);
        slopes.push((next.1 - corner.1) / (next.0 - corner.0));
        corner = next;
    }
    slopes.push(0.0);
    let shares: Vec<f64> = angles
        .iter()
        .zip(slopes.windows(2))
        .map(|(angle, slopes)| (slopes[0] - slopes[1]) * angle)
        .collect();
    Elements::proportional(&angles, &shares)
}
