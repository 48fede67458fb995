//! What can be wrong in a tick, and the limits that are kept whatever comes in.

use super::Inputs;
use crate::error::{Error, attempt, in_range};

/// What was wrong with a tick's inputs, or limited in its outputs; a set of flags.
///
/// ```
/// use epas_friction::Faults;
/// let faults = Faults::LOAD_RANGE | Faults::TORQUE_LIMIT;
/// assert!(faults.any() && faults.contains(Faults::LOAD_RANGE));
/// assert!(!faults.contains(Faults::SPEED_NOT_FINITE));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Faults(u8);

impl Faults {
    /// Nothing is wrong.
    pub const NONE: Self = Self(0);
    /// The nut speed is NaN or infinite: the output is the safe one (no torque).
    pub const SPEED_NOT_FINITE: Self = Self(1);
    /// The axial load is NaN or infinite: the output is the safe one (no torque).
    pub const LOAD_NOT_FINITE: Self = Self(1 << 1);
    /// The nut speed is beyond its limit: the limit stands in for it.
    pub const SPEED_RANGE: Self = Self(1 << 2);
    /// The axial load is beyond its limit: the limit stands in for it.
    pub const LOAD_RANGE: Self = Self(1 << 3);
    /// The friction torque was cut to its limit.
    pub const TORQUE_LIMIT: Self = Self(1 << 4);

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

    /// The flags as bits, in the order of their constants, for a diagnostic message.
    #[inline]
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// This set with `other` added where `condition` holds.
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

/// Bounds that a scene keeps whatever comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limits {
    /// Largest nut speed that is believed, rad/s, 1e-3 to 1e6.
    pub nut_speed: f32,
    /// Largest axial load that is believed, N, 1e-3 to 1e7.
    pub axial_load: f32,
    /// Largest friction torque that is put out, N m, 1e-6 to 1e6.
    pub friction_torque: f32,
}

impl Limits {
    /// The limits, checked.
    ///
    /// # Errors
    /// [`Error`] naming `nut_speed`, `axial_load` or `friction_torque`.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("nut_speed", self.nut_speed, 1e-3, 1e6));
        attempt!(in_range("axial_load", self.axial_load, 1e-3, 1e7));
        attempt!(in_range("friction_torque", self.friction_torque, 1e-6, 1e6));
        Ok(self)
    }

    /// The inputs within their limits, with what was wrong; `None` beside the flags where no number
    /// can stand in.
    #[inline]
    pub(crate) fn admit(&self, inputs: Inputs) -> (Option<Inputs>, Faults) {
        let (admitted, faults) = admit(
            inputs.nut_speed,
            self.nut_speed,
            [inputs.axial_load],
            self.axial_load,
        );
        let admitted = admitted.map(|(nut_speed, [axial_load])| Inputs {
            nut_speed,
            axial_load,
        });
        (admitted, faults)
    }

    /// The friction torque within its limit, and whether it was cut.
    #[inline]
    pub(crate) fn limit_torque(&self, torque: f32) -> (f32, Faults) {
        limit(torque, self.friction_torque)
    }
}

/// A scene's outputs, as far as faults decide them.
pub(super) trait Flagged {
    /// The safe output.
    fn safe(faults: Faults) -> Self;
    /// What was wrong.
    fn faults(&self) -> Faults;
}

/// What a scene makes of admitted inputs, the safe output where nothing was admitted, and how many ticks have
/// been flagged in a row, when it was `ticks` before.
#[inline(always)]
pub(super) fn answered<I, O: Flagged>(
    (admitted, faults): (Option<I>, Faults),
    ticks: u32,
    outputs: impl FnOnce(I, Faults) -> O,
) -> (O, u32) {
    let outputs = match admitted {
        Some(inputs) => outputs(inputs, faults),
        None => O::safe(faults),
    };
    let ticks = if outputs.faults().any() {
        ticks.saturating_add(1)
    } else {
        0
    };
    (outputs, ticks)
}

/// A speed and loads within plus and minus their largest values, with what was wrong; `None` beside the flags
/// where no number can stand in.
#[inline(always)]
pub(super) fn admit<const LOADS: usize>(
    speed: f32,
    largest_speed: f32,
    loads: [f32; LOADS],
    largest_load: f32,
) -> (Option<(f32, [f32; LOADS])>, Faults) {
    let finite = loads.iter().all(|load| load.is_finite());
    if speed.is_finite() && finite {
        let beyond = loads.iter().any(|load| load.abs() > largest_load);
        let faults = Faults::NONE
            .with(speed.abs() > largest_speed, Faults::SPEED_RANGE)
            .with(beyond, Faults::LOAD_RANGE);
        let admitted = (
            bounded(speed, largest_speed),
            loads.map(|load| bounded(load, largest_load)),
        );
        (Some(admitted), faults)
    } else {
        let faults = Faults::NONE
            .with(!speed.is_finite(), Faults::SPEED_NOT_FINITE)
            .with(!finite, Faults::LOAD_NOT_FINITE);
        (None, faults)
    }
}

/// A friction torque or force within its limit, and whether it was cut.
#[inline]
pub(super) fn limit(friction: f32, largest: f32) -> (f32, Faults) {
    (
        bounded(friction, largest),
        Faults::NONE.with(friction.abs() > largest, Faults::TORQUE_LIMIT),
    )
}

/// `value` within plus and minus `bound`.
///
/// Written with comparisons: `max` and `min` become calls of C functions on a Cortex-M, and `clamp`
/// keeps a panic for bounds that are not ordered.
#[inline]
fn bounded(value: f32, bound: f32) -> f32 {
    if value > bound {
        bound
    } else if value < -bound {
        -bound
    } else {
        value
    }
}
