//! Friction of one Hertzian contact with slip in both directions and spin (Lin 2019, eqs. (3.65) to (3.69)).

use std::sync::OnceLock;

use super::maps::{coarse_rule, gauss_rule};

/// One loaded contact ellipse with Coulomb friction.
///
/// Coordinates in the contact plane: 1 along the major axis, 2 along the minor axis, the normal completing a right-handed system. Velocity
/// of the ball against the groove at the point `(x, y)`: `(slip_1 - spin y, slip_2 + spin x)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Semi-major axis, m.
    pub semi_major: f64,
    /// Semi-minor axis, m; not larger than the semi-major axis, and positive.
    pub semi_minor: f64,
    /// Friction coefficient times normal load, N.
    pub friction_limit: f64,
}

/// How the contact integrals are evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integration {
    /// 160 nodes: full precision down to an axis ratio of 0.02.
    #[default]
    Full,
    /// 32 nodes, to compare with cases that were stored with as many: friction is off by 1e-5 of its limit at an axis ratio of 0.17, where
    /// the integrand peaks.
    Coarse,
}

/// Velocity of the ball against the groove at a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PatchVelocity {
    /// Slip at the contact centre along the major axis, m/s.
    pub slip_major: f64,
    /// Slip at the contact centre along the minor axis, m/s.
    pub slip_minor: f64,
    /// Relative spin about the normal, rad/s.
    pub spin: f64,
}

impl PatchVelocity {
    /// As a column `(slip_major, slip_minor, spin)`.
    pub const fn to_array(self) -> [f64; 3] {
        [self.slip_major, self.slip_minor, self.spin]
    }
}

/// Power lost in a contact with its first and second derivatives by `(slip_major, slip_minor, spin)`.
///
/// Minus the gradient is friction force and moment on the ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PatchFriction {
    /// Power lost, W.
    pub power: f64,
    /// Gradient of the power: N, N, N m.
    pub gradient: [f64; 3],
    /// Hessian of the power; positive semi-definite, and zero along the velocity itself (degree one).
    pub hessian: [[f64; 3]; 3],
}

/// Beyond this scaled distance of the velocity centre the contact is taken at this distance: force and moment differ
/// from their limits by less than one part in 1e12.
const FARTHEST: f64 = 1e12;

/// Nodes that are evaluated at once, so that the compiler uses the lanes of the processor.
const LANES: usize = 4;

type Nodes = [[f64; LANES]; 3];

/// Nodes beyond the last have no weight.
fn nodes(integration: Integration) -> &'static [Nodes] {
    static FULL: OnceLock<Vec<Nodes>> = OnceLock::new();
    static COARSE: OnceLock<Vec<Nodes>> = OnceLock::new();
    let of = |rule: &[(f64, f64)]| {
        let lanes = |nodes: &[(f64, f64)]| {
            let mut lanes = [[0.0; LANES], [1.0; LANES], [0.0; LANES]];
            for (lane, &(node, of_node)) in nodes.iter().enumerate() {
                let (sin, cos) = (std::f64::consts::FRAC_PI_2 * node).sin_cos();
                for (row, value) in lanes.iter_mut().zip([sin, cos, of_node]) {
                    row[lane] = value;
                }
            }
            lanes
        };
        rule.chunks(LANES).map(lanes).collect()
    };
    match integration {
        Integration::Full => FULL.get_or_init(|| of(gauss_rule())),
        Integration::Coarse => COARSE.get_or_init(|| of(coarse_rule())),
    }
}

const TERMS: usize = 13;

/// What the terms of a node depend on beside the node: axes, and the velocity centre in the plane scaled to the unit disc.
struct Centre {
    semi_major: f64,
    semi_minor: f64,
    distance: f64,
    cos: f64,
    sin: f64,
    /// The distance and its inverse, each at most one.
    reach: f64,
    inverse: f64,
}

impl Centre {
    #[inline(always)]
    fn terms(&self, [sin_t, cos_t, weight]: [f64; 3]) -> [f64; TERMS] {
        let (a, b) = (self.semi_major, self.semi_minor);
        let s = self.reach * sin_t;
        let h2 = 1.0 - s * s;
        // Angle between the line and the direction to the contact centre: sin = s/e.
        let sin_a = self.inverse * sin_t;
        let outside = ((1.0 - sin_a) * (1.0 + sin_a)).sqrt();
        let cos_a = if self.distance > 1.0 { outside } else { cos_t };
        let k = self.distance * cos_a;
        // Step of the line's angle, d theta = min(e, 1) cos t / k dt.
        let turn = weight * self.inverse * cos_t / cos_a;
        let along = (
            -(self.cos * cos_a - self.sin * sin_a),
            -(self.sin * cos_a + self.cos * sin_a),
        );
        let (u1, u2) = (a * along.0, b * along.1);
        // Axes of a contact are far from where squares overflow or vanish.
        let g = (u1 * u1 + u2 * u2).sqrt();
        let normal = -s * a * b;
        let scale = turn * h2 / (g * g * g);
        let [s1, s2, s3] = [u1, u2, normal].map(|part| scale * part);
        [
            turn * h2 * (k * k + 0.25 * h2) * g,
            -(turn * h2 * k * u2 / g),
            turn * h2 * k * u1 / g,
            // Moment about the contact centre: of the resultant at the middle of the chord, and of its spread.
            turn * h2 * (0.25 * h2 * g - k * s * (a - b) * (a + b) * along.0 * along.1 / g),
            s1 * u1,
            s1 * u2,
            s1 * normal,
            s2 * u1,
            s2 * u2,
            s2 * normal,
            s3 * u1,
            s3 * u2,
            s3 * normal,
        ]
    }

    fn summed(&self, nodes: &[Nodes]) -> [f64; TERMS] {
        let mut sums = [0.0; TERMS];
        for [sin, cos, weight] in nodes {
            let mut terms = [[0.0; LANES]; TERMS];
            for (lane, ((&sin, &cos), &weight)) in sin.iter().zip(cos).zip(weight).enumerate() {
                for (row, term) in terms.iter_mut().zip(self.terms([sin, cos, weight])) {
                    row[lane] = term;
                }
            }
            for (sum, row) in sums.iter_mut().zip(&terms) {
                for term in row {
                    *sum += term;
                }
            }
        }
        sums
    }
}

impl Patch {
    /// Power, force and moment by the exact reduction of the area integrals to one integral.
    ///
    /// In the plane scaled to the unit disc let the velocity centre lie at distance `e` from the contact centre. Along a straight line
    /// through it, at distance `s` from the contact centre, the direction of slip is constant and the pressure is a half-ellipse: that
    /// integral is elementary. There remains, with `h^2 = 1 - s^2`, `k^2 = e^2 - s^2`, `s = min(e, 1) sin t` and `g` the length of the
    /// physical image of the line's unit direction,
    ///
    /// `P = |w| (3 mu N/4) int h^2 (k^2 + h^2/4) g (min(e, 1) cos t/k) dt`, t from -pi/2 to pi/2,
    ///
    /// and likewise force, moment and all second derivatives. One smooth integrand serves a centre inside and outside the ellipse. A
    /// contact at rest gives zero power, force, moment and Hessian.
    ///
    /// Source: Lin 2019, eqs. (3.15) to (3.18) and (3.68); the reduction is not in the text.
    pub fn friction(&self, velocity: PatchVelocity) -> PatchFriction {
        self.friction_by(velocity, Integration::Full)
    }

    /// [`Self::friction`] with a given number of nodes.
    pub fn friction_by(&self, velocity: PatchVelocity, integration: Integration) -> PatchFriction {
        let (a, b) = (self.semi_major, self.semi_minor);
        let [v1, v2, spin] = velocity.to_array();
        let far = (v2 / a).hypot(v1 / b);
        if far == 0.0 && spin == 0.0 {
            return PatchFriction::default();
        }
        let w = spin.abs().max(far / FARTHEST);
        let sign = if spin < 0.0 { -1.0 } else { 1.0 };
        // Velocity centre, where slip - spin y = 0 and slip + spin x = 0, scaled to the unit disc.
        let (centre_1, centre_2) = (-sign * v2 / (w * a), sign * v1 / (w * b));
        let e = centre_1.hypot(centre_2);
        let (cos_p, sin_p) = if e > 0.0 {
            (centre_1 / e, centre_2 / e)
        } else {
            (1.0, 0.0)
        };
        let centre = Centre {
            semi_major: a,
            semi_minor: b,
            distance: e,
            cos: cos_p,
            sin: sin_p,
            reach: e.min(1.0),
            inverse: if e > 1.0 { 1.0 / e } else { 1.0 },
        };
        let [power, g0, g1, g2, hessian @ ..] = centre.summed(nodes(integration));
        let limit = 0.75 * std::f64::consts::FRAC_PI_2 * self.friction_limit;
        PatchFriction {
            power: limit * w * power,
            gradient: [g0, g1, g2].map(|x| sign * limit * x),
            hessian: std::array::from_fn(|row| {
                std::array::from_fn(|column| limit * hessian[3 * row + column] / w)
            }),
        }
    }
}
