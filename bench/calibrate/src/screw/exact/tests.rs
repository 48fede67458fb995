//! The grid's law against the exact ball.

use epas_friction::Clearance;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::*;
use epas_design::files::DesignSource;

/// Largest axial load, N.
const LARGEST: f64 = 6000.0;

/// Relative errors of a grid's law, largest and rms, for another gap, a friction coefficient between nodes and more rolling resistance, at
/// random loads of both signs.
fn errors(caged: &CagedDesign, grid: &Grid, random: &mut Pcg64) -> [f64; 2] {
    let friction = random.random_range(0.03..0.15);
    let law = grid.law(caged, (friction, friction)).unwrap();
    let ball = caged.exact_ball(friction);
    let both = DirectionalCoefficient {
        forward: friction,
        backward: friction,
    };
    let mut found: Vec<f64> = Vec::new();
    for side in [1.0, -1.0] {
        let mut loads: Vec<f64> = (0..60)
            .map(|_| LARGEST / grid.balls * 0.01f64.powf(random.random()))
            .collect();
        loads.sort_by(|a, b| b.total_cmp(a));
        let loads: Vec<f64> = loads.iter().map(|load| side * load).collect();
        for (exact, load) in ball.along(&loads).unwrap().into_iter().zip(&loads) {
            let sliding = law.friction((load * grid.balls) as f32, both);
            let torque = f64::from(sliding.forward) / grid.balls;
            found.push((torque / exact.unwrap().torque - 1.0).abs());
        }
    }
    let largest = found.iter().copied().fold(0.0, f64::max);
    let squares: f64 = found.iter().map(|error| error * error).sum();
    [largest, (squares / found.len() as f64).sqrt()]
}

fn designs() -> impl Iterator<Item = CagedDesign> {
    ["lin-4.1", "25x5x3.175"].into_iter().map(|name| {
        let source: DesignSource = name.parse().unwrap();
        source.load().unwrap().caged
    })
}

/// A trace without a load needs the screw's friction under its preload alone, however large that is beside the largest load: 100 to
/// 1500 N a contact lift off at 200 to 3000 N a ball, where a grid for no load reaches to 64 N.
#[test]
fn a_preload_is_solved_without_a_load() {
    let design = designs().next().unwrap();
    for gap in [-3e-6, -9e-6, -18e-6] {
        let mut caged = design;
        caged.clearance = Clearance::new(gap).unwrap();
        let grid = Grid::of(&caged, 0.0, Spacing::COARSE).unwrap();
        let law = grid.law(&caged, (0.1, 0.1)).unwrap();
        let both = DirectionalCoefficient {
            forward: 0.1,
            backward: 0.1,
        };
        let found = f64::from(law.friction(0.0, both).forward) / grid.balls;
        let lift_off = grid.lift_off(gap.into());
        assert!(lift_off > LEAST_LARGEST, "{lift_off}");
        // The ball itself, from where one flank carries down to a thousandth of the lift-off load.
        let loads: Vec<f64> = (0..60)
            .map(|k| 3.0 * lift_off * 3e-4_f64.powf(f64::from(k) / 59.0))
            .collect();
        let ball = caged.exact_ball(0.1);
        let exact = ball.along(&loads).unwrap().pop().unwrap().unwrap().torque;
        // A grid of the search errs by some parts in a thousand, a thousandth of the load changes a thousandth of the torque.
        assert!((found / exact - 1.0).abs() < 1e-2, "{gap}: {found} {exact}");
    }
}

/// The law errs where a contact opens between two loads, two friction coefficients or two gaps. Measured over four seeds, with a preload
/// and its own gap, with a preload and another gap, and with play, the largest of both designs: fine 4.3e-3, 5.8e-3, 3.2e-3 (rms 4.1e-4,
/// 4.7e-4, 3.4e-4), coarse 1.7e-2, 1.8e-2, 6.1e-2 (rms 1.1e-3, 1.8e-3, 5.7e-3). The bounds leave room for other loads and coefficients.
#[test]
fn regression_of_the_grid_against_the_exact_ball() {
    for (spacing, [most, most_rms]) in [
        (Spacing::FINE, [3e-2, 3e-3]),
        (Spacing::COARSE, [0.15, 2e-2]),
    ] {
        let mut random = Pcg64::seed_from_u64(7);
        for design in designs() {
            let with = |gap: f32, hysteresis_loss: f32| {
                let mut caged = design;
                caged.clearance = Clearance::new(gap).unwrap();
                caged.rolling_resistance.hysteresis_loss = hysteresis_loss;
                caged
            };
            let own = design.rolling_resistance.hysteresis_loss;
            for (gap, others) in [(-1e-6, vec![-1e-6, -1.7e-6]), (4e-6, vec![4e-6])] {
                let grid = Grid::of(&with(gap, own), LARGEST, spacing).unwrap();
                for other in others {
                    for loss in [own, 0.05] {
                        let [largest, rms] = errors(&with(other, loss), &grid, &mut random);
                        println!("{spacing:?} {gap} {other} {loss}: {largest:.1e} {rms:.1e}");
                        assert!(largest < most && rms < most_rms, "{largest} {rms}");
                    }
                }
            }
        }
    }
}
