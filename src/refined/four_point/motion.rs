//! Motion of a ball relative to nominal rolling, and of its contacts.

/// Motion of a ball relative to nominal rolling, in units of the track speed.
///
/// Nominal rolling is that of a ball with four equal contact angles; deviations from it are small, and
/// so they keep their digits in f32.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallMotion {
    /// Deviation of the ball's speed along the track.
    pub speed: f32,
    /// Deviation of `r_b omega_x`, the rotation about the axis from left to right.
    pub roll: f32,
    /// `r_b omega_y`, the rotation about the axis from bottom to top.
    pub yaw: f32,
}

/// State of a ball, kept from tick to tick, with the results of the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallState {
    /// Motion of the ball: where the next Newton step starts.
    pub motion: BallMotion,
    /// Relative deviation `epsilon` of the ball's speed from nominal rolling.
    pub speed_deviation: f32,
    /// Change of the speed deviation with a force along the track, 1/N.
    pub compliance: f32,
    /// Power loss in the grooves over the track speed, N: the drag on the moving groove.
    pub friction_force: f32,
}

impl BallState {
    /// A ball in nominal rolling.
    pub const NOMINAL: Self = Self {
        motion: BallMotion {
            speed: 0.0,
            roll: 0.0,
            yaw: 0.0,
        },
        speed_deviation: 0.0,
        compliance: 0.0,
        friction_force: 0.0,
    };
}

/// Slip and spin of one contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactMotion {
    /// Slip of the ball on the groove at the contact's centre, in units of the track speed.
    pub slip: f32,
    /// Spin of the ball on the groove, in units of track speed over ball radius.
    pub spin: f32,
}
