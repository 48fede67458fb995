//! Scenes with a train, for any number of balls.

use epas_friction::{
    Error, FrictionModel, Inputs, LinearBearingConfiguration, LinearBearingTrain, LinearInputs,
    Outputs, UncagedBallScrew, UncagedBallScrewConfiguration,
};

use super::trace::{Sample, Trace};
use crate::designs::train::{LinearDesign, UncagedDesign};
use crate::failure::Failure;

/// Most balls of a train.
const MOST_BALLS: u8 = 64;

/// Most ticks for each sample of a trace.
const MOST_TICKS: u32 = 1 << 16;

/// Outputs of a train as the table and the picture show them: N m of a screw, N of a bearing.
#[derive(Clone, Copy, Debug)]
pub struct TrainOutputs {
    /// What every scene has; of a bearing the friction torque is the force along the rail.
    pub common: Outputs,
    /// Friction from the grooves.
    pub groove: f32,
    /// Friction from balls that rub against each other.
    pub ball: f32,
    /// Pairs of balls that press on each other.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
}

/// What a train does at a sample.
#[derive(Clone, Copy, Debug)]
pub struct TrainRow {
    /// Its outputs.
    pub outputs: TrainOutputs,
    /// Balls that press on the one in front, one bit each.
    pub pressing: u64,
    /// Angle that the nut has turned, rad, or way of the carriage, m.
    pub way: f64,
}

/// A model of a train over a trace of equal steps.
pub struct Train {
    model: Box<dyn Model>,
    ticks: u32,
    step: f64,
    way: f64,
}

/// The in-loop model, whatever its number of balls.
trait Model {
    fn step(&mut self, sample: &Sample) -> TrainOutputs;
    fn pressing(&self) -> u64;
}

/// Balls that press on the one in front, one bit each.
fn pressing<const N: usize>(train: &epas_friction::train::Train<N>) -> u64 {
    train
        .contacts()
        .iter()
        .fold(0, |bits, contact| bits | 1 << contact.ball)
}

impl<const N: usize> Model for FrictionModel<UncagedBallScrew<N>> {
    fn step(&mut self, sample: &Sample) -> TrainOutputs {
        let outputs = FrictionModel::step(
            self,
            Inputs {
                nut_speed: sample.nut_speed as f32,
                axial_load: sample.axial_load as f32,
            },
        );
        TrainOutputs {
            common: outputs.into(),
            groove: outputs.groove_torque,
            ball: outputs.ball_torque,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
        }
    }

    fn pressing(&self) -> u64 {
        pressing(&self.state().train)
    }
}

impl<const N: usize> Model for FrictionModel<LinearBearingTrain<N>> {
    fn step(&mut self, sample: &Sample) -> TrainOutputs {
        let outputs = FrictionModel::step(
            self,
            LinearInputs {
                speed: sample.nut_speed as f32,
                normal_load: sample.axial_load as f32,
                side_load: sample.side_load as f32,
            },
        );
        TrainOutputs {
            common: Outputs {
                friction_torque: outputs.friction_force,
                load_torque: 0.0,
                efficiency: 0.0,
                regime: outputs.regime,
                faults: outputs.faults,
            },
            groove: outputs.groove_force,
            ball: outputs.ball_force,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
        }
    }

    fn pressing(&self) -> u64 {
        pressing(&self.state().train)
    }
}

/// The scene with the number of balls that is known only now.
macro_rules! with_balls {
    ($scene:ident, $balls:expr, $configuration:expr; $($count:literal)*) => {
        match $balls {
            $($count => FrictionModel::<$scene<$count>>::new($configuration)
                .map(|model| Some(Box::new(model) as Box<dyn Model>)),)*
            _ => Ok(None),
        }
    };
    ($scene:ident, $balls:expr, $configuration:expr) => {
        with_balls!($scene, $balls, $configuration;
            1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
            33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61
            62 63 64)
    };
}

type Built = Result<Option<Box<dyn Model>>, Error>;

fn uncaged(balls: u8, configuration: &UncagedBallScrewConfiguration) -> Built {
    with_balls!(UncagedBallScrew, balls, configuration)
}

fn linear(balls: u8, configuration: &LinearBearingConfiguration) -> Built {
    with_balls!(LinearBearingTrain, balls, configuration)
}

impl Train {
    /// The balls of a ball screw.
    pub fn of_screw(design: &UncagedDesign, trace: &Trace) -> Result<Self, Failure> {
        Self::new(trace, |tick| {
            let mut configuration = design.configuration;
            configuration.tick = tick;
            uncaged(design.balls, &configuration)
        })
    }

    /// The balls of a linear bearing.
    pub fn of_bearing(design: &LinearDesign, trace: &Trace) -> Result<Self, Failure> {
        Self::new(trace, |tick| {
            let mut configuration = design.configuration;
            configuration.tick = tick;
            linear(design.balls, &configuration)
        })
    }

    /// As many ticks for each sample as the limit of the balls' travel in a tick needs.
    fn new(trace: &Trace, build: impl Fn(f32) -> Built) -> Result<Self, Failure> {
        let step = equal_step(trace)?;
        let mut ticks = 1;
        loop {
            match build((step / f64::from(ticks)) as f32) {
                Ok(Some(model)) => {
                    return Ok(Self {
                        model,
                        ticks,
                        step,
                        way: 0.0,
                    });
                }
                Ok(None) => {
                    return Err(Failure::Data(format!(
                        "balls is out of range; allowed: 1 to {MOST_BALLS}"
                    )));
                }
                Err(error) if error.field() == "tick" && ticks < MOST_TICKS => ticks *= 2,
                Err(error) => return Err(Failure::Data(error.to_string())),
            }
        }
    }

    /// What the train does at a sample, and then until the next one.
    pub fn step(&mut self, sample: &Sample) -> TrainRow {
        let outputs = self.model.step(sample);
        let row = TrainRow {
            outputs,
            pressing: self.model.pressing(),
            way: self.way,
        };
        for _ in 1..self.ticks {
            self.model.step(sample);
        }
        self.way += sample.nut_speed * self.step;
        row
    }
}

/// The time between two samples, s, where it is the same all along: positions of balls are integrated.
fn equal_step(trace: &Trace) -> Result<f64, Failure> {
    let [first, second, ..] = trace.samples.as_slice() else {
        return Err(Failure::Data(
            "a scene with a train needs a trace of two samples or more".into(),
        ));
    };
    let step = second.time - first.time;
    for pair in trace.samples.windows(2) {
        if let [one, other] = pair {
            let this = other.time - one.time;
            // Times in a file are rounded.
            if step <= 0.0 || (this - step).abs() > 0.01 * step + 1e-9 {
                return Err(Failure::Data(format!(
                    "a scene with a train needs equal steps of time: {step} s at the start, {this} s after \
                     {} s",
                    one.time
                )));
            }
        }
    }
    Ok(step)
}
