//! Friction of one Hertzian contact that slips and spins: force, moment and power loss under Coulomb
//! friction, all three from one convex dissipation potential.
//!
//! [`FrictionMap`] runs at the set-up of the linear scene. A contact that slips in any direction is solved on a host.
//!
//! A contact of ball and groove slips along the ball path with the velocity `V` of its centre and spins
//! about its normal with `w`. With the friction coefficient `mu`, the contact force `F` and the ellipse
//! `a >= b` (major axis across the path) the power loss is
//!
//! ```text
//! D(V, w) = mu F a |w| P(x)          x = c/a = V/(a w)
//! force   = dD/dV = mu F f(x)        f = P'            (the friction force is its negative)
//! moment  = dD/dw = mu F a M(x)      M = P - x P'
//! ```
//!
//! where `c` is the distance of the velocity centre from the contact centre. `D` is convex and homogeneous, so a body that rests on several such
//! contacts moves with the least loss.

mod across;
mod along;
mod rolling;

pub use across::slip_and_spin;
pub(crate) use across::{Across, AcrossTable};
pub use along::{FrictionMap, NormalizedFriction, SMALLEST_AXIS_RATIO};
pub use rolling::{RollingContact, RollingResistance};
