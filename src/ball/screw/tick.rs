//! A row of balls under the load of one tick, and the speed of a ball.

use crate::ball::loads::LoadShare;
use crate::geometry::BallScrew;
use crate::math::constant;

/// A row of balls under one load; all values per unit of nut speed.
///
/// Speeds along the track are `nut_speed * (nominal_speed + speed_deviation)`, compliances `|nut_speed| * compliance`; a touching pair loses
/// the torque `ball_friction * contact_force * (rear.rubbing + front.rubbing)` on the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewTick {
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
    pub const fn nominal_speed(&self) -> f32 {
        self.nominal_speed
    }

    /// Load of each main contact of a ball under the mean load, N.
    pub const fn main_load(&self) -> f32 {
        self.main_load
    }

    /// Load of the third contact of a ball under the mean load, N.
    pub const fn third_load(&self) -> f32 {
        self.third_load
    }

    /// Half the speed with which two nominal balls rub, m per unit of nut speed (Lin 2019, eq. (3.73), with `cos(beta_BB)` as 1).
    pub const fn rubbing(&self) -> f32 {
        self.rubbing
    }

    /// Change of [`Self::rubbing`] with the speed along the track.
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

/// Largest deviation of a contact angle from the nominal one, rad: four times the 2 to 3 degrees of Lin 2019. With it in both
/// grooves the series of a ball's speed in `u` is off by 5e-4 at a contact angle of 45 degrees.
const LARGEST_DEVIATION: f32 = 0.2;

/// Dependence of a ball's speed on its contact angles: one formula for each set of contacts that may carry it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Speeds {
    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    pub(super) nominal: f32,
    /// Coefficients of the series of `2 cos beta/(cos beta + cos(beta - u)) - 1`, from that of `u` to that of `u^5`.
    pub(super) turn: [f32; 5],
    pub(super) largest_deviation: f32,
    /// With the third contact on the screw, on the nut, and with two contacts.
    third_on_screw: Branch,
    third_on_nut: Branch,
    two_point: Branch,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Branch {
    /// Speed, m, that the relative deviation multiplies; negative where it is that of the nut against the ball.
    pub(super) scale: f32,
    /// `r sin beta` over `1 + r cos beta` (third contact on the screw) or `1 - r cos beta` (on the nut).
    pub(super) sine: f32,
    /// `-r cos beta` or `r cos beta` over the same.
    pub(super) versine: f32,
    /// Rubbing speed at the nominal speed, m per unit of nut speed.
    pub(super) rubbing: f32,
    /// Its change with the ball's speed, 1.
    pub(super) rubbing_slope: f32,
    /// Relative change of the contacts' spin with the ball's speed, 1/m.
    pub(super) spin: f32,
}

/// Signs and weights with which the deviations of both grooves count in `u` and `v` of [`ScrewTick::ball`](super::ScrewTick::ball).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Weights {
    /// Of the sum of both, in `u`, which turns the ball.
    pub(super) both: f32,
    /// Of both grooves in `v`, which tilts the ball's contact with the groove that has no third contact.
    pub(super) screw: f32,
    pub(super) nut: f32,
}

impl Speeds {
    pub(super) const fn new(design: &BallScrew, sticks_to_screw: bool) -> Self {
        let angle = design.contact_angle();
        let (sin, cos) = (angle.sin, angle.cos);
        let path = design.path_radius();
        // r = r_b r_m/q².
        let ratio = design.ball_radius() * design.cos_lead_angle() / path;
        let (plus, minus) = (1.0 + ratio * cos, 1.0 - ratio * cos);
        let speed = 0.5 * path * plus;
        let against_nut = 0.5 * path * minus;
        let third_on_screw = Branch {
            scale: speed,
            sine: ratio * sin / plus,
            versine: -ratio * cos / plus,
            rubbing: speed * (1.0 / cos - ratio),
            rubbing_slope: 1.0 / cos - ratio,
            spin: 2.0 / path,
        };
        let third_on_nut = Branch {
            scale: -against_nut,
            sine: ratio * sin / minus,
            versine: ratio * cos / minus,
            rubbing: against_nut * (1.0 / cos + ratio),
            rubbing_slope: -(1.0 / cos + ratio),
            spin: -2.0 / path,
        };
        let tumbling = tumbling(design, ratio, sticks_to_screw);
        let (rubbing, rubbing_slope) = if sticks_to_screw {
            (speed * tumbling, tumbling)
        } else {
            (against_nut * tumbling, -tumbling)
        };
        Self {
            nominal: speed,
            turn: turn_series(sin / cos),
            largest_deviation: largest_deviation(design.parameters().contact_angle, sin / cos),
            third_on_screw,
            third_on_nut,
            two_point: Branch {
                rubbing,
                rubbing_slope,
                spin: 0.0,
                ..third_on_screw
            },
        }
    }

    /// With two contacts, under a load on the left (`side` = 1, an axial load below 0) or right diagonal (-1).
    #[inline]
    pub(super) const fn in_two_points(&self, side: f32) -> (&Branch, Weights) {
        let weights = Weights {
            both: 0.0,
            screw: -0.5 * side,
            nut: 0.5 * side,
        };
        (&self.two_point, weights)
    }

    /// With the third contact on the screw or on the nut.
    #[inline]
    pub(super) const fn in_more_points(&self, side: f32, on_screw: bool) -> (&Branch, Weights) {
        if on_screw {
            let weights = Weights {
                both: side,
                screw: 0.0,
                nut: side,
            };
            (&self.third_on_screw, weights)
        } else {
            let weights = Weights {
                both: -side,
                screw: side,
                nut: 0.0,
            };
            (&self.third_on_nut, weights)
        }
    }
}

/// Size of the angular velocity of a ball in two contacts relative to its orbit, over that of a ball that rolls on its equator.
const fn tumbling(design: &BallScrew, ratio: f32, sticks_to_screw: bool) -> f32 {
    let angle = design.contact_angle();
    let (sin, cos) = (angle.sin, angle.cos);
    let radius = design.ball_radius();
    let path = design.path_radius();
    let chord = 1.0 - (radius / path) * (radius / path);
    let cosine = if sticks_to_screw {
        cos - ratio
    } else {
        cos + ratio
    };
    constant::sqrt(sin * sin * chord + cosine * cosine)
}

/// Series of `1/(1 + x) - 1` with `x = (tan beta sin u - (1 - cos u))/2`, from the power of one on.
const fn turn_series(tangent: f32) -> [f32; 5] {
    let x1 = 0.5 * tangent;
    let x2 = -0.25;
    let x3 = -tangent / 12.0;
    let x4 = 1.0 / 48.0;
    let x5 = tangent / 240.0;
    let c1 = -x1;
    let c2 = -(x1 * c1 + x2);
    let c3 = -(x1 * c2 + x2 * c1 + x3);
    let c4 = -(x1 * c3 + x2 * c2 + x3 * c1 + x4);
    let c5 = -(x1 * c4 + x2 * c3 + x3 * c2 + x4 * c1 + x5);
    [c1, c2, c3, c4, c5]
}

/// Largest deviation of a contact angle: 0.2 rad, less where the deviations of both grooves together would turn a contact through the plane
/// across the axis, or where the series in `tan(beta) u/2` would need more terms.
pub(crate) const fn largest_deviation(contact_angle: f32, tangent: f32) -> f32 {
    let both = if contact_angle * tangent < 1.0 {
        contact_angle
    } else {
        1.0 / tangent
    };
    (0.5 * both).min(LARGEST_DEVIATION)
}
