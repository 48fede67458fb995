//! Ways to choose the pitch angle of the ball's axis of rotation.

use super::ball::ContactKinematics;
use super::friction_power::FrictionPower;
use super::parameters::KinematicsParameters;
use crate::error::{Error, in_range};
use crate::math;
use crate::ranges;

/// How the pitch angle (`beta`) is chosen: Alberdi et al., Table 1, and two that follow from power.
///
/// [`angle`](Self::angle) gives the angle for a design. The choice moves spin from one contact to
/// the other; it moves friction power by a few percent, and no method has been verified by
/// measurement in a ball screw. For the paper's own screw (Table 2, 41° contact angle):
///
/// | method | pitch angle |
/// |---|---|
/// | `Constant(40°)` | 40° |
/// | `InnerRacewayControl` | 49.79° (50.10° by the printed formula) |
/// | `OuterRacewayControl` | 34.50° (34.32°) |
/// | `Mean` | 41° |
/// | `DAlembert` | 38.30° (38.23°) |
/// | `BalancedSpin` | 42.2° |
/// | `LeastPower` | 41.2° |
///
/// **Missing:** the paper's iterative method (ITE) is not defined in it: 44° for this screw cannot be
/// reconstructed. `BalancedSpin` is the nearest method that can be written down.
///
/// ```
/// use epas_friction::kinematics::{KinematicsParameters, PitchMethod};
/// # fn main() -> Result<(), epas_friction::Error> {
/// let degree = core::f32::consts::PI / 180.0;
/// let mut parameters = KinematicsParameters {
///     ball_diameter: 7.94e-3,
///     pitch_radius: 19.25e-3,
///     lead_angle: 10.0 * degree,
///     groove_radius_screw: 4.2e-3,
///     groove_radius_nut: 4.2e-3,
///     contact_angle_screw: 41.0 * degree,
///     contact_angle_nut: 41.0 * degree,
///     pitch_angle: 0.0, // replaced below
///     yaw_angle: 0.0,
///     rolling_radius_screw: 3.97e-3,
///     rolling_radius_nut: 3.97e-3,
///     semi_major_screw: 0.601e-3,
///     semi_minor_screw: 0.083e-3,
///     semi_major_nut: 0.586e-3,
///     semi_minor_nut: 0.097e-3,
/// };
/// parameters.pitch_angle = PitchMethod::OuterRacewayControl.angle(&parameters, 151.0, 151.0)?;
/// assert!((parameters.pitch_angle / degree - 34.50).abs() < 0.01);
/// # Ok(()) }
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum PitchMethod {
    /// CONST: the given angle, customarily the nominal contact angle, rad.
    Constant(f32),
    /// IRC: no spin at the screw. `tan beta = cos beta' sin alpha_i / (cos alpha_i - r'_i cos^2 psi / r_m)`,
    /// exact for a helix. **Corrected:** Table 1 leaves out `cos^2 psi`, and section 2.8 exchanges
    /// the two contacts (Table 1 and section 4.3.3 do not).
    InnerRacewayControl,
    /// ORC: no spin at the nut. `tan beta = cos beta' sin alpha_o / (cos alpha_o + r'_o cos^2 psi / r_m)`,
    /// exact for a helix; corrected as [`InnerRacewayControl`](Self::InnerRacewayControl).
    OuterRacewayControl,
    /// GEO: mean of the two contact angles.
    Mean,
    /// DAL: no power of all forces on the ball (d'Alembert). **Unverified**, since the paper's source
    /// was not at hand; **corrected** where Table 1 contradicts itself: `cos alpha_o` in the second
    /// term of the denominator, and `C` turned over, so that the nut's control is reached where its
    /// spin moment rules.
    DAlembert,
    /// The spin powers `mu W 3/8 a E |spin|` of both contacts are equal. Closed form; raceway control
    /// is its limit where one contact's spin moment `W a E` rules.
    BalancedSpin,
    /// Friction power of both contacts together is least, at the given yaw angle and rolling radii.
    /// Golden-section search between the raceway controls in sixteen steps; the minimum is flat, so
    /// that an angle near it costs less than 5e-4 more power.
    LeastPower,
}

impl PitchMethod {
    /// The pitch angle, rad; for set-up. `load_screw` and `load_nut` are the normal loads (N, 0 to
    /// 1e7, not both 0) that the last four methods weigh the contacts by; the others ignore them.
    /// The parameters' own `pitch_angle` is not read.
    ///
    /// Errors: 2e-7 rad for the raceway controls (as long as no right angle is passed), 1e-4 rad for
    /// the methods that weigh by loads.
    ///
    /// Cost: about 2800 cycles for a closed form, its check included; `LeastPower` about 76 000
    /// (modelled, Cortex-M4F).
    ///
    /// # Errors
    /// As [`ContactKinematics::new`] for the parameters with the resulting pitch angle;
    /// `load_screw`, `load_nut` or `pitch_angle` (the constant) where those are wrong.
    pub fn angle(
        &self,
        parameters: &KinematicsParameters,
        load_screw: f32,
        load_nut: f32,
    ) -> Result<f32, Error> {
        ranges::LOAD.checked("load_screw", load_screw)?;
        ranges::LOAD.checked("load_nut", load_nut)?;
        if load_screw + load_nut <= 0.0 {
            in_range(
                "load_screw",
                load_screw,
                f32::MIN_POSITIVE,
                ranges::LOAD.maximum,
            )?;
        }
        let p = parameters;
        let angle = match *self {
            Self::Constant(angle) => angle,
            Self::InnerRacewayControl => zero_spin_moment(p, 1.0, 0.0),
            Self::OuterRacewayControl => zero_spin_moment(p, 0.0, 1.0),
            Self::BalancedSpin => {
                let (screw, nut) = spin_moments(p, load_screw, load_nut);
                zero_spin_moment(p, screw, nut)
            }
            Self::Mean => 0.5 * (p.contact_angle_screw + p.contact_angle_nut),
            Self::DAlembert => {
                let (screw, nut) = spin_moments(p, load_screw, load_nut);
                d_alembert(p, screw, nut)
            }
            Self::LeastPower => least_power(p, load_screw, load_nut)?,
        };
        ContactKinematics::new(&with_pitch_angle(p, angle))?;
        Ok(angle)
    }
}

const fn with_pitch_angle(parameters: &KinematicsParameters, angle: f32) -> KinematicsParameters {
    KinematicsParameters {
        pitch_angle: angle,
        ..*parameters
    }
}

/// `D / d_m`.
fn ball_ratio(p: &KinematicsParameters) -> f32 {
    p.ball_diameter / (2.0 * p.pitch_radius)
}

/// Spin moments of both contacts, `3/8 mu W a E`, but for a common factor.
fn spin_moments(p: &KinematicsParameters, load_screw: f32, load_nut: f32) -> (f32, f32) {
    (
        load_screw * mean_lever(p.semi_major_screw, p.semi_minor_screw),
        load_nut * mean_lever(p.semi_major_nut, p.semi_minor_nut),
    )
}

/// The pitch angle at which `moment_screw spin_i = moment_nut spin_o`.
///
/// Both spins are linear in `cos beta` and `sin beta`, so that with `e_k = cos psi r'_k / A_k`
/// `tan beta = cos beta' [m_i sin a_i (1 + e_i cos a_i) + m_o sin a_o (1 - e_o cos a_o)] /
/// [m_i (cos a_i - e_i sin^2 a_i) + m_o (cos a_o + e_o sin^2 a_o)]`.
fn zero_spin_moment(p: &KinematicsParameters, moment_screw: f32, moment_nut: f32) -> f32 {
    let (_, cosine_yaw) = math::sin_cos(p.yaw_angle);
    let (_, cosine_lead) = math::sin_cos(p.lead_angle);
    let term = |contact_angle, rolling_radius: f32, sign: f32| {
        let (sine, cosine) = math::sin_cos(contact_angle);
        let step = sign * rolling_radius * cosine_lead * cosine_lead;
        let e = step / (p.pitch_radius - step * cosine);
        (sine * (1.0 + e * cosine), cosine - e * sine * sine)
    };
    let (sine_screw, cosine_screw) = term(p.contact_angle_screw, p.rolling_radius_screw, 1.0);
    let (sine_nut, cosine_nut) = term(p.contact_angle_nut, p.rolling_radius_nut, -1.0);
    libm::atan2f(
        cosine_yaw * (moment_screw * sine_screw + moment_nut * sine_nut),
        moment_screw * cosine_screw + moment_nut * cosine_nut,
    )
}

/// Table 1, DAL, corrected: `C = moment_screw / moment_nut`, and `cos alpha_o` in the second term of the
/// denominator; numerator and denominator multiplied by `moment_nut`.
fn d_alembert(p: &KinematicsParameters, moment_screw: f32, moment_nut: f32) -> f32 {
    let ratio = ball_ratio(p);
    let (sine_i, cosine_i) = math::sin_cos(p.contact_angle_screw);
    let (sine_o, cosine_o) = math::sin_cos(p.contact_angle_nut);
    let b = (1.0 + ratio * cosine_o) / (1.0 - ratio * cosine_i);
    let cosine_difference = cosine_i * cosine_o + sine_i * sine_o;
    libm::atan2f(
        moment_screw * (b + 1.0) * sine_i + moment_nut * 2.0 * sine_o,
        moment_screw * ((b + 1.0) * cosine_i + ratio * (cosine_difference - b))
            + moment_nut * 2.0 * (cosine_o + ratio),
    )
}

/// The golden section, `(sqrt(5) - 1)/2`.
pub(crate) const SECTION: f32 = 0.618_034;

/// Golden-section search between the two raceway controls.
fn least_power(p: &KinematicsParameters, load_screw: f32, load_nut: f32) -> Result<f32, Error> {
    let power = |angle| {
        let kinematics = ContactKinematics::new(&with_pitch_angle(p, angle))?;
        Ok::<f32, Error>(FrictionPower::new(&kinematics).weighted(load_screw, load_nut))
    };
    let inner = zero_spin_moment(p, 1.0, 0.0);
    let outer = zero_spin_moment(p, 0.0, 1.0);
    let (mut low, mut high) = (inner.min(outer), inner.max(outer));
    let mut left = high - SECTION * (high - low);
    let mut right = low + SECTION * (high - low);
    let (mut power_left, mut power_right) = (power(left)?, power(right)?);
    for _ in 0..16 {
        if power_left <= power_right {
            (high, right, power_right) = (right, left, power_left);
            left = high - SECTION * (high - low);
            power_left = power(left)?;
        } else {
            (low, left, power_left) = (left, right, power_right);
            right = low + SECTION * (high - low);
            power_right = power(right)?;
        }
    }
    Ok(0.5 * (low + high))
}

/// `4 / pi a E(1 - b^2/a^2)` with Legendre's complete elliptic integral `E`: the ellipse's perimeter
/// over `pi`, by Ramanujan's second formula; 0 to 4e-4 below the exact value, the latter for `b = 0`.
fn mean_lever(semi_major: f32, semi_minor: f32) -> f32 {
    let sum = semi_major + semi_minor;
    if sum <= 0.0 {
        return 0.0;
    }
    let h = (semi_major - semi_minor) / sum;
    let h3 = 3.0 * h * h;
    sum * (1.0 + h3 / (10.0 + math::sqrt(4.0 - h3)))
}
