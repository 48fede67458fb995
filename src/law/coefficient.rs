//! Friction coefficient by speed, temperature and direction; lubricant drag of rolling contacts and churning. [`CoefficientLaw`] is folded at
//! set-up; [`CoefficientLaw::at_temperature`] runs where a new temperature comes in; [`CoefficientAtTemperature::at`] runs in the loop.

mod drag;
mod form;
mod model;
mod viscosity;

pub use super::fade::TemperatureFade;
pub use drag::RollingDrag;
pub use form::{CoefficientAtTemperature, CoefficientLaw, CoefficientParameters};
pub use model::{CoefficientModel, DirectionalCoefficient, OneCoefficient};
pub use viscosity::{OilData, TEMPERATURE, Viscosity};
