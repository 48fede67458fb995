//! One ball of a ball screw in elastic grooves: its place, its motion, its friction, renewed step by step.
//!
//! A ball has seven unknowns and as many equations, which a renewal takes one Newton step of:
//!
//! | unknown | equation |
//! |---|---|
//! | radial place | the radial forces of all contacts and of the neighbours' friction are in balance |
//! | axial place against the screw's groove | the screw's contacts carry the ball's axial load |
//! | axial place against the nut's groove | the nut's contacts carry it too, with the neighbours' friction |
//! | three angular velocities | no moment is left: derivatives of the power loss by the rotation, with the neighbours' friction |
//! | speed along the track | derivative of the power loss by the speed = push of the neighbours along the track |
//!
//! Loads of the contacts follow from the place (Hertz), friction forces and moments from the load, the slip and the spin of
//! each contact. Grooves are arcs of circles, so the direction of a contact is that from the ball's centre to the arc's.
//!
//! Source: Lin 2019, contact directions and loads (2.11)-(2.14), slip and spin (3.65)-(3.68), balance of a ball (3.69), with
//! neighbours (3.75). Errors and cost: [`SCREW_RENEWAL`](crate::promises::SCREW_RENEWAL).
//!
//! Constants that were chosen and not derived say what they were chosen from; those of a ring stand in `ring::chosen`.
//! `host-tests/tests/generators/elastic_balls.rs` shows what they do.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `constants` | what all balls of a screw have in common | set-up |
//! | `grooves` | both grooves with their contacts, folded once | set-up |
//! | `contact` | one contact: load, friction, and what it adds to the equations | every renewal |
//! | `equations` | the seven equations of a ball and their solution | every renewal |
//! | `law` | what a ball does between two renewals | every tick |
//! | `renewal` | one Newton step of place and motion together | every renewal |
//! | `resistance` | rolling resistance of all contacts | every renewal |
//! | `ring` | balls that are renewed in turn | every tick |
//! | `start` | place and motion of a ball that has none yet | start, reversal |
//! | `stored` | states as bytes | around ignition |

pub(crate) mod constants;
mod contact;
mod equations;
mod grooves;
pub(crate) mod law;
mod renewal;
mod resistance;
pub(crate) mod ring;
mod start;
mod stored;

pub use grooves::ElasticGrooves;
pub use renewal::{BallInputs, Renewal, Settled};
