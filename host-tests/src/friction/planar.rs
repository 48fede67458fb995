//! A ball whose contacts slip along the track and spin, but do not slip sideways: linear and rotary bearings.

use nalgebra::{Matrix3, Vector3};

use super::maps::FrictionMap;
use super::newton::{Local, sharpen};

/// One contact of a ball with three unknowns `y`: slip and spin are linear in `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarContact {
    /// Coefficients of the slip along the track at the contact centre.
    pub slip: [f64; 3],
    /// Slip at `y = 0`.
    pub slip_base: f64,
    /// Coefficients of the relative spin.
    pub spin: [f64; 3],
    /// Spin at `y = 0`.
    pub spin_base: f64,
    /// Semi-major axis, in the length unit of slip over spin.
    pub semi_major: f64,
    /// Friction coefficient times normal load; a contact at or below zero is lost.
    pub friction_limit: f64,
    /// Friction maps of its axis ratio.
    pub map: FrictionMap,
}

/// Friction of one contact at a given motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactFriction {
    /// Slip along the track at the contact centre, ball minus groove.
    pub slip: f64,
    /// Relative spin.
    pub spin: f64,
    /// Offset `c/a` of the velocity centre (infinite when a contact slips without spin).
    pub offset: f64,
    /// Friction force on the ball along the track: minus the derivative of the power by the slip.
    pub force: f64,
    /// Friction moment against the spin: the derivative of the power by the spin (`M_O` of (3.17)).
    pub moment: f64,
    /// Power lost: force times slip and moment times spin.
    pub power: f64,
}

/// Motion of least dissipation of one ball.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarMotion {
    /// The three unknowns.
    pub motion: [f64; 3],
    /// Friction of each contact, in the order given.
    pub contacts: Vec<ContactFriction>,
    /// Largest component of the unbalanced force.
    pub residual: f64,
    /// Upper bound of the dissipation above its minimum, by duality; zero unless a contact sticks.
    pub gap: f64,
    /// Newton steps over all stages.
    pub iterations: usize,
}

impl PlanarContact {
    /// Slip and spin at `y`.
    pub fn velocity(&self, y: &[f64; 3]) -> (f64, f64) {
        let dot = |row: &[f64; 3]| row.iter().zip(y).map(|(r, y)| r * y).sum::<f64>();
        (
            self.slip_base + dot(&self.slip),
            self.spin_base + dot(&self.spin),
        )
    }

    /// Friction at `y` with the spin replaced by `sqrt(spin^2 + rest_spin^2)` inside the power, which keeps the power
    /// convex, and force and moment consistent and within the limits of Coulomb's law.
    pub fn friction(&self, y: &[f64; 3], rest_spin: f64) -> ContactFriction {
        let (slip, spin) = self.velocity(y);
        if self.friction_limit <= 0.0 {
            let offset = slip / (spin * self.semi_major);
            return ContactFriction {
                slip,
                spin,
                offset,
                ..ContactFriction::default()
            };
        }
        let smooth = spin.hypot(rest_spin).max(1e-150);
        let value = self.map.at(slip / (self.semi_major * smooth));
        let force = self.friction_limit * value.force;
        let moment = self.friction_limit * self.semi_major * value.moment;
        let share = spin / smooth;
        ContactFriction {
            slip,
            spin,
            offset: slip / (spin * self.semi_major),
            force: -force,
            moment: moment * share,
            power: force * slip + moment * share * spin,
        }
    }

    /// Adds power, gradient and Hessian at `y`.
    ///
    /// With `W = sqrt(w^2 + delta^2)` and `kappa = V/(a W)` the Hessian is
    /// `mu F fh'/(a W) r r^T + mu F a Mh delta^2/W^3 s s^T`, `r = dV - (V/W) (w/W) dw`, `s = dw`.
    fn accumulate(&self, y: &Vector3<f64>, rest_spin: f64, sum: &mut Local<3>) {
        if self.friction_limit <= 0.0 {
            return;
        }
        let (slip, spin) = self.velocity(&[y.x, y.y, y.z]);
        let smooth = spin.hypot(rest_spin).max(1e-150);
        let offset = slip / (self.semi_major * smooth);
        let value = self.map.at(offset);
        let d_slip = Vector3::from(self.slip);
        let d_spin = Vector3::from(self.spin);
        let share = spin / smooth;
        let force = self.friction_limit * value.force;
        let moment = self.friction_limit * self.semi_major * value.moment;
        sum.value += force * slip + moment * smooth;
        sum.gradient += d_slip * force + d_spin * (moment * share);
        let r = d_slip - d_spin * (offset * self.semi_major * share);
        let stiffness = self.friction_limit * value.slope / (self.semi_major * smooth);
        if stiffness > 0.0 && r.iter().all(|x| x.is_finite()) {
            sum.hessian += r * r.transpose() * stiffness;
        }
        let rest = (rest_spin / smooth).powi(2) / smooth;
        sum.hessian += d_spin * d_spin.transpose() * (moment * rest);
    }
}

/// Power of all contacts with gradient and Hessian, plus a linear `load . y`.
pub fn dissipation(
    contacts: &[PlanarContact],
    load: &Vector3<f64>,
    y: &Vector3<f64>,
    rest_spin: f64,
) -> Local<3> {
    let mut sum = Local {
        value: load.dot(y),
        gradient: *load,
        hessian: Matrix3::zeros(),
    };
    for contact in contacts {
        contact.accumulate(y, rest_spin, &mut sum);
    }
    sum
}

/// True when no loaded contact is within thirty times the rest speed of standing still, so that smoothing is not needed.
pub(crate) fn all_move(contacts: &[PlanarContact], y: &Vector3<f64>, rest_spin: f64) -> bool {
    contacts.iter().filter(|c| c.friction_limit > 0.0).all(|c| {
        let (slip, spin) = c.velocity(&[y.x, y.y, y.z]);
        (slip / c.semi_major).hypot(spin) > 30.0 * rest_spin
    })
}

/// The motion of least dissipation, by [`sharpen`]; once every loaded contact moves, of the exact power. A contact that sticks in the
/// solution (two-point contact, and near it) stays smoothed at the last stage: its force and moment are inside Coulomb's limit, balance is
/// exact, and `gap` bounds the error of the power.
pub fn least_dissipation(contacts: &[PlanarContact], start: [f64; 3]) -> PlanarMotion {
    let zero = Vector3::zeros();
    let total: f64 = contacts.iter().map(|c| c.friction_limit.max(0.0)).sum();
    let tolerance = 1e-14 * total;
    let (end, rest_spin) = sharpen(
        Vector3::from(start),
        tolerance,
        1e-10 * total,
        |y, rest_spin| dissipation(contacts, &zero, y, rest_spin),
        |y, rest_spin| all_move(contacts, y, rest_spin),
    );
    let (point, residual, iterations) = (end.point, end.residual, end.iterations);
    let motion = [point.x, point.y, point.z];
    let friction: Vec<_> = contacts
        .iter()
        .map(|c| c.friction(&motion, rest_spin))
        .collect();
    let gap = contacts
        .iter()
        .zip(&friction)
        .map(|(c, f)| c.friction(&motion, 0.0).power - f.power)
        .sum::<f64>()
        .max(0.0);
    PlanarMotion {
        motion,
        contacts: friction,
        residual,
        gap: if rest_spin == 0.0 { 0.0 } else { gap },
        iterations,
    }
}
