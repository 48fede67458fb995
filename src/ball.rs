//! One ball between its grooves.
//!
//! | | what it is | runs in |
//! |---|---|---|
//! | [`AnalyticLinearBall`] | ball of a linear bearing, the published closed form (Lin 2019, eqs. (3.43), (3.51)) | `LinearBearingTrain` |
//! | [`folded`] | law of one ball over its load, solved on a host: torque by one cubic | `CagedBallScrew` |
//! | [`pressed`] | law of one ball that its neighbours press on, solved on a host: free speed, impedance and torque by polynomials | `UncagedBallScrew` |
//! | [`ScrewRow`], [`ScrewTick`] | balls of a ball screw under one load in closed form, for comparison | direct |
//! | [`LoadShare`], [`LoadShares`] | a ball's share of the load; along the track, for both signs of it | `UncagedBallScrew`, `LinearBearingTrain` |
//! | [`Clearance`] | how balls fit between the grooves | set-up of `ClosedFormScrew` |
//! | `preload` | two springs pressed against each other, and the preload that remains under a load | `ClosedFormScrew`, [`ScrewRow`]; [`PreloadedElements`](crate::law::memory::PreloadedElements) |

mod clearance;
pub mod folded;
mod linear;
mod loads;
pub(crate) mod preload;
pub mod pressed;
mod screw;
pub(crate) mod two_point;

pub use clearance::Clearance;
pub use linear::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE, SpeedDeviation};
pub use loads::{LoadShare, LoadShares};
pub(crate) use preload::PreloadSum;
#[doc(hidden)]
pub use preload::{CLOSING, LOST, QUARTIC};
pub(crate) use screw::largest_deviation;
pub use screw::{GrooveFit, RowContacts, ScrewRow, ScrewTick, ScrewTickBall};
#[doc(hidden)]
pub use two_point::HALF_TO_FOUR_THIRDS;
pub(crate) use two_point::{BorderParameters, GrooveFriction, GrooveLoss, spin_loss};
