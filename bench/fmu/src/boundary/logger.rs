//! Where texts go.

use std::ffi::{CString, c_char, c_void};
use std::sync::Arc;

use crate::outcome::Outcome;

/// `fmi2CallbackLogger`
pub type Logger2 = unsafe extern "C" fn(
    environment: *mut c_void,
    name: *const c_char,
    status: i32,
    category: *const c_char,
    message: *const c_char,
    ...
);

/// `fmi3LogMessageCallback`
pub type Logger3 = unsafe extern "C" fn(
    environment: *mut c_void,
    status: i32,
    category: *const c_char,
    message: *const c_char,
);

/// A caller's pointer, given back as it came.
#[derive(Clone, Copy)]
pub struct Environment(pub *mut c_void);

// SAFETY: the pointer is never followed here; which threads it may be given back on is the caller's, who calls on them.
unsafe impl Send for Environment {}

#[derive(Clone, Copy)]
enum Function {
    Two(Logger2),
    Three(Logger3),
    None,
}

/// Categories of texts.
const CATEGORIES: [&str; 2] = ["logStatusWarning", "logStatusError"];

/// Where the texts of an instance go.
#[derive(Clone)]
pub struct Logger {
    function: Function,
    environment: Environment,
    name: Arc<CString>,
    /// Whether warnings and errors are wanted.
    wanted: [bool; 2],
}

fn c_text(text: &str) -> CString {
    let bytes: Vec<u8> = text.bytes().take_while(|byte| *byte != 0).collect();
    CString::new(bytes).unwrap_or_default()
}

impl Logger {
    /// That of FMI 2.0. Errors are told always, warnings where logging is on.
    pub fn two(function: Option<Logger2>, environment: *mut c_void, name: &str, on: bool) -> Self {
        Self {
            function: function.map_or(Function::None, Function::Two),
            environment: Environment(environment),
            name: Arc::new(c_text(name)),
            wanted: [on, true],
        }
    }

    /// That of FMI 3.0.
    pub fn three(
        function: Option<Logger3>,
        environment: *mut c_void,
        name: &str,
        on: bool,
    ) -> Self {
        Self {
            function: function.map_or(Function::None, Function::Three),
            ..Self::two(None, environment, name, on)
        }
    }

    /// Wants some categories or all, or errors alone.
    pub fn want(&mut self, on: bool, categories: &[String]) -> Result<(), String> {
        if let Some(unknown) = categories
            .iter()
            .find(|name| !CATEGORIES.contains(&name.as_str()))
        {
            return Err(format!(
                "{unknown:?} is no category; allowed: {}",
                CATEGORIES.join(", ")
            ));
        }
        let named = |category: &str| {
            categories.is_empty() || categories.iter().any(|name| name == category)
        };
        self.wanted = if on {
            CATEGORIES.map(named)
        } else {
            [false, true]
        };
        Ok(())
    }

    /// Says something.
    pub fn say(&self, outcome: Outcome, message: &str) {
        let (status, category) = match outcome {
            Outcome::Fine => (0, 0),
            Outcome::Warning => (1, 0),
            Outcome::Refused => (3, 1),
        };
        if !self.wanted.get(category).copied().unwrap_or(true) {
            return;
        }
        let category = c_text(CATEGORIES.get(category).copied().unwrap_or_default());
        match self.function {
            Function::None => {}
            Function::Two(function) => {
                // The message is a format of `printf`.
                let message = c_text(&message.replace('%', "%%"));
                // SAFETY: the caller's function, with texts that live during the call.
                unsafe {
                    function(
                        self.environment.0,
                        self.name.as_ptr(),
                        status,
                        category.as_ptr(),
                        message.as_ptr(),
                    );
                }
            }
            Function::Three(function) => {
                let message = c_text(message);
                // SAFETY: as above.
                unsafe {
                    function(
                        self.environment.0,
                        status,
                        category.as_ptr(),
                        message.as_ptr(),
                    );
                }
            }
        }
    }
}
