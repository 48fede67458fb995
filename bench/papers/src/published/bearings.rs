//! The computable numbers of Lin 2019 on rotary bearings: sections 3.2 and 4.3.1.

use super::Computed;
use crate::rotary_ball::{RotaryBearing, RotaryConvention, RotaryMotion};
use crate::rotary_bearing::{TurningLoad, variation};
use epas_reference::error::ReferenceError;

/// Radial displacement of the inner ring in the three cases of Table 3.2, m; not printed.
pub const DISPLACEMENTS: [f64; 3] = [0.0, 5.2e-6, 8.0e-6];

/// Speed of the inner ring of Table 3.2, rad/s.
pub const INNER_SPEED: f64 = 20.0 * std::f64::consts::PI;

pub fn table_3_1(convention: RotaryConvention) -> RotaryBearing {
    RotaryBearing {
        ball_radius: 6.25e-3,
        pitch_radius: 35e-3,
        conformity: 0.54,
        contact_angle: std::f64::consts::FRAC_PI_4,
        youngs_modulus: 2.1e11,
        poisson_ratio: 0.28,
        convention,
    }
}

/// Loads and motion of Table 3.2 at a radial displacement of the inner ring, m: 100 N axial, friction 0.1.
pub fn table_3_2(displacement: f64) -> Result<([f64; 4], RotaryMotion), ReferenceError> {
    let bearing = table_3_1(RotaryConvention::Dissertation);
    let contacts = bearing.contacts_under_load(100.0, displacement)?;
    let motion = bearing.motion_with_sigmoid(&contacts, 0.1, INNER_SPEED, 100.0)?;
    Ok((contacts.contact_forces, motion))
}

pub(super) fn computed() -> Result<Computed, ReferenceError> {
    let (mut sums, mut torques, mut table) = ([0.0; 3], [0.0; 3], Vec::new());
    for (case, displacement) in DISPLACEMENTS.into_iter().enumerate() {
        let (forces, motion) = table_3_2(displacement)?;
        let losses = motion.contacts.map(|contact| contact.power);
        sums[case] = forces.iter().sum();
        torques[case] = 1e3 * motion.friction_torque;
        table.extend(forces);
        table.push(sums[case]);
        table.extend(losses);
        table.extend([losses.iter().sum(), torques[case]]);
        table.extend([motion.orbital_speed, motion.omega_x, motion.omega_y]);
    }
    let growth = [1, 2].map(|case| 100.0 * (sums[case] / sums[0] - 1.0));
    let torque_growth = [1, 2].map(|case| torques[case] / torques[0] - 1.0);
    let points = TurningLoad::default().sweep(18)?;
    Ok(vec![
        ("Table 3.2", table),
        ("section 3.2.2", [growth, torque_growth].concat()),
        ("section 4.3.1 and Figure 4.7", vec![variation(&points)[0]]),
    ])
}
