//! Tables: the exported functions that make them, and what a configuration's pointers to them lead to.

use core::slice;

use epas_friction::{DeviationMap, LoadShare as CrateLoadShare};

use super::pointers::{bare, report, usable};
use crate::scene::{TablePointers, Tables};
use crate::status::{
    EPAS_FIELD_BLOCK, EPAS_FIELD_LOAD_SHARE_COUNT, EPAS_FIELD_LOAD_SHARES,
    EPAS_FIELD_PASSING_DEVIATION, EPAS_FIELD_RECIRCULATING_DEVIATION, EPAS_NOT_INITIALISED,
    Failure,
};
use crate::tables::{
    Deviation, EPAS_DEVIATION_SAMPLES, EPAS_LARGEST_HARMONIC_COUNT, EPAS_LARGEST_SHARE_COUNT,
    Harmonic, LoadShare, PlacedDeviation, deviation_of_harmonics, deviation_of_samples,
    harmonic_count, is_load_share, load_share,
};

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

/// Puts a deviation into its place; where it cannot be made, the place holds none.
unsafe fn place_deviation(
    place: *mut Deviation,
    failure: *mut Failure,
    make: impl FnOnce() -> Result<DeviationMap, Failure>,
) -> u32 {
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<PlacedDeviation>();
        unsafe { (&raw mut (*place).mark).write(0) };
        let map = make()?;
        unsafe { (&raw mut (*place).map).write(map) };
        unsafe { (&raw mut (*place).mark).write(PlacedDeviation::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

/// A deviation that a configuration points to.
unsafe fn deviation(
    pointer: *const Deviation,
    field: u32,
) -> Result<&'static DeviationMap, Failure> {
    if pointer.is_null() {
        return Ok(Tables::NONE.passing);
    }
    usable(pointer).map_err(|status| Failure::pointer(status, field))?;
    let placed = pointer.cast::<PlacedDeviation>();
    if unsafe { (&raw const (*placed).mark).read() } == PlacedDeviation::MARK {
        Ok(unsafe { &(*placed).map })
    } else {
        Err(Failure::pointer(EPAS_NOT_INITIALISED, field))
    }
}

/// Shares of the load that a configuration points to.
unsafe fn load_shares(
    pointer: *const LoadShare,
    count: u32,
) -> Result<&'static [CrateLoadShare], Failure> {
    if pointer.is_null() {
        return Ok(Tables::NONE.load_shares);
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

/// The tables of a configuration. A scene that has none does not link what checks them.
#[inline(always)]
pub(super) unsafe fn tables(pointers: &TablePointers) -> Result<Tables, Failure> {
    if pointers.are_null() {
        Ok(Tables {
            block: unsafe { block(pointers) }?,
            ..Tables::NONE
        })
    } else {
        unsafe { pointed_tables(pointers) }
    }
}

#[inline(never)]
unsafe fn pointed_tables(pointers: &TablePointers) -> Result<Tables, Failure> {
    Ok(Tables {
        passing: unsafe { deviation(pointers.passing, EPAS_FIELD_PASSING_DEVIATION) }?,
        recirculating: unsafe {
            deviation(pointers.recirculating, EPAS_FIELD_RECIRCULATING_DEVIATION)
        }?,
        load_shares: unsafe { load_shares(pointers.load_shares, pointers.load_share_count) }?,
        block: None,
    })
}

/// The words of a block, where there is a pointer to them.
#[inline(always)]
unsafe fn block(pointers: &TablePointers) -> Result<Option<&'static [u32]>, Failure> {
    if pointers.block.is_null() {
        return Ok(None);
    }
    usable(pointers.block).map_err(|status| Failure::pointer(status, EPAS_FIELD_BLOCK))?;
    Ok(Some(unsafe {
        core::slice::from_raw_parts(pointers.block, pointers.block_words as usize)
    }))
}
