//! Contact load, contact angle and contact ellipse of the screw that Alberdi et al. analyse.
//!
//! Only what the paper's figures need: a single-arc groove with two-point contact, every ball under the same load.

use super::input::{KinematicsInput, Raceway};
use super::revised::Revised;
use ellip::{ellipe, ellipk};
use roots::{SimpleConvergency, find_root_brent};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Diameter of the ball, m (Table 2).
pub const BALL_DIAMETER: f64 = 7.94e-3;
/// Radius of the ball centres' helix, m.
pub const PITCH_RADIUS: f64 = 19.25e-3;
/// Radius of both grooves, m.
pub const GROOVE_RADIUS: f64 = 4.2e-3;
/// Nominal contact angle, rad.
pub const NOMINAL_CONTACT_ANGLE: f64 = 40.0 * PI / 180.0;
/// Lead angle, rad.
pub const LEAD_ANGLE: f64 = 10.0 * PI / 180.0;
/// Number of balls.
pub const BALLS: u32 = 15;
/// Young's modulus of both bodies, Pa.
pub const YOUNGS_MODULUS: f64 = 210e9;
/// Poisson's ratio of both bodies.
pub const POISSON_RATIO: f64 = 0.3;
/// Density of the ball, kg/m^3.
pub const DENSITY: f64 = 7850.0;
/// Contact load that the paper states for 1500 N axial load, N.
pub const CONTACT_LOAD: f64 = 151.0;
/// Contact angle that the paper states for 1500 N axial load, rad.
pub const CONTACT_ANGLE: f64 = 41.0 * PI / 180.0;
/// 1000 revolutions a minute, rad/s.
pub const SPEED: f64 = 1000.0 * TAU / 60.0;

/// Semi-axes of a contact ellipse and the load's constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// `a_H`, across the path, m.
    pub semi_major: f64,
    /// `b_H`, along the path, m.
    pub semi_minor: f64,
    /// Approach of the bodies, m.
    pub deflection: f64,
}

/// Contact ellipse of the ball on one raceway of the screw of Table 2, exact Hertz: (4) to (10) with
/// the ellipticity `k` from its transcendental equation
/// `R_y / R_x = (k^2 E - K) / (K - E)`, `m = 1 - 1/k^2`. **Corrected:** below (8) `r_nut,y = -r_o`, printed without its sign.
///
/// `cos_squared` is `cos^2 psi` for the curvature of the helical groove, (9) and (10), and 1 for that of a bearing's ring, which the
/// traditional formulation takes. `None` for a load that is not positive.
pub fn ellipse(
    raceway: Raceway,
    contact_angle: f64,
    cos_squared: f64,
    load: f64,
) -> Option<Ellipse> {
    if !(load > 0.0 && load.is_finite()) {
        return None;
    }
    let ball = 2.0 / BALL_DIAMETER;
    // (9), (10) as curvature, finite for a contact angle of 90 degrees.
    let step = raceway.sign() * contact_angle.cos() * cos_squared;
    let across = step / (PITCH_RADIUS - GROOVE_RADIUS * step);
    let rolling = ball + across;
    let groove = ball - 1.0 / GROOVE_RADIUS;
    let ratio = rolling / groove;
    let integrals = |k: f64| {
        let m = 1.0 - 1.0 / (k * k);
        Some((ellipk(m).ok()?, ellipe(m).ok()?))
    };
    let mut convergency = SimpleConvergency {
        eps: 1e-15,
        max_iter: 200,
    };
    let k = find_root_brent(
        1.0001,
        1000.0,
        |k: f64| {
            integrals(k).map_or(f64::NAN, |(first, second)| {
                (k * k * second - first) - ratio * (first - second)
            })
        },
        &mut convergency,
    )
    .ok()?;
    let (first, second) = integrals(k)?;
    let radius = 1.0 / (rolling + groove);
    let modulus = YOUNGS_MODULUS / (1.0 - POISSON_RATIO * POISSON_RATIO);
    let semi_major = (6.0 * k * k * second * load * radius / (PI * modulus)).cbrt();
    let semi_minor = semi_major / k;
    // delta = 3 W K / (2 pi a) (1 - nu^2) 2 / E with E' = E / (1 - nu^2).
    let deflection = 3.0 * load * first / (PI * modulus * semi_major);
    Some(Ellipse {
        semi_major,
        semi_minor,
        deflection,
    })
}

/// The screw of Table 2 at another lead angle, under the paper's load and contact angle (1500 N,
/// 1000 rpm), pitch angle 40°, yaw 0, rolling radii `D/2`.
///
/// `helical_curvature`: the groove's curvature of the revised (true) or traditional formulation.
pub fn case_one(lead_angle: f64, helical_curvature: bool) -> Option<KinematicsInput> {
    let cos_squared = if helical_curvature {
        lead_angle.cos().powi(2)
    } else {
        1.0
    };
    with_contacts(
        lead_angle,
        cos_squared,
        SPEED,
        [CONTACT_ANGLE; 2],
        [CONTACT_LOAD; 2],
    )
}

/// The screw of Table 2 as the paper analyses it.
pub fn table_two() -> Option<KinematicsInput> {
    case_one(LEAD_ANGLE, true)
}

fn with_contacts(
    lead_angle: f64,
    cos_squared: f64,
    speed: f64,
    contact_angles: [f64; 2],
    loads: [f64; 2],
) -> Option<KinematicsInput> {
    let screw = ellipse(Raceway::Screw, contact_angles[0], cos_squared, loads[0])?;
    let nut = ellipse(Raceway::Nut, contact_angles[1], cos_squared, loads[1])?;
    Some(KinematicsInput {
        ball_diameter: BALL_DIAMETER,
        pitch_radius: PITCH_RADIUS,
        lead_angle,
        groove_radius_screw: GROOVE_RADIUS,
        groove_radius_nut: GROOVE_RADIUS,
        contact_angle_screw: contact_angles[0],
        contact_angle_nut: contact_angles[1],
        pitch_angle: NOMINAL_CONTACT_ANGLE,
        yaw_angle: 0.0,
        rolling_radius_screw: 0.5 * BALL_DIAMETER,
        rolling_radius_nut: 0.5 * BALL_DIAMETER,
        speed,
        semi_major_screw: screw.semi_major,
        semi_minor_screw: screw.semi_minor,
        semi_major_nut: nut.semi_major,
        semi_minor_nut: nut.semi_minor,
    })
}

/// The screw of Table 2 under an axial load at a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedBall {
    /// Geometry, contact angles, ellipses.
    pub input: KinematicsInput,
    /// Normal load at the screw, N.
    pub load_screw: f64,
    /// Normal load at the nut, N.
    pub load_nut: f64,
}

/// Contact loads and angles under an axial load (N) at a speed (rad/s): equilibrium of the ball in the plane of normal and binormal, `W_k
/// sin alpha_k = F / (Z cos psi)` at both contacts and `W_o cos alpha_o - W_i cos alpha_i` equal to the centrifugal force, with the radial
/// distance of the groove centres unchanged by the deflections. The gyroscopic moment is left out. `None` where no equilibrium is found.
///
/// At 1500 N and 1000 rpm: 41.0° and 154.7 N; with `F / Z` in place of `F / (Z cos psi)`, 152.4 N. The paper's 151 N is neither.
pub fn loaded_ball(axial_load: f64, speed: f64) -> Option<LoadedBall> {
    let cos_psi = LEAD_ANGLE.cos();
    let share = axial_load / (f64::from(BALLS) * cos_psi);
    let nominal = table_two()?;
    let orbital_speed = Revised::new(&nominal).ok()?.orbital_ratio() * speed;
    let mass = DENSITY * PI / 6.0 * BALL_DIAMETER.powi(3);
    let centrifugal = mass * PITCH_RADIUS * orbital_speed * orbital_speed;
    let arm = GROOVE_RADIUS - 0.5 * BALL_DIAMETER;

    let angles = |screw: f64| {
        // W cos alpha = share cot alpha.
        let cotangent = 1.0 / screw.tan() + centrifugal / share;
        [screw, (1.0 / cotangent).atan()]
    };
    let radial_distance = |screw: f64| -> Option<f64> {
        let mut sum = 0.0;
        for (raceway, angle) in Raceway::BOTH.into_iter().zip(angles(screw)) {
            let load = share / angle.sin();
            let deflection = ellipse(raceway, angle, cos_psi * cos_psi, load)?.deflection;
            sum += (arm + deflection) * angle.cos();
        }
        Some(sum)
    };
    let target = 2.0 * arm * NOMINAL_CONTACT_ANGLE.cos();
    let mut convergency = SimpleConvergency {
        eps: 1e-13,
        max_iter: 100,
    };
    let screw = find_root_brent(
        0.2,
        FRAC_PI_2 - 0.05,
        |angle: f64| radial_distance(angle).map_or(f64::NAN, |distance| distance - target),
        &mut convergency,
    )
    .ok()?;
    let angles = angles(screw);
    let loads = angles.map(|angle| share / angle.sin());
    Some(LoadedBall {
        input: with_contacts(LEAD_ANGLE, cos_psi * cos_psi, speed, angles, loads)?,
        load_screw: loads[0],
        load_nut: loads[1],
    })
}
