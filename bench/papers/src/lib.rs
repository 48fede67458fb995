//! The printed numbers, figures and studies of four papers on ball screws, computed anew with the exact models of [`epas_reference`].
//!
//! | module | what |
//! |---|---|
//! | [`published`] | printed numbers of the four papers beside the computed ones |
//! | [`measured`] | measured and catalogue figures of real ball screws beside the exact model |
//! | [`kinematics`] | figures and rival formulations of Alberdi et al. |
//! | [`rolling_ball`] | equations of motion of one ball, Lin, Velinsky, Ravani 1994, from a rolling start |
//! | [`load_studies`] | applications of the static load distribution, Lin 2019, chapter 4 |
//! | [`rotary_ball`], [`rotary_bearing`] | four-point rotary bearings, Lin 2019, sections 3.2 and 4.3.1 |
//! | [`report`] | the page of all of them, with rival laws of friction beside the crate's |
//! | [`screws`] | random whole screws in the loop against the exact ones |
//!
//! Lengths are in m, forces in N, angles in rad unless a function is free of units.

// For a program: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

mod ball_motion;
mod kinematics;
mod load_studies;
mod measured;
mod peers;
mod published;
pub mod report;
mod rolling_ball;
mod rotary_ball;
mod rotary_bearing;
pub mod screws;
#[cfg(test)]
mod tests;
