//! Every computable number of Lin, Velinsky, Ravani 1994.

use crate::record::{Page, Verdict};
use epas_reference::efficiency::{Screw, optimum_backdrive, optimum_drive};
use epas_reference::steady_state::BallScrewState;

/// The paper's ball screw: 2113 N on one ball at 2000 rpm, friction 0.075.
#[must_use]
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

/// The closed forms of the same ball screw.
#[must_use]
pub fn screw(lead_angle: f64, contact_angle: f64) -> Screw {
    let ball = ball(lead_angle, contact_angle);
    Screw {
        lead_angle,
        contact_angle,
        friction: ball.friction,
        ball_ratio: ball.ball_radius / ball.pitch_radius,
        rolling_tangent: 0.0,
    }
}

/// Largest difference of eq. (14) from the exact steady state, percent, where it exists.
fn largest_difference(cases: impl Iterator<Item = (f64, f64)>) -> f64 {
    cases
        .filter_map(|(lead, contact)| {
            let (lead, contact) = (lead.to_radians(), contact.to_radians());
            let exact = ball(lead, contact).solve().ok()?.efficiency;
            let closed = screw(lead, contact).sliding_drive();
            Some(100.0 * (closed - exact).abs())
        })
        .fold(0.0, f64::max)
}

/// Appends the records.
pub(super) fn append(page: &mut Page<'_>) {
    let ten = 10_f64.to_radians();
    for (name, optimum) in [
        (
            "optimal efficiency, driving",
            optimum_drive(ten, 0.075).map(|contact| screw(ten, contact).sliding_drive()),
        ),
        (
            "optimal efficiency, back-driving",
            optimum_backdrive(ten, 0.075).map(|contact| screw(ten, contact).sliding_backdrive()),
        ),
    ] {
        page.turn("section on optimal efficiency").add(
            name,
            "%",
            "86.1",
            100.0 * optimum.unwrap_or(f64::NAN),
            Verdict::Convention(
                "not for all helix angles: up to 42.9 degrees driving, 47.1 degrees back-driving; and of full sliding, which the \
                 ball does not keep up",
            ),
        );
    }
    page.turn("Figure 3").add(
        "largest difference of eq. (14) from the exact steady state over the helix angle",
        "%",
        "0.33",
        largest_difference((8..=45).map(|lead| (f64::from(lead), 45.0))),
        Verdict::NotReproducible(
            "the two agree 600 times better; no load or unit slip gives both printed differences",
        ),
    );
    page.turn("Figure 3").add(
        "largest difference of eq. (14) from the exact steady state over the contact angle",
        "%",
        "0.86",
        largest_difference((20..=165).map(|contact| (10.0, 0.5 * f64::from(contact)))),
        Verdict::NotReproducible(
            "the two agree 400 times better; a load divided by 386 (gravity in inches) would give 0.86 % here, but not 0.33 % there",
        ),
    );
}
