//! A ball's load, and its share of the mean load.

use crate::error::{Error, attempt, in_range};
use crate::ranges;

/// A load above zero and up to 1e7 N as it is; 0 for anything else, NaN included.
#[inline]
pub(crate) const fn loaded(load: f32) -> f32 {
    // Positive numbers are in the order of their bits, everything else is larger: one comparison.
    let bits = load.to_bits();
    f32::from_bits(if bits <= ranges::LOAD.maximum.to_bits() {
        bits
    } else {
        0
    })
}

/// A ball's share of the load and its cube root, folded at set-up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadShare {
    pub(crate) share: f32,
    pub(super) root: f32,
}

impl LoadShare {
    /// The mean load.
    pub const MEAN: Self = Self {
        share: 1.0,
        root: 1.0,
    };

    /// Powers of a ball's load over the mean load of all balls, 0.01 to 100, within 2.1e-7; for constants too.
    pub const fn new(share: f32) -> Result<Self, Error> {
        let share = attempt!(in_range("share", share, 0.01, 100.0));
        // Newton's method from 1, which a constant can take: 14 steps from either end of the range.
        let mut root = 1.0;
        let mut step = 0;
        while step < 16 {
            root -= (root - share / (root * root)) * (1.0 / 3.0);
            step += 1;
        }
        Ok(Self { share, root })
    }

    pub(crate) const fn root(&self) -> f32 {
        self.root
    }

    pub(crate) const fn extremes(shares: &[Self]) -> (Self, Self) {
        let (mut lightest, mut heaviest) = match shares.first() {
            Some(first) => (*first, *first),
            None => (Self::MEAN, Self::MEAN),
        };
        let mut index = 0;
        while index < shares.len() {
            let share = shares[index];
            if share.share < lightest.share {
                lightest = share;
            }
            if share.share > heaviest.share {
                heaviest = share;
            }
            index += 1;
        }
        (lightest, heaviest)
    }

    #[inline]
    pub(crate) const fn two_thirds(&self) -> f32 {
        self.root * self.root
    }

    /// Load over the mean load.
    pub const fn share(&self) -> f32 {
        self.share
    }
}

/// Loads of the balls over their mean along the loaded track, a table for each sign of the load: a screw that bends, or with errors of its
/// groove, shares a push and a pull differently. Entries stand for the middles of equal parts of the loaded track, from its start, and are
/// linear between. `simulate --loads` of the bench program writes them.
///
/// They are weights: a ball carries its share over the sum of those of all loaded balls. Where the load changes its sign, the shares jump from
/// one table to the other; with a preload friction jumps by as much as the sums of `share^(4/3)` differ.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadShares {
    /// Table for loads of zero and above; 1 to 256 entries.
    pub positive: &'static [LoadShare],
    /// Table for loads below zero; as many entries.
    pub negative: &'static [LoadShare],
}

impl LoadShares {
    /// Every ball carries the mean load.
    pub const EVEN: Self = Self::same(&[LoadShare::MEAN]);

    /// One table for both signs of the load.
    #[must_use]
    pub const fn same(shares: &'static [LoadShare]) -> Self {
        Self {
            positive: shares,
            negative: shares,
        }
    }

    pub(crate) const fn are_even(&self) -> bool {
        let [(a, b), (c, d)] = [
            LoadShare::extremes(self.positive),
            LoadShare::extremes(self.negative),
        ];
        a.share == 1.0 && b.share == 1.0 && c.share == 1.0 && d.share == 1.0
    }

    pub(crate) const fn checked(self) -> Result<Self, Error> {
        let entries = self.positive.len() as f32;
        attempt!(in_range("load_shares", entries, 1.0, 256.0));
        let as_many = self.negative.len() as f32;
        attempt!(in_range("load_shares", as_many, entries, entries));
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_both_signs_are_as_long() {
        const HALVES: [LoadShare; 2] = [LoadShare::MEAN; 2];
        for (positive, negative, good) in [
            (&HALVES[..], &HALVES[..], true),
            (&HALVES[..1], &HALVES[..1], true),
            (&HALVES[..], &HALVES[..1], false),
            (&HALVES[..1], &HALVES[..], false),
            (&[], &[], false),
            (&HALVES[..], &[], false),
            (&[LoadShare::MEAN; 256], &[LoadShare::MEAN; 256], true),
            (&[LoadShare::MEAN; 257], &[LoadShare::MEAN; 257], false),
        ] {
            let checked = LoadShares { positive, negative }.checked();
            match checked {
                Ok(_) => assert!(good),
                Err(error) => assert!(!good && error.field() == "load_shares", "{error}"),
            }
        }
    }

    #[test]
    fn loads_that_are_none() {
        for load in [0.0, -0.0, -1.0, f32::NAN, -f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(loaded(load), 0.0);
        }
        assert_eq!(loaded(f32::INFINITY), 0.0);
        assert_eq!(loaded(1e7), 1e7);
        assert_eq!(loaded(70.0), 70.0);
    }

    /// A cube root to one rounding of Newton's last step (1.5 x 2^-24), squared (twice that and a rounding).
    #[test]
    fn load_shares_have_their_powers() {
        const TABLE: [Result<LoadShare, Error>; 2] = [LoadShare::new(0.97), LoadShare::new(0.0)];
        assert!(TABLE[0].is_ok() && TABLE[1].is_err());
        assert_eq!(LoadShare::new(1.0), Ok(LoadShare::MEAN));
        let mut worst = 0.0_f64;
        for step in 0..=40_000_u16 {
            let share = (0.01 * libm::pow(1e4, f64::from(step) / 4e4)) as f32;
            let Ok(powers) = LoadShare::new(share.clamp(0.01, 100.0)) else {
                panic!("{share}")
            };
            let root = libm::cbrt(f64::from(powers.share));
            for (found, truth) in [(powers.root, root), (powers.two_thirds(), root * root)] {
                worst = worst.max((f64::from(found) / truth - 1.0).abs());
            }
        }
        assert!(worst < 2.5e-7, "{worst}");
    }
}
