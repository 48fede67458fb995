//! The printed numbers, figures and studies of four papers on ball screws, computed anew with the exact models of [`epas_reference`].
//!
//! | module | what |
//! |---|---|
//! | [`published`] | printed numbers of the four papers beside the computed ones |
//! | [`measured`] | measured and catalogue figures of real ball screws beside the exact model |
//! | [`kinematics`] | figures and rival formulations of Alberdi et al. |
//! | [`rolling_ball`] | equations of motion of one ball, Lin, Velinsky, Ravani 1994, from a rolling start |
//! | [`stability`] | small disturbances of its steady state |
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
pub mod kinematics;
pub mod load_studies;
pub mod measured;
mod peers;
pub mod published;
pub mod report;
pub mod rolling_ball;
pub mod rotary_ball;
pub mod rotary_bearing;
pub mod screws;
pub mod stability;
