//! Models of scenes with a train, over a trace of equal steps.

use super::balls::{Balls, Built};
use super::trace::{Sample, SceneSample, Trace};
use epas_page::failure::Failure;

/// Most ticks for each sample of a trace.
const MOST_TICKS: u32 = 1 << 16;

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
pub struct Train<S: SceneSample, Outputs> {
    model: Box<dyn Balls<S::Inputs, Outputs>>,
    ticks: u32,
    step: f64,
    motion: f64,
}

impl<S: SceneSample, Outputs> Train<S, Outputs> {
    /// The model that `build` makes for a tick, s: as many ticks for each sample, doubled from one, as its limits need.
    pub fn new(
        trace: &Trace<S>,
        build: impl Fn(f32) -> Built<S::Inputs, Outputs>,
    ) -> Result<Self, Failure> {
        let step = equal_step(trace)?;
        let mut ticks = 1;
        loop {
            match build((step / f64::from(ticks)) as f32) {
                Ok(model) => {
                    return Ok(Self {
                        model,
                        ticks,
                        step,
                        motion: 0.0,
                    });
                }
                Err(error) if error.field() == "tick" => {
                    if error.value() > error.allowed().maximum && ticks < MOST_TICKS {
                        ticks *= 2;
                        continue;
                    }
                    let part = if ticks == 1 {
                        String::new()
                    } else {
                        format!("1/{ticks} of ")
                    };
                    return Err(Failure::Data(format!(
                        "{error} s; it is {part}the trace's step of {step} s"
                    )));
                }
                Err(error) => return Err(Failure::Data(error.to_string())),
            }
        }
    }

    /// Its ticks, for the summary.
    pub fn told(&self) -> String {
        let tick = 1e3 * self.step / f64::from(self.ticks);
        match self.ticks {
            1 => format!("{tick:.4} ms, one a sample"),
            ticks => format!("{tick:.4} ms, {ticks} a sample"),
        }
    }

    /// What the train does at a sample, and then until the next one.
    pub fn step(&mut self, sample: &S) -> TrainRow<Outputs> {
        let inputs = sample.inputs();
        let outputs = self.model.step(inputs);
        let row = TrainRow {
            outputs,
            pressing: self.model.pressing(),
            motion: self.motion,
        };
        for _ in 1..self.ticks {
            self.model.step(inputs);
        }
        self.motion += sample.speed() * self.step;
        row
    }
}

/// The time between two samples, s, where it is the same all along: positions of balls are integrated.
pub fn equal_step<S: Sample>(trace: &Trace<S>) -> Result<f64, Failure> {
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
