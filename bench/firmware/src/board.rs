//! What the programs need of the board: text to the host, the cycle counter, the height of the stack.

// The stack pointer, its memory and the debugger's calls.
#![allow(unsafe_code)]

use core::hint::black_box;
use core::mem::MaybeUninit;

use cortex_m::peripheral::scb::SystemHandler;
use cortex_m::peripheral::{DWT, SCB};
pub use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hio::{HostStream, hstdout};

use crate::check::Screen;
use crate::scenes::{Digest, Run, TICKS, course};

/// The host's screen, through the debugger.
pub struct Console {
    stream: Option<HostStream>,
}

impl Console {
    /// Opens it.
    #[must_use]
    pub fn open() -> Self {
        Self {
            stream: hstdout().ok(),
        }
    }
}

impl Screen for Console {
    #[inline(never)]
    fn bytes(&mut self, bytes: &[u8]) {
        if let Some(stream) = &mut self.stream {
            // Without a debugger the text is lost: a program on the target has no other way to say so.
            let _ = stream.write_all(bytes);
        }
    }
}

/// Starts the cycle counter where there is one.
pub fn start_clock() {
    if let Some(mut core) = cortex_m::Peripherals::take() {
        core.DCB.enable_trace();
        core.DWT.enable_cycle_counter();
    }
}

/// The cycle counter; QEMU's stands still.
#[must_use]
pub fn clock() -> u32 {
    DWT::cycle_count()
}

/// Gives `PendSV` the lowest priority, so that every other interrupt comes in the middle of it.
pub fn give_pend_sv_the_lowest_priority(scb: &mut SCB) {
    // SAFETY: no critical section here is made of priorities.
    unsafe { scb.set_priority(SystemHandler::PendSV, 0xFF) };
}

/// Ends the program with the exit code 0, or 1.
pub fn finish(passed: bool) -> ! {
    debug::exit(if passed { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}

/// What the free stack is painted with.
const PAINT: u32 = 0xA5A5_5A5A;

/// How much of it is painted, in words.
const PAINTED: usize = 2048;

/// Most bytes of stack that a call takes below its caller, over so many calls, each with its number; 8192 where
/// all that was painted is used. The call returns the stack pointer of its caller.
#[inline(never)]
pub fn stack_used(times: u32, work: &mut dyn FnMut(u32) -> u32) -> u32 {
    let top = cortex_m::register::msp::read() as *mut u32;
    for word in 1..=PAINTED {
        // SAFETY: free stack, below everything that is in use and within the memory of the board.
        unsafe { top.sub(word).write_volatile(PAINT) };
    }
    black_box(());
    let mut end = 0;
    for number in 0..times {
        end = work(number);
    }
    black_box(());
    let mut used = PAINTED;
    while used > 0 {
        // SAFETY: as above.
        if unsafe { top.sub(used).read_volatile() } != PAINT {
            break;
        }
        used -= 1;
    }
    (4 * used as u32).saturating_sub(top as u32 - end)
}

#[inline(never)]
fn set_up<S: Run>(place: &mut MaybeUninit<S::Model>) -> Option<&mut S::Model> {
    S::set_up().ok().map(|model| place.write(model))
}

/// A tick in a frame of its own, which counts as the tick's stack.
#[inline(never)]
fn tick<S: Run>(model: &mut S::Model, number: u32, digest: &mut Digest) {
    let (nut_speed, axial_load) = course(number);
    S::tick(model, nut_speed, axial_load, digest);
}

/// Runs a scene in its own image: set-up, then [`TICKS`] ticks; writes the digest of all results and the
/// stack that either takes.
pub fn run<S: Run>(console: &mut Console, place: &mut MaybeUninit<S::Model>) -> bool {
    let (mut place, mut model) = (Some(place), None);
    let set_up_stack = stack_used(1, &mut |_| {
        model = place.take().and_then(set_up::<S>);
        cortex_m::register::msp::read()
    });
    let Some(model) = model else {
        return false;
    };
    let mut digest = Digest::default();
    let stack = stack_used(TICKS, &mut |number| {
        tick::<S>(model, number, &mut digest);
        cortex_m::register::msp::read()
    });
    report(console, S::NAME, [digest.0, stack, set_up_stack]);
    true
}

/// One line of a scene: the program has it once, however many scenes it runs.
#[inline(never)]
fn report(console: &mut Console, name: &str, figures: [u32; 3]) {
    console.text(name);
    for figure in figures {
        console.text(" ");
        console.number(figure);
    }
    console.text("\n");
}

/// Makes a program of some scenes.
#[macro_export]
macro_rules! image {
    ($($scene:ty),*) => {
        #[cortex_m_rt::entry]
        fn main() -> ! {
            let mut console = $crate::board::Console::open();
            let passed = true;
            $(
                let place = cortex_m::singleton!(
                    : core::mem::MaybeUninit<<$scene as $crate::scenes::Run>::Model> =
                        core::mem::MaybeUninit::uninit()
                );
                let passed = passed
                    & place.is_some_and(|place| $crate::board::run::<$scene>(&mut console, place));
            )*
            $crate::board::finish(passed)
        }
    };
}
