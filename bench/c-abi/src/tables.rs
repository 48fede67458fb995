//! Tables that several models may share: deviations along a groove, shares of the load, what a host has folded of a ball.

use core::mem::MaybeUninit;

use epas_friction::scene::{FoldedBall, HIGHEST_ORDER};
use epas_friction::{DeviationMap, Harmonic as CrateHarmonic};

use crate::status::{
    EPAS_FIELD_BLOCK, EPAS_FIELD_COSINE, EPAS_FIELD_DEVIATION, EPAS_FIELD_HARMONIC_COUNT,
    EPAS_FIELD_ORDER, EPAS_FIELD_SHARE, EPAS_FIELD_SINE, EPAS_FIELD_TURNS, Failure,
};
use crate::types::EPAS_SCREW_RANGE_NODES;
use crate::version::mark;

/// Samples in a period of a deviation.
pub const EPAS_DEVIATION_SAMPLES: usize = 64;

/// Largest number of harmonics: one of each order, 0 to 8.
pub const EPAS_LARGEST_HARMONIC_COUNT: u32 = 9u32;
const HARMONICS: usize = EPAS_LARGEST_HARMONIC_COUNT as usize;
const _: () = assert!(HARMONICS == HIGHEST_ORDER as usize + 1);

/// Largest number of shares of the load.
pub const EPAS_LARGEST_SHARE_COUNT: u32 = 256u32;

/// One wave of a deviation along a groove: `cosine cos(order p) + sine sin(order p)` at the phase `p` of
/// its period.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Harmonic {
    /// Waves in a period, 0 (a constant) to 8.
    pub order: u32,
    /// Amplitude of the cosine, rad, -0.2 to 0.2.
    pub cosine: f32,
    /// Amplitude of the sine, rad, -0.2 to 0.2.
    pub sine: f32,
}

/// Size of `epas_deviation_t` in words of four bytes.
pub const EPAS_DEVIATION_WORDS: usize = 67;

/// Place for the deviation of a groove's contact angles, periodic along the track: where it is positive the
/// right flank's contact angle is larger by it and the left flank's smaller. The caller provides it, and
/// leaves it where and as it is for as long as a model is used that was given it. Models may share it.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Deviation {
    /// Not for the caller.
    pub words: [u32; EPAS_DEVIATION_WORDS],
}

/// Place for the load of a ball over the mean load; provided, left alone and shared as `epas_deviation_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct LoadShare {
    /// Not for the caller.
    pub words: [u32; 2],
}

/// Size of `epas_folded_ball_t` in words of four bytes.
pub const EPAS_FOLDED_BALL_WORDS: usize = 2544;

/// Size of `epas_folded_ball_range_t` in words of four bytes.
pub const EPAS_FOLDED_BALL_RANGE_WORDS: usize = 7606;

/// Place for a block of a ball screw without cage, decoded, for one friction coefficient. `epas_folded_ball_init` decodes it. The
/// caller provides it, and leaves it where and as it is for as long as a model is used that was given it: a model reads it in every
/// step. Models may share it.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct FoldedBallPlace {
    /// Not for the caller.
    pub words: [u32; EPAS_FOLDED_BALL_WORDS],
}

/// Place for a decoded block for a range of friction coefficients; as `epas_folded_ball_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct FoldedBallRangePlace {
    /// Not for the caller.
    pub words: [u32; EPAS_FOLDED_BALL_RANGE_WORDS],
}

/// A table in its place, with the mark that says that there is one.
#[repr(C)]
pub(crate) struct PlacedTable<T> {
    pub(crate) mark: u32,
    pub(crate) table: T,
}

/// What a [`PlacedTable`] may hold.
pub(crate) trait Table: 'static {
    const MARK: u32;
}

/// No table: of a scene that points to none.
pub(crate) enum NoTable {}

impl Table for NoTable {
    const MARK: u32 = mark(0xB0);
}

impl Table for DeviationMap {
    const MARK: u32 = mark(0xD0);
}

impl Table for FoldedBall<1> {
    const MARK: u32 = mark(0xB1);
}

impl Table for FoldedBall<EPAS_SCREW_RANGE_NODES> {
    const MARK: u32 = mark(0xB3);
}

/// Whether a place is as large as the table in it.
const fn fits<T, Place>() -> bool {
    size_of::<PlacedTable<T>>() == size_of::<Place>()
        && align_of::<PlacedTable<T>>() <= align_of::<Place>()
}

const _: () = assert!(fits::<DeviationMap, Deviation>(), "EPAS_DEVIATION_WORDS");
const _: () = assert!(
    fits::<FoldedBall<1>, FoldedBallPlace>(),
    "EPAS_FOLDED_BALL_WORDS"
);
const _: () = assert!(
    fits::<FoldedBall<EPAS_SCREW_RANGE_NODES>, FoldedBallRangePlace>(),
    "EPAS_FOLDED_BALL_RANGE_WORDS"
);
const _: () = assert!(
    size_of::<epas_friction::LoadShare>() == size_of::<LoadShare>()
        && align_of::<epas_friction::LoadShare>() <= align_of::<LoadShare>(),
    "LoadShare"
);

/// A number of turns as the crate takes it, and what was really asked for where that is refused.
fn with_turns(
    turns: u32,
    map: impl FnOnce(u16) -> Result<DeviationMap, epas_friction::Error>,
) -> Result<DeviationMap, Failure> {
    map(u16::try_from(turns).unwrap_or(u16::MAX)).map_err(|error| {
        let mut failure = Failure::of(error);
        if failure.field == EPAS_FIELD_TURNS {
            failure.value = turns as f32;
        }
        failure
    })
}

/// A deviation of up to nine waves.
pub(crate) fn deviation_of_harmonics(
    turns: u32,
    harmonics: &[Harmonic],
) -> Result<DeviationMap, Failure> {
    let mut waves = [CrateHarmonic::default(); HARMONICS];
    let Some(waves) = waves.get_mut(..harmonics.len()) else {
        return Err(harmonic_count(
            u32::try_from(harmonics.len()).unwrap_or(u32::MAX),
        ));
    };
    for ((index, harmonic), wave) in (0..).zip(harmonics).zip(waves.iter_mut()) {
        let Harmonic {
            order,
            cosine,
            sine,
        } = *harmonic;
        let Ok(order) = u8::try_from(order) else {
            return Err(Failure {
                index,
                ..Failure::count(EPAS_FIELD_ORDER, order, 0, u32::from(HIGHEST_ORDER))
            });
        };
        *wave = CrateHarmonic {
            order,
            cosine,
            sine,
        };
    }
    with_turns(turns, |turns| DeviationMap::from_harmonics(turns, waves)).map_err(|failure| {
        // The first wave with the value that was refused.
        let is_at = |harmonic: &Harmonic| match failure.field {
            EPAS_FIELD_ORDER => harmonic.order as f32 == failure.value,
            EPAS_FIELD_COSINE => harmonic.cosine.to_bits() == failure.value.to_bits(),
            EPAS_FIELD_SINE => harmonic.sine.to_bits() == failure.value.to_bits(),
            _ => false,
        };
        indexed(failure, harmonics.iter().position(is_at))
    })
}

/// A deviation by its samples.
pub(crate) fn deviation_of_samples(
    turns: u32,
    samples: &[f32; EPAS_DEVIATION_SAMPLES],
) -> Result<DeviationMap, Failure> {
    with_turns(turns, |turns| DeviationMap::from_samples(turns, samples)).map_err(|failure| {
        let is_at = |sample: &f32| {
            failure.field == EPAS_FIELD_DEVIATION && sample.to_bits() == failure.value.to_bits()
        };
        indexed(failure, samples.iter().position(is_at))
    })
}

/// Too many harmonics.
pub(crate) const fn harmonic_count(count: u32) -> Failure {
    Failure::count(
        EPAS_FIELD_HARMONIC_COUNT,
        count,
        0,
        EPAS_LARGEST_HARMONIC_COUNT,
    )
}

/// Decodes a block's words where the folded ball goes, and sees that its law is one that a model takes. A folded ball is large: what is
/// returned is no copy of it.
#[inline(never)]
pub(crate) fn decode<const NODES: usize>(
    words: &[u32],
    place: &mut MaybeUninit<FoldedBall<NODES>>,
) -> Result<(), Failure> {
    let folded = place.write(FoldedBall::EMPTY);
    folded.read_from(words).map_err(Failure::of_block)?;
    let law = folded.law.checked();
    law.map_err(|error| Failure::at(error, EPAS_FIELD_BLOCK))
}

/// One share of the load.
pub(crate) fn load_share(index: u32, share: f32) -> Result<epas_friction::LoadShare, Failure> {
    epas_friction::LoadShare::new(share).map_err(|error| Failure {
        index,
        ..Failure::at(error, EPAS_FIELD_SHARE)
    })
}

/// Whether a place holds what [`load_share`] makes.
pub(crate) fn is_load_share(share: epas_friction::LoadShare) -> bool {
    epas_friction::LoadShare::new(share.share()).is_ok_and(|made| made == share)
}

fn indexed(failure: Failure, position: Option<usize>) -> Failure {
    Failure {
        index: position
            .and_then(|position| u32::try_from(position).ok())
            .unwrap_or(0),
        ..failure
    }
}
