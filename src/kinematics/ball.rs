//! Contact kinematics of one ball: set-up, update, tick.

use super::coefficients::ContactCoefficients;
use super::path::{Direction, EllipticContact, KinematicsParameters, Path};
use crate::error::{Error, attempt};
use crate::geometry::Groove;
use crate::math::{self, constant};

/// Contact kinematics of one ball, ready for the control interrupt.
///
/// With `q = r_m / cos psi`, `A_k = q -+ r'_k cos psi cos alpha_k`,
/// `b_k = cos beta cos beta' cos alpha_k + sin beta sin alpha_k` (upper sign: screw) and `omega`
/// the speed of the screw,
/// `omega_m = omega G_i / (G_i + G_o)`, `omega_R = omega G_i G_o / (G_i + G_o)`,
/// `G_k = A_k / (r'_k b_k)`;
/// `rolling_slip = omega w_k (q / r'_k) (r'_k - S_k)`,
/// `side_slip = omega w_k S_k (sin psi -+ G_k cos beta sin beta')`,
/// `spin = omega w_k (cos psi sin alpha_k +- G_k n_k)`, with `w_i = -G_o / (G_i + G_o)`,
/// `w_o = -G_i / (G_i + G_o)`, `n_k = cos beta cos beta' sin alpha_k - sin beta cos alpha_k` and
/// `S_k` the distance from the ball's centre to the centre of the contact.
///
/// This is Alberdi et al., eqs. (22), (23), (31), (32), (34) and, for the entrainment speed, (36), rearranged: the printed (31) is the difference of two
/// nearly equal speeds; here the difference is `r'_k - S_k`, formed from `r'_k - D/2` and from `2 r - D`, both exact in f32.
/// **Corrected:** (23) as printed divides `omega_m` by the geometry of the *inner* contact; rolling needs `(omega - omega_m) A_i / (r'_i b_i)`, which
/// equals `omega_m A_o / (r'_o b_o)`. The printed form gives 185.9 in place of 252.0 rad/s for the paper's own screw.
///
/// Errors: see [`tick`](Self::tick) and [`ratios`](ContactCoefficients::ratios), over 200 000 random geometries: helix angle 0 to 40°, ball
/// diameter over pitch diameter 0.04 to 0.29, groove radius over ball diameter 0.505 to 0.58, contact angles 10 to 80°, pitch angle within 10° and yaw
/// within 6° of them and of 0, rolling radii within 1 % of the ball's, semi-major axis to 0.3 ball radii.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::kinematics::{ContactKinematics, EllipticContact, KinematicsParameters};
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let mut kinematics = ContactKinematics::new(&KinematicsParameters::of(&design, 100.0, 100.0)?)?;
/// let ball = kinematics.tick(104.72); // 1000 revolutions a minute
/// assert!((ball.orbital_speed / 104.72 - 0.43).abs() < 0.01);
/// // The load rose: new contact angles and ellipses.
/// let contact = EllipticContact { contact_angle: 0.8, semi_major: 0.65e-3, semi_minor: 0.09e-3 };
/// assert!(kinematics.update(contact, contact));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactKinematics {
    orbital_speed: f32,
    spin_speed: f32,
    screw: ContactCoefficients,
    nut: ContactCoefficients,
    path: Path,
}

impl ContactKinematics {
    /// Checks the parameters and forms all constants; for constants too.
    ///
    /// # Errors
    /// [`Error`] naming the first field of [`KinematicsParameters`] out of range: also a contact angle so far from the pitch angle that the ball's
    /// surface hardly moves at the contact (`b_k < 0.25`, about 75°), a contact ellipse larger than 0.3 of the ball's radius, and a rolling radius that
    /// folds the ball's path past the screw's axis.
    pub const fn new(parameters: &KinematicsParameters) -> Result<Self, Error> {
        let path = attempt!(Path::new(parameters));
        let (screw, nut) = attempt!(path.checked_directions(parameters));
        let mut kinematics = Self {
            orbital_speed: 0.0,
            spin_speed: 0.0,
            screw: ContactCoefficients::new(&path.screw),
            nut: ContactCoefficients::new(&path.nut),
            path,
        };
        let (screw, nut) = kinematics.fold(&screw, &nut);
        kinematics.screw.slip.entrainment_speed = constant::sqrt(screw);
        kinematics.nut.slip.entrainment_speed = constant::sqrt(nut);
        Ok(kinematics)
    }

    /// Takes new contact angles (rad) and ellipses (m), as load or temperature change them; false, and nothing changes, where
    /// [`new`](Self::new) would refuse one. Cost: about 450 cycles (modelled, Cortex-M4F).
    #[must_use]
    pub fn update(&mut self, screw: EllipticContact, nut: EllipticContact) -> bool {
        if !(self.path.accepts(screw) && self.path.accepts(nut)) {
            return false;
        }
        let screw = self.path.direction(&self.path.screw, screw, Groove::Screw);
        let nut = self.path.direction(&self.path.nut, nut, Groove::Nut);
        // At the nut `A_k` is never less than `q`.
        if !(screw.grips() && screw.reaches(&self.path.screw) && nut.grips()) {
            return false;
        }
        let (screw, nut) = self.fold(&screw, &nut);
        (
            self.screw.slip.entrainment_speed,
            self.nut.slip.entrainment_speed,
        ) = math::sqrt_pair(screw, nut);
        true
    }

    /// Motion, slip and entrainment speed at a screw speed (rad/s, either sign): Alberdi et al., eqs. (22), (23), (31), (32),
    /// (34), (36). A speed that is NaN or beyond 1e6 rad/s counts as 0.
    ///
    /// Errors over the domain of [`ContactKinematics`], largest (rms): orbital speed 3.9e-7 (8e-8), spin speed 4.8e-7 (1e-7), entrainment speed
    /// 5.0e-7 (1e-7), each of itself; rolling slip 2.2e-7 (4e-8), side slip 8.1e-8 (8e-9), spin on the ball's radius 2.7e-7 (5e-8), each of the
    /// entrainment speed. Cost: ten multiplications; as a call about 60 cycles (modelled, Cortex-M4F).
    #[inline]
    pub fn tick(&self, speed: f32) -> BallKinematics {
        self.per_speed().at_speed(speed)
    }

    /// Motion and slip per rad/s of the screw: the constants that [`tick`](Self::tick) multiplies.
    #[inline]
    pub const fn per_speed(&self) -> BallKinematics {
        BallKinematics {
            orbital_speed: self.orbital_speed,
            spin_speed: self.spin_speed,
            screw: self.screw.slip,
            nut: self.nut.slip,
        }
    }

    /// Contact with the screw (inner).
    pub const fn screw(&self) -> &ContactCoefficients {
        &self.screw
    }

    /// Contact with the nut (outer).
    pub const fn nut(&self) -> &ContactCoefficients {
        &self.nut
    }

    /// Forms all constants that depend on contact angles and ellipses, except the entrainment speeds: it returns their squares.
    #[inline]
    #[must_use]
    const fn fold(&mut self, screw: &Direction, nut: &Direction) -> (f32, f32) {
        // w and omega_R with one division: G_i / (G_i + G_o) = A_i b_o / (A_i b_o + A_o b_i).
        let screw_share = screw.reach * nut.grip;
        let nut_share = nut.reach * screw.grip;
        let inverse = 1.0 / (screw_share + nut_share);
        let orbital_speed = screw_share * inverse;
        let spin_speed = screw.reach * nut.reach * inverse;
        let (path, inner, outer) = (&self.path, Groove::Screw, Groove::Nut);
        let rotation = [
            spin_speed * path.axis_binormal,
            spin_speed * path.axis_tangent,
            spin_speed * path.axis_normal,
        ];
        let relative_speed = -(nut_share * inverse);
        let screw = self
            .screw
            .fold(path, &path.screw, screw, relative_speed, inner, rotation);
        let nut = self
            .nut
            .fold(path, &path.nut, nut, -orbital_speed, outer, rotation);
        self.orbital_speed = orbital_speed;
        self.spin_speed = spin_speed;
        (screw, nut)
    }
}

/// Slip of one contact at its centre; per unit of speed ([`per_speed`](super::ContactKinematics::per_speed)): m, m, 1, m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactSlip {
    /// Slip along the direction of rolling, m/s (Alberdi et al., eq. (31)).
    pub rolling_slip: f32,
    /// Slip across the direction of rolling, m/s (eq. (32), whose `omega_l` is `omega_t`).
    pub side_slip: f32,
    /// Angular velocity of the ball about the contact normal, relative to the raceway, rad/s (eq. (34)).
    pub spin: f32,
    /// Entrainment speed: mean speed of the two surfaces relative to the moving contact, m/s (size of the vector of eqs. (35), (36)).
    pub entrainment_speed: f32,
}

impl ContactSlip {
    #[inline]
    fn times(&self, speed: f32, magnitude: f32) -> Self {
        Self {
            rolling_slip: self.rolling_slip * speed,
            side_slip: self.side_slip * speed,
            spin: self.spin * speed,
            entrainment_speed: self.entrainment_speed * magnitude,
        }
    }
}

/// Motion of one ball and its slip at both contacts, or the same per rad/s of the screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallKinematics {
    /// Angular velocity of the ball's centre about the screw's axis (`omega_m`), rad/s (eq. (22)).
    pub orbital_speed: f32,
    /// Angular velocity of the ball relative to the frame that orbits with it (`omega_R`), rad/s (eq. (23),
    /// corrected as in [`ContactKinematics`](super::ContactKinematics)).
    pub spin_speed: f32,
    /// Contact with the screw.
    pub screw: ContactSlip,
    /// Contact with the nut.
    pub nut: ContactSlip,
}

impl BallKinematics {
    #[inline]
    pub(super) fn at_speed(&self, speed: f32) -> Self {
        let magnitude = speed.abs();
        // False for NaN. Only the branch for wrong speeds holds a call: the usual branch needs no stack frame.
        if magnitude <= SPEED_LIMIT {
            self.times(speed, magnitude)
        } else {
            Self::still(magnitude)
        }
    }

    #[inline]
    fn times(&self, speed: f32, magnitude: f32) -> Self {
        Self {
            orbital_speed: self.orbital_speed * speed,
            spin_speed: self.spin_speed * speed,
            screw: self.screw.times(speed, magnitude),
            nut: self.nut.times(speed, magnitude),
        }
    }

    /// Every result zero, with the sign of the refused speed: for a constant the compiler would call the function that clears memory.
    #[cold]
    #[inline(never)]
    fn still(speed: f32) -> Self {
        let zero = 0.0_f32.copysign(speed);
        let slip = ContactSlip {
            rolling_slip: zero,
            side_slip: zero,
            spin: zero,
            entrainment_speed: zero,
        };
        Self {
            orbital_speed: zero,
            spin_speed: zero,
            screw: slip,
            nut: slip,
        }
    }
}

const SPEED_LIMIT: f32 = 1.0e6;

#[inline]
pub(super) fn sane_speed(speed: f32) -> f32 {
    if speed.abs() <= SPEED_LIMIT {
        speed
    } else {
        0.0
    }
}
