//! The scalar kernels of the three backends: error and time.

use std::f64::consts::TAU;

use super::context::Context;
use super::statistics::{Errors, evenly};
use super::times::time;
use crate::report::draw::table;
use crate::timing;
use crate::timing::kernels::{libm, micromath, own};
use epas_page::document::{Block, Cell, Section};
use epas_page::failure::Failure;

/// Inputs of a sweep.
const INPUTS: usize = 400_000;

/// Relative errors over all magnitudes.
pub fn relative(kernel: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64) -> Errors {
    evenly(-37.9, 38.5, INPUTS)
        .map(|exponent| 10f64.powf(exponent) as f32)
        .map(|x| f64::from(kernel(x)) / exact(f64::from(x)) - 1.0)
        .collect()
}

/// Absolute errors of sine and cosine within two turns.
pub fn absolute(kernel: impl Fn(f32) -> (f32, f32)) -> Errors {
    evenly(-TAU, TAU, INPUTS)
        .flat_map(|angle| {
            let angle = angle as f32;
            let (sin, cos) = kernel(angle);
            let (exact_sin, exact_cos) = f64::from(angle).sin_cos();
            [f64::from(sin) - exact_sin, f64::from(cos) - exact_cos]
        })
        .collect()
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let sqrt = f64::sqrt as fn(f64) -> f64;
    let cbrt = f64::cbrt as fn(f64) -> f64;
    let entries: [(&str, &str, &str, Errors); 9] = [
        (
            "square root",
            "own (instruction)",
            "sqrt",
            relative(epas_friction::math::sqrt, sqrt),
        ),
        (
            "square root",
            "libm",
            "sqrt_libm",
            relative(::libm::sqrtf, sqrt),
        ),
        (
            "square root",
            "micromath",
            "sqrt_micromath",
            relative(micromath::sqrt, sqrt),
        ),
        ("cube root", "own", "cbrt", relative(own::cbrt, cbrt)),
        ("cube root", "libm", "cbrt_libm", relative(libm::cbrt, cbrt)),
        (
            "cube root",
            "micromath",
            "cbrt_micromath",
            relative(micromath::cbrt, cbrt),
        ),
        ("sine and cosine", "own", "sin_cos", absolute(own::sin_cos)),
        (
            "sine and cosine",
            "libm",
            "sin_cos_libm",
            absolute(libm::sin_cos),
        ),
        (
            "sine and cosine",
            "micromath",
            "sin_cos_micromath",
            absolute(micromath::sin_cos),
        ),
    ];
    let mut rows = Vec::new();
    for (kernel, backend, key, errors) in entries {
        let times = timing::times(&context.competition, key)?;
        rows.push(vec![
            kernel.into(),
            backend.into(),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            time(&times.latency, 2),
            time(&times.throughput, 2),
        ]);
    }
    Ok(Section {
        title: "Scalar kernels",
        blocks: vec![
            Block::Text(
                "Roots: relative errors over all magnitudes; sine and cosine: absolute errors within two \
                 pi. On this machine libm is fast because the processor has double precision; on a \
                 Cortex-M4F that is software, over a thousand instructions a call."
                    .into(),
            ),
            Block::Table(table("kernels", "Scalar kernels of the three backends", &[
                    "kernel",
                    "backend",
                    "largest error",
                    "rms",
                    "mean",
                    "latency (ns)",
                    "throughput (ns)",
                ], rows)),
        ],
    })
}
