//! Closed-form efficiency of a ball screw, and self-locking, both after Lin, Velinsky, Ravani 1994:
//!
//! - **rolling**, eq. (3): the ball rolls; only the contact at the screw slips, across the groove. For the friction of a gear in service.
//! - **sliding**, eq. (14) and (17): both main contacts slide along the path, a state that is unstable nearly everywhere. For the margin against
//!   self-locking.
//!
//! At the paper's own case (lead angle 10 degrees, contact angle 45 degrees, friction 0.075) the first gives 0.980, the second 0.860.

mod closed_form;

pub use closed_form::{Drive, EfficiencyGeometry};
