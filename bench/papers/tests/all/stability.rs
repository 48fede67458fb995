//! Small disturbances of the steady state of Lin, Velinsky, Ravani 1994.

use epas_papers::stability::growth;
use epas_reference::steady_state::BallScrewState;

/// The share of unstable states over lead angle, contact angle and friction, at the screw, load and speed of Lin, Velinsky,
/// Ravani 1994; and the growth at their own case.
#[test]
fn full_sliding_is_unstable_nearly_everywhere() {
    let case = BallScrewState {
        lead_angle: 10f64.to_radians(),
        contact_angle: 45f64.to_radians(),
        friction: 0.075,
        ball_radius: 4.37e-3,
        pitch_radius: 24.3e-3,
        speed: 2000.0 * std::f64::consts::TAU / 60.0,
        axial_load: 2113.0,
        ball_density: 7800.0,
    };
    let found = growth(&case, &case.solve().unwrap()).unwrap();
    println!("{found:?}");
    // Half a unit of the last digit, here and below.
    assert!((found.rate - 5.6).abs() < 0.05, "{found:?}");
    assert!((found.frequency - 65.0).abs() < 0.5, "{found:?}");

    let (mut unstable, mut all) = (0, 0);
    for lead in (1..=12).map(|step| 3.5 * f64::from(step)) {
        for contact in [25.0_f64, 35.0, 45.0, 55.0, 65.0] {
            for friction in [0.01, 0.03, 0.075, 0.15, 0.3] {
                let state = BallScrewState {
                    lead_angle: lead.to_radians(),
                    contact_angle: contact.to_radians(),
                    friction,
                    ..case
                };
                if let Ok(steady) = state.solve() {
                    all += 1;
                    let found = growth(&state, &steady).unwrap();
                    unstable += usize::from(found.rate > 0.0);
                }
            }
        }
    }
    println!("{unstable} of {all} states are unstable");
    assert!(all > 150 && unstable * 10 > all * 8);
}
