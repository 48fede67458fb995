use super::*;
use crate::fit::problem::Evaluation;
use crate::fit::separable::fit;
use crate::fit::toys::{Toy, free, noise, positive, stribeck_toy, total};
use crate::fit::uncertainty::uncertainty;

/// Of a linear parameter beside linear ones, the loss is a parabola to rounding: `(distance / standard error)^2`, in the logarithm of
/// the cost: `rate ln(1 + x / rate)`, which differs from x by x^2 / (2 rate), here below 2 %.
#[test]
fn linear_parameters_have_parabolas() {
    let rows = 2000;
    let columns = vec![
        vec![1.0; rows],
        (0..rows)
            .map(|k| (0.01 * k as f64).sin())
            .collect::<Vec<f64>>(),
    ];
    let target = noise(3, rows, 0.3)
        .iter()
        .zip(&columns[1])
        .map(|(noise, x)| 2.0 + 3.0 * x + noise)
        .collect();
    let model = move |_: &[f64]| Evaluation {
        fixed: vec![0.0; rows],
        columns: columns.clone(),
    };
    let toy = Toy {
        nonlinear: vec![],
        linear: vec![free("mean"), free("wave")],
        target,
        model,
    };
    let settings = FitSettings::default();
    let found = fit(&toy, &settings).unwrap();
    let sure = uncertainty(&toy, &found);
    let profile = profile(&toy, &found, &sure, "wave", &settings).unwrap();
    let interval = &sure.intervals[1];
    assert!(profile.parabolic);
    for point in &profile.points {
        let wanted = ((point.value - interval.value) / interval.standard_error).powi(2);
        assert!(
            (point.loss - wanted).abs() <= 0.02 * wanted + 1e-9,
            "{} {wanted}",
            point.loss
        );
    }
    assert!((profile.high - interval.high).abs() < 0.02 * interval.half_width);
    assert!((profile.low - interval.low).abs() < 0.02 * interval.half_width);
}

/// Where the trace tells a parameter well, profile and covariance agree.
#[test]
fn told_well() {
    let toy = stribeck_toy(&noise(1, 3000, 0.5), 0.1);
    let settings = FitSettings::default();
    let found = fit(&toy, &settings).unwrap();
    let sure = uncertainty(&toy, &found);
    let profile = profile(&toy, &found, &sure, "static", &settings).unwrap();
    assert!(profile.parabolic, "{profile:?} {:?}", sure.intervals[0]);
    assert!(profile.points.iter().all(|point| point.loss > -0.1));
    assert!(profile.evaluations < 200, "{}", profile.evaluations);
}

/// A rate seen over one decay in much noise, with free rest: a slow decay cannot be told from none, a fast one can. The profile is open to the low
/// side, closed to the high one, and not a parabola.
#[test]
fn open_to_one_side() {
    let model = |q: &[f64]| Evaluation {
        fixed: vec![0.0; 1000],
        columns: vec![
            (0..1000)
                .map(|row| (-q[0] * f64::from(row) * 1e-3).exp())
                .collect(),
            vec![1.0; 1000],
        ],
    };
    let clean = total(&model(&[1.0]), &[1.0, 0.0]);
    let toy = Toy {
        nonlinear: vec![positive("rate", 1.0, 0.01, 100.0)],
        linear: vec![free("size"), free("rest")],
        target: clean
            .iter()
            .zip(noise(4, 1000, 0.0))
            .map(|(value, noise)| value + 0.5 * noise)
            .collect(),
        model,
    };
    let settings = FitSettings::default();
    let found = fit(&toy, &settings).unwrap();
    let sure = uncertainty(&toy, &found);
    let profile = profile(&toy, &found, &sure, "rate", &settings).unwrap();
    assert_eq!(profile.open, [true, false], "{profile:?}");
    assert!(!profile.parabolic);
    assert!(profile.high < 50.0);
}
