//! Errors that end a run, and their exit codes.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use crate::aside::say;

/// Why a run stopped. Wrong usage never gets here: the argument parser ends the program itself, with
/// exit code 2.
#[derive(Debug)]
pub enum Failure {
    /// Wrong data, or a file that cannot be read or written: exit code 1.
    Data(String),
    /// Some requests were wrong, and their answers say so: exit code 1, no message.
    Answered,
    /// The reader of the output has closed it: exit code 0.
    BrokenPipe,
}

impl Failure {
    /// The failure to do something (`"read"`, `"write"`) with a file.
    pub fn file(verb: &str, path: &Path, error: &impl fmt::Display) -> Self {
        Self::Data(format!("cannot {verb} {}: {error}", path.display()))
    }

    /// The same failure of something with a name.
    #[must_use]
    pub fn of(self, name: &str) -> Self {
        match self {
            Self::Data(message) => Self::Data(format!("{name}: {message}")),
            other => other,
        }
    }

    /// What is wrong, in words.
    pub fn message(&self) -> &str {
        match self {
            Self::Data(message) => message,
            Self::Answered | Self::BrokenPipe => "the output cannot be written",
        }
    }

    /// Prints what is to be said on stderr and gives the exit code.
    pub fn report(&self) -> ExitCode {
        match self {
            Self::Data(message) => {
                say(format_args!("error: {}", printable(message)));
                ExitCode::FAILURE
            }
            Self::Answered => ExitCode::FAILURE,
            Self::BrokenPipe => ExitCode::SUCCESS,
        }
    }
}

/// A message that may quote a file, cut to 2000 letters, its control characters replaced.
fn printable(message: &str) -> String {
    const LONGEST: usize = 2000;
    let mut letters = message.chars();
    let mut text: String = letters
        .by_ref()
        .take(LONGEST)
        .map(|letter| match letter {
            '\n' | '\t' => letter,
            _ if letter.is_control() => char::REPLACEMENT_CHARACTER,
            _ => letter,
        })
        .collect();
    if letters.next().is_some() {
        text.push_str("...");
    }
    text
}

/// The sentence of an error. One of reading standard input or writing standard output is told apart where the reader has closed it; those of
/// files are named by [`Failure::file`].
impl<E: Error + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        let closed = (&error as &dyn Error)
            .downcast_ref::<io::Error>()
            .is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe);
        if closed {
            Self::BrokenPipe
        } else {
            Self::Data(error.to_string())
        }
    }
}
