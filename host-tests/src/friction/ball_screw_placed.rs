//! One ball of a ball screw between elastic grooves: its place, its motion and its loads together, under its own axial load.
//!
//! Seven equations: forces on the ball in its cross section (two), the axial force of the screw, the force along the track and three
//! moments (the gradient of the dissipation by the ball's motion). Seven unknowns: ball centre in the cross section (two), axial
//! displacement of the screw, angular velocity (three), and the orbital speed for a given force along the track, or that force for a given
//! speed.
//!
//! Source: Lin 2019, eqs. (2.11) to (2.14), (3.65) to (3.69).

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector3, Vector4};

use super::ball_screw_ball::{Groove, ScrewRow};
use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_rubbing::BallContact;
use super::patch::Integration;

/// Spin over which friction of a contact that sticks is smoothed, over the nut's speed.
pub(crate) const STICK_SPIN: f64 = 1e-4;

/// Forces on a ball from its neighbours' rubbing, over which the ball has no say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rubbing {
    /// Force in the cross section, x and z, N.
    pub in_plane: [f64; 2],
    /// Force along the track times path radius over ball radius, and moments over the ball radius, N; power per `R_B w_N` of the motion.
    pub motion: Vector4<f64>,
}

impl std::ops::AddAssign for Rubbing {
    fn add_assign(&mut self, other: Self) {
        self.in_plane[0] += other.in_plane[0];
        self.in_plane[1] += other.in_plane[1];
        self.motion += other.motion;
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drive {
    /// Force of the neighbours on the ball in the direction of orbiting, N.
    Force(f64),
    /// Orbital speed over the nut's speed.
    Speed(f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BallState {
    /// Ball centre x, z, and axial displacement of the screw, m.
    pub place: Vector3<f64>,
    /// Orbital speed and angular velocity x, y, z, over the nut's speed.
    pub motion: Vector4<f64>,
    /// What the motion is more than `motion`: a part smaller than its last digit, which a contact at rest answers with 1e-9 of its load.
    pub remainder: Vector4<f64>,
    /// Force of the neighbours on the ball in the direction of orbiting, N.
    pub force: f64,
}

impl BallState {
    pub fn new(place: Vector3<f64>, motion: Vector4<f64>, force: f64) -> Self {
        Self {
            place,
            motion,
            remainder: Vector4::zeros(),
            force,
        }
    }

    /// The state on a straight line from `before` through this one, `share` of their distance beyond it.
    pub fn beyond(&self, before: &Self, share: f64) -> Self {
        Self::new(
            self.place + (self.place - before.place) * share,
            self.motion + (self.motion - before.motion) * share,
            self.force + (self.force - before.force) * share,
        )
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Solved {
    pub state: BallState,
    /// Largest unbalanced force, N.
    pub residual: f64,
    /// Change of the force along the track with the orbital speed over the nut's speed, N.
    pub stiffness: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedBall<'a> {
    pub grooves: &'a ElasticGrooves,
    /// Friction coefficient of the grooves.
    pub friction: f64,
    pub direction: f64,
    /// Axial force of the screw on the ball, N; positive along z.
    pub axial_load: f64,
    /// From the neighbours, whatever the ball does.
    pub rubbing: Rubbing,
    /// Neighbours that move as the ball does, whose friction follows its motion.
    pub alike: Option<AlikeNeighbours>,
    pub integration: Integration,
    /// Spin over which friction of a contact that sticks is smoothed, over the nut's speed: [`STICK_SPIN`], or larger on the path to it.
    pub rest_spin: f64,
}

/// Two neighbours that move as the ball itself does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AlikeNeighbours {
    /// A contact of two balls, with a friction coefficient of one.
    pub contact: BallContact,
    /// Friction forces of the ball behind and of the one ahead, N.
    pub friction: [f64; 2],
    /// Outward force of both, N.
    pub outward: f64,
}

/// Slip over `R_B w_N` below which friction of alike neighbours is smoothed.
const STICK_SLIP: f64 = 1e-7;

impl AlikeNeighbours {
    fn slip(&self, state: &BallState) -> (Vector2<f64>, f64) {
        let slip = self.contact.slip(state, state);
        let size = slip.norm().hypot(STICK_SLIP);
        (slip / size, size)
    }

    fn rubbing(&self, direction: Vector2<f64>) -> Rubbing {
        let [behind, ahead] = self.friction;
        let [_, mut sum] = self.contact.rubbing(behind, direction);
        let [on_rear, _] = self.contact.rubbing(ahead, direction);
        sum += on_rear;
        sum
    }

    pub fn on_ball(&self, state: &BallState) -> Rubbing {
        let mut sum = self.rubbing(self.slip(state).0);
        sum.in_plane[0] += self.outward;
        sum
    }

    /// How that changes with the motion: columns of orbital speed and angular velocity.
    pub fn by_motion(&self, state: &BallState) -> SMatrix<f64, 7, 4> {
        let (direction, size) = self.slip(state);
        let turn = (Matrix2::identity() - direction * direction.transpose()) / size;
        let mut all = SMatrix::<f64, 7, 4>::zeros();
        for column in 0..4 {
            let moved = BallState::new(state.place, Vector4::ith(column, 1.0), 0.0);
            let change = self.rubbing(turn * self.contact.slip(&moved, &moved));
            let [x, z] = change.in_plane;
            all[(0, column)] = x;
            all[(1, column)] = z;
            all.fixed_view_mut::<4, 1>(3, column)
                .copy_from(&change.motion);
        }
        all
    }
}

/// Unbalanced forces, N: x, z, axial, along the track (times path over ball radius), moments over the ball radius.
pub(crate) type Balance = SVector<f64, 7>;

impl<'a> PlacedBall<'a> {
    /// A ball without friction of neighbours.
    pub fn alone(
        grooves: &'a ElasticGrooves,
        friction: f64,
        direction: f64,
        axial_load: f64,
        integration: Integration,
    ) -> Self {
        Self {
            grooves,
            friction,
            direction,
            axial_load,
            rubbing: Rubbing::default(),
            alike: None,
            integration,
            rest_spin: STICK_SPIN,
        }
    }

    /// Path radius over ball radius.
    pub fn path(&self) -> f64 {
        let track = &self.grooves.track;
        track.path_radius() / track.ball_radius
    }

    pub fn rows(&self, place: &Vector3<f64>) -> Option<Vec<ScrewRow>> {
        self.grooves
            .contacts_at([place.x, place.y], place.z)
            .into_iter()
            .filter(|contact| contact.load > 0.0)
            .map(|contact| {
                let row = ScrewRow::new(&self.grooves.track, contact).ok()?;
                Some(ScrewRow {
                    integration: self.integration,
                    ..row
                })
            })
            .collect()
    }

    pub fn rows_of(&self, state: &BallState) -> Option<Vec<ScrewRow>> {
        let mut rows = self.rows(&state.place)?;
        for row in &mut rows {
            row.remainder = row.rows * state.remainder;
        }
        Some(rows)
    }

    /// Friction on the ball: x, z, and the part of it that the screw takes up along its axis, N.
    pub fn friction_in_plane(&self, rows: &[ScrewRow], motion: &Vector4<f64>) -> Vector3<f64> {
        let (sin_a, cos_a) = self.grooves.track.lead_angle();
        let mut sum = Vector3::zeros();
        for row in rows {
            let [nx, nz] = normal(row);
            let gradient = row.local(motion, self.rest_spin).gradient;
            let (across, along) = (
                -self.friction * self.direction * gradient.x,
                -self.friction * self.direction * gradient.y,
            );
            sum += Vector3::new(across * nz, -across * nx, 0.0);
            if !row.contact.groove.on_nut() {
                sum.z += along * sin_a - across * nx * cos_a;
            }
        }
        sum
    }

    pub fn balance(&self, state: &BallState) -> Option<Balance> {
        let mut all = self.given(state);
        for row in &self.rows_of(state)? {
            let gradient = row.local(&state.motion, self.rest_spin).gradient;
            all += self.of_contact(row, row.contact.load, &gradient);
        }
        all.iter().all(|x| x.is_finite()).then_some(all)
    }

    /// Residual that rounding leaves, and the largest that is accepted, N: in proportion to the loads of all contacts.
    pub fn accuracy(&self, state: &BallState) -> (f64, f64) {
        let loads: f64 = self
            .grooves
            .contacts_at([state.place.x, state.place.y], state.place.z)
            .iter()
            .map(|contact| contact.load)
            .sum();
        (1e-13 * loads, 1e-8 * loads)
    }

    /// Loads SL, SR, NL, NR at a place, N.
    pub fn loads(&self, place: &Vector3<f64>) -> [f64; 4] {
        self.grooves
            .contacts_at([place.x, place.y], place.z)
            .map(|contact| contact.load)
    }

    /// Power that the nut puts in over `R_B w_N`, N: by its surface's velocity and spin at each of its contacts.
    pub fn power_in(&self, rows: &[ScrewRow], motion: &Vector4<f64>) -> f64 {
        rows.iter()
            .filter(|row| row.contact.groove.on_nut())
            .map(|row| self.friction * row.local(motion, self.rest_spin).gradient.dot(&row.base))
            .sum()
    }
}

/// Direction from ball centre to contact, x and z.
pub(crate) fn normal(row: &ScrewRow) -> [f64; 2] {
    let (sx, sz) = row.contact.groove.signs();
    let angle = row.contact.contact_angle;
    [sx * angle.cos(), sz * angle.sin()]
}

/// Direction from ball centre to the nut's contact that carries an axial load, with the arcs' mean angle.
pub(crate) fn main_direction(grooves: &ElasticGrooves, axial_load: f64) -> [f64; 2] {
    let angle = grooves.arc_angles.iter().sum::<f64>() / 4.0;
    let nut = if axial_load > 0.0 {
        Groove::NutRight
    } else {
        Groove::NutLeft
    };
    let (sx, sz) = nut.signs();
    [sx * angle.cos(), sz * angle.sin()]
}
