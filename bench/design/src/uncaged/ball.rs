//! The exact ball of a design, free and held, over the box of deviations and along the loads: what a law is fitted to.

use epas_friction::ball::pressed::POWERS;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::caged_ball::CagedBall;
use epas_reference::friction::held_ball::{
    AlongTrack, BallDrive, BallStart, DeviatingBall, HeldBall, HeldBallFriction,
};
use epas_reference::friction::patch::Integration;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::{CagedDesign, Failure};

/// Deviations at which balls are solved: a grid of Gauss-Lobatto points, over the largest deviations.
pub(super) const POINTS: usize = SIDE * SIDE;
const SIDE: usize = 5;

/// Places of the grid at which friction of the neighbours is put on a ball: the corners, the middles of the edges and the centre.
const RUBBED: [usize; 9] = [0, 2, 4, 10, 12, 14, 20, 22, 24];

/// Friction force of each neighbour over the root mean square of the forces that hold balls, with which grip and loss by rubbing are found: the
/// mean of those in rows of 37 balls with friction of 0.1 between them, each weighed by itself (0.31 in three designs; 0.2 unweighed).
const RUBBING: f64 = 0.3;

/// Largest friction force of a neighbour over `mu W`: a ball that is rubbed more loses its hold on the grooves.
const MOST_RUBBING: f64 = 0.12;

/// Loads that may be left without an exact answer, as a share.
const UNSOLVED: f64 = 0.02;

/// The exact ball of a gear with a friction coefficient, its contact integrals with 32 nodes: off by 1e-5 of a contact's friction limit, in a
/// fifth of the time.
pub(super) fn exact_ball(gear: &CagedDesign, friction: f32) -> CagedBall {
    CagedBall {
        integration: Integration::Coarse,
        ..gear.exact_ball(friction)
    }
}

/// Deviations of both grooves at a point of the grid, over the largest: -1 to 1 each.
fn deviations(point: usize) -> [f64; 2] {
    const LOBATTO: [f64; SIDE] = [
        -1.0,
        -0.654_653_670_707_977_1,
        0.0,
        0.654_653_670_707_977_1,
        1.0,
    ];
    [LOBATTO[point / SIDE], LOBATTO[point % SIDE]]
}

/// Speeds along the track of a ball without deviations, and its speed against the nut, m per unit of nut speed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Speeds {
    path: f64,
    nominal: f64,
    /// Against the nut.
    pub against_nut: f64,
}

impl Speeds {
    pub fn of(design: &BallScrewDesign) -> Self {
        let path = design
            .pitch_radius
            .hypot(design.lead / std::f64::consts::TAU);
        let cos_lead = design.pitch_radius / path;
        let nominal = 0.5 * (path + design.ball_radius * cos_lead * design.contact_angle.cos());
        Self {
            path,
            nominal,
            against_nut: path - nominal,
        }
    }

    /// Deviation of an orbital speed over the nut's.
    pub fn deviation(&self, orbital_speed: f64) -> f64 {
        (self.path * orbital_speed - self.nominal) / self.against_nut
    }

    /// Orbital speed over the nut's of a deviation.
    fn orbital(&self, deviation: f64) -> f64 {
        (self.nominal + self.against_nut * deviation) / self.path
    }

    /// Change of a force with the deviation, by that with the orbital speed.
    fn impedance(&self, stiffness: f64) -> f64 {
        stiffness * self.against_nut / self.path
    }
}

/// A ball at a point of the grid, under one load; forces and torques over `mu W`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BallPoint {
    /// Free speed, a deviation.
    pub free: f64,
    /// Net push at the held speed.
    pub force: f64,
    /// Friction torque at the free speed, m.
    pub torque: f64,
    /// Friction torque at the held speed, m.
    pub torque_held: f64,
}

/// Balls under one load; forces and torques over `mu W`.
#[derive(Clone, Debug)]
pub(super) struct BallSample {
    /// Load `W`, N.
    pub load: f64,
    /// Held speed, a deviation: the one at which the mean force over the box is about zero.
    pub held: f64,
    /// Balls of the grid.
    pub points: [BallPoint; POINTS],
    /// Some of them with friction of both neighbours.
    pub rubbed: Rubbed,
}

/// Some of the balls of the grid, on which both neighbours rub, at a speed at which their mean net push is about zero; over `mu W`.
#[derive(Clone, Debug, Default)]
pub(super) struct Rubbed {
    /// Speed of the balls, a deviation.
    pub speed: f64,
    /// Friction force of each neighbour.
    pub friction: f64,
    /// Balls: their points of the grid, net push, and friction torque with their part of the loss between balls, m.
    pub balls: Vec<(usize, f64, f64)>,
}

/// What is solved: a design with a friction coefficient, under loads of one sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balls<'a> {
    pub ball: CagedBall,
    /// Largest deviations on the screw and in the nut, rad.
    pub deviations: [f64; 2],
    /// Load at which a preload's unloaded side lifts off, N.
    pub lift_off: f64,
    /// Axial loads, N, falling.
    pub loads: &'a [f64],
    /// 1 where they oppose the motion, -1 where they assist it.
    pub side: f64,
}

/// Answers of one point along the loads; `None` without one.
type Along = Vec<Option<HeldBallFriction>>;

impl Balls<'_> {
    /// Balls under each load, at rising loads; loads without an answer are left out.
    ///
    /// # Errors
    /// [`Failure`] of a design out of range, or where more than a few loads have no answer.
    pub fn samples(&self) -> Result<Vec<BallSample>, Failure> {
        let speeds = Speeds::of(&self.ball.design);
        let balls = self.balls()?;
        let unsolved_most = (UNSOLVED * self.loads.len() as f64) as usize;
        let free = self.along(&balls, &[], unsolved_most, |_, _| AlongTrack::Free);
        self.check_solved(&[&free])?;
        let mut held = means(&free, self.loads.len(), &speeds);
        let mut pushed = Vec::new();
        // One Newton step brings the mean force to zero, but for the curvature of the laws.
        for (round, most) in [usize::MAX, unsolved_most].into_iter().enumerate() {
            pushed = self.along(&balls, &free, most, |_, load| {
                AlongTrack::Held(speeds.orbital(held[load]))
            });
            if round == 0 {
                for (load, held) in held.iter_mut().enumerate() {
                    *held -= step_to_balance(&pushed, load, &speeds);
                }
            }
        }
        self.check_solved(&[&free, &pushed])?;
        let rubbed = with_nearest(&self.rubbed(&balls, &pushed, &held, &speeds));
        let mut samples: Vec<BallSample> = (0..self.loads.len())
            .filter_map(|load| self.sample(load, held[load], &free, &pushed, &rubbed, &speeds))
            .collect();
        samples.reverse();
        Ok(samples)
    }

    /// Refuses answers of which more than a few loads have none at some point.
    fn check_solved(&self, all: &[&[Along]]) -> Result<(), Failure> {
        let solved = |load: usize| {
            all.iter()
                .all(|points| points.iter().all(|along| along[load].is_some()))
        };
        let unsolved: Vec<usize> = (0..self.loads.len())
            .filter(|load| !solved(*load))
            .collect();
        let most = UNSOLVED * self.loads.len() as f64;
        match unsolved.first() {
            Some(&first) if unsolved.len() as f64 > most => Err(Failure::Domain(format!(
                "the exact balance of balls with deviations is not found under more than {:.0} % of the loads, first at {:.3} N a ball, friction \
                 coefficient {:.4}; narrow the domain there, or the deviations",
                100.0 * UNSOLVED,
                self.loads[first],
                self.ball.friction
            ))),
            _ => Ok(()),
        }
    }

    fn balls(&self) -> Result<Vec<DeviatingBall>, Failure> {
        let CagedBall {
            design,
            clearance,
            friction,
            rolling,
            integration,
        } = self.ball;
        let ball = HeldBall {
            design,
            clearance,
            friction,
            rolling,
            integration,
        };
        (0..POINTS)
            .map(|point| {
                let [screw, nut] = deviations(point);
                let [most_screw, most_nut] = self.deviations;
                Ok(ball.in_grooves(screw * most_screw, nut * most_nut)?)
            })
            .collect()
    }

    /// Every ball along all loads, each state from the one before; the first from `starts`. A ball that has no answer under more than `unsolved`
    /// loads is given up: a search without an answer is the longest one.
    fn along(
        &self,
        balls: &[DeviatingBall],
        starts: &[Along],
        unsolved: usize,
        drive: impl Fn(usize, usize) -> AlongTrack + Sync,
    ) -> Vec<Along> {
        balls
            .par_iter()
            .enumerate()
            .map(|(point, ball)| {
                let mut last: Option<BallStart> = starts
                    .get(point)
                    .and_then(|along| Some(along.first()?.as_ref()?.start));
                let mut failed = 0;
                let solve = |(number, &load): (usize, &f64)| {
                    if failed > unsolved {
                        return None;
                    }
                    let drive = BallDrive {
                        axial_load: self.side * load,
                        along: drive(point, number),
                        rubbing: [0.0; 2],
                    };
                    let found = ball.solve(&drive, last.as_ref()).ok();
                    failed += usize::from(found.is_none());
                    last = found.map(|found| found.start).or(last);
                    found
                };
                self.loads.iter().enumerate().map(solve).collect()
            })
            .collect()
    }

    /// Some of the balls under each load, with friction of their neighbours; `None` where most of them have lost their hold.
    ///
    /// In a row friction between balls moves the common speed until the net pushes add up to zero again. What a ball needs then is not what it
    /// would need at the speed of balls that do not rub, because its push saturates with the speed.
    fn rubbed(
        &self,
        balls: &[DeviatingBall],
        pushed: &[Along],
        held: &[f64],
        speeds: &Speeds,
    ) -> Vec<Option<Rubbed>> {
        let of = |load: usize| {
            let smooth: Option<Vec<HeldBallFriction>> =
                pushed.iter().map(|along| along[load]).collect();
            let smooth = smooth?;
            let squares: f64 = smooth.iter().map(|found| found.force.powi(2)).sum();
            let rms = (squares / POINTS as f64).sqrt();
            let sliding = (self.loads[load] + self.lift_off) * self.ball.friction;
            let friction = (MOST_RUBBING * sliding).min(RUBBING * rms);
            let at = |speed: f64| {
                let drive = BallDrive {
                    axial_load: self.side * self.loads[load],
                    along: AlongTrack::Held(speeds.orbital(speed)),
                    rubbing: [friction; 2],
                };
                // A ball that finds no balance does not count.
                let found: Vec<(usize, HeldBallFriction)> = RUBBED
                    .into_iter()
                    .filter_map(|point| {
                        let found = balls[point].solve(&drive, Some(&smooth[point].start));
                        Some((point, found.ok()?))
                    })
                    .collect();
                (found.len() as f64 > 0.5 * RUBBED.len() as f64).then_some(found)
            };
            let first = at(held[load])?;
            let mean = |value: &dyn Fn(&HeldBallFriction) -> f64| {
                let values: Vec<(usize, f64)> = first
                    .iter()
                    .map(|(point, found)| (*point, value(found)))
                    .collect();
                line(&values)[0]
            };
            let impedance = mean(&|found| speeds.impedance(found.stiffness));
            let push = mean(&|found| found.force);
            let speed = if impedance > 0.0 {
                held[load] - push / impedance
            } else {
                held[load]
            };
            let balls = at(speed)?
                .into_iter()
                .map(|(point, found)| {
                    // Each contact's loss is shared by its two balls.
                    let torque = found.torque + 2.0 * friction * found.half_slip;
                    (point, found.force / sliding, torque / sliding)
                })
                .collect();
            Some(Rubbed {
                speed,
                friction: friction / sliding,
                balls,
            })
        };
        (0..self.loads.len()).into_par_iter().map(of).collect()
    }

    fn sample(
        &self,
        load: usize,
        held: f64,
        free: &[Along],
        pushed: &[Along],
        rubbed: &[Rubbed],
        speeds: &Speeds,
    ) -> Option<BallSample> {
        let whole = self.loads[load] + self.lift_off;
        let per_load = 1.0 / (whole * self.ball.friction);
        let mut points = [BallPoint::default(); POINTS];
        for (point, (free, pushed)) in points.iter_mut().zip(free.iter().zip(pushed)) {
            let (free, pushed) = (free[load].as_ref()?, pushed[load].as_ref()?);
            *point = BallPoint {
                free: speeds.deviation(free.orbital_speed),
                force: pushed.force * per_load,
                torque: free.torque * per_load,
                torque_held: pushed.torque * per_load,
            };
        }
        Some(BallSample {
            load: whole,
            held,
            points,
            rubbed: rubbed[load].clone(),
        })
    }
}

/// Values, each that is missing as the one before it, and the first as the next.
fn with_nearest(values: &[Option<Rubbed>]) -> Vec<Rubbed> {
    let mut last = values.iter().flatten().next().cloned().unwrap_or_default();
    let nearest = values.iter().map(|value| {
        if let Some(value) = value {
            last = value.clone();
        }
        last.clone()
    });
    nearest.collect()
}

/// Mean of the free speeds under each load, each ball with its impedance as weight.
fn means(free: &[Along], loads: usize, speeds: &Speeds) -> Vec<f64> {
    (0..loads)
        .map(|load| {
            let (mut sum, mut weight) = (0.0, 0.0);
            for found in free.iter().filter_map(|along| along[load].as_ref()) {
                let impedance = found.stiffness.max(0.0);
                sum += impedance * speeds.deviation(found.orbital_speed);
                weight += impedance;
            }
            if weight > 0.0 { sum / weight } else { 0.0 }
        })
        .collect()
}

/// By how much the held speed exceeds the one at which forces balance.
fn step_to_balance(pushed: &[Along], load: usize, speeds: &Speeds) -> f64 {
    let (mut force, mut impedance) = (0.0, 0.0);
    for found in pushed.iter().filter_map(|along| along[load].as_ref()) {
        force += found.force;
        impedance += speeds.impedance(found.stiffness);
    }
    if impedance > 0.0 {
        force / impedance
    } else {
        0.0
    }
}

/// Powers `1, s, n, s^2, s n, n^2` of the deviations at a point of the grid.
pub(super) fn powers(point: usize) -> [f64; POWERS] {
    let [s, n] = deviations(point);
    [1.0, s, n, s * s, s * n, n * n]
}

/// The straight line over the box of deviations that is nearest to a polynomial of the second degree through values at points of the grid.
///
/// Without values it is zero.
pub(super) fn line(values: &[(usize, f64)]) -> [f64; 3] {
    if values.is_empty() {
        return [0.0; 3];
    }
    let powers = DMatrix::from_fn(values.len(), POWERS, |row, power| {
        powers(values[row].0)[power]
    });
    let right = DVector::from_iterator(values.len(), values.iter().map(|(_, value)| *value));
    let Ok(found) = powers.svd(true, true).solve(&right, 1e-9) else {
        return [0.0; 3];
    };
    // The mean of a square from -1 to 1 is a third.
    [found[0] + (found[3] + found[5]) / 3.0, found[1], found[2]]
}
