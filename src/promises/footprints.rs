//! Sizes of programs with one scene each.

use super::promise::Footprint;

/// Most cycles of a step over its least ones, whatever sound inputs come.
pub const STEP_SPREAD: f64 = 1.5;

/// Sizes of programs with one scene each, and of one with all of them, on the reference board.
///
/// Their constants stand in flash; the stack of the set-up is that of [`FrictionModel::of`](crate::FrictionModel::of), which says
/// how long that takes.
pub const FOOTPRINTS: [Footprint; 8] = [
    Footprint {
        scene: "curvature",
        flash: 2600,
        flash_small: 2200,
        ram: 16,
        stack: 16,
        stack_set_up: 16,
    },
    Footprint {
        scene: "efficiency",
        flash: 2800,
        flash_small: 2400,
        ram: 16,
        stack: 16,
        stack_set_up: 16,
    },
    Footprint {
        scene: "caged_ball_screw",
        flash: 3900,
        flash_small: 3500,
        ram: 24,
        stack: 64,
        stack_set_up: 16,
    },
    Footprint {
        scene: "caged_with_memory",
        flash: 5700,
        flash_small: 5100,
        ram: 136,
        stack: 160,
        stack_set_up: 112,
    },
    Footprint {
        scene: "linear_bearing",
        flash: 8400,
        flash_small: 8000,
        ram: 720,
        stack: 272,
        stack_set_up: 32,
    },
    Footprint {
        scene: "ball_screw_37",
        flash: 25_600,
        flash_small: 23_000,
        ram: 2880,
        stack: 1200,
        stack_set_up: 3800,
    },
    Footprint {
        scene: "ball_screw_37_with_memory",
        flash: 27_000,
        flash_small: 24_500,
        ram: 3000,
        stack: 1300,
        stack_set_up: 3900,
    },
    Footprint {
        scene: "everything",
        flash: 32_000,
        flash_small: 29_000,
        ram: 3600,
        stack: 1200,
        stack_set_up: 3800,
    },
];
