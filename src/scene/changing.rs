//! What of a scene may change while it runs.

use super::contract::Scene;
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
