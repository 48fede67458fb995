//! Where on the track balls carry load, and what they find there.

use super::deviation::{DeviationMap, PHASE_BITS};
use super::phase::UNITS;
use crate::ball::{LoadShare, LoadShares};
use crate::error::{Error, attempt};

/// Fraction bits of the ratio of the load table's entries.
const FRACTION_BITS: u32 = 16;

/// Deviation maps of both grooves and the shares of the load, in integers along the track.
///
/// The track runs through the body in which balls recirculate (nut, carriage): first the loaded part,
/// then the return. The other groove (screw, rail) passes by.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct LoadedZone {
    /// Entries of the load table along the whole track: balls are loaded as long as the table lasts.
    entries: u32,
    /// Phase of each map at the end of the track, in units of 2^-20 of its period.
    passing_ratio: u32,
    recirculating_ratio: u32,
    passing: &'static DeviationMap,
    recirculating: &'static DeviationMap,
    shares: LoadShares,
}

/// A loaded ball: deviations of the grooves at its contacts, and its share of the load.
pub(crate) struct LoadedBall {
    /// Deviation of the groove that passes by, as a multiple of the first of [`LoadedZone::units`].
    pub(crate) passing: f32,
    /// Deviation of the groove of the body in which balls recirculate, as a multiple of the second.
    pub(crate) recirculating: f32,
    /// Its load over the mean load.
    pub(crate) load: &'static LoadShare,
}

impl LoadedZone {
    /// A track of `length` with `loaded` of it under load, in turns or wavelengths of the maps.
    pub(super) const fn new(
        loaded: f32,
        length: f32,
        passing: &'static DeviationMap,
        recirculating: &'static DeviationMap,
        shares: LoadShares,
    ) -> Result<Self, Error> {
        let shares = attempt!(shares.checked());
        // Rounded up to a whole number, which ends the table at most 2e-5 of the track too early. What rounding may have added is
        // taken off first, so that a track without return has exactly its entries.
        let entries =
            shares.positive.len() as f32 * length / loaded * (1_u32 << FRACTION_BITS) as f32;
        let entries = (entries * (1.0 - 4.0 * f32::EPSILON)) as u32 + 1;
        Ok(Self {
            entries,
            passing_ratio: phase_ratio(passing, length),
            recirculating_ratio: phase_ratio(recirculating, length),
            passing,
            recirculating,
            shares,
        })
    }

    /// Shares of the balls where the load is below zero, or else where it is not.
    #[inline(always)]
    pub(super) const fn shares(&self, negative: bool) -> &'static [LoadShare] {
        self.shares.of(negative)
    }

    /// The ball at `position`, if it is loaded, when the passing groove is at `phase` and the balls
    /// have these [`LoadedZone::shares`].
    #[inline(always)]
    pub(super) fn at(
        &self,
        position: u32,
        phase: u32,
        shares: &'static [LoadShare],
    ) -> Option<LoadedBall> {
        let scaled = |ratio: u32| ((u64::from(position) * u64::from(ratio)) >> 32) as u32;
        let load = shares.get((scaled(self.entries) >> FRACTION_BITS) as usize)?;
        let passing = scaled(self.passing_ratio).wrapping_add(phase >> (32 - PHASE_BITS));
        Some(LoadedBall {
            passing: self.passing.units(passing) as f32,
            recirculating: self.recirculating.units(scaled(self.recirculating_ratio)) as f32,
            load,
        })
    }

    /// Units of the deviations of the passing groove and of the recirculating one, rad.
    #[inline(always)]
    pub(super) const fn units(&self) -> (f32, f32) {
        (self.passing.unit(), self.recirculating.unit())
    }

    /// Turns of the maps in a period of the passing groove.
    #[inline]
    pub(super) fn passing_turns(&self) -> f32 {
        f32::from(self.passing.turns())
    }

    /// Phase of the passing groove, in units of 2^-32, per turn or wavelength.
    pub(super) const fn phase_per_turn(&self) -> f32 {
        UNITS / self.passing.turns() as f32
    }
}

/// Phase of a map at the end of a track of `length` turns, in units of 2^-20 of its period.
const fn phase_ratio(map: &DeviationMap, length: f32) -> u32 {
    let ratio = length / map.turns() as f32;
    (ratio * (1_u32 << PHASE_BITS) as f32) as u32
}
