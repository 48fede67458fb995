//! What a program of this project shows a person: reports as text, Markdown and one HTML page with plots; files that are written whole or
//! not at all; progress; and why a run stopped. It knows no physics.

// For the programs of this workspace: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

pub mod aside;
pub mod document;
pub mod failure;
pub mod files;
pub mod folder;
pub mod plot;
pub mod progress;
