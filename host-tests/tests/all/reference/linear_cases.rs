//! The ball of the linear bearing of Lin 2019, Table 3.3, as the stored cases have it.

use std::f64::consts::FRAC_PI_4;

use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall, LinearMotion, contact_forces};

/// Grooves turned by these deviations, rad, under 100 N down and this part of it across; `Psi` with the five digits of the cases.
pub fn ball(deviations: [f64; 4], side_force_ratio: f64) -> LinearBall {
    let contact_angles = deviations.map(|d| FRAC_PI_4 + d);
    LinearBall {
        ball_radius: 0.005,
        friction: 0.1,
        contact_angles,
        contact_forces: contact_forces(contact_angles, 100.0 * side_force_ratio, 100.0),
        ellipse: EllipseLaw {
            semi_major_constant: 0.0005307 * 0.005_f64.cbrt(),
            axis_ratio: 0.23214637336606972,
        },
    }
}

pub fn tilted(theta_degrees: f64, side_force_ratio: f64) -> LinearBall {
    let theta = theta_degrees.to_radians();
    ball([-theta, theta, 0.0, 0.0], side_force_ratio)
}

/// Equations (3.29) to (3.31) of a ball on which nothing acts but its four contacts, N.
pub fn balance(ball: &LinearBall, motion: &LinearMotion) -> [f64; 3] {
    let [bl, br, tr, tl] = ball.contact_angles;
    let f = motion.contacts.map(|c| c.force);
    let m = motion.contacts.map(|c| -c.moment / ball.ball_radius);
    [
        f[0] + f[1] + f[2] + f[3],
        -bl.cos() * f[0] - br.cos() * f[1] + tr.cos() * f[2] + tl.cos() * f[3] + bl.sin() * m[0]
            - br.sin() * m[1]
            - tr.sin() * m[2]
            + tl.sin() * m[3],
        bl.sin() * f[0] - br.sin() * f[1] - tr.sin() * f[2]
            + tl.sin() * f[3]
            + bl.cos() * m[0]
            + br.cos() * m[1]
            - tr.cos() * m[2]
            - tl.cos() * m[3],
    ]
}
