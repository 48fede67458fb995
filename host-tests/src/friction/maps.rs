//! Friction of one Hertzian contact that slips along its minor axis and spins: the maps of Lin 2019, eqs. (3.16) to (3.18).

use std::num::NonZeroUsize;
use std::sync::OnceLock;

use ellip::{elliprd, elliprf, elliprg};
use gauss_quad::GaussLegendre;

use crate::error::{ReferenceError, within};

/// Nodes of the fixed rule. The integrand has a branch point at a distance of about the axis ratio
/// from the end of the interval, so that 160 nodes give full precision down to an axis ratio of 0.02.
const NODES: usize = 160;

pub(crate) fn gauss_rule() -> &'static [(f64, f64)] {
    static RULE: OnceLock<GaussLegendre> = OnceLock::new();
    RULE.get_or_init(|| GaussLegendre::new(NonZeroUsize::new(NODES).unwrap_or(NonZeroUsize::MIN)))
        .as_node_weight_pairs()
}

/// The rule of 32 nodes by which some stored cases were made.
pub(crate) fn coarse_rule() -> &'static [(f64, f64)] {
    static RULE: OnceLock<GaussLegendre> = OnceLock::new();
    RULE.get_or_init(|| GaussLegendre::new(NonZeroUsize::new(32).unwrap_or(NonZeroUsize::MIN)))
        .as_node_weight_pairs()
}

/// Friction force, moment and power of an elliptical Hertzian contact, normalised, as functions of the offset `c/a` of the velocity centre
/// on the major axis.
///
/// With `kappa` = offset = `V/(w a)` (slip `V` along the minor axis at the contact centre, relative spin `w`, semi-major axis `a`), `k` =
/// axis ratio `b/a`, `e^2 = 1 - k^2`:
///
/// `P/(mu F a |w|) = Ph(kappa) = 3/8 int_0^psim sqrt(1 - e^2 s^2) (1 - kappa^2 s^2) (1 + kappa^2 (4 - 5 s^2)) dpsi`,
/// `s = sin psi`, `sin psim = min(1, 1/|kappa|)`
///
/// and `force = Ph'`, `moment = Ph - kappa Ph'`: the double integrals (3.16) to (3.18), exactly, by polar coordinates about the velocity
/// centre. For `|kappa| <= 1` the integral is the quartic `p0 + p2 kappa^2 + p4 kappa^4` with elliptic integrals as coefficients; outside
/// it is evaluated by a fixed Gauss rule, less the part that cancels at large offset.
///
/// Source: Lin 2019, eqs. (3.15) to (3.18). Corrected: the polar form printed in (3.16) and (3.17) lacks the square root of `1 - r^2`, and
/// the area element of (3.17) lacks the factor `r`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionMap {
    axis_ratio: f64,
    parameter: f64,
    p0: f64,
    p2: f64,
    p4: f64,
}

/// Values of the maps at one offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapValue {
    /// Force along the minor axis over `mu F`, with the sign of the offset; 0 at pure spin, 1 at pure sliding.
    pub force: f64,
    /// Moment about the contact centre over `mu F a`.
    pub moment: f64,
    /// Power over `mu F a |w|`; grows as the offset.
    pub power: f64,
    /// Derivative of the force by the offset; never negative, which makes the potential convex.
    pub slope: f64,
}

impl FrictionMap {
    /// Smallest axis ratio `b/a` accepted.
    pub const MIN_AXIS_RATIO: f64 = 0.02;

    /// Prepares the maps of a contact with `axis_ratio = b/a` in 0.02 to 1.
    pub fn new(axis_ratio: f64) -> Result<Self, ReferenceError> {
        let k = within("axis_ratio", axis_ratio, Self::MIN_AXIS_RATIO, 1.0)?;
        let m = (1.0 - k) * (1.0 + k);
        // Carlson's forms: complete_d = (K - E)/m and complete_b = (E - (1 - m) K)/m do not cancel for a circle.
        let kc2 = k * k;
        let out_of_range = |_| ReferenceError::OutOfRange {
            field: "axis_ratio",
            value: axis_ratio,
            min: Self::MIN_AXIS_RATIO,
            max: 1.0,
        };
        let complete_k = elliprf(0.0, kc2, 1.0).map_err(out_of_range)?;
        let complete_e = 2.0 * elliprg(0.0, kc2, 1.0).map_err(out_of_range)?;
        let complete_d = elliprd(0.0, kc2, 1.0).map_err(out_of_range)? / 3.0;
        let complete_b = complete_k - complete_d;
        let k3 = if m > 0.1 {
            (complete_k - 2.0 * complete_d + m * complete_d) / (2.0 * m)
        } else {
            // The closed form loses digits like 1/m; the defining integral is smooth here.
            1.5 * quarter(1.0, |s2, _| (1.0 - m * s2).sqrt() * s2 * (4.0 - 5.0 * s2))
        };
        Ok(Self {
            axis_ratio: k,
            parameter: m,
            p0: 0.375 * complete_e,
            p2: 0.75 * complete_b,
            p4: -0.25 * k3,
        })
    }

    /// Axis ratio `b/a`.
    pub const fn axis_ratio(&self) -> f64 {
        self.axis_ratio
    }

    /// Coefficients `p0, p2, p4` of the power inside the contact, `p0 + p2 x^2 + p4 x^4` for `|x| <= 1`.
    ///
    /// `p0 = 3/8 E` is the moment of pure spin, eq. (3.32).
    pub const fn coefficients(&self) -> [f64; 3] {
        [self.p0, self.p2, self.p4]
    }

    /// Slope `kf` of the force at pure spin, eq. (3.35): `(3/2) (E - k^2 K)/e^2`.
    ///
    /// The dissertation reads 1.38 off a plot, which is the least-squares slope over the inner half; the exact
    /// slope at conformity 0.56 is 1.4419.
    pub const fn initial_slope(&self) -> f64 {
        2.0 * self.p2
    }

    /// Evaluates the maps at `offset = c/a`, any real number; at infinity the force is 1, the moment 0 and the power
    /// infinite. A NaN gives NaN.
    pub fn at(&self, offset: f64) -> MapValue {
        let x = offset.abs();
        let sign = if offset < 0.0 { -1.0 } else { 1.0 };
        if x <= 1.0 {
            let x2 = x * x;
            return MapValue {
                force: sign * x * (2.0 * self.p2 + 4.0 * self.p4 * x2),
                moment: self.p0 - x2 * (self.p2 + 3.0 * self.p4 * x2),
                power: self.p0 + x2 * (self.p2 + self.p4 * x2),
                slope: 2.0 * self.p2 + 12.0 * self.p4 * x2,
            };
        }
        if x > 1e9 {
            // Force and moment differ from pure sliding by less than k^2/10 times 1e-18.
            let moment = 0.2 * self.axis_ratio * self.axis_ratio / x;
            return MapValue {
                force: sign,
                moment,
                power: x,
                slope: moment / (x * x),
            };
        }
        let m = self.parameter;
        let inverse = 1.0 / x;
        let inverse2 = inverse * inverse;
        // sqrt(1 - m s^2) - cos psi, as a quotient that does not cancel. With cos psi alone in its
        // place the integrals are those of pure sliding, known exactly: force 1, moment 0.
        let kc2 = self.axis_ratio * self.axis_ratio;
        let excess = |s2: f64| kc2 * s2 / ((1.0 - m * s2).sqrt() + (1.0 - s2).max(0.0).sqrt());
        let x2 = x * x;
        let mut force = 0.0;
        let mut moment = 0.0;
        let mut moment_slope = 0.0;
        integrate_quarter(inverse, |s2, weight| {
            let u2 = (s2 * x2).min(1.0);
            let d = weight * excess(s2);
            force += d * x * (4.0 - 8.0 * u2 - u2 * (6.0 - 10.0 * u2) * inverse2);
            moment += d * (1.0 - 4.0 * x2 + u2 * (6.0 + 12.0 * x2 - 15.0 * u2));
            moment_slope += d * x * (-8.0 + u2 * (48.0 + 12.0 * inverse2 - 60.0 * u2 * inverse2));
        });
        let force = 1.0 + 0.75 * force;
        let moment = 0.375 * moment;
        let edge = 8.0 * excess(inverse2) * ((x - 1.0) * (x + 1.0)).sqrt() * inverse;
        let moment_slope = 0.375 * (moment_slope - edge);
        MapValue {
            force: sign * force,
            moment,
            power: moment + x * force,
            slope: -moment_slope * inverse,
        }
    }
}

/// Gauss sum of `f(sin^2 psi, .)` over psi from 0 to `asin(end)`.
fn quarter(end: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    integrate_quarter(end, |s2, weight| sum += weight * f(s2, weight));
    sum
}

fn integrate_quarter(end: f64, mut visit: impl FnMut(f64, f64)) {
    let half = 0.5 * end.asin();
    for &(node, weight) in gauss_rule() {
        let s = (half * (1.0 + node)).sin();
        visit(s * s, half * weight);
    }
}
