//! A Cortex-R in the place of [the Cortex-M's board](../board/index.html): text to the host, and the end of a program.

pub use aarch32_rt::entry;
use semihosting::io::{Stdout, Write, stdout};

use crate::check::Screen;

/// The host's screen, through the debugger.
pub struct Console {
    stream: Option<Stdout>,
}

impl Console {
    /// Opens it.
    #[must_use]
    pub fn open() -> Self {
        Self {
            stream: stdout().ok(),
        }
    }
}

impl Screen for Console {
    fn bytes(&mut self, bytes: &[u8]) {
        if let Some(stream) = &mut self.stream {
            // Without a debugger the text is lost: a program on the target has no other way to say so.
            let _ = stream.write_all(bytes);
        }
    }
}

/// Nothing: cycles are counted on the Cortex-M4F.
pub fn start_clock() {}

/// No clock.
#[must_use]
pub fn clock() -> u32 {
    0
}

/// Ends the program with the exit code 0, or 1.
pub fn finish(passed: bool) -> ! {
    semihosting::process::exit(i32::from(!passed))
}
