//! Data of Alberdi et al., Figures 6 to 13.
//!
//! Each function returns what one figure draws, for the screw of the paper's Table 2 under the
//! paper's load. Angles in radians, lengths in metres, speeds in m/s and rad/s.

use super::pitch_angle;
use super::power::HertzMean;
use super::traditional::Traditional;
use epas_reference::error::ReferenceError;
use epas_reference::kinematics::ContactKinematics;
use epas_reference::kinematics::Revised;
use epas_reference::kinematics::operating::{self, LoadedBall};
use epas_reference::kinematics::{KinematicsInput, Raceway};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// `steps + 1` equidistant values from `low` to `high`.
fn range(low: f64, high: f64, steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |step| low + (high - low) * step as f64 / steps.max(1) as f64)
}

/// One contact by one formulation, as Figure 6 draws it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulationValues {
    /// Semi-major axis, m.
    pub semi_major: f64,
    /// Semi-minor axis, m.
    pub semi_minor: f64,
    /// Entrainment speed, m/s.
    pub entrainment_speed: f64,
    /// Angle of entrainment to the direction of rolling, rad.
    pub entrainment_angle: f64,
    /// Slip along the direction of rolling at the centre, m/s.
    pub rolling_slip: f64,
    /// Slip across it, m/s.
    pub side_slip: f64,
    /// Spin, rad/s.
    pub spin: f64,
}

/// A row of Figure 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixRow {
    /// Helix (lead) angle, rad.
    pub lead_angle: f64,
    /// Revised formulation at screw and nut.
    pub revised: [FormulationValues; 2],
    /// Traditional formulation at screw and nut.
    pub traditional: [FormulationValues; 2],
}

fn revised_values(revised: &Revised) -> [FormulationValues; 2] {
    let ball = revised.evaluate();
    Raceway::BOTH.map(|raceway| {
        let contact = revised.input().contact(raceway);
        let slip = ball.contact(raceway);
        FormulationValues {
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
            entrainment_speed: slip.entrainment_speed,
            entrainment_angle: slip.entrainment_angle,
            rolling_slip: slip.rolling_slip,
            side_slip: slip.side_slip,
            spin: slip.spin,
        }
    })
}

fn traditional_values(revised: &Revised) -> [FormulationValues; 2] {
    let traditional = Traditional::new(revised);
    Raceway::BOTH.map(|raceway| {
        let contact = revised.input().contact(raceway);
        let [v_x, v_y] = traditional.entrainment(raceway);
        let [rolling_slip, side_slip] =
            traditional.slip(raceway, 0.0, 0.0, traditional.distance(raceway));
        FormulationValues {
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
            entrainment_speed: v_x.hypot(v_y),
            entrainment_angle: v_y.atan2(v_x),
            rolling_slip,
            side_slip,
            spin: traditional.spin(raceway),
        }
    })
}

/// Figure 6: both formulations over the helix angle, 0 to 40°.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn helix_sweep(steps: usize) -> Result<Vec<HelixRow>, ReferenceError> {
    range(0.0, 40.0 * DEGREE, steps)
        .filter_map(|lead_angle| {
            let helical = operating::case_one(lead_angle, true)?;
            let ring = operating::case_one(lead_angle, false)?;
            Some((lead_angle, helical, ring))
        })
        .map(|(lead_angle, helical, ring)| {
            Ok(HelixRow {
                lead_angle,
                revised: revised_values(&Revised::new(&helical)?),
                traditional: traditional_values(&Revised::new(&ring)?),
            })
        })
        .collect()
}

/// Which formulation a field is drawn by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// Alberdi et al.
    Revised,
    /// Lin, Ravani and Velinsky, with the speeds of Wei and Lin.
    Traditional,
}

/// Slip at one point of the ellipse, m and m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldPoint {
    /// Along the direction of rolling.
    pub x: f64,
    /// Across it.
    pub y: f64,
    /// Total slip along `x`.
    pub slip_x: f64,
    /// Total slip along `y`.
    pub slip_y: f64,
    /// Rolling slip's part, along `x`.
    pub rolling: f64,
    /// Side slip's part, along `y`.
    pub side: f64,
    /// Spin's part along `x`.
    pub spin_x: f64,
    /// Spin's part along `y`.
    pub spin_y: f64,
}

/// Slip over the ellipse of one contact (Figures 7, 8 and the lower halves of 10 to 13): points of a
/// grid of `2 steps + 1` by `2 steps + 1` over the bounding rectangle that lie within the ellipse.
#[must_use]
pub fn slip_field(
    revised: &Revised,
    formulation: Formulation,
    raceway: Raceway,
    steps: usize,
) -> Vec<FieldPoint> {
    let contact = revised.input().contact(raceway);
    let speed = revised.input().speed;
    let traditional = Traditional::new(revised);
    let count = 2 * steps.max(1);
    let mut points = Vec::new();
    for v in range(-1.0, 1.0, count) {
        for u in range(-1.0, 1.0, count) {
            if u * u + v * v > 1.0 + 1e-12 {
                continue;
            }
            let (x, y) = (u * contact.semi_minor, v * contact.semi_major);
            let (rolling, side, spin) = match formulation {
                Formulation::Revised => (
                    speed * revised.rolling_slip(raceway, y),
                    speed * revised.side_slip(raceway, y),
                    speed * revised.spin(raceway),
                ),
                Formulation::Traditional => {
                    let spin = traditional.spin(raceway);
                    let distance = revised.distance(raceway, y);
                    let [v_x, v_y] = traditional.slip(raceway, x, y, distance);
                    (v_x + spin * y, v_y - spin * x, spin)
                }
            };
            points.push(FieldPoint {
                x,
                y,
                slip_x: rolling - spin * y,
                slip_y: side + spin * x,
                rolling,
                side,
                spin_x: -spin * y,
                spin_y: spin * x,
            });
        }
    }
    points
}

/// Figures 7 (`lead_angle` 0) and 8 (10°): the kinematics whose fields they draw.
///
/// # Errors
/// The field that the model refuses; `lead_angle` for one without a contact ellipse.
pub fn case_one(lead_angle: f64) -> Result<Revised, ReferenceError> {
    let input = operating::case_one(lead_angle, true).ok_or_else(|| {
        ReferenceError::input(
            "lead_angle",
            format!("no contact ellipse exists at {lead_angle}"),
        )
    })?;
    Revised::new(&input)
}

/// Figure 9: three slip fields with one slide-to-roll ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct SameSlideToRoll {
    /// The ratio that all three share.
    pub slide_to_roll: f64,
    /// The screw's contact as it is: rolling, side and spin slip.
    pub reference: Vec<FieldPoint>,
    /// The same without spin: what magnitude and angle of the ratio reconstruct.
    pub without_spin: Vec<FieldPoint>,
    /// All slip along the direction of rolling: what the magnitude alone lets one assume.
    pub rolling_only: Vec<FieldPoint>,
}

/// Figure 9: the ambiguity of the slide-to-roll ratio.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn same_slide_to_roll(steps: usize) -> Result<SameSlideToRoll, ReferenceError> {
    let revised = case_one(operating::LEAD_ANGLE)?;
    let slip = revised.evaluate().screw;
    let reference = slip_field(&revised, Formulation::Revised, Raceway::Screw, steps);
    let uniform = |rolling: f64, side: f64| {
        reference
            .iter()
            .map(|point| FieldPoint {
                slip_x: rolling,
                slip_y: side,
                rolling,
                side,
                spin_x: 0.0,
                spin_y: 0.0,
                ..*point
            })
            .collect()
    };
    Ok(SameSlideToRoll {
        slide_to_roll: slip.slide_to_roll,
        without_spin: uniform(slip.rolling_slip, slip.side_slip),
        rolling_only: uniform(slip.rolling_slip.hypot(slip.side_slip), 0.0),
        reference,
    })
}

/// A row of a sweep of one kinematic constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintRow {
    /// The constraint that is varied: rolling radius (m), yaw or pitch angle (rad).
    pub value: f64,
    /// Contact with the screw.
    pub screw: ContactKinematics,
    /// Contact with the nut.
    pub nut: ContactKinematics,
}

fn constraint_sweep(
    low: f64,
    high: f64,
    steps: usize,
    set: impl Fn(KinematicsInput, f64) -> KinematicsInput,
) -> Result<Vec<ConstraintRow>, ReferenceError> {
    let reference = case_two()?;
    range(low, high, steps)
        .map(|value| {
            let ball = Revised::new(&set(reference, value))?.evaluate();
            Ok(ConstraintRow {
                value,
                screw: ball.screw,
                nut: ball.nut,
            })
        })
        .collect()
}

/// The fixed values of the parametric study (Table 4): yaw angle 1°, pitch angle 40°, rolling radii
/// `D/2`.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn case_two() -> Result<KinematicsInput, ReferenceError> {
    let reference = case_one(operating::LEAD_ANGLE)?;
    Ok(KinematicsInput {
        yaw_angle: DEGREE,
        ..*reference.input()
    })
}

/// Figure 10: both rolling radii from 3.92 to 4.02 mm; selected are 3.95, 3.97 and 3.99 mm.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn rolling_radius_sweep(steps: usize) -> Result<Vec<ConstraintRow>, ReferenceError> {
    constraint_sweep(3.92e-3, 4.02e-3, steps, |input, radius| KinematicsInput {
        rolling_radius_screw: radius,
        rolling_radius_nut: radius,
        ..input
    })
}

/// Figure 11: yaw angle from -3 to 3°; selected are 0, 1 and 2°.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn yaw_sweep(steps: usize) -> Result<Vec<ConstraintRow>, ReferenceError> {
    constraint_sweep(-3.0 * DEGREE, 3.0 * DEGREE, steps, |input, yaw_angle| {
        KinematicsInput { yaw_angle, ..input }
    })
}

/// Figure 12: pitch angle from 28 to 52°; selected are 34.3, 40, 44 and 50.1°.
///
/// # Errors
/// None for the paper's screw; the type of the model's constructor.
pub fn pitch_sweep(steps: usize) -> Result<Vec<ConstraintRow>, ReferenceError> {
    constraint_sweep(28.0 * DEGREE, 52.0 * DEGREE, steps, |input, pitch_angle| {
        KinematicsInput {
            pitch_angle,
            ..input
        }
    })
}

/// Pitch angles by every method that can be written down, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchAngles {
    /// CONST: nominal contact angle.
    pub constant: f64,
    /// IRC, as printed.
    pub inner_raceway_control: f64,
    /// ORC, as printed.
    pub outer_raceway_control: f64,
    /// IRC, exact for a helix.
    pub inner_raceway_control_exact: f64,
    /// ORC, exact for a helix.
    pub outer_raceway_control_exact: f64,
    /// GEO.
    pub mean: f64,
    /// DAL as printed; unverified.
    pub d_alembert_printed: f64,
    /// DAL with the contradictions of Table 1 resolved; unverified.
    pub d_alembert: f64,
    /// Equal spin power at both contacts: beside ITE, which cannot be reconstructed.
    pub balanced_spin: f64,
    /// Least friction power.
    pub least_power: f64,
}

/// All pitch angles of a loaded ball; `None` where one does not exist.
#[must_use]
pub fn pitch_angles(ball: &LoadedBall, rule: &HertzMean) -> Option<PitchAngles> {
    let LoadedBall {
        input,
        load_screw,
        load_nut,
    } = ball;
    Some(PitchAngles {
        constant: operating::NOMINAL_CONTACT_ANGLE,
        inner_raceway_control: pitch_angle::inner_raceway_control_printed(input),
        outer_raceway_control: pitch_angle::outer_raceway_control_printed(input),
        inner_raceway_control_exact: pitch_angle::inner_raceway_control(input)?,
        outer_raceway_control_exact: pitch_angle::outer_raceway_control(input)?,
        mean: pitch_angle::mean_contact_angle(input),
        d_alembert_printed: pitch_angle::d_alembert_printed(input, *load_screw, *load_nut)?,
        d_alembert: pitch_angle::d_alembert(input, *load_screw, *load_nut)?,
        balanced_spin: pitch_angle::balanced_spin(input, *load_screw, *load_nut)?,
        least_power: pitch_angle::least_power(input, rule, *load_screw, *load_nut)?,
    })
}

/// A row of Figure 13.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadRow {
    /// Axial load, N.
    pub axial_load: f64,
    /// Contact angles at screw and nut, rad.
    pub contact_angles: [f64; 2],
    /// Contact loads at screw and nut, N.
    pub contact_loads: [f64; 2],
    /// Pitch angle by every method.
    pub pitch: PitchAngles,
}

/// Figure 13: pitch angles over the axial load, 500 to 3500 N, at a speed (rad/s; the paper's are
/// 1000 and 3500 rpm). Loads without an equilibrium are left out.
#[must_use]
pub fn load_sweep(speed: f64, steps: usize) -> Vec<LoadRow> {
    let rule = HertzMean::new(16, 32);
    range(500.0, 3500.0, steps)
        .filter_map(|axial_load| {
            let ball = operating::loaded_ball(axial_load, speed)?;
            Some(LoadRow {
                axial_load,
                contact_angles: [ball.input.contact_angle_screw, ball.input.contact_angle_nut],
                contact_loads: [ball.load_screw, ball.load_nut],
                pitch: pitch_angles(&ball, &rule)?,
            })
        })
        .collect()
}
