//! Slip from first principles: velocities of material points as derivatives of their positions.

use epas_reference::error::ReferenceError;
use epas_reference::kinematics::{KinematicsInput, Raceway};
use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual64, DualNum};

type Vector = Vector3<f64>;

/// `vector`, turned by `angle` about the fixed axis `Z`.
fn turn<T: DualNum<f64> + Copy>(angle: T, vector: [T; 3]) -> [T; 3] {
    let (sine, cosine) = angle.sin_cos();
    let [x, y, z] = vector;
    [x * cosine - y * sine, x * sine + y * cosine, z]
}

/// `vector`, turned by `angle` about a unit `axis` (Rodrigues).
fn turn_about<T: DualNum<f64> + Copy>(axis: Vector, angle: T, vector: Vector) -> [T; 3] {
    let (sine, cosine) = angle.sin_cos();
    let along = axis * axis.dot(&vector);
    let across = axis.cross(&vector);
    [0, 1, 2].map(|i| cosine * (vector[i] - along[i]) + sine * across[i] + along[i])
}

fn plus<T: DualNum<f64> + Copy>(left: [T; 3], right: [T; 3]) -> [T; 3] {
    [0, 1, 2].map(|i| left[i] + right[i])
}

fn constant<T: DualNum<f64>>(vector: Vector) -> [T; 3] {
    [0, 1, 2].map(|i| T::from(vector[i]))
}

/// Three rigid bodies: a screw that turns, a nut that advances, a ball that follows the helix between
/// them and turns about an axis that orbits with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    input: KinematicsInput,
    orbital_speed: f64,
    spin_speed: f64,
}

impl RigidBody {
    /// Orbital and spin speed from the condition of rolling: no slip along the path at the distance `r'_k` from the ball's centre, at both
    /// contacts. Slip is linear in both speeds, so three evaluations give the two equations.
    ///
    /// At standstill there is nothing to solve; the speeds are those of 1 rad/s, scaled.
    pub fn new(input: &KinematicsInput) -> Result<Self, ReferenceError> {
        input.validate()?;
        let unit = KinematicsInput {
            speed: 1.0,
            ..*input
        };
        let trial = |orbital_speed, spin_speed| {
            let body = Self {
                input: unit,
                orbital_speed,
                spin_speed,
            };
            Raceway::BOTH.map(|raceway| {
                let distance = unit.contact(raceway).rolling_radius;
                body.slip_at_distance(raceway, 0.0, 0.0, distance)[0]
            })
        };
        let still = trial(0.0, 0.0);
        let orbiting = trial(1.0, 0.0);
        let spinning = trial(0.0, 1.0);
        let [a, c] = [orbiting[0] - still[0], orbiting[1] - still[1]];
        let [b, d] = [spinning[0] - still[0], spinning[1] - still[1]];
        let determinant = a * d - b * c;
        Ok(Self {
            input: *input,
            orbital_speed: input.speed * (b * still[1] - d * still[0]) / determinant,
            spin_speed: input.speed * (c * still[0] - a * still[1]) / determinant,
        })
    }

    /// `omega_m`, rad/s.
    pub const fn orbital_speed(&self) -> f64 {
        self.orbital_speed
    }

    /// `omega_R`, rad/s.
    pub const fn spin_speed(&self) -> f64 {
        self.spin_speed
    }

    /// Tangent, normal (towards the axis) and binormal of the helix at the ball's angle 0, as columns; (1), (2).
    fn frame(&self) -> Matrix3<f64> {
        let (sin_psi, cos_psi) = self.input.lead_angle.sin_cos();
        Matrix3::new(
            0.0, -1.0, 0.0, cos_psi, 0.0, -sin_psi, sin_psi, 0.0, cos_psi,
        )
    }

    /// Axes `x`, `y`, `z` of a contact in space at the ball's angle 0, as columns; (3).
    fn contact_axes(&self, raceway: Raceway) -> Matrix3<f64> {
        let sign = raceway.sign();
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        self.frame()
            * Matrix3::new(
                sign,
                0.0,
                0.0,
                0.0,
                sin_alpha,
                -sign * cos_alpha,
                0.0,
                cos_alpha,
                sign * sin_alpha,
            )
    }

    /// Position at `time` of the ball's centre: on the helix of the screw, which does not advance.
    fn centre<T: DualNum<f64> + Copy>(&self, time: T) -> [T; 3] {
        let advance = self.input.advance() * (self.orbital_speed - self.input.speed);
        let start = [
            T::from(self.input.pitch_radius),
            T::from(0.0),
            time * advance,
        ];
        turn(time * self.orbital_speed, start)
    }

    /// Position at `time` of the ball's material point that is at `offset` from the centre at time 0.
    fn ball_point<T: DualNum<f64> + Copy>(&self, time: T, offset: Vector) -> [T; 3] {
        let (sin_beta, cos_beta) = self.input.pitch_angle.sin_cos();
        let (sin_yaw, cos_yaw) = self.input.yaw_angle.sin_cos();
        let axis = Vector::new(cos_beta * sin_yaw, -sin_beta, -cos_beta * cos_yaw);
        let turned = turn_about(self.frame() * axis, time * self.spin_speed, offset);
        plus(self.centre(time), turn(time * self.orbital_speed, turned))
    }

    /// Position at `time` of the raceway's material point that is at `point` in space at time 0.
    fn raceway_point<T: DualNum<f64> + Copy>(
        &self,
        time: T,
        raceway: Raceway,
        point: Vector,
    ) -> [T; 3] {
        let speed = self.input.speed;
        match raceway {
            Raceway::Screw => turn(time * speed, constant(point)),
            Raceway::Nut => {
                let [x, y, z] = constant(point);
                [x, y, z - time * (self.input.advance() * speed)]
            }
        }
    }

    /// Positions at `time` of the ball's and of the raceway's material point less that of the moving contact, in space; all three
    /// coincide at time 0; (11)-(13), (16).
    fn moved<T: DualNum<f64> + Copy>(
        &self,
        raceway: Raceway,
        (x, y, distance): (f64, f64, f64),
        time: T,
    ) -> [[T; 3]; 2] {
        let offset = self.contact_axes(raceway) * Vector::new(x, y, -distance);
        let point = Vector::new(self.input.pitch_radius, 0.0, 0.0) + offset;
        let carried = turn(time * self.orbital_speed, constant(offset));
        let contact = plus(self.centre(time), carried);
        [
            self.ball_point(time, offset),
            self.raceway_point(time, raceway, point),
        ]
        .map(|body| [0, 1, 2].map(|i| body[i] - contact[i]))
    }

    /// Velocity of the ball's and of the raceway's material point relative to the moving contact, in the contact frame, m/s:
    /// `(x, y, z)` each.
    pub fn surface_velocities(
        &self,
        raceway: Raceway,
        x: f64,
        y: f64,
        distance: f64,
    ) -> [[f64; 3]; 2] {
        let axes = self.contact_axes(raceway);
        let moved = self.moved(raceway, (x, y, distance), Dual64::new(0.0, 1.0));
        moved.map(|body| axes.tr_mul(&Vector::from(body.map(|part| part.eps))).into())
    }

    /// Slip (ball minus raceway) in the contact frame at `(x, y, -distance)` from the centre, m/s.
    pub fn slip_at_distance(&self, raceway: Raceway, x: f64, y: f64, distance: f64) -> [f64; 3] {
        let [ball, race] = self.surface_velocities(raceway, x, y, distance);
        [0, 1, 2].map(|i| ball[i] - race[i])
    }

    /// Mean velocity of both surfaces relative to the moving contact at `(0, 0, -distance)`, m/s.
    pub fn entrainment(&self, raceway: Raceway, distance: f64) -> [f64; 2] {
        let [ball, race] = self.surface_velocities(raceway, 0.0, 0.0, distance);
        [0.5 * (ball[0] + race[0]), 0.5 * (ball[1] + race[1])]
    }
}
