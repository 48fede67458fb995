//! Every exported function, and the only file with pointers.
//!
//! A pointer is checked for NULL and alignment; an object that the library has to have initialised carries
//! a mark that is checked. What cannot be checked is the caller's: that a pointer points to an object of its
//! type, that nobody else uses the object during the call, and that tables stay for as long as a model that
//! was given them.

#![allow(unsafe_code)]
// What the caller owes stands in the module's documentation, for all functions alike.
#![allow(clippy::missing_safety_doc)]

use core::ffi::c_char;
use core::slice;

use epas_friction::scene::Scene;
use epas_friction::{DeviationMap, LoadShare as CrateLoadShare};

use crate::caged::Caged;
use crate::linear::Linear;
use crate::one_shot;
use crate::scene::{CScene, Placed, TablePointers, Tables, model};
use crate::screw::Screw;
use crate::status::{
    EPAS_FIELD_LOAD_SHARE_COUNT, EPAS_FIELD_LOAD_SHARES, EPAS_FIELD_NONE, EPAS_FIELD_OWN_DEVIATION,
    EPAS_FIELD_PASSING_DEVIATION, EPAS_MISALIGNED, EPAS_NOT_INITIALISED, EPAS_NULL_POINTER,
    EPAS_OK, Failure, field_name, status_name,
};
use crate::tables::{
    Deviation, EPAS_DEVIATION_SAMPLES, EPAS_LARGEST_HARMONIC_COUNT, EPAS_LARGEST_SHARE_COUNT,
    Harmonic, LoadShare, PlacedDeviation, deviation_of_harmonics, deviation_of_samples,
    harmonic_count, is_load_share, load_share,
};
use crate::types::{
    CagedConfiguration, CagedPlace, Curvature, CurvatureRequest, EPAS_ABI_VERSION, Efficiency,
    EfficiencyRequest, Inputs, LinearConfiguration, LinearInputs, LinearPlace, Outputs,
    ScrewConfiguration, ScrewPlace, TrainOutputs,
};

/// A panic has nowhere to go. The function that it calls exists nowhere, so that whatever links this library
/// has proved that no panic can be reached.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn epas_friction_has_a_panic_path() -> !;
    }
    unsafe { epas_friction_has_a_panic_path() }
}

/// A pointer's status.
fn usable<T>(pointer: *const T) -> Result<(), u32> {
    if pointer.is_null() {
        Err(EPAS_NULL_POINTER)
    } else if pointer.is_aligned() {
        Ok(())
    } else {
        Err(EPAS_MISALIGNED)
    }
}

/// What a pointer points to.
unsafe fn read<T: Copy>(pointer: *const T) -> Result<T, u32> {
    usable(pointer)?;
    Ok(unsafe { pointer.read() })
}

/// The model in a place, if it is this scene's.
unsafe fn placed<'a, C: CScene>(place: *mut C::Place) -> Result<&'a mut Placed<C::Scene>, u32> {
    let () = C::FITS;
    usable(place)?;
    let place = place.cast::<Placed<C::Scene>>();
    if unsafe { (&raw const (*place).mark).read() } == C::MARK {
        Ok(unsafe { &mut *place })
    } else {
        Err(EPAS_NOT_INITIALISED)
    }
}

/// Ends a function that says what was wrong, to the caller and in `failure`, if there is one.
unsafe fn report(outcome: Result<(), Failure>, failure: *mut Failure) -> u32 {
    let found = match outcome {
        Ok(()) => Failure::NONE,
        Err(found) => found,
    };
    if usable(failure).is_ok() {
        unsafe { failure.write(found) };
    }
    found.status
}

const fn bare(status: u32) -> Failure {
    Failure::pointer(status, EPAS_FIELD_NONE)
}

/// A deviation that a configuration points to.
unsafe fn deviation(
    pointer: *const Deviation,
    field: u32,
) -> Result<&'static DeviationMap, Failure> {
    if pointer.is_null() {
        return Ok(Tables::NONE.passing);
    }
    usable(pointer).map_err(|status| Failure::pointer(status, field))?;
    let placed = pointer.cast::<PlacedDeviation>();
    if unsafe { (&raw const (*placed).mark).read() } == PlacedDeviation::MARK {
        Ok(unsafe { &(*placed).map })
    } else {
        Err(Failure::pointer(EPAS_NOT_INITIALISED, field))
    }
}

/// Shares of the load that a configuration points to.
unsafe fn load_shares(
    pointer: *const LoadShare,
    count: u32,
) -> Result<&'static [CrateLoadShare], Failure> {
    if pointer.is_null() {
        return Ok(Tables::NONE.load_shares);
    }
    usable(pointer).map_err(|status| Failure::pointer(status, EPAS_FIELD_LOAD_SHARES))?;
    let length = share_count(count)?;
    let shares = unsafe { slice::from_raw_parts(pointer.cast::<CrateLoadShare>(), length) };
    match (0..).zip(shares).find(|(_, share)| !is_load_share(**share)) {
        None => Ok(shares),
        Some((index, _)) => Err(Failure {
            index,
            ..Failure::pointer(EPAS_NOT_INITIALISED, EPAS_FIELD_LOAD_SHARES)
        }),
    }
}

fn share_count(count: u32) -> Result<usize, Failure> {
    let refused = Failure::count(
        EPAS_FIELD_LOAD_SHARE_COUNT,
        count,
        1,
        EPAS_LARGEST_SHARE_COUNT,
    );
    if (1..=EPAS_LARGEST_SHARE_COUNT).contains(&count) {
        usize::try_from(count).map_err(|_| refused)
    } else {
        Err(refused)
    }
}

/// The tables of a configuration. A scene that has none does not link what checks them.
#[inline(always)]
unsafe fn tables(pointers: &TablePointers) -> Result<Tables, Failure> {
    if pointers.are_null() {
        Ok(Tables::NONE)
    } else {
        unsafe { pointed_tables(pointers) }
    }
}

#[inline(never)]
unsafe fn pointed_tables(pointers: &TablePointers) -> Result<Tables, Failure> {
    Ok(Tables {
        passing: unsafe { deviation(pointers.passing, EPAS_FIELD_PASSING_DEVIATION) }?,
        own: unsafe { deviation(pointers.own, EPAS_FIELD_OWN_DEVIATION) }?,
        load_shares: unsafe { load_shares(pointers.load_shares, pointers.load_share_count) }?,
    })
}

unsafe fn init<C: CScene>(
    place: *mut C::Place,
    configuration: *const C::Configuration,
    failure: *mut Failure,
) -> u32 {
    let () = C::FITS;
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<Placed<C::Scene>>();
        // A place whose configuration is refused holds no model.
        unsafe { (&raw mut (*place).mark).write(0) };
        usable(configuration).map_err(bare)?;
        let configuration = unsafe { &*configuration };
        let tables = unsafe { tables(&C::tables(configuration)) }?;
        let model = model::<C>(configuration, tables)?;
        unsafe { (&raw mut (*place).model).write(model) };
        unsafe { (&raw mut (*place).mark).write(C::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

#[inline(always)]
unsafe fn step<C: CScene>(
    place: *mut C::Place,
    inputs: *const C::Inputs,
    outputs: *mut C::Outputs,
) -> u32 {
    if let Err(status) = usable(outputs) {
        return status;
    }
    let ready = unsafe { placed::<C>(place) }
        .and_then(|placed| Ok((&mut placed.model, unsafe { read(inputs) }?)));
    let (answer, status) = match ready {
        Ok((model, inputs)) => (C::outputs(model.step(C::inputs(inputs))), EPAS_OK),
        Err(status) => (C::REFUSED, status),
    };
    unsafe { outputs.write(answer) };
    status
}

unsafe fn reset<C: CScene>(place: *mut C::Place) -> u32 {
    match unsafe { placed::<C>(place) } {
        Ok(placed) => {
            placed.model.reset();
            EPAS_OK
        }
        Err(status) => status,
    }
}

unsafe fn faulted_ticks<C: CScene>(
    place: *const C::Place,
    ticks: *mut u32,
    counter: fn(&<C::Scene as Scene>::State) -> u32,
) -> u32 {
    if let Err(status) = usable(ticks) {
        return status;
    }
    // Only read.
    match unsafe { placed::<C>(place.cast_mut()) } {
        Ok(placed) => {
            unsafe { ticks.write(counter(placed.model.state())) };
            EPAS_OK
        }
        Err(status) => status,
    }
}

unsafe fn one_shot<Request, Answer>(
    request: *const Request,
    answer: *mut Answer,
    failure: *mut Failure,
    function: fn(&Request) -> Result<Answer, Failure>,
) -> u32 {
    let outcome = usable(answer).map_err(bare).and_then(|()| {
        usable(request).map_err(bare)?;
        let found = function(unsafe { &*request })?;
        unsafe { answer.write(found) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

unsafe fn place_deviation(
    place: *mut Deviation,
    failure: *mut Failure,
    make: impl FnOnce() -> Result<DeviationMap, Failure>,
) -> u32 {
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<PlacedDeviation>();
        unsafe { (&raw mut (*place).mark).write(0) };
        let map = make()?;
        unsafe { (&raw mut (*place).map).write(map) };
        unsafe { (&raw mut (*place).mark).write(PlacedDeviation::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

/// Version of the library: the header's where it equals `EPAS_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn epas_abi_version() -> u32 {
    EPAS_ABI_VERSION
}

/// Name of a field as it is written in C, for a diagnostic message; empty for no field. Never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn epas_field_name(field: u32) -> *const c_char {
    field_name(field).as_ptr()
}

/// Name of a status, for a diagnostic message. Never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn epas_status_name(status: u32) -> *const c_char {
    status_name(status).as_ptr()
}

/// Makes a deviation, with a period of `turns` turns (1 to 100), of `count` waves (0 to
/// `EPAS_LARGEST_HARMONIC_COUNT`). Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_deviation_from_harmonics(
    place: *mut Deviation,
    turns: u32,
    harmonics: *const Harmonic,
    count: u32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        if count > EPAS_LARGEST_HARMONIC_COUNT {
            return Err(harmonic_count(count));
        }
        if count == 0 {
            return deviation_of_harmonics(turns, &[]);
        }
        usable(harmonics).map_err(bare)?;
        let count = usize::try_from(count).unwrap_or(0);
        deviation_of_harmonics(turns, unsafe { slice::from_raw_parts(harmonics, count) })
    };
    unsafe { place_deviation(place, failure, make) }
}

/// Makes a deviation, with a period of `turns` turns (1 to 100), of `EPAS_DEVIATION_SAMPLES` samples at equal
/// distances from its start, rad, -0.2 to 0.2. Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_deviation_from_samples(
    place: *mut Deviation,
    turns: u32,
    samples: *const f32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        let samples = samples.cast::<[f32; EPAS_DEVIATION_SAMPLES]>();
        usable(samples).map_err(bare)?;
        deviation_of_samples(turns, unsafe { &*samples })
    };
    unsafe { place_deviation(place, failure, make) }
}

/// Folds `count` shares of the load (1 to `EPAS_LARGEST_SHARE_COUNT`), each a ball's load over the mean load,
/// 0.01 to 100. Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_load_shares_init(
    places: *mut LoadShare,
    shares: *const f32,
    count: u32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        usable(places).map_err(bare)?;
        usable(shares).map_err(bare)?;
        let length = share_count(count)?;
        let places = places.cast::<CrateLoadShare>();
        for (index, number) in (0..length).zip(0..) {
            let share = unsafe { shares.add(index).read() };
            unsafe { places.add(index).write(load_share(number, share)?) };
        }
        Ok(())
    };
    unsafe { report(make(), failure) }
}

/// Makes a caged ball screw in the place. Set-up only. Where it fails, every step is refused until it
/// succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_init(
    place: *mut CagedPlace,
    configuration: *const CagedConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Caged>(place, configuration, failure) }
}

/// One tick: bounded time, finite outputs whatever the inputs are. Where the call is refused the outputs are
/// no torque and `EPAS_FAULT_CALL`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_step(
    place: *mut CagedPlace,
    inputs: *const Inputs,
    outputs: *mut Outputs,
) -> u32 {
    unsafe { step::<Caged>(place, inputs, outputs) }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_reset(place: *mut CagedPlace) -> u32 {
    unsafe { reset::<Caged>(place) }
}

/// Consecutive ticks whose outputs were flagged; 0 after a sound tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_faulted_ticks(
    place: *const CagedPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Caged>(place, ticks, |state| state.faulted_ticks) }
}

/// Makes a ball screw of `EPAS_SCREW_BALLS` balls in the place. Set-up only. Where it fails, every step is
/// refused until it succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_init(
    place: *mut ScrewPlace,
    configuration: *const ScrewConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Screw>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_step(
    place: *mut ScrewPlace,
    inputs: *const Inputs,
    outputs: *mut TrainOutputs,
) -> u32 {
    unsafe { step::<Screw>(place, inputs, outputs) }
}

/// Sets the angle of the nut against the screw, rad, from which the screw's deviations are counted: once after
/// start-up, and again whenever an absolute sensor has it; between, the model integrates the speed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_set_nut_angle(place: *mut ScrewPlace, angle: f32) -> u32 {
    match unsafe { placed::<Screw>(place) } {
        Ok(placed) => {
            placed.model.set_nut_angle(angle);
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_reset(place: *mut ScrewPlace) -> u32 {
    unsafe { reset::<Screw>(place) }
}

/// Consecutive ticks whose outputs were flagged; 0 after a sound tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_faulted_ticks(
    place: *const ScrewPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Screw>(place, ticks, |state| state.faulted_ticks) }
}

/// Makes a linear bearing of `EPAS_LINEAR_BALLS` balls in the place. Set-up only. Where it fails, every step is
/// refused until it succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_init(
    place: *mut LinearPlace,
    configuration: *const LinearConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Linear>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_step(
    place: *mut LinearPlace,
    inputs: *const LinearInputs,
    outputs: *mut TrainOutputs,
) -> u32 {
    unsafe { step::<Linear>(place, inputs, outputs) }
}

/// Sets the carriage's place along the rail, m, from which the rail's deviations are counted: once after start-up, and
/// again whenever an absolute sensor has it; between, the model integrates the speed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_set_carriage_position(
    place: *mut LinearPlace,
    position: f32,
) -> u32 {
    match unsafe { placed::<Linear>(place) } {
        Ok(placed) => {
            placed.model.set_carriage_position(position);
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_reset(place: *mut LinearPlace) -> u32 {
    unsafe { reset::<Linear>(place) }
}

/// Consecutive ticks whose outputs were flagged; 0 after a sound tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_faulted_ticks(
    place: *const LinearPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Linear>(place, ticks, |state| state.faulted_ticks) }
}

/// Efficiency of a ball screw in closed form. No state: safe from any context. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_efficiency(
    request: *const EfficiencyRequest,
    answer: *mut Efficiency,
    failure: *mut Failure,
) -> u32 {
    unsafe { one_shot(request, answer, failure, one_shot::efficiency) }
}

/// Principal curvatures of a groove. It checks the whole design at each call; no state: safe from any
/// context. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_curvature(
    request: *const CurvatureRequest,
    answer: *mut Curvature,
    failure: *mut Failure,
) -> u32 {
    unsafe { one_shot(request, answer, failure, one_shot::curvature) }
}
