//! The exact ball of a design, free and held, over the box of deviations and along the loads: what a law is fitted to.

use epas_friction::ball::pressed::{POWERS, SPEED_POWERS};
use epas_reference::design::BallScrewDesign;
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

/// Points of the grid at which neighbours act on a ball: the corners, the middles of the edges and the centre.
const RUBBED: [usize; 9] = [0, 2, 4, 10, 12, 14, 20, 22, 24];

/// One load in so many at which neighbours act on balls.
const RUBBED_LOADS: usize = 4;

/// Friction of both neighbours over `mu W` that balls are solved under.
const RUBBINGS: [f64; 9] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.65, 0.9];

/// Speeds of rubbed balls less the held one, over `mu W` by the impedance, in the direction in which rubbing moves a row: a stiff row moves less.
const SHIFTS: [f64; 4] = [-0.12, 0.0, 0.15, 0.35];

/// Friction over `mu W` that tells that direction.
const DIRECTING: f64 = 0.1;

/// Outward force over the load `W` whose effect is taken as linear: neighbours that press with a tenth of the load on a chord of ten degrees.
const OUTWARD: f64 = 0.02;

/// Loads that may be left without an exact answer, as a share.
const UNSOLVED: f64 = 0.02;

/// The exact ball of a gear with a friction coefficient, its contact integrals with 32 nodes: off by 1e-5 of a contact's friction limit, in a
/// fifth of the time.
pub(super) fn exact_ball(gear: &CagedDesign, friction: f32) -> HeldBall {
    HeldBall {
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
    pub against_nut: f64,
    /// Outward force of neighbours over that along the track: the tangent of the chord's angle.
    pub outward: f64,
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
            outward: (design.ball_radius / path).asin().tan(),
        }
    }

    pub fn deviation(&self, orbital_speed: f64) -> f64 {
        (self.path * orbital_speed - self.nominal) / self.against_nut
    }

    pub fn orbital(&self, deviation: f64) -> f64 {
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
    pub points: [BallPoint; POINTS],
    pub neighbours: Option<Neighbours>,
}

/// What neighbours change in balls under one load, at a speed that is kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    pub rubbed: Vec<RubbedBall>,
    /// By an outward force of one newton: the points of the grid, net push and friction torque, m, each over the friction coefficient.
    pub outward: Vec<(usize, f64, f64)>,
}

/// What friction of both neighbours changes in a ball; over `mu W`.
#[derive(Clone, Copy, Debug)]
pub(super) struct RubbedBall {
    pub point: usize,
    pub rubbing: f64,
    /// Speed less the held one, a deviation.
    pub shift: f64,
    pub push: f64,
    /// Friction torque, with the ball's part of the loss between balls, m.
    pub torque: f64,
}

/// What is solved: a design with a friction coefficient, under loads of one sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balls<'a> {
    pub ball: HeldBall,
    /// Largest deviations on the screw and in the nut, rad.
    pub deviations: [f64; 2],
    /// Load at which a preload's unloaded side lifts off, N.
    pub lift_off: f64,
    /// Axial loads, N, falling.
    pub loads: &'a [f64],
    /// 1 where they oppose the motion, -1 where they assist it.
    pub side: f64,
    /// Friction coefficient between balls by which an outward force goes with the friction of neighbours.
    pub ball_friction: f64,
}

/// Answers of one point along the loads; `None` without one.
type Along = Vec<Option<HeldBallFriction>>;

impl Balls<'_> {
    /// Balls under each load, at rising loads; loads without an answer are left out.
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
        let mut samples: Vec<BallSample> = (0..self.loads.len())
            .into_par_iter()
            .filter_map(|load| {
                let mut sample = self.sample(load, held[load], &free, &pushed, &speeds)?;
                if load % RUBBED_LOADS == 0 || load + 1 == self.loads.len() {
                    let smooth = pushed.iter().map(|along| along[load]);
                    let smooth: Option<Vec<HeldBallFriction>> = smooth.collect();
                    sample.neighbours = Some(self.neighbours(&balls, &smooth?, &sample, &speeds));
                }
                Some(sample)
            })
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
        (0..POINTS)
            .map(|point| {
                let [screw, nut] = deviations(point);
                let [most_screw, most_nut] = self.deviations;
                Ok(self.ball.in_grooves(screw * most_screw, nut * most_nut)?)
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
                        outward: 0.0,
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

    /// What neighbours change in balls under the load of a sample; `smooth`: the balls of the grid at the held speed.
    fn neighbours(
        &self,
        balls: &[DeviatingBall],
        smooth: &[HeldBallFriction],
        sample: &BallSample,
        speeds: &Speeds,
    ) -> Neighbours {
        let sliding = sample.load * self.ball.friction;
        let axial_load = self.side * (sample.load - self.lift_off);
        let at = |point: usize, speed: f64, start: &BallStart, rubbing: f64, outward: f64| {
            let drive = BallDrive {
                axial_load,
                along: AlongTrack::Held(speeds.orbital(speed)),
                rubbing: [0.5 * rubbing * sliding; 2],
                outward,
            };
            balls[point].solve(&drive, Some(start)).ok()
        };
        let rms = |value: &dyn Fn(&BallPoint) -> f64| {
            let squares: f64 = sample.points.iter().map(|point| value(point).powi(2)).sum();
            squares.sqrt()
        };
        let impedance = rms(&|point| point.force) / rms(&|point| point.free - sample.held);
        let directing: f64 = RUBBED
            .into_iter()
            .filter_map(|point| {
                let smooth = &smooth[point];
                let rubbed = at(point, sample.held, &smooth.start, DIRECTING, 0.0)?;
                Some(rubbed.force - smooth.force)
            })
            .sum();
        let sin_chord = speeds.outward / speeds.outward.hypot(1.0);
        let mut found = Neighbours::default();
        for point in RUBBED {
            let held = &smooth[point];
            let outward = OUTWARD * sample.load;
            let Some(pressed) = at(point, sample.held, &held.start, 0.0, outward) else {
                continue;
            };
            let per_newton = 1.0 / (outward * self.ball.friction);
            let by_outward = [
                (pressed.force - held.force) * per_newton,
                (pressed.torque - held.torque) * per_newton,
            ];
            found.outward.push((point, by_outward[0], by_outward[1]));
            for shift in SHIFTS {
                let shift = -directing.signum() * shift / impedance;
                let speed = sample.held + shift;
                let Some(alone) = at(point, speed, &held.start, 0.0, 0.0) else {
                    continue;
                };
                let mut last = alone;
                for rubbing in RUBBINGS {
                    // What the outward force that goes with this friction does beside the friction is not linear in both; its own part is.
                    let outward = rubbing * sliding * sin_chord / self.ball_friction;
                    let Some(here) = at(point, speed, &last.start, rubbing, outward) else {
                        break;
                    };
                    let outward = outward * self.ball.friction;
                    let push = here.force - alone.force - outward * by_outward[0];
                    let torque = here.torque - alone.torque - outward * by_outward[1];
                    found.rubbed.push(RubbedBall {
                        point,
                        rubbing,
                        shift,
                        push: push / sliding,
                        // Each contact's loss is shared by its two balls.
                        torque: torque / sliding + rubbing * here.half_slip,
                    });
                    last = here;
                }
            }
        }
        found
    }

    fn sample(
        &self,
        load: usize,
        held: f64,
        free: &[Along],
        pushed: &[Along],
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
            neighbours: None,
        })
    }
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

/// Powers of the deviations at a point of the grid, in the order of [`BallNumbers`](epas_friction::ball::pressed::BallNumbers).
pub(super) fn powers(point: usize) -> [f64; SPEED_POWERS] {
    let [s, n] = deviations(point);
    let [ss, sn, nn] = [s * s, s * n, n * n];
    [1.0, s, n, ss, sn, nn, s * ss, s * sn, s * nn, n * nn]
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
