//! The scenes of the stored cases, set up in Rust; `test/setups.c` sets the same up in C, as a user would.

use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, OilData, RollingDrag, TemperatureFade, Viscosity,
};
use epas_friction::law::memory::{Hysteresis, Part, ProportionalElements, SLIP_4, SPIN_4};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, FoldedBall, Freshness, Scene, UncagedConstants,
    WithMemory, WithMemoryConfiguration,
};
use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration,
    DeviationMap, Error, FrictionBranch, FrictionModel, GrooveSize, Harmonic, Limits,
    LinearBearing, LinearBearingConfiguration, LinearBearingParameters, LinearBearingTrain,
    LinearLimits, LoadShare, LoadShares, Material, UncagedBallScrew, UncagedBallScrewConfiguration,
};

use crate::gears;

/// The gear of Lin 2019, chapter 3.6, with 100 N on each flank, by its block.
pub fn caged() -> Result<FrictionModel<CagedBallScrew>, Error> {
    FrictionModel::new(&CagedBallScrewConfiguration::read(gears::GEAR_33X20)?)
}

/// The same for a range of friction coefficients.
pub fn caged_range() -> Result<FrictionModel<CagedBallScrew<NODES>>, Error> {
    FrictionModel::new(&CagedBallScrewConfiguration::read(gears::GEAR_33X20_RANGE)?)
}

fn design() -> Result<BallScrew, Error> {
    BallScrew::new(BallScrewParameters {
        pitch_radius: 16.5e-3,
        lead: 20e-3,
        ball_radius: 2.778e-3,
        screw_groove: GrooveSize::Conformity(0.56),
        nut_groove: GrooveSize::Conformity(0.56),
        contact_angle: std::f32::consts::FRAC_PI_4,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
}

/// Its gap: 100 N on each flank, m.
const OVERSIZE: f32 = -4.068_737e-7;

/// The same gear by a closed form.
pub fn closed_form() -> Result<FrictionModel<ClosedFormScrew>, Error> {
    FrictionModel::new(&ClosedFormScrewConfiguration {
        design: design()?,
        friction: 0.075,
        rolling_tangent: 1e-3,
        branch: FrictionBranch::Rolling,
        clearance: Clearance::new(OVERSIZE)?,
        loaded_balls: 36,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 100.0,
            axial_load: 20_000.0,
            friction_torque: 20.0,
        },
    })
}

/// Friction coefficients of a block for a range of them.
pub const NODES: usize = 5;

/// The same gear with a memory, behind an encoder of 14 bits on its motor.
pub type Remembering = WithMemory<
    CagedBallScrew<NODES>,
    ProportionalElements<8>,
    Deadband<CountSensor>,
    CoefficientLaw,
>;

type RememberingConfiguration = WithMemoryConfiguration<
    CagedBallScrewConfiguration<NODES>,
    ProportionalElements<8>,
    Deadband<CountSensor>,
    CoefficientLaw,
>;

/// Turn of the nut for a count: a belt of ratio 2.5.
pub const TURN_PER_COUNT: f32 = 1.533_981e-4;

/// The gear's friction coefficient by speed and temperature, with this one at standstill.
pub fn law(boundary: f32) -> Result<CoefficientLaw, Error> {
    CoefficientLaw::new(&law_of(boundary, 0.05)?)
}

/// The same with this coefficient on a full film.
pub fn law_of(boundary: f32, full_film: f32) -> Result<CoefficientParameters, Error> {
    Ok(CoefficientParameters {
        boundary,
        full_film,
        half_share_speed: 4.9,
        reference_temperature: 293.15,
        viscosity: Viscosity::of_oil(&OilData {
            kinematic_viscosity_40: 100e-6,
            kinematic_viscosity_100: 11.2e-6,
            density: 880.0,
            pour_point: 233.15,
        })?,
        forward: 1.0,
        backward: 1.1,
        churning: 1e-6,
        drag: RollingDrag {
            torque: 0.001_3,
            heating: 0.000_5,
        },
    })
}

/// The gear whose friction remembers.
pub fn memory() -> Result<FrictionModel<Remembering>, Error> {
    FrictionModel::<Remembering>::new(&remembering(gears::GEAR_33X20_RANGE)?)
}

/// What the gear goes on with: another block.
pub fn swapped() -> Result<<Remembering as Scene>::Constants, Error> {
    Remembering::constants(&remembering(gears::GEAR_29X7_RANGE)?)
}

/// Friction of the gear under 5 kN, N m, the share of slip in it, and the breakaway angles of slip and spin, rad.
const REFERENCE_TORQUE: f32 = 0.6083;
const SLIP_SHARE: f32 = 0.3717;
const SLIP_ANGLE: f32 = 23.5e-3;
const SPIN_ANGLE: f32 = 0.3017e-3;

/// Elements of the gear.
pub fn elements() -> Result<ProportionalElements<8>, Error> {
    let slip = Part {
        backbone: &SLIP_4.elements,
        share: SLIP_SHARE,
        breakaway_angle: SLIP_ANGLE,
    };
    let spin = Part {
        backbone: &SPIN_4.elements,
        share: 1.0 - SLIP_SHARE,
        breakaway_angle: SPIN_ANGLE,
    };
    ProportionalElements::new(REFERENCE_TORQUE, &[slip, spin])
}

fn remembering(block: &[u32]) -> Result<RememberingConfiguration, Error> {
    let scene = CagedBallScrewConfiguration::read(block)?;
    let elements = elements()?;
    let counts = CountSensor::new(CountSensorParameters {
        period: 16_384,
        turn_per_count: TURN_PER_COUNT,
        largest_turn: 1.2,
    })?;
    Ok(WithMemoryConfiguration {
        scene,
        elements,
        angle: Deadband::new(counts, 1e-4)?,
        reference_load: 1.0,
        play: elements.breakaway(),
        coefficient: law(0.12)?,
        temperature: TemperatureFade::new(313.15, 10.0, 60.0)?,
        freshness: Freshness {
            load_hold: 0.01,
            load_fade: 0.09,
        },
    })
}

fn kept<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

/// Friction coefficients of a folded ball for a range of them.
/// Most balls of the header.
pub const MOST_BALLS: usize = 64;
pub const BALL_NODES: usize = 3;

/// The ball screw of Lin 2019, chapter 3.6, without cage, with two waves of deviation a turn on the screw and a triangle on the nut: less than 1
/// and 0.5 degrees.
fn without_cage<const NODES: usize>(
    folded: &'static FoldedBall<NODES>,
) -> Result<UncagedBallScrewConfiguration<NODES>, Error> {
    let triangle = std::array::from_fn(|sample: usize| {
        let sample = sample as f32;
        let rise = if sample < 32.0 { sample } else { 64.0 - sample };
        (rise - 16.0) * 0.0005
    });
    let shares = [1.4_f32, 1.2, 1.1, 0.9, 0.8, 0.6]
        .into_iter()
        .map(LoadShare::new)
        .collect::<Result<Vec<_>, _>>()?;
    Ok(UncagedBallScrewConfiguration {
        folded,
        ball_friction: 0.1,
        balls: 37,
        turns: 1.8,
        return_length: 20e-3,
        screw_deviation: kept(DeviationMap::from_harmonics(
            1,
            &[
                Harmonic {
                    order: 1,
                    cosine: 0.002,
                    sine: 0.0,
                },
                Harmonic {
                    order: 2,
                    cosine: 0.0,
                    sine: 0.014,
                },
            ],
        )?),
        nut_deviation: kept(DeviationMap::from_samples(2, &triangle)?),
        load_shares: LoadShares::same(kept(shares)),
        tick: 0.5e-3,
    })
}

fn with_angle<const NODES: usize>(
    folded: &'static FoldedBall<NODES>,
) -> Result<FrictionModel<UncagedBallScrew<MOST_BALLS, NODES>>, Error> {
    let configuration = without_cage(folded)?;
    let mut model = FrictionModel::<UncagedBallScrew<MOST_BALLS, NODES>>::new(&configuration)?;
    model.set_nut_angle(1.25);
    Ok(model)
}

/// The screw without cage, with one friction coefficient.
pub fn screw() -> Result<FrictionModel<UncagedBallScrew<MOST_BALLS>>, Error> {
    with_angle(&gears::GEAR_33X20_BALL)
}

/// What it goes on with: worn.
pub fn worn_screw() -> Result<UncagedConstants<MOST_BALLS>, Error> {
    UncagedConstants::new(&without_cage(&gears::GEAR_33X20_BALL_WORN)?)
}

/// The screw without cage, for a range of friction coefficients.
pub fn screw_range() -> Result<FrictionModel<UncagedBallScrew<MOST_BALLS, BALL_NODES>>, Error> {
    with_angle(&gears::GEAR_33X20_BALL_RANGE)
}

/// A linear bearing with balls of 10 mm.
pub fn linear() -> Result<FrictionModel<LinearBearingTrain<MOST_BALLS>>, Error> {
    let mut model =
        FrictionModel::<LinearBearingTrain<MOST_BALLS>>::new(&LinearBearingConfiguration {
            bearing: LinearBearing::new(LinearBearingParameters {
                ball_radius: 5e-3,
                groove: GrooveSize::Conformity(0.52),
                contact_angle: std::f32::consts::FRAC_PI_4,
                ball_material: Material::STEEL,
                groove_material: Material::STEEL,
            })?,
            friction: 0.1,
            ball_friction: 0.12,
            balls: 32,
            loaded_length: 0.2,
            return_length: 0.13,
            wavelength: 0.05,
            rail_deviation: kept(DeviationMap::from_harmonics(
                1,
                &[Harmonic {
                    order: 1,
                    cosine: 0.01,
                    sine: 0.02,
                }],
            )?),
            carriage_deviation: &DeviationMap::NONE,
            load_shares: &[LoadShare::MEAN],
            reversal_speed: 1e-3,
            tick: 1e-3,
            limits: LinearLimits {
                speed: 2.0,
                load: 5_000.0,
                friction_force: 50.0,
            },
        })?;
    model.set_carriage_position(0.0125);
    Ok(model)
}
