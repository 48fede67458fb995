//! Slip of a contact and motion of a ball, per unit of speed or at a speed.

/// Slip of one contact at its centre.
///
/// As a result of [`tick`](super::ContactKinematics::tick): m/s, m/s, rad/s, m/s. As a constant per unit of
/// speed ([`per_speed`](super::ContactKinematics::per_speed)): m, m, 1, m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactSlip {
    /// Slip along the direction of rolling, m/s (Alberdi et al., eq. (31)).
    pub rolling_slip: f32,
    /// Slip across the direction of rolling, m/s (eq. (32), whose `omega_l` is `omega_t`).
    pub side_slip: f32,
    /// Angular velocity of the ball about the contact normal, relative to the raceway, rad/s (eq. (34)).
    pub spin: f32,
    /// Entrainment speed: mean speed of the two surfaces relative to the moving contact, m/s (size of the vector of eqs. (35),
    /// (36)); never negative.
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

/// Motion of one ball and its slip at both contacts.
///
/// As a result of [`ContactKinematics::tick`](super::ContactKinematics::tick): speeds. As [`ContactKinematics::per_speed`](super::ContactKinematics::per_speed): the
/// same per rad/s of the screw.
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
    /// From the motion per speed to that at a speed; a wrong one counts as 0.
    #[inline]
    pub(super) fn at_speed(&self, speed: f32) -> Self {
        let magnitude = speed.abs();
        // False for NaN, too. Only the branch for wrong speeds holds a call: the usual branch needs no stack frame.
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

    /// Every result zero, with the sign of the refused speed. The sign serves to keep the zero from being a constant:
    /// for a constant the compiler would call the function that clears memory, which takes longer than the products.
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

/// Speeds beyond this are no speeds of a screw, rad/s (9.5 million revolutions a minute).
const SPEED_LIMIT: f32 = 1.0e6;

/// `speed`, or 0 where it is not a number or beyond [`SPEED_LIMIT`].
#[inline]
pub(super) fn sane_speed(speed: f32) -> f32 {
    // One comparison refuses NaN and both infinities as well.
    if speed.abs() <= SPEED_LIMIT {
        speed
    } else {
        0.0
    }
}
