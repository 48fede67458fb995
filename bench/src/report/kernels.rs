//! Scalar kernels: own, libm, micromath.

use epas_friction::math;

use super::Context;
use super::curvature_cost::shown;
use super::document::{Block, Cell, Section, Table};
use crate::failure::Failure;
use crate::timing::kernels::{libm, micromath, own};

/// A kernel by its float64 truth, its backends, and how its error is counted.
struct Kernel {
    name: &'static str,
    /// Inputs, from shares of 0 to 1.
    input: fn(f64) -> f32,
    domain: &'static str,
    truth: fn(f64) -> f64,
    measure: Error,
    backends: [Backend; 3],
}

struct Backend {
    name: &'static str,
    key: &'static str,
    function: fn(f32) -> f32,
}

/// How far a value is from the truth.
#[derive(Clone, Copy)]
enum Error {
    /// Relative to the truth.
    Relative,
    /// As it is.
    Absolute,
}

impl Error {
    fn of(self, value: f32, truth: f64) -> f64 {
        let difference = (f64::from(value) - truth).abs();
        match self {
            Self::Relative => difference / truth.abs(),
            Self::Absolute => difference,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Relative => "relative",
            Self::Absolute => "absolute",
        }
    }
}

/// Numbers over the positive range of f32 but its ends, evenly in their logarithm.
fn positive(share: f64) -> f32 {
    2f64.powf(-120.0 + 240.0 * share) as f32
}

fn angle(share: f64) -> f32 {
    (std::f64::consts::TAU * (2.0 * share - 1.0)) as f32
}

const fn backend(name: &'static str, key: &'static str, function: fn(f32) -> f32) -> Backend {
    Backend {
        name,
        key,
        function,
    }
}

fn all() -> [Kernel; 5] {
    let whole = "2^-120 to 2^120";
    let turns = "-2 pi to 2 pi";
    [
        Kernel {
            name: "square root",
            input: positive,
            domain: whole,
            truth: f64::sqrt,
            measure: Error::Relative,
            backends: [
                backend("own", "sqrt", math::sqrt),
                backend("libm", "sqrt_libm", ::libm::sqrtf),
                backend("micromath", "sqrt_micromath", micromath::sqrt),
            ],
        },
        Kernel {
            name: "cube root",
            input: positive,
            domain: whole,
            truth: f64::cbrt,
            measure: Error::Relative,
            backends: [
                backend("own", "cbrt", own::cbrt),
                backend("libm", "cbrt_libm", libm::cbrt),
                backend("micromath", "cbrt_micromath", micromath::cbrt),
            ],
        },
        Kernel {
            name: "its square",
            input: positive,
            domain: whole,
            truth: |x| x.cbrt().powi(2),
            measure: Error::Relative,
            backends: [
                backend("own", "cbrt_and_squared", own::cbrt_squared),
                backend("libm", "cbrt_and_squared_libm", libm::cbrt_squared),
                backend(
                    "micromath",
                    "cbrt_and_squared_micromath",
                    micromath::cbrt_squared,
                ),
            ],
        },
        Kernel {
            name: "sine",
            input: angle,
            domain: turns,
            truth: f64::sin,
            measure: Error::Absolute,
            backends: [
                backend("own", "sin_cos", |x| own::sin_cos(x).0),
                backend("libm", "sin_cos_libm", |x| libm::sin_cos(x).0),
                backend("micromath", "sin_cos_micromath", |x| {
                    micromath::sin_cos(x).0
                }),
            ],
        },
        Kernel {
            name: "cosine",
            input: angle,
            domain: turns,
            truth: f64::cos,
            measure: Error::Absolute,
            backends: [
                backend("own", "sin_cos", |x| own::sin_cos(x).1),
                backend("libm", "sin_cos_libm", |x| libm::sin_cos(x).1),
                backend("micromath", "sin_cos_micromath", |x| {
                    micromath::sin_cos(x).1
                }),
            ],
        },
    ]
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let samples = if context.quick { 20_000 } else { 1_000_000 };
    let mut table = Table::new(
        "kernels",
        format!(
            "Errors of the scalar kernels over {samples} inputs, and time of one call on this machine \
             (cube root and its square are timed together, sine and cosine too)"
        ),
        &[
            "kernel",
            "domain",
            "backend",
            "error",
            "largest",
            "rms",
            "latency (ns)",
            "quartiles (ns)",
            "throughput (ns)",
            "quartiles, throughput (ns)",
        ],
    );
    for kernel in all() {
        for backend in &kernel.backends {
            let (mut largest, mut squares) = (0.0_f64, 0.0);
            for index in 0..samples {
                let share = (f64::from(index) + 0.5) / f64::from(samples);
                let x = (kernel.input)(share);
                let error = kernel
                    .measure
                    .of((backend.function)(x), (kernel.truth)(x.into()));
                largest = largest.max(error);
                squares += error * error;
            }
            let time = context.time(backend.key)?;
            let mut cells = vec![
                Cell::text(kernel.name),
                Cell::text(kernel.domain),
                Cell::text(backend.name),
                Cell::text(kernel.measure.name()),
                Cell::error(largest),
                Cell::error((squares / f64::from(samples)).sqrt()),
            ];
            cells.extend(shown(&time.latency));
            cells.extend(shown(&time.throughput));
            table.rows.push(cells);
        }
    }
    let step = context.time("step_caged")?;
    Ok(Section {
        id: "kernels",
        title: "Scalar kernels: own, libm, micromath",
        blocks: vec![
            Block::text(
                "Square root, cube root and its square, sine and cosine in f32 by the crate's own \
                 kernels and by the two backends that can be chosen in their place. The own kernels are \
                 made for a core without double precision; on this machine, which has it, libm is as \
                 fast or faster.",
            ),
            Block::Table(table),
            Block::text(format!(
                "One tick of the caged ball-screw model, step(), takes {:.1} ns on this machine \
                 (latency; quartiles {:.1} to {:.1} ns).",
                step.latency.median, step.latency.quartiles.0, step.latency.quartiles.1
            )),
        ],
    })
}
