//! Ball of a four-point-contact linear bearing (Lin 2019, section 3.3).
//!
//! Contacts in the order BL, BR, TR, TL (bottom/top, left/right). The bottom groove stands, the top groove moves at `v` along z.

use super::maps::FrictionMap;
use super::planar::{ContactFriction, PlanarContact, least_dissipation};
use crate::error::{ReferenceError, within};

/// Contact ellipse as a function of the load: `a = semi_major_constant F^(1/3)`, `b = axis_ratio a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseLaw {
    /// Semi-major axis per cube root of the load, m/N^(1/3) (`C_a`; the dissertation's `Psi` is `C_a/R_B^(1/3)`).
    pub semi_major_constant: f64,
    /// Axis ratio `b/a`.
    pub axis_ratio: f64,
}

/// One ball with its contact angles and normal loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearBall {
    /// Ball radius, m.
    pub ball_radius: f64,
    /// Friction coefficient between ball and grooves, 0 to 1.
    pub friction: f64,
    /// Contact angles BL, BR, TR, TL, rad, in (0, pi/2).
    pub contact_angles: [f64; 4],
    /// Normal loads BL, BR, TR, TL, N; a load at or below zero is a lost contact.
    pub contact_forces: [f64; 4],
    /// Size of the contact ellipses.
    pub ellipse: EllipseLaw,
}

/// Motion and friction of one ball.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearMotion {
    /// Speed of the ball centre along the track, m/s.
    pub ball_speed: f64,
    /// Angular velocity about x (rolling), rad/s.
    pub roll: f64,
    /// Angular velocity about y, rad/s.
    pub yaw: f64,
    /// `2 v_B/v - 1`, the deviation `epsilon` of (3.42).
    pub speed_deviation: f64,
    /// Friction of BL, BR, TR, TL: m/s, rad/s, N, N m, W.
    pub contacts: [ContactFriction; 4],
    /// Power lost in the groove contacts, W.
    pub power_loss: f64,
    /// Largest unbalanced force, N.
    pub residual: f64,
    /// Bound of the power above its minimum, W; zero unless a contact sticks.
    pub gap: f64,
    /// Newton steps.
    pub iterations: usize,
}

impl LinearBall {
    /// Checks every input.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("ball_radius", self.ball_radius, 1e-6, 1.0)?;
        within("friction", self.friction, 0.0, 1.0)?;
        for angle in self.contact_angles {
            within(
                "contact_angles",
                angle,
                1e-3,
                std::f64::consts::FRAC_PI_2 - 1e-3,
            )?;
        }
        for force in self.contact_forces {
            within("contact_forces", force, -1e9, 1e9)?;
        }
        within(
            "semi_major_constant",
            self.ellipse.semi_major_constant,
            1e-9,
            1.0,
        )?;
        let [bl, br, tr, tl] = self.contact_forces.map(|force| force > 0.0);
        if (bl || br) && (tr || tl) {
            Ok(())
        } else {
            Err(ReferenceError::Undriven)
        }
    }

    /// Contacts for the unknowns `(v_B, R_B w_x, R_B w_y)/v`, with a friction coefficient of one.
    ///
    /// Kinematics (3.22), (3.23) and (F.1) to (F.3). Speeds in units of `v`, lengths of `R_B`; the
    /// friction coefficient only scales all forces of a ball alike, so that the motion for `mu = 0` is the limit.
    pub(crate) fn contacts(&self) -> Result<[PlanarContact; 4], ReferenceError> {
        let map = FrictionMap::new(self.ellipse.axis_ratio)?;
        // (sign of x, sign of y) of the contact direction: BL, BR below, TR, TL above.
        let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let mut contacts = [PlanarContact {
            slip: [1.0, 0.0, 0.0],
            slip_base: 0.0,
            spin: [0.0; 3],
            spin_base: 0.0,
            semi_major: 1.0,
            friction_limit: 0.0,
            map,
        }; 4];
        for (i, contact) in contacts.iter_mut().enumerate() {
            let (sin, cos) = self.contact_angles[i].sin_cos();
            let (sign_x, sign_y) = signs[i];
            let force = self.contact_forces[i];
            // omega x q along z: w_x q_y - w_y q_x with q = R_B (sign_x sin, sign_y cos).
            contact.slip = [1.0, sign_y * cos, -sign_x * sin];
            // Spin about the inward normal (the local minus y axis of Figure 3.3).
            contact.spin = [0.0, -sign_x * sin, -sign_y * cos];
            contact.slip_base = if sign_y > 0.0 { -1.0 } else { 0.0 };
            contact.friction_limit = force.max(0.0);
            contact.semi_major = self.ellipse.semi_major_constant
                * force.max(f64::MIN_POSITIVE).cbrt()
                / self.ball_radius;
        }
        Ok(contacts)
    }

    /// Motion of the ball when no other ball touches it: eqs. (3.22) to (3.25), by least dissipation.
    pub fn solve(&self, speed: f64) -> Result<LinearMotion, ReferenceError> {
        self.solve_from(speed, [0.5, 0.7, 0.0])
    }

    /// As [`Self::solve`], from a given start of `(v_B, R_B w_x, R_B w_y)/v`; the result does not depend on it.
    pub fn solve_from(&self, speed: f64, start: [f64; 3]) -> Result<LinearMotion, ReferenceError> {
        self.check()?;
        within("speed", speed, -1e6, 1e6)?;
        if speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        for value in start {
            within("start", value, -1e6, 1e6)?;
        }
        let contacts = self.contacts()?;
        let motion = least_dissipation(&contacts, start);
        let largest = self.contact_forces.iter().fold(0.0_f64, |m, f| m.max(*f));
        if motion.residual.is_nan() || motion.residual > 1e-6 * largest {
            return Err(ReferenceError::unbalanced(self.friction * motion.residual));
        }
        let mut friction = [ContactFriction::default(); 4];
        for (to, from) in friction.iter_mut().zip(&motion.contacts) {
            *to = *from;
        }
        Ok(self.dimensional(
            speed,
            motion.motion,
            friction,
            motion.residual,
            motion.gap,
            motion.iterations,
        ))
    }

    /// Puts speed, ball radius and friction coefficient back.
    pub(crate) fn dimensional(
        &self,
        speed: f64,
        y: [f64; 3],
        contacts: [ContactFriction; 4],
        residual: f64,
        gap: f64,
        iterations: usize,
    ) -> LinearMotion {
        let (mu, r, size) = (self.friction, self.ball_radius, speed.abs());
        let contacts = contacts.map(|c| ContactFriction {
            slip: c.slip * speed,
            spin: c.spin * speed / r,
            offset: c.offset,
            force: mu * c.force * speed.signum(),
            moment: mu * r * c.moment * speed.signum(),
            power: mu * c.power * size,
        });
        LinearMotion {
            ball_speed: y[0] * speed,
            roll: y[1] * speed / r,
            yaw: y[2] * speed / r,
            speed_deviation: 2.0 * y[0] - 1.0,
            contacts,
            power_loss: contacts.iter().map(|c| c.power).sum(),
            residual: mu * residual,
            gap: mu * gap * size,
            iterations,
        }
    }

    /// Speed deviation by the published closed form, see [`analytic_speed_deviation`].
    pub fn analytic_speed_deviation(&self, nominal_contact_angle: f64) -> f64 {
        let deviations = self
            .contact_angles
            .map(|angle| angle - nominal_contact_angle);
        analytic_speed_deviation(nominal_contact_angle, deviations, self.contact_forces)
    }

    /// Compliance by the published closed form, see [`analytic_compliance`].
    pub fn analytic_compliance(&self, nominal_contact_angle: f64, force_slope: f64) -> f64 {
        analytic_compliance(
            nominal_contact_angle,
            self.ball_radius,
            self.friction,
            self.ellipse.semi_major_constant,
            force_slope,
            self.contact_forces,
        )
    }
}

/// Slope of the friction force at the contact centre that the dissertation reads off Figure 3.11, (3.35).
///
/// The exact slope is [`FrictionMap::initial_slope`].
pub const PUBLISHED_FORCE_SLOPE: f64 = 1.38;

/// Normal loads BL, BR, TR, TL of a ball under a load `(side_load, normal_load)` on the top groove.
///
/// `F_TR cos b_TR + F_TL cos b_TL = N_y`, `F_TL sin b_TL - F_TR sin b_TR = N_x`, and the ball in balance. The text
/// approximates `F_BL = F_TR` and `F_BR = F_TL`, which moves Table 3.4 from 0.8712/-0.7863 % to +-0.8092 %.
/// Load beyond the reach of the angles gives a negative value: that contact is lost.
///
/// Source: Lin 2019, section 3.3.4.1 and Figure 3.13.
pub fn contact_forces(contact_angles: [f64; 4], side_load: f64, normal_load: f64) -> [f64; 4] {
    let [bl, br, tr, tl] = contact_angles;
    let top = (tr + tl).sin();
    let force_tr = (normal_load * tl.sin() - side_load * tl.cos()) / top;
    let force_tl = (normal_load * tr.sin() + side_load * tr.cos()) / top;
    let lateral = force_tr * tr.sin() - force_tl * tl.sin();
    let vertical = force_tr * tr.cos() + force_tl * tl.cos();
    let bottom = (bl + br).sin();
    [
        (lateral * br.cos() + vertical * br.sin()) / bottom,
        (vertical * bl.sin() - lateral * bl.cos()) / bottom,
        force_tr,
        force_tl,
    ]
}

/// Mean loads of the diagonals U (BL, TR) and D (BR, TL), to the power 2/3.
fn diagonals(forces: [f64; 4]) -> (f64, f64) {
    let [bl, br, tr, tl] = forces.map(|force| force.max(0.0));
    (
        (0.5 * (bl + tr)).cbrt().powi(2),
        (0.5 * (br + tl)).cbrt().powi(2),
    )
}

/// Deviation of the ball's speed from half the groove's, for small deviations from four equal contact angles.
///
/// `eps = tan(b0) ((d_TR - d_BL) F_U^(2/3) + (d_TL - d_BR) F_D^(2/3))/(2 (F_U^(2/3) + F_D^(2/3)))`
///
/// Source: Lin 2019, eqs. (3.42), (3.43). Corrected: the printed factor `1 - cos 2 b0` must be `tan b0 = (1 - cos 2 b0)/sin 2 b0`,
/// equal at 45 degrees only.
pub fn analytic_speed_deviation(
    nominal_contact_angle: f64,
    angle_deviations: [f64; 4],
    forces: [f64; 4],
) -> f64 {
    let [bl, br, tr, tl] = angle_deviations;
    let (up, down) = diagonals(forces);
    if up + down <= 0.0 {
        return 0.0;
    }
    nominal_contact_angle.tan() * ((tr - bl) * up + (tl - br) * down) / (2.0 * (up + down))
}

/// Change of a ball's speed deviation per newton of ball-to-ball force.
///
/// `s = tan(b0) Psi/(2 kf mu R_B^(2/3) (F_U^(2/3) + F_D^(2/3)))`, `Psi = semi_major_constant/R_B^(1/3)`; infinite without friction or load.
///
/// Source: Lin 2019, eqs. (3.44) to (3.51). Corrected: `tan b0` as in (3.43), and the exponents of (3.51) are +2/3, not -2/3.
pub fn analytic_compliance(
    nominal_contact_angle: f64,
    ball_radius: f64,
    friction: f64,
    semi_major_constant: f64,
    force_slope: f64,
    forces: [f64; 4],
) -> f64 {
    let (up, down) = diagonals(forces);
    nominal_contact_angle.tan() * semi_major_constant
        / (2.0 * force_slope * friction * ball_radius * (up + down))
}

/// Force between two balls that touch, the first one behind: `max(0, (eps_1 - eps_2)/(s_1 + s_2))`.
///
/// Source: Lin 2019, eq. (3.51), with the corrections of [`analytic_compliance`].
pub fn analytic_contact_force(speed_deviations: [f64; 2], compliances: [f64; 2]) -> f64 {
    ((speed_deviations[0] - speed_deviations[1]) / (compliances[0] + compliances[1])).max(0.0)
}

/// Speed of slip between two balls that touch, `|v|/cos b0`, with the balls taken to roll about the x axis.
///
/// Source: Lin 2019, eqs. (3.52), (3.53): the loss is `mu F` times this.
pub fn analytic_ball_slip(nominal_contact_angle: f64, speed: f64) -> f64 {
    speed.abs() / nominal_contact_angle.cos()
}
