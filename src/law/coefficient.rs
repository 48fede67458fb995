//! Friction coefficient by speed, temperature and direction; churning drag.
//!
//! [`CoefficientLaw`] is folded at set-up; [`CoefficientLaw::at_temperature`] runs where a new temperature comes in, outside
//! the interrupt; [`CoefficientAtTemperature::at`] runs in the loop.

mod both;
mod fade;
mod form;
mod model;
mod viscosity;

pub use both::DirectionalCoefficient;
pub use fade::TemperatureFade;
pub use form::{CoefficientAtTemperature, CoefficientLaw, CoefficientParameters};
pub use model::{CoefficientModel, OneCoefficient};
pub use viscosity::{OilData, TEMPERATURE, Viscosity};
