//! Scenes that units are made of.

use serde::{Deserialize, Serialize};

/// A scene of a unit, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneName {
    /// A ball screw whose balls do not touch
    Caged,
    /// The same with friction that remembers
    CagedWithMemory,
    /// A ball screw whose balls press on each other
    Uncaged,
    /// The same with friction that remembers
    UncagedWithMemory,
    /// A linear bearing whose balls press on each other
    Linear,
    /// The same with friction that remembers
    LinearWithMemory,
    /// What turns with the nut of a caged ball screw, moved by a motor torque, with friction that remembers
    Mechanism,
}

impl SceneName {
    /// All of them, each with its name on the command line and what it is.
    pub const ALL: [(Self, &'static str, &'static str); 7] = [
        (Self::Caged, "caged", "ball screw whose balls do not touch"),
        (
            Self::CagedWithMemory,
            "caged-with-memory",
            "ball screw whose balls do not touch, with friction that remembers",
        ),
        (
            Self::Uncaged,
            "uncaged",
            "ball screw whose balls press on each other",
        ),
        (
            Self::UncagedWithMemory,
            "uncaged-with-memory",
            "ball screw whose balls press on each other, with friction that remembers",
        ),
        (
            Self::Linear,
            "linear",
            "linear bearing whose balls press on each other",
        ),
        (
            Self::LinearWithMemory,
            "linear-with-memory",
            "linear bearing whose balls press on each other, with friction that remembers",
        ),
        (
            Self::Mechanism,
            "mechanism",
            "what turns with the nut of a ball screw, moved by a motor torque, with friction that remembers",
        ),
    ];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// What it is.
    pub const fn about(self) -> &'static str {
        Self::ALL[self as usize].2
    }

    /// Whether its friction remembers.
    pub const fn has_memory(self) -> bool {
        matches!(
            self,
            Self::CagedWithMemory
                | Self::UncagedWithMemory
                | Self::LinearWithMemory
                | Self::Mechanism
        )
    }

    /// Whether it is a linear bearing.
    pub const fn is_linear(self) -> bool {
        matches!(self, Self::Linear | Self::LinearWithMemory)
    }

    /// Whether it has a row of balls that press on each other.
    pub const fn has_row(self) -> bool {
        matches!(self, Self::Uncaged | Self::UncagedWithMemory) || self.is_linear()
    }

    /// Whether it moves in ticks of one length.
    pub const fn has_tick(self) -> bool {
        self.has_row() || matches!(self, Self::Mechanism)
    }
}
