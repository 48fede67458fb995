//! One range of the friction coefficient: formulas at both its ends, and just beyond.
//!
//! Where all contacts of a ball have the same coefficient, its motion does not depend on it; losses and the forces between
//! balls are proportional to it.

use core::f32::consts::FRAC_PI_4;

use epas_design::efficiency::{DesignRequest, Duty, optimum_contact_angle};
use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::efficiency::Drive;
use epas_friction::ranges::{FRICTION, FRICTION_OF_A_ROW, FRICTION_OR_NONE};
use epas_friction::{Error, Material, Range};

const NOMINAL: f32 = FRAC_PI_4;

fn linear(friction: f32) -> LinearBallParameters {
    LinearBallParameters {
        ball_radius: 0.005,
        contact_angle: NOMINAL,
        axis_ratio: 0.2321,
        semi_major_coefficient: 9.075e-5,
        friction,
    }
}

fn request(friction: f32) -> DesignRequest {
    DesignRequest {
        duty: Duty::MoveAxialLoad(14_500.0),
        lead_angle: 5f32.to_radians(),
        friction,
        screw_length: 0.75,
        pitch_radius: 14.5e-3,
        ball_ratio: 0.14,
        osculation: 0.95,
        loaded_balls: 71,
        rotation: 1.0,
        material: Material::STEEL,
    }
}

type Constructor = fn(f32) -> Result<(), Error>;

fn refused_beyond(range: Range, constructors: &[Constructor]) {
    for constructor in constructors {
        for end in [range.minimum, range.maximum] {
            assert_eq!(constructor(end), Ok(()), "{end}");
        }
        for beyond in [range.minimum.next_down(), range.maximum.next_up()] {
            let error = constructor(beyond).unwrap_err();
            assert_eq!(error.field(), "friction");
            assert_eq!(error.allowed(), range);
        }
    }
}

#[test]
fn every_constructor_takes_the_whole_range_and_nothing_beyond() {
    refused_beyond(
        FRICTION,
        &[|friction| AnalyticLinearBall::new(&linear(friction), PUBLISHED_SLOPE).map(drop)],
    );
    refused_beyond(
        FRICTION_OR_NONE,
        &[
            |friction| optimum_contact_angle(Drive::Driving, 0.1, friction).map(drop),
            |friction| request(friction).figures().map(drop),
        ],
    );
    // What a row takes, its balls take; what they take, an efficiency takes.
    for (wide, narrow) in [(FRICTION, FRICTION_OF_A_ROW), (FRICTION_OR_NONE, FRICTION)] {
        assert!(wide.contains(narrow.minimum) && wide.contains(narrow.maximum));
    }
    assert!(!FRICTION.contains(0.0));
}
