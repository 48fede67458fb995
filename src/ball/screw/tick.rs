//! A row of balls under one load, and one ball of it, in closed form: called directly, and at the set-up of
//! [`UncagedBallScrew`](crate::UncagedBallScrew) for the range of speeds. No step runs it.

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
    /// Coefficients of `t(u)`, 1/rad to 1/rad^5, and of `o(v)`, 1/rad to 1/rad^3: see [`ScrewLoop::ball`].
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

/// The row under one load, folded for a loop over balls whose deviations are within their limits: speeds over a speed of
/// reference, deviations in units of their maps. Made by [`ScrewTick::per_speed`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewLoop {
    /// Coefficients of `t(u)`, times `scale`, and of `o(v)`, in powers of 1/rad.
    turn: [f32; 5],
    tilt: [f32; 3],
    /// Weights of the deviations' units at screw and nut in `u`, which turns the ball, rad.
    turn_weights: (f32, f32),
    /// The same in `v`, which tilts its contact, rad.
    tilt_weights: (f32, f32),
    /// Speed that the relative deviation multiplies, over the speed of reference.
    scale: f32,
    /// Speed lost per newton, over the speed of reference, 1/N: the parts of [`ScrewTick`], and the rolling one's change with the speed.
    compliance_rolling: f32,
    compliance_sliding: f32,
    compliance_spin: f32,
    /// Power loss in the grooves, N m, in the same three parts.
    torque_rolling: f32,
    torque_sliding: f32,
    torque_spin: f32,
}

/// One ball in that loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoopBall {
    /// Speed along the track when no neighbour presses, less the nominal one, over the speed of reference.
    pub speed: f32,
    /// Force along the track, N, that takes the speed of reference from the ball.
    pub impedance: f32,
}

/// Sums over the balls of that loop, from which the power loss in the grooves follows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoopSums {
    /// Shares `q` of the load, their powers 4/3, and these times the balls' speeds.
    share: f32,
    four_thirds: f32,
    four_thirds_speed: f32,
}

impl LoopSums {
    /// Of no ball.
    pub const NONE: Self = Self {
        share: 0.0,
        four_thirds: 0.0,
        four_thirds_speed: 0.0,
    };
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

    /// One ball, by [`ScrewLoop::ball`]; a deviation beyond [`ScrewRow::largest_deviation`](super::ScrewRow::largest_deviation)
    /// is taken at it, NaN is none.
    #[inline]
    #[must_use]
    pub const fn ball(
        &self,
        screw_deviation: f32,
        nut_deviation: f32,
        share: &LoadShare,
    ) -> ScrewTickBall {
        let balls = self.per_speed(1.0, 1.0, (1.0, 1.0));
        let mut sums = LoopSums::NONE;
        let ball = balls.ball(
            limited(screw_deviation, self.largest_deviation),
            limited(nut_deviation, self.largest_deviation),
            share,
            &mut sums,
        );
        ScrewTickBall {
            speed_deviation: ball.speed,
            compliance: 1.0 / ball.impedance,
            groove_torque: balls.groove_torque(&sums),
            rubbing: self.rubbing + self.rubbing_slope * ball.speed,
        }
    }

    /// The row for speeds over a speed of reference, m per unit of nut speed, given with its inverse, and
    /// deviations at screw and nut in these `units`, rad: once for all balls of the row.
    #[inline(always)]
    #[must_use]
    pub const fn per_speed(&self, speed: f32, per_speed: f32, units: (f32, f32)) -> ScrewLoop {
        let (screw, nut) = units;
        let size = per_speed.abs();
        let scale = self.scale * per_speed;
        let spin = self.spin * speed;
        let compliance_rolling = self.compliance_rolling * size;
        let [t1, t2, t3, t4, t5] = self.turn;
        ScrewLoop {
            turn: [t1 * scale, t2 * scale, t3 * scale, t4 * scale, t5 * scale],
            tilt: self.tilt,
            turn_weights: (self.weights.both * screw, self.weights.both * nut),
            tilt_weights: (self.weights.screw * screw, self.weights.nut * nut),
            scale,
            compliance_rolling,
            compliance_sliding: self.compliance_sliding * size,
            compliance_spin: compliance_rolling * spin,
            torque_rolling: self.torque_rolling,
            torque_sliding: self.torque_sliding,
            torque_spin: self.torque_rolling * spin,
        }
    }
}

impl ScrewLoop {
    /// One ball with deviations of the screw's and the nut's groove, in units, and its share of the load; adds what its
    /// losses follow from to `sums`.
    ///
    /// ```text
    /// u = w (d_S + d_N)      v = w_S d_S + w_N d_N
    /// speed     = t(u) + o(v) (1 + t(u))            (relative; t and o are series of five and three terms)
    /// impedance = q / (y_sliding + q^(1/3) y_rolling (1 + s speed))
    /// ```
    ///
    /// with the share `q` of the load and the change `s` of the contacts' spin with the speed. [`ScrewTick::ball`] is the
    /// same in SI units. Cost: 116 modelled cycles on a Cortex-M4F.
    ///
    /// Independent operations stand side by side: a core without reordering waits a cycle where an operation needs the
    /// result of the one before.
    #[inline(always)]
    pub const fn ball(
        &self,
        screw: f32,
        nut: f32,
        share: &LoadShare,
        sums: &mut LoopSums,
    ) -> LoopBall {
        let LoadShare { share, root } = *share;
        let [t1, t2, t3, t4, t5] = self.turn;
        let [o1, o2, o3] = self.tilt;
        let (u, v) = (self.turn_weights.0 * screw, self.tilt_weights.0 * screw);
        let (x, y) = (self.turn_weights.1 * nut, self.tilt_weights.1 * nut);
        let (u, v) = (u + x, v + y);
        let (square, other) = (u * u, v * v);
        let (low, series) = (t2 * u, o2 * v);
        let (high, compliance) = (t4 * u, self.compliance_rolling * root);
        let (low, series) = (t1 + low, o1 + series);
        let (high, top) = (t3 + high, t5 * square);
        let (cubic, spin) = (o3 * other, self.compliance_spin * root);
        let (high, power) = (high + top, share * root);
        let (series, compliance) = (series + cubic, compliance + self.compliance_sliding);
        let high = high * square;
        let series = series * v;
        let turn = (low + high) * u;
        // The coefficients t1 to t5 hold the scale, so that `turn` is a speed.
        let (all, shares) = (self.scale + turn, sums.share + share);
        let (tilt, powers) = (series * all, sums.four_thirds + power);
        let speed = turn + tilt;
        *sums = LoopSums {
            share: shares,
            four_thirds: powers,
            four_thirds_speed: sums.four_thirds_speed + power * speed,
        };
        LoopBall {
            speed,
            impedance: share / (compliance + spin * speed),
        }
    }

    /// Power loss of these balls in the grooves, N m.
    #[inline(always)]
    #[must_use]
    pub const fn groove_torque(&self, sums: &LoopSums) -> f32 {
        self.torque_sliding * sums.share
            + self.torque_rolling * sums.four_thirds
            + self.torque_spin * sums.four_thirds_speed
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
