//! Makers' rules, judged by friction torque: an efficiency of 0.98 where a rule has 0.99 is twice the friction.

use std::f64::consts::{SQRT_2, TAU};

use super::catalogue;
use super::figure::{Measured, Size, Source, Standing, Usual};
use super::rows::{PRELOADED, range, torque, widened};
use super::studies::{BALL_LOADS, FIT_LOAD, SCREWS};
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;

/// Every screw of [`SCREWS`] under every load of [`BALL_LOADS`]: above zero it opposes the nut (driving), below zero it drives it.
fn cases(usual: &Usual, direction: f64) -> impl Iterator<Item = (Size, LoadedScrew)> {
    SCREWS.iter().flat_map(move |size| {
        BALL_LOADS.map(|load| (*size, size.under(direction * load * size.balls, usual)))
    })
}

/// Computed numbers in words: from the least to the largest, about their geometric mean.
fn spread(values: &[f64]) -> String {
    let [low, high] = range(values.iter().copied());
    let mean = values.iter().map(|value| value.ln()).sum::<f64>() / values.len() as f64;
    format!("{low:.2} to {high:.2} (geometric mean {:.2})", mean.exp())
}

pub(super) fn chart(usual: &Usual) -> Result<Measured, ReferenceError> {
    let mut frictions = Vec::new();
    for (size, screw) in cases(usual, 1.0) {
        let angle = size.design().lead_angle();
        if (1.0..=9.0).contains(&angle.to_degrees()) {
            frictions.push(catalogue::chart_friction(
                angle,
                screw.solve()?.efficiency(),
            ));
        }
    }
    let found = range(frictions);
    Ok(Measured {
        what: "catalogue chart of efficiency over lead angles of 1 to 9 degrees, driving",
        figure: "that of a plain screw with friction 0.005 to 0.01, at most 98 %",
        source: Source::Seen("Rexroth"),
        computed: format!(
            "that of a plain screw with friction {:.4} to {:.4}, 30 to 300 N a ball",
            found[0], found[1]
        ),
        standing: Standing::of(found, widened(catalogue::CHART_FRICTION)),
        needed: "below the band lie heavy loads on small leads, where the third contact no longer holds the ball".into(),
    })
}

/// Friction torque of a screw by the rule of efficiency, N m: in theory, and in practice.
fn torques_by_rule(size: &Size, screw: &LoadedScrew) -> [f64; 2] {
    let ideal = screw.axial_load.abs() * screw.design.lead / TAU;
    let theory = catalogue::efficiency(size.diameter, size.lead);
    [theory, catalogue::PRACTICE * theory].map(|efficiency| ideal * (1.0 / efficiency - 1.0))
}

/// The rule of efficiency in one direction. Its efficiencies of driving, `T/(T + friction)`, and of back-driving, `1 - friction/T = 2 - 1/driving`,
/// mean one friction torque.
fn rule(
    usual: &Usual,
    direction: f64,
    words: [&'static str; 2],
) -> Result<Measured, ReferenceError> {
    let (mut shares, mut within, mut needed) = (Vec::new(), 0, Vec::new());
    for (size, screw) in cases(usual, direction) {
        let [theory, practice] = torques_by_rule(&size, &screw);
        let found = torque(&screw)?;
        shares.push(found / theory);
        let [least, _] = widened([theory; 2]);
        let [_, most] = widened([practice; 2]);
        within += usize::from((least..=most).contains(&found));
        if screw.axial_load.abs() == FIT_LOAD * size.balls {
            needed.extend(screw.friction_for(theory, torque));
        }
    }
    let [low, high] = range(needed);
    Ok(Measured {
        what: words[0],
        figure: words[1],
        source: Source::Recalled("SKF"),
        computed: format!(
            "{} of the rule's torque in theory; {within} of {} cases between theory and practice; ten screws, 30 to 300 N a ball",
            spread(&shares),
            shares.len()
        ),
        standing: if within == shares.len() {
            Standing::Within
        } else {
            Standing::Apart
        },
        needed: format!(
            "for the theory itself friction {low:.3} to {high:.3} at 100 N a ball; what practice has more is wipers, seals, return"
        ),
    })
}

pub(super) fn driving(usual: &Usual) -> Result<Measured, ReferenceError> {
    let words = [
        "catalogue rule of efficiency, as friction torque, driving",
        "2.86e-3 of load times diameter in theory: efficiency 1/(1 + 0.018 d0/lead); 0.9 of that efficiency in practice",
    ];
    rule(usual, 1.0, words)
}

pub(super) fn back_driving(usual: &Usual) -> Result<Measured, ReferenceError> {
    let words = [
        "catalogue rule of efficiency, as friction torque, back-driving",
        "the torque of driving: efficiency 2 - 1/(efficiency of driving)",
    ];
    rule(usual, -1.0, words)
}

/// Sizes of screws that are sold preloaded.
const SOLD: [[f64; 3]; 4] = [
    [25.0, 8.0, 4.762],
    [32.0, 10.0, 6.35],
    [40.0, 8.0, 6.35],
    [40.0, 10.0, 6.35],
];

/// Axial preloads of a ball, N. The default friction coefficient was fitted at the third.
const PRELOADS: [f64; 4] = [4.0, 10.0, 25.0, 100.0];

/// Preloaded screws with the rule's coefficient of each.
fn preloaded(usual: &Usual) -> impl Iterator<Item = (LoadedScrew, f64)> {
    let usual = Usual {
        clearance: 0.0,
        ..*usual
    };
    SOLD.iter().flat_map(move |&[diameter, lead, ball]| {
        let size = Size {
            diameter,
            lead,
            ball,
            ..PRELOADED
        };
        let rule = catalogue::drag_coefficient(diameter, lead);
        PRELOADS.map(|preload| (size.under(preload * size.balls, &usual), rule))
    })
}

/// `preload lead/2 pi`, N m.
fn unit(screw: &LoadedScrew) -> f64 {
    screw.axial_load * screw.design.lead / TAU
}

const DRAG_RULE: &str = "0.05 (tan lead angle)^-1/2 of preload lead/2 pi";

/// The cases of both rows of drag in words.
fn preloads() -> String {
    let [least, .., most] = PRELOADS.map(|preload| SQRT_2 * preload);
    format!("25x8, 32x10, 40x8, 40x10; {least:.0} to {most:.0} N a contact")
}

pub(super) fn drag_of_two_nuts(usual: &Usual) -> Result<Measured, ReferenceError> {
    let (mut shares, mut driven, mut fitted) = (Vec::new(), Vec::new(), Vec::new());
    for (screw, rule) in preloaded(usual) {
        let back = LoadedScrew {
            axial_load: -screw.axial_load,
            ..screw
        };
        let [driving, driven_nut] = [torque(&screw)?, torque(&back)?];
        let share = (driving + driven_nut) / (unit(&screw) * rule);
        shares.push(share);
        driven.push(driven_nut / (driving + driven_nut));
        if screw.axial_load == PRELOADS[2] * screw.balls {
            fitted.push(share);
        }
    }
    let ([low, high], [least, most]) = (range(driven), range(fitted));
    Ok(Measured {
        what: "catalogue rule of the drag of a preload, two braced nuts",
        figure: DRAG_RULE,
        source: Source::Recalled("JIS B 1192"),
        computed: format!(
            "{} of the rule; {low:.2} to {high:.2} of it in the nut that is driven, the rest in the nut that drives; {}",
            spread(&shares),
            preloads()
        ),
        standing: Standing::of(range(shares), widened([1.0, 1.0])),
        needed: format!(
            "a torque in proportion to the preload; {least:.2} to {most:.2} of the rule at 35 N a contact, to which the default of the friction coefficient was fitted, and to nothing else"
        ),
    })
}

pub(super) fn drag_of_oversize(usual: &Usual) -> Result<Measured, ReferenceError> {
    let mut shares = Vec::new();
    for (screw, rule) in preloaded(usual) {
        shares.push(torque(&screw.braced_by_oversize()?)? / (unit(&screw) * rule));
    }
    Ok(Measured {
        what: "catalogue rule of the drag of a preload, one nut with oversize balls, without load",
        figure: DRAG_RULE,
        source: Source::Recalled("JIS B 1192"),
        computed: format!("{} of the rule; {}", spread(&shares), preloads()),
        standing: Standing::of(range(shares), widened([1.0, 1.0])),
        needed: "the rule is of nuts, not of how they are preloaded; neither direction drives"
            .into(),
    })
}

pub(super) fn drag_range(usual: &Usual) -> Result<Measured, ReferenceError> {
    let mut coefficients = Vec::new();
    for (screw, _) in preloaded(usual) {
        coefficients.push(screw.double_nut_torque()? / unit(&screw));
    }
    let found = range(coefficients);
    Ok(Measured {
        what: "drag torque of two braced nuts over preload lead/2 pi",
        figure: "0.1 to 0.3",
        source: Source::Seen("two makers' manuals"),
        computed: format!("{:.3} to {:.3}; {}", found[0], found[1], preloads()),
        standing: Standing::of(found, widened(catalogue::DRAG_RANGE)),
        needed: "preloads of a few N a contact are outside the manuals".into(),
    })
}
