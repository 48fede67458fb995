//! A trace of a screw whose design is known: friction coefficient, preload, breakaway angle and what else the trace can tell.
//!
//! | module | what |
//! |---|---|
//! | [`quantities`] | everything that has a value: names, units, bounds |
//! | [`friction`] | friction along the trace by the crate's caged scene with memory |
//! | [`problem`] | the whole torque as a separable problem |
//! | [`evidence`] | what the trace excites |
//! | [`choice`] | what is estimated, from where, within which bounds |

pub mod choice;
pub mod evidence;
pub mod friction;
pub mod problem;
pub mod quantities;
