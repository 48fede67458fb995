//! Times of one ball, of two balls, and of the forces in a train.

use std::array;
use std::f64::consts::TAU;
use std::hint::black_box;

use epas_friction::train::Press;
use epas_friction::{
    AnalyticLinearBall, BallChain, BallState, FourPointBall, PUBLISHED_SLOPE, SpeedDeviation,
};

use super::competitors::{Group, List};
use super::{Feed, Race, Taken};
use crate::failure::Failure;
use crate::study;

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

impl Taken for BallState {
    fn value(&self) -> f32 {
        self.speed_deviation
    }
}

impl Taken for SpeedDeviation {
    fn value(&self) -> f32 {
        self.speed_deviation
    }
}

/// Adds all of them.
pub(super) fn trains(race: &mut Race, list: &mut List) -> Result<(), Failure> {
    let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
    let parameters = black_box(study::linear_ball());
    let analytic = AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE).map_err(failure)?;
    let ball = FourPointBall::linear(&parameters).map_err(failure)?;
    one_ball(race, list, analytic, ball);
    two_balls(race, list, analytic, ball);
    press::<1>(race, list, "press_1");
    press::<2>(race, list, "press_2");
    press::<4>(race, list, "press_4");
    press::<8>(race, list, "press_8");
    press::<16>(race, list, "press_16");
    press::<32>(race, list, "press_32");
    press::<37>(race, list, "press_37");
    press::<48>(race, list, "press_48");
    press::<64>(race, list, "press_64");
    Ok(())
}

fn one_ball(race: &mut Race, list: &mut List, analytic: AnalyticLinearBall, ball: FourPointBall) {
    let cold = move |loads: Loads, steps: u8| {
        let contacts = ball.contacts(&loads.angles, &loads.forces);
        ball.refine(&contacts, &ball.start(&contacts), 0.0, steps)
    };
    let mut state = BallState::NOMINAL;
    Group::new(
        race,
        list,
        |share| Loads::new(1.6 * share - 0.8),
        |loads: Loads| loads.angles[0] + loads.forces[0],
    )
    .time("ball_analytic", move |loads| {
        analytic.speed_deviation(&loads.angles, &loads.forces)
    })
    .time("ball_start", move |loads| cold(loads, 0))
    .time("ball_step_1", move |loads| cold(loads, 1))
    .time("ball_step_2", move |loads| cold(loads, 2))
    .time("ball_step_3", move |loads| cold(loads, 3))
    .time("ball_warm_step", move |loads| {
        let contacts = ball.contacts(&loads.angles, &loads.forces);
        state = ball.step(&contacts, &state, 0.0);
        state
    });
}

fn two_balls(race: &mut Race, list: &mut List, analytic: AnalyticLinearBall, ball: FourPointBall) {
    const OPEN: [f32; 2] = [0.0, f32::INFINITY];
    let mut chain = BallChain::<2>::new();
    let mut press = Press::<2>::new();
    let mut row = move |pair: [Loads; 2], cold: bool, steps: usize| {
        let contacts = pair.map(|loads| ball.contacts(&loads.angles, &loads.forces));
        if cold {
            chain.balls = contacts.map(|contacts| ball.start(&contacts));
        }
        for _ in 0..steps {
            ball.refine_chain(
                &contacts,
                &mut chain,
                1.0,
                0.1,
                |free, compliance, forces| {
                    press.solve(free, &compliance.map(f32::recip), &OPEN);
                    for (place, force) in forces.iter_mut().zip(press.forces()) {
                        *place = force;
                    }
                },
            );
        }
        chain.forces[0]
    };
    let mut cold = row;
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
    })
    .time("pair_warm_step", move |pair| row(pair, false, 1))
    .time("pair_cold_3", move |pair| cold(pair, true, 3));
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
