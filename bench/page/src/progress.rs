//! What is to be seen of work that takes longer than a second: one line on a terminal, several in a log.

use std::io::{IsTerminal as _, Write as _, stderr};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::aside::say;

/// Time after which something is to be seen.
const SOON: Duration = Duration::from_millis(900);
/// Time between two lines of a log.
const SELDOM: Duration = Duration::from_secs(30);
/// Time between two lines that are written over each other on a terminal.
const OFTEN: Duration = Duration::from_millis(200);

/// A line about work that takes longer than a second, from whichever part of it: silence is not to be taken for a fault.
pub struct Working {
    ended: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Working {
    /// Work that begins.
    pub fn new(said: &'static str) -> Self {
        let (ended, ends) = channel();
        let thread = thread::spawn(move || {
            if ends.recv_timeout(SOON) == Err(RecvTimeoutError::Timeout) {
                say(said);
            }
        });
        Self {
            ended: Some(ended),
            thread: Some(thread),
        }
    }
}

impl Drop for Working {
    fn drop(&mut self) {
        drop(self.ended.take());
        if let Some(thread) = self.thread.take() {
            // A line that could not be written is no fault of the work.
            let _ = thread.join();
        }
    }
}

/// Progress of work that takes longer than a second, fed from any thread: one line that is written over on a terminal, a line every half
/// minute in a log.
pub struct Progress {
    work: &'static str,
    steps: u64,
    done: AtomicU64,
    start: Instant,
    terminal: bool,
    due: Mutex<Instant>,
}

impl Progress {
    /// For a fold, whose shares are told to [`Progress::share`].
    pub fn of_fold() -> Self {
        Self::new("folding", 1000)
    }

    /// For so many steps of some work.
    pub fn new(work: &'static str, steps: usize) -> Self {
        let start = Instant::now();
        Self {
            work,
            steps: steps as u64,
            done: AtomicU64::new(0),
            start,
            terminal: stderr().is_terminal(),
            due: Mutex::new(start + SOON),
        }
    }

    /// One step more is done.
    pub fn step(&self) {
        self.steps(1);
    }

    /// This share of the work is done; a smaller one than before is left out.
    pub fn share(&self, share: f64) {
        let now = (share * self.steps as f64) as u64;
        let before = self.done.fetch_max(now, Ordering::Relaxed);
        self.tell(now.max(before));
    }

    /// So many steps more are done.
    pub fn steps(&self, steps: u64) {
        self.tell(self.done.fetch_add(steps, Ordering::Relaxed) + steps);
    }

    fn tell(&self, done: u64) {
        let now = Instant::now();
        // Another thread that holds it writes the line.
        if let Ok(mut due) = self.due.try_lock()
            && now >= *due
        {
            *due = now + if self.terminal { OFTEN } else { SELDOM };
            let share = done as f64 / self.steps.max(1) as f64;
            let left = self.start.elapsed().as_secs_f64() * (1.0 - share) / share.max(1e-9);
            let line = format!(
                "{}: {:.0} %, about {left:.0} s left",
                self.work,
                100.0 * share
            );
            if self.terminal {
                over(&line);
            } else {
                say(line);
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.terminal && self.start.elapsed() > SOON {
            over("");
        }
    }
}

/// Writes over the line of a terminal. Where that cannot be written, the work goes on without.
fn over(line: &str) {
    let _ = write!(stderr(), "\r\x1b[K{line}");
}
