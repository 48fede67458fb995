//! Data of Alberdi et al., Figures 6 to 13: for the screw of the paper's Table 2 under the paper's load. Angles in rad, lengths in m,
//! speeds in m/s and rad/s.

use super::pitch_angle;
use super::traditional::Traditional;
use epas_bench::report::statistics::evenly;
use epas_reference::error::ReferenceError;
use epas_reference::kinematics::operating::{self, LoadedBall};
use epas_reference::kinematics::{ContactKinematics, KinematicsInput, Raceway, Revised};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// One contact by one formulation, as Figure 6 draws it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulationValues {
    pub semi_major: f64,
    pub entrainment_speed: f64,
    /// Slip along the direction of rolling at the centre, m/s.
    pub rolling_slip: f64,
    /// Slip across it, m/s.
    pub side_slip: f64,
    pub spin: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixRow {
    pub lead_angle: f64,
    pub revised: [FormulationValues; 2],
    pub traditional: [FormulationValues; 2],
}

fn revised_values(revised: &Revised) -> [FormulationValues; 2] {
    let ball = revised.evaluate();
    Raceway::BOTH.map(|raceway| {
        let slip = ball.contact(raceway);
        FormulationValues {
            semi_major: revised.input().contact(raceway).semi_major,
            entrainment_speed: slip.entrainment_speed,
            rolling_slip: slip.rolling_slip,
            side_slip: slip.side_slip,
            spin: slip.spin,
        }
    })
}

fn traditional_values(revised: &Revised) -> [FormulationValues; 2] {
    let traditional = Traditional::new(revised);
    Raceway::BOTH.map(|raceway| {
        let [v_x, v_y] = traditional.entrainment(raceway);
        let [rolling_slip, side_slip] =
            traditional.slip(raceway, 0.0, 0.0, traditional.distance(raceway));
        FormulationValues {
            semi_major: revised.input().contact(raceway).semi_major,
            entrainment_speed: v_x.hypot(v_y),
            rolling_slip,
            side_slip,
            spin: traditional.spin(raceway),
        }
    })
}

/// Figure 6: both formulations over the helix angle, 0 to 40°.
pub fn helix_sweep(steps: usize) -> Result<Vec<HelixRow>, ReferenceError> {
    let mut rows = Vec::new();
    for lead_angle in evenly(0.0, 40.0 * DEGREE, steps) {
        let [helical, ring] = [true, false].map(|helix| operating::case_one(lead_angle, helix));
        if let (Some(helical), Some(ring)) = (helical, ring) {
            rows.push(HelixRow {
                lead_angle,
                revised: revised_values(&Revised::new(&helical)?),
                traditional: traditional_values(&Revised::new(&ring)?),
            });
        }
    }
    Ok(rows)
}

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
    pub x: f64,
    pub y: f64,
    pub slip_x: f64,
    pub slip_y: f64,
}

/// Slip over the ellipse of one contact (Figures 7, 8): points of a grid of `2 steps + 1` by `2 steps + 1` over the bounding rectangle that
/// lie within the ellipse.
pub fn slip_field(
    revised: &Revised,
    formulation: Formulation,
    raceway: Raceway,
    steps: usize,
) -> Vec<FieldPoint> {
    let contact = revised.input().contact(raceway);
    let speed = revised.input().speed;
    let traditional = Traditional::new(revised);
    let mut points = Vec::new();
    for v in evenly(-1.0, 1.0, 2 * steps) {
        for u in evenly(-1.0, 1.0, 2 * steps) {
            if u * u + v * v > 1.0 + 1e-12 {
                continue;
            }
            let (x, y) = (u * contact.semi_minor, v * contact.semi_major);
            let [slip_x, slip_y] = match formulation {
                Formulation::Revised => {
                    let spin = speed * revised.spin(raceway);
                    [
                        speed * revised.rolling_slip(raceway, y) - spin * y,
                        speed * revised.side_slip(raceway, y) + spin * x,
                    ]
                }
                Formulation::Traditional => {
                    traditional.slip(raceway, x, y, revised.distance(raceway, y))
                }
            };
            points.push(FieldPoint {
                x,
                y,
                slip_x,
                slip_y,
            });
        }
    }
    points
}

/// The kinematics of Figures 7 (`lead_angle` 0) and 8 (10°); an error where there is no contact ellipse.
pub fn case_one(lead_angle: f64) -> Result<Revised, ReferenceError> {
    let none = || {
        let why = format!("no contact ellipse exists at {lead_angle}");
        ReferenceError::input("lead_angle", why)
    };
    Revised::new(&operating::case_one(lead_angle, true).ok_or_else(none)?)
}

/// Figure 9: three slip fields with one slide-to-roll ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct SameSlideToRoll {
    pub slide_to_roll: f64,
    /// The screw's contact as it is: rolling, side and spin slip.
    pub reference: Vec<FieldPoint>,
    /// The same without spin: what magnitude and angle of the ratio reconstruct.
    pub without_spin: Vec<FieldPoint>,
    pub rolling_only: Vec<FieldPoint>,
}

pub fn same_slide_to_roll(steps: usize) -> Result<SameSlideToRoll, ReferenceError> {
    let revised = case_one(operating::LEAD_ANGLE)?;
    let slip = revised.evaluate().screw;
    let reference = slip_field(&revised, Formulation::Revised, Raceway::Screw, steps);
    let uniform = |slip_x: f64, slip_y: f64| {
        let points = reference.iter().map(|point| FieldPoint {
            slip_x,
            slip_y,
            ..*point
        });
        points.collect()
    };
    Ok(SameSlideToRoll {
        slide_to_roll: slip.slide_to_roll,
        without_spin: uniform(slip.rolling_slip, slip.side_slip),
        rolling_only: uniform(slip.rolling_slip.hypot(slip.side_slip), 0.0),
        reference,
    })
}

/// The fixed values of the parametric study (Table 4): yaw angle 1°, pitch angle 40°, rolling radii `D/2`.
pub fn case_two() -> Result<KinematicsInput, ReferenceError> {
    let reference = case_one(operating::LEAD_ANGLE)?;
    Ok(KinematicsInput {
        yaw_angle: DEGREE,
        ..*reference.input()
    })
}

/// A constraint that Figures 10 to 12 vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// Both rolling radii, 3.92 to 4.02 mm: Figure 10.
    RollingRadius,
    /// Yaw angle, -3 to 3°: Figure 11.
    Yaw,
    /// Pitch angle, 28 to 52°: Figure 12.
    Pitch,
}

impl Constraint {
    /// The constraint (m or rad), and the contacts with screw and nut, over its range.
    pub fn sweep(self, steps: usize) -> Result<Vec<(f64, [ContactKinematics; 2])>, ReferenceError> {
        let (low, high) = match self {
            Self::RollingRadius => (3.92e-3, 4.02e-3),
            Self::Yaw => (-3.0 * DEGREE, 3.0 * DEGREE),
            Self::Pitch => (28.0 * DEGREE, 52.0 * DEGREE),
        };
        let reference = case_two()?;
        evenly(low, high, steps)
            .map(|value| {
                let mut input = reference;
                match self {
                    Self::RollingRadius => {
                        (input.rolling_radius_screw, input.rolling_radius_nut) = (value, value);
                    }
                    Self::Yaw => input.yaw_angle = value,
                    Self::Pitch => input.pitch_angle = value,
                }
                let ball = Revised::new(&input)?.evaluate();
                Ok((value, [ball.screw, ball.nut]))
            })
            .collect()
    }
}

/// Methods of Figure 13; the angle of balanced spin power stands in the place of ITE, which cannot be reconstructed. DAL has the
/// contradictions of Table 1 resolved.
pub const METHODS: [&str; 6] = [
    "CONST",
    "IRC",
    "ORC",
    "GEO",
    "DAL (unverified)",
    "balanced spin power",
];

/// Pitch angles of a loaded ball by each of [`METHODS`], rad; `None` where one does not exist.
pub fn pitch_angles(ball: &LoadedBall) -> Option<[f64; 6]> {
    let LoadedBall {
        input,
        load_screw,
        load_nut,
    } = ball;
    Some([
        operating::NOMINAL_CONTACT_ANGLE,
        pitch_angle::inner_raceway_control_printed(input),
        pitch_angle::outer_raceway_control_printed(input),
        pitch_angle::mean_contact_angle(input),
        pitch_angle::d_alembert(input, *load_screw, *load_nut)?,
        pitch_angle::balanced_spin(input, *load_screw, *load_nut)?,
    ])
}

/// Figure 13: pitch angles over the axial load, 500 to 3500 N, at a speed (rad/s; the paper's are 1000 and 3500 rpm). Loads without
/// an equilibrium are left out.
pub fn load_sweep(speed: f64, steps: usize) -> Vec<(f64, [f64; 6])> {
    evenly(500.0, 3500.0, steps)
        .filter_map(|axial_load| {
            let ball = operating::loaded_ball(axial_load, speed)?;
            Some((axial_load, pitch_angles(&ball)?))
        })
        .collect()
}
