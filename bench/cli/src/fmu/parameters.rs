//! Parameters of a unit: the numbers of its design, and a design with other numbers.

mod bearing;
mod named;
mod screw;

pub use bearing::{changed_bearing, of_bearing};
pub use named::Values;
pub use screw::{changed_screw, of_screw};
