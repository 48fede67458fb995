//! Why a tick did not count, and what was limited.

/// Why a tick of the adaptation did not count, or what was limited in it; a set of flags.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationFlags(u8);

impl AdaptationFlags {
    /// The tick counted, and nothing was limited.
    pub const NONE: Self = Self(0);
    /// An input is NaN, infinite, or beyond its limit: it did not count.
    pub const INPUT_RANGE: Self = Self(1);
    /// The model's step had a flag: it did not count.
    pub const FAULTED: Self = Self(1 << 1);
    /// The motor was at its limit: it did not count.
    pub const SATURATED: Self = Self(1 << 2);
    /// The mechanism stands, is slower than the least speed, or its friction has not turned round yet: it did not count.
    pub const STANDING: Self = Self(1 << 3);
    /// The model's friction is below the least: it did not count.
    pub const TOO_WEAK: Self = Self(1 << 4);
    /// The error was beyond four of its deviations: it counted as one of four, with as much more noise. The ticks with a correction
    /// say so, four of nine.
    pub const ERROR_CUT: Self = Self(1 << 5);
    /// An estimate is at its bound: friction may be further away than it may tell. Every tick that counts says so.
    pub const AT_BOUND: Self = Self(1 << 6);
    /// The flags with which a tick does not count.
    pub const CLOSED: Self = Self(0x1f);

    /// True where any flag is set.
    #[inline]
    #[must_use]
    pub const fn any(self) -> bool {
        self.0 != 0
    }

    /// True where every flag of `other` is set.
    #[inline]
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// True where the tick counted.
    #[inline]
    #[must_use]
    pub const fn counted(self) -> bool {
        self.0 & Self::CLOSED.0 == 0
    }

    /// The flags as bits, in the order of their constants.
    #[inline]
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// This set with `other` added where `condition` holds.
    #[inline(always)]
    pub(super) const fn with(self, condition: bool, other: Self) -> Self {
        Self(self.0 | if condition { other.0 } else { 0 })
    }
}
