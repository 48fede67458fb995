//! Studies behind the figures: efficiency over lead and load, what decides a screw's friction, and the choice of usual parameters.

use super::catalogue;
use super::figure::{Size, Usual};
use epas_reference::design::BallScrewDesign;
use epas_reference::efficiency::Screw;
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::{LoadedScrew, ScrewFriction};
use epas_reference::friction::rolling_resistance::RollingResistance;
use rayon::prelude::*;

const fn size(name: &'static str, [diameter, lead, ball]: [f64; 3], conformity: f64) -> Size {
    Size {
        name,
        diameter,
        lead,
        ball,
        conformity,
        balls: 50.0,
    }
}

pub const SCREWS: [Size; 10] = [
    size("125x10", [125.0, 10.0, 7.144], 0.528),
    size("29x7", [29.0, 7.0, 4.0], 0.54),
    size("33x20", [33.0, 20.0, 5.556], 0.56),
    size("32x6", [32.0, 6.0, 4.762], 0.528),
    size("32x8", [32.0, 8.0, 4.762], 0.528),
    size("32x10", [32.0, 10.0, 4.762], 0.528),
    size("32x16", [32.0, 16.0, 4.762], 0.528),
    size("32x20", [32.0, 20.0, 4.762], 0.528),
    size("32x32", [32.0, 32.0, 4.762], 0.528),
    size("32x64", [32.0, 64.0, 4.762], 0.528),
];

/// Axial loads of a ball, N.
pub const BALL_LOADS: [f64; 3] = [30.0, 100.0, 300.0];

/// Load at which parameters are sought that meet the catalogue's rule, N a ball.
pub const FIT_LOAD: f64 = 100.0;

fn closed(design: &BallScrewDesign, friction: f64) -> Screw {
    Screw {
        lead_angle: design.lead_angle(),
        contact_angle: design.contact_angle,
        friction,
        ball_ratio: design.ball_radius / design.pitch_radius,
        rolling_tangent: 0.0,
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct EfficiencyRow {
    pub size: Size,
    /// Axial load of a ball, N.
    pub ball_load: f64,
    pub exact: Result<ScrewFriction, ReferenceError>,
    /// Rolling ball, eq. (3) of Lin, Velinsky, Ravani 1994, same friction coefficient.
    pub rolling: f64,
    /// Sliding ball, eq. (14) there.
    pub sliding: f64,
    /// Maker's rule in theory.
    pub rule: f64,
    /// Friction coefficient at which the exact model meets the rule; at [`FIT_LOAD`] only.
    pub friction_for_rule: Option<f64>,
    /// Clearance at which it does, m.
    pub clearance_for_rule: Option<f64>,
}

impl EfficiencyRow {
    pub fn torque_over_diameter(&self) -> f64 {
        self.exact.as_ref().map_or(f64::NAN, |friction| {
            friction.torque() / (self.size.balls * self.ball_load * 1e-3 * self.size.diameter)
        })
    }
}

/// Efficiency over lead and load. `step` is called [`SCREWS`] times [`BALL_LOADS`].
pub fn efficiency_over_lead(usual: &Usual, step: &(dyn Fn() + Sync)) -> Vec<EfficiencyRow> {
    let cases: Vec<_> = SCREWS
        .iter()
        .flat_map(|size| BALL_LOADS.map(|load| (*size, load)))
        .collect();
    cases
        .par_iter()
        .map(|&(size, ball_load)| {
            let screw = size.under(size.balls * ball_load, usual);
            let design = screw.design;
            let closed = closed(&design, usual.friction);
            let rule = catalogue::efficiency(size.diameter, size.lead);
            let fitted = ball_load == FIT_LOAD;
            let target =
                screw.axial_load * design.lead / std::f64::consts::TAU * (1.0 / rule - 1.0);
            let row = EfficiencyRow {
                size,
                ball_load,
                exact: screw.solve(),
                rolling: closed.rolling_screw(),
                sliding: closed.sliding_drive(),
                rule,
                friction_for_rule: fitted
                    .then(|| screw.friction_for(target, |screw| Ok(screw.solve()?.torque())))
                    .flatten(),
                clearance_for_rule: fitted.then(|| screw.clearance_for(target)).flatten(),
            };
            step();
            row
        })
        .collect()
}

/// The ball screw of Table 3.6 of Lin 2019.
pub const TABLE_3_6: Size = Size {
    balls: 37.0,
    ..size("33x20, 37 balls", [33.0, 20.0, 5.556], 0.56)
};

pub const CLEARANCES: [f64; 9] = [-5.0, -2.0, -1.0, 0.0, 1.0, 2.0, 5.0, 10.0, 20.0];

pub const FRICTIONS: [f64; 6] = [0.03, 0.05, 0.075, 0.1, 0.125, 0.15];

/// Axial loads, N.
pub const LOADS: [f64; 2] = [1500.0, 14500.0];

/// Friction of one screw under one load with one friction coefficient, over [`CLEARANCES`].
#[derive(Clone, Debug, PartialEq)]
pub struct DecidingRow {
    /// Axial load, N.
    pub load: f64,
    pub friction: f64,
    /// Torque of sliding and spinning at each clearance, N m; NaN where the exact model has no answer.
    pub torques: Vec<f64>,
    /// Torque by eq. (3) of Lin, Velinsky, Ravani 1994, which leaves out spin and third contacts.
    pub closed: f64,
}

/// Friction torque of [`TABLE_3_6`] over load, friction coefficient and clearance. `step` is called [`LOADS`] times
/// [`FRICTIONS`] times [`CLEARANCES`].
pub fn what_decides(step: &(dyn Fn() + Sync)) -> Vec<DecidingRow> {
    let rows: Vec<(f64, f64)> = LOADS
        .iter()
        .flat_map(|load| FRICTIONS.map(|friction| (*load, friction)))
        .collect();
    let screws: Vec<LoadedScrew> = rows
        .iter()
        .flat_map(|&(load, friction)| {
            CLEARANCES.map(|clearance| {
                let usual = Usual {
                    friction,
                    clearance: 1e-6 * clearance,
                    rolling: RollingResistance::NONE,
                };
                TABLE_3_6.under(load, &usual)
            })
        })
        .collect();
    let solved = LoadedScrew::solve_all(&screws, step);
    rows.iter()
        .zip(solved.chunks(CLEARANCES.len()))
        .map(|(&(load, friction), solved)| {
            let design = TABLE_3_6.design();
            let closed = closed(&design, friction);
            DecidingRow {
                load,
                friction,
                torques: solved
                    .iter()
                    .map(|friction| friction.as_ref().map_or(f64::NAN, |found| found.sliding))
                    .collect(),
                closed: load * design.lead / std::f64::consts::TAU
                    * (1.0 / closed.rolling_screw() - 1.0),
            }
        })
        .collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    pub friction: f64,
    pub clearance: f64,
    /// Geometric mean over screws and loads of the friction torque over that of the rule of efficiency in theory.
    pub over_rule: f64,
    /// Factor by which one screw and load is away from that mean (one standard deviation of the logarithm).
    pub spread: f64,
    /// Geometric mean over screws of the drag torque of two braced nuts, whose balls just fit, over that of the rule of drag.
    pub over_drag: f64,
    pub gain_with_load: f64,
}

/// Screws of the choice: of leads from 0.08 to 0.6 of the diameter.
const CHOICE_SCREWS: [Size; 4] = [SCREWS[0], SCREWS[1], SCREWS[5], SCREWS[2]];

const CHOICE_LOADS: [f64; 3] = [15.0, 50.0, 150.0];

/// Friction coefficients and clearances, um, of the choice.
const CHOICES: ([f64; 4], [f64; 3]) = ([0.06, 0.08, 0.1, 0.125], [-2.0, -1.0, 0.0]);

pub const CHOICE_COUNT: usize = CHOICES.0.len() * CHOICES.1.len();

/// Choices of friction coefficient and clearance. `step` is called [`CHOICE_COUNT`] times.
pub fn choices(usual: &Usual, step: &(dyn Fn() + Sync)) -> Vec<Choice> {
    let (frictions, clearances) = CHOICES;
    let cases: Vec<Usual> = frictions
        .iter()
        .flat_map(|friction| {
            clearances.map(|clearance| Usual {
                friction: *friction,
                clearance: 1e-6 * clearance,
                ..*usual
            })
        })
        .collect();
    cases
        .par_iter()
        .map(|case| {
            let choice = choice(case);
            step();
            choice
        })
        .collect()
}

fn choice(usual: &Usual) -> Choice {
    let (mut ratios, mut drags, mut gains) = (Vec::new(), Vec::new(), Vec::new());
    for size in CHOICE_SCREWS {
        let rule = 1.0 / catalogue::efficiency(size.diameter, size.lead) - 1.0;
        let mut efficiencies = Vec::new();
        for load in CHOICE_LOADS {
            if let Ok(friction) = size.under(size.balls * load, usual).solve() {
                ratios.push((friction.torque() / (friction.ideal * rule)).ln());
                efficiencies.push(friction.efficiency());
            }
        }
        if let [first, .., last] = efficiencies.as_slice() {
            gains.push(last - first);
        }
        let preload = 25.0;
        let fitting = Usual {
            clearance: 0.0,
            ..*usual
        };
        let braced = size.under(size.balls * preload, &fitting);
        if let Ok(torque) = braced.double_nut_torque() {
            let unit = braced.axial_load * braced.design.lead / std::f64::consts::TAU;
            let rule = catalogue::drag_coefficient(size.diameter, size.lead);
            drags.push((torque / (unit * rule)).ln());
        }
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let middle = mean(&ratios);
    let squares: Vec<f64> = ratios
        .iter()
        .map(|ratio| (ratio - middle).powi(2))
        .collect();
    Choice {
        friction: usual.friction,
        clearance: usual.clearance,
        over_rule: middle.exp(),
        spread: mean(&squares).sqrt().exp(),
        over_drag: mean(&drags).exp(),
        gain_with_load: mean(&gains),
    }
}
