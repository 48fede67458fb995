//! Validated designs with their derived constants: [`BallScrew`], [`LinearBearing`].
//!
//! Set-up of every scene.
//!
//! A design starts as plain numbers from a catalogue or a drawing (`...Parameters`), is checked once,
//! and from then on cannot be wrong. Everything that follows from it alone (lead angle, curvature and
//! torsion of the ball path, groove offsets) is computed here, in the lead form that needs no
//! trigonometry and stays well conditioned at any lead.

mod angle;
mod ball_screw;
mod ball_screw_parameters;
mod catalogue;
mod limits;
mod linear_bearing;
mod profile;

pub use angle::ContactAngle;
pub use ball_screw::BallScrew;
pub use ball_screw_parameters::BallScrewParameters;
pub(crate) use catalogue::position;
pub use catalogue::{
    CATALOGUE, CatalogueSize, DISSERTATION_DESIGNS, FINE_LEAD_SIZES, NamedDesign, STEERING_SIZES,
    named,
};
pub use limits::{
    BALL_RADIUS, LARGEST_CONFORMITY, LARGEST_CONTACT_ANGLE, LEAD, PITCH_RADIUS, SMALLEST_AREA,
    SMALLEST_CONFORMITY,
};
pub use linear_bearing::{LinearBearing, LinearBearingParameters};
pub use profile::{Groove, GrooveProfile, GrooveSize, HelixPath};
