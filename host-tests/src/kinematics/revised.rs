//! Alberdi et al., eqs. (12) to (40).

use super::input::{KinematicsInput, Raceway};
use super::slip::{BallKinematics, ContactKinematics};
use crate::error::ReferenceError;

/// The revised formulation for one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Revised {
    input: KinematicsInput,
    /// `omega_m / omega`, from (22).
    orbital_ratio: f64,
    /// `omega_R / omega`, from (23), corrected.
    spin_ratio: f64,
}

impl Revised {
    /// Orbital and spin speed for an input.
    ///
    /// (22) as printed. **(23) is corrected:** the condition that rolling slip vanishes at `r'_i` is `omega_R = (omega - omega_m) A_i /
    /// (r'_i b_i)`; printed is `omega_m` in place of `omega - omega_m`.
    pub fn new(input: &KinematicsInput) -> Result<Self, ReferenceError> {
        input.validate()?;
        let path = |raceway| input.rolling_path(raceway);
        let factor = |raceway| input.surface_speed_factor(raceway);
        let (inner, outer) = (Raceway::Screw, Raceway::Nut);
        let orbital_ratio = 1.0
            / (1.0
                + (input.rolling_radius_screw * path(outer) * factor(inner))
                    / (input.rolling_radius_nut * path(inner) * factor(outer)));
        let spin_ratio =
            (1.0 - orbital_ratio) * path(inner) / (input.rolling_radius_screw * factor(inner));
        Ok(Self {
            input: *input,
            orbital_ratio,
            spin_ratio,
        })
    }

    /// The input.
    pub const fn input(&self) -> &KinematicsInput {
        &self.input
    }

    /// `omega_m / omega`.
    pub const fn orbital_ratio(&self) -> f64 {
        self.orbital_ratio
    }

    /// `omega_R / omega`.
    pub const fn spin_ratio(&self) -> f64 {
        self.spin_ratio
    }

    /// The ball's rotation relative to the orbiting frame, in (tangent, normal, binormal), per rad/s of the screw: (27).
    pub fn rotation(&self) -> [f64; 3] {
        let (sin_beta, cos_beta) = self.input.pitch_angle.sin_cos();
        let (sin_yaw, cos_yaw) = self.input.yaw_angle.sin_cos();
        [
            self.spin_ratio * cos_beta * sin_yaw,
            -self.spin_ratio * sin_beta,
            -self.spin_ratio * cos_beta * cos_yaw,
        ]
    }

    /// `omega_k / omega`: `omega_i = omega_m - omega`, `omega_o = -omega_m`; below (31).
    fn frame_ratio(&self, raceway: Raceway) -> f64 {
        match raceway {
            Raceway::Screw => self.orbital_ratio - 1.0,
            Raceway::Nut => -self.orbital_ratio,
        }
    }

    /// `D/2 - S_k(y)`, m: (14) and (15), each difference of roots as a quotient that does not cancel.
    fn deficit(&self, raceway: Raceway, y: f64) -> f64 {
        let contact = self.input.contact(raceway);
        let diameter = self.input.ball_diameter;
        let half = 0.5 * diameter;
        let deformed =
            2.0 * contact.groove_radius * diameter / (2.0 * contact.groove_radius + diameter);
        let sagitta = |radius: f64, chord: f64| {
            chord * chord / (radius + (radius * radius - chord * chord).sqrt())
        };
        sagitta(half, contact.semi_major) - sagitta(deformed, contact.semi_major)
            + sagitta(deformed, y)
    }

    /// `S_k(y)`, m: (14).
    pub fn distance(&self, raceway: Raceway, y: f64) -> f64 {
        0.5 * self.input.ball_diameter - self.deficit(raceway, y)
    }

    /// `omega_n sin alpha_k + omega_b cos alpha_k`, per rad/s of the screw.
    fn about_y(&self, raceway: Raceway) -> f64 {
        let [_, normal, binormal] = self.rotation();
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        normal * sin_alpha + binormal * cos_alpha
    }

    /// Rolling slip per rad/s of the screw, m.
    ///
    /// (31) is linear in `S` and, by (22) and (23), zero at `S = r'_k`. It is evaluated from that zero, as `(r'_k - S)` times its slope,
    /// because the printed difference of two nearly equal speeds loses three digits.
    pub fn rolling_slip(&self, raceway: Raceway, y: f64) -> f64 {
        self.inside_rolling_radius(raceway, y) * self.rolling_gradient(raceway)
    }

    /// `r'_k - S_k(y)`, m.
    pub fn inside_rolling_radius(&self, raceway: Raceway, y: f64) -> f64 {
        let contact = self.input.contact(raceway);
        (contact.rolling_radius - 0.5 * self.input.ball_diameter) + self.deficit(raceway, y)
    }

    /// Slope of (31) in `-S_k`, per rad/s of the screw.
    pub fn rolling_gradient(&self, raceway: Raceway) -> f64 {
        raceway.sign()
            * self.frame_ratio(raceway)
            * self.input.contact(raceway).contact_angle.cos()
            * self.input.lead_angle.cos()
            + self.about_y(raceway)
    }

    /// Side slip per rad/s of the screw, m: (32), with `omega_t` for the misprinted `omega_l`.
    pub fn side_slip(&self, raceway: Raceway, y: f64) -> f64 {
        self.distance(raceway, y) * self.side_gradient(raceway)
    }

    /// Side slip over `S_k`, per rad/s of the screw.
    pub fn side_gradient(&self, raceway: Raceway) -> f64 {
        let [tangent, _, _] = self.rotation();
        self.frame_ratio(raceway) * self.input.lead_angle.sin() + raceway.sign() * tangent
    }

    /// Spin per rad/s of the screw: (34).
    pub fn spin(&self, raceway: Raceway) -> f64 {
        let [_, normal, binormal] = self.rotation();
        let (sin_alpha, cos_alpha) = self.input.contact(raceway).contact_angle.sin_cos();
        self.frame_ratio(raceway) * self.input.lead_angle.cos() * sin_alpha
            - raceway.sign() * (normal * cos_alpha - binormal * sin_alpha)
    }

    /// Slip `(x, y)` at a point of the contact, m/s: (30) with (31) to (34).
    pub fn slip(&self, raceway: Raceway, x: f64, y: f64) -> [f64; 2] {
        let spin = self.spin(raceway);
        [
            self.input.speed * (self.rolling_slip(raceway, y) - spin * y),
            self.input.speed * (self.side_slip(raceway, y) + spin * x),
        ]
    }

    /// Entrainment velocity at the centre per rad/s of the screw, m, with the sign of (36): against
    /// the mean velocity of the surfaces in the frame of the moving contact.
    pub fn entrainment(&self, raceway: Raceway) -> [f64; 2] {
        let [tangent, _, _] = self.rotation();
        let distance = self.distance(raceway, 0.0);
        let (sin_psi, cos_psi) = self.input.lead_angle.sin_cos();
        let cos_alpha = self.input.contact(raceway).contact_angle.cos();
        let sign = raceway.sign();
        let frame = self.frame_ratio(raceway);
        [
            0.5 * (frame
                * (self.input.pitch_radius / cos_psi - sign * distance * cos_alpha * cos_psi)
                + distance * self.about_y(raceway)),
            0.5 * (frame * distance * sin_psi - sign * tangent * distance),
        ]
    }

    /// Everything at the contact centres.
    ///
    /// **(37) and (39)** print an arc tangent of a quotient; taken here is atan2, of the reversed components of (36) for the entrainment
    /// angle. The ratios come from the coefficients per rad/s, so that they exist at standstill.
    pub fn evaluate(&self) -> BallKinematics {
        let speed = self.input.speed;
        BallKinematics {
            orbital_speed: self.orbital_ratio * speed,
            spin_speed: self.spin_ratio * speed,
            screw: self.at_centre(Raceway::Screw),
            nut: self.at_centre(Raceway::Nut),
        }
    }

    fn at_centre(&self, raceway: Raceway) -> ContactKinematics {
        let contact = self.input.contact(raceway);
        let speed = self.input.speed;
        let rolling = self.rolling_slip(raceway, 0.0);
        let side = self.side_slip(raceway, 0.0);
        let spin = self.spin(raceway);
        let [v_x, v_y] = self.entrainment(raceway);
        let entrainment = v_x.hypot(v_y);
        let sliding = rolling.hypot(side);
        ContactKinematics {
            rolling_slip: speed * rolling,
            side_slip: speed * side,
            spin: speed * spin,
            entrainment_speed: speed.abs() * entrainment,
            entrainment_angle: (-v_y).atan2(-v_x),
            slide_to_roll: sliding / entrainment,
            // Adding zero turns -0 into +0, so that the angle of slip straight back is pi, not -pi.
            slide_angle: (sliding > 0.0).then(|| (side + 0.0).atan2(rolling)),
            spin_to_roll: spin * (contact.semi_major * contact.semi_minor).sqrt() / entrainment,
        }
    }

    /// Slip in three components (contact frame) at a point, m/s, by the paper's vectors: ball (26) + (29) minus nut (19) or screw (21).
    ///
    /// **(26) is corrected:** its second term's third component reads
    /// `-x cos psi cos alpha +- y sin psi`; printed is `-+ x cos psi cos alpha`.
    pub fn slip_by_vectors(&self, raceway: Raceway, x: f64, y: f64) -> [f64; 3] {
        let input = &self.input;
        let contact = input.contact(raceway);
        let sign = raceway.sign();
        let distance = self.distance(raceway, y);
        let (sin_psi, cos_psi) = input.lead_angle.sin_cos();
        let (sin_alpha, cos_alpha) = contact.contact_angle.sin_cos();
        let radius = input.pitch_radius;
        let (omega, omega_m) = (input.speed, self.orbital_ratio * input.speed);
        let [tangent, normal, binormal] = self.rotation().map(|w| w * input.speed);

        let centre = [
            sign * (omega_m - omega) * radius / cos_psi + sign * omega * radius * cos_psi,
            -omega * radius * cos_alpha * sin_psi,
            -sign * omega * radius * sin_alpha * sin_psi,
        ];
        let offset = [
            -distance * cos_alpha * cos_psi - sign * y * sin_alpha * cos_psi,
            sign * distance * sin_psi + sign * x * sin_alpha * cos_psi,
            -x * cos_psi * cos_alpha + sign * y * sin_psi,
        ];
        let about_y = normal * sin_alpha + binormal * cos_alpha;
        let about_z = normal * cos_alpha - binormal * sin_alpha;
        let rotation = [
            -distance * about_y + sign * y * about_z,
            sign * distance * tangent - sign * x * about_z,
            sign * y * tangent - x * about_y,
        ];
        let raceway_velocity = match raceway {
            Raceway::Screw => [
                omega * ((radius - distance * cos_alpha) * cos_psi - y * cos_psi * sin_alpha),
                omega * ((distance - radius * cos_alpha) * sin_psi + x * cos_psi * sin_alpha),
                omega * (-radius * sin_alpha * sin_psi - x * cos_psi * cos_alpha + y * sin_psi),
            ],
            Raceway::Nut => {
                let advance = input.advance() * omega;
                [
                    advance * sin_psi,
                    -advance * cos_alpha * cos_psi,
                    advance * sin_alpha * cos_psi,
                ]
            }
        };
        std::array::from_fn(|i| centre[i] + omega_m * offset[i] + rotation[i] - raceway_velocity[i])
    }
}
