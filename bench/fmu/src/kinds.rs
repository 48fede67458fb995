//! Where an instance is, and which types a caller asks for.

use epas_cli::fmu::Kind;

/// Where an instance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Made, nothing set.
    Instantiated,
    /// In initialisation mode.
    Initializing,
    /// Ready for steps.
    Stepping,
    /// At its end.
    Terminated,
}

impl Phase {
    pub const ALL: [Self; 4] = [
        Self::Instantiated,
        Self::Initializing,
        Self::Stepping,
        Self::Terminated,
    ];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "before initialisation",
            Self::Initializing => "in initialisation mode",
            Self::Stepping => "after initialisation",
            Self::Terminated => "after its end",
        }
    }
}

/// Types that a caller asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// `fmi2Real`.
    Real,
    /// `fmi2Integer`.
    Integer,
    /// `fmi3Float64`.
    Float64,
    /// `fmi3Float32`.
    Float32,
    /// `fmi3Int32`.
    Int32,
    /// `fmi3Int64`.
    Int64,
    /// One that no variable here has.
    Other(&'static str),
}

impl Wanted {
    /// Whether a variable of a kind is of this type.
    pub const fn fits(self, kind: Kind) -> bool {
        matches!(
            (self, kind),
            (Self::Real, Kind::Float64 | Kind::Float32)
                | (Self::Integer, Kind::Int32 | Kind::Choice(_))
                | (Self::Float64, Kind::Float64)
                | (Self::Float32, Kind::Float32)
                | (Self::Int32, Kind::Int32)
                | (Self::Int64, Kind::Choice(_))
        )
    }

    pub fn name(self) -> String {
        match self {
            Self::Other(name) => name.to_owned(),
            known => format!("{known:?}"),
        }
    }
}
