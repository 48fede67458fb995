//! Long calls that Ctrl-C ends.

use std::panic;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// Time between two checks for signals.
const BETWEEN: Duration = Duration::from_millis(50);

/// Stack of a thread that solves a design, bytes: that of a main thread.
const STACK: usize = 8 << 20;

/// Checks Python's signals at most every [`BETWEEN`], from code that does not hold the interpreter's lock.
pub struct Signals {
    due: Instant,
}

impl Signals {
    /// The first check is due after [`BETWEEN`].
    pub fn new() -> Self {
        Self {
            due: Instant::now() + BETWEEN,
        }
    }

    /// Runs Python's signal handlers where a check is due.
    #[inline]
    pub fn check(&mut self) -> PyResult<()> {
        let now = Instant::now();
        if now < self.due {
            return Ok(());
        }
        self.due = now + BETWEEN;
        handle_signals()
    }
}

/// Runs Python's signal handlers.
#[allow(
    clippy::redundant_closure_for_method_calls,
    reason = "the method alone is for one lifetime"
)]
fn handle_signals() -> PyResult<()> {
    Python::attach(|py| py.check_signals())
}

/// Whether a caller no longer waits.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Ends the work where its caller no longer waits: by unwinding, through whatever called this.
    pub fn check(&self) {
        if self.0.load(Ordering::Relaxed) {
            panic::resume_unwind(Box::new(Self::default()));
        }
    }
}

/// Runs work on a thread of its own, without the interpreter's lock, and waits for it; signals are handled meanwhile.
///
/// After an interrupt the call ends at once, and the work at its next [`Stop::check`].
pub fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Stop) -> T + Send + 'static,
) -> PyResult<T> {
    let stop = Stop::default();
    let (sender, receiver) = channel();
    let seen = stop.clone();
    let thread = thread::Builder::new().stack_size(STACK).spawn(move || {
        // Nobody waits for what is made after an interrupt.
        let _ = sender.send(work(&seen));
    })?;
    py.detach(move || {
        loop {
            match receiver.recv_timeout(BETWEEN) {
                Ok(made) => return Ok(made),
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(raised) = handle_signals() {
                        stop.0.store(true, Ordering::Relaxed);
                        return Err(raised);
                    }
                }
                Err(RecvTimeoutError::Disconnected) => match thread.join() {
                    Ok(()) => return Err(pyo3::exceptions::PyRuntimeError::new_err("no result")),
                    Err(payload) => panic::resume_unwind(payload),
                },
            }
        }
    })
}
