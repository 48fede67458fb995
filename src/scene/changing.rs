//! What of a scene may change while it runs.

use super::contract::Scene;
use crate::ball::Clearance;
use crate::error::Error;

/// A scene whose friction coefficient may change while it runs.
pub trait ChangingFriction: Scene {
    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
    ///
    /// # Errors
    /// [`Error`] naming `friction`; the state is then as it was.
    fn set_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        friction: f32,
    ) -> Result<(), Error>;
}

/// A scene whose balls fit between the grooves with a clearance that may change while it runs.
pub trait ChangingClearance: Scene {
    /// See [`FrictionModel::set_clearance`](crate::FrictionModel::set_clearance).
    ///
    /// # Errors
    /// [`Error`] naming `clearance`; the state is then as it was.
    fn set_clearance(
        constants: &Self::Constants,
        state: &mut Self::State,
        clearance: Clearance,
    ) -> Result<(), Error>;
}
