//! One ball between its grooves, and rows of balls that push each other, against float64.

mod linear_ball;
mod screw_ball;
mod train;
mod two_point;
