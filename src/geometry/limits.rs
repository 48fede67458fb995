//! Limits that every design keeps.
//!
//! Lengths are in metres. Their ranges hold every ball screw and bearing of a steering gear or a machine, and refuse most
//! lengths that were given in millimetres.

use crate::error::Range;

/// Radius of the cylinder on which the balls of a ball screw or a ball bearing run, m: 1e-3 to 0.5.
pub const PITCH_RADIUS: Range = Range::new(1e-3, 0.5);

/// Lead of a ball screw, m: 0 to 0.2; 0 is a ball bearing.
pub const LEAD: Range = Range::new(0.0, 0.2);

/// Ball radius, m: 1e-4 to 0.05. In a ball screw it also stays below 0.9 of the pitch radius.
pub const BALL_RADIUS: Range = Range::new(1e-4, 0.05);

/// Smallest accepted conformity `groove_radius / (2 ball_radius)`. At 0.5 ball and groove coincide and
/// the contact is no ellipse; catalogues have 0.505 to 0.58.
pub const SMALLEST_CONFORMITY: f32 = 0.5005;

/// Largest accepted conformity; at 1 the groove radius is the ball's diameter.
pub const LARGEST_CONFORMITY: f32 = 1.0;

/// Largest accepted nominal contact angle, rad (89 degrees).
pub const LARGEST_CONTACT_ANGLE: f32 = 1.5533;

/// Smallest `A = 1 + zeta kappa (H - r_s cos(beta))` of a groove, a pure number: at 0 its surface folds, and its curvatures
/// have an error of `6e-8 / A`.
pub const SMALLEST_AREA: f32 = 1e-4;
