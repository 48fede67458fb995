//! Every exported function, and the only module with pointers.
//!
//! A pointer is checked for NULL. What cannot be checked is the caller's: that a pointer points to as many objects of its type as the call
//! says, and that a text ends. Instances and states are handles ([`crate::registry`]), which are never followed.

#![allow(unsafe_code)]
// What the caller owes stands above and in the standard, for all functions alike; so does what each of them does.
#![allow(clippy::missing_safety_doc, missing_docs)]

mod fmi2;
mod fmi2_absent;
mod fmi3;
mod fmi3_absent;
mod logger;
mod pointers;

pub use logger::Logger;
