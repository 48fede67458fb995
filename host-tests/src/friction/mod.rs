//! Friction of balls between grooves and between each other, by the exact Coulomb model (Lin 2019, ch. 3.2 to 3.4).
//!
//! The models rest on one fact that the dissertation does not state. For given normal loads and
//! contact angles, the power lost in the Coulomb contacts is a convex function of the ball's
//! motion, homogeneous of degree one, and the equilibrium of friction forces and moments
//! ((3.19), (3.25), the friction rows of (3.69)) is that its gradient vanishes: **a ball moves so
//! that it loses the least power**. So the motion is the minimum of a convex function: it exists,
//! the loss and the forces are unique, and a damped Newton method finds it from any start. The
//! ball-to-ball contact force is the multiplier of the constraint that a ball behind must not be
//! faster than the ball in front.
//!
//! | file | what |
//! |---|---|
//! | [`maps`] | one contact whose velocity centre lies on the major axis: (3.16) to (3.18) in closed form and as a line integral |
//! | [`patch`] | one contact with any velocity centre (ball screw), the exact reduction to one integral |
//! | [`contact_law`] | size and stiffness of a Hertzian contact, exact and as the dissertation takes it |
//! | [`planar`] | equilibrium of a ball whose contacts slip along the track only |
//! | [`linear_ball`] | ball of a linear bearing, statics, the published analytical formulas |
//! | [`isotonic`] | rows of balls that push each other, each answering a force in proportion, two ways |
//! | [`chain`] | chains of touching balls in a linear bearing, with and without ball-to-ball friction |
//! | [`ball_screw_ball`] | ball of a ball screw with given contacts, (3.65) to (3.69) |
//! | [`ball_screw_grooves`] | the grooves as elastic arcs, (2.11) to (2.14) |
//! | [`ball_screw_elastic`] | in-plane balance with elasticity, and two touching balls, (3.69) to (3.76) |
//! | [`ball_screw_row`] | rows of balls with elasticity, clearance of either sign, and an axial load of each ball |
//! | [`rolling_resistance`] | elastic hysteresis and lubricant drag of a contact, beside its Coulomb friction |
//! | [`ball_screw_efficiency`] | friction torque and efficiency of a screw under a steady load, by one of its balls |
//! | [`caged_ball`] | one ball under one load after the other, no neighbour pressing |
//! | [`held_ball`] | one ball whose neighbours let it run, or hold it at a speed and rub on it |
//! | [`ball_screw_ring`] | the whole screw, exactly: balls in elastic grooves that recirculate and press on each other |
//! | [`ball_screw_train`] | trains of any length with given contacts, (3.77) |
//! | [`ball_screw_closed`] | closed-form orbital speed, spin, loads and compliance in a ball screw |
//! | [`whole_screw`] | the whole screw by the closed form of a ball (section 3.4.4), to compare with |
//!
//! Units: m, rad, s, N, W, Pa. Signs: the velocity of a contact is that of the ball minus that of
//! the groove; forces and moments are those on the ball.

pub mod ball_screw_ball;
pub mod ball_screw_closed;
pub mod ball_screw_efficiency;
pub mod ball_screw_elastic;
pub mod ball_screw_grooves;
mod ball_screw_placed;
mod ball_screw_press;
pub mod ball_screw_ring;
mod ball_screw_ring_deviation;
mod ball_screw_ring_march;
mod ball_screw_ring_newton;
mod ball_screw_ring_order;
mod ball_screw_ring_pool;
mod ball_screw_ring_rates;
mod ball_screw_ring_solve;
pub mod ball_screw_row;
mod ball_screw_rubbing;
mod ball_screw_settle;
mod ball_screw_steps;
mod ball_screw_tangent;
pub mod ball_screw_train;
pub mod caged_ball;
pub mod chain;
pub mod contact_law;
pub mod held_ball;
pub mod isotonic;
pub mod linear_ball;
pub mod maps;
pub mod newton;
pub mod patch;
pub mod planar;
pub mod rolling_resistance;
mod train_newton;
pub mod whole_screw;
