//! The ball of a ball screw: a third contact, slip across the track, and what follows from them.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `fit` | how balls fit between the grooves | set-up |
//! | `raceway` | one groove: its contact under any load | every tick |
//! | `contacts` | loads of the main, third and fourth contact | every tick |
//! | `speeds` | how speeds follow deviations of the contact angles | set-up |
//! | `row` | the row under a load ([`ScrewRow::at`]) | every tick |
//! | `tick` | one ball of the row ([`ScrewLoop::ball`]) | every ball of every tick |

mod contacts;
mod fit;
mod raceway;
mod row;
mod speeds;
mod tick;

pub use fit::GrooveFit;
pub use row::{RowContacts, ScrewRow};
pub(crate) use speeds::largest_deviation;
pub use tick::{LoopBall, LoopSums, ScrewLoop, ScrewTick, ScrewTickBall};
