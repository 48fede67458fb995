//! Measured traces as recorders write them, and tables of this project's programs as other tools read them.
//!
//! | module | what |
//! |---|---|
//! | [`units`] | quantities and their units, as headings and measurement files name them |
//! | [`headings`], [`front`] | the headings of a table, and what stands above and below them |
//! | [`source`] | where a trace comes from: a file or standard input, a table or a measurement file |
//! | [`mdf4`] | measurement files, read and written |
//! | [`flags`] | flags of a step: names, meaning, reaction |

// For the programs of this workspace: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

pub mod flags;
pub mod front;
pub mod headings;
pub mod mdf4;
pub mod source;
pub mod units;
