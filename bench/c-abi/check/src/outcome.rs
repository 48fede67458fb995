//! What a check gives: nothing but its value, or why it failed.

/// The value, or any error with its message.
pub type Outcome<T> = Result<T, Box<dyn std::error::Error>>;
