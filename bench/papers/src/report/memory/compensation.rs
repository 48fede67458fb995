//! Compensation of friction in the loop: what keeps it quiet, and what makes it hum.

use epas_friction::law::compensation::CompensationMargin;
use epas_friction::law::memory::{Part, ProportionalElements, SLIP_8};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband, NutAngle};
use epas_friction::law::{Elements, SlidingLimits};
use epas_reference::closed_loop::{ClosedLoop, Swing};
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::peers::paths::STREAM;
use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

const FRICTION: f32 = 0.04;

const PERIOD: u32 = 16_384;

#[derive(Clone, Copy)]
enum Law {
    /// By the speed, with a reversal speed, rad/s.
    Speed(f64),
    /// By the angle: true breakaway angle over the model's, and half width of the play beyond the noise over the true one;
    /// `None` where elements follow the counts as they are.
    Angle(f64, Option<f64>),
}

struct Case {
    name: &'static str,
    law: Law,
    share: f32,
    /// True breakaway angle, rad.
    breakaway: f64,
    rate: f64,
    delay: usize,
    /// Amplitude of the push at first over the full friction, and standard deviation of the angle in counts.
    push: f64,
    noise: f64,
}

pub fn blocks() -> Result<Vec<Block>, Failure> {
    let rows = cases()
        .par_iter()
        .map(Case::row)
        .collect::<Result<_, Failure>>()?;
    let columns = "compensation | share | largest share allowed | true breakaway, mrad | \
         true breakaway over the model's | play beyond noise, over breakaway | ticks, 1/s | \
         delay, ticks | noise, counts rms | swing, counts | swing, breakaway angles | \
         speed, rad/s";
    Ok(vec![Block::Table(table(
        "memory_compensation",
        "Friction compensated in a simulated loop: motor and screw of 4e-4 kg m^2 at the nut, exact friction of 0.04 N m, an encoder of 14 bits behind a ratio of 2.5, and ticks of \
         delay from a reading to its torque. Pushed at 25 Hz with half of the friction for half a second, or with a noisy angle from rest; left alone until 2 s; what the nut does in the \
         second after that, from end to end. Compensation is negative stiffness: the share has to stay below the friction, below the stiffness and below what a swing loses; a play between \
         sensor and elements, a twentieth of the breakaway angle beyond the noise, gives room for the last of these and keeps noise out",
        columns,
        rows,
    ))])
}

fn cases() -> Vec<Case> {
    let case = |name, law, share, breakaway, (rate, delay), (push, noise)| Case {
        name,
        law,
        share,
        breakaway,
        rate,
        delay,
        push,
        noise,
    };
    let (slow, fast) = ((1e3, 1), (2e4, 1));
    let (pushed, noisy, both) = ((0.5, 0.0), (0.0, 0.3), (0.5, 0.3));
    let speed = Law::Speed(0.5);
    let inside = Law::Angle(1.0, Some(0.05));
    vec![
        case("by speed", speed, 0.95, 2e-3, slow, pushed),
        case("by speed", speed, 0.95, 1e-2, slow, pushed),
        case("by speed", speed, 0.95, 1e-2, fast, pushed),
        case("all of it", inside, 1.0, 2e-3, fast, pushed),
        case("no play", Law::Angle(1.05, None), 0.924, 1e-2, fast, pushed),
        case("no play", Law::Angle(1.11, None), 0.95, 5e-3, slow, pushed),
        case("no play", Law::Angle(1.0, None), 0.95, 1e-3, fast, noisy),
        case("behind a play", inside, 0.95, 1e-3, fast, noisy),
        case("behind a play", inside, 0.95, 5e-4, slow, both),
        case("behind a play", inside, 0.95, 2e-3, (1e3, 3), both),
        case("behind a play", inside, 0.95, 2e-3, fast, both),
        case("behind a play", inside, 0.95, 1e-2, fast, both),
        case(
            "behind a play",
            Law::Angle(1.25, Some(0.1)),
            0.73,
            1e-2,
            fast,
            both,
        ),
    ]
}

impl Case {
    fn row(&self) -> Result<Vec<Cell>, Failure> {
        let swing = self.swing()?;
        let (allowed, ratio, play) = match self.law {
            Law::Speed(_) => (Cell::from("none"), "".into(), "".into()),
            Law::Angle(ratio, play) => (
                self.allowed(ratio, play.unwrap_or(0.0)),
                Cell::fixed(ratio, 2),
                play.map_or("none".into(), |play| Cell::fixed(play, 2)),
            ),
        };
        Ok(vec![
            self.name.into(),
            Cell::fixed(self.share.into(), 3),
            allowed,
            Cell::fixed(1e3 * self.breakaway, 1),
            ratio,
            play,
            Cell::fixed(self.rate, 0),
            Cell::fixed(self.delay as f64, 0),
            Cell::fixed(self.noise, 1),
            Cell::fixed(swing.counts, 1),
            Cell::fixed(swing.counts * ClosedLoop::COUNT / self.breakaway, 2),
            Cell::fixed(swing.speed, 3),
        ])
    }

    /// The largest share that the margin allows; without a play it allows none.
    fn allowed(&self, ratio: f64, play: f64) -> Cell {
        let margin = CompensationMargin {
            breakaway_angle: (self.breakaway / ratio) as f32,
            largest_breakaway_angle: self.breakaway as f32,
            friction_ratio: 1.0,
            play: (play * self.breakaway) as f32,
        };
        margin
            .largest_share()
            .map_or("none".into(), |share| Cell::fixed(share.into(), 3))
    }

    fn swing(&self) -> Result<Swing, Failure> {
        let plant = ClosedLoop {
            inertia: 4e-4,
            friction: FRICTION.into(),
            breakaway: self.breakaway,
            count: ClosedLoop::COUNT,
            tick: 1.0 / self.rate,
            delay: self.delay,
            kick: 0.0,
            push: self.push * f64::from(FRICTION),
            settling: 2.0,
            watched: 1.0,
        };
        let normal = Normal::new(0.0, self.noise)?;
        let mut random = Pcg64::new(11, STREAM);
        // Cut at three, which the play is wide enough for.
        let noise = || {
            0.5 + normal
                .sample(&mut random)
                .clamp(-3.0 * self.noise, 3.0 * self.noise)
        };
        let share = f64::from(self.share);
        match self.law {
            Law::Speed(reversal_speed) => {
                let mut last = 0;
                Ok(plant.run(noise, |count| {
                    let speed = (count - last) as f64 * ClosedLoop::COUNT * self.rate;
                    last = count;
                    share * f64::from(FRICTION) * speed / speed.hypot(reversal_speed)
                }))
            }
            Law::Angle(ratio, play) => {
                let mut follow = self.elements(ratio, play)?;
                Ok(plant.run(noise, |count| {
                    share * follow(count.rem_euclid(PERIOD.into()) as u32)
                }))
            }
        }
    }

    /// Friction of a count, by the crate's sensor and elements.
    fn elements(
        &self,
        ratio: f64,
        play: Option<f64>,
    ) -> Result<impl FnMut(u32) -> f64, epas_friction::Error> {
        let part = Part {
            backbone: &SLIP_8.elements,
            share: 1.0,
            breakaway_angle: (self.breakaway / ratio) as f32,
        };
        let elements = ProportionalElements::<8>::new(FRICTION, &[part])?;
        let counts = CountSensor::new(CountSensorParameters {
            period: PERIOD,
            turn_per_count: ClosedLoop::COUNT as f32,
            largest_turn: 0.5,
        })?;
        let noise = (0.5 + 3.0 * self.noise) * ClosedLoop::COUNT;
        let half_width = play.map_or(0.0, |play| noise + play * self.breakaway);
        let sensor = Deadband::new(counts, half_width as f32)?;
        let mut reading = Deadband::<CountSensor>::FRESH;
        let mut state = ProportionalElements::<8>::VIRGIN;
        let limits = SlidingLimits {
            forward: FRICTION,
            backward: FRICTION,
            load: 1.0,
        };
        Ok(move |count| {
            let turn = sensor.turn(&mut reading, count).angle();
            elements.follow(&mut state, turn, &limits).into()
        })
    }
}
