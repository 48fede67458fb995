//! Drives of the tests: drawn parameters, a position loop, sensors as people have them.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use crate::trace::Trace;
use crate::trace::channels::resolution;

#[derive(Clone, Copy, Debug)]
pub struct Drive {
    /// kg m^2, N m s/rad, N m, N m.
    pub inertia: f64,
    pub viscous: f64,
    pub offset: f64,
    pub coulomb: f64,
    pub losses: [f64; 2],
    /// rad, N m of the load.
    pub amplitude: f64,
    pub load: f64,
    phase: f64,
    /// Noise of effort and load, N m.
    pub noise: [f64; 2],
    pub rate: usize,
    /// Whether it rests between moves.
    pub rests: bool,
    /// Stiffness of the loop over that of a loop of 8 Hz.
    pub stiffness: f64,
    /// Way over which friction builds up after a turn (Dahl), rad; 0 for at once.
    pub bristle: f64,
    /// Friction at rest beyond Coulomb's over it, and the speed over which it falls, rad/s.
    pub stribeck: (f64, f64),
    /// Whether the loop has its speed from the difference of the last two positions of the trace's sensor.
    pub differences: bool,
}

impl Drive {
    pub fn drawn(seed: u64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(1000 + seed);
        let mut between = |low: f64, high: f64| random.random_range(low..high);
        let mut log = |low: f64, high: f64| between(low.ln(), high.ln()).exp();
        let inertia = log(2e-4, 3e-3);
        Self {
            inertia,
            viscous: log(1.0, 6.0) * 4.0 * inertia,
            offset: log(1e-3, 0.03),
            coulomb: log(0.03, 0.3),
            losses: [log(0.01, 0.15), log(0.01, 0.2)],
            amplitude: log(10.0, 45.0),
            load: log(0.9, 5.6),
            phase: log(1e-3, TAU),
            noise: [log(2e-3, 0.02), log(5e-3, 0.03)],
            rate: [500, 1000, 2000][(seed % 3) as usize],
            rests: false,
            stiffness: 1.0,
            bristle: 0.0,
            stribeck: (0.0, 1.0),
            differences: false,
        }
    }

    /// Truth of inertia, viscous friction, offset, Coulomb friction and both losses.
    pub fn truth(&self) -> [f64; 6] {
        let [driving, back_driving] = self.losses;
        [
            self.inertia,
            self.viscous,
            self.offset,
            self.coulomb,
            driving,
            back_driving,
        ]
    }

    fn reference(&self, time: f64) -> f64 {
        const MOVES: [(f64, f64); 10] = [
            (30.0, 0.5),
            (12.0, 0.5),
            (45.0, 0.75),
            (6.0, 1.0),
            (20.0, 0.5),
            (60.0, 0.5),
            (9.0, 1.25),
            (35.0, 0.5),
            (15.0, 1.0),
            (50.0, 0.5),
        ];
        if self.rests {
            let number = (time / 4.0).floor();
            let (size, frequency) = MOVES[number as usize % 10];
            let whole = (3.0 * frequency).floor() / frequency;
            let within = (time - 4.0 * number).min(whole);
            size * self.amplitude / 30.0 * (1.0 - (TAU * frequency * within).cos()) / 2.0
        } else {
            let [slow, fast] = [0.3, 1.1].map(|frequency| (TAU * frequency * time).sin());
            self.amplitude * (slow + fast / 3.0)
        }
    }

    fn torque_of_load(&self, time: f64) -> f64 {
        let slow = (TAU * 0.13 * time + self.phase).sin();
        self.load * (slow + 0.4 * (TAU * 0.71 * time + 1.0 + 2.0 * self.phase).sin())
    }

    /// A trace of so many seconds: positions in steps of `2 pi/2^bits`, or speeds that are their differences behind a first-order filter of
    /// this time; and the share of its samples in which the drive stands.
    pub fn trace(&self, seed: u64, seconds: f64, bits: u32, lag: Option<f64>) -> (Trace, f64) {
        let every = (1.0 / (self.rate as f64 * STEP)).round() as usize;
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut normal =
            |size: f64| -> f64 { size * Distribution::<f64>::sample(&StandardNormal, &mut random) };
        let mut moving = Moving::default();
        let [mut angles, mut efforts, mut loads] = [Vec::new(), Vec::new(), Vec::new()];
        let mut stood = 0.0;
        let step_of_sensor = TAU / 2_f64.powi(bits as i32);
        let (mut before, mut effort) = (0.0, 0.0);
        for step in 0..(seconds / STEP) as usize {
            let time = step as f64 * STEP;
            let load = self.torque_of_load(time);
            let wanted = self.reference(time);
            let rate = (self.reference(time + STEP) - wanted) / STEP;
            let now = |angle: f64, speed: f64| {
                let stiff = self.inertia * self.stiffness;
                stiff * (2500.0 * (wanted - angle) + 75.0 * (rate - speed) / self.stiffness.sqrt())
            };
            if !self.differences {
                effort = now(moving.angle, moving.speed);
            } else if step % every == 0 {
                // A controller that holds its effort for a tick.
                let counted = (moving.angle / step_of_sensor).round() * step_of_sensor;
                effort = now(counted, (counted - before) * self.rate as f64);
                before = counted;
            }
            if step % every == 0 {
                angles.push(moving.angle);
                efforts.push(effort + normal(self.noise[0]));
                loads.push(load + normal(self.noise[1]));
                stood += f64::from(moving.speed == 0.0);
            }
            moving.step(self, effort, load);
        }
        let stood = stood / angles.len() as f64;
        let step = step_of_sensor;
        let counted: Vec<f64> = angles.iter().map(|x| (x / step).round() * step).collect();
        let tick = 1.0 / self.rate as f64;
        let speeds = lag.map(|lag| {
            let share = 1.0 - (-tick / lag).exp();
            let mut speed = 0.0;
            let pairs = counted.windows(2);
            let mut speeds: Vec<f64> = pairs
                .map(|pair| {
                    speed += share * ((pair[1] - pair[0]) / tick - speed);
                    speed
                })
                .collect();
            speeds.insert(0, 0.0);
            speeds
        });
        let position = match &speeds {
            Some(speeds) => speeds
                .iter()
                .scan(0.0, |sum, speed| {
                    *sum += speed * tick;
                    Some(*sum)
                })
                .collect(),
            None => counted,
        };
        let trace = Trace {
            name: "drive".into(),
            step: tick,
            resolution: if lag.is_some() {
                0.0
            } else {
                resolution(&position)
            },
            position,
            position_summed: lag.is_some(),
            speed: speeds,
            effort: efforts,
            load: Some(loads),
            load_is_effort: true,
            ..Trace::default()
        };
        (trace, stood)
    }
}

/// Step of the simulation, s.
const STEP: f64 = 5e-5;

#[derive(Default)]
struct Moving {
    angle: f64,
    speed: f64,
    /// Friction that has built up, over the whole.
    held: f64,
}

impl Moving {
    fn step(&mut self, drive: &Drive, effort: f64, load: f64) {
        let push = effort - load - drive.offset;
        let whole = |direction: f64| -> f64 {
            let loss = drive.losses[usize::from(direction * load <= 0.0)];
            let rise = drive.stribeck.0 * (-self.speed.abs() / drive.stribeck.1).exp();
            drive.coulomb * (1.0 + rise) + loss * load.abs()
        };
        let before = self.speed;
        if drive.bristle > 0.0 {
            let force = push - drive.viscous * before - self.held * whole(before.signum());
            self.speed += force / drive.inertia * STEP;
            let direction = self.speed.signum();
            let turn = (-self.speed.abs() * STEP / drive.bristle).exp();
            self.held = direction + (self.held - direction) * turn;
        } else if before == 0.0 {
            let friction = whole(push.signum());
            if push.abs() > friction {
                self.speed = (push - push.signum() * friction) / drive.inertia * STEP;
            }
        } else {
            let friction = before.signum() * whole(before.signum());
            self.speed += (push - drive.viscous * before - friction) / drive.inertia * STEP;
            if self.speed * before < 0.0 {
                self.speed = 0.0;
            }
        }
        self.angle += self.speed * STEP;
    }
}
