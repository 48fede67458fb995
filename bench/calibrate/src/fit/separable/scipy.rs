//! Fits compared with SciPy's.

use super::*;
use crate::fit::problem::Evaluation;
use crate::fit::toys::{Toy, close, free, hash, positive, rough, stribeck_toy, total};

/// SciPy 1.16, all five parameters at once: `least_squares(lambda p: model(p) - y, truth, x_scale='jac', ftol=1e-15, xtol=1e-15,
/// gtol=1e-15)` with the model of `stribeck` and the noise above. Tolerance: half of the descent's last relative change of cost,
/// 1e-8, moves a parameter by 1e-4 of its standard error (0.13 of `stribeck_speed`'s value) at most.
#[test]
fn least_squares_as_scipy() {
    let toy = stribeck_toy(&rough(), 1.0);
    let settings = FitSettings {
        robust: false,
        ..FitSettings::default()
    };
    let fit = fit(&toy, &settings).unwrap();
    close(&fit.nonlinear, &[3.04965353, 0.68500143], 2e-5);
    close(&fit.linear, &[2.05563207, 0.13640255, -0.06722383], 2e-5);
    let cost: f64 = fit.residual.iter().map(|r| r * r).sum();
    close(&[cost], &[161.3269151414671], 1e-9);
}

/// The same with `loss='soft_l1'` and `f_scale = 1.5 * 1.4826 * median(abs(residual))`, repeated until it stands. Weights that stand
/// to 2e-3 leave a few thousandths of a standard error.
#[test]
fn soft_l1_as_scipy() {
    let toy = stribeck_toy(&rough(), 1.0);
    let fit = fit(&toy, &FitSettings::default()).unwrap();
    close(&fit.nonlinear, &[3.02649591, 0.69198548], 1e-3);
    close(&fit.linear, &[2.06469426, 0.13397781, -0.09629579], 1e-3);
    assert!(fit.weights.iter().step_by(97).all(|weight| *weight < 0.15));
}

/// Four springs in parallel that slip at `limit / 4` each, after `2 travel f^exponent`, f = 1/8, 3/8, 5/8, 7/8. SciPy: all five
/// parameters at once, from the truth, `least_squares(..., x_scale='jac', jac='3-point', diff_step=1e-4, ftol=1e-15, xtol=1e-15,
/// gtol=1e-15)`. The model has kinks where springs begin to slip, so that differences of 1e-3 and of 1e-4 end at points that differ
/// by parts of the standard errors, which are 0.2 to 0.8 % here: half of 0.2 % is allowed.
#[test]
fn maxwell_slip_as_scipy() {
    let path: Vec<f64> = (0..2000)
        .map(|k| {
            let t = 0.01 * f64::from(k);
            (1.1 * t).sin() + 0.4 * (3.7 * t).sin() + 0.02 * t
        })
        .collect();
    let model = {
        let path = path.clone();
        move |q: &[f64]| {
            let bounds = [0.125f64, 0.375, 0.625, 0.875].map(|f| 2.0 * q[1] * f.powf(q[2]));
            let mut springs = [0.0f64; 4];
            let mut before = path[0];
            let force = |x: &f64| {
                for (spring, bound) in springs.iter_mut().zip(bounds) {
                    *spring = (*spring + x - before).clamp(-bound, bound);
                }
                before = *x;
                springs
                    .iter()
                    .zip(bounds)
                    .map(|(spring, bound)| 0.25 * q[0] * spring / bound)
                    .sum()
            };
            Evaluation {
                fixed: path.iter().map(force).collect(),
                columns: vec![path.clone(), vec![1.0; 2000]],
            }
        }
    };
    let clean = total(&model(&[2.0, 0.15, 1.5]), &[0.3, -0.2]);
    let toy = Toy {
        nonlinear: vec![
            positive("limit", 1.0, 0.1, 20.0),
            positive("travel", 0.05, 0.01, 1.0),
            positive("exponent", 1.0, 0.3, 4.0),
        ],
        linear: vec![free("stiffness"), free("offset")],
        target: clean
            .iter()
            .enumerate()
            .map(|(k, value)| value + 0.3 * hash(k))
            .collect(),
        model,
    };
    let fit = fit(
        &toy,
        &FitSettings {
            robust: false,
            ..FitSettings::default()
        },
    )
    .unwrap();
    close(&fit.nonlinear, &[2.00336167, 0.1502813, 1.49906843], 1e-3);
    close(&fit.linear, &[0.29626745, -0.19795366], 3e-3);
    assert!(matches!(fit.verdict, Verdict::Agreed(_)));
}
