//! Tables A1 and A2 of Bertolino et al. 2023 as printed, and their errors computed again.

use epas_reference::curvature::{Groove, Surface, literature, profile};
use epas_reference::error::ReferenceError;

/// One row of Table A1 or A2 as printed; lengths in mm, angles in degrees, errors in percent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Nominal diameter.
    pub nominal_diameter: f64,
    /// Lead as printed.
    pub lead: f64,
    /// Ball diameter.
    pub ball_diameter: f64,
    /// Lead angle as printed.
    pub lead_angle: f64,
    /// Mean error of the literature formula.
    pub literature_mean: f64,
    /// Largest error of the literature formula.
    pub literature_max: f64,
    /// Mean error of the proposed (circular groove) formula.
    pub proposed_mean: f64,
    /// Largest error of the proposed formula.
    pub proposed_max: f64,
}

const fn row(size: [f64; 4], errors: [f64; 4]) -> Row {
    Row {
        nominal_diameter: size[0],
        lead: size[1],
        ball_diameter: size[2],
        lead_angle: size[3],
        literature_mean: errors[0],
        literature_max: errors[1],
        proposed_mean: errors[2],
        proposed_max: errors[3],
    }
}

impl Row {
    /// The lead that the row was computed with: 60 mm where 65 is printed, as its lead angle shows.
    #[must_use]
    pub fn true_lead(&self) -> f64 {
        if self.lead == 65.0 { 60.0 } else { self.lead }
    }

    /// The four printed errors: literature mean and largest, proposed mean and largest.
    #[must_use]
    pub fn errors(&self) -> [f64; 4] {
        [
            self.literature_mean,
            self.literature_max,
            self.proposed_mean,
            self.proposed_max,
        ]
    }

    /// The groove surface of this size: conformity 0.528, nominal contact angle 45 degrees, pitch
    /// radius half the nominal diameter.
    #[must_use]
    pub fn surface(&self, groove: Groove) -> Surface {
        let pitch_radius = 0.5 * self.nominal_diameter;
        let (groove_radius, offset_h, offset_l) = profile(
            0.5 * self.ball_diameter,
            CONFORMITY,
            std::f64::consts::FRAC_PI_4,
        );
        Surface {
            groove,
            pitch_radius,
            lead_angle: (self.true_lead() / (std::f64::consts::TAU * pitch_radius)).atan(),
            groove_radius,
            offset_h,
            offset_l,
        }
    }
}

/// Conformity of the printed tables; they determine it within 0.0005.
pub const CONFORMITY: f64 = 0.528;

/// Mean and largest error, percent, of a formula for the first radius of curvature over the contact
/// angles 1, 2, ... 70 degrees.
#[must_use]
pub fn radius_errors(surface: &Surface, formula: impl Fn(f64) -> f64) -> (f64, f64) {
    let mut sum = 0.0;
    let mut largest = 0.0_f64;
    for degrees in 1..=70 {
        let angle = f64::from(degrees).to_radians();
        let exact = surface.principal(angle).kappa1;
        let error = (exact / formula(angle) - 1.0).abs() * 100.0;
        sum += error;
        largest = largest.max(error);
    }
    (sum / 70.0, largest)
}

/// The four errors of a row computed again, in the order of [`Row::errors`].
///
/// The errors are those of the radius. The screw's table takes the groove radius in the literature
/// formula, not the ball radius that eq. (27) prints; the nut's table the ball radius, as eq. (28).
///
/// # Errors
/// [`ReferenceError`] where the row is no regular surface.
pub fn computed_errors(row: &Row, groove: Groove) -> Result<[f64; 4], ReferenceError> {
    let surface = row.surface(groove);
    surface.check(0.0)?;
    let radius = match groove {
        Groove::Screw => surface.groove_radius,
        Groove::Nut => 0.5 * row.ball_diameter,
    };
    let (literature_mean, literature_max) = radius_errors(&surface, |angle| {
        literature(groove, surface.pitch_radius, radius, angle)
    });
    let (proposed_mean, proposed_max) =
        radius_errors(&surface, |angle| surface.circular_groove(angle));
    Ok([literature_mean, literature_max, proposed_mean, proposed_max])
}

/// Table A1: the screw shaft.
pub const TABLE_A1: [Row; 31] = [
    row([125.0, 10.0, 7.144, 1.46], [0.30, 0.31, 0.24, 0.24]),
    row([160.0, 25.0, 12.7, 2.85], [0.60, 0.61, 0.33, 0.34]),
    row([125.0, 20.0, 12.7, 2.92], [0.71, 0.73, 0.43, 0.45]),
    row([160.0, 30.0, 12.7, 3.42], [0.71, 0.73, 0.33, 0.34]),
    row([125.0, 25.0, 12.7, 3.64], [0.87, 0.89, 0.43, 0.44]),
    row([125.0, 30.0, 12.7, 4.37], [1.06, 1.09, 0.43, 0.44]),
    row([100.0, 30.0, 12.7, 5.45], [1.54, 1.60, 0.54, 0.57]),
    row([80.0, 25.0, 12.7, 5.68], [1.81, 1.90, 0.70, 0.73]),
    row([125.0, 40.0, 12.7, 5.82], [1.54, 1.58, 0.42, 0.44]),
    row([80.0, 30.0, 9.525, 6.81], [2.04, 2.12, 0.50, 0.52]),
    row([63.0, 25.0, 9.525, 7.20], [2.42, 2.53, 0.65, 0.68]),
    row([50.0, 20.0, 6.35, 7.26], [2.30, 2.39, 0.53, 0.56]),
    row([100.0, 40.0, 12.7, 7.26], [2.30, 2.39, 0.53, 0.56]),
    row([32.0, 15.0, 6.35, 8.49], [3.43, 3.65, 0.87, 0.94]),
    row([50.0, 25.0, 6.35, 9.04], [3.25, 3.37, 0.52, 0.55]),
    row([32.0, 20.0, 6.35, 11.25], [5.30, 5.63, 0.82, 0.90]),
    row([80.0, 60.0, 9.525, 13.43], [6.35, 6.57, 0.44, 0.47]),
    row([25.0, 20.0, 3.5, 14.29], [7.29, 7.59, 0.51, 0.56]),
    row([40.0, 40.0, 6.35, 17.66], [10.89, 11.39, 0.52, 0.60]),
    row([32.0, 32.0, 4.762, 17.66], [10.77, 11.23, 0.49, 0.56]),
    row([50.0, 60.0, 6.35, 20.91], [14.29, 14.78, 0.35, 0.42]),
    row([32.0, 40.0, 4.762, 21.70], [15.60, 16.23, 0.40, 0.49]),
    row([63.0, 80.0, 7.144, 22.01], [15.50, 15.96, 0.29, 0.36]),
    row([40.0, 60.0, 6.35, 25.52], [21.01, 21.86, 0.33, 0.45]),
    row([40.0, 60.0, 7.144, 25.52], [21.36, 22.34, 0.38, 0.52]),
    row([25.0, 50.0, 3.5, 32.48], [31.45, 32.41, 0.14, 0.26]),
    row([32.0, 64.0, 4.762, 32.48], [31.63, 32.66, 0.15, 0.28]),
    row([50.0, 100.0, 7.144, 32.48], [31.51, 32.49, 0.14, 0.27]),
    row([20.0, 50.0, 3.5, 38.51], [42.42, 43.82, 0.15, 0.54]),
    row([20.0, 65.0, 3.5, 43.68], [51.39, 52.81, 0.27, 0.84]),
    row([25.0, 80.0, 3.5, 45.53], [53.80, 54.90, 0.27, 0.76]),
];

/// Table A2: the nut.
pub const TABLE_A2: [Row; 31] = [
    row([125.0, 10.0, 7.144, 1.46], [0.09, 0.15, 0.22, 0.22]),
    row([160.0, 25.0, 12.7, 2.85], [0.26, 0.35, 0.29, 0.30]),
    row([125.0, 20.0, 12.7, 2.92], [0.27, 0.39, 0.37, 0.38]),
    row([160.0, 30.0, 12.7, 3.42], [0.36, 0.45, 0.29, 0.30]),
    row([125.0, 25.0, 12.7, 3.64], [0.41, 0.52, 0.37, 0.38]),
    row([125.0, 30.0, 12.7, 4.37], [0.57, 0.68, 0.37, 0.38]),
    row([100.0, 30.0, 12.7, 5.45], [0.87, 0.99, 0.45, 0.46]),
    row([80.0, 25.0, 12.7, 5.68], [0.93, 1.07, 0.55, 0.57]),
    row([125.0, 40.0, 12.7, 5.82], [0.99, 1.09, 0.36, 0.37]),
    row([80.0, 30.0, 9.525, 6.81], [1.33, 1.43, 0.41, 0.42]),
    row([63.0, 25.0, 9.525, 7.20], [1.47, 1.58, 0.51, 0.53]),
    row([50.0, 20.0, 6.35, 7.26], [1.50, 1.60, 0.44, 0.45]),
    row([100.0, 40.0, 12.7, 7.26], [1.50, 1.60, 0.44, 0.45]),
    row([32.0, 15.0, 6.35, 8.49], [1.97, 2.10, 0.64, 0.66]),
    row([50.0, 25.0, 6.35, 9.04], [2.31, 2.39, 0.43, 0.43]),
    row([32.0, 20.0, 6.35, 11.25], [3.42, 3.48, 0.61, 0.61]),
    row([80.0, 60.0, 9.525, 13.43], [5.04, 5.07, 0.37, 0.38]),
    row([25.0, 20.0, 3.5, 14.29], [5.63, 5.71, 0.41, 0.43]),
    row([40.0, 40.0, 6.35, 17.66], [8.42, 8.71, 0.41, 0.45]),
    row([32.0, 32.0, 4.762, 17.66], [8.46, 8.74, 0.39, 0.42]),
    row([50.0, 60.0, 6.35, 20.91], [11.87, 12.29, 0.29, 0.34]),
    row([32.0, 40.0, 4.762, 21.70], [12.61, 13.14, 0.32, 0.38]),
    row([63.0, 80.0, 7.144, 22.01], [13.20, 13.63, 0.25, 0.29]),
    row([40.0, 60.0, 6.35, 25.52], [17.11, 17.94, 0.26, 0.35]),
    row([40.0, 60.0, 7.144, 25.52], [16.94, 17.87, 0.29, 0.38]),
    row([25.0, 50.0, 3.5, 32.48], [27.04, 28.19, 0.12, 0.23]),
    row([32.0, 64.0, 4.762, 32.48], [26.94, 28.15, 0.13, 0.25]),
    row([50.0, 100.0, 7.144, 32.48], [27.01, 28.17, 0.12, 0.23]),
    row([20.0, 50.0, 3.5, 38.51], [36.18, 37.91, 0.15, 0.62]),
    row([20.0, 65.0, 3.5, 43.68], [44.93, 46.83, 0.26, 0.91]),
    row([25.0, 80.0, 3.5, 45.53], [48.66, 50.22, 0.26, 0.81]),
];
