//! Each function once as a call of its own, with the arguments in registers as the compiler passes them:
//! what a count finds between the call and the return is the function and nothing else.

// The counts find functions by their symbols, which the linker must keep.
#![allow(unsafe_code)]
// Rust calls Rust here; the C calling convention passes f32 in floating-point registers.
#![allow(improper_ctypes_definitions)]

use epas_friction::adaptation::{Adaptation, AdaptationInputs, Adapted};
use epas_friction::ball::{AnalyticLinearBall, ScrewRow, ScrewTick, ScrewTickBall, SpeedDeviation};
use epas_friction::contact::{FrictionMap, NormalizedFriction};
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature, PrincipalCurvatures,
};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::ContactAngle;
use epas_friction::hertz::{ContactEllipse, HertzContact};
use epas_friction::kinematics::{BallKinematics, ContactKinematics, EllipticContact, SlipRatios};
use epas_friction::law::coefficient::{CoefficientAtTemperature, CoefficientLaw};
use epas_friction::law::memory::{
    LoadExactElements, MemoryState, ParallelElements, ParallelElementsState, PreloadedElements,
    ProportionalElements, SeatElement, SeatState,
};
use epas_friction::law::motion::{
    AngleReading, CountReading, CountSensor, Deadband, DeadbandReading, NutAngle, Play, PlayState,
    SpeedOverTick, WrappedAngle,
};
use epas_friction::law::{Elements, SlidingLimits};
use epas_friction::scene::{
    CagedBallScrew, CagedConstants, UncagedBallScrew, UncagedConstants, WithMemoryInputs,
};
use epas_friction::train::{Press, Train};
use epas_friction::{
    ClosedFormScrew, DeviationMap, FrictionModel, Inputs, LinearBearingTrain, LinearInputs,
    LinearOutputs, LoadProportionalScrew, LoadShare, Outputs, UncagedOutputs, math,
};

use crate::peers::{LuGre, Stribeck};
use crate::remembering::{Carriage, Gear, GearByLaw};
use crate::scenes::{
    BALLS, CagedByLaw, CagedLawConstants, CagedMemory, EfficiencyStep, ROW, efficiency_step,
};

/// Angles and forces of four contacts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourContacts {
    /// Contact angles, rad.
    pub(crate) angles: [f32; 4],
    /// Contact forces, N.
    pub(crate) forces: [f32; 4],
}

macro_rules! counted {
    ($(fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty $body:block)*) => {$(
        #[inline(never)]
        #[unsafe(no_mangle)]
        pub(crate) extern "C" fn $name($($argument: $type),*) -> $result $body
    )*};
}

/// Where start-up ends and what is counted begins.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn counting() {
    // A function that does nothing would be left out.
    core::hint::black_box(());
}

counted! {
    fn count_curvature_literature(form: &LiteratureCurvature, cos: f32, sin: f32) -> f32 {
        form.first(ContactAngle { cos, sin })
    }
    fn count_curvature_circular_groove(form: &CircularGrooveCurvature, cos: f32, sin: f32) -> f32 {
        form.first(ContactAngle { cos, sin })
    }
    fn count_curvature_fitted(form: &FittedCurvature, cos: f32, sin: f32) -> f32 { form.first(ContactAngle { cos, sin }) }
    fn count_curvature_exact(form: &GothicArch, cos: f32, sin: f32) -> PrincipalCurvatures {
        form.principal(ContactAngle { cos, sin })
    }
    fn count_hertz_ellipse(contact: &HertzContact, load: f32) -> ContactEllipse { contact.at(load) }
    fn count_efficiency_rolling(screw: &EfficiencyGeometry, friction: f32, tangent: f32) -> f32 {
        screw.rolling_efficiency(friction, tangent)
    }
    fn count_efficiency_sliding(screw: &EfficiencyGeometry, friction: f32) -> f32 { screw.sliding_efficiency(friction) }
    fn count_efficiency_backdrive(screw: &EfficiencyGeometry, friction: f32) -> f32 {
        screw.sliding_backdrive_efficiency(friction)
    }
    fn count_friction_coefficient(law: &CoefficientAtTemperature, speed: f32) -> f32 { law.at(speed) }
    fn count_friction_coefficient_warming(law: &CoefficientLaw, speed: f32, temperature: f32) -> f32 {
        law.at_temperature(temperature).at(speed)
    }
    fn count_kinematics_update(kinematics: &mut ContactKinematics, screw: &EllipticContact, nut: &EllipticContact) -> bool {
        kinematics.update(*screw, *nut)
    }
    fn count_kinematics_tick(kinematics: &ContactKinematics, speed: f32) -> BallKinematics { kinematics.tick(speed) }
    fn count_kinematics_ratios(kinematics: &ContactKinematics) -> SlipRatios { kinematics.screw().ratios() }
    fn count_adaptation_update(adaptation: &mut Adaptation, inputs: &AdaptationInputs) -> Adapted {
        adaptation.update(inputs)
    }
    fn count_friction_map(map: &FrictionMap, offset: f32) -> NormalizedFriction { map.evaluate(offset) }
    fn count_sqrt(x: f32) -> f32 { math::sqrt(x) }
    fn count_cbrt(x: f32) -> f32 { math::cbrt(x) }
    fn count_cbrt_squared(x: f32) -> f32 { math::cbrt_squared(x) }
    fn count_cbrt_and_squared(x: f32) -> (f32, f32) { math::cbrt_and_squared(x) }
    fn count_sin_cos(x: f32) -> (f32, f32) { math::sin_cos(x) }
    fn count_linear_ball_speed(ball: &AnalyticLinearBall, contacts: &FourContacts) -> SpeedDeviation {
        ball.speed_deviation(&contacts.angles, &contacts.forces)
    }
    fn count_linear_ball_analytic(ball: &AnalyticLinearBall, rear: &FourContacts, front: &FourContacts) -> f32 {
        let rear = ball.speed_deviation(&rear.angles, &rear.forces);
        let front = ball.speed_deviation(&front.angles, &front.forces);
        rear.contact_force(&front)
    }
    fn count_step_efficiency(screw: &EfficiencyGeometry, nut_speed: f32, load_torque: f32, friction: f32) -> EfficiencyStep {
        efficiency_step(screw, nut_speed, load_torque, friction)
    }
    fn count_step_closed_form(model: &mut FrictionModel<ClosedFormScrew>, nut_speed: f32, axial_load: f32) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_load_proportional(model: &mut FrictionModel<LoadProportionalScrew>, nut_speed: f32, axial_load: f32) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_caged(model: &mut FrictionModel<CagedBallScrew>, nut_speed: f32, axial_load: f32) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_caged_range(model: &mut FrictionModel<CagedBallScrew<5>>, nut_speed: f32, axial_load: f32) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_caged_memory(model: &mut FrictionModel<CagedMemory>, inputs: &WithMemoryInputs<Inputs, f32>) -> Outputs {
        model.step(*inputs)
    }
    fn count_step_caged_law(model: &mut FrictionModel<CagedByLaw>, inputs: &WithMemoryInputs<Inputs, f32>) -> Outputs {
        model.step(*inputs)
    }
    fn count_between_caged(model: &mut FrictionModel<CagedMemory>, reading: f32) -> Outputs { model.between(reading) }
    fn count_set_friction_caged(model: &mut FrictionModel<CagedBallScrew<5>, &'static CagedConstants<5>>, friction: f32) -> bool {
        model.set_friction(friction).is_ok()
    }
    fn count_swap_caged(model: &mut FrictionModel<CagedBallScrew, &'static CagedConstants>, constants: &'static CagedConstants) -> bool {
        model.swap_constants(constants).is_ok()
    }
    fn count_start_caged(model: &mut FrictionModel<CagedBallScrew<5>, &'static CagedConstants<5>>, constants: &'static CagedConstants<5>) -> () {
        *model = FrictionModel::of(constants);
    }
    fn count_start_caged_law(model: &mut FrictionModel<CagedByLaw, &'static CagedLawConstants>, constants: &'static CagedLawConstants) -> () {
        *model = FrictionModel::of(constants);
    }
    fn count_set_friction_37(model: &mut FrictionModel<UncagedBallScrew<BALLS, 3>>, friction: f32) -> bool {
        model.set_friction(friction).is_ok()
    }
    fn count_start_37(
        model: &mut FrictionModel<UncagedBallScrew<BALLS>, &'static UncagedConstants<BALLS>>, constants: &'static UncagedConstants<BALLS>
    ) -> () {
        *model = FrictionModel::of(constants);
    }
    fn count_memory_8(elements: &ProportionalElements<8>, state: &mut MemoryState<8>, turn: f32, limits: &SlidingLimits) -> f32 {
        elements.follow(state, turn, limits)
    }
    fn count_memory_load_exact_8(elements: &LoadExactElements<8>, state: &mut MemoryState<8>, turn: f32, limits: &SlidingLimits) -> f32 {
        elements.follow(state, turn, limits)
    }
    fn count_memory_preloaded_10(
        elements: &PreloadedElements<LoadExactElements<10>>, state: &mut MemoryState<10>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        elements.follow(state, turn, limits)
    }
    fn count_memory_together_10(
        both: &ParallelElements<ProportionalElements<4>, ProportionalElements<6>>, state: &mut ParallelElementsState<MemoryState<4>, MemoryState<6>>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        both.follow(state, turn, limits)
    }
    fn count_memory_seat(seat: &SeatElement, state: &mut SeatState, turn: f32, limits: &SlidingLimits) -> f32 {
        seat.follow(state, turn, limits)
    }
    fn count_turn_of_counts(sensor: &CountSensor, last: &mut CountReading, reading: u32) -> f32 {
        sensor.turn(last, reading).angle()
    }
    fn count_turn_of_angles(sensor: &WrappedAngle, last: &mut AngleReading, reading: f32) -> f32 {
        sensor.turn(last, reading).angle()
    }
    fn count_turn_of_speed(sensor: &SpeedOverTick, reading: f32) -> f32 { sensor.turn(&mut (), reading).angle() }
    fn count_turn_steady(sensor: &Deadband<CountSensor>, last: &mut DeadbandReading<CountReading>, reading: u32) -> f32 {
        sensor.turn(last, reading).angle()
    }
    fn count_play(play: &Play, state: &mut PlayState, turn: f32) -> f32 { play.follow(state, turn).turn }
    fn count_deviation_map(map: &DeviationMap, phase: u32) -> f32 { map.at(phase) }
    fn count_ball_screw_row(row: &ScrewRow, nut_speed: f32, load: f32) -> ScrewTick { row.at(nut_speed, load) }
    fn count_ball_screw_ball(row: &ScrewTick, screw: f32, nut: f32, share: &LoadShare) -> ScrewTickBall {
        row.ball(screw, nut, share)
    }
    fn count_press_37(press: &mut Press<BALLS>, free: &[f32; BALLS], impedance: &[f32; BALLS], room: &[f32; BALLS]) -> bool {
        press.solve(free, impedance, room)
    }
    fn count_train_37(train: &mut Train<BALLS>, free: &[f32; BALLS], impedance: &[f32; BALLS], travel: f32) -> bool {
        train.step(free, impedance, travel)
    }
    fn count_step_train_37(model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_train_37_pressing(model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_train_37_shares(model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_train_37_range(model: &mut FrictionModel<UncagedBallScrew<BALLS, 3>>, nut_speed: f32, axial_load: f32) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }
    fn count_step_train_37_memory(model: &mut FrictionModel<Gear>, inputs: &WithMemoryInputs<Inputs, u32>) -> UncagedOutputs {
        model.step(*inputs)
    }
    fn count_step_train_37_memory_pressing(model: &mut FrictionModel<Gear>, inputs: &WithMemoryInputs<Inputs, u32>) -> UncagedOutputs {
        model.step(*inputs)
    }
    fn count_step_train_37_law(model: &mut FrictionModel<GearByLaw>, inputs: &WithMemoryInputs<Inputs, u32>) -> UncagedOutputs {
        model.step(*inputs)
    }
    fn count_between_train_37(model: &mut FrictionModel<Gear>, reading: u32) -> UncagedOutputs { model.between(reading) }
    fn count_step_linear_memory(model: &mut FrictionModel<Carriage>, inputs: &WithMemoryInputs<LinearInputs, f32>) -> LinearOutputs {
        model.step(*inputs)
    }
    fn count_between_linear(model: &mut FrictionModel<Carriage>, reading: f32) -> LinearOutputs { model.between(reading) }
    fn count_step_linear(model: &mut FrictionModel<LinearBearingTrain<ROW>>, speed: f32, normal_load: f32, side_load: f32) -> LinearOutputs {
        model.step(LinearInputs { speed, normal_load, side_load })
    }
    fn count_libm_sqrtf(x: f32) -> f32 { libm::sqrtf(x) }
    fn count_libm_cbrtf(x: f32) -> f32 { libm::cbrtf(x) }
    fn count_libm_cosf(x: f32) -> f32 { libm::cosf(x) }
    fn count_libm_sincosf(x: f32) -> (f32, f32) { libm::sincosf(x) }
    fn count_libm_powf(x: f32) -> f32 { libm::powf(x, 2.0 / 3.0) }
    fn count_micromath_sqrt(x: f32) -> f32 { micromath::F32Ext::sqrt(x) }
    fn count_micromath_cos(x: f32) -> f32 { micromath::F32Ext::cos(x) }
    fn count_micromath_powf(x: f32) -> f32 { micromath::F32Ext::powf(x, 2.0 / 3.0) }
    fn count_idsp_sin_cos(x: f32) -> (f32, f32) {
        let turns = x * (0.5 / core::f32::consts::PI);
        let fraction = turns - turns as i32 as f32;
        let (cos, sin) = idsp::cossin(((fraction * 2_147_483_648.0) as i32).wrapping_mul(2));
        let unit = 1.0 / 2_147_483_648.0;
        (sin as f32 * unit, cos as f32 * unit)
    }
    fn count_lugre_step(model: &mut LuGre, speed: f32) -> f32 { model.step(speed) }
    fn count_stribeck_curve(curve: &Stribeck, speed: f32) -> f32 { curve.torque(speed) }
}
