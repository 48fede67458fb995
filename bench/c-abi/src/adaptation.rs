//! A friction level that follows the vehicle: its structures in C, and what they are in the crate.

use epas_friction::adaptation::{
    Adaptation, AdaptationConfiguration as CrateConfiguration, AdaptationConstants,
    AdaptationInputs as CrateInputs, Adapted, HealthConfiguration,
};
use epas_friction::{Faults, Regime};

use crate::memory::level;
use crate::status::Failure;
use crate::types::{
    EPAS_ADAPTATION_STATE_BYTES, EPAS_ADAPTATION_WORDS, EPAS_FAULT_CALL,
    EPAS_FAULT_FORCES_NOT_HELD, EPAS_REGIME_BACK_DRIVING, EPAS_REGIME_DRIVING, EPAS_REGIME_LOCKED,
};
use crate::version::mark;

/// An input is NaN, infinite, or beyond its limit: the tick did not count.
pub const EPAS_ADAPTATION_INPUT_RANGE: u32 = 1u32;
/// The model's step had a fault: the tick did not count.
pub const EPAS_ADAPTATION_FAULTED: u32 = 2u32;
/// The motor was at its limit: the tick did not count.
pub const EPAS_ADAPTATION_SATURATED: u32 = 4u32;
/// The mechanism stands, or its friction has not turned round yet: the tick did not count.
pub const EPAS_ADAPTATION_STANDING: u32 = 8u32;
/// The model's friction is below the least: the tick did not count.
pub const EPAS_ADAPTATION_TOO_WEAK: u32 = 16u32;
/// The error was beyond four of its deviations: it counted less.
pub const EPAS_ADAPTATION_ERROR_CUT: u32 = 32u32;
/// An estimate is at its bound.
pub const EPAS_ADAPTATION_AT_BOUND: u32 = 64u32;

/// The level has fallen beyond its threshold: wear, lost preload.
pub const EPAS_HEALTH_FALLEN: u32 = 1u32;
/// The level has risen beyond its threshold: lost or aged lubricant, dirt.
pub const EPAS_HEALTH_RISEN: u32 = 2u32;

/// What the engineer sets for an adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AdaptationConfiguration {
    /// Time between two updates, s, 1e-5 to 1.
    pub tick: f32,
    /// Time in which data lose their weight, s, 200 to 1e5 ticks.
    pub forgetting_time: f32,
    /// Time constant of the filter, s, 0 to 1.
    pub filter_time: f32,
    /// Noise of the observed torque after the filter, one standard deviation, N m, 1e-6 to 1e3.
    pub noise: f32,
    /// How far a level may be from 1, one standard deviation, 0 to 10. 0 holds both levels.
    pub level_deviation: f32,
    /// Least level, 0.1 to 1.
    pub least_level: f32,
    /// Largest level, 1 to 10.
    pub largest_level: f32,
    /// How large the drag may be, one standard deviation, N m s/rad, 0 to 1e3. 0 leaves it out.
    pub drag_deviation: f32,
    /// Largest drag of either sign, N m s/rad, 0 to 1e4.
    pub largest_drag: f32,
    /// How large the offset may be, one standard deviation, N m, 0 to 1e3. 0 leaves it out.
    pub offset_deviation: f32,
    /// Largest offset of either sign, N m, 0 to 1e4.
    pub largest_offset: f32,
    /// How wrong the load torque may be, one standard deviation, 0 to 1. 0 leaves it out.
    pub load_deviation: f32,
    /// Largest relative error of the load torque, of either sign, 0 to 1.
    pub largest_load_error: f32,
    /// Largest torque that is believed, N m, 1e-6 to 1e6: observed, of the model, and of the load.
    pub largest_torque: f32,
    /// Largest nut speed that is believed, rad/s, 1e-3 to 1e6.
    pub largest_speed: f32,
    /// Nut speed below which a tick does not count, rad/s, 0 to `largest_speed`.
    pub least_speed: f32,
    /// Friction torque of the model below which a tick does not count, N m, 0 to `largest_torque`.
    pub least_friction: f32,
    /// Time constant of the slow average of the level, s, 400 to 1e7 ticks.
    pub average_time: f32,
    /// Relative fall of the level from which `EPAS_HEALTH_FALLEN` is set, 0.01 to 0.9.
    pub fall: f32,
    /// Relative rise from which `EPAS_HEALTH_RISEN` is set, 0.01 to 9.
    pub rise: f32,
    /// How far the drift has to go back before a flag is taken away, 0 to the smaller of the two above.
    pub hysteresis: f32,
}

/// What an adaptation is told at a tick, after the model's step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AdaptationInputs {
    /// Torque that the motor had to add to overcome friction, N m: its torque about the nut's axis, less what the inertia
    /// took, less `load_torque`. With the sign of the speed where friction opposes it.
    pub observed: f32,
    /// `friction_torque` of the model's outputs, N m.
    pub modelled: f32,
    /// Lubricant drag in `observed` and `modelled`, N m, which no level scales: that of `epas_memory_drag_torque`, 0 for a model without memory.
    pub lubricant_drag: f32,
    /// Level that the model had in the positive direction when it gave `modelled`: that of the last `epas_memory_set_level`, or 1
    /// where none was set. Outside 0.1 to 10 ticks of this direction do not count.
    pub forward: f32,
    /// The same in the negative direction.
    pub backward: f32,
    /// Nut speed, rad/s.
    pub nut_speed: f32,
    /// `load_torque` of the model's outputs, N m.
    pub load_torque: f32,
    /// `regime` of the model's outputs.
    pub regime: u32,
    /// `faults` of the model's outputs: with any of them the tick does not count.
    pub faults: u32,
    /// Whether the motor was at its limit; 0 for not.
    pub saturated: u32,
}

/// What a tick of an adaptation returns; every number is finite, and within its bounds. The friction torque to compensate of an
/// `epas_memory_t` is its own after `epas_memory_set_level` with both levels, that of another scene the model's times the level of its
/// direction; both with `drag` times the nut speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AdaptationOutputs {
    /// Friction over that of the model at level 1, in the positive direction.
    pub forward: f32,
    /// The same in the negative direction.
    pub backward: f32,
    /// Drag beyond the model's, N m s/rad.
    pub drag: f32,
    /// Offset of the observed torque, N m.
    pub offset: f32,
    /// Part of the load torque that was taken off too little.
    pub load_error: f32,
    /// Relative change of the slow average of the level since commissioning.
    pub drift: f32,
    /// A sum of `EPAS_HEALTH_...`; 0 for a sound mechanism.
    pub health: u32,
    /// Why the tick did not count, or what was limited: a sum of `EPAS_ADAPTATION_...`, or `EPAS_FAULT_CALL`.
    pub flags: u32,
}

/// Place for the constants and the state of an adaptation; as `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AdaptationPlace {
    /// Not for the caller.
    pub words: [u64; EPAS_ADAPTATION_WORDS],
}

/// An adaptation in its place.
#[repr(C)]
pub(crate) struct PlacedAdaptation {
    pub(crate) mark: u32,
    pub(crate) adaptation: Adaptation,
}

impl PlacedAdaptation {
    pub(crate) const MARK: u32 = mark(0x10);

    /// The place is large enough, and the header's bytes of a state are the crate's.
    pub(crate) const FITS: () = {
        assert!(
            size_of::<Self>() <= size_of::<AdaptationPlace>()
                && align_of::<Self>() <= align_of::<AdaptationPlace>(),
            "the place is too small: its number of words in types.rs"
        );
        assert!(
            Adaptation::<AdaptationConstants>::STATE_BYTES == EPAS_ADAPTATION_STATE_BYTES as usize,
            "EPAS_ADAPTATION_STATE_BYTES in types.rs"
        );
    };
}

impl AdaptationOutputs {
    /// Outputs of a refused call: the model as it is.
    pub(crate) const REFUSED: Self = Self {
        forward: 1.0,
        backward: 1.0,
        drag: 0.0,
        offset: 0.0,
        load_error: 0.0,
        drift: 0.0,
        health: 0,
        flags: EPAS_FAULT_CALL,
    };

    pub(crate) const fn of(adapted: &Adapted) -> Self {
        let Adapted {
            estimates,
            flags,
            health,
        } = adapted;
        Self {
            forward: estimates.forward,
            backward: estimates.backward,
            drag: estimates.drag,
            offset: estimates.offset,
            load_error: estimates.load_error,
            drift: health.drift,
            health: if health.fallen { EPAS_HEALTH_FALLEN } else { 0 }
                | if health.risen { EPAS_HEALTH_RISEN } else { 0 },
            flags: flags.bits() as u32,
        }
    }
}

/// The checked and folded adaptation.
pub(crate) fn adaptation(c: &AdaptationConfiguration) -> Result<Adaptation, Failure> {
    Adaptation::new(&CrateConfiguration {
        tick: c.tick,
        forgetting_time: c.forgetting_time,
        filter_time: c.filter_time,
        noise: c.noise,
        level_deviation: c.level_deviation,
        least_level: c.least_level,
        largest_level: c.largest_level,
        drag_deviation: c.drag_deviation,
        largest_drag: c.largest_drag,
        offset_deviation: c.offset_deviation,
        largest_offset: c.largest_offset,
        load_deviation: c.load_deviation,
        largest_load_error: c.largest_load_error,
        largest_torque: c.largest_torque,
        largest_speed: c.largest_speed,
        least_speed: c.least_speed,
        least_friction: c.least_friction,
        health: HealthConfiguration {
            average_time: c.average_time,
            fall: c.fall,
            rise: c.rise,
            hysteresis: c.hysteresis,
        },
    })
    .map_err(Failure::of)
}

/// The crate's inputs. An unknown regime counts as standing.
pub(crate) const fn inputs(inputs: &AdaptationInputs) -> CrateInputs {
    CrateInputs {
        observed: inputs.observed,
        modelled: inputs.modelled,
        lubricant_drag: inputs.lubricant_drag,
        level: level(inputs.forward, inputs.backward),
        nut_speed: inputs.nut_speed,
        load_torque: inputs.load_torque,
        regime: match inputs.regime {
            EPAS_REGIME_DRIVING => Regime::Driving,
            EPAS_REGIME_BACK_DRIVING => Regime::BackDriving,
            EPAS_REGIME_LOCKED => Regime::Locked,
            _ => Regime::Standing,
        },
        // Any fault does that leaves the friction in doubt.
        faults: if inputs.faults & !EPAS_FAULT_FORCES_NOT_HELD == 0 {
            Faults::NONE
        } else {
            Faults::BEYOND_MODEL
        },
        saturated: inputs.saturated != 0,
    }
}
