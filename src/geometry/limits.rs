//! Limits that every design keeps.

/// Smallest accepted conformity `groove_radius / (2 ball_radius)`. At 0.5 ball and groove coincide and
/// the contact is no ellipse; catalogues stand between 0.505 and 0.58.
pub const SMALLEST_CONFORMITY: f32 = 0.5005;

/// Largest accepted conformity; at 1 the groove radius is the ball's diameter.
pub const LARGEST_CONFORMITY: f32 = 1.0;

/// Largest accepted nominal contact angle, rad (89 degrees).
pub const LARGEST_CONTACT_ANGLE: f32 = 1.5533;
