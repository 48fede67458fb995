//! Every computable number of Lin, Velinsky, Ravani 1994.

use super::Computed;
use epas_reference::efficiency::{Screw, optimum_backdrive, optimum_drive};
use epas_reference::steady_state::BallScrewState;

/// The paper's ball screw: 2113 N on one ball at 2000 rpm, friction 0.075.
pub fn ball(lead_angle: f64, contact_angle: f64) -> BallScrewState {
    BallScrewState {
        lead_angle,
        contact_angle,
        friction: 0.075,
        ball_radius: 4.37e-3,
        pitch_radius: 24.3e-3,
        speed: 2000.0 * std::f64::consts::TAU / 60.0,
        axial_load: 2113.0,
        ball_density: 7800.0,
    }
}

pub fn closed(ball: &BallScrewState) -> Screw {
    Screw {
        lead_angle: ball.lead_angle,
        contact_angle: ball.contact_angle,
        friction: ball.friction,
        ball_ratio: ball.ball_radius / ball.pitch_radius,
        rolling_tangent: 0.0,
    }
}

/// Largest difference of eq. (14) from the exact steady state, percent, where it exists.
fn largest_difference(cases: impl Iterator<Item = (f64, f64)>) -> f64 {
    cases
        .filter_map(|(lead, contact)| {
            let ball = ball(lead.to_radians(), contact.to_radians());
            let exact = ball.solve().ok()?.efficiency;
            Some(100.0 * (closed(&ball).sliding_drive() - exact).abs())
        })
        .fold(0.0, f64::max)
}

pub(super) fn computed() -> Computed {
    let ten = 10_f64.to_radians();
    let screw = |contact: f64| closed(&ball(ten, contact));
    let optima = [
        optimum_drive(ten, 0.075).map(|contact| screw(contact).sliding_drive()),
        optimum_backdrive(ten, 0.075).map(|contact| screw(contact).sliding_backdrive()),
    ];
    vec![
        (
            "section on optimal efficiency",
            optima
                .map(|optimum| 100.0 * optimum.unwrap_or(f64::NAN))
                .into(),
        ),
        (
            "Figure 3",
            vec![
                largest_difference((8..=45).map(|lead| (f64::from(lead), 45.0))),
                largest_difference((20..=165).map(|contact| (10.0, 0.5 * f64::from(contact)))),
            ],
        ),
    ]
}
