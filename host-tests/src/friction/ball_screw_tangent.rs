//! How the balance of a ball between elastic grooves changes with its place and its motion: derivatives in closed form.
//!
//! A contact's friction depends on the place through its load and through the direction of its normal. At equal velocities a load `N` changes
//! the power `P = N Phi(v1, v2, a w)` with `a` in proportion to `N^(1/3)`, so that for the forces `g = dP/dv` and the moment `m = dP/dw`
//!
//! `dg/dN = g/N + (dg/dw) w/(3 N)`, `dm/dN = 4 m/(3 N) + (dm/dw) w/(3 N)`.
//!
//! A turn of the normal changes the velocities at the contact, and turns friction along with it.

use nalgebra::{Matrix3, SMatrix, Vector3, Vector4};

use super::ball_screw_ball::ScrewRow;
use super::ball_screw_placed::{Balance, BallState, PlacedBall, normal};
use super::patch::PatchVelocity;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    pub balance: Balance,
    /// By the place over a unit of length, and by the motion, N.
    pub jacobian: SMatrix<f64, 7, 7>,
    /// Sum of the loads of all contacts, N.
    pub loads: f64,
}

struct Slope {
    gradient: Vector3<f64>,
    by_velocity: Matrix3<f64>,
    by_load: Vector3<f64>,
}

impl Slope {
    fn of(row: &ScrewRow, motion: &Vector4<f64>, rest_spin: f64) -> Self {
        let v = row.velocity(motion);
        let spin = v.z.hypot(rest_spin);
        let share = v.z / spin;
        let here = row.patch.friction_by(
            PatchVelocity {
                slip_major: v.x,
                slip_minor: v.y,
                spin,
            },
            row.integration,
        );
        let whole = Matrix3::from_fn(|i, j| here.hessian[i][j]);
        let [across, along, moment] = here.gradient;
        let per_load = 1.0 / row.contact.load;
        let growth = spin * per_load / 3.0;
        let mut by_velocity = whole;
        for k in 0..3 {
            by_velocity[(k, 2)] *= share;
            by_velocity[(2, k)] *= share;
        }
        by_velocity[(2, 2)] += moment * (rest_spin / spin).powi(2) / spin;
        Self {
            gradient: Vector3::new(across, along, moment * share),
            by_velocity,
            by_load: Vector3::new(
                across * per_load + whole[(0, 2)] * growth,
                along * per_load + whole[(1, 2)] * growth,
                share * (4.0 / 3.0 * moment * per_load + whole[(2, 2)] * growth),
            ),
        }
    }
}

impl PlacedBall<'_> {
    pub fn tangent(&self, state: &BallState, unit: f64) -> Option<Tangent> {
        let rows = self.rows_of(state)?;
        let cos_a = self.grooves.track.lead_angle().1;
        let mut sum = Tangent {
            balance: self.given(state),
            jacobian: SMatrix::zeros(),
            loads: 0.0,
        };
        for row in &rows {
            let screw = !row.contact.groove.on_nut();
            let load = row.contact.load;
            sum.loads += load;
            let slope = Slope::of(row, &state.motion, self.rest_spin);
            sum.balance += self.of_contact(row, load, &slope.gradient);
            let [nx, nz] = normal(row);
            // Friction turns with the normal, and so do the velocities.
            let turned = Turned::of(row, &state.motion, cos_a);
            let by_angle = slope.by_velocity * turned.velocity;
            let mut angle = self.of_contact(row, 0.0, &by_angle);
            angle += self.turned(row, load, &slope.gradient, &turned);
            let mut by_load = self.of_contact(row, 1.0, &slope.by_load);
            let law = if screw {
                self.grooves.screw
            } else {
                self.grooves.nut
            };
            let deflection = law.compliance * load.cbrt().powi(2);
            let length =
                self.grooves.offset(row.contact.groove) - self.grooves.oversize + deflection;
            by_load *= 1.5 * load / deflection * unit;
            angle *= unit / length;
            let moved = if screw { -cos_a } else { 0.0 };
            for (column, along, across) in [(0, nx, -nz), (1, nz, nx), (2, moved * nz, moved * nx)]
            {
                let mut column = sum.jacobian.column_mut(column);
                column += by_load * along + angle * across;
            }
            for column in 0..4 {
                let by_motion = slope.by_velocity * row.rows.column(column);
                let mut column = sum.jacobian.column_mut(3 + column);
                column += self.of_contact(row, 0.0, &by_motion);
            }
        }
        if let Some(alike) = &self.alike {
            let mut motion = sum.jacobian.fixed_columns_mut::<4>(3);
            motion += alike.by_motion(state);
        }
        let mut all = sum.balance.iter().chain(&sum.jacobian);
        all.all(|x| x.is_finite()).then_some(sum)
    }

    pub fn given(&self, state: &BallState) -> Balance {
        let mut rubbing = self.rubbing;
        if let Some(alike) = &self.alike {
            rubbing += alike.on_ball(state);
        }
        let [rub_x, rub_z] = rubbing.in_plane;
        let mut motion = rubbing.motion;
        motion[0] += self.path() * state.force;
        let mut all = Balance::zeros();
        all.fixed_rows_mut::<3>(0)
            .copy_from(&Vector3::new(rub_x, rub_z, -self.axial_load));
        all.fixed_rows_mut::<4>(3).copy_from(&motion);
        all
    }

    /// Forces of a contact: its load, and friction with a gradient for a friction coefficient of one.
    pub fn of_contact(&self, row: &ScrewRow, load: f64, gradient: &Vector3<f64>) -> Balance {
        let (sin_a, cos_a) = self.grooves.track.lead_angle();
        let [nx, nz] = normal(row);
        let across = -self.friction * self.direction * gradient.x;
        let along = -self.friction * self.direction * gradient.y;
        let mut all = Balance::zeros();
        all[0] = -load * nx + across * nz;
        all[1] = -load * nz - across * nx;
        if !row.contact.groove.on_nut() {
            all[2] = (-load * nz - across * nx) * cos_a + along * sin_a;
        }
        let motion = row.rows.transpose() * gradient * -self.friction;
        all.fixed_rows_mut::<4>(3).copy_from(&motion);
        all
    }

    fn turned(
        &self,
        row: &ScrewRow,
        load: f64,
        gradient: &Vector3<f64>,
        turned: &Turned,
    ) -> Balance {
        let cos_a = self.grooves.track.lead_angle().1;
        let [nx, nz] = normal(row);
        let across = -self.friction * self.direction * gradient.x;
        let mut all = Balance::zeros();
        all[0] = load * nz + across * nx;
        all[1] = -load * nx + across * nz;
        if !row.contact.groove.on_nut() {
            all[2] = all[1] * cos_a;
        }
        let motion = turned.rows.transpose() * gradient * -self.friction;
        all.fixed_rows_mut::<4>(3).copy_from(&motion);
        all
    }
}

struct Turned {
    rows: SMatrix<f64, 3, 4>,
    velocity: Vector3<f64>,
}

impl Turned {
    fn of(row: &ScrewRow, motion: &Vector4<f64>, cos_a: f64) -> Self {
        let [nx, nz] = normal(row);
        // Of `ScrewRow::new`: the normal turns from x to z.
        let rows = SMatrix::<f64, 3, 4>::new(
            0.0, 0.0, 0.0, 0.0, //
            0.0, -nx, 0.0, -nz, //
            0.0, -nz, 0.0, nx,
        );
        let nut = if row.contact.groove.on_nut() {
            cos_a
        } else {
            0.0
        };
        Self {
            rows,
            velocity: Vector3::new(0.0, nut * nz, -nut * nx) + rows * motion,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ball_screw_grooves::ElasticGrooves;
    use super::super::ball_screw_placed::{BallState, Drive, PlacedBall};
    use super::super::ball_screw_settle::settle;
    use super::super::patch::Integration;
    use crate::design::BallScrewDesign;
    use nalgebra::{SVector, Vector4};

    /// Against central differences of the balance, of a ball with three contacts and of one with four, both ways of the nut, off balance.
    #[test]
    fn derivatives_are_those_of_the_balance() {
        for (clearance, direction, load) in
            [(0.0, 1.0, -50.0), (-3e-6, -1.0, 40.0), (2e-6, 1.0, 60.0)]
        {
            const SCREW: BallScrewDesign = BallScrewDesign::LIN;
            let grooves = ElasticGrooves::of(&SCREW, clearance).unwrap();
            let grooves = grooves.turned(0.02, -0.01);
            let ball = PlacedBall::alone(&grooves, 0.1, direction, load, Integration::Full);
            let settled = settle(&ball, Drive::Force(0.3), None).unwrap().state;
            let unit = 1e-6;
            let state = BallState {
                motion: settled.motion + Vector4::new(1e-3, 3e-3, -2e-3, 5e-3),
                place: settled.place * 1.01,
                ..settled
            };
            let found = ball.tangent(&state, unit).unwrap();
            let at = |change: &SVector<f64, 7>| {
                let mut there = state;
                there.place += change.fixed_rows::<3>(0) * unit;
                there.motion += change.fixed_rows::<4>(3);
                ball.tangent(&there, unit).unwrap().balance
            };
            let largest = found.jacobian.amax();
            for column in 0..7 {
                let step = 1e-5 * SVector::<f64, 7>::ith(column, 1.0);
                let differences = (at(&step) - at(&-step)) / 2e-5;
                let off = (differences - found.jacobian.column(column)).amax();
                assert!(
                    off < 1e-6 * largest,
                    "{clearance} {column}: {off:e} of {largest:e}"
                );
            }
        }
    }
}
