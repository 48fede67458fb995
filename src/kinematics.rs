//! Rolling, side and spin slip of a ball between screw and nut. Called directly; no scene links it.
//!
//! A ball that orbits along a helix cannot roll without slip. Relative to a raceway it slips along its path (*rolling slip*, a parabola over the
//! ellipse), across it (*side slip*), and about the contact normal (*spin*), all in proportion to the speed of the screw:
//!
//! | call | when | what it costs |
//! |---|---|---|
//! | [`ContactKinematics::new`] | once | checks every number, forms all constants: 2100 cycles; none as a constant |
//! | [`ContactKinematics::update`] | contact angles or loads changed | one division, two square roots, two sines and cosines: 450 cycles |
//! | [`ContactKinematics::tick`] | every interrupt | ten multiplications: 60 cycles |
//! | [`ContactCoefficients::ratios`] | after an update, if wanted | the speed-free ratios, with arc tangents: 430 cycles a contact |
//!
//! Cycles are modelled for a Cortex-M4F (Arm's cycle table, no wait states, own scalar kernels).
//!
//! # Frame and signs
//! Screw turning at `speed` about its axis without moving along it; nut sliding along it without
//! turning; right-hand thread for a positive lead angle. At each contact `x` is the direction of
//! rolling (along the path at the screw, against it at the nut), `y` lies across the path in the
//! groove, `z` points from the raceway to the ball's centre. Slip is the ball's surface minus the
//! raceway's. The semi-major axis of the ellipse lies along `y`. The screw is the inner contact
//! (the paper's subscript i, upper signs), the nut the outer one (o, lower signs).
//!
//! # The ball's rotation
//! Pitch angle (beta) and yaw angle (beta') point the axis about which the ball turns *relative to the frame that orbits with it*; the rolling
//! radius (r') of a contact is the distance from the ball's centre at which rolling slip vanishes. They are inputs: customary are a pitch angle
//! equal to the contact angle, a yaw angle of 0 and the ball's radius. The published ways to choose a pitch angle are in the reference
//! (`host-tests/src/kinematics`).
//!
//! Source: Alberdi, Arana, Oyanguren, Larrañaga, Ulacia, "A revised framework for ball-screw
//! contact kinematics" ("Alberdi et al." below).

mod ball;
mod coefficients;
pub(crate) mod path;

pub use ball::{BallKinematics, ContactKinematics, ContactSlip};
pub use coefficients::{ContactCoefficients, SlipRatios, SlipVector};
pub use path::{EllipticContact, KinematicsParameters};
#[doc(hidden)]
pub use path::{FOURTH_POWER, LARGEST_ELLIPSE};
