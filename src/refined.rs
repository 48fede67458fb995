//! One ball between its grooves, and chains of balls, refined by Newton steps: beside the closed forms of
//! [`ball`](crate::ball).
//!
//! Called directly; no scene links it.
//!
//! | | what it is | where it holds |
//! |---|---|---|
//! | [`FourPointBall::start`] | four-force start: exact angles, every contact its own load | four loaded contacts |
//! | [`FourPointBall::step`] | one damped Newton step on the dissipation | from pure rolling to pure sliding |
//! | [`FourPointBall::refine_chain`] | the same for balls that press on each other | straight tracks, any number |
//! | [`ScrewBall::closed_form`] | impedances of rolling, one linear system | two to four contacts of a ball screw |
//! | [`ScrewBall::step`] | one step with the impedances at the motion found | from pure rolling to pure sliding |
//! | [`ScrewBall::refine_chain`] | the same for balls that press on each other | any number |
//!
//! Contacts come in the order bottom left, bottom right, top right, top left (Lin 2019, Fig. 3.10); in a
//! rotary bearing bottom is the inner ring and top the outer one. The bottom groove of a linear bearing
//! rests and the top groove moves; contact angles are measured from the axis on which top and bottom lie
//! towards the left and the right.
//!
//! Friction forces do not depend on the size of the speed, and dissipation is even in it: motions are in
//! units of the track speed, signed, and no function here takes that speed. A negative one changes the
//! sense of rear and front only ([`FourPointBall::refine_chain`]). At standstill the forces of Coulomb
//! friction are undefined: what is found is their limit, with which the motion sets in.

mod four_point;
mod pressing;
mod screw;
mod symmetric;

pub use four_point::{
    BallChain, BallMotion, BallState, ContactMotion, DEFAULT_NEWTON_STEPS, FourPointBall,
    FourPointContacts, LARGEST_ANGLE_DEVIATION, RotaryBall, RotaryBallParameters, RotaryMotion,
};
pub use screw::{
    DEFAULT_IMPEDANCE_STEPS, ScrewBall, ScrewBallMotion, ScrewBallState, ScrewChain,
    ScrewContactMotion, ScrewContacts,
};
