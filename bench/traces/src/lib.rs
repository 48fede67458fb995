//! Measured traces as recorders write them, and tables of this project's programs as other tools read them.
//!
//! | module | what |
//! |---|---|
//! | [`units`] | quantities and their units, as headings and measurement files name them |
//! | [`headings`], [`front`] | the headings of a table, and what stands above and below them |
//! | [`source`] | where a trace comes from: a file or standard input, a table or a measurement file |
//! | [`mdf4`] | measurement files, read and written |
//! | [`table`], `gaps` | the numbers of either in SI units, with empty cells filled |
//! | [`marks`] | samples that are not to be believed |
//! | [`agreement`] | whether position and speed agree |
//! | [`clock`] | one sample clock: tick, gaps, jitter |
//! | [`channels`] | angles without jumps, the step of a sensor |
//! | [`flags`] | flags of a step: names, meaning, reaction |

// For the programs of this workspace: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

pub mod agreement;
pub mod channels;
pub mod clock;
pub mod flags;
pub(crate) mod front;
mod gaps;
pub(crate) mod headings;
pub mod marks;
pub mod mdf4;
pub mod source;
pub mod table;
pub mod units;
