//! Times of one ball, of two balls, and of the forces in a train.

use std::array;
use std::f64::consts::TAU;
use std::hint::black_box;

use epas_friction::ball::{
    AnalyticLinearBall, GrooveFit, PUBLISHED_SLOPE, ScrewRow, SpeedDeviation,
};
use epas_friction::train::Press;
use epas_friction::train::Train;
use epas_friction::{Inputs, LoadShare, UncagedOutputs};

use super::feed::{Feed, Taken};
use super::group::{Group, List};
use super::race::Race;
use crate::study;
use epas_page::failure::Failure;

/// Contact angles and forces of a ball, in the order BL, BR, TR, TL.
#[derive(Clone, Copy)]
struct Loads {
    angles: [f32; 4],
    forces: [f32; 4],
}

impl Loads {
    /// A ball of the case study of Lin 2019, Section 3.3.4: 100 N, groove turned by two degrees.
    fn new(side_force_ratio: f64) -> Self {
        let ball = study::turned_ball(2.0, side_force_ratio);
        Self {
            angles: ball.contact_angles.map(|angle| angle as f32),
            forces: ball.contact_forces.map(|force| force as f32),
        }
    }
}

impl Feed for Loads {
    fn shifted(mut self, by: f32) -> Self {
        self.angles[0] += by;
        self.forces[0] += by;
        self
    }
}

impl<T: Feed, const N: usize> Feed for [T; N] {
    fn shifted(mut self, by: f32) -> Self {
        if let Some(first) = self.first_mut() {
            *first = first.shifted(by);
        }
        self
    }
}

impl Taken for SpeedDeviation {
    fn value(&self) -> f32 {
        self.speed_deviation
    }
}

impl Taken for UncagedOutputs {
    fn value(&self) -> f32 {
        self.friction_torque
    }
}

pub(super) fn trains(race: &mut Race, list: &mut List) -> Result<(), Failure> {
    let parameters = black_box(study::linear_ball());
    let analytic = AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE)?;
    one_ball(race, list, analytic);
    two_balls(race, list, analytic);
    screw_pair(race, list)?;
    train::<1>(race, list, ["press_1", "train_1", "step_train_1"])?;
    train::<2>(race, list, ["press_2", "train_2", "step_train_2"])?;
    train::<4>(race, list, ["press_4", "train_4", "step_train_4"])?;
    train::<8>(race, list, ["press_8", "train_8", "step_train_8"])?;
    train::<16>(race, list, ["press_16", "train_16", "step_train_16"])?;
    train::<32>(race, list, ["press_32", "train_32", "step_train_32"])?;
    train::<37>(race, list, ["press_37", "train_37", "step_train_37"])?;
    train::<48>(race, list, ["press_48", "train_48", "step_train_48"])?;
    train::<64>(race, list, ["press_64", "train_64", "step_train_64"])
}

/// Two balls of a ball screw under 50 N each, the one in front turned by up to three degrees.
fn screw_pair(race: &mut Race, list: &mut List) -> Result<(), Failure> {
    let design = black_box(study::ball_screw()?);
    let friction = black_box(study::FRICTION as f32);
    let row = ScrewRow::new(&design, friction, GrooveFit::Zero)?;
    Group::new(
        race,
        list,
        |share| [screw_loads(0.0), screw_loads(0.05 * share as f32)],
        |pair: [Loads; 2]| pair[0].angles[0] + pair[0].forces[0],
    )
    .time("screw_row_pair", move |[rear, front]| {
        let tick = row.at(1.0, -rear.forces[1]);
        let ball = |loads: Loads| tick.ball(loads.angles[1] - 0.785, 0.0, &LoadShare::MEAN);
        let (rear, front) = (ball(rear), ball(front));
        (rear.speed_deviation - front.speed_deviation) / (rear.compliance + front.compliance)
    });
    Ok(())
}

/// Contacts SL, SR, NL, NR of a ball under 50 N along the axis, as the elastic model finds them, with the
/// screw's groove turned.
fn screw_loads(turn: f32) -> Loads {
    Loads {
        angles: [0.7788 - turn, 0.7839 + turn, 0.7998, 0.78],
        forces: [
            8.8 + 75.0 * turn,
            75.6 - 20.0 * turn,
            76.2 - 5.0 * turn,
            0.0,
        ],
    }
}

fn train<const N: usize>(
    race: &mut Race,
    list: &mut List,
    [of_forces, of_train, of_scene]: [&'static str; 3],
) -> Result<(), Failure> {
    press::<N>(race, list, of_forces);
    // As full as the screw of Lin 2019, Section 3.4.4.
    let (length, pitch) = (5.68e-3 * N as f32, 5.555e-3);
    let mut train = black_box(Train::<N>::evenly_spaced(length, pitch, N)?);
    Group::new(race, list, |share| share as f32, |share: f32| share).time(of_train, move |share| {
        let mut free = [0.0; N];
        for (free, position) in free.iter_mut().zip(train.positions()) {
            // A triangle wave in four parts of the track.
            let phase = (position << 2) as i32;
            *free = 1e-11 * (phase.saturating_abs() as f32) + 1e-3 * share;
        }
        train.step(&free, &[500.0; N], 1e-5);
        black_box(&train);
        free[0]
    });
    let mut model = black_box(study::whole_screw::<N>()?);
    let per_ball = black_box(-1500.0 / 37.0) * N as f32;
    Group::new(
        race,
        list,
        |share| Inputs {
            nut_speed: (6.0 + share) as f32,
            axial_load: per_ball * (1.0 + 0.01 * share) as f32,
        },
        |inputs: Inputs| inputs.nut_speed,
    )
    .time(of_scene, move |inputs| model.step(inputs));
    Ok(())
}

fn one_ball(race: &mut Race, list: &mut List, analytic: AnalyticLinearBall) {
    Group::new(
        race,
        list,
        |share| Loads::new(1.6 * share - 0.8),
        |loads: Loads| loads.angles[0] + loads.forces[0],
    )
    .time("ball_analytic", move |loads| {
        analytic.speed_deviation(&loads.angles, &loads.forces)
    });
}

fn two_balls(race: &mut Race, list: &mut List, analytic: AnalyticLinearBall) {
    Group::new(
        race,
        list,
        |share| {
            let ratio = 1.6 * share - 0.8;
            [Loads::new(-ratio), Loads::new(ratio)]
        },
        |pair: [Loads; 2]| pair[0].angles[0] + pair[0].forces[0],
    )
    .time("pair_analytic", move |[rear, front]| {
        let rear = analytic.speed_deviation(&rear.angles, &rear.forces);
        let front = analytic.speed_deviation(&front.angles, &front.forces);
        rear.contact_force(&front)
    });
}

/// Deviations that vary along the track, and from ball to ball: some clusters, some balls alone.
fn press<const N: usize>(race: &mut Race, list: &mut List, key: &'static str) {
    let impedance: [f32; N] = array::from_fn(|ball| 500.0 - 2.5 * (ball % 7) as f32);
    let mut room = [0.0; N];
    if let Some(last) = room.last_mut() {
        *last = f32::INFINITY;
    }
    let mut press = Press::<N>::new();
    Group::new(
        race,
        list,
        |share| {
            array::from_fn(|ball| {
                let place = ball as f64 / 37.0;
                (0.008 * (TAU * (4.0 * place + share)).sin()
                    + 0.002 * (TAU * 17.3 * (place + share)).sin()) as f32
            })
        },
        |free: [f32; N]| free[0],
    )
    .time(key, move |free| {
        press.solve(&free, &impedance, &room);
        black_box(&press);
        press.forces().next().unwrap_or(0.0)
    });
}
