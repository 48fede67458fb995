//! What can be wrong in a tick.

/// What was wrong with a tick's inputs, limited in its outputs, or beyond the model; a set of flags.
///
/// [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`] speak of accuracy alone: they are in [`Faults::any`], not in [`Faults::faulty`].
///
/// ```
/// use epas_friction::Faults;
/// let faults = Faults::LOAD_RANGE | Faults::FRICTION_LIMIT;
/// assert!(faults.any() && faults.contains(Faults::LOAD_RANGE));
/// assert!(!faults.contains(Faults::SPEED_NOT_FINITE));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Faults(u16);

impl Faults {
    /// Nothing is wrong.
    pub const NONE: Self = Self(0);
    /// The speed is NaN or infinite: the output is the safe one (no friction), or with memory that of the last sound inputs.
    pub const SPEED_NOT_FINITE: Self = Self(1);
    /// A load is NaN or infinite: as for the speed.
    pub const LOAD_NOT_FINITE: Self = Self(1 << 1);
    /// The speed is beyond its limit: the limit is used instead.
    pub const SPEED_RANGE: Self = Self(1 << 2);
    /// A load is beyond its limit: the limit is used instead.
    pub const LOAD_RANGE: Self = Self(1 << 3);
    /// The friction of the output was cut to its limit; or it was NaN, which no scene is known to make, and the output is zero.
    pub const FRICTION_LIMIT: Self = Self(1 << 4);
    /// The friction is less accurate than stated: the mechanism is outside the range of its formulas. The output is the best estimate, finite
    /// and continuous, and no reason to take the friction away. Each scene says where this begins.
    pub const BEYOND_MODEL: Self = Self(1 << 5);
    /// Forces between balls are less accurate than stated, while the friction is not: compensation and adaptation go on.
    pub const FORCES_NOT_HELD: Self = Self(1 << 6);
    /// A reading of the angle is missing or cannot be right: friction stays where it is, and the next reading spans the gap.
    pub const ANGLE_NOT_VALID: Self = Self(1 << 7);
    /// The temperature is NaN or beyond its range: that of the configuration is used instead.
    pub const TEMPERATURE_RANGE: Self = Self(1 << 8);
    /// A load is older than it may be: its friction fades away.
    pub const LOAD_STALE: Self = Self(1 << 9);
    /// A temperature is older than it may be: that of the configuration is used instead.
    pub const TEMPERATURE_STALE: Self = Self(1 << 10);

    /// True where any flag is set.
    #[inline]
    #[must_use]
    pub const fn any(self) -> bool {
        self.0 != 0
    }

    /// True where an input was wrong or an output was limited: any flag but
    /// [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`].
    #[inline]
    #[must_use]
    pub const fn faulty(self) -> bool {
        self.0 & !(Self::BEYOND_MODEL.0 | Self::FORCES_NOT_HELD.0) != 0
    }

    /// True where the output friction is not that of the inputs, or less accurate than stated: any flag but [`Faults::FORCES_NOT_HELD`].
    #[inline]
    #[must_use]
    pub const fn doubtful(self) -> bool {
        self.0 & !Self::FORCES_NOT_HELD.0 != 0
    }

    /// True where every flag of `other` is set.
    #[inline]
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The flags as bits, in the order of their constants, for a diagnostic message.
    pub const fn bits(self) -> u16 {
        self.0
    }

    pub(super) const fn of_bits(bits: u16) -> Self {
        Self(bits)
    }

    #[inline(always)]
    pub(super) const fn beyond(speed: bool, load: bool) -> Self {
        Self::NONE
            .with(speed, Self::SPEED_RANGE)
            .with(load, Self::LOAD_RANGE)
    }

    #[inline(always)]
    pub(super) const fn not_finite(speed: bool, load: bool) -> Self {
        Self::NONE
            .with(speed, Self::SPEED_NOT_FINITE)
            .with(load, Self::LOAD_NOT_FINITE)
    }

    #[inline]
    #[must_use]
    pub(crate) const fn with(self, condition: bool, other: Self) -> Self {
        if condition {
            Self(self.0 | other.0)
        } else {
            self
        }
    }
}

impl core::ops::BitOr for Faults {
    type Output = Self;

    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl core::ops::BitOrAssign for Faults {
    #[inline]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// `value` within plus and minus `bound`: `max` and `min` become calls on a Cortex-M, `clamp` keeps a panic.
#[inline(always)]
pub(super) const fn bounded(value: f32, bound: f32) -> f32 {
    if value > bound {
        bound
    } else if value < -bound {
        -bound
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_contains_its_flags_and_no_others() {
        let both = Faults::LOAD_RANGE | Faults::BEYOND_MODEL;
        assert!(both.contains(Faults::LOAD_RANGE) && both.contains(both));
        assert!(!both.contains(Faults::SPEED_RANGE));
        assert!(!both.contains(Faults::LOAD_RANGE | Faults::SPEED_RANGE));
        assert!(both.contains(Faults::NONE));
    }

    #[test]
    fn accuracy_is_no_fault() {
        assert!(Faults::BEYOND_MODEL.any() && !Faults::BEYOND_MODEL.faulty());
        assert!(Faults::FORCES_NOT_HELD.any() && !Faults::FORCES_NOT_HELD.faulty());
        assert!(!Faults::FORCES_NOT_HELD.doubtful() && Faults::BEYOND_MODEL.doubtful());
        assert!((Faults::BEYOND_MODEL | Faults::LOAD_RANGE).faulty());
        assert!(Faults::LOAD_RANGE.faulty() && !Faults::NONE.faulty());
    }
}
