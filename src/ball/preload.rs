//! Two Hertzian springs pressed against each other by a preload, and the preload that remains under a load.
//!
//! Forces `F_U` and `F_D` that push against each other with the deflections `F_U^(2/3)` and `F_D^(2/3)`, both `F_0` without a
//! load, under a load `F = F_U - F_D`: of two flanks of the nut (axial forces), or of two diagonals of a ball.
//!
//! ```text
//! F_U^(2/3) + F_D^(2/3) = 2 F_0^(2/3),   F_U - F_D = F;   from F = 2 sqrt(2) F_0 on F_D is lost, and F_U = F
//! ```

use crate::math::constant;

/// Load over preload at which the unloaded side loses contact: `2^(3/2)`.
#[doc(hidden)]
pub const LOST: f32 = 2.828_427_1;

/// `(12 (2 sqrt(2) - 2) / 8 - 1) / 8`: the sum of the two forces is continuous where the unloaded side is lost.
#[doc(hidden)]
pub const QUARTIC: f32 = 0.030330086;

/// Coefficients `c1`, `c2`, `c3` of [`closing`].
#[doc(hidden)]
pub const CLOSING: [f32; 3] = [0.055_61, -0.044_86, 0.065_821];

/// Preload of a contact below which it counts as 0, N: a rounding below the least of [`Clearance::of_preload`](super::Clearance::of_preload).
const NO_PRELOAD: f32 = 0.99e-3;

/// Preload of a contact, N, `ratio^(3/2)`, from an oversize over that of one newton, `-2 gap / (c_S + c_N)`, above zero, and its root.
pub(crate) const fn preload_of(ratio: f32, root: f32) -> f32 {
    let force = ratio * root;
    if force < NO_PRELOAD { 0.0 } else { force }
}

/// Load with a preload counted, N: `|F| + 2 sqrt(2) F_0`, to which friction under a preload is about in proportion
/// ([`PreloadedElements`](crate::law::memory::PreloadedElements)).
#[inline(always)]
pub(crate) const fn preload_counted(load: f32, lift_off: f32) -> f32 {
    load.abs() + lift_off
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Preload {
    /// `F_0`, N; 0 without a preload.
    force: f32,
    /// `1 / (3 F_0)`, 1/N; 0 without a preload.
    per_three: f32,
}

/// Constants of the sum of both forces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct PreloadSum {
    /// `2 sqrt(2) F_0`, N: the load at which the unloaded side is lost.
    lift_off: f32,
    /// `2 F_0`, N.
    constant: f32,
    /// `1 / (12 F_0)`, 1/N; 0 without a preload.
    square: f32,
    /// `QUARTIC / F_0^2`, 1/N^2; 0 without a preload.
    quartic: f32,
}

impl PreloadSum {
    pub(crate) const fn new(force: f32) -> Self {
        let loaded = force > 0.0;
        Self {
            lift_off: LOST * force,
            constant: 2.0 * force,
            square: if loaded { 1.0 / (12.0 * force) } else { 0.0 },
            quartic: if loaded {
                QUARTIC / (force * force)
            } else {
                0.0
            },
        }
    }

    /// Lift-off, constant and both coefficients of [`Self::under`].
    pub(crate) const fn numbers(&self) -> [f32; 4] {
        [self.lift_off, self.constant, self.square, self.quartic]
    }

    #[inline(always)]
    pub(crate) const fn counted(&self, load: f32) -> f32 {
        preload_counted(load, self.lift_off)
    }

    /// Sum of both forces, N, under a load of either sign, N: `F_0 (2 + y^2/12 + ...)` with `y = F / F_0`, and the load from
    /// `y = 2 sqrt(2)` on. The next coefficient is chosen so that both meet there; the largest error between is 0.84 %.
    #[inline(always)]
    pub(crate) fn under(&self, load: f32) -> f32 {
        let magnitude = load.abs();
        if magnitude < self.lift_off {
            let squared = load * load;
            self.constant + squared * self.square * (1.0 + squared * self.quartic)
        } else {
            magnitude
        }
    }
}

impl Preload {
    pub(crate) const fn new(force: f32) -> Self {
        Self {
            force,
            per_three: if force > 0.0 {
                1.0 / (3.0 * force)
            } else {
                0.0
            },
        }
    }

    /// The larger force, N, under a load not below 0, N: within 9e-4 of the preload.
    #[inline]
    pub(crate) const fn larger(&self, load: f32) -> f32 {
        if load < LOST * self.force {
            let plus = 1.0 + closing(load * self.per_three);
            self.force * (plus * constant::sqrt(plus))
        } else {
            load
        }
    }

    /// Both forces, N, the larger one first, under a load not below 0, N: `F_0 (1 + x)^(3/2)` and `F_0 (1 - x)^(3/2)` with one
    /// displacement `x` over the preload's deflection, within 4e-6 of the preload.
    #[inline]
    pub(crate) const fn both(&self, load: f32) -> (f32, f32) {
        if load < LOST * self.force {
            let third = load * self.per_three;
            let x = closing(third);
            let (plus, minus) = (1.0 + x, not_negative(1.0 - x));
            let (up, down) = (constant::sqrt(plus), constant::sqrt(minus));
            // A step of Newton's method, with the slopes of both powers for their change.
            let excess = plus * up - minus * down - 3.0 * third;
            let step = excess / (up + down);
            let larger = self.force * (up * (plus - step));
            let smaller = self.force * (down * (minus + step));
            (larger, not_negative(smaller))
        } else {
            (load, 0.0)
        }
    }
}

/// `x` where `((1 + x)^(3/2) - (1 - x)^(3/2))/3` is `t`, for `x` in 0 to 1, within 4.3e-4: the series
/// `t (1 + t²/24 + ...)` with minimax coefficients, made again in `host-tests/tests/generators/preload.rs`.
#[inline]
const fn closing(third: f32) -> f32 {
    let [c1, c2, c3] = CLOSING;
    let square = third * third;
    third * (1.0 + square * (c1 + square * (c2 + square * c3)))
}

#[inline]
const fn not_negative(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The larger of two forces with the difference `load` whose deflections add up to twice that of `preload`.
    fn larger(preload: f64, load: f64) -> f64 {
        let deflection = |force: f64| libm::pow(force, 2.0 / 3.0);
        let (mut low, mut high) = (load, load + 2.0 * preload);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if deflection(middle) + deflection(middle - load) < 2.0 * deflection(preload) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Both forces within 4e-6 of the preload, the larger one alone within 9e-4, their sum within 0.85 % of itself.
    #[test]
    fn both_forces_are_those_of_two_hertzian_springs() {
        for preload in [1e-3_f32, 1.0, 250.0, 1e6] {
            let (springs, sum) = (Preload::new(preload), PreloadSum::new(preload));
            let exact = f64::from(preload);
            for step in 0..=1000_u16 {
                let load = preload * (2.828_427 * f32::from(step) / 1000.0);
                let up = larger(exact, f64::from(load));
                let down = up - f64::from(load);
                let (found_up, found_down) = springs.both(load);
                assert!((f64::from(found_up) - up).abs() < 4.5e-6 * exact, "{load}");
                assert!(
                    (f64::from(found_down) - down).abs() < 4.5e-6 * exact,
                    "{load}"
                );
                let alone = f64::from(springs.larger(load));
                assert!((alone - up).abs() < 9e-4 * exact, "{load}: {alone}");
                let found = f64::from(sum.under(-load)) / (up + down) - 1.0;
                assert!(found.abs() < 8.5e-3, "{load}: {found}");
            }
            for load in [2.83 * preload, 100.0 * preload] {
                assert_eq!(springs.both(load), (load, 0.0));
                assert_eq!((springs.larger(load), sum.under(-load)), (load, load));
            }
        }
        let (none, sum) = (Preload::new(0.0), PreloadSum::new(0.0));
        assert_eq!((none.both(3.0), none.larger(3.0)), ((3.0, 0.0), 3.0));
        assert_eq!((sum.under(-3.0), sum.under(0.0)), (3.0, 0.0));
    }
}
