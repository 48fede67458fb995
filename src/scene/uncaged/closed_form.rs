//! The law of a ball by the papers' closed form, without a host: for a first look.

use super::FoldedBall;
use crate::ball::pressed::{
    BallKnot, BallLaw, BallNode, BallNumbers, KNOTS, Knot, NEIGHBOUR_KNOTS, NeighbourKnot,
    NeighbourNumbers, RUBBINGS,
};
use crate::ball::{Clearance, GrooveFit, LoadShare, ScrewRow, ScrewTick};
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::scene::contract::Limits;

/// Catalogue numbers of a ball screw without cage; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CatalogueBall {
    /// The validated design; contact angle 0.05 to 1.5 rad.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 1e-3 to 0.5.
    pub friction: f32,
    /// How balls fit between the grooves; play counts as none.
    pub clearance: Clearance,
    /// Largest deviations of the contact angles on the screw and in the nut, rad, 1e-6 to [`ScrewRow::largest_deviation`].
    pub deviations: [f32; 2],
    /// Largest axial load of one ball, N, 1 to 1e5.
    pub axial_load: f32,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

/// Least load of a ball that has a knot, over the largest.
const LEAST: f32 = 1e-3;

impl FoldedBall<1> {
    /// The law of a ball by the closed form [`ScrewRow`] at 32 loads, for those who have no host that folds.
    ///
    /// Speeds and torques follow deviations by a parabola through the closed form's at the middle and the ends of their range. Rolling
    /// resistance, and the change of a ball's speed by friction between balls, are left out.
    ///
    /// Accuracy against balls in elastic grooves, that of [`ScrewRow`]: torque up to a factor of 2 too large on the side of the load on which
    /// the third contact opens, some per cent on the other; forces between balls accordingly.
    ///
    /// Source: Lin 2019, eqs. (3.56) to (3.68), (3.73).
    pub const fn of_catalogue(ball: &CatalogueBall) -> Result<Self, Error> {
        let CatalogueBall {
            ref design,
            friction,
            clearance,
            deviations: [screw, nut],
            axial_load,
            reversal_speed,
            limits,
        } = *ball;
        attempt!(in_range("friction", friction, 1e-3, 0.5));
        let preload = attempt!(clearance.checked(design)).preload(design);
        let fit = if preload > 0.0 {
            GrooveFit::Preload {
                contact_force: preload,
            }
        } else {
            GrooveFit::Zero
        };
        let row = attempt!(ScrewRow::new(design, friction, fit));
        let largest = row.largest_deviation();
        attempt!(in_range("deviations", screw, 1e-6, largest));
        attempt!(in_range("deviations", nut, 1e-6, largest));
        attempt!(in_range("axial_load", axial_load, 1.0, 1e5));
        let lift_off = 2.828_427_1 * preload * design.axial_per_normal();
        let speed = design.path_radius() - row.nominal_speed();
        let branches = knots(&row, ball, lift_off, speed);
        let neighbours = neighbours(&row, axial_load, lift_off);
        Ok(Self {
            law: BallLaw {
                nodes: [BallNode {
                    friction,
                    branches,
                    neighbours,
                    unheld: [0; 2],
                }],
                deviations: [screw, nut],
                lift_off,
            },
            friction,
            lead: design.lead(),
            ball_radius: design.ball_radius(),
            path_radius: design.path_radius(),
            speed,
            reversal_speed,
            limits,
        })
    }
}

const fn knots(
    row: &ScrewRow,
    ball: &CatalogueBall,
    lift_off: f32,
    speed: f32,
) -> [[BallKnot; KNOTS]; 2] {
    let CatalogueBall {
        friction,
        deviations,
        axial_load,
        ..
    } = *ball;
    let mut branches = [[Knot::none(BallNumbers::NONE); KNOTS]; 2];
    let mut number = 0;
    while number < 2 * KNOTS {
        let (branch, knot) = (number / KNOTS, number % KNOTS);
        let load = knot_load(lift_off, axial_load, knot);
        let next = knot_load(lift_off, axial_load, knot + 1);
        let side = if branch == 0 { 1.0 } else { -1.0 };
        let tick = row.at(1.0, side * (load - lift_off));
        let next = if knot + 1 < KNOTS { next } else { load };
        let numbers = numbers(&tick, deviations, speed, 1.0 / (friction * load));
        branches[branch][knot] = Knot::between(load, next, numbers);
        number += 1;
    }
    branches
}

/// Load `W` of a knot, N: axial loads about in a geometric series, by their bits.
const fn knot_load(lift_off: f32, axial_load: f32, knot: usize) -> f32 {
    let [least, most] = [(LEAST * axial_load).to_bits(), axial_load.to_bits()];
    let bits = least + ((most - least) as u64 * knot as u64 / (KNOTS - 1) as u64) as u32;
    lift_off + f32::from_bits(bits)
}

const fn numbers(
    tick: &ScrewTick,
    [screw, nut]: [f32; 2],
    speed: f32,
    per_load: f32,
) -> BallNumbers {
    // Free speed, impedance and torque in one corner of the box.
    let mut at = [[[0.0; 3]; 3]; 3];
    let mut corner = 0;
    while corner < 9 {
        let (s, n) = (corner / 3, corner % 3);
        let deviations = [screw * (s as f32 - 1.0), nut * (n as f32 - 1.0)];
        let ball = tick.ball(deviations[0], deviations[1], &LoadShare::MEAN);
        let free = ball.speed_deviation / speed;
        let impedance = speed / ball.compliance * per_load;
        at[0][s][n] = free;
        at[1][s][n] = impedance;
        at[2][s][n] = ball.groove_torque * per_load;
        corner += 1;
    }
    let [u, u_s, u_n, u_ss, u_sn, u_nn] = parabola(&at[0]);
    let [z, z_screw, z_nut, ..] = parabola(&at[1]);
    BallNumbers {
        free: [u, u_s, u_n, u_ss, u_sn, u_nn, 0.0, 0.0, 0.0, 0.0],
        impedance: [z, z_screw, z_nut],
        torque: parabola(&at[2]),
        slope: 0.0,
        work: 1.0,
    }
}

/// Changes by neighbours under the least load and the largest, of both branches: the closed form knows only what is lost between balls.
const fn neighbours(
    row: &ScrewRow,
    axial_load: f32,
    lift_off: f32,
) -> [[NeighbourKnot; NEIGHBOUR_KNOTS]; 2] {
    let mut branches = [[Knot::none(NeighbourNumbers::NONE); NEIGHBOUR_KNOTS]; 2];
    let ends = [LEAST * axial_load, axial_load];
    let mut number = 0;
    while number < 2 * NEIGHBOUR_KNOTS {
        let (branch, knot) = (number / NEIGHBOUR_KNOTS, number % NEIGHBOUR_KNOTS);
        let load = ends[if knot == 0 { 0 } else { 1 }];
        let side = if branch == 0 { 1.0 } else { -1.0 };
        let rubbing = row.at(1.0, side * load).rubbing();
        let mut numbers = NeighbourNumbers::NONE;
        let mut node = 0;
        while node < RUBBINGS.len() {
            numbers.nodes[node].torque[0] = RUBBINGS[node] * rubbing;
            node += 1;
        }
        branches[branch][knot] = Knot::between(lift_off + load, lift_off + ends[1], numbers);
        number += 1;
    }
    branches
}

/// Coefficients of `1, s, n, s^2, s n, n^2` from values at -1, 0 and 1 of both.
const fn parabola(at: &[[f32; 3]; 3]) -> [f32; 6] {
    let middle = at[1][1];
    [
        middle,
        0.5 * (at[2][1] - at[0][1]),
        0.5 * (at[1][2] - at[1][0]),
        0.5 * (at[2][1] + at[0][1]) - middle,
        0.25 * (at[2][2] - at[2][0] - at[0][2] + at[0][0]),
        0.5 * (at[1][2] + at[1][0]) - middle,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DISSERTATION_DESIGNS, DeviationMap, FrictionModel, Inputs, LoadShares};
    use crate::{UncagedBallScrew, UncagedBallScrewConfiguration};

    const DESIGN: BallScrew = match BallScrew::new(DISSERTATION_DESIGNS[1].parameters) {
        Ok(design) => design,
        Err(_) => panic!("a field is out of range"),
    };

    const CATALOGUE_BALL: CatalogueBall = CatalogueBall {
        design: DESIGN,
        friction: 0.1,
        clearance: Clearance::ZERO,
        deviations: [0.02, 0.01],
        axial_load: 300.0,
        reversal_speed: 1e-3,
        limits: Limits {
            nut_speed: 100.0,
            axial_load: 20_000.0,
            friction_torque: 20.0,
        },
    };

    static BALL: FoldedBall = match FoldedBall::of_catalogue(&CATALOGUE_BALL) {
        Ok(ball) => ball,
        Err(_) => panic!("a field is out of range"),
    };

    /// Equal balls do not press, and lose what the row does: linear between knots 20 % apart, a torque that grows as the load's
    /// power of up to 4/3 is within `0.2^2/8 * 4/9` of that, 0.25 %; 32 loads from 0.3 N on.
    #[test]
    fn equal_balls_lose_what_the_row_does() {
        let mut model =
            FrictionModel::<UncagedBallScrew<37>>::new(&UncagedBallScrewConfiguration {
                folded: &BALL,
                ball_friction: 0.1,
                balls: 37,
                turns: 2.0,
                return_length: 0.0,
                screw_deviation: &DeviationMap::NONE,
                nut_deviation: &DeviationMap::NONE,
                load_shares: LoadShares::EVEN,
                tick: 1e-3,
            })
            .unwrap();
        let row = ScrewRow::new(&DESIGN, 0.1, GrooveFit::Zero).unwrap();
        for (nut_speed, axial_load) in
            [(10.0, 1850.0), (-10.0, 1850.0), (5.0, -8000.0), (3.0, 37.0)]
        {
            let found = model.step(Inputs {
                nut_speed,
                axial_load,
            });
            let ball = row
                .at(nut_speed, axial_load / 37.0)
                .ball(0.0, 0.0, &LoadShare::MEAN);
            let exact = 37.0 * ball.groove_torque;
            let error = found.friction_torque.abs() / exact - 1.0;
            assert!(error.abs() < 2.6e-3, "{nut_speed} {axial_load}: {error}");
            assert_eq!(found.largest_contact_force, 0.0);
            assert!(!found.faults.any(), "{:?}", found.faults);
        }
    }

    /// Numbers at the corners of the box are the closed form's; within it a parabola is.
    #[test]
    fn deviations_move_a_ball_as_in_the_row() {
        let row = ScrewRow::new(&DESIGN, 0.1, GrooveFit::Zero).unwrap();
        let speed = BALL.speed;
        for branch in [0, 1] {
            let knot = BALL.law.nodes[0].branches[branch][20];
            let side = if branch == 0 { 1.0 } else { -1.0 };
            let tick = row.at(1.0, side * knot.load);
            for (screw, nut) in [(1.0, 1.0), (-1.0, 1.0), (0.5, -0.7), (0.0, 1.0)] {
                let exact = tick.ball(0.02 * screw, 0.01 * nut, &LoadShare::MEAN);
                let found = knot.numbers.at([screw, nut]);
                let free = exact.speed_deviation / speed;
                // The series' terms beyond the second are its speed times the square of 0.03 rad.
                assert!((found.speed - free).abs() < 1e-3 * 0.03, "{found:?} {free}");
                let impedance = speed / exact.compliance / (0.1 * knot.load);
                assert!((found.impedance / impedance - 1.0).abs() < 2e-3);
            }
        }
    }

    #[test]
    fn what_no_catalogue_has_is_refused() {
        let refused = |change: fn(&mut CatalogueBall)| {
            let mut ball = CATALOGUE_BALL;
            change(&mut ball);
            FoldedBall::of_catalogue(&ball).unwrap_err().field()
        };
        assert_eq!(refused(|ball| ball.friction = 0.0), "friction");
        assert_eq!(refused(|ball| ball.deviations[1] = 0.5), "deviations");
        assert_eq!(refused(|ball| ball.axial_load = f32::NAN), "axial_load");
    }
}
