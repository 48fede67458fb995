//! Static load distribution of a ball screw, after Lin 2019, chapter 2. Lengths in m, forces in N, angles in rad.
//!
//! Every ball touches up to four circular arcs of a gothic-arch groove. The screw is a Timoshenko beam whose section is reduced by the
//! groove, the nut is rigid, each contact follows Hertz. Friction and ball-to-ball forces are left out. The contact angles of the printed
//! equations (2.25) vanish on circular arcs: the equations become the gradient of one **convex** energy
//!
//! `V(U, p) = U'KU/2 - F'U + sum of (2/5) C^(-3/2) max(delta, 0)^(5/2)`,
//! `delta = |p - o(U)| - (r_G - r_B) + e`,
//!
//! with node displacements `U`, ball centres `p`, arc centres `o`, which move with the screw, and the ball's oversize `e`. The forces are
//! therefore unique and Newton's method with a Levenberg term and an energy test converges from any start ([`StaticLoad::solve`]).

pub mod ball;
pub mod beam;
pub mod cases;
pub mod contact;
pub mod geometry;
mod newton;
pub mod problem;
pub mod shaft;
pub mod shares;
pub mod solution;
pub mod surface;
mod system;

pub use crate::material::Elastic;
pub use ball::{Ball, NutPose};
pub use beam::Section;
pub use contact::{ContactConstants, HertzConvention};
pub use geometry::{Contact, Geometry};
pub use problem::{Load, State, StaticLoad, Support};
pub use shaft::{Shaft, ShaftModel};
pub use shares::{Served, ShareError, ShareTable, ShareTables};
pub use solution::{Outcome, StaticSolution};
pub use surface::{Deviation, SurfaceError};
