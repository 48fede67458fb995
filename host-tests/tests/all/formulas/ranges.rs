//! One range of the friction coefficient: formulas at both its ends, and just beyond.
//!
//! Where all contacts of a ball have the same coefficient, its motion does not depend on it; losses and the forces between
//! balls are proportional to it.

use core::f32::consts::FRAC_PI_4;

use epas_design::efficiency::{
    DesignRequest, Duty, DynamicCorrection, optimum_contact_angle, optimum_efficiency,
};
use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::ranges::{FRICTION, FRICTION_OF_A_ROW, FRICTION_OR_NONE};
use epas_friction::{Error, Material, Range};

const USUAL: f32 = 0.1;

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

/// The equations scale with the coefficient but for roundings and floors of 1e-9 N. Measured: 4.2e-7.
const SCALED: f32 = 1e-6;

fn close(found: f32, wanted: f32, what: &str) {
    let error = found / wanted - 1.0;
    println!("{what}: {error:e}");
    assert!(
        error.abs() < SCALED,
        "{what}: {found} for {wanted}, off by {error:e}"
    );
}

#[test]
fn a_ball_of_a_linear_bearing_at_both_ends() {
    let (angles, forces) = (
        [0.7505, 0.8203, NOMINAL, NOMINAL],
        [114.06, 24.32, 113.14, 28.28],
    );
    let closed = |friction| {
        let ball = AnalyticLinearBall::new(&linear(friction), PUBLISHED_SLOPE).unwrap();
        ball.speed_deviation(&angles, &forces)
    };
    for friction in [FRICTION.minimum, FRICTION.maximum] {
        let factor = friction / USUAL;
        let analytic = closed(friction);
        assert_eq!(analytic.speed_deviation, closed(USUAL).speed_deviation);
        close(
            analytic.compliance,
            closed(USUAL).compliance / factor,
            "closed form",
        );
    }
}

/// Without friction there is no loss; at 1 every figure is finite, and what locks says so.
#[test]
fn efficiency_at_both_ends() {
    for (lead, contact) in [(0.01, 0.3), (0.1, 0.785), (0.5, 0.785), (1.2, 1.3)] {
        let screw = EfficiencyGeometry::new(lead, contact, 0.18).unwrap();
        assert_eq!(screw.rolling_efficiency(0.0, 0.0), 1.0);
        assert_eq!(screw.rolling_backdrive_efficiency(0.0, 0.0), 1.0);
        assert_eq!(screw.sliding_efficiency(0.0), 1.0);
        assert_eq!(screw.sliding_backdrive_efficiency(0.0), 1.0);
        for drive in [Drive::Driving, Drive::BackDriving] {
            assert!(!screw.locks(drive, 0.0));
            assert_eq!(screw.rolling_torque_per_load(drive, 0.01, 0.0, 0.0), 0.0);
            assert_eq!(screw.sliding_torque_per_load(drive, 0.01, 0.0), 0.0);
        }
        let most = FRICTION_OR_NONE.maximum;
        for (drive, efficiency) in [
            (Drive::Driving, screw.sliding_efficiency(most)),
            (Drive::BackDriving, screw.sliding_backdrive_efficiency(most)),
        ] {
            assert!(efficiency.is_finite() && efficiency < 1.0);
            assert!(
                screw.locks(drive, most) == (efficiency <= 0.0),
                "{lead} {contact}"
            );
        }
        assert!(screw.rolling_efficiency(most, 0.0).is_finite());
        assert!(screw.rolling_backdrive_efficiency(most, 0.0) < 1.0);
        let dynamic = DynamicCorrection::new(&screw, most);
        assert!(dynamic.coefficient().is_finite() && dynamic.efficiency(1e-3).is_finite());
    }
    assert_eq!(optimum_efficiency(0.0), 1.0);
    close(optimum_efficiency(1.0), 0.171_572_88, "optimum efficiency");
    for friction in [FRICTION_OR_NONE.minimum, FRICTION_OR_NONE.maximum] {
        let figures = request(friction).figures().unwrap();
        assert!(figures.max_pressure_screw.is_finite() && figures.max_pressure_nut.is_finite());
        assert_eq!(figures.locked, figures.sliding_efficiency <= 0.0);
    }
}
