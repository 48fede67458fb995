//! The firmware example of the README, to the letter, so that its costs are counted.

use epas_friction::*;

/// Once, at set-up: the words of a block in, a checked model out, or an error that names what is wrong.
pub fn set_up(words: &[u32]) -> Result<FrictionModel<CagedBallScrew>, Error> {
    Ok(FrictionModel::of(CagedConstants::from_block(words)?))
}

/// Every millisecond: the friction torque on the nut, N m, with the sign of the speed. At the motor: over the belt's ratio.
pub fn friction_compensation(model: &mut FrictionModel<CagedBallScrew>, nut_speed: f32, axial_load: f32) -> f32 {
    model.step(Inputs { nut_speed, axial_load }).friction_torque // regime, efficiency, faults beside it
}
