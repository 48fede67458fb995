//! Motion of a ball and of its contacts, per unit of nut speed.

/// Motion of a ball per unit of nut speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBallMotion {
    /// Speed along the track less the nominal one, ball radii per radian of the nut.
    pub speed: f32,
    /// Total angular velocity about x (radial), y (along the track) and z, rad per radian of the nut.
    pub turn: [f32; 3],
}

/// Slip and spin of one contact per unit of nut speed; ball minus groove.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewContactMotion {
    /// Slip across the track, along the major axis of the contact, ball radii per radian of the nut.
    pub across: f32,
    /// Slip along the track, ball radii per radian of the nut.
    pub along: f32,
    /// Spin about the normal that points into the groove, rad per radian of the nut.
    pub spin: f32,
}

/// State of a ball, kept from tick to tick, with the results of the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBallState {
    /// Motion of the ball: where the next step starts.
    pub motion: ScrewBallMotion,
    /// Relative deviation of the orbital speed, 1, from [`ScrewBall::nominal_orbital_speed`](super::ScrewBall::nominal_orbital_speed).
    pub speed_deviation: f32,
    /// Change of that with a force along the track, 1/N.
    pub compliance: f32,
    /// Power loss in the grooves over the nut's speed, N m.
    pub groove_torque: f32,
}
