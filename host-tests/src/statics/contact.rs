//! Hertzian constants of the two contacts of a ball, and the dissertation's own values of them.

use nalgebra::{Matrix2, Vector3};

use super::geometry::Geometry;
use crate::curvature::{Groove, PrincipalCurvatures, Surface, profile};
use crate::error::ReferenceError;
use crate::hertz::{Hertz, axis_ratio};
use crate::material::Elastic;

/// How principal radii and Hertzian constants are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HertzConvention {
    /// Principal curvatures from `I^-1 II` and the exact contact ellipse.
    #[default]
    Correct,
    /// Lin 2019, appendix B as printed: principal radii as eigenvalues of the second fundamental form alone, eq. (B.4), which are no radii
    /// (along the path they are curvature times squared pitch radius), and the correction factor `F_1` = 1. Table B.1 reproduces with it
    /// and a groove radius of 0.56 ball diameters, 3.111 mm, not the 3.254 mm of Table 2.1.
    Dissertation,
}

/// One contact with a groove: radii and Hertzian constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveContact {
    /// Principal radii of the groove, m, convex positive: across the path, along it.
    pub principal_radii: [f64; 2],
    /// Relative radii, m: the smaller, the larger.
    pub relative_radii: [f64; 2],
    /// Eccentricity of the contact ellipse.
    pub eccentricity: f64,
    /// Deflection per load to the power 2/3, `C`, m/N^(2/3).
    pub deflection: f64,
    /// Semi-major axis per cube root of the load, m/N^(1/3).
    pub semi_major: f64,
    /// Semi-minor axis per cube root of the load, m/N^(1/3).
    pub semi_minor: f64,
}

/// Both contacts of a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactConstants {
    /// With the screw.
    pub screw: GrooveContact,
    /// With the nut.
    pub nut: GrooveContact,
}

impl ContactConstants {
    /// For screw, nut and balls of the given materials.
    pub fn new(
        geometry: &Geometry,
        [screw, nut, ball]: [Elastic; 3],
        convention: HertzConvention,
    ) -> Result<Self, ReferenceError> {
        geometry.check()?;
        let side = |groove, metal| contact(geometry, groove, metal, ball, convention);
        Ok(Self {
            screw: side(Groove::Screw, screw)?,
            nut: side(Groove::Nut, nut)?,
        })
    }

    /// All three bodies of one material.
    pub fn of_one_material(
        geometry: &Geometry,
        elastic: Elastic,
        convention: HertzConvention,
    ) -> Result<Self, ReferenceError> {
        Self::new(geometry, [elastic; 3], convention)
    }
}

/// Principal curvatures of the nominal groove at the nominal contact point, 1/m, convex positive.
pub fn nominal_curvatures(
    geometry: &Geometry,
    groove: Groove,
) -> Result<PrincipalCurvatures, ReferenceError> {
    let conformity = geometry.groove_radius / (2.0 * geometry.ball_radius);
    let (groove_radius, offset_h, offset_l) =
        profile(geometry.ball_radius, conformity, geometry.contact_angle);
    let surface = Surface {
        groove,
        pitch_radius: geometry.pitch_radius,
        lead_angle: geometry.lead_angle(),
        groove_radius,
        offset_h,
        offset_l,
    };
    surface.check(geometry.contact_angle)?;
    Ok(surface.principal(geometry.contact_angle))
}

fn contact(
    geometry: &Geometry,
    groove: Groove,
    metal: Elastic,
    ball: Elastic,
    convention: HertzConvention,
) -> Result<GrooveContact, ReferenceError> {
    metal.check()?;
    ball.check()?;
    let modulus = metal.contact_modulus(&ball);
    match convention {
        HertzConvention::Correct => {
            let curvatures = nominal_curvatures(geometry, groove)?;
            exact(geometry.ball_radius, curvatures, modulus)
        }
        HertzConvention::Dissertation => as_printed(geometry, groove, modulus),
    }
}

/// The exact contact of a ball with a surface of these curvatures.
pub fn exact(
    ball_radius: f64,
    curvatures: PrincipalCurvatures,
    contact_modulus: f64,
) -> Result<GrooveContact, ReferenceError> {
    let relative = [curvatures.kappa1, curvatures.kappa2]
        .map(|curvature| 1.0 / (1.0 / ball_radius + curvature));
    if relative.iter().any(|radius| *radius <= 0.0) {
        return Err(ReferenceError::input(
            "groove_radius",
            "the ball does not fit into the groove",
        ));
    }
    let hertz = Hertz::new(relative[0], relative[1], contact_modulus)?;
    Ok(GrooveContact {
        principal_radii: [1.0 / curvatures.kappa2, 1.0 / curvatures.kappa1],
        relative_radii: sorted(relative),
        eccentricity: (1.0 - hertz.axis_ratio * hertz.axis_ratio).sqrt(),
        deflection: hertz.deflection,
        semi_major: hertz.semi_major,
        semi_minor: hertz.semi_minor,
    })
}

fn sorted([first, second]: [f64; 2]) -> [f64; 2] {
    if first <= second {
        [first, second]
    } else {
        [second, first]
    }
}

fn as_printed(
    geometry: &Geometry,
    groove: Groove,
    contact_modulus: f64,
) -> Result<GrooveContact, ReferenceError> {
    let eigenvalues = second_form(geometry, groove).symmetric_eigenvalues();
    let [across, along] = {
        let from_arc = |value: f64| (value + geometry.groove_radius).abs();
        if from_arc(eigenvalues[0]) <= from_arc(eigenvalues[1]) {
            [eigenvalues[0], eigenvalues[1]]
        } else {
            [eigenvalues[1], eigenvalues[0]]
        }
    };
    let relative = [across, along].map(|radius| 1.0 / (1.0 / geometry.ball_radius + 1.0 / radius));
    let [small, large] = sorted(relative);
    if small <= 0.0 {
        return Err(ReferenceError::input(
            "groove_radius",
            "the ball does not fit into the groove by the printed radii",
        ));
    }
    let ratio = axis_ratio(large / small)?;
    // (B.2), (B.1), (B.10), (B.11) with the exponent 1/3.
    let equivalent = (small * large).sqrt();
    let mean_axis = (3.0 * equivalent / (4.0 * contact_modulus)).cbrt();
    Ok(GrooveContact {
        principal_radii: [across, along],
        relative_radii: [small, large],
        eccentricity: (1.0 - ratio * ratio).sqrt(),
        deflection: (9.0 / (16.0 * contact_modulus.powi(2) * equivalent)).cbrt(),
        semi_major: mean_axis / ratio.sqrt(),
        semi_minor: mean_axis * ratio.sqrt(),
    })
}

/// Second fundamental form of eq. (2.6) over azimuth and section angle, convex positive.
fn second_form(geometry: &Geometry, groove: Groove) -> Matrix2<f64> {
    let (sin, cos) = geometry.contact_angle.sin_cos();
    let (sin_lead, cos_lead) = geometry.lead_angle().sin_cos();
    let outward = groove.sign();
    let (radius, ball) = (geometry.groove_radius, geometry.ball_radius);
    // A vector of the section in the frame that has turned by the azimuth.
    let place = |x3: f64, z3: f64| Vector3::new(outward * x3, -sin_lead * z3, cos_lead * z3);
    let point = place(-ball * cos, -ball * sin) + Vector3::new(geometry.pitch_radius, 0.0, 0.0);
    let turned = |v: Vector3<f64>| Vector3::new(-v.y, v.x, 0.0);
    let along_azimuth = turned(point) + Vector3::new(0.0, 0.0, geometry.advance());
    let along_section = place(radius * sin, -radius * cos);
    let normal = along_azimuth.cross(&along_section).normalize();
    let azimuth_azimuth = Vector3::new(-point.x, -point.y, 0.0).dot(&normal);
    let mixed = turned(along_section).dot(&normal);
    let section_section = place(radius * cos, radius * sin).dot(&normal);
    // Along the section the groove is hollow, whichever way the normal points.
    let sense = -section_section.signum();
    sense * Matrix2::new(azimuth_azimuth, mixed, mixed, section_section)
}
