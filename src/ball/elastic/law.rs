//! What a ball of a ring does on its own between two renewals, and what all balls have in common in a tick.

use super::constants::BallConstants;
use super::renewal::{Renewal, Settled};
use crate::math::{self, inverse_cube_roots};
use crate::train::IMPEDANCE_RANGE;

/// Least and largest impedance of a loaded ball, N, at its renewal: within what a train takes
/// ([`IMPEDANCE_RANGE`](crate::train::IMPEDANCE_RANGE)) by a factor of ten or more. Until the next renewal it follows the
/// load's power 2/3, and a load that has changed by more than a factor of three has all balls begin anew.
const IMPEDANCES: (f32, f32) = (1e-6, 1e8);
const _: () = assert!(IMPEDANCES.0 >= IMPEDANCE_RANGE.0 && IMPEDANCES.1 <= IMPEDANCE_RANGE.1);

/// A screw's balls: constants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct RingConstants {
    pub(super) ball: BallConstants,
    /// Speed of a nominal ball and its speed against the nut, over ball radius and nut speed.
    pub(super) nominal: f32,
    pub(super) reference: f32,
    pub(super) per_reference: f32,
    /// Angular velocity of a nominal ball's orbit about the axis across track and radius.
    pub(super) orbit: f32,
    /// Largest deviation of a ball's speed, over the nominal one against the nut.
    pub(super) fastest: f32,
}

/// One ball: 36 bytes. Lengths over the ball radius, speeds over the nut's.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct RingBall {
    pub(super) place: [f32; 3],
    pub(super) turning: [f32; 3],
    /// Speed without forces of neighbours less the nominal one, over the nominal one against the nut.
    pub(super) free: f32,
    /// Force along the track that changes this by one, over the power 2/3 of the load; 0 of a ball without load.
    pub(super) impedance: f32,
    /// Friction torque on the nut over the power 7/6 of the load.
    pub(super) torque: f32,
}

/// The load that all balls have in common, in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct RingLoad {
    /// Mean axial load of a ball in the frame in which the nut turns forward, N.
    pub(crate) axial: f32,
    /// Mean contact force with that of the preload, smooth where the load crosses zero, N: `sqrt(F^2 + 8 P^2)`.
    pub(super) whole: f32,
    /// Powers 2/3 and 7/6 of the load, preload counted, and inverse ones. Friction of slip across the track goes with the
    /// load, that of spin with its power 4/3; a screw's torque has both.
    pub(super) two_thirds: f32,
    pub(super) seven_sixths: f32,
    pub(super) per_two_thirds: f32,
    pub(super) per_seven_sixths: f32,
}

/// What a ball next to another one does to it, N.
pub(crate) struct Neighbour {
    /// Force along the track.
    pub(crate) force: f32,
    /// Largest friction force; 0 of a neighbour without load, which turns as the ball makes it.
    pub(crate) friction: f32,
}

/// A ball's neighbours in the frame in which the nut turns forward.
pub(crate) struct Neighbours {
    pub(crate) behind: Neighbour,
    pub(crate) ahead: Neighbour,
}

impl Neighbours {
    /// Force of both along the track, N.
    #[inline(always)]
    pub(super) fn force(&self) -> f32 {
        self.behind.force - self.ahead.force
    }

    /// Largest friction forces of both across the track, N: their sum, and that of the ball in front less that of the ball
    /// behind.
    #[inline(always)]
    pub(super) fn rubbing(&self) -> [f32; 2] {
        let (ahead, behind) = (self.ahead.friction, self.behind.friction);
        [ahead + behind, ahead - behind]
    }
}

impl RingConstants {
    /// What its balls have in common.
    pub(crate) const fn ball(&self) -> &BallConstants {
        &self.ball
    }

    /// Of grooves in which no ball's speed deviates by more than `fastest`, over that of a nominal ball against the nut.
    pub(crate) const fn new(ball: &BallConstants, fastest: f32) -> Self {
        let grooves = &ball.grooves;
        let nominal = 0.5 * (grooves.path + grooves.cos_lead * grooves.cos);
        let reference = grooves.path - nominal;
        Self {
            nominal,
            reference,
            per_reference: 1.0 / reference,
            orbit: nominal * grooves.orbit,
            fastest,
            ball: *ball,
        }
    }
}

/// `value`, or the bound that it is beyond; NaN is the least.
#[inline(always)]
pub(super) const fn between(value: f32, least: f32, most: f32) -> f32 {
    if value > most {
        most
    } else if value > least {
        value
    } else {
        least
    }
}

/// Square of a ball's contact force under an axial load, N, preload counted, smooth where the load crosses zero: `F^2 + 8 P^2`, N^2.
#[inline(always)]
fn whole_squared(constants: &RingConstants, axial: f32, lift_off: f32) -> f32 {
    let normal = constants.ball.normal * axial;
    normal * normal + lift_off * lift_off
}

/// Growth of a ball's friction torque from one axial load, N, to another, of either sign and not both zero: the power 7/6 of that of
/// the contact force, preload counted, as a ratio of its square `x`:
///
/// ```text
/// x^(7/12) -> (19 x + 5)/(5 x + 19)
/// ```
///
/// Within 0.3 % for factors of the force up to 1.25, 1.7 % up to 1.5, 8 % up to 2; between 5/19 and 19/5 for any.
#[inline(always)]
pub(super) fn growth(constants: &RingConstants, lift_off: f32, from: f32, to: f32) -> f32 {
    let [from, to] = [from, to].map(|axial| whole_squared(constants, axial, lift_off));
    (19.0 * to + 5.0 * from) / (5.0 * to + 19.0 * from)
}

impl RingLoad {
    /// Of a mean axial load in the frame in which the nut turns forward, N.
    #[inline(always)]
    pub(super) fn new(constants: &RingConstants, axial: f32, lift_off: f32) -> Self {
        let whole = math::sqrt(whole_squared(constants, axial, lift_off));
        let [inverse, _] = inverse_cube_roots([whole, 1.0]);
        let two_thirds = whole * inverse;
        let seven_sixths = two_thirds * two_thirds * math::sqrt(inverse);
        // What is stored and read under one load is itself to the last bits. One division for both reciprocals.
        let both = 1.0 / (two_thirds * seven_sixths);
        Self {
            axial,
            whole,
            two_thirds,
            seven_sixths,
            per_two_thirds: both * seven_sixths,
            per_seven_sixths: both * two_thirds,
        }
    }

    /// Impedance of a ball, N.
    #[inline(always)]
    pub(crate) fn impedance(&self, ball: &RingBall) -> f32 {
        ball.impedance * self.two_thirds
    }

    /// Friction torque of balls on the nut, from the sum of theirs, N m.
    #[inline(always)]
    pub(crate) fn torque(&self, sum: f32) -> f32 {
        sum * self.seven_sixths
    }
}

impl RingBall {
    /// Keeps what a renewal under a force of both neighbours found, with a free speed within `fastest`.
    #[inline(always)]
    pub(super) fn keep(
        &mut self,
        constants: &RingConstants,
        load: &RingLoad,
        settled: &Settled,
        found: &Renewal,
        force: f32,
        fastest: f32,
    ) {
        let radius = constants.ball.grooves.ball_radius;
        let impedance = constants.reference * radius / found.compliance;
        let impedance = between(impedance, IMPEDANCES.0, IMPEDANCES.1);
        let free =
            (settled.speed - constants.nominal) * constants.per_reference - force / impedance;
        self.place = settled.place;
        self.turning = settled.turning;
        self.free = between(free, -fastest, fastest);
        self.impedance = impedance * load.per_two_thirds;
        self.torque = constants.ball.torque(found) * load.per_seven_sixths;
    }

    /// Free speed, over the nominal one against the nut.
    #[inline(always)]
    pub(crate) const fn free(&self) -> f32 {
        self.free
    }

    /// Friction torque over the power 7/6 of the load.
    #[inline(always)]
    pub(crate) const fn torque(&self) -> f32 {
        self.torque
    }

    /// A ball that leaves its load.
    #[inline(always)]
    pub(crate) fn leave(&mut self) {
        self.impedance = 0.0;
    }

    /// Whether the ball carries load.
    #[inline(always)]
    pub(crate) const fn loaded(&self) -> bool {
        self.impedance > 0.0
    }

    /// Half the speed with which balls alike rub, m per unit of nut speed (Lin 2019, eq. (3.73), with `cos(beta_BB)` as 1 and the
    /// orbit of a nominal ball).
    #[inline(always)]
    pub(crate) fn rubbing(&self, constants: &RingConstants) -> f32 {
        let [x, _, z] = self.turning;
        let z = z - constants.orbit;
        math::sqrt(x * x + z * z) * constants.ball.grooves.ball_radius
    }
}
