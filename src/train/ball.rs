//! One ball of a train.

/// What a train keeps of a ball and of the distance in front of it, and a place for half a cluster.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Ball {
    /// Free speed, then actual speed.
    pub(super) speed: f32,
    pub(super) impedance: f32,
    /// How fast the distance in front may close beyond what the free speeds make of it: negative where the
    /// ball would run into the one in front. Then, at the rear ball of a cluster, the sum of its impedances.
    pub(super) slack: f32,
    /// Force between the ball and the one in front. Until it is known, the sum of the impedances of the
    /// cluster whose front ball this is, or the sum of the slacks of the cluster whose rear ball it is.
    pub(super) force: f32,
    /// The sum of the cluster whose front ball this is, or the sum of the impedances of the cluster whose rear ball
    /// it is. Then, at the rear ball, what is left of the cluster's pushes.
    pub(super) sum: f32,
    /// Place on the track.
    pub(super) position: u32,
    /// Sixteenths of a unit.
    pub(super) fraction: u8,
    /// Balls of the cluster besides this one, at the cluster's two ends.
    pub(super) extent: u8,
}

impl Ball {
    pub(super) const REST: Self = Self {
        speed: 0.0,
        impedance: 1.0,
        slack: 0.0,
        force: 0.0,
        sum: 0.0,
        position: 0,
        fraction: 0,
        extent: 0,
    };

    /// What the ball would do on its own.
    #[inline(always)]
    pub(super) fn set(&mut self, speed: f32, impedance: f32, slack: f32) {
        self.speed = speed;
        self.impedance = impedance;
        self.slack = slack;
    }
}
