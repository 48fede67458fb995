//! Validated designs with their derived constants: [`BallScrew`], [`LinearBearing`].
//!
//! A design starts as plain numbers from a catalogue or a drawing (`...Parameters`), and is checked once, at the set-up of every scene. Lead angle,
//! curvature and torsion of the ball path, and groove offsets are computed here, without trigonometry of the lead.

mod ball_screw;
mod catalogue;
mod linear_bearing;
mod profile;

pub use ball_screw::{BallScrew, BallScrewParameters};
pub(crate) use catalogue::position;
pub use catalogue::{
    CATALOGUE, CatalogueSize, DISSERTATION_DESIGNS, FINE_LEAD_SIZES, NamedDesign, STEERING_SIZES,
    named,
};
pub use linear_bearing::{LinearBearing, LinearBearingParameters};
pub use profile::{
    BALL_RADIUS, ContactAngle, Groove, GrooveProfile, GrooveSize, HelixPath, LARGEST_CONFORMITY,
    LARGEST_CONTACT_ANGLE, LEAD, PITCH_RADIUS, SMALLEST_AREA, SMALLEST_CONFORMITY,
};
