//! The equations (5) to (9) in scaled unknowns, and their solution by Newton's method.

use nalgebra::{SMatrix, SVector};

use super::ball::BallScrewState;
use crate::error::ReferenceError;

/// Unknowns: `qA`, `D = (qA - qB)/eps`, `p = qA'/eps`, `psiB`, `X = (psiA - psiB - pi)/eps`,
/// `|V_A| / (r_b Omega)`, `s = eps spin / Omega`; loads over `F0 = Fa / (Ca Sb)`.
type Unknowns = SVector<f64, 7>;

/// The steady state where it exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyState {
    /// Efficiency of driving.
    pub efficiency: f64,
    /// Torque on the screw for this ball, N m.
    pub torque: f64,
    /// Normal load `Q_B` at the screw, N.
    pub normal_screw: f64,
    /// Normal load `Q_A` at the nut's main contact, N.
    pub normal_nut: f64,
    /// Normal load `Q_A'` at the nut's minor contact, N.
    pub normal_nut_minor: f64,
    /// Angular speed of the ball about the screw's axis over the screw's, `(theta' + Omega) / Omega`.
    pub orbital_ratio: f64,
    /// Angular velocity of the ball along tangent, normal and binormal, rad/s.
    pub ball_speed: [f64; 3],
    /// Slip angles `psi_A`, `psi_B`, rad.
    pub slip_angles: [f64; 2],
    /// Slip speeds at A and B, m/s.
    pub slip_speeds: [f64; 2],
    /// Largest residual of the scaled equations.
    pub residual: f64,
    /// Newton steps taken.
    pub steps: usize,
}

/// The scaled problem.
struct Scaled {
    sin_a: f64,
    cos_a: f64,
    sin_b: f64,
    cos_b: f64,
    friction: f64,
    /// `d / r_b = r_m / (Ca r_b)`.
    arm: f64,
    eps: f64,
    /// `m r_m f r_b / I = 2.5 f / a`.
    inertia: f64,
}

/// What follows from the unknowns: velocities over `r_b Omega`.
struct Motion {
    /// `omega_t / Omega`.
    tangential: f64,
    /// `(omega_b Cb - omega_n Sb) / Omega`.
    roll: f64,
    /// `(theta' + Omega) / Omega`.
    orbital: f64,
    /// Slip speed at B.
    slip_b: f64,
}

impl Scaled {
    fn motion(&self, y: &Unknowns) -> Motion {
        let turned = y[3] + self.eps * y[4];
        let slip_a = y[5];
        let tangential = -slip_a * turned.cos();
        let a_y = slip_a * turned.sin();
        let slip_b = (self.sin_a - tangential) / y[3].cos();
        let b_y = -slip_b * y[3].sin();
        let orbital = (a_y + b_y + self.arm - self.cos_a * self.cos_b) / (2.0 * self.arm);
        Motion {
            tangential,
            roll: a_y - self.arm * orbital,
            orbital,
            slip_b,
        }
    }

    /// Cosine and sine of the slip angle at the minor contact, eq. (6), times `eps` inside so that the large spin stays finite.
    fn minor_direction(&self, y: &Unknowns, motion: &Motion) -> (f64, f64) {
        let (s, c) = (self.sin_b, self.cos_b);
        let x = -self.eps * motion.tangential;
        let along = self.eps * (self.arm * motion.orbital + motion.roll * (c * c - s * s))
            + 2.0 * y[6] * s * c;
        let speed = x.hypot(along);
        (-x / speed, -along / speed)
    }

    fn residual(&self, y: &Unknowns) -> Unknowns {
        let Self {
            sin_a,
            cos_a,
            sin_b,
            cos_b,
            friction: f,
            eps,
            inertia,
            ..
        } = *self;
        let motion = self.motion(y);
        let (cos_m, sin_m) = self.minor_direction(y, &motion);
        let (qa, d, p, psi, x, s) = (y[0], y[1], y[2], y[3], y[4], y[6]);
        let qb = qa - eps * d;
        let w = motion.orbital;
        // psi_A = psi_B + pi + eps X; differences of sines and cosines over eps without cancellation.
        let half = 0.5 * eps * x;
        let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
        let (sin_mid, cos_mid) = (psi + half).sin_cos();
        let (sin_psi, cos_psi) = psi.sin_cos();
        let (sin_turned, cos_turned) = (psi + eps * x).sin_cos();
        let sin_rate = x * sinc * cos_mid;
        let cos_rate = -x * sinc * sin_mid;
        // (qA sin psiA + qB sin psiB)/eps and (qA cos psiA + qB cos psiB)/eps
        let sin_sum = -(qb * sin_rate + d * sin_turned);
        let cos_sum = -(qb * cos_rate + d * cos_turned);
        let spin_n = s * cos_b - eps * motion.roll * sin_b;

        Unknowns::from([
            // (5a), (5b), (5c), each over eps
            sin_sum + p * sin_m,
            cos_b * d - f * sin_b * cos_sum + p * (cos_b + f * sin_b * cos_m) - inertia * w * w,
            sin_b * d + f * cos_b * cos_sum - p * (sin_b - f * cos_b * cos_m),
            // (5d), (5f)
            qb * cos_psi + qa * cos_turned - eps * p * cos_m + w * cos_a * spin_n,
            -cos_b * (qb * sin_psi + qa * sin_turned - eps * p * sin_m) - w * sin_a * spin_n,
            // (5e) + tan(beta) (5f), over eps
            2.0 * sin_b * p * sin_m - w * (motion.tangential * cos_a - sin_a * motion.roll / cos_b),
            // (9), axial
            cos_a * sin_b * (qa - eps * p - 1.0)
                + f * (cos_a * cos_b * (-qa * cos_turned + eps * p * cos_m)
                    + sin_a * (-qa * sin_turned + eps * p * sin_m)),
        ])
    }

    fn start(&self) -> Unknowns {
        let Self {
            sin_a,
            cos_a,
            sin_b,
            cos_b,
            friction: f,
            ..
        } = *self;
        let tan = sin_a / cos_a;
        let root = cos_b.hypot(tan);
        let (s0, c0) = (tan / root, cos_b / root);
        let w = 0.5 * (1.0 - cos_a * root * root / (self.arm * cos_b));
        let grip = sin_b - f * root;
        let g = sin_b * (1.0 - s0) * root / (cos_b * grip);
        let qa = sin_b / grip;
        let p = self.inertia * w * w / (cos_b * (1.0 + s0) + g * (cos_b * c0 + f * sin_b));
        let d = p * (sin_b - f * root * s0) / grip;
        let x = (p - d * s0) / (qa * c0);
        let slip = (sin_a * self.arm * w / cos_b - 2.0 * sin_b * p / w)
            / (c0 * cos_a + sin_a * s0 / cos_b);
        let s = -2.0 * qa * c0 / (w * cos_a * cos_b);
        Unknowns::from([qa, d, p, s0.atan2(c0), x, slip, s])
    }

    /// Damped Newton's method with a central-difference Jacobian; at most 60 steps.
    fn solve(&self) -> Result<(Unknowns, f64, usize), ReferenceError> {
        const TOLERANCE: f64 = 1e-13;
        let mut y = self.start();
        let mut residual = self.residual(&y);
        let mut steps = 0;
        while steps < 60 {
            let size = residual.amax();
            if !size.is_finite() || size < TOLERANCE {
                break;
            }
            steps += 1;
            let mut jacobian = SMatrix::<f64, 7, 7>::zeros();
            for column in 0..7 {
                let width = 1e-6 * y[column].abs().max(1e-3);
                let (mut above, mut below) = (y, y);
                above[column] += width;
                below[column] -= width;
                let slope = (self.residual(&above) - self.residual(&below)) / (2.0 * width);
                jacobian.set_column(column, &slope);
            }
            let Some(step) = jacobian.lu().solve(&residual) else {
                break;
            };
            let shorter = std::iter::successors(Some(1.0_f64), |length| Some(0.5 * length))
                .take(20)
                .map(|length| y - length * step)
                .map(|trial| (trial, self.residual(&trial)))
                .find(|(_, trial)| trial.norm() < residual.norm());
            let Some(next) = shorter else { break };
            (y, residual) = next;
        }
        let size = residual.amax();
        // The terms are of order `p + qA`: their rounding is the floor.
        let floor = 1e-12 * (1.0 + y[2].abs() + y[1].abs() + y[0].abs());
        if size < floor.max(1e-10) {
            Ok((y, size, steps))
        } else {
            Err(ReferenceError::NotConverged {
                residual: size,
                unit: "of the scaled equations",
            })
        }
    }
}

impl BallScrewState {
    /// The steady state, or why there is none.
    pub fn solve(&self) -> Result<SteadyState, ReferenceError> {
        self.check()?;
        if self.friction == 0.0 {
            return Err(ReferenceError::Frictionless);
        }
        let (sin_a, cos_a) = self.lead_angle.sin_cos();
        let (sin_b, cos_b) = self.contact_angle.sin_cos();
        let f = self.friction;
        if f * cos_b.hypot(sin_a / cos_a) >= sin_b {
            return Err(ReferenceError::Locked);
        }
        let r_b = self.ball_radius;
        let mass = self.ball_mass();
        let moment_of_inertia = 0.4 * mass * r_b * r_b;
        let unit_load = self.axial_load / (cos_a * sin_b);
        let scaled = Scaled {
            sin_a,
            cos_a,
            sin_b,
            cos_b,
            friction: f,
            arm: self.pitch_radius / (cos_a * r_b),
            eps: moment_of_inertia * self.speed * self.speed / (f * r_b * unit_load),
            inertia: mass * self.pitch_radius * f * r_b / moment_of_inertia,
        };
        if scaled.start()[5] <= 0.0 {
            return Err(ReferenceError::NoSlip);
        }
        let (y, residual, steps) = scaled.solve()?;
        let motion = scaled.motion(&y);
        if y[5] <= 0.0 || motion.slip_b <= 0.0 || y[2] < 0.0 {
            return Err(ReferenceError::NoSlip);
        }

        let q_b = (y[0] - scaled.eps * y[1]) * unit_load;
        let ball_ratio = r_b / self.pitch_radius;
        let (sin_psi, cos_psi) = y[3].sin_cos();
        let torque = self.pitch_radius
            * q_b
            * (sin_a * sin_b
                + f * (sin_a * cos_psi * (ball_ratio - cos_b)
                    + cos_a * sin_psi * (1.0 - ball_ratio * cos_b)));
        let spin = y[6] / scaled.eps;
        let omega = self.speed;
        Ok(SteadyState {
            efficiency: self.axial_load * self.pitch_radius * sin_a / (cos_a * torque),
            torque,
            normal_screw: q_b,
            normal_nut: y[0] * unit_load,
            normal_nut_minor: scaled.eps * y[2] * unit_load,
            orbital_ratio: motion.orbital,
            ball_speed: [
                motion.tangential * omega,
                (spin * cos_b - motion.roll * sin_b) * omega,
                (spin * sin_b + motion.roll * cos_b) * omega,
            ],
            slip_angles: [y[3] + std::f64::consts::PI + scaled.eps * y[4], y[3]],
            slip_speeds: [y[5] * r_b * omega.abs(), motion.slip_b * r_b * omega.abs()],
            residual,
            steps,
        })
    }
}
