//! What a call comes to: what an instance says, as its logger and both versions of FMI tell it.

/// What a call comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Success.
    Fine,
    /// Success, with a text.
    Warning,
    Refused,
}

/// What a call says beside its success.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// Success, or success with a warning.
    pub outcome: Outcome,
    /// What the logger is told; nothing that it has been told already.
    pub text: Option<String>,
}
