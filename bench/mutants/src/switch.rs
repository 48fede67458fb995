//! Which mutant runs: a module of the changed crate, not of this program.
//!
//! `MUTANT` is the number of the mutant that runs; 0, or nothing, is the crate as it is. With `MUTANT_REACHED`, a file, none runs,
//! and the file says at the end which places were run and which mutants gave another value there.

extern crate std;

use core::sync::atomic::{AtomicBool, AtomicU8, AtomicU32, Ordering::Relaxed};

static ACTIVE: AtomicU32 = AtomicU32::new(0);
static WATCHED: AtomicBool = AtomicBool::new(false);
static REACHED: [AtomicU8; NUMBERS] = [const { AtomicU8::new(0) }; NUMBERS];

/// In the compiler: the crate as it is.
const fn none(_: u32) -> u32 {
    0
}

#[inline(always)]
fn running(place: u32) -> u32 {
    if WATCHED.load(Relaxed) {
        REACHED[place as usize].store(1, Relaxed);
    }
    ACTIVE.load(Relaxed)
}

/// Number of the mutant that runs, at a place, which has the number of its first mutant.
#[inline(always)]
pub const fn at(place: u32) -> u32 {
    core::intrinsics::const_eval_select((place,), none, running)
}

const fn nothing(_: u32, _: bool) {}

#[inline(always)]
fn other(mutant: u32, differs: bool) {
    if differs && WATCHED.load(Relaxed) {
        REACHED[mutant as usize].fetch_or(2, Relaxed);
    }
}

/// That a mutant gives another value here than the crate.
#[inline(always)]
pub const fn differs(mutant: u32, differs: bool) {
    core::intrinsics::const_eval_select((mutant, differs), nothing, other);
}

extern "C" fn start() {
    if let Some(number) = std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()) {
        ACTIVE.store(number, Relaxed);
    }
    if std::env::var_os("MUTANT_REACHED").is_some() {
        WATCHED.store(true, Relaxed);
        // SAFETY: a function of the C library, with a function that lives as long as the program.
        unsafe { atexit(end) };
    }
}

extern "C" fn end() {
    if let Some(file) = std::env::var_os("MUTANT_REACHED") {
        let bytes: std::vec::Vec<u8> = REACHED.iter().map(|reached| reached.load(Relaxed)).collect();
        let _ = std::fs::write(file, bytes);
    }
}

unsafe extern "C" {
    fn atexit(function: extern "C" fn()) -> i32;
}

#[used]
#[unsafe(link_section = ".init_array")]
static START: extern "C" fn() = start;
