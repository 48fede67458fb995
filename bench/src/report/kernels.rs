//! The scalar kernels of the three backends: error and time.

use std::f64::consts::TAU;

use super::Context;
use super::statistics::{Errors, evenly};
use super::times::time;
use crate::report::draw::table;
use crate::timing;
use crate::timing::kernels::{libm, micromath, own};
use epas_page::document::{Block, Cell, Section};
use epas_page::failure::Failure;

const INPUTS: usize = 400_000;

const BACKENDS: [&str; 3] = ["own", "libm", "micromath"];

pub fn relative(kernel: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64) -> Errors {
    evenly(-37.9, 38.5, INPUTS)
        .map(|exponent| 10f64.powf(exponent) as f32)
        .map(|x| f64::from(kernel(x)) / exact(f64::from(x)) - 1.0)
        .collect()
}

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

pub fn section(context: &Context) -> Result<Section, Failure> {
    let sqrt = |kernel: fn(f32) -> f32| relative(kernel, f64::sqrt);
    let cbrt = |kernel: fn(f32) -> f32| relative(kernel, f64::cbrt);
    let kernels = [
        (
            "square root",
            ["sqrt", "sqrt_libm", "sqrt_micromath"],
            [epas_friction::math::sqrt, ::libm::sqrtf, micromath::sqrt].map(sqrt),
        ),
        (
            "cube root",
            ["cbrt", "cbrt_libm", "cbrt_micromath"],
            [own::cbrt, libm::cbrt, micromath::cbrt].map(cbrt),
        ),
        (
            "sine and cosine",
            ["sin_cos", "sin_cos_libm", "sin_cos_micromath"],
            [own::sin_cos, libm::sin_cos, micromath::sin_cos].map(absolute),
        ),
    ];
    let mut rows = Vec::new();
    for (kernel, keys, errors) in kernels {
        for ((backend, key), errors) in BACKENDS.into_iter().zip(keys).zip(errors) {
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
            Block::Table(table("kernels", "Scalar kernels of the three backends", "kernel | backend | largest error | rms | mean | latency (ns) | throughput (ns)", rows)),
        ],
    })
}
