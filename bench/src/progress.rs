//! What is to be seen of work that takes longer than a second: a bar on a terminal, lines in a log.

use std::io::{IsTerminal as _, stderr};
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::aside::say;

/// Time after which something is to be seen.
const SOON: Duration = Duration::from_millis(900);
/// Time between two lines of a log.
const BETWEEN: Duration = Duration::from_secs(30);

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

/// Progress of work that takes longer than a second, fed from any thread: a bar, or a line every half minute where standard
/// error is no terminal.
pub struct Progress {
    bar: ProgressBar,
    work: &'static str,
    start: Instant,
    /// When the next line is due; none on a terminal.
    line: Option<Mutex<Instant>>,
}

impl Progress {
    /// For so many steps of some work.
    pub fn new(work: &'static str, steps: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent} % {eta} left") {
            bar.set_style(style);
        }
        bar.set_message(work);
        let start = Instant::now();
        let line = !stderr().is_terminal();
        Self {
            bar,
            work,
            start,
            line: line.then(|| Mutex::new(start + SOON)),
        }
    }

    /// One step more is done.
    pub fn step(&self) {
        self.steps(1);
    }

    /// So many steps more are done.
    pub fn steps(&self, steps: u64) {
        self.bar.inc(steps);
        let Some(line) = &self.line else {
            if self.bar.is_hidden() && self.start.elapsed() > SOON {
                self.bar.set_draw_target(ProgressDrawTarget::stderr());
            }
            return;
        };
        let now = Instant::now();
        // Another thread that holds it writes the line.
        if let Ok(mut due) = line.try_lock()
            && now >= *due
        {
            *due = now + BETWEEN;
            let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
            let share = done as f64 / all.max(1) as f64;
            let left = self.start.elapsed().as_secs_f64() * (1.0 - share) / share.max(1e-9);
            say(format_args!(
                "{}: {:.0} %, about {left:.0} s left",
                self.work,
                100.0 * share
            ));
        }
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
