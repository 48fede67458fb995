//! Host timing: every competitor in the same run, in turns, with the cost of the call taken off.
//!
//! A competitor runs a batch of calls over an array of inputs. Inputs and outputs go through
//! [`black_box`], so that nothing is folded, hoisted or vectorised. Two ways of calling are timed:
//!
//! - **latency**: each input waits for the output before it, as in a control loop that needs the answer
//!   to go on;
//! - **throughput**: the calls are independent, so that the processor works on several at once.
//!
//! Competitors take turns, one batch each in every round and in an order that moves on, so that
//! whatever else the machine does hits all alike. In each round the time of an empty call over the same
//! inputs is subtracted; what is reported are median and quartiles over the rounds, and the median of
//! the ratios within each round.

mod competitors;
mod group;
pub mod kernels;
mod race;
mod trains;

pub use competitors::{Competition, compete};
pub use race::{Measure, Ratio};
