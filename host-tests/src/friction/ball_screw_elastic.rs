//! Balls of a ball screw with friction and contact elasticity: the in-plane balance that places the ball, and two balls that touch
//! (Lin 2019, eqs. (3.69), (3.73) to (3.76)).
//!
//! The slip `R_B w_N sin a` across the track is shared by the two loaded contacts, and both friction forces push the ball the same way along
//! the other diagonal: in a groove without play a third, light contact closes. So loads and friction must be found together.

use nalgebra::{DMatrix, DVector, SMatrix, Vector3, Vector4};

use super::ball_screw_ball::{
    ScrewMotion, ScrewRow, ball_dissipation, ball_minimum, dimensional, rolling,
};
use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::normal;
use super::newton::{Local, minimise};
use crate::error::{ReferenceError, within};

/// Which angular velocity enters the slip between two balls, (3.73).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BallSlip {
    /// Relative to the frame that orbits with the balls, as (3.61) and (3.73) define `omega`, and as the power balance requires.
    Orbiting,
    /// The total angular velocity in space. It overstates the slip by the orbit's rotation (12 to 13 % for Table 3.6), and
    /// comes nearer to the friction increase that the dissertation prints with Table 3.7.
    Total,
}

/// How the screw is held along its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScrewSupport {
    /// Free: the axial force of the screw on all balls together, N, positive along z (SL and NR carry it).
    Load(f64),
    /// Held at an axial displacement, m.
    Displacement(f64),
}

/// One or two neighbouring balls on one screw and nut; the first is behind when the nut turns forward.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticBalls {
    /// Grooves at each ball.
    pub grooves: Vec<ElasticGrooves>,
    /// Friction coefficient of the grooves, 0.001 to 1.
    pub friction: f64,
    /// Friction coefficient between the balls.
    pub ball_friction: f64,
    /// Angular velocity of the nut, rad/s.
    pub nut_speed: f64,
    /// Convention of the slip between balls.
    pub ball_slip: BallSlip,
}

/// Place, motion and loads of the balls.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticMotion {
    /// Ball centres in their cross sections, x and z, m.
    pub positions: Vec<[f64; 2]>,
    /// Axial displacement of the screw, m.
    pub screw_displacement: f64,
    /// Motion and contacts of each ball.
    pub balls: Vec<ScrewMotion>,
    /// Force between the two balls, N.
    pub contact_force: f64,
    /// Slip between the two balls, m/s.
    pub ball_slip: f64,
    /// Power lost between the balls, W.
    pub ball_loss: f64,
    /// Largest unbalanced force, N.
    pub residual: f64,
}

impl ElasticMotion {
    /// Power lost in the grooves, W.
    pub fn groove_loss(&self) -> f64 {
        self.balls.iter().map(|b| b.power_loss).sum()
    }
}

/// Finest smoothing spin of a contact that sticks, over the nut's speed. With a finer one the rounding of the motion is larger
/// than the spin over which friction reverses.
const FINEST: f64 = 1e-5;
/// Coarsest smoothing spin whose solution is accepted, where rounding stops finer ones from converging (loads of millinewtons with play).
const COARSEST: f64 = 1e-3;

/// Unknowns of one ball: place in units of the approach, and motion in units of the nut's speed.
const PER_BALL: usize = 6;

struct Problem<'a> {
    balls: &'a ElasticBalls,
    support: ScrewSupport,
    unit: f64,
    touching: bool,
    /// Spin below which friction is smoothed, over the nut's speed; zero for Coulomb's law itself.
    rest_spin: f64,
}

impl Problem<'_> {
    fn size(&self) -> usize {
        PER_BALL * self.balls.grooves.len() + 1 + usize::from(self.touching)
    }

    fn rows_of(&self, ball: usize, q: &DVector<f64>) -> Result<Vec<ScrewRow>, ReferenceError> {
        let grooves = &self.balls.grooves[ball];
        let at = PER_BALL * ball;
        let displacement = q[PER_BALL * self.balls.grooves.len()] * self.unit;
        let contacts =
            grooves.contacts_at([q[at] * self.unit, q[at + 1] * self.unit], displacement);
        contacts
            .iter()
            .filter(|c| c.load > 0.0)
            .map(|c| ScrewRow::new(&grooves.track, *c))
            .collect()
    }

    fn motion_of(ball: usize, q: &DVector<f64>) -> Vector4<f64> {
        q.fixed_rows::<4>(PER_BALL * ball + 2).into_owned()
    }

    /// Slip between the two balls over `R_B w_N`: components (z4, x4) of (3.73).
    fn slip_between(&self, q: &DVector<f64>) -> [f64; 2] {
        let track = &self.balls.grooves[0].track;
        let (sin_b, cos_b) = track.ball_contact_angle();
        let (sin_a, cos_a) = track.lead_angle();
        let spin = |ball: usize| {
            let y = Self::motion_of(ball, q);
            let orbit = match self.balls.ball_slip {
                BallSlip::Orbiting => y[0],
                BallSlip::Total => 0.0,
            };
            [y[1], y[2] - orbit * sin_a, y[3] - orbit * cos_a]
        };
        let (one, two) = (spin(0), spin(1));
        [
            (one[0] + two[0]) * cos_b + (one[1] - two[1]) * sin_b,
            -(one[2] + two[2]),
        ]
    }

    /// Unbalanced forces and moments (over `R_B`), N: per ball in-plane x and z, along the track (times path over ball
    /// radius), three moments; then the axial force; then the speed difference.
    fn residual(&self, q: &DVector<f64>) -> Option<DVector<f64>> {
        let n = self.balls.grooves.len();
        let mu = self.balls.friction;
        let sign = self.balls.nut_speed.signum();
        let mut r = DVector::zeros(self.size());
        let axial = PER_BALL * n;
        for ball in 0..n {
            let rows = self.rows_of(ball, q).ok()?;
            let y = Self::motion_of(ball, q);
            let (sin_a, cos_a) = self.balls.grooves[ball].track.lead_angle();
            let at = PER_BALL * ball;
            for row in &rows {
                let gradient = row.local(&y, self.rest_spin).gradient;
                let [nx, nz] = normal(row);
                let (across, along) = (-mu * sign * gradient.x, -mu * sign * gradient.y);
                let force = [
                    -row.contact.load * nx + across * nz,
                    along,
                    -row.contact.load * nz - across * nx,
                ];
                r[at] += force[0];
                r[at + 1] += force[2];
                let generalised = row.rows.transpose() * gradient;
                for i in 0..4 {
                    r[at + 2 + i] -= mu * sign * generalised[i];
                }
                if !row.contact.groove.on_nut() {
                    r[axial] += force[2] * cos_a + force[1] * sin_a;
                }
            }
        }
        match self.support {
            ScrewSupport::Load(load) => r[axial] -= load,
            ScrewSupport::Displacement(u) => {
                r[axial] = (q[axial] - u / self.unit) * self.stiffness();
            }
        }
        if self.touching {
            self.add_ball_contact(q, &mut r);
        }
        r.iter().all(|x| x.is_finite()).then_some(r)
    }

    fn stiffness(&self) -> f64 {
        let grooves = &self.balls.grooves[0];
        (self.unit / (grooves.screw.compliance + grooves.nut.compliance)).powf(1.5)
    }

    /// (3.75) for the rear ball and its mirror image for the front ball, and (3.76).
    ///
    /// The rear ball is pushed back along the chord between the centres, the front ball forward; both outward. Arms and friction forces
    /// reverse together, so both feel the moments about x and z with one sign.
    fn add_ball_contact(&self, q: &DVector<f64>, r: &mut DVector<f64>) {
        let n = self.balls.grooves.len();
        let track = &self.balls.grooves[0].track;
        let (sin_b, cos_b) = track.ball_contact_angle();
        let path = track.path_radius() / track.ball_radius;
        let sign = self.balls.nut_speed.signum();
        let force = q[PER_BALL * n + 1] * self.stiffness();
        let slip = self.slip_between(q);
        let size = slip[0].hypot(slip[1]).max(1e-300);
        let [fz, fx] = slip.map(|s| -self.balls.ball_friction * force * sign * s / size);
        // With the nut reversed the list is still rear to front along +y; the first ball then is the front one in motion, and
        // the pair presses with the same geometry.
        for (ball, direction) in [(0, 1.0), (1, -1.0)] {
            let at = PER_BALL * ball;
            r[at] += sin_b * force + direction * cos_b * fx;
            r[at + 1] += direction * fz;
            r[at + 2] += path * (-direction * cos_b * force + sin_b * fx);
            r[at + 3] += cos_b * fz;
            r[at + 4] += direction * sin_b * fz;
            r[at + 5] -= fx;
        }
        let difference = Self::motion_of(0, q)[0] - Self::motion_of(1, q)[0];
        r[PER_BALL * n + 1] = difference * self.stiffness();
    }

    /// Jacobian: by the power's Hessian for the motions, which a contact at rest makes stiff; central differences for places,
    /// displacement and contact force, and for the friction between balls.
    fn jacobian(&self, q: &DVector<f64>) -> Option<DMatrix<f64>> {
        let n = self.balls.grooves.len();
        let axial = PER_BALL * n;
        let scale = self.balls.friction * self.balls.nut_speed.signum();
        let mut jacobian = DMatrix::zeros(self.size(), self.size());
        for ball in 0..n {
            let y = Self::motion_of(ball, q);
            let (sin_a, cos_a) = self.balls.grooves[ball].track.lead_angle();
            let at = PER_BALL * ball;
            for row in &self.rows_of(ball, q).ok()? {
                let by_motion = row.local(&y, self.rest_spin).hessian * row.rows * -scale;
                let [nx, nz] = normal(row);
                let generalised = row.rows.transpose() * by_motion;
                for i in 0..4 {
                    let column = at + 2 + i;
                    jacobian[(at, column)] += by_motion[(0, i)] * nz;
                    jacobian[(at + 1, column)] -= by_motion[(0, i)] * nx;
                    for k in 0..4 {
                        jacobian[(at + 2 + k, column)] += generalised[(k, i)];
                    }
                    if !row.contact.groove.on_nut() && matches!(self.support, ScrewSupport::Load(_))
                    {
                        jacobian[(axial, column)] +=
                            by_motion[(1, i)] * sin_a - by_motion[(0, i)] * nx * cos_a;
                    }
                }
            }
        }
        for j in 0..self.size() {
            let motion = j < axial && j % PER_BALL >= 2;
            if motion && !self.touching {
                continue;
            }
            let step = 1e-7 * q[j].abs().max(0.1);
            let (mut up, mut down) = (q.clone(), q.clone());
            up[j] += step;
            down[j] -= step;
            let difference = if motion {
                let (mut above, mut below) =
                    (DVector::zeros(self.size()), DVector::zeros(self.size()));
                self.add_ball_contact(&up, &mut above);
                self.add_ball_contact(&down, &mut below);
                above - below
            } else {
                self.residual(&up)? - self.residual(&down)?
            };
            let mut column = jacobian.column_mut(j);
            column += difference / (2.0 * step);
        }
        Some(jacobian)
    }

    fn solve(&self, start: DVector<f64>, tolerance: f64) -> (DVector<f64>, f64) {
        let mut q = start;
        let Some(mut r) = self.residual(&q) else {
            return (q, f64::INFINITY);
        };
        for _ in 0..400 {
            if r.amax() <= tolerance {
                break;
            }
            let Some(step) = self
                .jacobian(&q)
                .and_then(|jacobian| jacobian.lu().solve(&r))
            else {
                break;
            };
            let mut fraction = 1.0;
            let mut moved = false;
            while fraction > 1e-5 {
                let there = &q - &step * fraction;
                if let Some(new) = self.residual(&there)
                    && new.norm() < (1.0 - 1e-4 * fraction) * r.norm()
                {
                    q = there;
                    r = new;
                    moved = true;
                    break;
                }
                fraction *= 0.5;
            }
            if !moved {
                break;
            }
        }
        let residual = r.amax();
        (q, residual)
    }
}

impl ElasticBalls {
    fn check(&self) -> Result<(), ReferenceError> {
        within("grooves", self.grooves.len() as f64, 1.0, 2.0)?;
        within("friction", self.friction, 1e-3, 1.0)?;
        within("ball_friction", self.ball_friction, 0.0, 1.0)?;
        within("nut_speed", self.nut_speed, -1e6, 1e6)?;
        if self.nut_speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        self.grooves.iter().try_for_each(ElasticGrooves::check)
    }

    /// Balance without friction: places and axial displacement, by the least elastic energy.
    pub fn frictionless(&self, axial_load: f64) -> Result<(Vec<[f64; 2]>, f64), ReferenceError> {
        self.check()?;
        let load = within("axial_load", axial_load, -1e9, 1e9)?;
        let (positions, displacement, _) = self.elastic_start(load, [0.0; 2])?;
        Ok((positions, displacement))
    }

    /// Least energy with a constant in-plane force on every ball; the start of the solution with friction. Two balls share the load
    /// through one displacement of the screw: five unknowns.
    fn elastic_start(
        &self,
        load: f64,
        push: [f64; 2],
    ) -> Result<(Vec<[f64; 2]>, f64, f64), ReferenceError> {
        let n = self.grooves.len() as f64;
        let first = self.grooves.first().ok_or(ReferenceError::Undriven)?;
        let (travel, reach) =
            first.two_point_start(within("axial_load", load.abs(), 1e-9, 1e9)? / n * load.signum());
        let unit = reach;
        let energy = |y: &SMatrix<f64, 5, 1>| {
            let mut sum = Local {
                value: -load * unit * y[4],
                gradient: SMatrix::zeros(),
                hessian: SMatrix::zeros(),
            };
            sum.gradient[4] = -load * unit;
            for ball in 0..2 {
                let grooves = &self.grooves[ball.min(self.grooves.len() - 1)];
                let share = if self.grooves.len() == 1 { 0.5 } else { 1.0 };
                let index = [2 * ball, 2 * ball + 1, 4];
                let local = grooves.energy(&Vector3::new(y[index[0]], y[index[1]], y[4]), unit);
                let work = [push[0] * unit, push[1] * unit, 0.0];
                sum.value += share * (local.value - work[0] * y[index[0]] - work[1] * y[index[1]]);
                for i in 0..3 {
                    sum.gradient[index[i]] += share * (local.gradient[i] - work[i]);
                    for j in 0..3 {
                        sum.hessian[(index[i], index[j])] += share * local.hessian[(i, j)];
                    }
                }
            }
            sum
        };
        let middle = 0.5 * travel * first.track.lead_angle().1 / unit;
        let start = SMatrix::<f64, 5, 1>::from([0.0, middle, 0.0, middle, travel / unit]);
        let end = minimise(start, 1e-13 * load.abs() * unit, energy);
        let (y, residual) = (end.point, end.residual / unit);
        if residual.is_nan() || residual > 1e-4 * (load.abs() + push[0].hypot(push[1])) {
            return Err(ReferenceError::unbalanced(residual));
        }
        let positions = (0..self.grooves.len())
            .map(|b| [y[2 * b] * unit, y[2 * b + 1] * unit])
            .collect();
        Ok((positions, y[4] * unit, unit))
    }

    /// Each ball on its own (no force between the balls), under the given support.
    pub fn solve_apart(&self, support: ScrewSupport) -> Result<ElasticMotion, ReferenceError> {
        self.run(support, false)
    }

    /// The balls with their contact: apart when the front one is faster, pressing on each other otherwise.
    ///
    /// Newton's method on the `7 n` (and with contact one more) equations: in-plane balance, balance along the track and of moments of each
    /// ball, the screw's axial balance, equal orbital speeds. Starts from the frictionless balance with the friction forces of a pinned
    /// third contact; where a contact sticks, from friction smoothed at rest that is sharpened in steps down to 1e-5 of the nut's speed (at
    /// least 1e-3).
    ///
    /// Source: Lin 2019, eqs. (3.69) to (3.76). Corrected: (3.69) is lost in the text and rebuilt as six equations of balance per ball; for
    /// the front ball the outward part of the normal force does not reverse.
    pub fn solve(&self, support: ScrewSupport) -> Result<ElasticMotion, ReferenceError> {
        let apart = self.run(support, false)?;
        let [rear, front] = apart.balls.as_slice() else {
            return Ok(apart);
        };
        if rear.orbital_speed <= front.orbital_speed {
            return Ok(apart);
        }
        self.run(support, true)
    }

    fn run(&self, support: ScrewSupport, touching: bool) -> Result<ElasticMotion, ReferenceError> {
        self.check()?;
        let n = self.grooves.len();
        let load = match support {
            ScrewSupport::Load(load) => within("support", load, -1e9, 1e9)?,
            ScrewSupport::Displacement(u) => self.load_at(u)?,
        };
        if load == 0.0 {
            return Err(ReferenceError::Undriven);
        }
        let tolerance = 1e-12 * load.abs();
        let accept = 1e-7 * load.abs();
        let (cold, unit) = self.cold_start(load)?;
        let problem = |touching: bool, rest_spin: f64| Problem {
            balls: self,
            support,
            unit,
            touching,
            rest_spin,
        };
        let mut best = f64::INFINITY;
        let (mut q, mut residual) = problem(false, 0.0).solve(cold.clone(), tolerance);
        let mut rest_spin = 0.0;
        if residual > accept {
            // A contact sticks in the solution or in between: start with friction smoothed over a wide spin, and narrow it in steps from
            // which Newton's method still converges.
            rest_spin = 3.0;
            (q, residual) = problem(false, rest_spin).solve(cold, tolerance);
            let mut factor = 0.3;
            let mut refused = 0.0;
            while residual <= accept && rest_spin > FINEST && factor < 0.98 {
                let finer = f64::max(rest_spin * factor, FINEST);
                let (next, left) = problem(false, finer).solve(q.clone(), tolerance);
                if left <= accept {
                    (q, residual, rest_spin) = (next, left, finer);
                    factor = f64::max(factor * factor, 0.3);
                    let (exact, left) = problem(false, 0.0).solve(q.clone(), tolerance);
                    if rest_spin < 0.1 && left <= 1e-9 * load.abs() {
                        (q, residual, rest_spin) = (exact, left, 0.0);
                    }
                } else {
                    refused = left;
                    factor = factor.sqrt();
                }
            }
            if rest_spin > COARSEST {
                residual = f64::max(residual, refused);
            }
        }
        best = best.min(residual);
        if residual <= accept && touching {
            let joined = problem(true, rest_spin);
            let mut longer = DVector::zeros(joined.size());
            longer.rows_mut(0, q.len()).copy_from(&q);
            (q, residual) = joined.solve(longer, tolerance);
            best = residual;
        }
        if residual <= accept {
            return Ok(self.result(&problem(touching, rest_spin), &q, residual, n));
        }
        Err(ReferenceError::unbalanced(best))
    }

    /// Axial load without friction at a displacement of the screw, by bisection.
    fn load_at(&self, displacement: f64) -> Result<f64, ReferenceError> {
        within("support", displacement, -0.01, 0.01)?;
        let (mut low, mut high) = (1e-6_f64, 1e6_f64);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            let (_, u, _) = self.elastic_start(middle * displacement.signum(), [0.0; 2])?;
            if u.abs() < displacement.abs() {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok((low * high).sqrt() * displacement.signum())
    }

    fn cold_start(&self, load: f64) -> Result<(DVector<f64>, f64), ReferenceError> {
        let n = self.grooves.len();
        let first = self.grooves.first().ok_or(ReferenceError::Undriven)?;
        let angle = first.arc_angles.iter().sum::<f64>() / 4.0;
        let normal = load.abs() / n as f64 / (angle.sin() * first.track.lead_angle().1);
        // Both main contacts push the ball across towards the third contact: SL for SR-NL loads and a nut turning
        // forward, NL for SL-NR loads.
        let turn = self.nut_speed.signum();
        let push = 1.4 * self.friction * normal;
        let push = [
            push * turn * -angle.cos() * -load.signum(),
            push * turn * -angle.sin(),
        ];
        let (positions, displacement, unit) = self.elastic_start(load, push)?;
        let mut q = DVector::zeros(PER_BALL * n + 1);
        q[PER_BALL * n] = displacement / unit;
        for (ball, position) in positions.iter().enumerate() {
            q[PER_BALL * ball] = position[0] / unit;
            q[PER_BALL * ball + 1] = position[1] / unit;
            let grooves = &self.grooves[ball];
            let rows: Vec<_> = grooves
                .contacts_at(*position, displacement)
                .iter()
                .filter(|c| c.load > 0.0)
                .map(|c| ScrewRow::new(&grooves.track, *c))
                .collect::<Result<_, _>>()?;
            let (end, _) = ball_minimum(&rows, rolling(&grooves.track), false);
            q.rows_mut(PER_BALL * ball + 2, 4).copy_from(&end.point);
        }
        Ok((q, unit))
    }

    fn result(
        &self,
        problem: &Problem<'_>,
        q: &DVector<f64>,
        residual: f64,
        n: usize,
    ) -> ElasticMotion {
        let mut positions = Vec::with_capacity(n);
        let mut balls = Vec::with_capacity(n);
        for ball in 0..n {
            let y = Problem::motion_of(ball, q);
            positions.push([
                q[PER_BALL * ball] * problem.unit,
                q[PER_BALL * ball + 1] * problem.unit,
            ]);
            let rows = problem.rows_of(ball, q).unwrap_or_default();
            let track = &self.grooves[ball].track;
            let unbalanced = ball_dissipation(&rows, &y, problem.rest_spin)
                .gradient
                .amax();
            balls.push(dimensional(
                track,
                &rows,
                &y,
                problem.rest_spin,
                self.friction,
                self.nut_speed,
                unbalanced,
            ));
        }
        let contact_force = if problem.touching {
            q[PER_BALL * n + 1] * problem.stiffness()
        } else {
            0.0
        };
        let radius = self.grooves.first().map_or(0.0, |g| g.track.ball_radius);
        let ball_slip = if n == 2 {
            let slip = problem.slip_between(q);
            slip[0].hypot(slip[1]) * radius * self.nut_speed.abs()
        } else {
            0.0
        };
        ElasticMotion {
            positions,
            screw_displacement: q[PER_BALL * n] * problem.unit,
            balls,
            contact_force,
            ball_slip,
            ball_loss: self.ball_friction * contact_force * ball_slip,
            residual,
        }
    }
}
