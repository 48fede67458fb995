//! The control loop in the `SysTick` interrupt, at 1 kHz.

#![no_std]
#![no_main]

use core::cell::{Cell, RefCell};

use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use epas_firmware::board::{Console, clock, finish};
use epas_firmware::check::Screen as _;
use epas_firmware::control_loop::{ControlLoop, RECORDED};

/// Clock of the core, Hz: that of the reference board, or of the board at hand.
const CORE_CLOCK: u32 = number(option_env!("EPAS_CORE_CLOCK"), 25_000_000);

/// What the interrupt has, and what the main program looks at when it is over.
static LOOP: Mutex<RefCell<Option<ControlLoop>>> = Mutex::new(RefCell::new(None));
static OVER: Mutex<Cell<bool>> = Mutex::new(Cell::new(false));
static MOST_CYCLES: Mutex<Cell<u32>> = Mutex::new(Cell::new(0));

#[exception]
fn SysTick() {
    free(|key| {
        let Ok(mut control) = LOOP.borrow(key).try_borrow_mut() else {
            return;
        };
        let Some(control) = control.as_mut() else {
            return;
        };
        let start = clock();
        let goes_on = control.tick();
        let cycles = clock().wrapping_sub(start);
        let most = MOST_CYCLES.borrow(key);
        if cycles > most.get() {
            most.set(cycles);
        }
        OVER.borrow(key).set(!goes_on);
    });
}

#[entry]
fn main() -> ! {
    let mut console = Console::open();
    let (Some(mut core), Ok(control)) = (cortex_m::Peripherals::take(), ControlLoop::new(RECORDED))
    else {
        finish(false)
    };
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    free(|key| {
        if let Ok(mut place) = LOOP.borrow(key).try_borrow_mut() {
            *place = Some(control);
        }
    });
    core.SYST.set_clock_source(SystClkSource::Core);
    core.SYST.set_reload(CORE_CLOCK / 1000 - 1);
    core.SYST.clear_current();
    core.SYST.enable_counter();
    core.SYST.enable_interrupt();
    while !free(|key| OVER.borrow(key).get()) {
        cortex_m::asm::wfi();
    }
    core.SYST.disable_interrupt();
    let (passed, digest, cycles) = free(|key| {
        let control = LOOP.borrow(key).try_borrow();
        let control = control.as_ref().ok().and_then(|control| control.as_ref());
        (
            control.is_some_and(ControlLoop::passed),
            control.map_or(0, ControlLoop::digest),
            MOST_CYCLES.borrow(key).get(),
        )
    });
    console.text(if passed {
        "the control loop gives what the host found: digest "
    } else {
        "the control loop differs from the host: digest "
    });
    console.number(digest);
    if cycles > 0 {
        console.text(", at most ");
        console.number(cycles);
        console.text(" cycles a tick for all scenes");
    }
    console.text("\n");
    finish(passed)
}

/// A number given in decimals, or another one.
const fn number(text: Option<&str>, otherwise: u32) -> u32 {
    let Some(text) = text else {
        return otherwise;
    };
    match u32::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("EPAS_CORE_CLOCK is the clock in Hz"),
    }
}
