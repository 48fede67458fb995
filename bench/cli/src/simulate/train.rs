//! Rows of balls that press on each other, over a trace of equal steps, and which press in a picture (Lin 2019, Figures 3.24 and 3.25).

use super::picture::{self, Form, Labels, Moment};
use super::reference::Friction;
use super::scene::Row;
use super::trace::{Sample, SceneSample, Trace};
use crate::model::{Built, Model, TickOutputs};
use epas_page::failure::Failure;
use epas_page::plot::{Mark, Panel, Series};

/// Most ticks for each sample of a trace.
const MOST_TICKS: u32 = 1 << 16;

pub struct Train {
    model: Box<dyn Model>,
    ticks: u32,
    step: f64,
    motion: f64,
}

impl Train {
    /// The model that `build` makes for a tick, s: as many ticks for each sample, doubled from one, as its limits need.
    pub fn new<S: Sample>(trace: &Trace<S>, build: impl Fn(f32) -> Built) -> Result<Self, Failure> {
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

    pub fn told(&self) -> String {
        let tick = 1e3 * self.step / f64::from(self.ticks);
        match self.ticks {
            1 => format!("{tick:.4} ms, one a sample"),
            ticks => format!("{tick:.4} ms, {ticks} a sample"),
        }
    }

    pub fn rows<S: SceneSample>(
        &mut self,
        trace: &Trace<S>,
        reference: &[Friction],
        done: &dyn Fn(),
    ) -> Vec<Row<S>> {
        let samples = trace.samples.iter().enumerate();
        let row = |(index, sample): (usize, &S)| {
            let row = self.step(sample, reference.get(index).copied());
            done();
            row
        };
        samples.map(row).collect()
    }

    fn step<S: SceneSample>(&mut self, sample: &S, reference: Option<Friction>) -> Row<S> {
        let inputs = sample.inputs();
        let outputs = self.model.step(&inputs);
        let row = Row {
            sample: *sample,
            temperature: inputs.temperature,
            outputs,
            pressing: self.model.pressing(),
            motion: self.motion,
            reference,
        };
        for _ in 1..self.ticks {
            self.model.step(&inputs);
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

/// Moments at which contacts are marked, at most.
const MOMENTS: usize = 500;

pub fn draw<S>(
    labels: &Labels,
    moments: &[Moment],
    rows: &[Row<S>],
    form: Form,
) -> Result<String, Failure> {
    let points: Vec<_> = moments.iter().zip(rows).collect();
    let mut panels = picture::panels(labels, moments, form);
    let ends = picture::ends(moments);
    let curve = |value: &dyn Fn(&TickOutputs) -> f64| {
        form.curve(&points, &|point| point.0.place, &|point| {
            value(&point.1.outputs)
        })
    };
    let panel = |label: &str, mark, points| -> Panel {
        let series = vec![Series::new("", 0, mark, points)];
        picture::chart("", labels.place, ends, label, series)
    };
    panels.extend([
        panel("ball that presses on the next", Mark::Dots, marks(&points)),
        panel(
            "ball-to-ball contacts",
            Mark::Line,
            curve(&|outputs| outputs.contacts.into()),
        ),
        panel(
            "largest force between balls (N)",
            Mark::Line,
            curve(&|outputs| outputs.largest_contact_force.into()),
        ),
    ]);
    form.draw(&labels.title, &panels)
}

fn marks<S>(points: &[(&Moment, &Row<S>)]) -> Vec<(f64, f64)> {
    let stride = points.len().div_ceil(MOMENTS).max(1);
    points
        .iter()
        .step_by(stride)
        .flat_map(|(moment, row)| {
            (0..u64::BITS)
                .filter(|ball| row.pressing >> ball & 1 == 1)
                .map(|ball| (moment.place, f64::from(ball + 1)))
        })
        .collect()
}
