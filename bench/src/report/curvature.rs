//! Groove curvature: the crate's four forms against the reference.

use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::{BallScrew, CATALOGUE};
use epas_reference::curvature::{self as reference, Surface};

use super::statistics::{Errors, evenly};
use epas_page::failure::Failure;

/// The four forms of the crate, in the order in which they are shown.
pub const FORMS: [&str; 4] = ["literature", "circular groove", "fitted", "exact"];

/// Both grooves, for the crate and for the reference.
pub const GROOVES: [(Groove, reference::Groove, &str); 2] = [
    (Groove::Screw, reference::Groove::Screw, "screw"),
    (Groove::Nut, reference::Groove::Nut, "nut"),
];

/// The crate's four forms for one groove.
pub struct Forms {
    /// See [`FORMS`].
    pub literature: LiteratureCurvature,
    /// See [`FORMS`].
    pub circular: CircularGrooveCurvature,
    /// See [`FORMS`].
    pub fitted: FittedCurvature,
    /// See [`FORMS`].
    pub exact: GothicArch,
}

impl Forms {
    /// For a groove of a design.
    pub fn of(design: &BallScrew, groove: Groove) -> Self {
        Self {
            literature: LiteratureCurvature::of(design, groove),
            circular: CircularGrooveCurvature::of(design, groove),
            fitted: FittedCurvature::of(design, groove),
            exact: GothicArch::of(design, groove),
        }
    }

    /// First curvature by each form.
    pub fn first(&self, contact_angle: f32) -> [f64; 4] {
        let angle = ContactAngle::new(contact_angle);
        [
            self.literature.first(angle),
            self.circular.first(angle),
            self.fitted.first(angle),
            self.exact.principal(angle).kappa1,
        ]
        .map(f64::from)
    }
}

/// The reference's surface of a design, from the same rounded numbers.
pub fn surface(design: &BallScrew, groove: Groove, same: reference::Groove) -> Surface {
    let profile = design.profile(groove);
    let pitch_radius = f64::from(design.pitch_radius());
    Surface {
        groove: same,
        pitch_radius,
        lead_angle: (f64::from(design.lead()) / (std::f64::consts::TAU * pitch_radius)).atan(),
        groove_radius: f64::from(profile.groove_radius),
        offset_h: f64::from(profile.offset_h),
        offset_l: f64::from(profile.offset_l),
    }
}

/// Errors of the four forms over all sizes and both grooves.
pub fn catalogue_errors(quick: bool) -> Result<[Errors; 4], Failure> {
    let steps = if quick { 70 } else { 700 };
    let mut all = [Errors::default(); 4];
    for size in CATALOGUE {
        let design = size.design()?;
        for groove in GROOVES {
            let forms = Forms::of(&design, groove.0);
            let surface = surface(&design, groove.0, groove.1);
            for degrees in evenly(0.0, 70.0, steps) {
                let angle = degrees.to_radians() as f32;
                let exact = surface.principal(f64::from(angle)).kappa1;
                for (errors, computed) in all.iter_mut().zip(forms.first(angle)) {
                    errors.add(computed / exact - 1.0);
                }
            }
        }
    }
    Ok(all)
}

/// Largest differences of the reference's separate derivations from the Weingarten map in the Frenet
/// frame, over all sizes and both grooves: the map as printed, and Appendix B.
pub fn double_errors() -> Result<[f64; 2], Failure> {
    let mut errors = [Errors::default(); 2];
    for size in CATALOGUE {
        let design = size.design()?;
        for (groove, same, _) in GROOVES {
            let surface = surface(&design, groove, same);
            for degrees in 0..=70 {
                let angle = f64::from(degrees).to_radians();
                let exact = surface.principal(angle).kappa1;
                let others = [
                    surface.principal_cartesian(angle).kappa1,
                    surface.appendix_b(angle),
                ];
                for (errors, other) in errors.iter_mut().zip(others) {
                    errors.add(other / exact - 1.0);
                }
            }
        }
    }
    Ok(errors.map(|errors| errors.largest))
}
