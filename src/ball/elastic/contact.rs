//! One contact of a ball: its load and its friction, and how both change with the ball's place and motion.

use super::grooves::ElasticGroove;
use crate::contact::SlipFriction;
use crate::math;

/// Spin below which a contact sticks, over the nut's speed.
pub(super) const STICK_SPIN: f32 = 0.03;

/// Least part of its secant that the stiffness of a contact against slip is taken as.
const LEAST_SECANT: f32 = 0.05;

/// Motion of a ball: speed along the track over ball radius and nut speed, and total angular velocity over nut speed
/// about the radial axis, the track and the axis across both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    pub(super) speed: f32,
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
}

/// A number for each part of a motion.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub(super) speed: f32,
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
}

/// Where a contact lies and what it carries.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    /// Direction from the ball's centre to the contact: radial and axial part.
    pub(super) nx: f32,
    pub(super) nz: f32,
    /// 1 / distance of the ball's centre from the arc's.
    pub(super) per_distance: f32,
    /// Cube root of the load, `N^(1/3)`.
    pub(super) root: f32,
    /// Load, N.
    pub(super) load: f32,
    /// Change of the load with the approach, N.
    pub(super) stiffness: f32,
}

impl Touch {
    /// The contact of a ball whose centre lies at `(x, z)` from the groove's middle with an arc whose centre lies at
    /// `(mx, mz)`, both over the ball radius; none where a gap is left.
    #[inline(always)]
    pub(super) fn at(
        groove: &ElasticGroove,
        (x, z): (f32, f32),
        (mx, mz): (f32, f32),
        clearance: f32,
    ) -> Option<Self> {
        let (ex, ez) = (x - mx, z - mz);
        let square = ex * ex + ez * ez;
        let distance = math::sqrt(square);
        let sum = distance + groove.centre;
        // One division for both reciprocals.
        let both = 1.0 / (distance * sum);
        let per_distance = sum * both;
        // distance - centre, without cancellation.
        let approach = (x * (x - 2.0 * mx) + z * (z - 2.0 * mz)) * (distance * both) - clearance;
        // False for NaN.
        if approach > 0.0 {
            let scaled = approach * groove.stiffness;
            let root = math::sqrt(scaled);
            Some(Self {
                nx: ex * per_distance,
                nz: ez * per_distance,
                per_distance,
                root,
                load: root * scaled,
                stiffness: 1.5 * root * groove.stiffness,
            })
        } else {
            None
        }
    }
}

/// A contact that slips, over its friction limit `mu N`.
pub(super) struct Slipping {
    /// Force across and along the track, moment about the normal.
    pub(super) across: f32,
    pub(super) along: f32,
    /// Derivatives of the power by the parts of the motion.
    pub(super) gradient: Row,
    /// Derivative of the gradient by the logarithm of the ellipse's size.
    pub(super) growth: Row,
    /// Derivative of `across` by that logarithm.
    pub(super) across_growth: f32,
    /// Derivative of the gradient by the angle of the normal.
    pub(super) turn: Row,
    /// Derivatives of the forces across and along by the parts of the motion.
    pub(super) by_across: Row,
    pub(super) by_along: Row,
    /// Rows of the slip across and along, at a place of the velocity centre that stays: their parts about x and z.
    pub(super) tilt_across: (f32, f32),
    pub(super) tilt_along: (f32, f32),
    pub(super) stick: f32,
    pub(super) power: f32,
}

impl Slipping {
    /// Friction of a contact under a motion of the ball.
    #[inline(always)]
    pub(super) fn of(groove: &ElasticGroove, touch: &Touch, motion: &Motion) -> Self {
        let [base_y, base_z, base_speed] = groove.base;
        let Touch { nx, nz, root, .. } = *touch;
        let (rx, rz) = (motion.x, motion.z - base_z);
        let across = motion.y - base_y;
        let cross = rx * nz - rz * nx;
        let along = (motion.speed - base_speed) - cross;
        let spin = rx * nx + rz * nz;
        let friction =
            groove
                .map
                .dissipation(across, along, spin, groove.semi_major * root, STICK_SPIN);
        let SlipFriction {
            across: g1,
            along: g2,
            moment,
            stiffness_across: s11,
            stiffness_mixed: s12,
            stiffness_along: s22,
            tilt_across: t1,
            tilt_along: t2,
            stick,
            power,
            ..
        } = friction;
        let s11 = at_least(s11, g1, across);
        let s22 = at_least(s22, g2, along);
        // Slip rows with the velocity centre held: (0, -t1 nx, 1, -t1 nz) and (1, -nz - t2 nx, 0, nx - t2 nz).
        let (q1x, q1z) = (-t1 * nx, -t1 * nz);
        let (q2x, q2z) = (-nz - t2 * nx, nx - t2 * nz);
        let (h1, h2) = (s11 * across + s12 * along, s12 * across + s22 * along);
        // The normal turns by an angle: slip along changes by the spin, the spin by `cross`.
        let (e1, e2) = (-t1 * cross, spin - t2 * cross);
        let (f1, f2) = (s11 * e1 + s12 * e2, s12 * e1 + s22 * e2);
        let held = stick * cross + g2;
        Self {
            across: g1,
            along: g2,
            gradient: Row {
                speed: g2,
                x: moment * nx - g2 * nz,
                y: g1,
                z: moment * nz + g2 * nx,
            },
            growth: Row {
                speed: -h2,
                x: moment * nx - h1 * q1x - h2 * q2x,
                y: -h1,
                z: moment * nz - h1 * q1z - h2 * q2z,
            },
            across_growth: -h1,
            turn: Row {
                speed: f2,
                x: f1 * q1x + f2 * q2x + held * nx + moment * nz,
                y: f1,
                z: f1 * q1z + f2 * q2z + held * nz - moment * nx,
            },
            by_across: Row {
                speed: s12,
                x: s11 * q1x + s12 * q2x,
                y: s11,
                z: s11 * q1z + s12 * q2z,
            },
            by_along: Row {
                speed: s22,
                x: s12 * q1x + s22 * q2x,
                y: s12,
                z: s12 * q1z + s22 * q2z,
            },
            tilt_across: (q1x, q1z),
            tilt_along: (q2x, q2z),
            stick,
            power,
        }
    }
}

/// A stiffness, at least a part of the secant `force / slip`.
#[inline(always)]
fn at_least(stiffness: f32, force: f32, slip: f32) -> f32 {
    let (force, slip) = (LEAST_SECANT * force.abs(), slip.abs());
    if stiffness * slip < force {
        force / (slip + 1e-20)
    } else {
        stiffness
    }
}
