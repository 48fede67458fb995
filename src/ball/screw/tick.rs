//! A row of balls under one load, and one ball of it, in closed form: at the set-up of a
//! [`FoldedBall`](crate::scene::FoldedBall) from catalogue numbers. No step runs it.

use super::speeds::{Branch, Speeds, Weights};
use crate::ball::loads::LoadShare;

/// A row of balls under one load; all values per unit of nut speed.
///
/// The true speeds along the track are `nut_speed * (nominal_speed + speed_deviation)`, compliances
/// `|nut_speed| * compliance`, and a touching pair loses the torque
/// `ball_friction * contact_force * (rear.rubbing + front.rubbing)` on the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewTick {
    /// Largest deviation of a contact angle that counts, rad.
    largest_deviation: f32,
    /// Coefficients of `t(u)`, 1/rad to 1/rad^5, and of `o(v)`, 1/rad to 1/rad^3: see [`ScrewTick::ball`].
    turn: [f32; 5],
    tilt: [f32; 3],
    weights: Weights,
    /// Speed that the relative deviation multiplies, m.
    scale: f32,
    /// Relative change of the contacts' spin with the ball's speed, 1/m.
    spin: f32,
    /// Half the speed with which nominal balls rub, m, and its change with the ball's speed.
    rubbing: f32,
    rubbing_slope: f32,
    /// Speed lost per newton of force along the track under the mean load, m/N: the part that follows the size of the ellipses, and
    /// the rest.
    compliance_rolling: f32,
    compliance_sliding: f32,
    /// Power loss in the grooves under the mean load, N m, in the same parts.
    torque_rolling: f32,
    torque_sliding: f32,
    /// Speed along the track of a nominal ball, m.
    nominal_speed: f32,
    /// Load of each main contact and of the third one under the mean load, N.
    main_load: f32,
    third_load: f32,
}

/// One ball of the row, per unit of nut speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewTickBall {
    /// Speed along the track when no neighbour presses, less [`ScrewTick::nominal_speed`], m.
    pub speed_deviation: f32,
    /// Speed along the track lost per newton of force along it, m/N.
    pub compliance: f32,
    /// Power loss in the grooves, N m: the ball's friction torque on the nut.
    pub groove_torque: f32,
    /// Half the speed with which balls alike rub against each other, m.
    pub rubbing: f32,
}

/// A ball under the mean load: what the row takes from its loads.
#[derive(Clone, Copy)]
pub(super) struct Mean {
    /// Part of a diagonal's speed that remains where the other diagonal carries load as well.
    pub(super) gain: f32,
    /// Speed along the track lost per newton of force along it, m/N.
    pub(super) compliance: f32,
    /// Its part that follows the size of the ellipses.
    pub(super) compliance_rolling: f32,
    /// Power loss in the grooves, N m.
    pub(super) torque: f32,
    /// Its part that follows the size of the ellipses.
    pub(super) torque_rolling: f32,
    /// Load of each main contact and of the third one, N.
    pub(super) main_load: f32,
    pub(super) third_load: f32,
}

impl ScrewTick {
    /// From how speeds follow deviations, and from a ball under the mean load.
    #[inline]
    pub(super) const fn new(
        speeds: &Speeds,
        (branch, weights): (&Branch, Weights),
        mean: &Mean,
    ) -> Self {
        Self {
            largest_deviation: speeds.largest_deviation,
            turn: speeds.turn,
            tilt: [
                branch.sine,
                0.5 * branch.versine,
                -branch.sine * (1.0 / 6.0),
            ],
            weights,
            scale: mean.gain * branch.scale,
            spin: branch.spin,
            rubbing: branch.rubbing,
            rubbing_slope: branch.rubbing_slope,
            compliance_rolling: mean.compliance_rolling,
            compliance_sliding: mean.compliance - mean.compliance_rolling,
            torque_rolling: mean.torque_rolling,
            torque_sliding: mean.torque - mean.torque_rolling,
            nominal_speed: speeds.nominal,
            main_load: mean.main_load,
            third_load: mean.third_load,
        }
    }

    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    #[must_use]
    pub const fn nominal_speed(&self) -> f32 {
        self.nominal_speed
    }

    /// Load of each main contact of a ball under the mean load, N.
    #[must_use]
    pub const fn main_load(&self) -> f32 {
        self.main_load
    }

    /// Load of the third contact of a ball under the mean load, N.
    #[must_use]
    pub const fn third_load(&self) -> f32 {
        self.third_load
    }

    /// Half the speed with which two nominal balls rub, m per unit of nut speed (Lin 2019, eq. (3.73), with `cos(beta_BB)` as 1).
    #[must_use]
    pub const fn rubbing(&self) -> f32 {
        self.rubbing
    }

    /// Change of that with the speed along the track.
    #[must_use]
    pub const fn rubbing_slope(&self) -> f32 {
        self.rubbing_slope
    }

    /// One ball with these deviations of its contact angles on screw and nut, rad, and its share of the load.
    ///
    /// ```text
    /// u = w (d_S + d_N)      v = w_S d_S + w_N d_N
    /// speed_deviation = t(u) + o(v) (scale + t(u))            (t and o are series of five and three terms)
    /// compliance      = (y_sliding + q^(1/3) y_rolling (1 + s speed_deviation)) / q
    /// groove_torque   = T_sliding q + T_rolling q^(4/3) (1 + s speed_deviation)
    /// ```
    ///
    /// with the share `q` of the load and the change `s` of the contacts' spin with the speed. A deviation beyond
    /// [`ScrewRow::largest_deviation`](super::ScrewRow::largest_deviation) is cut to it; NaN counts as 0.
    #[inline]
    #[must_use]
    pub const fn ball(
        &self,
        screw_deviation: f32,
        nut_deviation: f32,
        share: &LoadShare,
    ) -> ScrewTickBall {
        let LoadShare { share, root } = *share;
        let screw = limited(screw_deviation, self.largest_deviation);
        let nut = limited(nut_deviation, self.largest_deviation);
        let [t1, t2, t3, t4, t5] = self.turn;
        let [o1, o2, o3] = self.tilt;
        let u = self.weights.both * screw + self.weights.both * nut;
        let v = self.weights.screw * screw + self.weights.nut * nut;
        let (square, other) = (u * u, v * v);
        let scale = self.scale;
        let low = t1 * scale + t2 * scale * u;
        let high = (t3 * scale + t4 * scale * u) + t5 * scale * square;
        let turn = (low + high * square) * u;
        let tilt = ((o1 + o2 * v) + o3 * other) * v * (scale + turn);
        let speed = turn + tilt;
        let spin = 1.0 + self.spin * speed;
        ScrewTickBall {
            speed_deviation: speed,
            compliance: (self.compliance_sliding + self.compliance_rolling * root * spin) / share,
            groove_torque: share * (self.torque_sliding + self.torque_rolling * root * spin),
            rubbing: self.rubbing + self.rubbing_slope * speed,
        }
    }
}

/// A deviation within the limits of the series; NaN gives zero.
#[inline]
pub(super) const fn limited(deviation: f32, largest: f32) -> f32 {
    if deviation.abs() <= largest {
        deviation
    } else if deviation.is_nan() {
        0.0
    } else {
        largest.copysign(deviation)
    }
}
