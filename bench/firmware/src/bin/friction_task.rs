//! The friction task of 1 kHz under a current loop of 20 kHz, with a simulated vehicle; see `epas_firmware::friction_task`.
//!
//! Two interrupts share the model. The current loop never waits: where the friction task is in the middle of a step, it keeps
//! its torque for one tick of 50 us. So the model stands in a lock that can be tried and not waited for, instead of in a
//! critical section, which would hold the current loop off for a whole step.

#![no_std]
#![no_main]

use core::cell::{Cell, RefCell};
use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::SCB;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use epas_firmware::board::{Console, finish, give_pend_sv_the_lowest_priority};
use epas_firmware::check::Screen as _;
use epas_firmware::friction_task::fast::FastTask;
use epas_firmware::friction_task::gear::Gear;
use epas_firmware::friction_task::judge::Judge;
use epas_firmware::friction_task::memory::{MEASURED, WORKING_PAGE, reference_page};
use epas_firmware::friction_task::page::Calibration;
use epas_firmware::friction_task::reaction::ReactionParameters;
use epas_firmware::friction_task::slow::{Message, Reading, SlowInputs, SlowTask};
use epas_firmware::friction_task::vehicle::{self, EVENTS, Motor, STEPS};
use epas_firmware::friction_task::watch::{Offer, PageReport, Watch};
use epas_firmware::friction_task::{RATIO, judge};
use try_lock::TryLock;

/// Counts of the timer in a tick of the current loop. QEMU counts one for 40 instructions: 8,400 instructions, as many as a core
/// at 168 MHz has cycles in 50 us. On a board: its clock over 20,000.
const FAST_COUNTS: u32 = match option_env!("EPAS_CORE_CLOCK") {
    Some(clock) => match u32::from_str_radix(clock, 10) {
        Ok(clock) => clock / 20_000,
        Err(_) => panic!("EPAS_CORE_CLOCK is the clock in Hz"),
    },
    None => 210,
};

/// The model, for whoever takes it first. The friction task always finds it free: the current loop gives it back before the
/// task goes on.
static GEAR: TryLock<Option<Gear>> = TryLock::new(None);

/// The friction task, which has it for itself once the interrupts run.
static SLOW: TryLock<Option<SlowTask>> = TryLock::new(None);

/// From the current loop to the friction task: last reading of the encoder, last torque (bits of f32).
static READING: Mutex<Cell<Reading>> = Mutex::new(Cell::new(Reading::NONE));
static TORQUE: AtomicU32 = AtomicU32::new(0);

/// From the friction task to the current loop: ticks so far, and how torque is output.
static STEPS_DONE: AtomicU32 = AtomicU32::new(0);
static REACTION: Mutex<Cell<ReactionParameters>> =
    Mutex::new(Cell::new(ReactionParameters::of(&Calibration::REFERENCE)));

/// From the background to the friction task: a calibration that may be taken, and what was found of the page.
static OFFER: TryLock<Option<Offer>> = TryLock::new(None);
static PAGE: Mutex<Cell<PageReport>> = Mutex::new(Cell::new(PageReport::START));

/// Mailboxes of a bus: what came since the friction task looked.
static LOAD: Mutex<Cell<Option<Message>>> = Mutex::new(Cell::new(None));
static TEMPERATURE: Mutex<Cell<Option<Message>>> = Mutex::new(Cell::new(None));

/// What the run shows, and how many ticks kept their torque.
static JUDGE: Mutex<RefCell<Judge>> = Mutex::new(RefCell::new(Judge::START));
static BUSY: AtomicU32 = AtomicU32::new(0);
static OVER: AtomicBool = AtomicBool::new(false);

/// The current loop.
#[exception]
fn SysTick() {
    static mut TICK: u32 = 0;
    static mut TASK: FastTask = FastTask::START;
    static mut MOTOR: Motor = Motor::START;

    let time = *TICK / RATIO;
    if time >= STEPS {
        OVER.store(true, Ordering::Release);
        return;
    }
    // On a board: the encoder over SPI.
    let counts = MOTOR.counts(*TICK);
    let parameters = free(|key| {
        READING.borrow(key).set(Reading {
            counts,
            tick: *TICK,
        });
        REACTION.borrow(key).get()
    });
    let steps = STEPS_DONE.load(Ordering::Acquire);
    let mut gear = GEAR.try_lock();
    let gear = gear.as_mut().and_then(|gear| gear.as_mut());
    // On a board: to the current controller, added to what the assistance asks for.
    let torque = TASK.tick(gear, counts, steps, &parameters);
    TORQUE.store(torque.to_bits(), Ordering::Release);
    BUSY.store(TASK.busy, Ordering::Release);
    judge(|judge| judge.fast(time, torque));

    if (*TICK).is_multiple_of(RATIO) {
        receive(time);
        SCB::set_pendsv();
    }
    *TICK = TICK.wrapping_add(1);
}

/// On a board: the interrupt of the bus.
fn receive(time: u32) {
    free(|key| {
        for (mailbox, message) in [
            (&LOAD, vehicle::load(time)),
            (&TEMPERATURE, vehicle::temperature(time)),
        ] {
            if message.is_some() {
                mailbox.borrow(key).set(message);
            }
        }
    });
}

/// The friction task.
#[exception]
fn PendSV() {
    static mut TIME: u32 = 0;

    // What else the task has to do, in place of your own: it puts the step at any phase of the current loop.
    cortex_m::asm::delay(*TIME * 797 % 8400);
    if let Some(mut task) = SLOW.try_lock()
        && let Some(task) = task.as_mut()
    {
        slow(task, *TIME);
    }
    STEPS_DONE.fetch_add(1, Ordering::AcqRel);
    *TIME = TIME.wrapping_add(1);
}

fn slow(task: &mut SlowTask, time: u32) {
    let inputs = free(|key| SlowInputs {
        load: LOAD.borrow(key).take(),
        temperature: TEMPERATURE.borrow(key).take(),
    });
    // Where the background is putting one there, it is for the next tick.
    let offer = OFFER.try_lock().and_then(|mut offer| offer.take());

    let Some(mut gear) = GEAR.try_lock() else {
        return;
    };
    let Some(model) = gear.as_mut() else {
        return;
    };
    // Read while nobody else can give the model a younger angle.
    let reading = free(|key| READING.borrow(key).get());
    let outputs = task.step(model, offer, reading, &inputs);
    drop(gear);

    let parameters = ReactionParameters::of(task.calibration());
    let page = free(|key| {
        REACTION.borrow(key).set(parameters);
        PAGE.borrow(key).get()
    });

    task.adapt(&outputs, vehicle::observed(&outputs, task.level()));
    let torque = f32::from_bits(TORQUE.load(Ordering::Acquire));
    let measured = task.measured(torque, &page);
    free(|key| MEASURED.write(key, measured));
    judge(|judge| judge.slow(time, outputs.faults));
}

fn judge(look: impl FnOnce(&mut Judge)) {
    free(|key| {
        if let Ok(mut judge) = JUDGE.borrow(key).try_borrow_mut() {
            look(&mut judge);
        }
    });
}

#[entry]
fn main() -> ! {
    let mut console = Console::open();
    let page = reference_page();
    let (Some(mut core), Ok(calibration)) = (cortex_m::Peripherals::take(), page.checked()) else {
        finish(false)
    };
    if !set_up(&calibration) {
        finish(false)
    }
    free(|key| WORKING_PAGE.write(key, page));
    give_pend_sv_the_lowest_priority(&mut core.SCB);
    core.SYST.set_clock_source(SystClkSource::Core);
    core.SYST.set_reload(FAST_COUNTS - 1);
    core.SYST.clear_current();
    core.SYST.enable_counter();
    core.SYST.enable_interrupt();
    let mut watch = Watch::new(&calibration);
    while !OVER.load(Ordering::Acquire) {
        background(&mut watch);
        cortex_m::asm::wfi();
    }
    core.SYST.disable_interrupt();
    finish(report(&mut console, &calibration))
}

/// Whenever no interrupt runs: the calibration page.
fn background(watch: &mut Watch) {
    let page = free(|key| WORKING_PAGE.read(key));
    let offer = watch.look(&page);
    free(|key| PAGE.borrow(key).set(watch.report()));
    if offer.is_some()
        && let Some(mut place) = OFFER.try_lock()
    {
        *place = offer;
    }
}

/// Model and task in their places.
#[inline(never)]
fn set_up(calibration: &Calibration) -> bool {
    let (Some(mut slow), Some(mut gear)) = (SLOW.try_lock(), GEAR.try_lock()) else {
        return false;
    };
    let Ok((task, model)) = SlowTask::new(calibration) else {
        return false;
    };
    *slow = Some(task);
    *gear = Some(model);
    true
}

/// The measured figures; whether they are as they should be.
fn report(console: &mut Console, calibration: &Calibration) -> bool {
    let (judge, measured) = free(|key| {
        let judge = JUDGE.borrow(key).try_borrow();
        (
            judge.map_or(judge::Judge::START, |judge| *judge),
            MEASURED.read(key),
        )
    });
    console.text("torque of the motor, mN m (its change in 50 us, uN m)\n");
    for (seen, (_, _, name)) in judge.seen().iter().zip(&EVENTS) {
        console.text("  ");
        console.number((1e3 * seen.least) as u32);
        console.text(" to ");
        console.number((1e3 * seen.largest) as u32);
        console.text(" (");
        console.number((1e6 * seen.largest_step) as u32);
        console.text("), flags ");
        console.number(u32::from(seen.faults.bits()));
        console.text(": ");
        console.text(name);
        console.text("\n");
    }
    let figures = [
        ("steps", STEPS_DONE.load(Ordering::Acquire)),
        (
            "ticks of the current loop that found the model busy",
            BUSY.load(Ordering::Acquire),
        ),
        (
            "per mille of the torque left beyond the limit",
            (1e3 * judge.left_beyond_limit()) as u32,
        ),
        (
            "per mille of friction that the adaptation found",
            (1e3 * measured.level_forward) as u32,
        ),
    ];
    for (name, figure) in figures {
        console.text(name);
        console.text(": ");
        console.number(figure);
        console.text("\n");
    }
    let level = measured.level_forward / vehicle::TRUE_LEVEL - 1.0;
    judge.passed(calibration) && measured.steps == STEPS && level.abs() < 0.02
}
