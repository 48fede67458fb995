//! Tables: the exported functions that make them, and what a configuration's pointers to them lead to.

use core::mem::MaybeUninit;
use core::slice;

use epas_friction::scene::FoldedBall;
use epas_friction::{DeviationMap, LoadShare as CrateLoadShare};

use super::pointers::{bare, report, usable};
use crate::scene::{Pointers, Tables, TrackPointers, TrackTables};
use crate::status::{
    EPAS_FIELD_BLOCK, EPAS_FIELD_FOLDED, EPAS_FIELD_LOAD_SHARE_COUNT, EPAS_FIELD_LOAD_SHARES,
    EPAS_FIELD_PASSING_DEVIATION, EPAS_FIELD_RECIRCULATING_DEVIATION, EPAS_NOT_INITIALISED,
    EPAS_NULL_POINTER, Failure,
};
use crate::tables::{
    Deviation, EPAS_DEVIATION_SAMPLES, EPAS_LARGEST_HARMONIC_COUNT, EPAS_LARGEST_SHARE_COUNT,
    FoldedBallPlace, FoldedBallRangePlace, Harmonic, LoadShare, PlacedTable, Table, decode,
    deviation_of_harmonics, deviation_of_samples, harmonic_count, is_load_share, load_share,
};
use crate::types::{Block, EPAS_SCREW_RANGE_NODES};

/// Makes a deviation, with a period of `turns` turns (1 to 100), of `count` waves (0 to
/// `EPAS_LARGEST_HARMONIC_COUNT`). Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_deviation_from_harmonics(
    place: *mut Deviation,
    turns: u32,
    harmonics: *const Harmonic,
    count: u32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        if count > EPAS_LARGEST_HARMONIC_COUNT {
            return Err(harmonic_count(count));
        }
        if count == 0 {
            return deviation_of_harmonics(turns, &[]);
        }
        usable(harmonics).map_err(bare)?;
        let count = usize::try_from(count).unwrap_or(0);
        deviation_of_harmonics(turns, unsafe { slice::from_raw_parts(harmonics, count) })
    };
    unsafe { place_deviation(place, failure, make) }
}

/// Makes a deviation, with a period of `turns` turns (1 to 100), of `EPAS_DEVIATION_SAMPLES` samples at equal
/// distances from its start, rad, -0.2 to 0.2. Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_deviation_from_samples(
    place: *mut Deviation,
    turns: u32,
    samples: *const f32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        let samples = samples.cast::<[f32; EPAS_DEVIATION_SAMPLES]>();
        usable(samples).map_err(bare)?;
        deviation_of_samples(turns, unsafe { &*samples })
    };
    unsafe { place_deviation(place, failure, make) }
}

/// Decodes a block of a ball screw without cage, for one friction coefficient: at set-up, or in a task while models run that use other
/// places. Where it fails, the place holds none. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_folded_ball_init(
    place: *mut FoldedBallPlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { place_folded::<1, _>(place, block, failure) }
}

/// Decodes a block for a range of friction coefficients; as `epas_folded_ball_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_folded_ball_range_init(
    place: *mut FoldedBallRangePlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { place_folded::<EPAS_SCREW_RANGE_NODES, _>(place, block, failure) }
}

/// Folds `count` shares of the load (1 to `EPAS_LARGEST_SHARE_COUNT`), each a ball's load over the mean load,
/// 0.01 to 100. Set-up only. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_load_shares_init(
    places: *mut LoadShare,
    shares: *const f32,
    count: u32,
    failure: *mut Failure,
) -> u32 {
    let make = || {
        usable(places).map_err(bare)?;
        usable(shares).map_err(bare)?;
        let length = share_count(count)?;
        let places = places.cast::<CrateLoadShare>();
        for (index, number) in (0..length).zip(0..) {
            let share = unsafe { shares.add(index).read() };
            unsafe { places.add(index).write(load_share(number, share)?) };
        }
        Ok(())
    };
    unsafe { report(make(), failure) }
}

/// Puts a table into its place; where it cannot be made, the place holds none.
unsafe fn place_table<T: Table, Place>(
    place: *mut Place,
    failure: *mut Failure,
    make: impl FnOnce(&mut MaybeUninit<T>) -> Result<(), Failure>,
) -> u32 {
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<PlacedTable<MaybeUninit<T>>>();
        unsafe { (&raw mut (*place).mark).write(0) };
        // SAFETY: the place is the caller's and nobody else uses it; a table that is not made is not read, for want of the mark.
        make(unsafe { &mut (*place).table })?;
        unsafe { (&raw mut (*place).mark).write(T::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

/// Puts a deviation into its place.
unsafe fn place_deviation(
    place: *mut Deviation,
    failure: *mut Failure,
    make: impl FnOnce() -> Result<DeviationMap, Failure>,
) -> u32 {
    let put = |table: &mut MaybeUninit<DeviationMap>| {
        table.write(make()?);
        Ok(())
    };
    unsafe { place_table(place, failure, put) }
}

/// Puts a decoded block into its place.
unsafe fn place_folded<const NODES: usize, Place>(
    place: *mut Place,
    block: *const Block,
    failure: *mut Failure,
) -> u32
where
    FoldedBall<NODES>: Table,
{
    let put = |table: &mut MaybeUninit<FoldedBall<NODES>>| {
        usable(block).map_err(bare)?;
        let words = unsafe { words(&*block) }?;
        let none = || Failure::pointer(EPAS_NULL_POINTER, EPAS_FIELD_BLOCK);
        decode(words.ok_or_else(none)?, table)
    };
    unsafe { place_table(place, failure, put) }
}

/// A table that a configuration points to, where it does.
unsafe fn placed_table<T: Table>(
    pointer: *const PlacedTable<T>,
    field: u32,
) -> Result<Option<&'static T>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    usable(pointer).map_err(|status| Failure::pointer(status, field))?;
    if unsafe { (&raw const (*pointer).mark).read() } == T::MARK {
        // SAFETY: the mark says that the table has been made; the caller promises that it stays as long as the model.
        Ok(Some(unsafe { &(*pointer).table }))
    } else {
        Err(Failure::pointer(EPAS_NOT_INITIALISED, field))
    }
}

/// A deviation that a configuration points to, or none.
unsafe fn deviation(
    pointer: *const Deviation,
    field: u32,
) -> Result<&'static DeviationMap, Failure> {
    let found = unsafe { placed_table(pointer.cast(), field) }?;
    Ok(found.unwrap_or(TrackTables::NONE.passing))
}

/// Shares of the load that a configuration points to.
unsafe fn load_shares(
    pointer: *const LoadShare,
    count: u32,
) -> Result<&'static [CrateLoadShare], Failure> {
    if pointer.is_null() {
        return Ok(TrackTables::NONE.load_shares);
    }
    usable(pointer).map_err(|status| Failure::pointer(status, EPAS_FIELD_LOAD_SHARES))?;
    let length = share_count(count)?;
    let shares = unsafe { slice::from_raw_parts(pointer.cast::<CrateLoadShare>(), length) };
    match (0..).zip(shares).find(|(_, share)| !is_load_share(**share)) {
        None => Ok(shares),
        Some((index, _)) => Err(Failure {
            index,
            ..Failure::pointer(EPAS_NOT_INITIALISED, EPAS_FIELD_LOAD_SHARES)
        }),
    }
}

/// A number of shares within its range.
fn share_count(count: u32) -> Result<usize, Failure> {
    let refused = Failure::count(
        EPAS_FIELD_LOAD_SHARE_COUNT,
        count,
        1,
        EPAS_LARGEST_SHARE_COUNT,
    );
    if (1..=EPAS_LARGEST_SHARE_COUNT).contains(&count) {
        usize::try_from(count).map_err(|_| refused)
    } else {
        Err(refused)
    }
}

/// What a configuration points to. A scene without tables along a track does not link what checks them.
#[inline(always)]
pub(super) unsafe fn tables<F: Table>(pointers: &Pointers<F>) -> Result<Tables<F>, Failure> {
    let track = &pointers.track;
    Ok(Tables {
        track: if track.are_null() {
            TrackTables::NONE
        } else {
            unsafe { track_tables(track) }?
        },
        block: unsafe { words(&pointers.block) }?,
        folded: unsafe { placed_table(pointers.folded, EPAS_FIELD_FOLDED) }?,
    })
}

#[inline(never)]
unsafe fn track_tables(pointers: &TrackPointers) -> Result<TrackTables, Failure> {
    Ok(TrackTables {
        passing: unsafe { deviation(pointers.passing, EPAS_FIELD_PASSING_DEVIATION) }?,
        recirculating: unsafe {
            deviation(pointers.recirculating, EPAS_FIELD_RECIRCULATING_DEVIATION)
        }?,
        load_shares: unsafe { load_shares(pointers.load_shares, pointers.load_share_count) }?,
    })
}

/// The words of a block, where there is a pointer to them.
#[inline(always)]
unsafe fn words(block: &Block) -> Result<Option<&'static [u32]>, Failure> {
    if block.words.is_null() {
        return Ok(None);
    }
    usable(block.words).map_err(|status| Failure::pointer(status, EPAS_FIELD_BLOCK))?;
    Ok(Some(unsafe {
        slice::from_raw_parts(block.words, block.count as usize)
    }))
}
