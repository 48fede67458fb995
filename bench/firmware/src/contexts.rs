//! The designs and states that the functions under test work with.

use core::hint::black_box;

use epas_friction::adaptation::{Adaptation, AdaptationConfiguration};
use epas_friction::ball::{
    AnalyticLinearBall, GrooveFit, LinearBallParameters, PUBLISHED_SLOPE, ScrewRow, ScrewTick,
};
use epas_friction::contact::FrictionMap;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::kinematics::{ContactKinematics, KinematicsParameters};
use epas_friction::law::Elements;
use epas_friction::law::coefficient::{CoefficientAtTemperature, CoefficientLaw};
use epas_friction::law::memory::{
    BackboneElement, LoadExactElements, MemoryState, ParallelElements, ParallelElementsState,
    PreloadedElements, ProportionalElements, SLIP_6, SLIP_8, SPIN_4, SeatElement, SeatState,
};
use epas_friction::law::motion::{
    AngleReading, CountReading, CountSensor, CountSensorParameters, Deadband, DeadbandReading,
    NutAngle, Play, PlayState, SpeedOverTick, WrappedAngle, WrappedAngleParameters,
};
use epas_friction::scene::{CagedBallScrew, CagedConstants, UncagedBallScrew, UncagedConstants};
use epas_friction::train::{Press, Train};
use epas_friction::{
    BallScrew, CATALOGUE, ClosedFormScrew, DeviationMap, Error, FrictionModel, LinearBearingTrain,
    LoadProportionalScrew, defaults,
};

use crate::gears::{GEAR_33X20, GEAR_33X20_RANGE};
use crate::peers::{LuGre, Stribeck};
use crate::remembering::{self, Carriage, Gear, GearByLaw};
use crate::scenes::{
    BALLS, CAGED_BY_LAW, CAGED_WITH_MEMORY, CARRIAGE, CLOSED_FORM, CagedByLaw, CagedLawConstants,
    CagedMemory, LOAD_PROPORTIONAL, ROW, SCREW_DEVIATION, TICK, UNCAGED, UNCAGED_RANGE,
    UNCAGED_SCREW, UNCAGED_SHARES,
};

/// Everything that is set up once.
pub struct Contexts {
    /// Counter of processor cycles; stands still where there is none.
    pub clock: fn() -> u32,
    /// Cycles of the last function run, by that counter.
    pub elapsed: u32,
    pub(crate) literature: LiteratureCurvature,
    pub(crate) circular: CircularGrooveCurvature,
    pub(crate) fitted: FittedCurvature,
    pub(crate) exact: GothicArch,
    pub(crate) hertz: HertzContact,
    pub(crate) efficiency: EfficiencyGeometry,
    pub(crate) kinematics: ContactKinematics,
    pub(crate) map: FrictionMap,
    pub(crate) coefficient: CoefficientLaw,
    pub(crate) at_temperature: CoefficientAtTemperature,
    pub(crate) adaptation: Adaptation,
    pub(crate) analytic: AnalyticLinearBall,
    pub(crate) closed_form: FrictionModel<ClosedFormScrew>,
    pub(crate) load_proportional: FrictionModel<LoadProportionalScrew>,
    pub(crate) caged: FrictionModel<CagedBallScrew>,
    pub(crate) caged_range: FrictionModel<CagedBallScrew<5>>,
    pub(crate) caged_set: FrictionModel<CagedBallScrew<5>, &'static CagedConstants<5>>,
    pub(crate) caged_swapped: FrictionModel<CagedBallScrew, &'static CagedConstants>,
    pub(crate) worn: bool,
    pub(crate) caged_memory: FrictionModel<CagedMemory>,
    pub(crate) caged_law: FrictionModel<CagedByLaw>,
    pub(crate) caged_law_started: FrictionModel<CagedByLaw, &'static CagedLawConstants>,
    pub(crate) deviation: &'static DeviationMap,
    pub(crate) screw_row: ScrewRow,
    pub(crate) screw_tick: ScrewTick,
    pub(crate) press: Press<BALLS>,
    pub(crate) train: Train<BALLS>,
    pub(crate) uncaged: FrictionModel<UncagedBallScrew<BALLS>>,
    pub(crate) uncaged_shares: FrictionModel<UncagedBallScrew<BALLS>>,
    pub(crate) uncaged_range: FrictionModel<UncagedBallScrew<BALLS, 3>>,
    pub(crate) set: FrictionModel<UncagedBallScrew<BALLS, 3>>,
    pub(crate) uncaged_started:
        FrictionModel<UncagedBallScrew<BALLS>, &'static UncagedConstants<BALLS>>,
    pub(crate) pressing: FrictionModel<UncagedBallScrew<BALLS>>,
    pub(crate) gear: FrictionModel<Gear>,
    pub(crate) gear_count: u32,
    pub(crate) gear_pressing: FrictionModel<Gear>,
    pub(crate) gear_pressing_count: u32,
    pub(crate) gear_law: FrictionModel<GearByLaw>,
    pub(crate) gear_law_count: u32,
    pub(crate) carriage_memory: FrictionModel<Carriage>,
    pub(crate) carriage: FrictionModel<LinearBearingTrain<ROW>>,
    pub(crate) proportional: ProportionalElements<8>,
    pub(crate) proportional_state: MemoryState<8>,
    pub(crate) load_exact: LoadExactElements<8>,
    pub(crate) load_exact_state: MemoryState<8>,
    pub(crate) preloaded: PreloadedElements<LoadExactElements<10>>,
    pub(crate) preloaded_state: MemoryState<10>,
    pub(crate) together: ParallelElements<ProportionalElements<4>, ProportionalElements<6>>,
    pub(crate) together_state: ParallelElementsState<MemoryState<4>, MemoryState<6>>,
    pub(crate) seat: SeatElement,
    pub(crate) seat_state: SeatState,
    pub(crate) counts: CountSensor,
    pub(crate) last_count: CountReading,
    pub(crate) angles: WrappedAngle,
    pub(crate) last_angle: AngleReading,
    pub(crate) speeds: SpeedOverTick,
    pub(crate) steady: Deadband<CountSensor>,
    pub(crate) last_steady: DeadbandReading<CountReading>,
    pub(crate) play: Play,
    pub(crate) play_state: PlayState,
    pub(crate) lugre: LuGre,
}

/// Ball radius, m, of the linear bearing of Lin 2019, Table 3.3.
const BALL_RADIUS: f32 = 0.005;

impl Contexts {
    /// Sets everything up.
    pub fn new(clock: fn() -> u32) -> Result<Self, Error> {
        // Through `black_box`, or the compiler would fold the constants into the functions.
        let design: BallScrew = black_box(CATALOGUE[15].design()?);
        let linear_parameters = black_box(LinearBallParameters {
            ball_radius: BALL_RADIUS,
            contact_angle: core::f32::consts::FRAC_PI_4,
            axis_ratio: 0.2321,
            semi_major_coefficient: 9.075e-5,
            friction: 0.1,
        });
        let degree = core::f32::consts::PI / 180.0;
        // The screw of Alberdi et al., Table 2, at 1500 N.
        let kinematics_parameters = black_box(KinematicsParameters {
            ball_diameter: 7.94e-3,
            pitch_radius: 19.25e-3,
            lead_angle: 10.0 * degree,
            groove_radius_screw: 4.2e-3,
            groove_radius_nut: 4.2e-3,
            contact_angle_screw: 41.0 * degree,
            contact_angle_nut: 41.0 * degree,
            pitch_angle: 40.0 * degree,
            yaw_angle: 0.0,
            rolling_radius_screw: 3.97e-3,
            rolling_radius_nut: 3.97e-3,
            semi_major_screw: 0.601e-3,
            semi_minor_screw: 0.083e-3,
            semi_major_nut: 0.586e-3,
            semi_minor_nut: 0.097e-3,
        });
        let coefficient = CoefficientLaw::new(&black_box(defaults::COEFFICIENT))?;
        let screw_row = ScrewRow::new(&design, 0.1, GrooveFit::Zero)?;
        let few = elements(&SPIN_4.elements)?;
        let more = elements(&SLIP_6.elements)?;
        let counts = CountSensor::new(CountSensorParameters {
            period: black_box(16_384),
            turn_per_count: core::f32::consts::TAU / 16_384.0,
            largest_turn: 1.0,
        })?;
        Ok(Self {
            clock,
            elapsed: 0,
            literature: LiteratureCurvature::of(&design, Groove::Screw),
            circular: CircularGrooveCurvature::of(&design, Groove::Screw),
            fitted: FittedCurvature::of(&design, Groove::Screw),
            exact: GothicArch::of(&design, Groove::Screw),
            hertz: HertzContact::of(&design, Groove::Screw),
            efficiency: EfficiencyGeometry::of(&design),
            kinematics: ContactKinematics::new(&kinematics_parameters)?,
            map: FrictionMap::new(black_box(0.2321))?,
            coefficient,
            at_temperature: coefficient.at_temperature(300.0),
            adaptation: Adaptation::new(&black_box(adaptation_configuration()))?,
            analytic: AnalyticLinearBall::new(&linear_parameters, PUBLISHED_SLOPE)?,
            closed_form: FrictionModel::new(&black_box(CLOSED_FORM))?,
            load_proportional: FrictionModel::new(&black_box(LOAD_PROPORTIONAL))?,
            caged: FrictionModel::of(black_box(GEAR_33X20)),
            caged_range: {
                let mut model = FrictionModel::of(black_box(GEAR_33X20_RANGE));
                model.set_friction(0.11)?;
                model
            },
            caged_set: FrictionModel::of(black_box(&GEAR_33X20_RANGE)),
            caged_swapped: FrictionModel::of(black_box(&GEAR_33X20)),
            worn: false,
            caged_memory: FrictionModel::of(black_box(CAGED_WITH_MEMORY)),
            caged_law: FrictionModel::of(black_box(CAGED_BY_LAW)),
            caged_law_started: FrictionModel::of(black_box(&CAGED_BY_LAW)),
            deviation: &SCREW_DEVIATION,
            screw_tick: screw_row.at(10.0, 100.0),
            screw_row,
            press: Press::new(),
            train: Train::evenly_spaced(0.2248, 0.00594, BALLS)?,
            uncaged: FrictionModel::new(&black_box(UNCAGED_SCREW))?,
            uncaged_shares: FrictionModel::new(&black_box(UNCAGED_SHARES))?,
            uncaged_range: {
                let mut model = FrictionModel::new(&black_box(UNCAGED_RANGE))?;
                model.set_friction(0.09)?;
                model
            },
            set: FrictionModel::new(&black_box(UNCAGED_RANGE))?,
            uncaged_started: FrictionModel::of(black_box(&UNCAGED)),
            pressing: pressing(FrictionModel::new(&black_box(UNCAGED_SCREW))?),
            gear: FrictionModel::new(&black_box(remembering::gear_configuration()?))?,
            gear_count: 0,
            gear_pressing: remembering::pressing(FrictionModel::new(&black_box(
                remembering::gear_configuration()?,
            ))?),
            gear_pressing_count: remembering::PRESSING_COUNT,
            gear_law: FrictionModel::new(&black_box(remembering::gear_law_configuration()?))?,
            gear_law_count: 0,
            carriage_memory: FrictionModel::new(
                &black_box(remembering::carriage_configuration()?),
            )?,
            carriage: FrictionModel::new(&black_box(CARRIAGE))?,
            proportional: elements(&SLIP_8.elements)?,
            proportional_state: ProportionalElements::VIRGIN,
            load_exact: LoadExactElements::new(black_box(0.04), 2e-3, 4.0)?,
            load_exact_state: LoadExactElements::VIRGIN,
            preloaded: PreloadedElements::new(LoadExactElements::new(black_box(0.04), 2e-3, 4.0)?),
            preloaded_state: LoadExactElements::VIRGIN,
            together: ParallelElements::new(few, more, black_box(0.3))?,
            together_state: ParallelElementsState {
                first: ProportionalElements::VIRGIN,
                second: ProportionalElements::VIRGIN,
            },
            seat: SeatElement::new(black_box(0.04), 1e-3, 2e-3)?,
            seat_state: SeatElement::VIRGIN,
            counts,
            last_count: CountSensor::FRESH,
            angles: WrappedAngle::new(WrappedAngleParameters {
                lowest: black_box(0.0),
                period: core::f32::consts::TAU,
                largest_turn: 1.0,
            })?,
            last_angle: WrappedAngle::FRESH,
            speeds: SpeedOverTick::new(black_box(TICK), 1.0)?,
            steady: Deadband::new(counts, black_box(1e-3))?,
            last_steady: Deadband::<CountSensor>::FRESH,
            play: Play::new(black_box(1e-3))?,
            play_state: PlayState::FRESH,
            lugre: black_box(LuGre {
                stribeck: Stribeck {
                    coulomb: 0.3,
                    excess: 0.1,
                    inverse_speed: 2.0,
                    viscous: 1e-3,
                },
                stiffness: 300.0,
                damping: 0.5,
                period: 5e-5,
                deflection: 0.0,
            }),
        })
    }
}

/// Elements that slide under 0.04 N m after 2 mrad.
fn elements<const N: usize>(
    backbone: &'static [BackboneElement],
) -> Result<ProportionalElements<N>, Error> {
    crate::scenes::elements(backbone, black_box(0.04), 2e-3)
}

/// Levels, drag, offset and the load's gain every 10 ms.
const fn adaptation_configuration() -> AdaptationConfiguration {
    AdaptationConfiguration {
        drag_deviation: 2e-4,
        largest_drag: 2e-3,
        offset_deviation: 5e-3,
        largest_offset: 0.05,
        ..AdaptationConfiguration::every(0.01)
    }
}

/// A ball screw that has turned with its load falling.
fn pressing(
    mut model: FrictionModel<UncagedBallScrew<BALLS>>,
) -> FrictionModel<UncagedBallScrew<BALLS>> {
    for inputs in remembering::falling() {
        let _ = model.step(inputs);
    }
    model
}
