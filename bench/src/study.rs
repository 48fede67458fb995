//! The case studies of Lin 2019 that report and timing share.

use std::f32::consts::{PI, TAU};
use std::f64::consts::FRAC_PI_4;

use epas_design::breakaway::{Breakaway, BreakawayConfiguration, ScrewContacts, Tables};
use epas_design::uncaged::Folded;
use epas_design::{CagedDesign, UncagedDesign, UncagedFold};
use epas_friction::ball::LinearBallParameters;
use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::law::memory::{ProportionalElements, SLIP_4, SPIN_4};
use epas_friction::law::motion::{WrappedAngle, WrappedAngleParameters};
use epas_friction::scene::{Scene, Sliding, WithMemory, WithMemoryConfiguration, WithMemoryInputs};
use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, DeviationMap, FrictionModel, GrooveSize, Harmonic,
    Inputs, Limits, LoadShares, Material, RollingResistance, UncagedBallScrew,
    UncagedBallScrewConfiguration,
};
use epas_reference::curvature::Groove;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_elastic::{BallSlip, ElasticBalls};
use epas_reference::friction::ball_screw_grooves::ElasticGrooves;
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall, contact_forces};
use epas_reference::material::Elastic;

use epas_design::uncaged_scene::folded;
use epas_page::failure::Failure;

/// Friction coefficient of balls and grooves.
pub const FRICTION: f64 = 0.1;
/// Load on a ball across the track and down, N.
pub const NORMAL_LOAD: f64 = 100.0;

const BALL_RADIUS: f64 = 0.005;
/// The ellipse of Table 3.3 (conformity 0.56, steel).
const AXIS_RATIO: f64 = 0.232_146_373;
const PSI: f64 = 5.3073e-4;

fn semi_major_constant() -> f64 {
    PSI * BALL_RADIUS.cbrt()
}

/// The ball of Table 3.3 for the crate.
pub fn linear_ball() -> LinearBallParameters {
    LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: FRAC_PI_4 as f32,
        axis_ratio: AXIS_RATIO as f32,
        semi_major_coefficient: semi_major_constant() as f32,
        friction: FRICTION as f32,
    }
}

/// The ball of Table 3.3 with its bottom groove turned by so many degrees, under a side force of so many
/// times the normal load (Section 3.3.4).
pub fn turned_ball(degrees: f64, side_force_ratio: f64) -> LinearBall {
    let turn = degrees.to_radians();
    let contact_angles = [-turn, turn, 0.0, 0.0].map(|deviation| FRAC_PI_4 + deviation);
    LinearBall {
        ball_radius: BALL_RADIUS,
        friction: FRICTION,
        contact_angles,
        contact_forces: contact_forces(contact_angles, NORMAL_LOAD * side_force_ratio, NORMAL_LOAD)
            .map(|force| force.max(0.0)),
        ellipse: EllipseLaw {
            semi_major_constant: semi_major_constant(),
            axis_ratio: AXIS_RATIO,
        },
    }
}

/// The ball screw of Table 3.6, with the groove radius of Table 2.1.
const LIN: BallScrewDesign = BallScrewDesign::LIN;

/// A design of the reference for the crate.
pub fn screw_of(design: &BallScrewDesign) -> Result<BallScrew, epas_friction::Error> {
    let material = |elastic: Elastic| Material {
        youngs_modulus: elastic.youngs_modulus as f32,
        poisson_ratio: elastic.poisson_ratio as f32,
        ..Material::STEEL
    };
    BallScrew::new(BallScrewParameters {
        pitch_radius: design.pitch_radius as f32,
        lead: design.lead as f32,
        ball_radius: design.ball_radius as f32,
        screw_groove: GrooveSize::Radius(design.screw_groove_radius as f32),
        nut_groove: GrooveSize::Radius(design.nut_groove_radius as f32),
        contact_angle: design.contact_angle as f32,
        ball_material: material(design.ball),
        groove_material: material(design.groove),
    })
}

/// The ball screw of Table 3.6 for the crate.
pub fn ball_screw() -> Result<BallScrew, Failure> {
    Ok(screw_of(&LIN)?)
}

/// Two balls of it, from rear to front, where the screw's contact angles deviate by so many degrees: more
/// on the right flank, less on the left.
pub fn screw_pair(degrees: [f64; 2]) -> Result<ElasticBalls, Failure> {
    let [screw, nut] = [LIN.contact(Groove::Screw)?, LIN.contact(Groove::Nut)?].map(HertzLaw::from);
    let grooves = degrees.map(|degrees| {
        let turn = degrees.to_radians();
        ElasticGrooves {
            track: (&LIN).into(),
            screw_groove_radius: LIN.screw_groove_radius,
            nut_groove_radius: LIN.nut_groove_radius,
            arc_angles: [-turn, turn, 0.0, 0.0].map(|deviation| FRAC_PI_4 + deviation),
            screw,
            nut,
            oversize: 0.0,
        }
    });
    Ok(ElasticBalls {
        grooves: grooves.to_vec(),
        friction: FRICTION,
        ball_friction: FRICTION,
        nut_speed: 1.0,
        ball_slip: BallSlip::Orbiting,
    })
}

/// Deviation of the screw's contact angles in Figure 3.23, with the amplitude of 2.3 degrees that gives the
/// printed peak.
static SCREW_DEVIATION: DeviationMap = match DeviationMap::from_harmonics(
    1,
    &[Harmonic {
        order: 2,
        cosine: 0.0,
        sine: 0.040_14,
    }],
) {
    Ok(map) => map,
    Err(_) => panic!("a deviation is out of range"),
};

/// The screw of Section 3.4.4 in the loop, its 37 balls or as many as are asked for at the same occupation.
pub fn whole_screw<const N: usize>() -> Result<FrictionModel<UncagedBallScrew<N>>, Failure> {
    let fold = UncagedFold::of(UncagedDesign {
        gear: CagedDesign {
            design: ball_screw()?,
            friction: FRICTION as f32,
            rolling_resistance: RollingResistance::NONE,
            clearance: Clearance::ZERO,
            loaded_balls: 1,
            reversal_speed: 1e-3,
            limits: Limits {
                nut_speed: 20.0,
                axial_load: 1e5,
                friction_torque: 100.0,
            },
        },
        // That of the screw; the nut has none, and counts with the least that is folded for.
        deviations: [0.0402, 1e-4],
    });
    let Folded::One(folded) = folded(&fold)? else {
        return Err(Failure::Data("one friction coefficient is one node".into()));
    };
    Ok(FrictionModel::new(&UncagedBallScrewConfiguration {
        folded,
        ball_friction: FRICTION as f32,
        balls: N as u16,
        turns: (2.0 * N as f32 / 37.0).max(0.11),
        return_length: 0.0,
        screw_deviation: &SCREW_DEVIATION,
        nut_deviation: &DeviationMap::NONE,
        load_shares: LoadShares::EVEN,
        tick: 1e-3,
    })?)
}

/// A scene with a memory of eight elements, whose sensor reads an angle within a turn either way and whose friction coefficient is one.
pub type Remembering<S> =
    FrictionModel<WithMemory<S, ProportionalElements<8>, WrappedAngle, OneCoefficient>>;

/// The scene of a gear with the elements that its contacts have under an axial load, N.
pub fn remembering<S>(
    gear: &CagedDesign,
    scene: S::Configuration,
    axial_load: f32,
) -> Result<Remembering<S>, Failure>
where
    S: Sliding<Constants: Copy, Configuration: Copy>,
    WithMemory<S, ProportionalElements<8>, WrappedAngle, OneCoefficient>: Scene<
        Configuration = WithMemoryConfiguration<
            S::Configuration,
            ProportionalElements<8>,
            WrappedAngle,
            OneCoefficient,
        >,
    >,
{
    let CagedDesign {
        design,
        friction,
        clearance,
        rolling_resistance,
        loaded_balls,
        ..
    } = *gear;
    let contact_load = ScrewContacts::of(&design).preloaded(axial_load, loaded_balls, clearance);
    let breakaway = Breakaway::of(
        &design,
        &BreakawayConfiguration {
            friction,
            clearance,
            rolling_resistance,
            loaded_balls,
            contact_load,
        },
    )?;
    let elements = breakaway.elements(&Tables {
        slip: &SLIP_4.elements,
        spin: &SPIN_4.elements,
        rolling_resistance: &[],
    })?;
    let sensor = WrappedAngle::new(WrappedAngleParameters {
        lowest: -TAU,
        period: 2.0 * TAU,
        largest_turn: PI,
    })?;
    let configuration =
        WithMemoryConfiguration::new(scene, friction, elements, sensor, axial_load)?;
    Ok(FrictionModel::new(&configuration)?)
}

/// A moment of a sensor that was read now, at the temperature of the default law.
pub fn fresh(inputs: Inputs, reading: f32) -> WithMemoryInputs<Inputs, f32> {
    WithMemoryInputs {
        scene: inputs,
        reading,
        load_age: 0.0,
        temperature: 313.0,
        temperature_age: 0.0,
    }
}
