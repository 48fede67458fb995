//! Choosing a screw by its efficiency: the contact angle of least loss, the published design procedure, and what the inertia of the balls
//! changes. In f32, on a host; the closed forms themselves are [`epas_friction::efficiency`].

mod dynamic;
mod optimum;
mod procedure;

pub use dynamic::DynamicCorrection;
pub use optimum::{OptimumContactAngle, optimum_contact_angle, optimum_efficiency};
pub use procedure::{DesignFigures, DesignRequest, Duty};
