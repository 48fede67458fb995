//! What slip costs: friction power of the contacts under Hertz pressure.

use super::ball::ContactKinematics;
use super::coefficients::ContactCoefficients;
use super::slip::sane_speed;
use crate::error::Range;
use crate::math;
use crate::ranges;

/// A quantity split by the kind of slip that causes it.
///
/// As a constant of [`FrictionPower`]: mean slip per rad/s of the screw, m. As a result: W.
///
/// The parts are shares along the total slip, `<v_part . v / |v|>`, and add up to
/// [`total`](Self::total). One part can be negative where it works against a larger one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipParts {
    /// Rolling slip's part.
    pub rolling: f32,
    /// Side slip's part.
    pub side: f32,
    /// Spin's part.
    pub spin: f32,
}

impl SlipParts {
    /// Sum of the three parts.
    #[inline]
    #[must_use]
    pub fn total(&self) -> f32 {
        self.rolling + self.side + self.spin
    }

    /// Every part multiplied by `factor`, for instance by the number of balls.
    #[inline]
    #[must_use]
    pub fn times(&self, factor: f32) -> Self {
        Self {
            rolling: self.rolling * factor,
            side: self.side * factor,
            spin: self.spin * factor,
        }
    }

    #[inline]
    fn plus(&self, other: &Self) -> Self {
        Self {
            rolling: self.rolling + other.rolling,
            side: self.side + other.side,
            spin: self.spin + other.spin,
        }
    }
}

/// Friction power of one ball (or of several equal ones), W.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallFrictionPower {
    /// Contact with the screw.
    pub screw: SlipParts,
    /// Contact with the nut.
    pub nut: SlipParts,
}

impl BallFrictionPower {
    /// Power of both contacts, W.
    #[inline]
    #[must_use]
    pub fn total(&self) -> f32 {
        self.screw.total() + self.nut.total()
    }

    /// Power of both contacts by kind of slip, W.
    #[inline]
    #[must_use]
    pub fn by_slip(&self) -> SlipParts {
        self.screw.plus(&self.nut)
    }

    /// Power of `balls` balls under the same load, as in a nut whose balls share it evenly, W.
    #[inline]
    #[must_use]
    pub fn of_nut(&self, balls: u16) -> Self {
        let factor = f32::from(balls);
        Self {
            screw: self.screw.times(factor),
            nut: self.nut.times(factor),
        }
    }
}

/// Friction power from contact kinematics: `P = mu W <|v_s|>`, with `<>` the mean over the contact
/// ellipse weighted by Hertz pressure.
///
/// `v_s` is linear in `x` and `y` apart from the parabolas of rolling and side slip, and
/// proportional to the speed, so the mean is a constant times the speed. It is a sum over eight lines
/// along the direction of rolling, at the nodes `y` of Gauss' rule for the pressure that a line carries,
/// `1 - y^2/a^2`. Along a line rolling and side slip are constant and spin adds `w x` across: with
/// `V^2 = v_x^2 + v_y^2` in its middle and `X^2 = b^2 (1 - y^2/a^2)` its mean is taken as
/// `sqrt(V^2 + w^2 g)`, `g = X^2 (c w^2 X^2 (4 / (3 pi))^2 + v_x^2 / 4) / (c w^2 X^2 + V^2)`,
/// `c = 0.3`, which meets both limits exactly: no slip in the middle, and little spin.
///
/// Errors against quadrature of the full field: 0.05 % for the paper's cases (Tables 2 and 4), each
/// part within 0.7 % of the total; 2.6 % for any linear field, whatever its direction, spin and axis
/// ratio; over 3000 random geometries with both parabolas median 1e-5, 95 % below 0.2 %, largest 3.3 %
/// (slip that vanishes within the ellipse), mean -1e-4.
///
/// Cost: about 1900 cycles for both contacts (modelled, Cortex-M4F).
///
/// Source: the Hertz mean of Coulomb friction; Alberdi et al. give the slip, not its power.
///
/// ```
/// # use epas_friction::kinematics::{ContactKinematics, FrictionPower, KinematicsParameters};
/// # fn main() -> Result<(), epas_friction::Error> {
/// # let degree = core::f32::consts::PI / 180.0;
/// # let kinematics = ContactKinematics::new(&KinematicsParameters {
/// #     ball_diameter: 7.94e-3,
/// #     pitch_radius: 19.25e-3,
/// #     lead_angle: 10.0 * degree,
/// #     groove_radius_screw: 4.2e-3,
/// #     groove_radius_nut: 4.2e-3,
/// #     contact_angle_screw: 41.0 * degree,
/// #     contact_angle_nut: 41.0 * degree,
/// #     pitch_angle: 40.0 * degree,
/// #     yaw_angle: 0.0,
/// #     rolling_radius_screw: 3.97e-3,
/// #     rolling_radius_nut: 3.97e-3,
/// #     semi_major_screw: 0.601e-3,
/// #     semi_minor_screw: 0.083e-3,
/// #     semi_major_nut: 0.586e-3,
/// #     semi_minor_nut: 0.097e-3,
/// # })?;
/// let power = FrictionPower::new(&kinematics);
/// // 151 N at both contacts, friction 0.075, 1000 revolutions a minute.
/// let ball = power.of_ball(0.075, 151.0, 151.0, 104.72);
/// assert!((ball.total() - 0.8438).abs() < 0.001);
/// assert!(ball.by_slip().side > 0.9 * ball.total());
/// // Fifteen balls.
/// assert!((ball.of_nut(15).total() - 12.66).abs() < 0.02);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionPower {
    screw: SlipParts,
    nut: SlipParts,
}

impl FrictionPower {
    /// Forms the mean slip of both contacts; again after each update of the kinematics.
    #[must_use]
    pub fn new(kinematics: &ContactKinematics) -> Self {
        Self {
            screw: Field::new(kinematics.screw()).mean(),
            nut: Field::new(kinematics.nut()).mean(),
        }
    }

    /// Mean sliding speed at the screw per rad/s, split by kind of slip, m.
    #[inline]
    #[must_use]
    pub const fn screw(&self) -> &SlipParts {
        &self.screw
    }

    /// Mean sliding speed at the nut per rad/s, split by kind of slip, m.
    #[inline]
    #[must_use]
    pub const fn nut(&self) -> &SlipParts {
        &self.nut
    }

    /// Sum of load times mean slip, W per rad/s and unit of friction.
    #[inline]
    pub(super) fn weighted(&self, load_screw: f32, load_nut: f32) -> f32 {
        load_screw * self.screw.total() + load_nut * self.nut.total()
    }

    /// Friction power (W) of one ball: friction coefficient (0 to 1), normal loads on screw and nut
    /// (N, 0 to 1e7), speed of the screw (rad/s).
    ///
    /// A factor that is not a number or out of its range counts as 0, and so does the power it makes.
    ///
    /// Cost: about 85 cycles (modelled, Cortex-M4F).
    #[inline]
    #[must_use]
    pub fn of_ball(
        &self,
        friction: f32,
        load_screw: f32,
        load_nut: f32,
        speed: f32,
    ) -> BallFrictionPower {
        let rate = within(ranges::FRICTION_OR_NONE, friction) * sane_speed(speed).abs();
        BallFrictionPower {
            screw: self.screw.times(rate * within(ranges::LOAD, load_screw)),
            nut: self.nut.times(rate * within(ranges::LOAD, load_nut)),
        }
    }
}

/// `value` within the range, else 0 (NaN too).
#[inline]
fn within(range: Range, value: f32) -> f32 {
    if range.contains(value) { value } else { 0.0 }
}

/// Slip over one ellipse per rad/s of the screw:
/// `v_x = roll + roll_2 y^2 - spin y`, `v_y = side + side_2 y^2 + spin x`, |x| <= b, |y| <= a.
struct Field {
    roll: f32,
    roll_2: f32,
    side: f32,
    side_2: f32,
    spin: f32,
    semi_major: f32,
    semi_minor: f32,
}

/// Gauss' rule on (-1, 1) under the weight `1 - y^2` (Gegenbauer polynomials `C^(3/2)_8`), exact to
/// degree fifteen: positive nodes, and weights of one node of which all eight add up to one.
pub(crate) const LINES: [(f32, f32); 4] = [
    (0.165_278_96, 0.238_944_24),
    (0.477_924_95, 0.169_002_42),
    (0.738_773_87, 0.076_610_777),
    (0.919_533_91, 0.015_442_572),
];
/// `(4 / (3 pi))^2`: square of the mean of `|x|` under a semicircle of unit radius.
pub(crate) const KINK: f32 = 0.180_126_55;
/// Share of the spin's own square in the blend between both limits. Any from 0.2 to 0.6 leaves the same largest error of
/// linear fields on axis ratios of 0.05 to 1, 2.2 %; 0.1 leaves 3.7 % (`host-tests/tests/generators/lines.rs`).
pub(crate) const BLEND: f32 = 0.3;

impl Field {
    fn new(contact: &ContactCoefficients) -> Self {
        let (roll_2, side_2) = contact.parabolas();
        Self {
            roll: contact.slip.rolling_slip,
            roll_2,
            side: contact.slip.side_slip,
            side_2,
            spin: contact.slip.spin,
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
        }
    }

    fn mean(&self) -> SlipParts {
        let mut sum = SlipParts::default();
        // Square of the speed across a line that the spin gives to the end of the minor axis.
        let end_speed = self.spin * self.semi_minor;
        let end_speed_2 = end_speed * end_speed;
        for (node, weight) in LINES {
            let y = node * self.semi_major;
            let y_2 = y * y;
            let roll = self.roll + self.roll_2 * y_2;
            let side = self.side + self.side_2 * y_2;
            let turning = self.spin * y;
            let across = end_speed_2 * (1.0 - node * node);
            sum = sum
                .plus(&line(roll, side, -turning, across).times(weight))
                .plus(&line(roll, side, turning, across).times(weight));
        }
        sum
    }
}

/// Mean slip along one line, split: rolling slip, side slip and the spin's slip along the line are
/// constant on it; `across` is the square of the spin's slip across it at its ends.
fn line(roll: f32, side: f32, turning: f32, across: f32) -> SlipParts {
    let v_x = roll + turning;
    let along_2 = v_x * v_x;
    let middle = along_2 + side * side;
    let blend = BLEND * across;
    let below = blend + middle;
    // Slip below 1e-15 m per radian is none; its square would leave the range of f32.
    if below < 1.0e-30 {
        return SlipParts::default();
    }
    let squared = middle + across * (blend * KINK + 0.25 * along_2) / below;
    // Shares by mean squares, <v_part . v>, whose sum is <v^2> = middle + across / 4.
    let factor = math::sqrt(squared) / (middle + 0.25 * across);
    SlipParts {
        rolling: roll * v_x * factor,
        side: side * side * factor,
        spin: (turning * v_x + 0.25 * across) * factor,
    }
}
