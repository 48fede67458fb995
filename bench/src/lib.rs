//! The main job: the error of every formula and scene of `epas-friction` beside its run time, as tables and one page.
//!
//! | module | what |
//! |---|---|
//! | [`report`] | the tables and the page |
//! | [`timing`] | times of a call on this machine |
//! | [`counts`] | what `epas-target` counted on a Cortex-M4F |
//! | [`exact_ring`] | a scene without cage beside the exact whole screw |
//! | [`study`] | the case studies of Lin 2019 that report and timing share |

// For a program: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

pub mod counts;
pub mod exact_ring;
pub mod report;
pub mod study;
pub mod timing;
