//! Closed-form efficiency after Lin, Velinsky, Ravani 1994, as printed but for named corrections.

use std::f64::consts::FRAC_PI_4;

/// Geometry and friction of a ball screw; angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Lead angle `alpha`.
    pub lead_angle: f64,
    /// Contact angle `beta`.
    pub contact_angle: f64,
    /// Friction coefficient `f`.
    pub friction: f64,
    /// Ball radius over pitch radius, `a`.
    pub ball_ratio: f64,
    /// Tangent of the rolling friction angle, eq. (2).
    pub rolling_tangent: f64,
}

/// Tangent of the rolling friction angle, eq. (2): `f_r / (r_b Sb)`, `f_r` a length.
pub fn rolling_tangent(rolling_lever: f64, ball_radius: f64, contact_angle: f64) -> f64 {
    rolling_lever / (ball_radius * contact_angle.sin())
}

impl Screw {
    /// `R = sqrt(Cb² + ta²)`.
    pub fn root(&self) -> f64 {
        self.contact_angle.cos().hypot(self.lead_angle.tan())
    }

    /// Eq. (3), times `ta` above and below so that it exists without lead where rolling resists.
    pub fn rolling_screw(&self) -> f64 {
        self.rolling(self.ball_ratio, self.ball_ratio - self.contact_angle.cos())
    }

    /// Eq. (4) as printed. It breaks the energy balance; the right one is eq. (3).
    pub fn rolling_nut(&self) -> f64 {
        let cos = self.contact_angle.cos();
        self.rolling(self.ball_ratio + 2.0 * cos, self.ball_ratio + cos)
    }

    fn rolling(&self, slide: f64, grip: f64) -> f64 {
        let Self {
            friction,
            rolling_tangent,
            ..
        } = *self;
        let sin = self.contact_angle.sin();
        let tan = self.lead_angle.tan();
        if rolling_tangent == 0.0 {
            return 1.0 - friction * slide / (sin + friction * grip);
        }
        let secant = self.lead_angle.cos().powi(-2);
        1.0 - (friction * slide * tan + rolling_tangent * secant)
            / (tan * (sin + friction * grip) + rolling_tangent)
    }

    /// Eq. (11), efficiency over the slip angle at the screw contact, with the numerator's sign
    /// corrected: `Sb + f (Cb cos(psiA) + ta sin(psiA))` where psiA is psiB plus pi.
    pub fn at_slip_angle(&self, slip_angle: f64) -> f64 {
        let (sin_b, cos_b) = self.contact_angle.sin_cos();
        let (sin_psi, cos_psi) = slip_angle.sin_cos();
        let tan = self.lead_angle.tan();
        let (f, a) = (self.friction, self.ball_ratio);
        (sin_b - f * (cos_b * cos_psi + tan * sin_psi))
            / (sin_b + f * (cos_psi * (a - cos_b) + sin_psi * (1.0 - a * cos_b) / tan))
    }

    /// Slip angle of full sliding, eq. (13).
    pub fn slip_angle(&self) -> f64 {
        self.lead_angle.tan().atan2(self.contact_angle.cos())
    }

    /// One less the efficiency of driving, eq. (14).
    pub fn loss_drive(&self) -> f64 {
        let sin = self.contact_angle.sin();
        self.friction / (self.lead_angle.cos().powi(2) * sin * (self.root() + self.friction * sin))
    }

    /// Efficiency of driving in full sliding, eq. (14), as that of a plain sliding screw with the lead angle `zeta`:
    /// `tan(zeta) / tan(zeta + phi)` with `tan(zeta) = R / Sb`, `tan(phi) = f`.
    pub fn sliding_drive(&self) -> f64 {
        let x = self.contact_angle.sin() / self.root();
        (x - self.friction) / (x * (1.0 + self.friction * x))
    }

    /// Efficiency of back-driving in full sliding, eq. (17): `tan(zeta - phi) / tan(zeta)`.
    pub fn sliding_backdrive(&self) -> f64 {
        let x = self.contact_angle.sin() / self.root();
        x * (1.0 - self.friction * x) / (x + self.friction)
    }

    /// One less the efficiency of back-driving, eq. (17).
    pub fn loss_backdrive(&self) -> f64 {
        let root = self.root();
        self.friction
            / (self.lead_angle.cos().powi(2)
                * (self.contact_angle.sin() * root + self.friction * root * root))
    }

    /// Self-braking of driving, eq. (16).
    pub fn locked_drive(&self) -> bool {
        self.contact_angle.sin() <= self.friction * self.root()
    }

    /// Self-braking of back-driving, eq. (19).
    pub fn locked_backdrive(&self) -> bool {
        self.friction * self.contact_angle.sin() >= self.root()
    }

    /// Efficiency of rolling where the load back-drives, from the work of the slipping contact: input
    /// `Q Ca (Sb + f Cb)`, loss `f Q r_b Sa` per ball (rolling resistance left out).
    pub fn rolling_backdrive(&self) -> f64 {
        let (sin, cos) = self.contact_angle.sin_cos();
        let input = sin + self.friction * cos;
        (input - self.friction * self.ball_ratio) / input
    }
}

/// Optimum contact angle of driving, from eq. (15): `Ca Sb = sin(pi/4 + phi/2)`; `None` beyond its range `alpha <= pi/4 - phi/2`.
pub fn optimum_drive(lead_angle: f64, friction: f64) -> Option<f64> {
    let sin = (FRAC_PI_4 + 0.5 * friction.atan()).sin() / lead_angle.cos();
    (sin <= 1.0).then(|| sin.asin())
}

/// Optimum contact angle of back-driving, from eq. (18) with its lost `R` restored:
/// `Ca Sb = sin(pi/4 - phi/2)`; `None` beyond its range `alpha <= pi/4 + phi/2`.
pub fn optimum_backdrive(lead_angle: f64, friction: f64) -> Option<f64> {
    let sin = (FRAC_PI_4 - 0.5 * friction.atan()).sin() / lead_angle.cos();
    (sin <= 1.0).then(|| sin.asin())
}

/// Highest efficiency of full sliding, for either direction: 86.1 % at a friction of 0.075.
pub fn optimum_efficiency(friction: f64) -> f64 {
    ((1.0 + friction * friction).sqrt() - friction).powi(2)
}

/// Least contact angle that does not lock driving, from eq. (16): `Sb = sin(phi) / Ca`.
pub fn locking_border_drive(lead_angle: f64, friction: f64) -> Option<f64> {
    let sin = friction.atan().sin() / lead_angle.cos();
    (sin <= 1.0).then(|| sin.asin())
}

/// Largest contact angle that does not lock back-driving, from eq. (19): `Sb = cos(phi) / Ca`; only below a lead angle of `phi`.
pub fn locking_border_backdrive(lead_angle: f64, friction: f64) -> Option<f64> {
    let sin = friction.atan().cos() / lead_angle.cos();
    (sin <= 1.0).then(|| sin.asin())
}

/// Normal load per axial load, friction neglected, eq. (20).
pub fn normal_per_axial_load(lead_angle: f64, contact_angle: f64) -> f64 {
    1.0 / (lead_angle.cos() * contact_angle.sin())
}

/// Normal load times pitch radius per torque, friction neglected, eq. (21).
pub fn normal_per_torque(lead_angle: f64, contact_angle: f64) -> f64 {
    1.0 / (lead_angle.sin() * contact_angle.sin())
}
