//! What slip costs: friction power of the contacts under Hertz pressure.

use super::{ContactCoefficients, ContactKinematics, abs, sane_speed};
use crate::math;
use core::f32::consts::PI;

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
/// proportional to the speed, so the mean is a constant times the speed. It is formed
/// - where slip at the centre exceeds `|spin| a`: by the seven-point cubature
///   `0.3 |v(0)| + 7/60 sum |v_j|` with the six points at `rho^2 = 4/7`, exact for polynomials of
///   degree five under Hertz' weight;
/// - where spin rules: by `sqrt(V^2 + w^2 g)`, `g = (c w^2 a^2 m^2 + (v_y^2 a^2 + v_x^2 b^2) / 5) /
///   (c w^2 a^2 + V^2)`, `c = 0.2`, which meets both limits exactly: pure spin,
///   `m = 3/8 a E(1 - b^2/a^2)` with Legendre's complete elliptic integral `E`, and small spin;
///   `V^2` is the mean square of rolling and side slip;
/// - in between (1 to 1.25 times) by the weighted mean of both, so that the power is continuous.
///
/// Errors: ERRORS_POWER
///
/// Cost: CYCLES_POWER
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
/// assert!((ball.total() - 0.8455).abs() < 0.001, "{ball:?} {power:?}");
/// assert!(ball.by_slip().side > 0.9 * ball.total());
/// // Fifteen balls.
/// assert!((ball.of_nut(15).total() - 12.68).abs() < 0.02);
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

    /// Friction power (W) of one ball: friction coefficient (0 to 10), normal loads on screw and nut
    /// (N, 0 to 1e7), speed of the screw (rad/s).
    ///
    /// A factor that is not a number or out of its range counts as 0, and so does the power it makes.
    /// Cost: CYCLES_OF_BALL
    #[inline]
    #[must_use]
    pub fn of_ball(
        &self,
        friction: f32,
        load_screw: f32,
        load_nut: f32,
        speed: f32,
    ) -> BallFrictionPower {
        let rate = within(friction, 10.0) * abs(sane_speed(speed));
        BallFrictionPower {
            screw: self.screw.times(rate * within(load_screw, 1.0e7)),
            nut: self.nut.times(rate * within(load_nut, 1.0e7)),
        }
    }
}

/// `value` from 0 to `maximum`, else 0 (NaN too).
#[inline]
fn within(value: f32, maximum: f32) -> f32 {
    if value >= 0.0 && value <= maximum {
        value
    } else {
        0.0
    }
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

/// The blend ends where slip at the centre is `|spin| a`, and the cubature begins at this much more.
const CROSSOVER: f32 = 1.25;

impl Field {
    fn new(contact: &ContactCoefficients) -> Self {
        let (roll_2, side_2) = contact.parabolas();
        Self {
            roll: contact.rolling_slip,
            roll_2,
            side: contact.side_slip,
            side_2,
            spin: contact.spin,
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
        }
    }

    fn mean(&self) -> SlipParts {
        let centre = self.roll * self.roll + self.side * self.side;
        let rim = self.spin * self.semi_major;
        let rim = rim * rim;
        if centre >= CROSSOVER * CROSSOVER * rim {
            return self.cubature();
        }
        let blend = self.blend();
        if centre <= rim {
            return blend;
        }
        // rim < centre here, so rim > 0 unless both underflow, which the comparison above excludes.
        let weight = (math::sqrt(centre / rim) - 1.0) * (1.0 / (CROSSOVER - 1.0));
        blend
            .times(1.0 - weight)
            .plus(&self.cubature().times(weight))
    }

    /// Shares of `|v|` at one point.
    fn at(&self, x: f32, y: f32) -> SlipParts {
        let y_2 = y * y;
        let roll = self.roll + self.roll_2 * y_2;
        let side = self.side + self.side_2 * y_2;
        let (spin_x, spin_y) = (-self.spin * y, self.spin * x);
        let (v_x, v_y) = (roll + spin_x, side + spin_y);
        let squared = v_x * v_x + v_y * v_y;
        if squared > 0.0 {
            let inverse = 1.0 / math::sqrt(squared);
            SlipParts {
                rolling: roll * v_x * inverse,
                side: side * v_y * inverse,
                spin: (spin_x * v_x + spin_y * v_y) * inverse,
            }
        } else {
            SlipParts::default()
        }
    }

    /// Seven points, degree five under the weight `sqrt(1 - x^2/b^2 - y^2/a^2)`.
    fn cubature(&self) -> SlipParts {
        // rho = sqrt(4/7), at 30, 90, ..., 330 degrees: rho cos 30°, rho sin 30°, rho.
        let x = 0.654_653_67 * self.semi_minor;
        let y = 0.377_964_47 * self.semi_major;
        let far = 0.755_928_95 * self.semi_major;
        self.at(x, y)
            .plus(&self.at(x, -y))
            .plus(&self.at(-x, y))
            .plus(&self.at(-x, -y))
            .plus(&self.at(0.0, far))
            .plus(&self.at(0.0, -far))
            .times(7.0 / 60.0)
            .plus(&self.at(0.0, 0.0).times(0.3))
    }

    fn blend(&self) -> SlipParts {
        let a_2 = self.semi_major * self.semi_major;
        let b_2 = self.semi_minor * self.semi_minor;
        // Mean squares with <x^2> = b^2/5, <y^2> = a^2/5, <y^4> = 3 a^4/35.
        let square = |centre: f32, curvature: f32| {
            centre * centre
                + a_2 * (0.4 * centre * curvature + 3.0 / 35.0 * a_2 * curvature * curvature)
        };
        let roll = square(self.roll, self.roll_2);
        let side = square(self.side, self.side_2);
        let spin_2 = self.spin * self.spin;
        let spin = spin_2 * 0.2 * (a_2 + b_2);
        let sum = roll + side + spin;
        if sum <= 0.0 {
            return SlipParts::default();
        }
        let centre = roll + side;
        let lever = mean_lever(self.semi_major, self.semi_minor);
        let weight = 0.2 * spin_2 * a_2;
        let below = weight + centre;
        let squared = if below > 0.0 {
            let lever_2 = (weight * lever * lever + 0.2 * (side * a_2 + roll * b_2)) / below;
            centre + spin_2 * lever_2
        } else {
            0.0
        };
        // Cross terms between the kinds of slip vanish by symmetry: shares by mean squares.
        let factor = math::sqrt(squared) / sum;
        SlipParts {
            rolling: roll * factor,
            side: side * factor,
            spin: spin * factor,
        }
    }
}

/// Mean of `sqrt(x^2 + y^2)` over the ellipse, `3/8 a E(1 - b^2/a^2)`, from the ellipse's perimeter
/// `4 a E` by Ramanujan's second formula: 0 to 4e-4 below the exact value, the latter for `b = 0`.
pub(super) fn mean_lever(semi_major: f32, semi_minor: f32) -> f32 {
    let sum = semi_major + semi_minor;
    if sum <= 0.0 {
        return 0.0;
    }
    let h = (semi_major - semi_minor) / sum;
    let h3 = 3.0 * h * h;
    3.0 * PI / 32.0 * sum * (1.0 + h3 / (10.0 + math::sqrt(4.0 - h3)))
}
