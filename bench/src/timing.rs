//! Host timing: every competitor in the same run, in turns, with the cost of the call taken off.
//!
//! A competitor runs a batch of calls over an array of inputs. Inputs and outputs go through
//! [`black_box`](std::hint::black_box), so that nothing is folded, hoisted or vectorised. Two ways of calling are timed:
//!
//! - **latency**: each input waits for the output before it, as in a control loop that needs the answer
//!   to go on;
//! - **throughput**: the calls are independent, so that the processor works on several at once.
//!
//! Competitors take turns, one batch each in every round and in an order that moves on, so that whatever else the machine does
//! hits all alike. A batch is repeated until it is so long that reading the clock counts less than a hundredth of it. Right
//! before it the empty call runs over the same inputs, right after it the unit: a chain of multiplications and additions that
//! wait for each other. A machine that gets slower from one second to the next slows down all three. What is reported are
//! medians and quartiles over the rounds: of the time less that of the empty call, and of that over the unit, round by round.

mod competitors;
mod feed;
mod group;
pub(crate) mod kernels;
mod measure;
mod race;
mod trains;

pub use competitors::{Competition, compete, times};
pub use measure::{Measure, Ratio, Spread};
