//! The contact angle of least loss, and the design procedure. Called directly; no scene links it.

mod optimum;
mod procedure;

pub use optimum::{OptimumContactAngle, optimum_contact_angle, optimum_efficiency};
pub use procedure::{DesignFigures, DesignRequest, Duty};
