//! Friction coefficient by speed, temperature and direction; lubricant drag of rolling contacts and churning.
//!
//! [`CoefficientLaw`] is folded at set-up; [`CoefficientLaw::at_temperature`] runs where a new temperature comes in, outside
//! the interrupt; [`CoefficientAtTemperature::at`] runs in the loop.

mod at_temperature;
mod both;
mod drag;
mod fade;
mod form;
mod model;
mod viscosity;

pub use at_temperature::CoefficientAtTemperature;
pub use both::DirectionalCoefficient;
pub use drag::RollingDrag;
pub use fade::TemperatureFade;
pub use form::{CoefficientLaw, CoefficientParameters};
pub use model::{CoefficientModel, OneCoefficient};
pub use viscosity::{OilData, TEMPERATURE, Viscosity};
