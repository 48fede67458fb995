//! How a ball's speed follows its contact angles.

use crate::geometry::BallScrew;
use crate::math::constant;

/// Largest deviation of a contact angle from the nominal one, rad: four times the 2 to 3 degrees of Lin 2019. With it in both
/// grooves the series of a ball's speed in `u` is off by 5e-4 at a contact angle of 45 degrees; with 3 degrees in both, by 1e-7.
const LARGEST_DEVIATION: f32 = 0.2;

/// How the speed of a ball follows its contact angles: one formula for each set of contacts that may carry it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Speeds {
    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    pub(super) nominal: f32,
    /// Coefficients of the series of `2 cos beta/(cos beta + cos(beta - u)) - 1`, from that of `u` to that of `u^5`.
    pub(super) turn: [f32; 5],
    /// Largest deviation of a contact angle that counts, rad.
    pub(super) largest_deviation: f32,
    /// With the third contact on the screw, on the nut, and with two contacts.
    third_on_screw: Branch,
    third_on_nut: Branch,
    two_point: Branch,
}

/// How a ball's speed follows its contact angles, and how it rubs.
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
    /// Of the screw's, in `v`, which tilts the ball's contact with the groove that has no third contact.
    pub(super) screw: f32,
    /// Of the nut's, in `v`.
    pub(super) nut: f32,
}

impl Speeds {
    /// Speeds of a design's balls; one in two contacts sticks to the screw, or else to the nut.
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

    /// The same with the third contact on the screw or on the nut.
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

/// Size of the angular velocity of a ball in two contacts relative to its orbit, over that of a ball that rolls on its
/// equator: the speed with which balls alike rub, over the orbital speed against the groove to which they stick.
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

/// Largest deviation of a contact angle: 0.2 rad, less where the deviations of both grooves together
/// would turn a contact through the plane across the axis, or where the series in them, which converges
/// like the powers of `tan(beta) u/2`, would need more terms.
pub(crate) const fn largest_deviation(contact_angle: f32, tangent: f32) -> f32 {
    let both = if contact_angle * tangent < 1.0 {
        contact_angle
    } else {
        1.0 / tangent
    };
    if 0.5 * both < LARGEST_DEVIATION {
        0.5 * both
    } else {
        LARGEST_DEVIATION
    }
}
