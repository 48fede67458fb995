//! The scenes that the firmware runs, each with the constants of one gear.
//!
//! In the image of a scene the compiler has folded them: they stand in flash. Functions that are counted have
//! theirs set up at run time, or the compiler would fold them into the functions.

use epas_friction::curvature::FittedCurvature;
use epas_friction::defaults::COEFFICIENT;
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient, TemperatureFade};
use epas_friction::law::memory::{BackboneElement, Part, ProportionalElements, SLIP_8};
use epas_friction::law::motion::SpeedOverTick;
use epas_friction::scene::{
    CagedBallScrew, CagedConstants, Freshness, UncagedBallScrew, UncagedBallScrewConfiguration,
    UncagedConstants, WithMemory, WithMemoryConfiguration, WithMemoryConstants, WithMemoryInputs,
};
use epas_friction::{
    BallScrew, Clearance, ClosedFormScrewConfiguration, DISSERTATION_DESIGNS, DeviationMap, Error,
    FrictionBranch, FrictionModel, GrooveSize, Harmonic, Inputs, Limits, LinearBearing,
    LinearBearingConfiguration, LinearBearingParameters, LinearBearingTrain, LinearConstants,
    LinearInputs, LinearLimits, LoadProportionalConfiguration, LoadShare, LoadShares, Material,
};

use crate::from_page;
use crate::gears::{GEAR_33X20, GEAR_33X20_BALL, GEAR_33X20_BALL_RANGE, GEAR_33X20_RANGE};
use crate::numbers::{linear_outputs, outputs, uncaged_outputs};

/// Balls in the ball screw's circuit.
pub const BALLS: usize = 37;

/// Balls in the linear bearing's circuit.
pub const ROW: usize = 24;

/// Time between two ticks, s.
pub const TICK: f32 = 1e-3;

/// Oversize of the balls of the gear with a cage: with 36 of them, 100 N on each flank of the nut.
const OVERSIZE: Clearance = folded(Clearance::new(-4.068_737e-7));

/// Two waves of 1 degree a turn.
pub static SCREW_DEVIATION: DeviationMap = folded(DeviationMap::from_harmonics(
    1,
    &[Harmonic {
        order: 2,
        cosine: 0.0,
        sine: 0.0174,
    }],
));

/// Three waves of half a degree a turn.
static NUT_DEVIATION: DeviationMap = folded(DeviationMap::from_harmonics(
    1,
    &[Harmonic {
        order: 3,
        cosine: 0.0078,
        sine: 0.0039,
    }],
));

/// The gear whose geometry every scene of a ball screw has: Lin 2019, chapter 3.6, 33 mm pitch circle,
/// lead 20 mm, 37 balls in two turns.
pub const DESIGN: BallScrew = {
    let [_, design, _] = DISSERTATION_DESIGNS;
    folded(BallScrew::new(design.parameters))
};

const BEARING: LinearBearing = folded(LinearBearing::new(LinearBearingParameters {
    ball_radius: 0.005,
    groove: GrooveSize::Conformity(0.54),
    contact_angle: core::f32::consts::FRAC_PI_4,
    ball_material: Material::STEEL,
    groove_material: Material::STEEL,
}));

static CURVATURE: FittedCurvature = FittedCurvature::of(&DESIGN, Groove::Screw);
static EFFICIENCY: EfficiencyGeometry = EfficiencyGeometry::of(&DESIGN);
static LINEAR: LinearConstants<ROW> = folded(LinearConstants::new(&CARRIAGE));
/// Constants of the screw without a cage.
pub static UNCAGED: UncagedConstants<BALLS> = folded(UncagedConstants::new(&UNCAGED_SCREW));

const SPEED: SpeedOverTick = folded(SpeedOverTick::new(TICK, 1.0));

/// Constants of the caged gear with a memory.
pub static CAGED_WITH_MEMORY: CagedMemoryConstants = folded(WithMemoryConstants::new(
    GEAR_33X20,
    &folded(with_memory((), SPEED, folded(OneCoefficient::new(0.075)))),
));
/// Constants of the caged gear whose friction coefficient follows speed and temperature.
pub static CAGED_BY_LAW: CagedLawConstants = folded(WithMemoryConstants::new(
    GEAR_33X20_RANGE,
    &folded(with_memory(
        (),
        SPEED,
        folded(CoefficientLaw::new(&COEFFICIENT)),
    )),
));
static UNCAGED_WITH_MEMORY: UncagedMemoryConstants = folded(WithMemoryConstants::new(
    UNCAGED,
    &folded(with_memory(
        UNCAGED_SCREW,
        SPEED,
        folded(OneCoefficient::new(0.1)),
    )),
));

/// Constants of a caged gear with a memory.
pub type CagedMemoryConstants =
    WithMemoryConstants<CagedConstants, ProportionalElements<8>, SpeedOverTick, OneCoefficient>;
/// The same with a friction coefficient by speed and temperature.
pub type CagedLawConstants =
    WithMemoryConstants<CagedConstants<5>, ProportionalElements<8>, SpeedOverTick>;
/// The same without cage.
pub type UncagedMemoryConstants = WithMemoryConstants<
    UncagedConstants<BALLS>,
    ProportionalElements<8>,
    SpeedOverTick,
    OneCoefficient,
>;

/// Elements in proportion, of a table, that slide under a limit, N m (N), and after an angle, rad (m).
pub const fn elements<const M: usize>(
    backbone: &[BackboneElement],
    limit: f32,
    breakaway_angle: f32,
) -> Result<ProportionalElements<M>, Error> {
    let part = Part {
        backbone,
        share: 1.0,
        breakaway_angle,
    };
    ProportionalElements::new(limit, &[part])
}

/// A ball screw with a memory of eight elements, by the readings of a sensor.
pub const fn with_memory<C: Copy, A: Copy, L: Copy>(
    scene: C,
    angle: A,
    coefficient: L,
) -> Result<WithMemoryConfiguration<C, ProportionalElements<8>, A, L>, Error> {
    match elements(&SLIP_8.elements, 0.2, 2e-3) {
        Ok(elements) => Ok(WithMemoryConfiguration {
            scene,
            elements,
            angle,
            reference_load: 1_000.0,
            play: 2e-3,
            coefficient,
            temperature: TemperatureFade::DEFAULT,
            freshness: Freshness::DEFAULT,
        }),
        Err(error) => Err(error),
    }
}

/// The constants of a set-up at compile time; a field out of range is an error of the compiler.
const fn folded<T: Copy>(set_up: Result<T, Error>) -> T {
    match set_up {
        Ok(folded) => folded,
        Err(_) => panic!("a field is out of range"),
    }
}

const LIMITS: Limits = Limits {
    nut_speed: 100.0,
    axial_load: 20_000.0,
    friction_torque: 20.0,
};

/// A mechanism with its own model, run by a tick.
pub trait Run {
    /// Its name.
    const NAME: &'static str;
    /// What stays in memory from tick to tick.
    type Model;

    /// Sets it up.
    fn set_up() -> Result<Self::Model, Error>;

    /// One tick; what it gives goes into the digest.
    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest);
}

/// A checksum of many results: FNV-1a over their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(pub u32);

impl Default for Digest {
    fn default() -> Self {
        Self(0x811C_9DC5)
    }
}

impl Digest {
    /// Takes in some numbers.
    #[inline]
    pub fn take(&mut self, values: &[f32]) {
        for value in values {
            self.0 = (self.0 ^ value.to_bits()).wrapping_mul(0x0100_0193);
        }
    }
}

/// Ticks of the run of a scene's image.
pub const TICKS: u32 = 2000;

/// Nut speed and load of a tick: lock to lock and back, the load with another period, so that all four
/// quadrants are passed.
#[must_use]
pub fn course(tick: u32) -> (f32, f32) {
    let triangle = |period: u32| {
        let place = tick % period;
        let half = period / 2;
        let up = if place < half { place } else { period - place };
        2.0 * (up as f32 / half as f32) - 1.0
    };
    (40.0 * triangle(700), 12_000.0 * triangle(1300))
}

/// Curvature alone, by the fitted formula.
pub struct Curvature;

impl Run for Curvature {
    const NAME: &'static str = "curvature";
    type Model = &'static FittedCurvature;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(&CURVATURE)
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, _: f32, digest: &mut Digest) {
        let sin = 0.6 + 0.005 * nut_speed;
        let cos = epas_friction::math::sqrt(1.0 - sin * sin);
        digest.take(&[model.first(ContactAngle { cos, sin })]);
    }
}

/// Efficiency of the present direction, and the torque that friction takes.
pub struct Efficiency;

impl Run for Efficiency {
    const NAME: &'static str = "efficiency";
    type Model = &'static EfficiencyGeometry;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(&EFFICIENCY)
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        let step = efficiency_step(model, nut_speed, 1e-3 * axial_load, 0.08);
        digest.take(&[step.efficiency, step.friction_torque]);
    }
}

/// A ball screw with a cage, by a law that a host has folded.
pub struct Caged;

impl Run for Caged {
    const NAME: &'static str = "caged_ball_screw";
    type Model = FrictionModel<CagedBallScrew, &'static CagedConstants>;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(FrictionModel::of(&GEAR_33X20))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&outputs(&model.step(Inputs {
            nut_speed,
            axial_load,
        })));
    }
}

/// The same from a block of a calibration page, which is checked and kept in memory: the README's example.
pub struct FromPage;

#[allow(
    dead_code,
    reason = "the constants beside the block of the generated file"
)]
mod page {
    include!("gears/gear_33x20.rs");
    /// Words of a page.
    pub static WORDS: [u32; GEAR_33X20_BLOCK.len()] = GEAR_33X20_BLOCK;
}

impl Run for FromPage {
    const NAME: &'static str = "caged_from_page";
    type Model = FrictionModel<CagedBallScrew>;

    fn set_up() -> Result<Self::Model, Error> {
        // A page is not known when firmware is compiled.
        from_page::set_up(core::hint::black_box(&page::WORDS))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&[from_page::friction_compensation(
            model, nut_speed, axial_load,
        )]);
    }
}

/// The same whose friction remembers: eight elements, one friction coefficient.
pub struct CagedWithMemory;

/// Its scene.
pub type CagedMemory =
    WithMemory<CagedBallScrew, ProportionalElements<8>, SpeedOverTick, OneCoefficient>;

/// The same with a friction coefficient by speed and temperature.
pub type CagedByLaw = WithMemory<CagedBallScrew<5>, ProportionalElements<8>, SpeedOverTick>;

impl Run for CagedWithMemory {
    const NAME: &'static str = "caged_with_memory";
    type Model = FrictionModel<CagedMemory, &'static CagedMemoryConstants>;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(FrictionModel::of(&CAGED_WITH_MEMORY))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&outputs(&model.step(remembered(nut_speed, axial_load))));
    }
}

/// A ball screw with 37 balls, without cage, whose friction remembers.
pub struct UncagedWithMemory;

/// Its scene.
pub type UncagedMemory =
    WithMemory<UncagedBallScrew<BALLS>, ProportionalElements<8>, SpeedOverTick, OneCoefficient>;

impl Run for UncagedWithMemory {
    const NAME: &'static str = "ball_screw_37_with_memory";
    type Model = FrictionModel<UncagedMemory, &'static UncagedMemoryConstants>;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(FrictionModel::of(&UNCAGED_WITH_MEMORY))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&uncaged_outputs(
            &model.step(remembered(nut_speed, axial_load)),
        ));
    }
}

/// Inputs and a reading of this tick at a usual temperature.
#[must_use]
pub const fn remembered_of<I: Copy, R: Copy>(scene: I, reading: R) -> WithMemoryInputs<I, R> {
    WithMemoryInputs {
        scene,
        reading,
        load_age: 0.0,
        temperature: 313.15,
        temperature_age: 0.0,
    }
}

/// Speed and load of this tick, the speed as reading too.
#[must_use]
pub const fn remembered(nut_speed: f32, axial_load: f32) -> WithMemoryInputs<Inputs, f32> {
    let scene = Inputs {
        nut_speed,
        axial_load,
    };
    remembered_of(scene, nut_speed)
}

/// A linear bearing without cage.
pub struct Linear;

impl Run for Linear {
    const NAME: &'static str = "linear_bearing";
    type Model = FrictionModel<LinearBearingTrain<ROW>, &'static LinearConstants<ROW>>;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(FrictionModel::of(&LINEAR))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&linear_outputs(&model.step(LinearInputs {
            speed: 0.02 * nut_speed,
            normal_load: 1500.0,
            side_load: 0.1 * axial_load,
        })));
    }
}

/// A ball screw with 37 balls, without cage.
pub struct Uncaged;

impl Run for Uncaged {
    const NAME: &'static str = "ball_screw_37";
    type Model = FrictionModel<UncagedBallScrew<BALLS>, &'static UncagedConstants<BALLS>>;

    fn set_up() -> Result<Self::Model, Error> {
        Ok(FrictionModel::of(&UNCAGED))
    }

    fn tick(model: &mut Self::Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&uncaged_outputs(&model.step(Inputs {
            nut_speed,
            axial_load,
        })));
    }
}

/// Its caged form by a closed form.
pub const CLOSED_FORM: ClosedFormScrewConfiguration = ClosedFormScrewConfiguration {
    design: DESIGN,
    friction: 0.075,
    rolling_tangent: 0.0,
    branch: FrictionBranch::Rolling,
    clearance: OVERSIZE,
    loaded_balls: 36,
    reversal_speed: 0.5,
    limits: LIMITS,
};

/// A drive of its lead without a drawing.
pub const LOAD_PROPORTIONAL: LoadProportionalConfiguration = LoadProportionalConfiguration {
    load_lever: DESIGN.reduced_lead(),
    coulomb_friction: 0.05,
    viscous_friction: 1e-3,
    driving_loss: 0.1,
    back_driving_loss: 0.13,
    reversal_speed: 0.5,
    limits: LIMITS,
};

/// Its form without a cage: all 37 balls under load, as in the dissertation; this takes the most cycles.
pub const UNCAGED_SCREW: UncagedBallScrewConfiguration = UncagedBallScrewConfiguration {
    folded: &GEAR_33X20_BALL,
    ball_friction: 0.1,
    balls: BALLS as u16,
    turns: 2.0,
    return_length: 0.0,
    screw_deviation: &SCREW_DEVIATION,
    nut_deviation: &NUT_DEVIATION,
    load_shares: LoadShares::EVEN,
    tick: TICK,
};

/// Loads of the balls over their mean, in eight parts of the track: a nut that is pulled at one end.
static SHARES: [LoadShare; 8] = [
    folded(LoadShare::new(1.35)),
    folded(LoadShare::new(1.22)),
    folded(LoadShare::new(1.10)),
    folded(LoadShare::new(1.0)),
    folded(LoadShare::new(0.92)),
    folded(LoadShare::new(0.85)),
    folded(LoadShare::new(0.80)),
    folded(LoadShare::new(0.76)),
];

/// The same with loads of their own for the balls.
pub const UNCAGED_SHARES: UncagedBallScrewConfiguration = UncagedBallScrewConfiguration {
    load_shares: LoadShares::same(&SHARES),
    ..UNCAGED_SCREW
};

/// The same for a range of friction coefficients.
pub const UNCAGED_RANGE: UncagedBallScrewConfiguration<3> = UncagedBallScrewConfiguration {
    folded: &GEAR_33X20_BALL_RANGE,
    ball_friction: UNCAGED_SCREW.ball_friction,
    balls: UNCAGED_SCREW.balls,
    turns: UNCAGED_SCREW.turns,
    return_length: UNCAGED_SCREW.return_length,
    screw_deviation: UNCAGED_SCREW.screw_deviation,
    nut_deviation: UNCAGED_SCREW.nut_deviation,
    load_shares: UNCAGED_SCREW.load_shares,
    tick: UNCAGED_SCREW.tick,
};

/// A carriage on a rail with the balls of Lin 2019, Table 3.3.
pub const CARRIAGE: LinearBearingConfiguration = LinearBearingConfiguration {
    bearing: BEARING,
    friction: 0.1,
    ball_friction: 0.1,
    balls: ROW as u16,
    loaded_length: 0.16,
    return_length: 0.09,
    wavelength: 0.1,
    rail_deviation: &SCREW_DEVIATION,
    carriage_deviation: &NUT_DEVIATION,
    load_shares: &[LoadShare::MEAN],
    reversal_speed: 0.01,
    tick: TICK,
    limits: LinearLimits {
        speed: 3.0,
        load: 5_000.0,
        friction_force: 500.0,
    },
};

/// Efficiency of the present direction, and the torque that friction takes.
#[derive(Clone, Copy, Debug)]
pub struct EfficiencyStep {
    /// Efficiency of the present direction.
    pub efficiency: f32,
    /// Friction torque, N m.
    pub friction_torque: f32,
}

/// The direction of power flow, its rolling efficiency, and the torque about the nut that friction takes
/// from a load torque.
#[inline]
#[must_use]
pub fn efficiency_step(
    screw: &EfficiencyGeometry,
    nut_speed: f32,
    load_torque: f32,
    friction: f32,
) -> EfficiencyStep {
    let drive = if nut_speed * load_torque < 0.0 {
        Drive::BackDriving
    } else {
        Drive::Driving
    };
    let efficiency = match drive {
        Drive::Driving => screw.rolling_efficiency(friction, 0.0),
        Drive::BackDriving => screw.rolling_backdrive_efficiency(friction, 0.0),
    };
    let lost = match drive {
        Drive::Driving => (1.0 - efficiency) / efficiency,
        Drive::BackDriving => efficiency - 1.0,
    };
    EfficiencyStep {
        efficiency,
        friction_torque: load_torque * lost,
    }
}

/// No scene: what start-up and the loop around a scene take alone.
pub struct Empty;

impl Run for Empty {
    const NAME: &'static str = "empty";
    type Model = ();

    fn set_up() -> Result<(), Error> {
        Ok(())
    }

    fn tick((): &mut (), nut_speed: f32, axial_load: f32, digest: &mut Digest) {
        digest.take(&[nut_speed, axial_load]);
    }
}
