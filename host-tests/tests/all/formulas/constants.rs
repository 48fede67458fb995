//! What a compiler folds and what the target would compute are the same bits.
//!
//! A constant takes each set-up from one list of numbers; at run time the same functions take the same numbers from behind `black_box`.
//! Bits are compared through the `Debug` text, which prints every number of a structure so that it can be read back exactly.

use std::fmt::Debug;
use std::hint::black_box;

use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::kinematics::{ContactKinematics, EllipticContact, KinematicsParameters};
use epas_friction::{BallScrew, CATALOGUE, math};
use epas_testkit::gears::folded;

#[derive(Clone, Copy, Debug)]
#[allow(dead_code)] // Read through `Debug`.
struct SetUp {
    design: BallScrew,
    ball_mass: f32,
    ball_ratio: f32,
    cos_lead_angle: f32,
    contacts: [HertzContact; 2],
    arches: [GothicArch; 2],
    fitted: [FittedCurvature; 2],
    circular: [CircularGrooveCurvature; 2],
    literature: [LiteratureCurvature; 2],
    efficiency: EfficiencyGeometry,
    torques: [f32; 4],
    loads: [f32; 2],
}

impl SetUp {
    const fn of(design: BallScrew, friction: f32, rolling_tangent: f32) -> Self {
        let efficiency = EfficiencyGeometry::of(&design);
        let radius = design.pitch_radius();
        Self {
            design,
            ball_mass: design.ball_mass(),
            ball_ratio: design.ball_ratio(),
            cos_lead_angle: design.cos_lead_angle(),
            contacts: [
                HertzContact::of(&design, Groove::Screw),
                HertzContact::of(&design, Groove::Nut),
            ],
            arches: [
                GothicArch::of(&design, Groove::Screw),
                GothicArch::of(&design, Groove::Nut),
            ],
            fitted: [
                FittedCurvature::of(&design, Groove::Screw),
                FittedCurvature::of(&design, Groove::Nut),
            ],
            circular: [
                CircularGrooveCurvature::of(&design, Groove::Screw),
                CircularGrooveCurvature::of(&design, Groove::Nut),
            ],
            literature: [
                LiteratureCurvature::of(&design, Groove::Screw),
                LiteratureCurvature::of(&design, Groove::Nut),
            ],
            efficiency,
            torques: [
                efficiency.rolling_torque_per_load(
                    Drive::Driving,
                    radius,
                    friction,
                    rolling_tangent,
                ),
                efficiency.rolling_torque_per_load(
                    Drive::BackDriving,
                    radius,
                    friction,
                    rolling_tangent,
                ),
                efficiency.sliding_torque_per_load(Drive::Driving, radius, friction),
                efficiency.sliding_torque_per_load(Drive::BackDriving, radius, friction),
            ],
            loads: [
                efficiency.normal_per_axial_load(),
                efficiency.normal_per_torque(),
            ],
        }
    }
}

const SIZES: usize = CATALOGUE.len();
const FRICTION: f32 = 0.075;
const ROLLING_TANGENT: f32 = 1e-3;

const CATALOGUE_SET_UPS: [SetUp; SIZES] = {
    let first = folded(CATALOGUE[0].design());
    let mut all = [SetUp::of(first, FRICTION, ROLLING_TANGENT); SIZES];
    let mut index = 1;
    while index < SIZES {
        let design = folded(CATALOGUE[index].design());
        all[index] = SetUp::of(design, FRICTION, ROLLING_TANGENT);
        index += 1;
    }
    all
};

/// `Debug` prints the shortest text that reads back as the same number, and the sign of a zero: equal
/// texts are equal bits. No NaN may hide among them.
pub fn same_bits(folded: &impl Debug, computed: &impl Debug) {
    let (folded, computed) = (format!("{folded:?}"), format!("{computed:?}"));
    assert!(!folded.contains("NaN"), "{folded}");
    assert_eq!(folded, computed);
}

#[test]
fn a_folded_ball_screw_has_the_bits_of_one_made_at_run_time() {
    for (size, folded) in CATALOGUE.iter().zip(&CATALOGUE_SET_UPS) {
        let design = black_box(size).design().unwrap();
        let computed = SetUp::of(
            black_box(design),
            black_box(FRICTION),
            black_box(ROLLING_TANGENT),
        );
        same_bits(folded, &computed);
    }
}

/// Set-up shares the algebra of the exact curvatures with the loop, but neither the square root, which must not
/// show, nor the one division of the loop.
#[test]
fn the_roots_of_set_up_are_those_of_the_loop() {
    for set_up in &CATALOGUE_SET_UPS {
        for (arch, groove) in set_up.arches.iter().zip([Groove::Screw, Groove::Nut]) {
            let angle = set_up.design.contact_angle();
            let clearance = set_up.design.clearance(groove);
            let relative = arch.relative(angle, clearance);
            let ball_curvature = 1.0 / (arch.groove_radius() - clearance);
            let along = ball_curvature + arch.principal(angle).kappa1;
            // The loop's quotients have two roundings more each, and a sum rounds both.
            assert!((relative.along / along - 1.0).abs() <= 2.5 * f32::EPSILON);
        }
        let slope = set_up.design.tan_lead_angle();
        let cos_lead_angle = 1.0 / math::sqrt(1.0 + slope * slope);
        assert_eq!(set_up.cos_lead_angle.to_bits(), cos_lead_angle.to_bits());
    }
}

/// The screw of Alberdi et al., Table 2, at 1500 N.
const BALL: KinematicsParameters = KinematicsParameters {
    ball_diameter: 7.94e-3,
    pitch_radius: 19.25e-3,
    lead_angle: 0.1745,
    groove_radius_screw: 4.2e-3,
    groove_radius_nut: 4.2e-3,
    contact_angle_screw: 0.7156,
    contact_angle_nut: 0.7156,
    pitch_angle: 0.6981,
    yaw_angle: 0.02,
    rolling_radius_screw: 3.97e-3,
    rolling_radius_nut: 3.96e-3,
    semi_major_screw: 0.601e-3,
    semi_minor_screw: 0.083e-3,
    semi_major_nut: 0.586e-3,
    semi_minor_nut: 0.097e-3,
};

/// The kinematics' set-up takes other kernels than its update in the loop: the same contact given again must change nothing.
#[test]
fn folded_kinematics_have_the_bits_of_those_made_at_run_time() {
    const FOLDED: ContactKinematics = match ContactKinematics::new(&BALL) {
        Ok(kinematics) => kinematics,
        Err(_) => panic!("the ball does not roll"),
    };
    let mut computed = ContactKinematics::new(&black_box(BALL)).unwrap();
    same_bits(&FOLDED, &computed);
    let screw = EllipticContact {
        contact_angle: BALL.contact_angle_screw,
        semi_major: BALL.semi_major_screw,
        semi_minor: BALL.semi_minor_screw,
    };
    let nut = EllipticContact {
        contact_angle: BALL.contact_angle_nut,
        semi_major: BALL.semi_major_nut,
        semi_minor: BALL.semi_minor_nut,
    };
    let other = EllipticContact {
        contact_angle: 0.5,
        ..screw
    };
    assert!(computed.update(other, other));
    assert!(format!("{FOLDED:?}") != format!("{computed:?}"));
    assert!(computed.update(black_box(screw), black_box(nut)));
    same_bits(&FOLDED, &computed);
}
