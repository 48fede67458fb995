//! The structures of the header. Every number is a `float` or a `uint32_t`, so that none has a field whose
//! size depends on the compiler's options (`-fshort-enums`).

use crate::tables::{Deviation, FoldedBallPlace, FoldedBallRangePlace, LoadShare};

/// Bytes of a state of an adaptation.
pub const EPAS_ADAPTATION_STATE_BYTES: u32 = 116u32;
/// Words of eight bytes that an adaptation takes.
pub const EPAS_ADAPTATION_WORDS: usize = 48;

/// The ball rolls and slips across the groove at the screw: a paper's closed form, which leaves out spin, the third contact
/// and most of the lead's effect.
pub const EPAS_BRANCH_ROLLING: u32 = 1u32;
/// The ball slides along the path at both contacts: a paper's closed form, a pessimistic bound.
pub const EPAS_BRANCH_SLIDING: u32 = 2u32;

/// The mechanism is slower than the reversal speed, or with memory its elements still stick or the nut has
/// just turned back: friction is between its two directions.
pub const EPAS_REGIME_STANDING: u32 = 0u32;
/// The motor moves the load.
pub const EPAS_REGIME_DRIVING: u32 = 1u32;
/// The load turns the nut.
pub const EPAS_REGIME_BACK_DRIVING: u32 = 2u32;
/// No torque moves the load, or the load alone does not sustain the motion.
pub const EPAS_REGIME_LOCKED: u32 = 3u32;

/// The speed is NaN or infinite: the friction output is 0; in `epas_memory_t` the last sound speed and load stand in.
pub const EPAS_FAULT_SPEED_NOT_FINITE: u32 = 1u32;
/// A load is NaN or infinite: as for the speed.
pub const EPAS_FAULT_LOAD_NOT_FINITE: u32 = 2u32;
/// The speed is beyond its limit: the limit stands in for it.
pub const EPAS_FAULT_SPEED_RANGE: u32 = 4u32;
/// A load is beyond its limit: the limit stands in for it.
pub const EPAS_FAULT_LOAD_RANGE: u32 = 8u32;
/// The friction torque of a screw, or the friction force of a bearing, was cut to its limit.
pub const EPAS_FAULT_FRICTION_LIMIT: u32 = 16u32;
/// The friction is not held: the mechanism is where its formulas leave the accuracy that they promise. It is the best estimate. No fault of
/// the inputs: the faulted ticks do not count it.
pub const EPAS_FAULT_BEYOND_MODEL: u32 = 32u32;
/// Forces from ball to ball are not held, while the friction is. No fault of the inputs: the faulted ticks do not count it, and an
/// adaptation goes on.
pub const EPAS_FAULT_FORCES_NOT_HELD: u32 = 64u32;
/// A reading of the angle is missing or cannot be right: friction stays where it is, and the next reading spans the gap.
pub const EPAS_FAULT_ANGLE_NOT_VALID: u32 = 128u32;
/// The temperature is NaN or beyond its range: the last one, or the bound, stands in for it.
pub const EPAS_FAULT_TEMPERATURE_RANGE: u32 = 256u32;
/// A load is older than it may be: its friction fades away.
pub const EPAS_FAULT_LOAD_STALE: u32 = 512u32;
/// A temperature is older than it may be: the fallback stands in for it.
pub const EPAS_FAULT_TEMPERATURE_STALE: u32 = 1024u32;
/// The call itself was refused (its status says why): the friction output is 0.
pub const EPAS_FAULT_CALL: u32 = 0x80000000u32;

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Material {
    /// Young's modulus, Pa, 1e6 to 1e13; steel 210e9.
    pub youngs_modulus: f32,
    /// Poisson's ratio, 0 to 0.5; steel 0.28.
    pub poisson_ratio: f32,
    /// Density, kg/m^3, 1 to 1e5; steel 7800.
    pub density: f32,
}

/// A ball screw by its catalogue numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct BallScrew {
    /// Radius of the cylinder on which the ball centres run, m, 1e-3 to 0.5; half the nominal diameter
    /// where a catalogue prints no pitch circle.
    pub pitch_radius: f32,
    /// Axial travel of the nut in one turn, m, 0 to 0.2.
    pub lead: f32,
    /// Ball radius, m, 1e-4 to 0.05, up to 0.9 of the pitch radius.
    pub ball_radius: f32,
    /// Radius of the screw's groove over the ball's diameter, 0.5005 to 1.
    pub screw_conformity: f32,
    /// Radius of the nut's groove over the ball's diameter, 0.5005 to 1.
    pub nut_conformity: f32,
    /// Nominal contact angle, rad, 0.01 to 1.5533.
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of screw and nut.
    pub groove_material: Material,
}

/// Bounds that a model keeps whatever comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Limits {
    /// Largest nut speed that is believed, rad/s, 1e-3 to 1e6.
    pub nut_speed: f32,
    /// Largest axial load that is believed, N, 1e-3 to 1e7.
    pub axial_load: f32,
    /// Largest friction torque output, N m, 1e-6 to 1e6.
    pub friction_torque: f32,
}

/// What the control interrupt knows at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Inputs {
    /// Angular speed of the nut relative to the screw, rad/s.
    pub nut_speed: f32,
    /// Axial force of the load, N; positive where it opposes the travel that a positive nut speed
    /// makes.
    pub axial_load: f32,
}

/// What a ball screw whose balls do not touch returns at a tick; every number is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Outputs {
    /// Torque about the nut's axis that the motor has to add to overcome friction, N m, with the sign
    /// of the nut speed; with memory it keeps the old sign after a reversal, until the regime is
    /// standing no more.
    pub friction_torque: f32,
    /// Torque about the nut's axis that holds the load without friction, N m.
    pub load_torque: f32,
    /// Work out over work in of the two torques above, in the direction of motion; 0 without load,
    /// while standing or in a fault, negative where the direction is locked.
    pub efficiency: f32,
    /// What the mechanism does, one of `EPAS_REGIME_...`.
    pub regime: u32,
    /// What was wrong with this tick, a sum of `EPAS_FAULT_...`; 0 for nothing.
    pub faults: u32,
}

/// A ball screw that was folded on a host: the words that `epas design` writes into a header, or those of a calibration page. They are
/// read while a model is made or swapped, or a folded ball is decoded, and need not stay.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Block {
    /// The words.
    pub words: *const u32,
    /// How many there are.
    pub count: u32,
}

/// Bytes of a state of `epas_caged_t`, as `epas_caged_export` writes it.
pub const EPAS_CAGED_STATE_BYTES: u32 = 24u32;

/// Size of `epas_caged_t` in words of eight bytes.
pub const EPAS_CAGED_WORDS: usize = 52;

/// Place for the constants and the state of a caged ball screw with one friction coefficient. The caller provides it, in memory of
/// static duration or any other; nothing in it is for the caller to read or write. Zero it, or leave it
/// as a static object is; then give it to `epas_caged_init`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct CagedPlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_CAGED_WORDS],
}

/// Bytes of a state of `epas_caged_range_t`, as `epas_caged_range_export` writes it.
pub const EPAS_CAGED_RANGE_STATE_BYTES: u32 = 24u32;

/// Size of `epas_caged_range_t` in words of eight bytes.
pub const EPAS_CAGED_RANGE_WORDS: usize = 220;

/// Friction coefficients of a block for a range of them.
pub const EPAS_RANGE_NODES: usize = 5;

/// Place for the constants and the state of a caged ball screw whose friction coefficient changes; as `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct CagedRangePlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_CAGED_RANGE_WORDS],
}

/// What the engineer sets for a ball screw whose balls do not touch, by a closed form: from catalogue numbers, without a host, for a first
/// look. Over the built-in designs a rolling ball has 0.02 to 1.1 times the exact friction, a sliding one 0.6 to 14 times.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ClosedFormConfiguration {
    /// The design.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 0 to 1.
    pub friction: f32,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, 0 to 0.1.
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for, one of `EPAS_BRANCH_...`.
    pub branch: u32,
    /// Radial gap of every contact at a centred ball without load, m, play above zero, oversize below; -0.02 to
    /// 0.05 ball radii. `epas_clearance` finds it from a preload or an axial play. Oversize presses on both flanks of the nut, and
    /// play changes nothing.
    pub clearance: f32,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u32,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3.
    pub reversal_speed: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

/// Bytes of a state of `epas_closed_form_t`, as `epas_closed_form_export` writes it.
pub const EPAS_CLOSED_FORM_STATE_BYTES: u32 = 20u32;

/// Size of `epas_closed_form_t` in words of eight bytes.
pub const EPAS_CLOSED_FORM_WORDS: usize = 8;

/// Place for the constants and the state of a ball screw by a closed form; as `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ClosedFormPlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_CLOSED_FORM_WORDS],
}

/// Bytes of a state of a screw whose friction remembers, as `epas_memory_export` writes it.
pub const EPAS_MEMORY_STATE_BYTES: u32 = 124u32;

/// Size of `epas_memory_t` in words of eight bytes.
pub const EPAS_MEMORY_WORDS: usize = 265;

/// Most balls in a circuit, return included. A larger number needs the library built with that number.
pub const EPAS_MOST_BALLS: usize = 64;

/// The circuit of a ball screw whose balls press on each other.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ScrewCircuit {
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// Balls in the circuit, return included, 1 to `EPAS_MOST_BALLS`.
    pub balls: u32,
    /// Turns of the loaded track, 0.1 to 100.
    pub turns: f32,
    /// Length of the return, m, 0 to 10: there balls carry no load.
    pub return_length: f32,
    /// Deviation of the contact angles along the screw's groove, at most the largest that was folded, or NULL for none. It has to stay
    /// where and as it is for as long as the model is used.
    pub screw_deviation: *const Deviation,
    /// Deviation of the contact angles along the nut's groove, from the start of the loaded track, or NULL
    /// for none; it has to stay too.
    pub nut_deviation: *const Deviation,
    /// Load of a ball over the mean load, at the middles of equal parts of the loaded track from its start, for loads of
    /// both signs, or NULL for the mean load everywhere; it has to stay too.
    pub load_shares: *const LoadShare,
    /// Elements of `load_shares`, 1 to 256; not read where that is NULL.
    pub load_share_count: u32,
    /// Time between two steps, s, 1e-6 to 1; at the largest nut speed the balls may move by 3 % of the track
    /// in it.
    pub tick: f32,
}

/// What the engineer sets for a ball screw whose balls press on each other, with one friction coefficient.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ScrewConfiguration {
    /// What a host has folded: the gear, its friction coefficient, reversal speed and limits. It has to stay where and as it is for as long
    /// as the model is used.
    pub folded: *const FoldedBallPlace,
    /// What is set beside it.
    pub circuit: ScrewCircuit,
}

/// The same with a friction coefficient that changes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ScrewRangeConfiguration {
    /// What a host has folded; as in `epas_screw_configuration_t`.
    pub folded: *const FoldedBallRangePlace,
    /// What is set beside it.
    pub circuit: ScrewCircuit,
}

/// Bytes of a state of `epas_screw_t` with `EPAS_MOST_BALLS`, as `epas_screw_export` writes it; fewer balls take the first of them.
pub const EPAS_SCREW_STATE_BYTES: u32 = 613u32;

/// Size of `epas_screw_t` in words of eight bytes.
pub const EPAS_SCREW_WORDS: usize = 447;

/// Place for the constants and the state of a ball screw whose balls press on each other, with one friction coefficient; as
/// `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ScrewPlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_SCREW_WORDS],
}

/// Friction coefficients of a folded ball for a range of them.
pub const EPAS_SCREW_RANGE_NODES: usize = 3;

/// Bytes of a state of `epas_screw_range_t`; as `EPAS_SCREW_STATE_BYTES`.
pub const EPAS_SCREW_RANGE_STATE_BYTES: u32 = 613u32;

/// Size of `epas_screw_range_t` in words of eight bytes.
pub const EPAS_SCREW_RANGE_WORDS: usize = 448;

/// Place for the constants and the state of a ball screw whose balls press on each other and whose friction coefficient changes; as
/// `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ScrewRangePlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_SCREW_RANGE_WORDS],
}

/// What a ball screw whose balls press on each other returns at a tick; every number is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ScrewOutputs {
    /// Torque about the nut's axis that the motor has to add to overcome friction, N m, with the sign of the
    /// nut speed: the sum of the next two, within its limit.
    pub friction_torque: f32,
    /// Its part from the grooves, N m.
    pub groove_torque: f32,
    /// Its part from balls that rub against each other, N m.
    pub ball_torque: f32,
    /// Torque about the nut's axis that holds the load without friction, N m.
    pub load_torque: f32,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// Pairs of balls that press on each other.
    pub contacts: u32,
    /// What the mechanism does, one of `EPAS_REGIME_...`.
    pub regime: u32,
    /// What was wrong with this tick, a sum of `EPAS_FAULT_...`; 0 for nothing.
    pub faults: u32,
}

/// A linear ball bearing with gothic-arch grooves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LinearBearing {
    /// Ball radius, m, 1e-4 to 0.05.
    pub ball_radius: f32,
    /// Radius of the grooves over the ball's diameter, 0.5005 to 1.
    pub conformity: f32,
    /// Nominal contact angle, rad, 0.01 to 1.5533.
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of rail and carriage.
    pub groove_material: Material,
}

/// Bounds that a linear bearing keeps whatever comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LinearLimits {
    /// Largest speed that is believed, m/s, 1e-6 to 1e3.
    pub speed: f32,
    /// Largest normal and side load that is believed, N, 1e-3 to 1e7.
    pub load: f32,
    /// Largest friction force output, N, 1e-6 to 1e6.
    pub friction_force: f32,
}

/// What the engineer sets for a linear bearing.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct LinearConfiguration {
    /// The design.
    pub bearing: LinearBearing,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 1.
    pub friction: f32,
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// Balls in the circuit, return included, 1 to `EPAS_MOST_BALLS`.
    pub balls: u32,
    /// Length of the loaded track, m, 1e-4 to 100.
    pub loaded_length: f32,
    /// Length of the return, m, 0 to 100: there balls carry no load.
    pub return_length: f32,
    /// Length that counts as one turn of the deviations, m, 1e-4 to 100.
    pub wavelength: f32,
    /// Deviation of the contact angles along the rail, or NULL for none. It has to stay where and as it is
    /// for as long as the model is used.
    pub rail_deviation: *const Deviation,
    /// Deviation of the contact angles along the carriage, or NULL for none; it has to stay too.
    pub carriage_deviation: *const Deviation,
    /// Load of a ball over the mean load, at the middles of equal parts of the loaded track from its start, or NULL for the
    /// mean load everywhere; it has to stay too.
    pub load_shares: *const LoadShare,
    /// Elements of `load_shares`, 1 to 256; not read where that is NULL.
    pub load_share_count: u32,
    /// Speed over which friction changes its direction, m/s, 1e-9 to 10.
    pub reversal_speed: f32,
    /// Time between two steps, s, 1e-6 to 1; at the largest speed the balls may move by 3 % of the track in
    /// it.
    pub tick: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: LinearLimits,
}

/// What the control interrupt knows of a linear bearing at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LinearInputs {
    /// Speed of the carriage on the rail, m/s.
    pub speed: f32,
    /// Force that presses the carriage on the row of balls, N, preload included; zero or less lifts it off.
    pub normal_load: f32,
    /// Force across, N: positive loads the diagonal from bottom left to top right.
    pub side_load: f32,
}

/// What a linear bearing returns at a tick; every number is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LinearOutputs {
    /// Force along the rail that has to be added to overcome friction, N, with the sign of the speed: the sum
    /// of the next two, within its limit.
    pub friction_force: f32,
    /// Its part from the grooves, N.
    pub groove_force: f32,
    /// Its part from balls that rub against each other, N.
    pub ball_force: f32,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// Pairs of balls that press on each other.
    pub contacts: u32,
    /// What the mechanism does: `EPAS_REGIME_STANDING` or `EPAS_REGIME_DRIVING`.
    pub regime: u32,
    /// What was wrong with this tick, a sum of `EPAS_FAULT_...`; 0 for nothing.
    pub faults: u32,
}

/// Bytes of a state of `epas_linear_t`; as `EPAS_SCREW_STATE_BYTES`.
pub const EPAS_LINEAR_STATE_BYTES: u32 = 613u32;

/// Size of `epas_linear_t` in words of eight bytes.
pub const EPAS_LINEAR_WORDS: usize = 286;

/// Place for the constants and the state of a linear bearing; as `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct LinearPlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_LINEAR_WORDS],
}
