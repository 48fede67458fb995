//! Closed-form efficiency of a ball screw, and self-locking.
//!
//! [`EfficiencyGeometry`] runs at the set-up of the scene by closed forms. The contact angle of least loss, the published design
//! procedure and the correction for the balls' inertia are in `epas-design`.
//!
//! There are two answers, both after Lin, Velinsky, Ravani 1994:
//!
//! - **rolling**, eq. (3): the ball rolls; only the contact at the screw slips, across the groove. **Use it for the friction of a gear in service.**
//! - **sliding**, eq. (14) and (17): both main contacts slide along the path. The ball would have to spin at millions of revolutions per minute, and
//!   the state is unstable nearly everywhere. **Use it as the pessimistic bound**, for the margin against self-locking.
//!
//! At the paper's own case (lead angle 10 degrees, contact angle 45 degrees, friction 0.075) the first
//! gives 0.980, the second 0.860.

mod closed_form;

pub use closed_form::{Drive, EfficiencyGeometry};
