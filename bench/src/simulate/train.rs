//! Models of scenes with a train, for any number of balls, over a trace of equal steps.

use epas_friction::Error;

use super::trace::{Sample, Trace};
use crate::failure::Failure;

/// Most balls of a train.
const MOST_BALLS: u8 = 64;

/// Most ticks for each sample of a trace.
const MOST_TICKS: u32 = 1 << 16;

/// The in-loop model of a scene, whatever its number of balls.
pub trait Balls<S, Outputs>: Send + Sync {
    /// What the model says to a sample.
    fn step(&mut self, sample: &S) -> Outputs;
    /// Balls that press on the one in front, one bit each.
    fn pressing(&self) -> u64;
    /// Back to the state before the first tick.
    fn reset(&mut self);
    /// Consecutive ticks with a fault.
    fn faulted_ticks(&self) -> u32;
    /// Sets the friction coefficient of ball and groove.
    ///
    /// # Errors
    /// [`Error`] naming it; the model goes on as it was.
    fn set_friction(&mut self, friction: f32) -> Result<(), Error>;
    /// Sets where the grooves' deviations are counted from: angle of the nut, rad, or place of the carriage, m. False where
    /// the scene does not take it.
    fn set_place(&mut self, place: f32) -> bool;
    /// The same model in the same state.
    fn copied(&self) -> Box<dyn Balls<S, Outputs>>;
}

/// Balls that press on the one in front, one bit each.
pub fn pressing<const N: usize>(train: &epas_friction::train::Train<N>) -> u64 {
    train
        .contacts()
        .iter()
        .fold(0, |bits, contact| bits | 1 << contact.ball)
}

/// Without the program no row of balls is needed, whatever its number is.
#[cfg(not(feature = "program"))]
macro_rules! with_balls {
    ($kind:ident $scene:ident, $balls:expr, $configuration:expr) => {
        Ok(None)
    };
}

/// A scene with the number of balls that is known only when the program runs; none where it is out of range.
#[cfg(feature = "program")]
macro_rules! with_balls {
    (plain $scene:ident, $balls:expr, $configuration:expr; $($count:literal)*) => {
        match $balls {
            $($count => FrictionModel::<$scene<$count>>::new($configuration)
                .map(|model| Some(Box::new(model) as _)),)*
            _ => Ok(None),
        }
    };
    (remembering $scene:ident, $balls:expr, $configuration:expr; $($count:literal)*) => {
        match $balls {
            $($count => FrictionModel::<Remembering<$scene<$count>>>::new($configuration)
                .map(|model| Some(Box::new(model) as _)),)*
            _ => Ok(None),
        }
    };
    ($kind:ident $scene:ident, $balls:expr, $configuration:expr) => {
        with_balls!($kind $scene, $balls, $configuration;
            1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
            33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61
            62 63 64)
    };
}
pub(super) use with_balls;

/// A model as it is built, none for a number of balls that is out of range.
pub type Built<S, Outputs> = Result<Option<Box<dyn Balls<S, Outputs>>>, Error>;

/// What a train does at a sample.
#[derive(Clone, Copy, Debug)]
pub struct TrainRow<Outputs> {
    /// Its outputs.
    pub outputs: Outputs,
    /// Balls that press on the one in front, one bit each.
    pub pressing: u64,
    /// Motion since the first sample: angle of the nut, rad, or travel of the carriage, m.
    pub motion: f64,
}

/// A model of a train over a trace of equal steps.
pub struct Train<S, Outputs> {
    model: Box<dyn Balls<S, Outputs>>,
    ticks: u32,
    step: f64,
    motion: f64,
}

impl<S: Sample, Outputs> Train<S, Outputs> {
    /// The model that `build` makes for a tick, s: as many ticks for each sample as the limit of the balls'
    /// travel in a tick needs.
    pub fn new(
        trace: &Trace<S>,
        build: impl Fn(f32) -> Built<S, Outputs>,
    ) -> Result<Self, Failure> {
        let step = equal_step(trace)?;
        let mut ticks = 1;
        loop {
            match build((step / f64::from(ticks)) as f32) {
                Ok(Some(model)) => {
                    return Ok(Self {
                        model,
                        ticks,
                        step,
                        motion: 0.0,
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
    pub fn step(&mut self, sample: &S) -> TrainRow<Outputs> {
        let outputs = self.model.step(sample);
        let row = TrainRow {
            outputs,
            pressing: self.model.pressing(),
            motion: self.motion,
        };
        for _ in 1..self.ticks {
            self.model.step(sample);
        }
        self.motion += sample.speed() * self.step;
        row
    }
}

/// The time between two samples, s, where it is the same all along: positions of balls are integrated.
fn equal_step<S: Sample>(trace: &Trace<S>) -> Result<f64, Failure> {
    let [first, second, ..] = trace.samples.as_slice() else {
        return Err(Failure::Data(
            "a scene with a train needs a trace of two samples or more".into(),
        ));
    };
    let step = second.time() - first.time();
    for pair in trace.samples.windows(2) {
        if let [one, other] = pair {
            let this = other.time() - one.time();
            // Times in a file are rounded.
            if step <= 0.0 || (this - step).abs() > 0.01 * step + 1e-9 {
                return Err(Failure::Data(format!(
                    "a scene with a train needs equal steps of time: {step} s at the start, {this} s after \
                     {} s",
                    one.time()
                )));
            }
        }
    }
    Ok(step)
}
