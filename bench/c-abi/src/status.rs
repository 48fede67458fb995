//! Status codes, and which field of a configuration is wrong.

use core::ffi::CStr;

use epas_friction::{Error, Refusal};

/// Everything went well.
pub const EPAS_OK: u32 = 0u32;
/// A pointer is NULL.
pub const EPAS_NULL_POINTER: u32 = 1u32;
/// A pointer is not aligned as its type asks.
pub const EPAS_MISALIGNED: u32 = 2u32;
/// The object has not been initialised, or by another scene or another version of the library.
pub const EPAS_NOT_INITIALISED: u32 = 3u32;
/// A field is NaN or infinite.
pub const EPAS_NOT_FINITE: u32 = 4u32;
/// A field is outside its range.
pub const EPAS_OUT_OF_RANGE: u32 = 5u32;
/// The screw's groove would reach past the axis of the screw.
pub const EPAS_FOLDED_GROOVE: u32 = 6u32;
/// The block has not the length of a state.
pub const EPAS_STATE_LENGTH: u32 = 7u32;
/// The bytes are not a stored state.
pub const EPAS_NOT_A_STATE: u32 = 8u32;
/// The state is of another version of the library.
pub const EPAS_STATE_VERSION: u32 = 9u32;
/// The state's checksum is wrong.
pub const EPAS_STATE_DAMAGED: u32 = 10u32;
/// The state is of another scene, another number of balls or another design; of a linear bearing, or of another friction coefficient.
pub const EPAS_STATE_FOREIGN: u32 = 11u32;
/// A number of the state is NaN or infinite, or out of the range of its field.
pub const EPAS_STATE_OUT_OF_RANGE: u32 = 12u32;
/// The words are not a block of a folded screw.
pub const EPAS_NOT_A_BLOCK: u32 = 13u32;
/// The block is of another version of its layout.
pub const EPAS_BLOCK_VERSION: u32 = 14u32;
/// The block has not as many words as it says, or as its scene takes.
pub const EPAS_BLOCK_LENGTH: u32 = 15u32;
/// The block has another number of friction coefficients: one for `epas_caged_t` and `epas_folded_ball_t`, a range for
/// `epas_caged_range_t`, `epas_memory_t` and `epas_folded_ball_range_t`.
pub const EPAS_BLOCK_NODES: u32 = 16u32;
/// The block's checksum is wrong.
pub const EPAS_BLOCK_DAMAGED: u32 = 17u32;

/// No field is wrong.
pub const EPAS_FIELD_NONE: u32 = 0u32;
/// `pitch_radius`
pub const EPAS_FIELD_PITCH_RADIUS: u32 = 1u32;
/// `lead`
pub const EPAS_FIELD_LEAD: u32 = 2u32;
/// `ball_radius`
pub const EPAS_FIELD_BALL_RADIUS: u32 = 3u32;
/// `screw_conformity`
pub const EPAS_FIELD_SCREW_CONFORMITY: u32 = 4u32;
/// `nut_conformity`
pub const EPAS_FIELD_NUT_CONFORMITY: u32 = 5u32;
/// `conformity`
pub const EPAS_FIELD_CONFORMITY: u32 = 6u32;
/// `contact_angle`
pub const EPAS_FIELD_CONTACT_ANGLE: u32 = 7u32;
/// `ball_material.youngs_modulus`
pub const EPAS_FIELD_BALL_YOUNGS_MODULUS: u32 = 8u32;
/// `ball_material.poisson_ratio`
pub const EPAS_FIELD_BALL_POISSON_RATIO: u32 = 9u32;
/// `ball_material.density`
pub const EPAS_FIELD_BALL_DENSITY: u32 = 10u32;
/// `groove_material.youngs_modulus`
pub const EPAS_FIELD_GROOVE_YOUNGS_MODULUS: u32 = 11u32;
/// `groove_material.poisson_ratio`
pub const EPAS_FIELD_GROOVE_POISSON_RATIO: u32 = 12u32;
/// `groove_material.density`
pub const EPAS_FIELD_GROOVE_DENSITY: u32 = 13u32;
/// `friction`
pub const EPAS_FIELD_FRICTION: u32 = 14u32;
/// `ball_friction`
pub const EPAS_FIELD_BALL_FRICTION: u32 = 15u32;
/// `rolling_tangent`
pub const EPAS_FIELD_ROLLING_TANGENT: u32 = 16u32;
/// `branch`
pub const EPAS_FIELD_BRANCH: u32 = 17u32;
/// `clearance`
pub const EPAS_FIELD_CLEARANCE: u32 = 18u32;
/// `loaded_balls`
pub const EPAS_FIELD_LOADED_BALLS: u32 = 19u32;
/// Preload of a contact, N.
pub const EPAS_FIELD_CONTACT_FORCE: u32 = 20u32;
/// `turns`
pub const EPAS_FIELD_TURNS: u32 = 21u32;
/// `loaded_length`
pub const EPAS_FIELD_LOADED_LENGTH: u32 = 22u32;
/// `return_length`
pub const EPAS_FIELD_RETURN_LENGTH: u32 = 23u32;
/// `wavelength`; its value may be the number of wavelengths on the track.
pub const EPAS_FIELD_WAVELENGTH: u32 = 24u32;
/// `load_share_count`
pub const EPAS_FIELD_LOAD_SHARE_COUNT: u32 = 25u32;
/// `load_shares`
pub const EPAS_FIELD_LOAD_SHARES: u32 = 26u32;
/// `screw_deviation`, in a linear bearing `rail_deviation`
pub const EPAS_FIELD_PASSING_DEVIATION: u32 = 27u32;
/// `nut_deviation`, in a linear bearing `carriage_deviation`
pub const EPAS_FIELD_RECIRCULATING_DEVIATION: u32 = 28u32;
/// `reversal_speed`
pub const EPAS_FIELD_REVERSAL_SPEED: u32 = 29u32;
/// `tick`
pub const EPAS_FIELD_TICK: u32 = 30u32;
/// `limits.nut_speed`
pub const EPAS_FIELD_LIMIT_NUT_SPEED: u32 = 31u32;
/// `limits.axial_load`
pub const EPAS_FIELD_LIMIT_AXIAL_LOAD: u32 = 32u32;
/// `limits.friction_torque`
pub const EPAS_FIELD_LIMIT_FRICTION_TORQUE: u32 = 33u32;
/// `limits.speed`
pub const EPAS_FIELD_LIMIT_SPEED: u32 = 34u32;
/// `limits.load`
pub const EPAS_FIELD_LIMIT_LOAD: u32 = 35u32;
/// `limits.friction_force`
pub const EPAS_FIELD_LIMIT_FRICTION_FORCE: u32 = 36u32;
/// Length of the whole track, m: it follows from the loaded part and the return.
pub const EPAS_FIELD_TRACK_LENGTH: u32 = 37u32;
/// Distance of two balls in contact, m: where it is out of range, the balls do not fit on the track.
pub const EPAS_FIELD_BALL_PITCH: u32 = 38u32;
/// Ratio of the axes of the contact ellipse: it follows from the conformity.
pub const EPAS_FIELD_AXIS_RATIO: u32 = 39u32;
/// `order`
pub const EPAS_FIELD_ORDER: u32 = 40u32;
/// `cosine`
pub const EPAS_FIELD_COSINE: u32 = 41u32;
/// `sine`
pub const EPAS_FIELD_SINE: u32 = 42u32;
/// Number of harmonics.
pub const EPAS_FIELD_HARMONIC_COUNT: u32 = 43u32;
/// A sample of a deviation, or the largest of a sum of harmonics, rad.
pub const EPAS_FIELD_DEVIATION: u32 = 44u32;
/// A share of the load.
pub const EPAS_FIELD_SHARE: u32 = 45u32;
/// `lead_angle`
pub const EPAS_FIELD_LEAD_ANGLE: u32 = 46u32;
/// `ball_ratio`
pub const EPAS_FIELD_BALL_RATIO: u32 = 47u32;
/// `groove`
pub const EPAS_FIELD_GROOVE: u32 = 48u32;
/// A field that this header does not know; a newer library would.
pub const EPAS_FIELD_OTHER: u32 = 49u32;
/// Axial play of the nut, m.
pub const EPAS_FIELD_AXIAL_PLAY: u32 = 50u32;
/// `given`
pub const EPAS_FIELD_GIVEN: u32 = 51u32;
/// `slip_share`
pub const EPAS_FIELD_SLIP_SHARE: u32 = 52u32;
/// `spin_angle`
pub const EPAS_FIELD_SPIN_ANGLE: u32 = 53u32;
/// `forgetting_time`
pub const EPAS_FIELD_FORGETTING_TIME: u32 = 54u32;
/// `filter_time`
pub const EPAS_FIELD_FILTER_TIME: u32 = 55u32;
/// `noise`
pub const EPAS_FIELD_NOISE: u32 = 56u32;
/// `level_deviation`
pub const EPAS_FIELD_LEVEL_DEVIATION: u32 = 57u32;
/// `least_level`
pub const EPAS_FIELD_LEAST_LEVEL: u32 = 58u32;
/// `largest_level`
pub const EPAS_FIELD_LARGEST_LEVEL: u32 = 59u32;
/// `drag_deviation`
pub const EPAS_FIELD_DRAG_DEVIATION: u32 = 60u32;
/// `largest_drag`
pub const EPAS_FIELD_LARGEST_DRAG: u32 = 61u32;
/// `offset_deviation`
pub const EPAS_FIELD_OFFSET_DEVIATION: u32 = 62u32;
/// `largest_offset`
pub const EPAS_FIELD_LARGEST_OFFSET: u32 = 63u32;
/// `load_deviation`
pub const EPAS_FIELD_LOAD_DEVIATION: u32 = 64u32;
/// `largest_load_error`
pub const EPAS_FIELD_LARGEST_LOAD_ERROR: u32 = 65u32;
/// `largest_torque`
pub const EPAS_FIELD_LARGEST_TORQUE: u32 = 66u32;
/// `largest_speed`
pub const EPAS_FIELD_LARGEST_SPEED: u32 = 67u32;
/// `least_speed`
pub const EPAS_FIELD_LEAST_SPEED: u32 = 68u32;
/// `least_friction`
pub const EPAS_FIELD_LEAST_FRICTION: u32 = 69u32;
/// `average_time`
pub const EPAS_FIELD_AVERAGE_TIME: u32 = 70u32;
/// `fall`
pub const EPAS_FIELD_FALL: u32 = 71u32;
/// `rise`
pub const EPAS_FIELD_RISE: u32 = 72u32;
/// `hysteresis`
pub const EPAS_FIELD_HYSTERESIS: u32 = 73u32;
/// `encoder.period`
pub const EPAS_FIELD_PERIOD: u32 = 74u32;
/// `encoder.turn_per_count`
pub const EPAS_FIELD_TURN_PER_COUNT: u32 = 75u32;
/// `encoder.largest_turn`
pub const EPAS_FIELD_LARGEST_TURN: u32 = 76u32;
/// `encoder.play`
pub const EPAS_FIELD_PLAY: u32 = 77u32;
/// `coefficient.boundary`
pub const EPAS_FIELD_BOUNDARY: u32 = 78u32;
/// `coefficient.full_film`
pub const EPAS_FIELD_FULL_FILM: u32 = 79u32;
/// `coefficient.half_share_speed`
pub const EPAS_FIELD_HALF_SHARE_SPEED: u32 = 80u32;
/// `coefficient.reference_temperature`
pub const EPAS_FIELD_REFERENCE_TEMPERATURE: u32 = 81u32;
/// `forward`
pub const EPAS_FIELD_FORWARD: u32 = 82u32;
/// `backward`
pub const EPAS_FIELD_BACKWARD: u32 = 83u32;
/// `coefficient.churning`
pub const EPAS_FIELD_CHURNING: u32 = 84u32;
/// `oil.kinematic_viscosity_40`
pub const EPAS_FIELD_KINEMATIC_VISCOSITY_40: u32 = 85u32;
/// `oil.kinematic_viscosity_100`
pub const EPAS_FIELD_KINEMATIC_VISCOSITY_100: u32 = 86u32;
/// `oil.density`
pub const EPAS_FIELD_OIL_DENSITY: u32 = 87u32;
/// `oil.pour_point`
pub const EPAS_FIELD_POUR_POINT: u32 = 88u32;
/// The least or largest friction coefficient of a law, with its factors.
pub const EPAS_FIELD_COEFFICIENT: u32 = 89u32;
/// `reference_torque`
pub const EPAS_FIELD_REFERENCE_TORQUE: u32 = 90u32;
/// `slip_angle`
pub const EPAS_FIELD_SLIP_ANGLE: u32 = 91u32;
/// `load_hold`
pub const EPAS_FIELD_LOAD_HOLD: u32 = 92u32;
/// `load_fade`
pub const EPAS_FIELD_LOAD_FADE: u32 = 93u32;
/// `fallback_temperature`
pub const EPAS_FIELD_FALLBACK_TEMPERATURE: u32 = 94u32;
/// `temperature_hold`
pub const EPAS_FIELD_TEMPERATURE_HOLD: u32 = 95u32;
/// `temperature_fade`
pub const EPAS_FIELD_TEMPERATURE_FADE: u32 = 96u32;
/// The words of a block, or a number in it.
pub const EPAS_FIELD_BLOCK: u32 = 97u32;
/// `folded`, or a number in it.
pub const EPAS_FIELD_FOLDED: u32 = 98u32;
/// `coefficient.drag_torque`
pub const EPAS_FIELD_DRAG_TORQUE: u32 = 99u32;
/// `coefficient.drag_heating`
pub const EPAS_FIELD_DRAG_HEATING: u32 = 100u32;
/// `balls`
pub const EPAS_FIELD_BALLS: u32 = 101u32;

/// Names of the fields in C, by their numbers.
const FIELD_NAMES: [&CStr; 102] = [
    c"",
    c"pitch_radius",
    c"lead",
    c"ball_radius",
    c"screw_conformity",
    c"nut_conformity",
    c"conformity",
    c"contact_angle",
    c"ball_material.youngs_modulus",
    c"ball_material.poisson_ratio",
    c"ball_material.density",
    c"groove_material.youngs_modulus",
    c"groove_material.poisson_ratio",
    c"groove_material.density",
    c"friction",
    c"ball_friction",
    c"rolling_tangent",
    c"branch",
    c"clearance",
    c"loaded_balls",
    c"contact force",
    c"turns",
    c"loaded_length",
    c"return_length",
    c"wavelength",
    c"load_share_count",
    c"load_shares",
    c"passing deviation",
    c"recirculating deviation",
    c"reversal_speed",
    c"tick",
    c"limits.nut_speed",
    c"limits.axial_load",
    c"limits.friction_torque",
    c"limits.speed",
    c"limits.load",
    c"limits.friction_force",
    c"track length",
    c"ball pitch",
    c"axis ratio",
    c"order",
    c"cosine",
    c"sine",
    c"harmonic count",
    c"deviation",
    c"share",
    c"lead_angle",
    c"ball_ratio",
    c"groove",
    c"other",
    c"axial play",
    c"given",
    c"slip_share",
    c"spin_angle",
    c"forgetting_time",
    c"filter_time",
    c"noise",
    c"level_deviation",
    c"least_level",
    c"largest_level",
    c"drag_deviation",
    c"largest_drag",
    c"offset_deviation",
    c"largest_offset",
    c"load_deviation",
    c"largest_load_error",
    c"largest_torque",
    c"largest_speed",
    c"least_speed",
    c"least_friction",
    c"average_time",
    c"fall",
    c"rise",
    c"hysteresis",
    c"encoder.period",
    c"encoder.turn_per_count",
    c"encoder.largest_turn",
    c"encoder.play",
    c"coefficient.boundary",
    c"coefficient.full_film",
    c"coefficient.half_share_speed",
    c"coefficient.reference_temperature",
    c"forward",
    c"backward",
    c"coefficient.churning",
    c"oil.kinematic_viscosity_40",
    c"oil.kinematic_viscosity_100",
    c"oil.density",
    c"oil.pour_point",
    c"coefficient",
    c"reference_torque",
    c"slip_angle",
    c"load_hold",
    c"load_fade",
    c"fallback_temperature",
    c"temperature_hold",
    c"temperature_fade",
    c"block",
    c"folded",
    c"coefficient.drag_torque",
    c"coefficient.drag_heating",
    c"balls",
];

/// Fields to which the crate gives another name, some of them one in each scene.
const CRATE_NAMES: [(&str, u32); 33] = [
    ("contact_force", EPAS_FIELD_CONTACT_FORCE),
    ("load_shares", EPAS_FIELD_LOAD_SHARE_COUNT),
    ("screw_deviation", EPAS_FIELD_PASSING_DEVIATION),
    ("rail_deviation", EPAS_FIELD_PASSING_DEVIATION),
    ("nut_deviation", EPAS_FIELD_RECIRCULATING_DEVIATION),
    ("carriage_deviation", EPAS_FIELD_RECIRCULATING_DEVIATION),
    ("nut_speed", EPAS_FIELD_LIMIT_NUT_SPEED),
    ("axial_load", EPAS_FIELD_LIMIT_AXIAL_LOAD),
    ("friction_torque", EPAS_FIELD_LIMIT_FRICTION_TORQUE),
    ("speed", EPAS_FIELD_LIMIT_SPEED),
    ("load", EPAS_FIELD_LIMIT_LOAD),
    ("friction_force", EPAS_FIELD_LIMIT_FRICTION_FORCE),
    ("length", EPAS_FIELD_TRACK_LENGTH),
    ("pitch", EPAS_FIELD_BALL_PITCH),
    ("axis_ratio", EPAS_FIELD_AXIS_RATIO),
    ("axial_play", EPAS_FIELD_AXIAL_PLAY),
    ("period", EPAS_FIELD_PERIOD),
    ("turn_per_count", EPAS_FIELD_TURN_PER_COUNT),
    ("largest_turn", EPAS_FIELD_LARGEST_TURN),
    ("half_width", EPAS_FIELD_PLAY),
    ("boundary", EPAS_FIELD_BOUNDARY),
    ("full_film", EPAS_FIELD_FULL_FILM),
    ("half_share_speed", EPAS_FIELD_HALF_SHARE_SPEED),
    ("reference_temperature", EPAS_FIELD_REFERENCE_TEMPERATURE),
    ("churning", EPAS_FIELD_CHURNING),
    ("drag_torque", EPAS_FIELD_DRAG_TORQUE),
    ("drag_heating", EPAS_FIELD_DRAG_HEATING),
    ("kinematic_viscosity_40", EPAS_FIELD_KINEMATIC_VISCOSITY_40),
    (
        "kinematic_viscosity_100",
        EPAS_FIELD_KINEMATIC_VISCOSITY_100,
    ),
    ("density", EPAS_FIELD_OIL_DENSITY),
    ("pour_point", EPAS_FIELD_POUR_POINT),
    ("hold_time", EPAS_FIELD_TEMPERATURE_HOLD),
    ("fade_time", EPAS_FIELD_TEMPERATURE_FADE),
];

/// What the status codes mean, by their numbers.
const STATUS_NAMES: [&CStr; 18] = [
    c"ok",
    c"null pointer",
    c"misaligned pointer",
    c"not initialised",
    c"not a finite number",
    c"out of range",
    c"groove folded past the axis",
    c"wrong length of a state",
    c"no state",
    c"state of another version",
    c"damaged state",
    c"state of other constants",
    c"state out of range",
    c"no block",
    c"block of another version",
    c"wrong length of a block",
    c"block of another number of friction coefficients",
    c"damaged block",
];

pub(crate) fn field_name(field: u32) -> &'static CStr {
    FIELD_NAMES.get(field as usize).copied().unwrap_or(c"")
}

pub(crate) fn status_name(status: u32) -> &'static CStr {
    let name = STATUS_NAMES.get(status as usize).copied();
    name.unwrap_or(c"unknown status")
}

/// Status of a refused state.
pub(crate) const fn refused(refusal: Refusal) -> u32 {
    match refusal {
        Refusal::Length { .. } => EPAS_STATE_LENGTH,
        Refusal::NotAState => EPAS_NOT_A_STATE,
        Refusal::Version { .. } => EPAS_STATE_VERSION,
        Refusal::Damaged => EPAS_STATE_DAMAGED,
        Refusal::OtherScene | Refusal::OtherBalls { .. } | Refusal::OtherConstants => {
            EPAS_STATE_FOREIGN
        }
        // `Refusal` may grow; what is wrong is then still a number.
        _ => EPAS_STATE_OUT_OF_RANGE,
    }
}

/// Number of a field that the crate names.
fn field_number(name: &str) -> u32 {
    let other = CRATE_NAMES.iter().find(|(own, _)| *own == name);
    other.map_or_else(
        || {
            let mut own = (0..).zip(FIELD_NAMES);
            own.find(|(_, own)| own.to_bytes() == name.as_bytes())
                .map_or(EPAS_FIELD_OTHER, |(number, _)| number)
        },
        |(_, number)| *number,
    )
}

/// What was wrong with a configuration, a table or a request.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Failure {
    /// What was wrong, one of the status codes; the function returned it too.
    pub status: u32,
    /// Which field, one of `EPAS_FIELD_...`; `epas_field_name` gives its name.
    pub field: u32,
    /// Which element, where the field is in an array; 0 elsewhere.
    pub index: u32,
    /// The value found, in the field's own unit.
    pub value: f32,
    /// Smallest value allowed beside the other fields.
    pub minimum: f32,
    /// Largest value allowed beside the other fields.
    pub maximum: f32,
}

impl Failure {
    pub(crate) const NONE: Self = Self {
        status: EPAS_OK,
        field: EPAS_FIELD_NONE,
        index: 0,
        value: 0.0,
        minimum: 0.0,
        maximum: 0.0,
    };

    /// A pointer that cannot be used, or what it points to.
    pub(crate) const fn pointer(status: u32, field: u32) -> Self {
        Self {
            status,
            field,
            ..Self::NONE
        }
    }

    /// The crate's error where the C structure spells the field as [`field_number`] finds it.
    pub(crate) fn of(error: Error) -> Self {
        Self::at(error, field_number(error.field()))
    }

    /// The crate's error at a field of the C structure.
    pub(crate) fn at(error: Error, field: u32) -> Self {
        let status = match error {
            Error::NotFinite { .. } => EPAS_NOT_FINITE,
            Error::FoldedGroove { .. } => EPAS_FOLDED_GROOVE,
            // `Error` may grow; what is wrong with a value is then still that it is not allowed.
            _ => EPAS_OUT_OF_RANGE,
        };
        Self {
            status,
            field,
            index: 0,
            value: error.value(),
            minimum: error.allowed().minimum,
            maximum: error.allowed().maximum,
        }
    }

    /// What is wrong with a block: its frame, or a number in it.
    pub(crate) fn of_block(error: Error) -> Self {
        let status = match error.field() {
            "magic" => EPAS_NOT_A_BLOCK,
            "version" => EPAS_BLOCK_VERSION,
            "words" => EPAS_BLOCK_LENGTH,
            "nodes" => EPAS_BLOCK_NODES,
            "checksum" => EPAS_BLOCK_DAMAGED,
            _ => return Self::of(error),
        };
        Self {
            status,
            ..Self::at(error, EPAS_FIELD_BLOCK)
        }
    }

    /// A whole number out of its range.
    pub(crate) const fn count(field: u32, value: u32, minimum: u32, maximum: u32) -> Self {
        Self {
            status: EPAS_OUT_OF_RANGE,
            field,
            index: 0,
            value: value as f32,
            minimum: minimum as f32,
            maximum: maximum as f32,
        }
    }
}
