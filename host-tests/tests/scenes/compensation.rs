//! Compensation of friction in the loop: motor, delay, encoder and exact friction.

use std::convert::Infallible;

use embedded_hal::pwm::{ErrorType, SetDutyCycle};
use epas_friction::hal::{FaultReaction, FeedForwardConfiguration, FrictionFeedForward};
use epas_friction::law::Elements;
use epas_friction::law::coefficient::{CoefficientLaw, TemperatureFade};
use epas_friction::law::compensation::CompensationMargin;
use epas_friction::law::memory::{LoadExactElements, Part, ProportionalElements, SLIP_8};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Steady};
use epas_friction::scene::{Freshness, WithMemory, WithMemoryConfiguration, WithMemoryInputs};
use epas_friction::{CagedBallScrew, FrictionModel, Inputs};
use epas_reference::closed_loop::{ClosedLoop, Swing};

use crate::kit::gears::caged;
use crate::kit::random::Random;

const TEMPERATURE: f32 = 313.15;

/// A bridge that turns the duty into a torque again.
struct Bridge(u16);

impl Bridge {
    const SCALE: u16 = u16::MAX - 1;
}

impl ErrorType for Bridge {
    type Error = Infallible;
}

impl SetDutyCycle for Bridge {
    fn max_duty_cycle(&self) -> u16 {
        Self::SCALE
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0 = duty;
        Ok(())
    }
}

type Caged<E> = FrictionModel<WithMemory<CagedBallScrew, E, Steady<CountSensor>>>;

/// Preload of both flanks, N, as the scene counts it.
const PRELOAD: f64 = 848.528;

/// A model whose elements follow the counts beyond a play, rad, at this preload over their reference.
fn model<E: Elements + Copy>(elements: E, play: f64, load: f64) -> Caged<E> {
    let scene = caged();
    let counts = CountSensor::new(CountSensorParameters {
        period: 16384,
        turn_per_count: ClosedLoop::COUNT as f32,
        largest_turn: 0.5,
    })
    .unwrap();
    Caged::new(&WithMemoryConfiguration {
        scene,
        elements,
        angle: Steady::new(counts, play as f32).unwrap(),
        reference_load: (PRELOAD / load) as f32,
        play: 0.0,
        coefficient: CoefficientLaw::constant(scene.friction).unwrap(),
        temperature: TemperatureFade::new(TEMPERATURE, 60.0, 60.0).unwrap(),
        freshness: Freshness::DEFAULT,
    })
    .unwrap()
}

fn still(reading: u32) -> WithMemoryInputs<Inputs, u32> {
    WithMemoryInputs {
        scene: Inputs {
            nut_speed: 0.0,
            axial_load: 0.0,
        },
        reading,
        load_age: 0.0,
        temperature: TEMPERATURE,
        temperature_age: 0.0,
    }
}

/// Full friction of the model, N m: by the preload alone, the same in both directions.
fn full_friction() -> f32 {
    let mut model = model(slip(0.05, 1e-3), 0.0, 1.0);
    model.step(still(0));
    model.step(still(3000));
    let forward = model.step(still(3000)).friction_torque;
    model.step(still(0));
    assert_eq!(model.step(still(0)).friction_torque, -forward);
    forward
}

/// Elements of both forms.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Proportional,
    /// At this load over the reference.
    LoadExact(f64),
}

/// A true friction, a model that is off by these ratios, and a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Case {
    form: Form,
    /// Breakaway angle of the true friction, rad.
    breakaway: f64,
    /// True breakaway angle over the model's, and the model's full friction over the true one.
    earlier: f64,
    friction_ratio: f64,
    share: f32,
    /// Play beyond the noise, over the breakaway angle.
    play: f64,
    /// Ticks of the motor in a second; the model steps once in a millisecond.
    rate: u32,
    delay: usize,
    /// Speed at the start, rad/s.
    kick: f64,
    /// Standard deviation of the angle, counts; no angle is off by more than three of them.
    noise: f64,
}

impl Case {
    fn margin(&self) -> CompensationMargin {
        CompensationMargin {
            breakaway_angle: (self.breakaway / self.earlier) as f32,
            largest_breakaway_angle: self.breakaway as f32,
            friction_ratio: self.friction_ratio as f32,
            play: (self.play * self.breakaway) as f32,
        }
    }

    /// Breakaway angle in counts.
    fn counts(&self) -> f64 {
        self.breakaway / ClosedLoop::COUNT
    }

    fn swing(&self) -> Swing {
        let full = full_friction();
        let angle = self.breakaway / self.earlier;
        match self.form {
            Form::Proportional => self.swing_of(slip(full, angle as f32), 1.0),
            // Full friction grows with the load, breakaway with its power 2/3.
            Form::LoadExact(load) => {
                let limit = full / load as f32;
                let angle = angle / load.cbrt().powi(2);
                let elements = LoadExactElements::<8>::new(limit, angle as f32, 4.0);
                self.swing_of(elements.unwrap(), load)
            }
        }
    }

    fn swing_of<E: Elements + Copy>(&self, elements: E, load: f64) -> Swing {
        let full = full_friction();
        let count = ClosedLoop::COUNT;
        // A count is off by half of one, and by the noise.
        let noise_width = if self.noise > 0.0 {
            (0.5 + 3.0 * self.noise) * count
        } else {
            0.0
        };
        let mut model = model(elements, noise_width + self.play * self.breakaway, load);
        let mut stage = stage(4.0 * full, self.share);
        let mut random = Random(7);
        let mut tick = 0;
        let plant = ClosedLoop {
            inertia: 4e-4,
            friction: f64::from(full) / self.friction_ratio,
            breakaway: self.breakaway,
            count,
            tick: 1.0 / f64::from(self.rate),
            delay: self.delay,
            kick: self.kick,
            settling: 2.0,
            watched: 1.0,
        };
        plant.run(
            || 0.5 + self.noise * (random.signed() + random.signed() + random.signed()),
            |count| {
                let reading = count.rem_euclid(16384) as u32;
                let outputs = if tick % (self.rate / 1000) == 0 {
                    model.step(still(reading))
                } else {
                    model.between(reading)
                };
                tick += 1;
                let Ok(applied) = stage.apply(&outputs);
                assert!(!applied.neutral && !applied.saturated);
                let duty = f64::from(applied.duty) / f64::from(Bridge::SCALE);
                4.0 * f64::from(full) * (2.0 * duty - 1.0)
            },
        )
    }
}

/// A bridge with the share as it is: what a margin forbids is tried here too.
fn stage(full_torque: f32, share: f32) -> FrictionFeedForward<Bridge> {
    let configuration = FeedForwardConfiguration {
        full_torque,
        largest_torque: full_torque,
        share,
        reaction: FaultReaction::NeutralOnAnyFault,
    };
    FrictionFeedForward::new(Bridge(0), &configuration).unwrap()
}

fn slip(limit: f32, breakaway_angle: f32) -> ProportionalElements<8> {
    let part = Part {
        backbone: &SLIP_8.elements,
        share: 1.0,
        breakaway_angle,
    };
    ProportionalElements::new(limit, &[part]).unwrap()
}

/// Runs cases on two threads; gives what is to be said of those that are not as they should be.
fn unlike(cases: &[Case], good: impl Fn(&Case, &Swing) -> bool + Sync) -> Vec<String> {
    let check = |cases: &[Case]| {
        let bad = cases.iter().filter_map(|case| {
            let swing = case.swing();
            (!good(case, &swing)).then(|| format!("{case:?}: {swing:?}"))
        });
        bad.collect::<Vec<_>>()
    };
    let (first, second) = cases.split_at(cases.len() / 2);
    std::thread::scope(|scope| {
        let other = scope.spawn(|| check(second));
        let mut bad = check(first);
        bad.extend(other.join().unwrap());
        bad
    })
}

const QUIET: Case = Case {
    form: Form::Proportional,
    breakaway: 2e-3,
    earlier: 1.0,
    friction_ratio: 1.0,
    share: 0.95,
    play: 0.05,
    rate: 20_000,
    delay: 1,
    kick: 1.0,
    noise: 0.0,
};

const FORMS: [Form; 4] = [
    Form::Proportional,
    Form::LoadExact(1.0),
    Form::LoadExact(0.4),
    Form::LoadExact(2.0),
];

/// Ratio of breakaway angles, ratio of frictions, play over breakaway.
const MARGINS: [(f64, f64, f64); 6] = [
    (1.0, 1.0, 0.05),
    (0.8, 1.0, 0.041),
    (1.02, 1.0, 0.1),
    (1.1, 1.0, 0.05),
    (1.2, 1.1, 0.1),
    (1.7, 1.0, 0.2),
];

/// Two seconds after a kick nothing moves but what is left of the last swing: less than a count and a tenth of a breakaway angle from end
/// to end. At every rate, delay and breakaway, with the largest share that each margin allows.
#[test]
fn quiet_within_the_margin() {
    let mut cases = Vec::new();
    for breakaway in [0.5e-3, 2e-3, 5e-3, 10e-3] {
        for (rate, delay) in [
            (1000, 1),
            (1000, 2),
            (1000, 3),
            (10_000, 2),
            (20_000, 1),
            (20_000, 3),
        ] {
            for (earlier, friction_ratio, play) in MARGINS {
                for form in FORMS {
                    for noise in [0.0, 0.3] {
                        let case = Case {
                            form,
                            breakaway,
                            earlier,
                            friction_ratio,
                            play,
                            rate,
                            delay,
                            noise,
                            ..QUIET
                        };
                        let share = case.margin().largest_share().unwrap();
                        cases.push(Case { share, ..case });
                    }
                }
            }
        }
    }
    let loud = unlike(&cases, |case, swing| {
        swing.counts < 1.0 + 0.1 * case.counts()
    });
    assert!(
        loud.is_empty(),
        "{} of {}: {}",
        loud.len(),
        cases.len(),
        loud.join("\n")
    );
}
