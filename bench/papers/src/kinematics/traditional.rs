//! The formulation that Alberdi et al. revise.

use epas_reference::kinematics::Revised;
use epas_reference::kinematics::{KinematicsInput, Raceway};

/// Slip by the formula of Lin, Ravani and Velinsky 1994, which leaves the orbiting frame's rotation out of the ball's surface velocity.
///
/// Per rad/s of the screw: (26) without its second term, plus (29), minus (19) or (21).
///
/// It lets the ball turn by its rotation *relative* to the orbiting frame where the formula needs the *absolute* one, which is larger by
/// the orbital speed; [`Self::with_absolute_rotation`] puts that right and equals the revised formulation. For the screw of Alberdi et al.
/// its slip is three times the true one (2.9 at the screw, 3.4 at the nut), nearly all of it along the path, and side slip at the nut
/// vanishes where there is as much as at the screw. It stands here for comparison and must not feed wear or heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traditional {
    input: KinematicsInput,
    orbital_ratio: f64,
    /// In (tangent, normal, binormal).
    rotation: [f64; 3],
    distances: [f64; 2],
}

impl Traditional {
    /// As it is used: orbital and spin speed of Wei and Lin, (22) and (23) without the advance `L / (2 pi) sin psi` and with (23)
    /// corrected, and the rotation (27) *relative* to the orbiting frame.
    pub fn new(revised: &Revised) -> Self {
        let input = revised.input();
        let cos_psi = input.lead_angle.cos();
        let path = |raceway: Raceway| {
            let contact = input.contact(raceway);
            (input.pitch_radius
                - raceway.sign() * contact.rolling_radius * contact.contact_angle.cos())
                * cos_psi
                / (contact.rolling_radius * input.surface_speed_factor(raceway))
        };
        let (inner, outer) = (path(Raceway::Screw), path(Raceway::Nut));
        let spin_ratio = inner * outer / (inner + outer);
        let scale = spin_ratio / revised.spin_ratio();
        Self {
            input: *input,
            orbital_ratio: inner / (inner + outer),
            rotation: revised.rotation().map(|w| w * scale),
            distances: Raceway::BOTH.map(|raceway| revised.distance(raceway, 0.0)),
        }
    }

    /// The same formula fed with the revised speeds and the *absolute* rotation of the ball,
    /// `(omega_t + omega_m sin psi, omega_n, omega_b + omega_m cos psi)`: equal to the revised formulation, because what (26) adds is `omega_m e_Z x r`.
    #[cfg(test)]
    pub fn with_absolute_rotation(revised: &Revised) -> Self {
        let input = revised.input();
        let (sin_psi, cos_psi) = input.lead_angle.sin_cos();
        let orbital_ratio = revised.orbital_ratio();
        let [tangent, normal, binormal] = revised.rotation();
        Self {
            input: *input,
            orbital_ratio,
            rotation: [
                tangent + orbital_ratio * sin_psi,
                normal,
                binormal + orbital_ratio * cos_psi,
            ],
            distances: Raceway::BOTH.map(|raceway| revised.distance(raceway, 0.0)),
        }
    }

    /// `S_k` at the centre of a contact, m.
    pub const fn distance(&self, raceway: Raceway) -> f64 {
        match raceway {
            Raceway::Screw => self.distances[0],
            Raceway::Nut => self.distances[1],
        }
    }

    /// Velocities of ball and raceway in `(x, y)` at a point of the contact, per rad/s of the screw,
    /// m, the translation of the ball's centre taken off both.
    fn surfaces(&self, raceway: Raceway, x: f64, y: f64, distance: f64) -> [[f64; 2]; 2] {
        let sign = raceway.sign();
        let (sin_psi, cos_psi) = self.input.lead_angle.sin_cos();
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        let [tangent, normal, binormal] = self.rotation;
        let about_y = normal * sin_alpha + binormal * cos_alpha;
        let about_z = normal * cos_alpha - binormal * sin_alpha;
        let ball = [
            -distance * about_y + sign * y * about_z,
            sign * distance * tangent - sign * x * about_z,
        ];
        // (21) and (19) less the first term of (26).
        let radius = self.input.pitch_radius;
        let race = match raceway {
            Raceway::Screw => [
                (1.0 - self.orbital_ratio) * radius / cos_psi
                    - distance * cos_alpha * cos_psi
                    - y * cos_psi * sin_alpha,
                distance * sin_psi + x * cos_psi * sin_alpha,
            ],
            Raceway::Nut => [self.orbital_ratio * radius / cos_psi, 0.0],
        };
        [ball, race]
    }

    /// Slip `(x, y)` at a point of the contact whose surface lies `distance` from the ball's centre, m/s.
    pub fn slip(&self, raceway: Raceway, x: f64, y: f64, distance: f64) -> [f64; 2] {
        let [ball, race] = self.surfaces(raceway, x, y, distance);
        [0, 1].map(|i| self.input.speed * (ball[i] - race[i]))
    }

    pub fn spin(&self, raceway: Raceway) -> f64 {
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        let [_, normal, binormal] = self.rotation;
        let raceway_spin = match raceway {
            Raceway::Screw => self.input.lead_angle.cos() * sin_alpha,
            Raceway::Nut => 0.0,
        };
        let ball_spin = -raceway.sign() * (normal * cos_alpha - binormal * sin_alpha);
        self.input.speed * (ball_spin - raceway_spin)
    }

    /// Mean velocity of both surfaces at the centre, the translation of the ball's centre taken off, m/s.
    pub fn entrainment(&self, raceway: Raceway) -> [f64; 2] {
        let [ball, race] = self.surfaces(raceway, 0.0, 0.0, self.distance(raceway));
        [0, 1].map(|i| 0.5 * self.input.speed * (ball[i] + race[i]))
    }
}
