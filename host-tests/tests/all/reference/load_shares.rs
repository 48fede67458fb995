//! Shares of the balls in the load: up to 300 N a ball, of both signs, and how many tables they take.

use crate::refusals::assert_refused;
use std::f64::consts::TAU;
use std::sync::Arc;

use epas_reference::ReferenceError;
use epas_reference::statics::cases::{CaseStudy, ScrewEnd};
use epas_reference::statics::shares::{LEAST_SHARE, loads_between};
use epas_reference::statics::surface::HarmonicError;
use epas_reference::statics::{
    Served, ShareError, ShareTable, ShareTables, StaticLoad, StaticSolution,
};

use epas_testkit::random::Random;

const TOLERANCE: ShareError = ShareError::TOLERANCE;

/// Table 3.6: 37 balls on two turns (Lin 2019, section 3.4.4), on the screw of Table 2.1.
fn table_3_6() -> CaseStudy {
    let case = CaseStudy::table_2_1();
    let mut geometry = case.geometry;
    geometry.groove_radius = 1.12 * geometry.ball_radius;
    CaseStudy {
        geometry,
        balls: 37,
        ball_spacing: 2.0 * TAU / 37.0,
        ..case
    }
}

fn screws() -> [(&'static str, CaseStudy); 3] {
    [
        ("2.1", CaseStudy::table_2_1()),
        ("3.6", table_3_6()),
        ("4.1", CaseStudy::table_4_1()),
    ]
}

/// An error of the screw: none, 5 um of pitch once a turn, 5 um of roundness twice a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Pitch,
    Roundness,
}

fn solve(
    case: &CaseStudy,
    axial_load: f64,
    fault: Fault,
) -> Result<StaticSolution, ReferenceError> {
    let mut setup = CaseStudy {
        axial_load,
        ..case.clone()
    }
    .setup()?;
    let error = match fault {
        Fault::None => None,
        Fault::Pitch => Some(HarmonicError::pitch(&case.geometry, 5e-6)),
        Fault::Roundness => Some(HarmonicError::roundness(5e-6)),
    };
    for surface in &mut setup.errors[..2] {
        surface.extend(error.map(|error| Arc::new(error) as _));
    }
    StaticLoad::new(setup)?.solve()
}

fn table(case: &CaseStudy, axial_load: f64) -> ShareTable {
    ShareTable::new(axial_load, &solve(case, axial_load, Fault::None).unwrap()).unwrap()
}

fn tables(case: &CaseStudy, smallest: f64, largest: f64, fault: Fault) -> Vec<ShareTable> {
    let balls = case.balls as f64;
    let loads = loads_between(smallest * balls, largest * balls).unwrap();
    ShareTable::of_loads(&loads, |load| solve(case, load, fault)).unwrap()
}

/// 9.6 kN on 32 balls, 11.1 kN on 37, 21.3 kN on 71, either way, with and without errors and preload. The nut takes
/// what the screw is loaded with: their difference is the residual (1e-11 of the largest force where the search
/// ends) times the number of nodes and balls that are free along the axis, below 200.
#[test]
fn three_hundred_newtons_a_ball_of_both_signs() {
    for (name, screw) in screws() {
        let balls = screw.balls as f64;
        for oversize in [-5e-6, 0.0, 5e-6] {
            let case = CaseStudy {
                ball_oversize: vec![oversize],
                ..screw.clone()
            };
            for fault in [Fault::None, Fault::Pitch, Fault::Roundness] {
                for of_a_ball in [5.0, -5.0, 50.0, -50.0, 300.0, -300.0] {
                    let load = of_a_ball * balls;
                    let what = format!("{name}, {oversize} m, {fault:?}, {load} N");
                    let solution = solve(&case, load, fault).unwrap();
                    assert!(solution.residual <= 2e-11, "{what}: {}", solution.residual);
                    let largest = solution
                        .forces
                        .iter()
                        .flatten()
                        .fold(0.0, |most: f64, force| most.max(*force));
                    let unbalanced = (solution.on_nut[2] - load).abs();
                    assert!(
                        unbalanced < 200.0 * 2e-11 * largest.max(load.abs()),
                        "{what}: {unbalanced} N"
                    );
                    // A push is carried by SL and NR, a pull by SR and NL.
                    let [left, right] = [0, 1]
                        .map(|flank| solution.forces.iter().map(|four| four[flank]).sum::<f64>());
                    assert_eq!(left > right, load > 0.0, "{what}: {left} {right}");
                    let table = ShareTable::new(load, &solution).unwrap();
                    let mean = table.shares.iter().sum::<f64>() / balls;
                    // Measured: 1.3e-15, roundings of up to 71 sums.
                    assert!((mean - 1.0).abs() < 4e-15, "{what}: {mean}");
                    assert!(table.positive().iter().all(|share| *share >= LEAST_SHARE));
                }
            }
        }
    }
}

/// Turned about an axis across, a screw pushed at its left end is a screw pulled at its right end, with its balls in
/// the opposite order: the same forces to the solver's rounding (measured: 8e-15).
#[test]
fn a_pull_at_one_end_mirrors_a_push_at_the_other() {
    for (name, case) in screws() {
        let mirrored = CaseStudy {
            loaded_end: ScrewEnd::Right,
            nut_position: case.screw_length - case.nut_position,
            first_azimuth: -(case.first_azimuth + (case.balls as f64 - 1.0) * case.ball_spacing),
            ..case.clone()
        };
        for of_a_ball in [1.0, 50.0, -50.0, 300.0] {
            let load = of_a_ball * case.balls as f64;
            let mut turned = table(&mirrored, -load);
            turned.shares.reverse();
            let error = table(&case, load).error_at(&turned).unwrap();
            assert!(
                error.groove_torque.abs() < 2.4e-14 && error.ball_load < 2.4e-14,
                "{name}: {error:?}"
            );
        }
    }
}

/// From 5 to 300 N a ball of both signs, the best table alone. A screw without errors: friction hardly
/// feels how the load is shared (measured: 0.2 %), single balls do (12 %). With 5 um of error it errs by 20 to 73 % of a
/// small load's friction, but by little of the largest load's: 1.2 % of friction and 10 % of the largest ball load.
#[test]
fn one_table_for_all_loads() {
    for (name, case) in screws() {
        for fault in [Fault::None, Fault::Pitch, Fault::Roundness] {
            let all = [
                tables(&case, 5.0, 300.0, fault),
                tables(&case, -5.0, -300.0, fault),
            ]
            .concat();
            let alone = Served::best_alone(&all, &TOLERANCE).unwrap().unwrap();
            assert!(alone.of_largest.groove_torque.abs() < 0.013);
            assert!(alone.of_largest.ball_load < 0.1);
            if fault == Fault::None {
                assert!(alone.worst.groove_torque.abs() < 0.0025, "{name}");
                assert!(alone.worst.ball_load < 0.13, "{name}");
            } else {
                assert!(!alone.serves(&TOLERANCE), "{name}");
                assert!(alone.worst.groove_torque.abs() > 0.1, "{name}");
            }
        }
    }
}

#[test]
fn ranges_follow_each_other() {
    for (name, case) in screws() {
        for (smallest, largest) in [(5.0, 300.0), (-5.0, -300.0)] {
            let all = tables(&case, smallest, largest, Fault::Roundness);
            let found = ShareTables::fewest(&all, &TOLERANCE).unwrap();
            assert!(found.served.len() > 5, "{name}: {}", found.served.len());
            let mut next = 0;
            let mut unserved = found.unserved.iter().peekable();
            let mut skip = |next: &mut usize| {
                while unserved
                    .next_if(|load| **load == all[*next].axial_load)
                    .is_some()
                {
                    *next += 1;
                }
            };
            for served in &found.served {
                skip(&mut next);
                assert_eq!(served.from, all[next].axial_load, "{name}");
                let mut worst = 0.0_f64;
                while next < all.len() && all[next].axial_load.abs() <= served.to.abs() {
                    let error = served.table.error_at(&all[next]).unwrap();
                    assert!(error.is_within(&TOLERANCE), "{name}: {error:?}");
                    worst = worst.max(error.ball_load);
                    next += 1;
                }
                assert_eq!(worst, served.worst.ball_load, "{name}");
                assert_eq!(all[next - 1].axial_load, served.to, "{name}");
            }
            skip(&mut next);
            assert_eq!(next, all.len(), "{name}");
        }
    }
}

/// Tables of two balls that differ from even shares by `lean`, under loads of 1 N, 2 N, ...
fn leaning(leans: &[f64]) -> Vec<ShareTable> {
    leans
        .iter()
        .enumerate()
        .map(|(index, lean)| ShareTable {
            axial_load: index as f64 + 1.0,
            shares: vec![1.0 + lean, 1.0 - lean],
        })
        .collect()
}

#[test]
fn no_fewer_tables_would_serve() {
    let mut random = Random(12);
    for _ in 0..300 {
        let leans: Vec<f64> = (0..9).map(|_| random.between(-0.1, 0.1)).collect();
        let all = leaning(&leans);
        let serves = |first: usize, last: usize| {
            all.iter().any(|table| {
                all[first..=last]
                    .iter()
                    .all(|load| table.error_at(load).unwrap().is_within(&TOLERANCE))
            })
        };
        let mut fewest = vec![0_usize];
        for last in 0..all.len() {
            let best = (0..=last)
                .filter(|first| serves(*first, last))
                .map(|first| fewest[first] + 1)
                .min();
            fewest.push(best.unwrap());
        }
        let found = ShareTables::fewest(&all, &TOLERANCE).unwrap();
        assert_eq!(found.served.len(), fewest[all.len()], "{leans:?}");
    }
}

#[test]
fn balls_that_push_against_the_load() {
    let all = [
        ShareTable {
            axial_load: 10.0,
            shares: vec![2.5, 1.0, -0.5],
        },
        ShareTable {
            axial_load: 20.0,
            shares: vec![1.2, 1.0, 0.8],
        },
    ];
    assert_eq!(all[0].idle(), 1);
    let found = ShareTables::fewest(&all, &TOLERANCE).unwrap();
    assert_eq!(found.unserved, [10.0]);
    assert_eq!(found.served.len(), 1);
    assert_eq!((found.served[0].from, found.served[0].to), (20.0, 20.0));
    let positive = all[0].positive();
    assert!(positive.iter().all(|share| *share >= LEAST_SHARE));
    assert_eq!(all[0].range(&all, 10.0, &TOLERANCE).unwrap(), None);
    assert_eq!(
        all[1].range(&all, 20.0, &TOLERANCE).unwrap(),
        Some([20.0, 20.0])
    );
    assert_eq!(all[1].range(&all, 1.0, &TOLERANCE).unwrap(), None);
    assert_eq!(all[1].range(&[], 20.0, &TOLERANCE).unwrap(), None);
}

#[test]
fn loads_rise_by_a_tenth() {
    for (smallest, largest) in [(1.0, 1e4), (-7.0, -7.1), (3.0, -300.0), (1e-6, 1e8)] {
        let loads = loads_between(smallest, largest).unwrap();
        assert_eq!(loads[0], smallest.abs().copysign(largest));
        assert_eq!(loads.last(), Some(&largest));
        for pair in loads.windows(2) {
            let ratio = pair[1] / pair[0];
            assert!(ratio > 1.0 && ratio < 1.1 + 1e-12, "{ratio}");
        }
    }
    assert_eq!(loads_between(5.0, -5.0).unwrap(), [-5.0]);
}

#[test]
fn bad_input_names_its_field() {
    assert_refused(
        &(1.0, 2.0),
        |&(smallest, largest)| loads_between(smallest, largest),
        &[
            ("axial_load", |loads, v| loads.0 = v, &[0.0, 3.0]),
            ("axial_load", |loads, v| loads.1 = v, &[]),
        ],
    );
    let case = CaseStudy::table_2_1();
    let nothing = solve(&case, 0.0, Fault::None).unwrap();
    let field = |error: ReferenceError| error.field().unwrap().to_owned();
    assert_eq!(
        field(ShareTable::new(0.0, &nothing).unwrap_err()),
        "axial_load"
    );
    let refused = ShareTable::of_loads(&[100.0, f64::NAN], |load| solve(&case, load, Fault::None));
    assert_eq!(field(refused.unwrap_err()), "axial_load");

    let even = |axial_load: f64, balls: usize| ShareTable {
        axial_load,
        shares: vec![1.0; balls],
    };
    let fewest = |loads: &[ShareTable]| ShareTables::fewest(loads, &TOLERANCE);
    #[rustfmt::skip]
    assert_refused(
        &[even(1.0, 2), even(2.0, 2)],
        |loads| fewest(loads),
        &[
            ("axial_load", |loads, v| loads[0].axial_load = v, &[2.0, 3.0, -1.0, 0.0]),
            ("shares", |loads, _| loads[1].shares.push(1.0), &[]),
        ],
    );
    let uneven = [even(1.0, 2), even(2.0, 3)];
    for error in [
        Served::best_alone(&uneven, &TOLERANCE).unwrap_err(),
        uneven[0].error_at(&uneven[1]).unwrap_err(),
        uneven[0].range(&uneven, 1.0, &TOLERANCE).unwrap_err(),
    ] {
        assert_eq!(field(error), "shares");
    }
    assert_refused(
        &TOLERANCE,
        |tolerance| ShareTables::fewest(&[even(1.0, 2)], tolerance),
        &[
            ("tolerance", |t, v| t.groove_torque = v, &[0.0, -0.01, 1.5]),
            ("tolerance", |t, v| t.ball_load = v, &[0.0, -0.01, 1.5]),
        ],
    );
    assert_eq!(fewest(&[]).unwrap(), ShareTables::default());
    assert_eq!(Served::best_alone(&[], &TOLERANCE).unwrap(), None);
}
