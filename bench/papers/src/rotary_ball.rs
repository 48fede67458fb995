//! Ball of a four-point-contact rotary bearing: loads and friction (Lin 2019, section 3.2).
//!
//! Contacts in the order IL, IR, OR, OL (inner/outer ring, left/right). The outer ring stands, the inner ring turns.

use nalgebra::{Matrix3, Vector3};

use epas_reference::error::ReferenceError;
use epas_reference::friction::contact_law::{Eccentricity, HertzLaw};
use epas_reference::friction::maps::FrictionMap;
use epas_reference::friction::newton::{Local, minimise};
use epas_reference::friction::planar::{
    ContactFriction, PlanarContact, dissipation, least_dissipation,
};

/// Direction of each contact from the ball centre: signs of the axial (x) and radial (y) component.
pub const SIGNS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

/// How the groove's curvature along the track and the eccentricity of the contact enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotaryConvention {
    /// Radius of curvature along the track `r/cos(contact angle)` (Meusnier) and exact Hertz theory.
    Physical,
    /// The dissertation's: eigenvalues of the second fundamental form alone, (B.4), which give `r cos(contact angle)`, and
    /// `F1 = 1`. Only so does Table 3.2 reproduce to its digits; the curvature along the track is wrong by `1/cos^2`.
    Dissertation,
}

/// A four-point-contact rotary ball bearing (Table 3.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryBearing {
    pub ball_radius: f64,
    pub pitch_radius: f64,
    /// Groove radius over ball diameter.
    pub conformity: f64,
    pub contact_angle: f64,
    pub youngs_modulus: f64,
    pub poisson_ratio: f64,
    pub convention: RotaryConvention,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryContacts {
    /// Contact angles, rad; of a lost contact, the direction to the groove.
    pub contact_angles: [f64; 4],
    pub contact_forces: [f64; 4],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryMotion {
    /// Orbital speed of the ball, rad/s.
    pub orbital_speed: f64,
    /// Angular velocity about the bearing's axis in the orbiting frame, rad/s.
    pub omega_x: f64,
    /// Angular velocity about the radial direction, rad/s.
    pub omega_y: f64,
    /// Friction of IL, IR, OR, OL: m/s, rad/s, N, N m, W.
    pub contacts: [ContactFriction; 4],
    /// Friction torque on the inner ring, N m, (3.21).
    pub friction_torque: f64,
    /// Largest unbalanced force, N.
    pub residual: f64,
}

impl RotaryBearing {
    /// Contact law of the inner (false) or outer (true) ring at the nominal contact angle.
    ///
    /// `1/R' = 1/R_B +- cos b/(R_P -+ R_B cos b)` (+ inner, - outer), `1/R'' = 1/R_B - 1/R_G`.
    pub fn contact_law(&self, outer: bool) -> Result<HertzLaw, ReferenceError> {
        let (r, poisson) = (self.ball_radius, self.poisson_ratio);
        let sign = if outer { -1.0 } else { 1.0 };
        let cos = self.contact_angle.cos();
        let distance = self.pitch_radius - sign * r * cos;
        let (along, eccentricity) = match self.convention {
            RotaryConvention::Physical => (cos / distance, Eccentricity::Exact),
            RotaryConvention::Dissertation => (1.0 / (distance * cos), Eccentricity::Ignored),
        };
        let relative_1 = 1.0 / (1.0 / r + sign * along);
        let relative_2 = 1.0 / (1.0 / r - 1.0 / (2.0 * self.conformity * r));
        HertzLaw::new(
            relative_1,
            relative_2,
            self.youngs_modulus / (2.0 * (1.0 - poisson * poisson)),
            eccentricity,
        )
    }

    /// Contact angles and loads of a ball under an axial load on the inner ring, with the inner ring displaced by
    /// `radial_displacement` towards the ball (Figure 3.6).
    ///
    /// The groove arcs are circles of radius `R_G`, so a contact lies on the line from the arc's centre through the ball centre, and the
    /// elastic energy `sum 2/5 C^-3/2 deflection^5/2` less the load's work is convex in ball centre and ring displacement; it is minimised.
    pub fn contacts_under_load(
        &self,
        axial_load: f64,
        radial_displacement: f64,
    ) -> Result<RotaryContacts, ReferenceError> {
        let (load, lift) = (axial_load, radial_displacement);
        let laws = [self.contact_law(false)?, self.contact_law(true)?];
        let (sin, cos) = self.contact_angle.sin_cos();
        let offset = (2.0 * self.conformity - 1.0) * self.ball_radius;
        // Unit of length: the approach of the two rings under the load alone.
        let reach = (laws[0].compliance + laws[1].compliance) * (load / sin).powf(2.0 / 3.0);
        let unit = reach / sin;
        let arms = |y: &Vector3<f64>| {
            SIGNS.map(|(sx, sy)| {
                let ring = if sy < 0.0 {
                    [y.z * unit, lift]
                } else {
                    [0.0, 0.0]
                };
                [
                    y.x * unit + offset * sx * sin - ring[0],
                    y.y * unit + offset * sy * cos - ring[1],
                ]
            })
        };
        let energy = |y: &Vector3<f64>| {
            let mut sum = Local {
                value: -load * y.z * unit,
                gradient: Vector3::new(0.0, 0.0, -load * unit),
                hessian: Matrix3::zeros(),
            };
            for (arm, (_, sy)) in arms(y).iter().zip(SIGNS) {
                let law = if sy < 0.0 { laws[0] } else { laws[1] };
                let length = arm[0].hypot(arm[1]);
                let deflection = (length - offset).max(0.0);
                let force = law.load(deflection);
                let ring = if sy < 0.0 { -1.0 } else { 0.0 };
                let along = Vector3::new(arm[0], arm[1], ring * arm[0]) * (unit / length);
                let across = Vector3::new(-arm[1], arm[0], -ring * arm[1]) * (unit / length);
                sum.value += 0.4 * force * deflection;
                sum.gradient += along * force;
                if force > 0.0 {
                    sum.hessian += along * along.transpose() * (1.5 * force / deflection)
                        + across * across.transpose() * (force / length);
                }
            }
            sum
        };
        // The exact answer when IL and OR alone carry the load, which closes any play first: the arcs' centres at their distance
        // under load. With all contacts open there is no stiffness to start from.
        let side = (2.0 * offset + reach).powi(2) - (2.0 * offset * cos + lift).powi(2);
        let travel = side.max(0.0).sqrt() - 2.0 * offset * sin;
        let start = Vector3::new(0.5 * travel, 0.5 * lift, travel) / unit;
        let end = minimise(start, 1e-13 * load * unit, energy);
        let mut contacts = RotaryContacts {
            contact_angles: [0.0; 4],
            contact_forces: [0.0; 4],
        };
        for ((i, arm), (sx, sy)) in arms(&end.point).iter().enumerate().zip(SIGNS) {
            contacts.contact_angles[i] = (arm[0] * sx).atan2(arm[1] * sy);
            let law = if sy < 0.0 { laws[0] } else { laws[1] };
            contacts.contact_forces[i] = law.load(arm[0].hypot(arm[1]) - offset);
        }
        let residual = end.residual / unit;
        let largest = contacts.contact_forces.iter().fold(load, |m, f| m.max(*f));
        if residual.is_nan() || residual > 1e-8 * largest {
            return Err(ReferenceError::unbalanced(residual));
        }
        Ok(contacts)
    }

    /// Rows for the unknowns `(w_B, w_x, w_y)/w_I`, friction coefficient one; lengths in ball radii. (3.10) to (3.14).
    fn rows(&self, contacts: &RotaryContacts) -> Result<[PlanarContact; 4], ReferenceError> {
        let laws = [self.contact_law(false)?, self.contact_law(true)?];
        let maps = [
            FrictionMap::new(laws[0].ellipse.axis_ratio)?,
            FrictionMap::new(laws[1].ellipse.axis_ratio)?,
        ];
        let rows = std::array::from_fn(|i| {
            let load = contacts.contact_forces[i].max(0.0);
            let (sx, sy) = SIGNS[i];
            let side = usize::from(sy > 0.0);
            let (sin, cos) = contacts.contact_angles[i].sin_cos();
            let radius = self.pitch_radius / self.ball_radius + sy * cos;
            // The inner ring turns at one: its speed is taken off slip and spin of the inner contacts.
            let ring = if sy < 0.0 { 1.0 } else { 0.0 };
            PlanarContact {
                slip: [radius, sy * cos, -sx * sin],
                slip_base: -radius * ring,
                spin: [-sx * sin, -sx * sin, -sy * cos],
                spin_base: sx * sin * ring,
                semi_major: laws[side].ellipse.semi_major_constant
                    * load.max(f64::MIN_POSITIVE).cbrt()
                    / self.ball_radius,
                friction_limit: load,
                map: maps[side],
            }
        });
        let loaded = |i: usize| contacts.contact_forces[i] > 0.0;
        if (loaded(0) || loaded(1)) && (loaded(2) || loaded(3)) {
            Ok(rows)
        } else {
            Err(ReferenceError::Undriven)
        }
    }

    /// Motion of least dissipation: the Coulomb model itself.
    pub fn motion(
        &self,
        contacts: &RotaryContacts,
        friction: f64,
        inner_speed: f64,
    ) -> Result<RotaryMotion, ReferenceError> {
        let (mu, speed) = (friction, inner_speed);
        if speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        let rows = self.rows(contacts)?;
        let solution = least_dissipation(&rows, self.rolling_start());
        let largest = contacts
            .contact_forces
            .iter()
            .fold(0.0_f64, |m, f| m.max(*f));
        if solution.residual.is_nan()
            || solution.residual > 1e-6 * largest * self.pitch_radius / self.ball_radius
        {
            return Err(ReferenceError::unbalanced(mu * solution.residual));
        }
        let mut frictions = [ContactFriction::default(); 4];
        for (to, from) in frictions.iter_mut().zip(&solution.contacts) {
            *to = *from;
        }
        Ok(self.dimensional(solution.motion, frictions, solution.residual, mu, speed))
    }

    /// Motion by the dissertation's equations (3.19) to (3.21): force, moment and power of every contact are multiplied by
    /// `|Sig| = tanh(sigmoid_slope |w|/(2 w_I sin b))`, (3.20), with `sigmoid_slope = 100` in Table 3.2.
    ///
    /// The factor takes friction from a contact that slides without spinning, too, and the equations have no potential; it is
    /// kept for Table 3.2. In a two-point contact it decides how the spin is shared (`w_x`, `w_y`), not the losses.
    /// Corrected: in (3.19) `Sig` carries the sign of the spin that the force already has, so its magnitude is meant; likewise (3.21).
    /// Written as tanh, the factor does not overflow for fast spin.
    pub fn motion_with_sigmoid(
        &self,
        contacts: &RotaryContacts,
        friction: f64,
        inner_speed: f64,
        sigmoid_slope: f64,
    ) -> Result<RotaryMotion, ReferenceError> {
        let (mu, speed, final_slope) = (friction, inner_speed, sigmoid_slope);
        if speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        let rows = self.rows(contacts)?;
        let width = self.contact_angle.sin();
        let sigmoid = |row: &PlanarContact, y: &Vector3<f64>, slope: f64| {
            let spin = row.velocity(&[y.x, y.y, y.z]).1;
            let value = (0.5 * slope * spin / width).tanh();
            (
                value.abs(),
                0.5 * slope / width * (1.0 - value * value) * spin.signum(),
            )
        };
        let system = |y: &Vector3<f64>, slope: f64| {
            let mut residual = Vector3::zeros();
            let mut jacobian = Matrix3::zeros();
            for row in &rows {
                let local = dissipation(std::slice::from_ref(row), &Vector3::zeros(), y, 1e-12);
                let (share, rise) = sigmoid(row, y, slope);
                residual += local.gradient * share;
                jacobian += local.hessian * share
                    + local.gradient * Vector3::from(row.spin).transpose() * rise;
            }
            (residual, jacobian)
        };
        let total: f64 = rows.iter().map(|row| row.friction_limit).sum();
        let mut best: Option<(Vector3<f64>, f64)> = None;
        // The equations have no potential whose fall would guide Newton's method: it starts with a broad sigmoid that is made
        // steeper in steps, from plain rolling and, where that fails, from the motion of least dissipation.
        let starts = [
            Vector3::from(self.rolling_start()),
            Vector3::from(least_dissipation(&rows, self.rolling_start()).motion),
        ];
        for start in starts {
            let mut y = start;
            let mut slope = f64::min(2.0, final_slope);
            loop {
                y = damped_newton(y, 1e-14 * total, |y| system(y, slope));
                if slope >= final_slope {
                    break;
                }
                slope = f64::min(1.5 * slope, final_slope);
            }
            let residual = system(&y, final_slope).0.amax();
            if residual.is_finite() && best.is_none_or(|(_, least)| residual < least) {
                best = Some((y, residual));
            }
            if residual <= 1e-11 * total {
                break;
            }
        }
        let (y, residual) = best.ok_or(ReferenceError::unbalanced(f64::INFINITY))?;
        if residual > 1e-8 * total {
            return Err(ReferenceError::unbalanced(mu * residual));
        }
        let motion = [y.x, y.y, y.z];
        let frictions = rows.map(|row| {
            let share = sigmoid(&row, &y, final_slope).0;
            let c = row.friction(&motion, 0.0);
            ContactFriction {
                force: share * c.force,
                moment: share * c.moment,
                power: share * c.power,
                ..c
            }
        });
        Ok(self.dimensional(motion, frictions, residual, mu, speed))
    }

    /// Rolling on an axis parallel to the bearing's, at the nominal contact angle.
    fn rolling_start(&self) -> [f64; 3] {
        let ratio = self.ball_radius * self.contact_angle.cos() / self.pitch_radius;
        [0.5 * (1.0 - ratio), -0.5 / ratio.max(1e-6), 0.0]
    }

    fn dimensional(
        &self,
        y: [f64; 3],
        contacts: [ContactFriction; 4],
        residual: f64,
        mu: f64,
        speed: f64,
    ) -> RotaryMotion {
        let r = self.ball_radius;
        let contacts = contacts.map(|c| ContactFriction {
            slip: c.slip * r * speed,
            spin: c.spin * speed,
            offset: c.offset,
            force: mu * c.force * speed.signum(),
            moment: mu * r * c.moment * speed.signum(),
            power: mu * r * c.power * speed.abs(),
        });
        RotaryMotion {
            orbital_speed: y[0] * speed,
            omega_x: y[1] * speed,
            omega_y: y[2] * speed,
            contacts,
            friction_torque: contacts.iter().map(|c| c.power).sum::<f64>() / speed,
            residual: mu * residual,
        }
    }
}

/// Newton's method with the step halved until the norm of the residual falls.
fn damped_newton(
    start: Vector3<f64>,
    tolerance: f64,
    system: impl Fn(&Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>),
) -> Vector3<f64> {
    let mut y = start;
    let (mut residual, mut jacobian) = system(&y);
    for _ in 0..60 {
        if residual.amax() <= tolerance {
            break;
        }
        // A rank-deficient Jacobian (a lost contact, a contact at rest) is shifted just enough to be solved.
        let shifted = jacobian + Matrix3::identity() * (1e-13 * jacobian.amax());
        let Some(step) = shifted.lu().solve(&residual) else {
            break;
        };
        let mut fraction = 1.0;
        let mut moved = false;
        while fraction > 1e-8 {
            let there = y - step * fraction;
            let (new, slope) = system(&there);
            if new.norm() < (1.0 - 1e-4 * fraction) * residual.norm() {
                (y, residual, jacobian) = (there, new, slope);
                moved = true;
                break;
            }
            fraction *= 0.5;
        }
        if !moved {
            break;
        }
    }
    y
}
