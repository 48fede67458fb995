//! Coverage of the intervals over drawn drives.

use rayon::prelude::*;

use super::choice::{Estimate, Wanted, estimate};
use super::drives::Drive;
use super::record::Record;
use super::terms::Term;

const TERMS: [Term; 6] = [
    Term::Inertia,
    Term::Viscous,
    Term::Offset,
    Term::Coulomb,
    Term::Driving,
    Term::BackDriving,
];

fn truth(drive: &Drive) -> [f64; 6] {
    let [driving, back_driving] = drive.losses;
    [
        drive.inertia,
        drive.viscous,
        drive.offset,
        drive.coulomb,
        driving,
        back_driving,
    ]
}

/// Of drives: how many intervals hold the truth, median half-widths over the truth (of offset and losses themselves).
fn coverage(
    count: u64,
    bits: u32,
    lag: Option<f64>,
    change: impl Fn(&mut Drive) + Sync,
) -> ([usize; 6], [f64; 6]) {
    let found: Vec<(Drive, Option<Estimate>)> = (0..count)
        .into_par_iter()
        .map(|seed| {
            let mut drive = Drive::drawn(seed);
            change(&mut drive);
            let trace = drive.trace(seed, 20.0, bits, lag);
            (
                drive,
                estimate(&[Record::of(&trace, &[])], &Wanted::default()),
            )
        })
        .collect();
    let (mut held, mut halves) = ([0; 6], [0.0; 6]);
    for (k, term) in TERMS.into_iter().enumerate() {
        let mut widths: Vec<f64> = Vec::new();
        for (drive, estimate) in &found {
            let truth = truth(drive)[k];
            let Some((value, half)) = estimate.as_ref().and_then(|e| e.of(term)) else {
                continue;
            };
            held[k] += usize::from((value - truth).abs() <= half);
            widths.push(if matches!(k, 0 | 1 | 3) {
                half / truth
            } else {
                half
            });
        }
        widths.sort_by(f64::total_cmp);
        halves[k] = widths.get(widths.len() / 2).copied().unwrap_or(f64::NAN);
    }
    (held, halves)
}

#[test]
#[ignore]
fn look() {
    let count = std::env::var("N").map_or(20, |n| n.parse().unwrap());
    for bits in [9, 10, 12, 14, 18] {
        for rests in [false, true] {
            let (held, halves) = coverage(count, bits, None, |drive| drive.rests = rests);
            println!(
                "{bits} {rests}: {held:?} {}",
                halves.map(|h| format!("{:.4}", 100.0 * h)).join(" ")
            );
        }
    }
    for hertz in [200.0, 50.0, 20.0] {
        for rests in [false, true] {
            let (held, halves) = coverage(
                count,
                14,
                Some(1.0 / (std::f64::consts::TAU * hertz)),
                |drive| drive.rests = rests,
            );
            println!(
                "{hertz} Hz {rests}: {held:?} {}",
                halves.map(|h| format!("{:.4}", 100.0 * h)).join(" ")
            );
        }
    }
}
