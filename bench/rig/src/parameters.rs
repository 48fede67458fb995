//! What a rig's screw is like: everything that a calibration may want to find.

use std::f64::consts::{FRAC_PI_4, TAU};

use epas_reference::coefficient::Vogel;
use epas_reference::curvature::Groove;
use epas_reference::design::BallScrewDesign;
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::RollingResistance;
use epas_reference::material::Elastic;

/// Screw with its fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Drawing.
    pub design: BallScrewDesign,
    /// Balls that carry, 1 to 1e4.
    pub balls: f64,
    /// Axial force of each flank of the nut without a load, N, 0 to 1e5: balls are larger than their grooves. 0 is
    /// neither play nor preload.
    pub axial_preload: f64,
    /// Rolling resistance of every contact.
    pub rolling: RollingResistance,
    /// Largest load on either side, N: friction is solved up to it.
    pub largest_load: f64,
}

impl Screw {
    /// Screw of Lin 2019, Table 4.1, close to a rack-assist steering gear: 71 balls of 4 mm, a lead of 7 mm.
    pub const STEERING: Self = Self {
        design: BallScrewDesign {
            pitch_radius: 14.5e-3,
            lead: 7e-3,
            ball_radius: 2e-3,
            screw_groove_radius: 2.16e-3,
            nut_groove_radius: 2.16e-3,
            contact_angle: FRAC_PI_4,
            ball: Elastic::STEEL,
            groove: Elastic::STEEL,
        },
        balls: 71.0,
        axial_preload: 700.0,
        rolling: RollingResistance::STEEL,
        largest_load: 6000.0,
    };

    /// Torque of the load over the load, m.
    pub fn reduced_lead(&self) -> f64 {
        self.design.lead / TAU
    }

    /// Radial gap of every contact at the centred ball, m: zero, or below zero where balls are larger than their grooves.
    ///
    /// Two contacts of a diagonal share twice the oversize; each carries its part of the preload,
    /// `axial_preload/(balls sin b cos a)`.
    pub fn clearance(&self) -> Result<f64, ReferenceError> {
        let deflection = self.design.contact(Groove::Screw)?.deflection
            + self.design.contact(Groove::Nut)?.deflection;
        Ok(-0.5 * deflection * self.contact_force(self.axial_preload).powf(2.0 / 3.0))
    }

    /// Force of a contact under an axial load of a flank, N.
    pub fn contact_force(&self, flank_load: f64) -> f64 {
        let slope = self.design.contact_angle.sin() * self.design.lead_angle().cos();
        flank_load / (self.balls * slope)
    }

    /// Under one load with one friction coefficient.
    pub(crate) fn loaded(&self, axial_load: f64, friction: f64, clearance: f64) -> LoadedScrew {
        LoadedScrew {
            design: self.design,
            clearance,
            friction,
            rolling: self.rolling,
            balls: self.balls,
            axial_load,
        }
    }

    /// Sum of the axial forces of both flanks, N, under a load: they share one Hertzian deflection,
    /// `F1^(2/3) + F2^(2/3) = 2 P^(2/3)`, `F1 - F2 = load`, until one is lost.
    pub fn flank_sum(&self, load: f64) -> f64 {
        let (load, preload) = (load.abs(), self.axial_preload);
        if load >= 2.0 * std::f64::consts::SQRT_2 * preload {
            return load;
        }
        // Forces are preload times (1 + x)^(3/2) and (1 - x)^(3/2): Newton's method from below, where the difference of
        // both is concave in x, comes up to the root without overshoot.
        let ratio = load / preload;
        let mut x = ratio / 3.0;
        for _ in 0..30 {
            let (plus, minus) = (1.0 + x, (1.0 - x).max(0.0));
            let missing = ratio - (plus * plus.sqrt() - minus * minus.sqrt());
            let step = missing / (1.5 * (plus.sqrt() + minus.sqrt()));
            x = (x + step).clamp(0.0, 1.0);
            if step.abs() < 1e-15 {
                break;
            }
        }
        let (plus, minus) = (1.0 + x, 1.0 - x);
        preload * (plus * plus.sqrt() + minus * minus.sqrt())
    }
}

/// Friction coefficient by speed and temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficient {
    /// `mu_f + (mu_b - mu_f)/(1 + |w|/w_m)`, `w_m = half_share_speed ((T - pole)/(reference - pole))^5`.
    Rational {
        /// Speed of the nut at which half of the difference is gone, rad/s.
        half_share_speed: f64,
        /// Temperature of that speed, K.
        reference_temperature: f64,
        /// Temperature at which nothing flows, K.
        pole: f64,
    },
    /// Film of Hamrock and Dowson 1977, of which asperities carry `1/(1 + film/roughness)^2` (Olver and Spikes 1998).
    Film {
        /// The oil.
        oil: Vogel,
        /// Growth of the viscosity's logarithm with pressure, 1/Pa.
        pressure_viscosity: f64,
        /// Roughness of both surfaces, m.
        roughness: f64,
    },
}

/// Torque by the angle of the nut: `S/S_ref (cosine cos k th + sine sin k th)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Waves a turn, `k`.
    pub order: f64,
    /// N m at the reference load.
    pub cosine: f64,
    /// N m at the reference load.
    pub sine: f64,
}

/// Everything about the rig that a calibration may want to find.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Screw, fit, rolling resistance.
    pub screw: Screw,
    /// Friction coefficient `mu_b` at standstill.
    pub boundary: f64,
    /// Friction coefficient `mu_f` at high speed.
    pub full_film: f64,
    /// What lies between.
    pub coefficient: Coefficient,
    /// Factor of the coefficient forward and backward.
    pub directions: [f64; 2],
    /// Angle from no friction to full sliding, rad, at the reference load and coefficient `mu_b`.
    pub breakaway: f64,
    /// Axial load at which the breakaway angle holds, N; zero only with a preload.
    pub reference_axial_load: f64,
    /// Free play between the sensor's angle, which the drive turns, and the balls', rad, 0 to 1.
    pub backlash: f64,
    /// A part that spins, less stiff than slip: its share of the torque, 0 to 1, and its breakaway angle over that of slip.
    pub spinning: Option<[f64; 2]>,
    /// A seal, friction without a load: its torque, N m, and its breakaway angle, rad.
    pub seal: Option<[f64; 2]>,
    /// Inertia about the nut's axis, kg m^2.
    pub inertia: f64,
    /// Viscous drag, N m s.
    pub viscous: f64,
    /// Torque that the motor's channel shows without any, N m.
    pub offset: f64,
    /// Torque of the load over lead/2 pi times the measured load: gain of the load's channel.
    pub load_gain: f64,
    /// Error of the thread over the turn.
    pub waves: Vec<Wave>,
}

/// Zero of the Celsius scale, K.
pub const ZERO_CELSIUS: f64 = 273.15;

impl Default for Parameters {
    /// Friction and drive of a steering gear; the friction is of the form that the crate's has.
    fn default() -> Self {
        let wave = |order, cosine, sine| Wave {
            order,
            cosine,
            sine,
        };
        Self {
            screw: Screw::STEERING,
            boundary: 0.115,
            full_film: 0.06,
            coefficient: Coefficient::Rational {
                half_share_speed: 6.0,
                reference_temperature: ZERO_CELSIUS + 30.0,
                pole: ZERO_CELSIUS - 64.0,
            },
            directions: [1.0, 1.0],
            breakaway: 2e-3,
            reference_axial_load: 0.0,
            backlash: 0.0,
            spinning: None,
            seal: None,
            inertia: 4e-4,
            viscous: 3e-4,
            offset: 6e-3,
            load_gain: 1.012,
            waves: vec![wave(1.0, 1.5e-3, -1e-3), wave(2.0, 0.8e-3, 1.2e-3)],
        }
    }
}

impl Parameters {
    /// The same gear under another physics than the crate's form: a film by Hamrock and Dowson with Vogel's oil, two fifths of the
    /// torque by spin over twice the breakaway angle, a seal, a third wave, half of the rolling resistance.
    #[must_use]
    pub fn other_physics() -> Self {
        let mut parameters = Self {
            coefficient: Coefficient::Film {
                oil: Vogel {
                    viscosity_40: 0.088,
                    viscosity_100: 0.0095,
                    offset: 150.0,
                },
                pressure_viscosity: 20e-9,
                roughness: 0.15e-6,
            },
            spinning: Some([0.4, 2.0]),
            seal: Some([4e-3, 6e-3]),
            ..Self::default()
        };
        parameters.screw.rolling.hysteresis_loss *= 0.5;
        parameters.waves.push(Wave {
            order: 3.0,
            cosine: 1e-3,
            sine: 0.7e-3,
        });
        parameters
    }
    /// Parameters by the names of `calibrate`, in SI units; the preload is the force of a contact, the half-share speed that at 20 degrees
    /// Celsius, the temperature at which `calibrate` tells it. Of physics that a calibration has no name
    /// for there is nothing.
    pub fn named(&self) -> Vec<(String, f64)> {
        let [forward, backward] = self.directions;
        let mut named = vec![("friction", self.boundary)];
        if let Coefficient::Rational {
            half_share_speed,
            reference_temperature,
            pole,
        } = self.coefficient
        {
            let told_at = ZERO_CELSIUS + 20.0;
            let ratio = (told_at - pole) / (reference_temperature - pole);
            named.extend([
                ("full_film_ratio", self.full_film / self.boundary),
                ("half_share_speed", half_share_speed * ratio.powi(5)),
                ("reference_temperature", told_at),
                ("viscosity_pole", pole),
            ]);
        }
        let asymmetry = (forward - backward) / (forward + backward);
        let preload = self.screw.contact_force(self.screw.axial_preload);
        named.extend([("direction_asymmetry", asymmetry), ("preload", preload)]);
        if self.spinning.is_none() {
            named.push(("breakaway_angle", self.breakaway));
        }
        named.extend([
            ("backlash", self.backlash),
            ("inertia", self.inertia),
            ("drag", self.viscous),
            ("offset", self.offset),
            ("gain", self.load_gain),
        ]);
        let waves = self.waves.iter().flat_map(|wave| {
            let name = |part| format!("{part}_{}", wave.order);
            [(name("cosine"), wave.cosine), (name("sine"), wave.sine)]
        });
        let named = named
            .into_iter()
            .map(|(name, value)| (name.to_owned(), value));
        named.chain(waves).collect()
    }

    /// The same as lines of text above a trace's headings, which a reader of traces skips.
    pub fn header(&self) -> String {
        let line = |(name, value): (String, f64)| format!("# truth: {name} = {value}\n");
        self.named().into_iter().map(line).collect()
    }
}
