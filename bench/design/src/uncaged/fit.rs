//! The numbers of a law at its knots, by least squares over the exact balls.
//!
//! Free speed and impedance are fitted together. What a train makes of them is a force, `z (v - u)` at a speed `v` near the held one; and
//! differences of free speeds, summed over time, say when balls meet. So errors of the force at the held speed and of the free speed count
//! alike. The impedance is therefore the secant from the free speed to the held one, not the tangent at either.

use epas_friction::ball::pressed::{KNOTS, LARGEST_WORK, POWERS, SPEED_POWERS};
use nalgebra::{DMatrix, DVector, Matrix2, SMatrix, SVector, Vector2};

use super::Column;
use super::ball::{BallSample, POINTS, powers};
use super::knots::{Between, Knots};
use super::neighbours;

/// Errors that weigh as much as each other where knots are placed: of the torque, of the force over its root mean square, and of the free
/// speed over the root mean square of its distance from the held one.
const TORQUE: f64 = 3e-4;
const FORCE: f64 = 3e-3;
const SPEED: f64 = 1e-2;

/// Gauss-Newton steps for free speeds and impedances together.
const STEPS: usize = 8;

/// Least and largest impedance over `mu W` of a ball without deviations, and the largest change of it by deviations, over itself.
const IMPEDANCES: [f64; 2] = [0.1, 500.0];
const LARGEST_CHANGE: f64 = 0.8;

/// Largest loss by a push over its work, a little less than a law may have.
const MOST_WORK: f64 = 0.999 * LARGEST_WORK as f64;

/// Powers of an impedance, and numbers that are fitted together.
const SLOPES: usize = 3;
const TOGETHER: usize = SPEED_POWERS + SLOPES;

/// Numbers at a knot, all over `mu W` but speeds and work; see `BallNumbers`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Numbers {
    pub free: [f64; SPEED_POWERS],
    pub impedance: [f64; SLOPES],
    pub torque: [f64; POWERS],
    pub slope: f64,
    pub work: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// Knots: load, N, and numbers.
    pub knots: Vec<(f64, Numbers)>,
    pub neighbours: Vec<(f64, neighbours::Numbers)>,
    pub errors: Vec<Errors>,
}

/// Error of a law under one load, over the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    /// Load, N.
    pub load: f64,
    /// Root mean square of the errors of the forces that hold balls, over that of the forces.
    pub force: f64,
}

/// The first powers of all points, and the polynomials of least squares through values there.
struct Grid {
    powers: DMatrix<f64>,
    /// Upper triangle of `powers`, and its orthonormal columns.
    triangle: DMatrix<f64>,
    columns: DMatrix<f64>,
}

impl Grid {
    fn new(count: usize) -> Self {
        let powers = DMatrix::from_fn(POINTS, count, |point, power| powers(point)[power]);
        let factors = powers.clone().qr();
        Self {
            powers,
            triangle: factors.r(),
            columns: factors.q(),
        }
    }

    /// Coordinates of the polynomial through values: the sum of their squares is that of its values.
    fn coordinates(&self, values: impl Fn(usize) -> f64) -> DVector<f64> {
        let values = DVector::from_fn(POINTS, |point, _| values(point));
        self.columns.tr_mul(&values)
    }

    /// Coefficients of the polynomial through values; zero where the powers are not independent, which they are.
    fn coefficients(&self, values: impl Fn(usize) -> f64) -> DVector<f64> {
        let coordinates = self.coordinates(values);
        let found = self.triangle.solve_upper_triangular(&coordinates);
        found.unwrap_or_else(|| DVector::zeros(coordinates.len()))
    }
}

fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}

pub(super) struct Fit<'a> {
    samples: &'a [BallSample],
    weights: &'a [f64],
    /// Speed against the nut, m per unit of nut speed.
    against_nut: f64,
    /// Polynomials of free speeds, and of all else.
    cubic: Grid,
    square: Grid,
    /// Root mean squares of the forces and of the speeds' distance from the held one, and mean torques, of each load.
    forces: Vec<f64>,
    spreads: Vec<f64>,
    torques: Vec<f64>,
}

impl<'a> Fit<'a> {
    pub fn new(samples: &'a [BallSample], weights: &'a [f64], against_nut: f64) -> Self {
        let of = |value: &dyn Fn(&BallSample) -> f64| samples.iter().map(value).collect();
        Self {
            samples,
            weights,
            against_nut,
            cubic: Grid::new(SPEED_POWERS),
            square: Grid::new(POWERS),
            forces: of(&|sample| rms(sample.points.iter().map(|point| point.force))),
            spreads: of(&|sample| rms(sample.points.iter().map(|p| p.free - sample.held))),
            torques: of(&|sample| {
                sample.points.iter().map(|point| point.torque).sum::<f64>() / POINTS as f64
            }),
        }
    }

    pub fn branch(&self) -> Branch {
        let loads: Vec<f64> = self.samples.iter().map(|sample| sample.load).collect();
        let knots = Knots::placed(&loads, &self.columns(), KNOTS);
        let places = knots.places();
        let speeds = self.speeds(&knots, &places);
        let gains = self.gains(&knots, &places);
        let torques = self.torques(&knots, &places, &speeds, &gains);
        let numbers: Vec<(f64, Numbers)> = (0..knots.at.len())
            .map(|knot| {
                let numbers = Numbers {
                    free: std::array::from_fn(|power| speeds[knot][power]),
                    impedance: std::array::from_fn(|power| speeds[knot][SPEED_POWERS + power]),
                    torque: torques[knot].into(),
                    slope: gains[knot][0],
                    work: gains[knot][1],
                };
                (loads[knots.at[knot]], numbers)
            })
            .collect();
        let errors = self.errors(&speeds, &places);
        Branch {
            knots: numbers,
            neighbours: neighbours::fitted(self.samples),
            errors,
        }
    }

    /// What knots are placed by: polynomials of each load's free speeds, forces and torques, in coordinates whose squares are errors.
    fn columns(&self) -> Vec<Column> {
        let (mut columns, count) = (Vec::new(), POINTS as f64);
        type Value = fn(&BallSample, usize) -> f64;
        let families: [(Value, &Grid, &[f64], f64); 3] = [
            (
                |sample, point| sample.points[point].free,
                &self.cubic,
                &self.spreads,
                SPEED,
            ),
            (
                |sample, point| sample.points[point].force,
                &self.square,
                &self.forces,
                FORCE,
            ),
            (
                |sample, point| sample.points[point].torque_held,
                &self.square,
                &self.torques,
                TORQUE,
            ),
        ];
        for (value, grid, sizes, tolerance) in families {
            let all: Vec<DVector<f64>> = self
                .samples
                .iter()
                .map(|sample| grid.coordinates(|point| value(sample, point)))
                .collect();
            // What polynomials leave of a load's errors no knot takes away: such a load needs them less.
            let weight = |load: usize| {
                let sample = &self.samples[load];
                let whole: f64 = (0..POINTS).map(|point| value(sample, point).powi(2)).sum();
                let left = (whole - all[load].norm_squared()).max(0.0) / count;
                self.weights[load] / ((sizes[load] * tolerance).powi(2) + left)
            };
            for power in 0..grid.columns.ncols() {
                columns.push(Column {
                    values: all.iter().map(|coordinates| coordinates[power]).collect(),
                    weights: (0..all.len()).map(|load| weight(load) / count).collect(),
                });
            }
        }
        columns
    }

    /// What a ball loses by a change of speed more than at its free speed.
    fn gained(&self, place: &Between, gains: &[[f64; 2]], impedance: f64, push: f64) -> f64 {
        let [low, high] = place.shares;
        let [slope, work] =
            [0, 1].map(|gain| low * gains[place.knot][gain] + high * gains[place.knot + 1][gain]);
        (slope + 0.5 * work * self.against_nut * impedance * push) * push
    }

    /// Powers of free speed and impedance at the knots.
    fn speeds(&self, knots: &Knots<'_>, places: &[Between]) -> Vec<SVector<f64, TOGETHER>> {
        let mut found = self.first_speeds(knots, places);
        let size = TOGETHER * knots.at.len();
        for _ in 0..STEPS {
            let mut normal = DMatrix::<f64>::zeros(size, size);
            let mut right = DVector::<f64>::zeros(size);
            for (load, place) in places.iter().enumerate() {
                let here = blended(&found, place);
                let (matrix, vector) = self.normal_equations(load, &here);
                let at = |side: usize| TOGETHER * (place.knot + side);
                for (a, share_a) in place.shares.into_iter().enumerate() {
                    let mut part = right.fixed_rows_mut::<TOGETHER>(at(a));
                    part += vector * share_a;
                    for (b, share_b) in place.shares.into_iter().enumerate() {
                        let mut part = normal.fixed_view_mut::<TOGETHER, TOGETHER>(at(a), at(b));
                        part += matrix * (share_a * share_b);
                    }
                }
            }
            // Where an impedance is not seen, nothing changes it.
            for place in 0..size {
                normal[(place, place)] *= 1.0 + 1e-9;
                normal[(place, place)] += 1e-30;
            }
            let Some(factor) = normal.cholesky() else {
                break;
            };
            let step = factor.solve(&right);
            for (knot, numbers) in found.iter_mut().enumerate() {
                *numbers += step.fixed_rows::<TOGETHER>(TOGETHER * knot);
                limit_impedance(numbers);
            }
        }
        found
    }

    /// Polynomials of the free speed alone, and impedances of the sizes of forces and speeds.
    fn first_speeds(&self, knots: &Knots<'_>, places: &[Between]) -> Vec<SVector<f64, TOGETHER>> {
        let all: Vec<DVector<f64>> = self
            .samples
            .iter()
            .map(|sample| self.cubic.coefficients(|point| sample.points[point].free))
            .collect();
        let weights: Vec<f64> = (0..all.len())
            .map(|load| self.weights[load] / self.spreads[load].powi(2))
            .collect();
        let fitted = |values: Vec<f64>| {
            let column = Column {
                values,
                weights: weights.clone(),
            };
            knots.fitted(places, &column)
        };
        let speeds: [Vec<f64>; SPEED_POWERS] =
            std::array::from_fn(|power| fitted(all.iter().map(|numbers| numbers[power]).collect()));
        let sizes = self.forces.iter().zip(&self.spreads);
        let impedances = fitted(sizes.map(|(force, spread)| force / spread).collect());
        (0..knots.at.len())
            .map(|knot| {
                let mut numbers = SVector::zeros();
                for (power, speeds) in speeds.iter().enumerate() {
                    numbers[power] = speeds[knot];
                }
                numbers[SPEED_POWERS] = impedances[knot];
                numbers
            })
            .collect()
    }

    /// Normal equations of the errors under one load, by the numbers there.
    fn normal_equations(
        &self,
        load: usize,
        numbers: &SVector<f64, TOGETHER>,
    ) -> (SMatrix<f64, TOGETHER, TOGETHER>, SVector<f64, TOGETHER>) {
        let sample = &self.samples[load];
        let mut matrix = SMatrix::zeros();
        let mut vector = SVector::zeros();
        let mut add = |row: SVector<f64, TOGETHER>, missing: f64| {
            matrix += row * row.transpose();
            vector += row * missing;
        };
        let weight = self.weights[load].sqrt();
        let (per_force, per_speed) = (weight / self.forces[load], weight / self.spreads[load]);
        for (point, exact) in sample.points.iter().enumerate() {
            let (free, impedance) = self.free_and_impedance(point, numbers);
            let push = sample.held - free;
            let mut by_force = SVector::zeros();
            let mut by_speed = SVector::zeros();
            for power in 0..SPEED_POWERS {
                let at = self.cubic.powers[(point, power)];
                by_force[power] = -impedance * at * per_force;
                by_speed[power] = at * per_speed;
                if power < SLOPES {
                    by_force[SPEED_POWERS + power] = push * at * per_force;
                }
            }
            add(by_force, (exact.force - impedance * push) * per_force);
            add(by_speed, (exact.free - free) * per_speed);
        }
        (matrix, vector)
    }

    fn free_and_impedance(&self, point: usize, numbers: &SVector<f64, TOGETHER>) -> (f64, f64) {
        let powers = self.cubic.powers.row(point);
        let free = (0..SPEED_POWERS)
            .map(|power| powers[power] * numbers[power])
            .sum();
        let impedance = (0..SLOPES)
            .map(|power| powers[power] * numbers[SPEED_POWERS + power])
            .sum();
        (free, impedance)
    }

    /// What balls lose at the held speed more than at their free speeds, in two parts at the knots: in proportion to the change of speed, and over
    /// the work of the force. The latter is 1 where the force is in proportion to the change of speed, more where it saturates.
    fn gains(&self, knots: &Knots<'_>, places: &[Between]) -> Vec<[f64; 2]> {
        let column = || Column {
            values: Vec::new(),
            weights: Vec::new(),
        };
        let mut columns = [column(), column()];
        for (load, sample) in self.samples.iter().enumerate() {
            let mut squares = Matrix2::zeros();
            let mut products = Vector2::zeros();
            for point in &sample.points {
                let push = sample.held - point.free;
                let work = 0.5 * self.against_nut * point.force * push;
                let parts = Vector2::new(push, work);
                squares += parts * parts.transpose();
                // Beside a work that counts once.
                products += parts * (point.torque_held - point.torque - work);
            }
            let weight = self.weights[load] / self.torques[load].powi(2);
            let alone = Vector2::new(products[0] / squares[(0, 0)], 0.0);
            let found = squares
                .cholesky()
                .map_or(alone, |both| both.solve(&products));
            let work = (1.0 + found[1]).clamp(0.0, MOST_WORK);
            for (part, value) in [found[0], work].into_iter().enumerate() {
                columns[part].values.push(value);
                columns[part].weights.push(weight * squares[(part, part)]);
            }
        }
        let [slopes, works] = columns.map(|column| knots.fitted(places, &column));
        let works = works.into_iter().map(|work| work.clamp(0.0, MOST_WORK));
        slopes
            .into_iter()
            .zip(works)
            .map(<[f64; 2]>::from)
            .collect()
    }

    /// Powers of the torque at the free speed, at the knots: as close to the exact one there as to what makes the one at the held speed.
    fn torques(
        &self,
        knots: &Knots<'_>,
        places: &[Between],
        speeds: &[SVector<f64, TOGETHER>],
        gains: &[[f64; 2]],
    ) -> Vec<SVector<f64, POWERS>> {
        let weights: Vec<f64> = (0..places.len())
            .map(|load| self.weights[load] / self.torques[load].powi(2))
            .collect();
        let all: Vec<DVector<f64>> = self
            .samples
            .iter()
            .zip(places)
            .map(|(sample, place)| {
                let here = blended(speeds, place);
                self.square.coefficients(|point| {
                    let (free, impedance) = self.free_and_impedance(point, &here);
                    let push = sample.held - free;
                    let gained = self.gained(place, gains, impedance, push);
                    let exact = &sample.points[point];
                    0.5 * (exact.torque + exact.torque_held - gained)
                })
            })
            .collect();
        let columns: [Vec<f64>; POWERS] = std::array::from_fn(|power| {
            let column = Column {
                values: all.iter().map(|numbers| numbers[power]).collect(),
                weights: weights.clone(),
            };
            knots.fitted(places, &column)
        });
        (0..knots.at.len())
            .map(|knot| SVector::from_fn(|power, _| columns[power][knot]))
            .collect()
    }

    fn errors(&self, speeds: &[SVector<f64, TOGETHER>], places: &[Between]) -> Vec<Errors> {
        let all = self.samples.iter().zip(places).zip(&self.forces);
        all.map(|((sample, place), size)| {
            let here = blended(speeds, place);
            let points = sample.points.iter().enumerate();
            let errors = points.map(|(point, exact)| {
                let (free, impedance) = self.free_and_impedance(point, &here);
                impedance * (sample.held - free) - exact.force
            });
            Errors {
                load: sample.load,
                force: rms(errors) / size,
            }
        })
        .collect()
    }
}

/// Brings an impedance within what a law may have, for all deviations.
fn limit_impedance(numbers: &mut SVector<f64, TOGETHER>) {
    let mean = numbers[SPEED_POWERS].clamp(IMPEDANCES[0], IMPEDANCES[1]);
    numbers[SPEED_POWERS] = mean;
    let change: f64 = (1..SLOPES)
        .map(|power| numbers[SPEED_POWERS + power].abs())
        .sum();
    if change > LARGEST_CHANGE * mean {
        for power in 1..SLOPES {
            numbers[SPEED_POWERS + power] *= LARGEST_CHANGE * mean / change;
        }
    }
}

fn blended<const N: usize>(knots: &[SVector<f64, N>], place: &Between) -> SVector<f64, N> {
    let [low, high] = place.shares;
    knots[place.knot] * low + knots[place.knot + 1] * high
}
