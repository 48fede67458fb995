//! Friction of balls between grooves and between each other, by the exact Coulomb model (Lin 2019, ch. 3.2 to 3.4).
//!
//! For given normal loads and contact angles, the power lost in the Coulomb contacts is a convex function of the ball's motion, homogeneous
//! of degree one, and the equilibrium of friction forces and moments ((3.19), (3.25), the friction rows of (3.69)) is that its gradient
//! vanishes: **a ball moves so that it loses the least power**. So the motion exists, the loss and the forces are unique, and a damped
//! Newton method finds it from any start. The force between two balls is the multiplier of the constraint that a ball behind must not be
//! faster than the one in front.
//!
//! Units: m, rad, s, N, W, Pa. Signs: the velocity of a contact is that of the ball minus that of the groove; forces and moments are those
//! on the ball.

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
