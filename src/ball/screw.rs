//! The ball of a ball screw in closed form: a third contact, slip across the track, and what follows from them. No step runs
//! it: both ball screws run laws that a host has folded.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `fit` | how balls fit between the grooves | set-up |
//! | `raceway` | one groove: its contact under any load | `ScrewRow::at` |
//! | `contacts` | loads of the main, third and fourth contact | `ScrewRow::at` |
//! | `speeds` | how speeds follow deviations of the contact angles | set-up |
//! | `row` | the row under a load ([`ScrewRow::at`]) | `ScrewRow::at` |
//! | `tick` | one ball of the row ([`ScrewTick::ball`]) | `ScrewTick::ball` |

mod contacts;
mod fit;
mod raceway;
mod row;
mod speeds;
mod tick;

pub use fit::GrooveFit;
pub use row::{RowContacts, ScrewRow};
pub(crate) use speeds::largest_deviation;
pub use tick::{ScrewTick, ScrewTickBall};
