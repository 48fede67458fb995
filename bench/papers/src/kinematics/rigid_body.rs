//! Slip from first principles: velocities of material points as derivatives of their positions.

use epas_reference::error::ReferenceError;
use epas_reference::kinematics::{KinematicsInput, Raceway};
use num_dual::{Dual64, DualNum};

type Vector<T> = [T; 3];

fn constant<T: DualNum<f64>>(vector: Vector<f64>) -> Vector<T> {
    vector.map(T::from)
}

fn sum<T: DualNum<f64>>(left: Vector<T>, right: Vector<T>) -> Vector<T> {
    let [a, b, c] = left;
    let [x, y, z] = right;
    [a + x, b + y, c + z]
}

fn dot(left: Vector<f64>, right: Vector<f64>) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

fn cross(left: Vector<f64>, right: Vector<f64>) -> Vector<f64> {
    let [a, b, c] = left;
    let [x, y, z] = right;
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn combine(factors: [f64; 3], basis: [Vector<f64>; 3]) -> Vector<f64> {
    std::array::from_fn(|i| factors.iter().zip(basis).map(|(f, e)| f * e[i]).sum())
}

/// `vector`, turned by `angle` about the fixed axis `Z`.
fn turn<T: DualNum<f64>>(angle: &T, vector: Vector<T>) -> Vector<T> {
    let (sine, cosine) = angle.sin_cos();
    let [x, y, z] = vector;
    [
        x.clone() * cosine.clone() - y.clone() * sine.clone(),
        x * sine + y * cosine,
        z,
    ]
}

/// `vector`, turned by `angle` about a unit `axis` (Rodrigues).
fn turn_about<T: DualNum<f64>>(axis: Vector<f64>, angle: &T, vector: Vector<f64>) -> Vector<T> {
    let (sine, cosine) = angle.sin_cos();
    let along = dot(axis, vector);
    let across = cross(axis, vector);
    std::array::from_fn(|i| {
        cosine.clone() * vector[i]
            + sine.clone() * across[i]
            + (-cosine.clone() + 1.0) * (along * axis[i])
    })
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
    /// Orbital and spin speed from the condition of rolling: no slip along the path at the distance
    /// `r'_k` from the ball's centre, at both contacts. Slip is linear in both speeds, so three
    /// evaluations give the two equations.
    ///
    /// At standstill there is nothing to solve; the speeds are those of 1 rad/s, scaled.
    ///
    /// # Errors
    /// The field of the input that the model cannot take.
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
    #[must_use]
    pub const fn orbital_speed(&self) -> f64 {
        self.orbital_speed
    }

    /// `omega_R`, rad/s.
    #[must_use]
    pub const fn spin_speed(&self) -> f64 {
        self.spin_speed
    }

    /// Tangent, normal (towards the axis) and binormal of the helix at the ball's angle 0.
    fn frame(&self) -> [Vector<f64>; 3] {
        let (sin_psi, cos_psi) = self.input.lead_angle.sin_cos();
        [
            [0.0, cos_psi, sin_psi],
            [-1.0, 0.0, 0.0],
            [0.0, -sin_psi, cos_psi],
        ]
    }

    /// Axes `x`, `y`, `z` of a contact in space at the ball's angle 0; (3).
    fn contact_axes(&self, raceway: Raceway) -> [Vector<f64>; 3] {
        let sign = raceway.sign();
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        let frame = self.frame();
        [
            combine([sign, 0.0, 0.0], frame),
            combine([0.0, sin_alpha, cos_alpha], frame),
            combine([0.0, -sign * cos_alpha, sign * sin_alpha], frame),
        ]
    }

    /// Position at `time` of the ball's centre: on the helix of the screw, which does not advance.
    fn centre<T: DualNum<f64>>(&self, time: &T) -> Vector<T> {
        let orbit = time.clone() * self.orbital_speed;
        let advance = self.input.advance() * (self.orbital_speed - self.input.speed);
        let [x, y, _] = turn(&orbit, constant([self.input.pitch_radius, 0.0, 0.0]));
        [x, y, time.clone() * advance]
    }

    /// Position at `time` of the ball's material point that is at `offset` from the centre at time 0.
    fn ball_point<T: DualNum<f64>>(&self, time: &T, offset: Vector<f64>) -> Vector<T> {
        let (sin_beta, cos_beta) = self.input.pitch_angle.sin_cos();
        let (sin_yaw, cos_yaw) = self.input.yaw_angle.sin_cos();
        let axis = combine(
            [cos_beta * sin_yaw, -sin_beta, -cos_beta * cos_yaw],
            self.frame(),
        );
        let turned = turn_about(axis, &(time.clone() * self.spin_speed), offset);
        let carried = turn(&(time.clone() * self.orbital_speed), turned);
        sum(self.centre(time), carried)
    }

    /// Position at `time` of the raceway's material point that is at `point` in space at time 0.
    fn raceway_point<T: DualNum<f64>>(
        &self,
        time: &T,
        raceway: Raceway,
        point: Vector<f64>,
    ) -> Vector<T> {
        let speed = self.input.speed;
        match raceway {
            Raceway::Screw => turn(&(time.clone() * speed), constant(point)),
            Raceway::Nut => {
                let [x, y, z] = constant(point);
                [x, y, z - time.clone() * (self.input.advance() * speed)]
            }
        }
    }

    /// Position at `time` of the point of the moving contact that is at `offset` at time 0.
    fn contact_point<T: DualNum<f64>>(&self, time: &T, offset: Vector<f64>) -> Vector<T> {
        let carried = turn(&(time.clone() * self.orbital_speed), constant(offset));
        sum(self.centre(time), carried)
    }

    /// From the ball's centre to a point of the contact, and from the screw's axis to it.
    fn place(&self, raceway: Raceway, x: f64, y: f64, distance: f64) -> [Vector<f64>; 2] {
        let offset = combine([x, y, -distance], self.contact_axes(raceway));
        let centre = [self.input.pitch_radius, 0.0, 0.0];
        [offset, sum(centre, offset)]
    }

    /// Position of the ball's and of the raceway's material point less that of the moving contact, at
    /// `time`, in space; all three coincide at time 0.
    #[must_use]
    pub fn separation(
        &self,
        raceway: Raceway,
        x: f64,
        y: f64,
        distance: f64,
        time: f64,
    ) -> [Vector<f64>; 2] {
        let [offset, point] = self.place(raceway, x, y, distance);
        let contact = self.contact_point(&time, offset);
        let ball = self.ball_point(&time, offset);
        let race = self.raceway_point(&time, raceway, point);
        [
            std::array::from_fn(|i| ball[i] - contact[i]),
            std::array::from_fn(|i| race[i] - contact[i]),
        ]
    }

    /// Velocity of the ball's and of the raceway's material point relative to the moving contact, in
    /// the contact frame, m/s: `(x, y, z)` each.
    #[must_use]
    pub fn surface_velocities(
        &self,
        raceway: Raceway,
        x: f64,
        y: f64,
        distance: f64,
    ) -> [Vector<f64>; 2] {
        let [offset, point] = self.place(raceway, x, y, distance);
        let time = Dual64::new(0.0, 1.0);
        let contact = self.contact_point(&time, offset);
        let axes = self.contact_axes(raceway);
        [
            self.ball_point(&time, offset),
            self.raceway_point(&time, raceway, point),
        ]
        .map(|body| {
            let velocity = std::array::from_fn(|i| body[i].eps - contact[i].eps);
            axes.map(|axis| dot(axis, velocity))
        })
    }

    /// Slip (ball minus raceway) in the contact frame at `(x, y, -distance)` from the centre, m/s.
    #[must_use]
    pub fn slip_at_distance(&self, raceway: Raceway, x: f64, y: f64, distance: f64) -> Vector<f64> {
        let [ball, race] = self.surface_velocities(raceway, x, y, distance);
        std::array::from_fn(|i| ball[i] - race[i])
    }

    /// Mean velocity of both surfaces relative to the moving contact at `(0, 0, -distance)`, m/s.
    #[must_use]
    pub fn entrainment(&self, raceway: Raceway, distance: f64) -> [f64; 2] {
        let [ball, race] = self.surface_velocities(raceway, 0.0, 0.0, distance);
        [0.5 * (ball[0] + race[0]), 0.5 * (ball[1] + race[1])]
    }
}
