//! What the friction task shows to a tool.

use super::table::table;

table! {
    /// Numbers of the last tick of the friction task.
    pub struct Measured, MEASURED_FIELDS {
        /// Torque about the axis of the nut that the motor is asked for
        torque: f32, "N m", -20.0 to 20.0;
        /// Friction torque of the model
        friction_torque: f32, "N m", -20.0 to 20.0;
        /// Torque about the axis of the nut that holds the load without friction
        load_torque: f32, "N m", -100.0 to 100.0;
        /// Nut speed
        nut_speed: f32, "rad/s", -1_000.0 to 1_000.0;
        /// Axial load of the rack
        axial_load: f32, "N", -100_000.0 to 100_000.0;
        /// Age of the axial load
        load_age: f32, "s", 0.0 to 20_000.0;
        /// Temperature of the screw
        temperature: f32, "K", 0.0 to 1_000.0;
        /// Age of the temperature
        temperature_age: f32, "s", 0.0 to 20_000.0;
        /// Friction level of the adaptation, positive direction
        level_forward: f32, "", 0.1 to 10.0;
        /// Friction level of the adaptation, negative direction
        level_backward: f32, "", 0.1 to 10.0;
        /// What the mechanism does: index into the regimes
        regime: u32, "", 0.0 to 255.0;
        /// Faults of the tick: a bit for each
        faults: u32, "", 0.0 to 65_535.0;
        /// Ticks of the friction task since the start
        steps: u32, "", 0.0 to 4_294_967_040.0;
        /// What was found of the calibration page: index into the states
        page_state: u32, "", 0.0 to 4.0;
        /// Index of the number that is outside its limits, where the state says so
        page_field: u32, "", 0.0 to 255.0;
        /// Pages that were taken
        pages_taken: u32, "", 0.0 to 4_294_967_040.0;
        /// Pages that were refused
        pages_refused: u32, "", 0.0 to 4_294_967_040.0;
    }
}

impl Measured {
    /// Before the first tick.
    pub const NONE: Self = Self {
        torque: 0.0,
        friction_torque: 0.0,
        load_torque: 0.0,
        nut_speed: 0.0,
        axial_load: 0.0,
        load_age: 0.0,
        temperature: 0.0,
        temperature_age: 0.0,
        level_forward: 1.0,
        level_backward: 1.0,
        regime: 0,
        faults: 0,
        steps: 0,
        page_state: 0,
        page_field: 0,
        pages_taken: 0,
        pages_refused: 0,
    };
}

/// Names of `page_state`, in their order.
pub const PAGE_STATES: [&str; 5] = [
    "taken",
    "refused: other layout",
    "refused: checksum",
    "refused: out of range",
    "refused: not together",
];

/// Names of `regime`, in their order.
pub const REGIMES: [&str; 4] = ["standing", "driving", "back-driving", "locked"];
