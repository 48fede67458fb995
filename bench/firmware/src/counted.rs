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
pub struct FourContacts {
    /// Contact angles, rad.
    pub angles: [f32; 4],
    /// Contact forces, N.
    pub forces: [f32; 4],
}

macro_rules! counted {
    ($($(#[$meta:meta])* fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty $body:block)*) => {$(
        $(#[$meta])*
        #[inline(never)]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: $type),*) -> $result $body
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
    /// Literature formula of the first curvature.
    fn count_curvature_literature(form: &LiteratureCurvature, cos: f32, sin: f32) -> f32 {
        form.first(ContactAngle { cos, sin })
    }

    /// First curvature of a circular groove.
    fn count_curvature_circular_groove(form: &CircularGrooveCurvature, cos: f32, sin: f32) -> f32 {
        form.first(ContactAngle { cos, sin })
    }

    /// Fitted first curvature.
    fn count_curvature_fitted(form: &FittedCurvature, cos: f32, sin: f32) -> f32 {
        form.first(ContactAngle { cos, sin })
    }

    /// Both exact curvatures.
    fn count_curvature_exact(form: &GothicArch, cos: f32, sin: f32) -> PrincipalCurvatures {
        form.principal(ContactAngle { cos, sin })
    }

    /// Contact ellipse under a load.
    fn count_hertz_ellipse(contact: &HertzContact, load: f32) -> ContactEllipse {
        contact.at(load)
    }

    /// Rolling efficiency.
    fn count_efficiency_rolling(screw: &EfficiencyGeometry, friction: f32, tangent: f32) -> f32 {
        screw.rolling_efficiency(friction, tangent)
    }

    /// Full-sliding efficiency.
    fn count_efficiency_sliding(screw: &EfficiencyGeometry, friction: f32) -> f32 {
        screw.sliding_efficiency(friction)
    }

    /// Full-sliding efficiency of back-driving.
    fn count_efficiency_backdrive(screw: &EfficiencyGeometry, friction: f32) -> f32 {
        screw.sliding_backdrive_efficiency(friction)
    }

    /// Friction coefficient by speed.
    fn count_friction_coefficient(law: &CoefficientAtTemperature, speed: f32) -> f32 {
        law.at(speed)
    }

    /// The same with a new temperature.
    fn count_friction_coefficient_warming(law: &CoefficientLaw, speed: f32, temperature: f32) -> f32 {
        law.at_temperature(temperature).at(speed)
    }

    /// New contact angles and ellipses.
    fn count_kinematics_update(
        kinematics: &mut ContactKinematics, screw: &EllipticContact, nut: &EllipticContact
    ) -> bool {
        kinematics.update(*screw, *nut)
    }

    /// Motion and slip at a speed.
    fn count_kinematics_tick(kinematics: &ContactKinematics, speed: f32) -> BallKinematics {
        kinematics.tick(speed)
    }

    /// Speed-free ratios of one contact.
    fn count_kinematics_ratios(kinematics: &ContactKinematics) -> SlipRatios {
        kinematics.screw().ratios()
    }

    /// A tick of the friction level that follows the vehicle.
    fn count_adaptation_update(adaptation: &mut Adaptation, inputs: &AdaptationInputs) -> Adapted {
        adaptation.update(inputs)
    }

    /// Friction of one contact by its offset ratio.
    fn count_friction_map(map: &FrictionMap, offset: f32) -> NormalizedFriction {
        map.evaluate(offset)
    }

    /// Square root.
    fn count_sqrt(x: f32) -> f32 {
        math::sqrt(x)
    }

    /// Cube root.
    fn count_cbrt(x: f32) -> f32 {
        math::cbrt(x)
    }

    /// Square of the cube root.
    fn count_cbrt_squared(x: f32) -> f32 {
        math::cbrt_squared(x)
    }

    /// Cube root and its square.
    fn count_cbrt_and_squared(x: f32) -> (f32, f32) {
        math::cbrt_and_squared(x)
    }

    /// Sine and cosine.
    fn count_sin_cos(x: f32) -> (f32, f32) {
        math::sin_cos(x)
    }

    /// One ball by the published closed form.
    fn count_linear_ball_speed(ball: &AnalyticLinearBall, contacts: &FourContacts) -> SpeedDeviation {
        ball.speed_deviation(&contacts.angles, &contacts.forces)
    }

    /// Two balls by the published closed form, and the force between them.
    fn count_linear_ball_analytic(
        ball: &AnalyticLinearBall, rear: &FourContacts, front: &FourContacts
    ) -> f32 {
        let rear = ball.speed_deviation(&rear.angles, &rear.forces);
        let front = ball.speed_deviation(&front.angles, &front.forces);
        rear.contact_force(&front)
    }

    /// One tick of firmware that knows the efficiency alone.
    fn count_step_efficiency(
        screw: &EfficiencyGeometry, nut_speed: f32, load_torque: f32, friction: f32
    ) -> EfficiencyStep {
        efficiency_step(screw, nut_speed, load_torque, friction)
    }

    /// One tick of a ball screw by a closed form.
    fn count_step_closed_form(
        model: &mut FrictionModel<ClosedFormScrew>, nut_speed: f32, axial_load: f32
    ) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// One tick of a drive without a drawing.
    fn count_step_load_proportional(
        model: &mut FrictionModel<LoadProportionalScrew>, nut_speed: f32, axial_load: f32
    ) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// One tick of a caged ball screw.
    fn count_step_caged(
        model: &mut FrictionModel<CagedBallScrew>, nut_speed: f32, axial_load: f32
    ) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// One tick of a caged ball screw whose friction coefficient lies between two nodes.
    fn count_step_caged_range(
        model: &mut FrictionModel<CagedBallScrew<5>>, nut_speed: f32, axial_load: f32
    ) -> Outputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// One tick of a caged ball screw with a memory.
    fn count_step_caged_memory(
        model: &mut FrictionModel<CagedMemory>, inputs: &WithMemoryInputs<Inputs, f32>
    ) -> Outputs {
        model.step(*inputs)
    }

    /// The same with a friction coefficient by speed and temperature.
    fn count_step_caged_law(
        model: &mut FrictionModel<CagedByLaw>, inputs: &WithMemoryInputs<Inputs, f32>
    ) -> Outputs {
        model.step(*inputs)
    }

    /// Friction between two steps of a caged ball screw.
    fn count_between_caged(
        model: &mut FrictionModel<CagedMemory>, reading: f32
    ) -> Outputs {
        model.between(reading)
    }

    /// A new friction coefficient of a caged ball screw.
    fn count_set_friction_caged(
        model: &mut FrictionModel<CagedBallScrew<5>, &'static CagedConstants<5>>, friction: f32
    ) -> bool {
        model.set_friction(friction).is_ok()
    }

    /// Another block of a caged ball screw, as for another clearance.
    fn count_swap_caged(
        model: &mut FrictionModel<CagedBallScrew, &'static CagedConstants>, constants: &'static CagedConstants
    ) -> bool {
        model.swap_constants(constants).is_ok()
    }

    /// A caged ball screw from its constants to its first tick.
    fn count_start_caged(
        model: &mut FrictionModel<CagedBallScrew<5>, &'static CagedConstants<5>>,
        constants: &'static CagedConstants<5>
    ) -> () {
        *model = FrictionModel::of(constants);
    }

    /// The same with a memory, and a friction coefficient by speed and temperature.
    fn count_start_caged_law(
        model: &mut FrictionModel<CagedByLaw, &'static CagedLawConstants>, constants: &'static CagedLawConstants
    ) -> () {
        *model = FrictionModel::of(constants);
    }

    /// A new friction coefficient of 37 balls that run.
    fn count_set_friction_37(
        model: &mut FrictionModel<UncagedBallScrew<BALLS, 3>>, friction: f32
    ) -> bool {
        model.set_friction(friction).is_ok()
    }

    /// A ball screw without cage from its constants to its first tick.
    fn count_start_37(
        model: &mut FrictionModel<UncagedBallScrew<BALLS>, &'static UncagedConstants<BALLS>>,
        constants: &'static UncagedConstants<BALLS>
    ) -> () {
        *model = FrictionModel::of(constants);
    }

    /// One tick of elements in proportion.
    fn count_memory_8(
        elements: &ProportionalElements<8>, state: &mut MemoryState<8>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        elements.follow(state, turn, limits)
    }

    /// One tick of elements that touch by load.
    fn count_memory_load_exact_8(
        elements: &LoadExactElements<8>, state: &mut MemoryState<8>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        elements.follow(state, turn, limits)
    }

    /// One tick of elements that touch by the load of both flanks.
    fn count_memory_preloaded_10(
        elements: &PreloadedElements<LoadExactElements<10>>, state: &mut MemoryState<10>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        elements.follow(state, turn, limits)
    }

    /// One tick of four elements beside six.
    fn count_memory_together_10(
        both: &ParallelElements<ProportionalElements<4>, ProportionalElements<6>>,
        state: &mut ParallelElementsState<MemoryState<4>, MemoryState<6>>, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        both.follow(state, turn, limits)
    }

    /// One tick of a seat.
    fn count_memory_seat(
        seat: &SeatElement, state: &mut SeatState, turn: f32, limits: &SlidingLimits
    ) -> f32 {
        seat.follow(state, turn, limits)
    }

    /// Turn between two counts of an encoder.
    fn count_turn_of_counts(sensor: &CountSensor, last: &mut CountReading, reading: u32) -> f32 {
        sensor.turn(last, reading).angle()
    }

    /// Turn between two angles.
    fn count_turn_of_angles(sensor: &WrappedAngle, last: &mut AngleReading, reading: f32) -> f32 {
        sensor.turn(last, reading).angle()
    }

    /// Turn from a speed.
    fn count_turn_of_speed(sensor: &SpeedOverTick, reading: f32) -> f32 {
        sensor.turn(&mut (), reading).angle()
    }

    /// Turn between two counts behind a play.
    fn count_turn_steady(
        sensor: &Deadband<CountSensor>, last: &mut DeadbandReading<CountReading>, reading: u32
    ) -> f32 {
        sensor.turn(last, reading).angle()
    }

    /// What a play lets through.
    fn count_play(play: &Play, state: &mut PlayState, turn: f32) -> f32 {
        play.follow(state, turn).turn
    }

    /// Deviation of a contact angle along a groove.
    fn count_deviation_map(map: &DeviationMap, phase: u32) -> f32 {
        map.at(phase)
    }

    /// A row of balls under one load.
    fn count_ball_screw_row(row: &ScrewRow, nut_speed: f32, load: f32) -> ScrewTick {
        row.at(nut_speed, load)
    }

    /// One ball of a row.
    fn count_ball_screw_ball(
        row: &ScrewTick, screw: f32, nut: f32, share: &LoadShare
    ) -> ScrewTickBall {
        row.ball(screw, nut, share)
    }

    /// Forces between balls that all touch, from given speeds and impedances.
    fn count_press_37(
        press: &mut Press<BALLS>, free: &[f32; BALLS], impedance: &[f32; BALLS], room: &[f32; BALLS]
    ) -> bool {
        press.solve(free, impedance, room)
    }

    /// Forces between the balls of a train from given speeds and impedances, and where the balls go.
    fn count_train_37(
        train: &mut Train<BALLS>, free: &[f32; BALLS], impedance: &[f32; BALLS], travel: f32
    ) -> bool {
        train.step(free, impedance, travel)
    }

    /// One tick of a ball screw with 37 balls without cage.
    fn count_step_train_37(
        model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32
    ) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// The same, where most balls press on each other.
    fn count_step_train_37_pressing(
        model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32
    ) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// The same with loads of their own for the balls.
    fn count_step_train_37_shares(
        model: &mut FrictionModel<UncagedBallScrew<BALLS>>, nut_speed: f32, axial_load: f32
    ) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// The same with a friction coefficient between two nodes.
    fn count_step_train_37_range(
        model: &mut FrictionModel<UncagedBallScrew<BALLS, 3>>, nut_speed: f32, axial_load: f32
    ) -> UncagedOutputs {
        model.step(Inputs { nut_speed, axial_load })
    }

    /// One tick of 37 balls without cage with a memory.
    fn count_step_train_37_memory(
        model: &mut FrictionModel<Gear>, inputs: &WithMemoryInputs<Inputs, u32>
    ) -> UncagedOutputs {
        model.step(*inputs)
    }

    /// The same, where most balls press on each other.
    fn count_step_train_37_memory_pressing(
        model: &mut FrictionModel<Gear>, inputs: &WithMemoryInputs<Inputs, u32>
    ) -> UncagedOutputs {
        model.step(*inputs)
    }

    /// The same with a friction coefficient by speed and temperature.
    fn count_step_train_37_law(
        model: &mut FrictionModel<GearByLaw>, inputs: &WithMemoryInputs<Inputs, u32>
    ) -> UncagedOutputs {
        model.step(*inputs)
    }

    /// Friction between two of its steps.
    fn count_between_train_37(model: &mut FrictionModel<Gear>, reading: u32) -> UncagedOutputs {
        model.between(reading)
    }

    /// One tick of a linear bearing with a memory.
    fn count_step_linear_memory(
        model: &mut FrictionModel<Carriage>, inputs: &WithMemoryInputs<LinearInputs, f32>
    ) -> LinearOutputs {
        model.step(*inputs)
    }

    /// Friction between two of its steps.
    fn count_between_linear(model: &mut FrictionModel<Carriage>, reading: f32) -> LinearOutputs {
        model.between(reading)
    }

    /// One tick of a linear bearing.
    fn count_step_linear(
        model: &mut FrictionModel<LinearBearingTrain<ROW>>, speed: f32, normal_load: f32, side_load: f32
    ) -> LinearOutputs {
        model.step(LinearInputs { speed, normal_load, side_load })
    }

    /// `libm`'s square root.
    fn count_libm_sqrtf(x: f32) -> f32 {
        libm::sqrtf(x)
    }

    /// `libm`'s cube root.
    fn count_libm_cbrtf(x: f32) -> f32 {
        libm::cbrtf(x)
    }

    /// `libm`'s cosine.
    fn count_libm_cosf(x: f32) -> f32 {
        libm::cosf(x)
    }

    /// `libm`'s sine and cosine.
    fn count_libm_sincosf(x: f32) -> (f32, f32) {
        libm::sincosf(x)
    }

    /// `libm`'s power, as it would serve for a deflection.
    fn count_libm_powf(x: f32) -> f32 {
        libm::powf(x, 2.0 / 3.0)
    }

    /// `micromath`'s square root.
    fn count_micromath_sqrt(x: f32) -> f32 {
        micromath::F32Ext::sqrt(x)
    }

    /// `micromath`'s cosine.
    fn count_micromath_cos(x: f32) -> f32 {
        micromath::F32Ext::cos(x)
    }

    /// `micromath`'s power.
    fn count_micromath_powf(x: f32) -> f32 {
        micromath::F32Ext::powf(x, 2.0 / 3.0)
    }

    /// `idsp`'s sine and cosine of a table, with the angle to and the results from integers.
    fn count_idsp_sin_cos(x: f32) -> (f32, f32) {
        let turns = x * (0.5 / core::f32::consts::PI);
        let fraction = turns - turns as i32 as f32;
        let (cos, sin) = idsp::cossin(((fraction * 2_147_483_648.0) as i32).wrapping_mul(2));
        let unit = 1.0 / 2_147_483_648.0;
        (sin as f32 * unit, cos as f32 * unit)
    }

    /// One step of the LuGre model.
    fn count_lugre_step(model: &mut LuGre, speed: f32) -> f32 {
        model.step(speed)
    }

    /// A Stribeck curve.
    fn count_stribeck_curve(curve: &Stribeck, speed: f32) -> f32 {
        curve.torque(speed)
    }
}
