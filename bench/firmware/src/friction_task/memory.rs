//! Where calibration pages and measured numbers stand: at addresses that a tool outside reads and writes.

// A tool writes this memory beside the program, so that it has to be read and written as a device is.
#![allow(unsafe_code)]

use core::cell::UnsafeCell;

use cortex_m::interrupt::CriticalSection;

use super::measured::Measured;
use super::page::CalibrationPage;

/// Memory that somebody outside the program reads and writes. Every bit pattern is a `T`: it is made of numbers alone.
#[derive(Debug)]
#[repr(transparent)]
pub struct Outside<T> {
    value: UnsafeCell<T>,
}

// SAFETY: no reference to the value is ever made, and each access by the program has the critical section to itself.
unsafe impl<T: Copy + Send> Sync for Outside<T> {}

impl<T: Copy> Outside<T> {
    const fn new(value: T) -> Self {
        Self {
            value: UnsafeCell::new(value),
        }
    }

    /// What stands there now. Where the tool is writing, some numbers are old and some new: a checksum has to tell.
    #[inline]
    pub fn read(&self, _: &CriticalSection) -> T {
        // SAFETY: a valid address, and nobody in the program writes meanwhile.
        unsafe { self.value.get().read_volatile() }
    }

    /// Writes a value.
    #[inline]
    pub fn write(&self, _: &CriticalSection, value: T) {
        // SAFETY: a valid address, and nobody in the program reads or writes meanwhile.
        unsafe { self.value.get().write_volatile(value) }
    }
}

/// The page in flash.
#[unsafe(no_mangle)]
pub static REFERENCE_PAGE: CalibrationPage = CalibrationPage::REFERENCE;

/// The page in RAM: that of the flash from the start, and then what the tuner makes of it.
#[unsafe(no_mangle)]
pub static WORKING_PAGE: Outside<CalibrationPage> = Outside::new(CalibrationPage::REFERENCE);

/// What the friction task shows.
#[unsafe(no_mangle)]
pub static MEASURED: Outside<Measured> = Outside::new(Measured::NONE);

/// The page in flash as it stands there, whatever the compiler knows of it: it may have been flashed anew without the program.
#[must_use]
pub fn reference_page() -> CalibrationPage {
    // SAFETY: a valid address; numbers alone.
    unsafe { (&raw const REFERENCE_PAGE).read_volatile() }
}
