//! Mean slip by quadrature over the contact ellipse: times coefficient and load it is the power of friction.

use epas_reference::kinematics::Raceway;
use epas_reference::kinematics::Revised;
use gauss_quad::GaussLegendre;
use std::f64::consts::TAU;
use std::num::NonZeroUsize;

/// Means over an ellipse weighted by Hertz pressure, `sqrt(1 - x^2/b^2 - y^2/a^2)`.
///
/// With `x = b rho cos t`, `y = a rho sin t` and `rho = sqrt(1 - u^2)` the mean is `3 / (2 pi)` times the integral of `f u^2` over `u` from
/// 0 to 1 and `t` from 0 to `2 pi`: Gauss and Legendre's rule in `u`, the trapezoidal rule, exact for periodic functions, in `t`. Where `f`
/// has a kink inside the ellipse (slip that vanishes there) the error falls only as the cube of the spacing.
#[derive(Clone, Debug)]
pub struct HertzMean {
    /// `x / b`, `y / a`, weight; weights add up to one.
    nodes: Vec<[f64; 3]>,
}

impl HertzMean {
    /// A rule of `radial` times `angular` points (at least one each).
    pub fn new(radial: usize, angular: usize) -> Self {
        let radial = NonZeroUsize::new(radial).unwrap_or(NonZeroUsize::MIN);
        let angular = angular.max(1);
        let rule = GaussLegendre::new(radial);
        let mut nodes = Vec::with_capacity(radial.get() * angular);
        for (node, weight) in &rule {
            // From [-1, 1] to [0, 1].
            let u = 0.5 * (node + 1.0);
            let rho = (1.0 - u * u).sqrt();
            let weight = 0.5 * weight * 3.0 * u * u / angular as f64;
            for step in 0..angular {
                let (sine, cosine) = (TAU * (step as f64 + 0.5) / angular as f64).sin_cos();
                nodes.push([rho * cosine, rho * sine, weight]);
            }
        }
        Self { nodes }
    }

    /// Mean of `f(x, y)` over the ellipse with `|x| <= semi_minor`, `|y| <= semi_major`.
    pub fn mean<const N: usize>(
        &self,
        semi_major: f64,
        semi_minor: f64,
        f: impl Fn(f64, f64) -> [f64; N],
    ) -> [f64; N] {
        let mut sum = [0.0; N];
        for [x, y, weight] in &self.nodes {
            let values = f(semi_minor * x, semi_major * y);
            for (total, value) in sum.iter_mut().zip(values) {
                *total += weight * value;
            }
        }
        sum
    }
}

/// Mean sliding speed of a contact, m/s, and its shares `<v_part . v / |v|>`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanSlip {
    /// `<|v|>`.
    pub total: f64,
    /// Share of rolling slip.
    pub rolling: f64,
    /// Share of side slip.
    pub side: f64,
    /// Share of spin.
    pub spin: f64,
}

impl MeanSlip {
    /// Mean over an ellipse of a field given as rolling slip, side slip (both functions of `y`) and spin.
    pub fn of_field(
        rule: &HertzMean,
        semi_major: f64,
        semi_minor: f64,
        rolling: impl Fn(f64) -> f64,
        side: impl Fn(f64) -> f64,
        spin: f64,
    ) -> Self {
        let [total, rolling, side, spin] = rule.mean(semi_major, semi_minor, |x, y| {
            let (roll, side) = (rolling(y), side(y));
            let (spin_x, spin_y) = (-spin * y, spin * x);
            let (v_x, v_y) = (roll + spin_x, side + spin_y);
            let speed = v_x.hypot(v_y);
            if speed > 0.0 {
                [
                    speed,
                    roll * v_x / speed,
                    side * v_y / speed,
                    (spin_x * v_x + spin_y * v_y) / speed,
                ]
            } else {
                [0.0; 4]
            }
        });
        Self {
            total,
            rolling,
            side,
            spin,
        }
    }
}

/// Mean slip of one contact over its ellipse with the full field (30), `S_k(y)` of (14) included.
pub fn mean_slip(revised: &Revised, rule: &HertzMean, raceway: Raceway) -> MeanSlip {
    let input = revised.input();
    let contact = input.contact(raceway);
    let speed = input.speed;
    let (rolling, side) = (
        revised.rolling_gradient(raceway),
        revised.side_gradient(raceway),
    );
    MeanSlip::of_field(
        rule,
        contact.semi_major,
        contact.semi_minor,
        |y| speed * rolling * revised.inside_rolling_radius(raceway, y),
        |y| speed * side * revised.distance(raceway, y),
        speed * revised.spin(raceway),
    )
}
