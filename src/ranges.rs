//! The range of a quantity that several modules take at set-up: one quantity, one range. Ranges of a validated design (lengths, conformity, nominal
//! contact angle) are in [`geometry`](crate::geometry).

use crate::error::Range;

/// Coulomb friction coefficient of ball and groove, where a formula divides by it; far above any rolling contact's (0.05 to 0.2).
pub const FRICTION: Range = Range::new(1e-6, 1.0);

/// Coulomb friction coefficient where no formula divides by it: of ball and groove in efficiencies and losses, of ball and ball everywhere.
pub const FRICTION_OR_NONE: Range = Range::new(0.0, 1.0);

/// Coulomb friction coefficient in a row of balls that find their own loads: friction across the track wedges the ball between its grooves, and the
/// contact force grows by `1/(1 - mu share)` with a share of sliding friction up to 1, at 0.5 twofold.
pub const FRICTION_OF_A_ROW: Range = Range::new(1e-6, 0.5);

/// Load of one contact or one ball, N.
pub const LOAD: Range = Range::new(0.0, 1e7);

/// Ball radius, m, of a formula that is called directly; of a design [`geometry::BALL_RADIUS`](crate::geometry::BALL_RADIUS).
pub const BALL_RADIUS: Range = Range::new(1e-5, 1.0);

/// Radius of the cylinder on which the balls of a screw run, m, of a formula that is called directly; of a design
/// [`geometry::PITCH_RADIUS`](crate::geometry::PITCH_RADIUS).
pub const PITCH_RADIUS: Range = Range::new(1e-4, 10.0);

/// Nominal contact angle of a ball that rolls in up to four contacts, rad: rotation grows with `1/cos`, spin vanishes with `sin`.
pub const ROLLING_CONTACT_ANGLE: Range = Range::new(0.05, 1.5);

/// Semi-major axis of a contact over the cube root of its load, m/N^(1/3).
pub const SEMI_MAJOR_COEFFICIENT: Range = Range::new(1e-8, 1.0);

/// Semi-minor axis of a contact over the cube root of its load, m/N^(1/3).
pub const SEMI_MINOR_COEFFICIENT: Range = Range::new(1e-9, 1.0);

/// Relative curvature of both bodies of a contact along its track, 1/m.
pub const ROLLING_CURVATURE: Range = Range::new(1e-3, 1e6);

/// Share of the elastic energy that a rolling contact loses, far above any metal's (0.01).
pub const HYSTERESIS_LOSS: Range = Range::new(0.0, 0.2);

/// Drag of a lubricant on one contact under 100 N, N.
pub const LUBRICANT_DRAG: Range = Range::new(0.0, 10.0);

/// Friction in a stored state, N m or N.
pub const STORED_FRICTION: Range = Range::new(0.0, 1e9);

/// Load of all balls in a stored state, N.
pub const STORED_LOAD: Range = Range::new(0.0, 1e13);

/// A friction coefficient over any other in a stored state.
pub const STORED_RATIOS: Range = Range::new(0.0, 1e9);
