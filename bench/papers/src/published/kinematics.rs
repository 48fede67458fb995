//! Every computable number that Alberdi et al. print, for the screw of their Table 2.

use super::Computed;
use crate::kinematics::{Traditional, figures, pitch_angle};
use epas_reference::error::ReferenceError;
use epas_reference::kinematics::operating::{self, CONTACT_LOAD};
use epas_reference::kinematics::{KinematicsInput, Raceway, Revised, yaw_without_side_slip};

pub(super) fn computed() -> Result<Computed, ReferenceError> {
    let revised = figures::case_one(operating::LEAD_ANGLE)?;
    let input = *revised.input();
    let ball = revised.evaluate();
    let traditional = Traditional::new(&revised);
    let entrainment = Raceway::BOTH.map(|raceway| {
        let [along, across] = traditional.entrainment(raceway);
        along.hypot(across)
    });
    let angles = [ball.screw, ball.nut].map(|contact| contact.entrainment_angle.to_degrees());
    // Slip at the centre of each contact by the traditional formulation over that by the revised one.
    let slip_ratios = Raceway::BOTH.map(|raceway| {
        let [x, y] = traditional.slip(raceway, 0.0, 0.0, traditional.distance(raceway));
        let contact = ball.contact(raceway);
        x.hypot(y) / contact.rolling_slip.hypot(contact.side_slip)
    });
    let degrees = |angle: Option<f64>| angle.unwrap_or(f64::NAN).to_degrees();
    let load = CONTACT_LOAD;
    let loaded = operating::loaded_ball(1500.0, operating::SPEED);
    let at = |yaw: f64| -> Result<_, ReferenceError> {
        let yaw_angle = yaw.to_radians();
        Ok(Revised::new(&KinematicsInput { yaw_angle, ..input })?.evaluate())
    };
    let smaller = Revised::new(&KinematicsInput {
        rolling_radius_screw: 3.95e-3,
        ..figures::case_two()?
    })?;
    let speeds = [ball.screw, ball.nut].map(|contact| contact.entrainment_speed);
    Ok(vec![
        (
            "section 4.1",
            [speeds, entrainment, angles, angles].concat(),
        ),
        ("section 4.2", vec![100.0 * ball.screw.slide_to_roll]),
        (
            "section 4.1, \"approximately three times\"",
            slip_ratios.into(),
        ),
        (
            "section 3",
            vec![
                pitch_angle::inner_raceway_control_printed(&input).to_degrees(),
                pitch_angle::outer_raceway_control_printed(&input).to_degrees(),
                degrees(pitch_angle::balanced_spin(&input, load, load)),
                degrees(loaded.as_ref().map(|ball| ball.input.contact_angle_screw)),
                loaded.map_or(f64::NAN, |ball| ball.load_screw),
            ],
        ),
        (
            "section 4.3.3",
            vec![
                degrees(pitch_angle::inner_raceway_control(&input)),
                degrees(pitch_angle::outer_raceway_control(&input)),
            ],
        ),
        (
            "Table 1",
            vec![pitch_angle::mean_contact_angle(&input).to_degrees()],
        ),
        (
            "section 5",
            vec![degrees(pitch_angle::d_alembert_printed(&input, load, load))],
        ),
        (
            "section 4.3.2",
            vec![
                yaw_without_side_slip(&input, Raceway::Nut)?.to_degrees(),
                yaw_without_side_slip(&input, Raceway::Screw)?.to_degrees(),
                100.0 * at(-3.0)?.nut.slide_to_roll,
                100.0 * at(3.0)?.nut.slide_to_roll,
                100.0 * at(-3.0)?.screw.slide_to_roll,
            ],
        ),
        (
            "section 4.3.1 and Figure 10",
            vec![degrees(smaller.evaluate().screw.slide_angle)],
        ),
        ("eq. (23)", vec![ball.spin_speed]),
    ])
}
