//! Requests at points of the maps. All numbers are such as f32 holds, so that the reference computes from the same.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use epas_eval::groove_curvature::Groove;
use epas_eval::{
    contact_kinematics, efficiency, friction_map, groove_curvature, hertz, linear_train,
    steady_state,
};

use crate::study::turned_ball;

/// A number as f32 holds it.
fn held(number: f64) -> f64 {
    f64::from(number as f32)
}

pub fn power(exponent: f64) -> f64 {
    10f64.powf(exponent)
}

/// A groove of 3.6 mm across on a pitch radius of 10 mm, all lengths times `scale`.
pub fn groove(
    groove: Groove,
    contact_degrees: f64,
    lead_degrees: f64,
    scale: f64,
) -> groove_curvature::Request {
    groove_curvature::Request {
        groove,
        pitch_radius: held(0.01 * scale),
        lead_angle: held(lead_degrees.to_radians()),
        contact_angle: held(contact_degrees.to_radians()),
        groove_radius: held(0.0018 * scale),
        offset_h: held(5e-5 * scale),
        offset_l: held(5e-5 * scale),
        ball_radius: None,
    }
}

/// A screw's groove around a ball, met at 45 degrees.
pub fn hugging(conformity: f64, ball_ratio: f64) -> groove_curvature::Request {
    let (pitch_radius, ball_radius) = (0.01, 0.01 * ball_ratio);
    let groove_radius = 2.0 * conformity * ball_radius;
    let offset = held((groove_radius - ball_radius) * FRAC_1_SQRT_2);
    groove_curvature::Request {
        groove: Groove::Screw,
        pitch_radius: held(pitch_radius),
        lead_angle: held(0.2),
        contact_angle: held(FRAC_PI_4),
        groove_radius: held(groove_radius),
        offset_h: offset,
        offset_l: offset,
        ball_radius: None,
    }
}

/// A screw without rolling resistance.
pub fn efficiency(
    friction: f64,
    lead_degrees: f64,
    contact_degrees: f64,
    ball_ratio: f64,
) -> efficiency::Request {
    efficiency::Request {
        lead_angle: held(lead_degrees.to_radians()),
        contact_angle: held(contact_degrees.to_radians()),
        friction: held(friction),
        ball_ratio: held(ball_ratio),
        rolling_tangent: 0.0,
    }
}

pub fn dynamic(speed: f64, load: f64) -> steady_state::Request {
    steady_state::Request {
        lead_angle: held(0.2),
        contact_angle: held(FRAC_PI_4),
        friction: held(0.1),
        ball_radius: held(0.003),
        pitch_radius: held(0.015),
        speed: held(speed),
        axial_load: held(load),
        ball_density: steady_state::BALL_DENSITY,
    }
}

pub fn ellipse(ratio: f64, load: f64, radius: f64, modulus: f64) -> hertz::Request {
    hertz::Request {
        relative_radius_1: held(radius),
        relative_radius_2: held(radius * ratio),
        load: held(load),
        contact_modulus: held(modulus),
    }
}

/// A ball of 7.94 mm that rolls nearly on its equator.
pub fn kinematics(
    lead_degrees: f64,
    contact_degrees: f64,
    pitch_degrees: f64,
    speed: f64,
) -> contact_kinematics::Request {
    let radius = 0.00397;
    let contact_angle = held(contact_degrees.to_radians());
    contact_kinematics::Request {
        ball_diameter: held(2.0 * radius),
        pitch_radius: held(0.01925),
        lead_angle: held(lead_degrees.to_radians()),
        groove_radius_screw: held(0.0042),
        groove_radius_nut: held(0.0042),
        contact_angle_screw: contact_angle,
        contact_angle_nut: contact_angle,
        pitch_angle: held(pitch_degrees.to_radians()),
        yaw_angle: 0.0,
        rolling_radius_screw: held(0.998 * radius),
        rolling_radius_nut: held(0.998 * radius),
        speed: held(speed),
        semi_major_screw: held(2e-4),
        semi_minor_screw: held(4e-5),
        semi_major_nut: held(2e-4),
        semi_minor_nut: held(4e-5),
    }
}

pub fn friction(axis_ratio: f64, offset: f64) -> friction_map::Request {
    friction_map::Request {
        axis_ratio: held(axis_ratio),
        offset: held(offset),
    }
}

/// Balls of Lin 2019, Table 3.3, with the bottom groove turned by degrees, under side forces.
pub fn linear(balls: impl IntoIterator<Item = (f64, f64)>) -> linear_train::Request {
    let turned = |(degrees, side)| {
        let ball = turned_ball(degrees, side);
        linear_train::Ball {
            contact_angles: ball.contact_angles.map(held),
            contact_forces: ball.contact_forces.map(held),
        }
    };
    linear_train::Request {
        ball_radius: held(0.005),
        conformity: held(0.56),
        nominal_contact_angle: held(FRAC_PI_4),
        youngs_modulus: held(2.1e11),
        poisson_ratio: held(0.3),
        friction: held(0.1),
        ball_friction: 0.0,
        speed: held(0.5),
        balls: balls.into_iter().map(turned).collect(),
    }
}

pub fn rising_row(balls: f64, degrees: f64) -> linear_train::Request {
    let balls = balls.round() as u32;
    linear((0..balls).map(|ball| {
        let place = f64::from(ball) / f64::from(balls - 1);
        (degrees, 0.6 * (2.0 * place - 1.0))
    }))
}
