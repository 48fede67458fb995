//! Sizes of programs with one scene each.

use super::promise::Footprint;

/// Most cycles of a step over its least ones, whatever sound inputs come.
pub const STEP_SPREAD: f64 = 1.5;

/// Sizes of programs with one scene each, and of one with all of them, on the reference board.
pub const FOOTPRINTS: [Footprint; 6] = [
    Footprint {
        scene: "curvature",
        flash: 2600,
        flash_small: 2200,
        ram: 16,
        stack: 16,
    },
    Footprint {
        scene: "efficiency",
        flash: 2800,
        flash_small: 2400,
        ram: 16,
        stack: 16,
    },
    Footprint {
        scene: "caged_ball_screw",
        flash: 3300,
        flash_small: 2900,
        ram: 16,
        stack: 32,
    },
    Footprint {
        scene: "linear_bearing",
        flash: 7800,
        flash_small: 7700,
        ram: 720,
        stack: 256,
    },
    Footprint {
        scene: "ball_screw_37",
        flash: 10_200,
        flash_small: 10_000,
        ram: 1080,
        stack: 456,
    },
    Footprint {
        scene: "everything",
        flash: 16_000,
        flash_small: 15_400,
        ram: 1824,
        stack: 456,
    },
];
