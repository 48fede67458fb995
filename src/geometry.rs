//! Validated designs with their derived constants: [`BallScrew`], [`LinearBearing`], [`BallBearing`].
//!
//! A design starts as plain numbers from a catalogue or a drawing (`...Parameters`), is checked once,
//! and from then on cannot be wrong. Everything that follows from it alone (lead angle, curvature and
//! torsion of the ball path, groove offsets) is computed here, in the lead form that needs no
//! trigonometry and stays well conditioned at any lead.

mod angle;
mod ball_bearing;
mod ball_screw;
mod catalogue;
mod linear_bearing;
mod profile;

pub use angle::ContactAngle;
pub use ball_bearing::{BallBearing, BallBearingParameters};
pub use ball_screw::{BallScrew, BallScrewParameters};
pub use catalogue::{CATALOGUE, CatalogueSize, DISSERTATION_DESIGNS, NamedDesign};
pub use linear_bearing::{LinearBearing, LinearBearingParameters};
pub use profile::{Groove, GrooveProfile, GrooveSize, HelixPath};

/// Smallest accepted conformity `groove_radius / (2 ball_radius)`. At 0.5 ball and groove coincide and
/// the contact is no ellipse; catalogues stand between 0.505 and 0.58.
pub const SMALLEST_CONFORMITY: f32 = 0.5005;

/// Largest accepted conformity; at 1 the groove radius is the ball's diameter.
pub const LARGEST_CONFORMITY: f32 = 1.0;

/// Largest accepted nominal contact angle, rad (89 degrees).
pub const LARGEST_CONTACT_ANGLE: f32 = 1.5533;
