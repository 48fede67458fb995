//! The four forms of the first curvature, side by side against the Weingarten map.

use epas_friction::{
    CircularGrooveCurvature, ContactAngle, FittedCurvature, GothicArch, Groove, GrooveProfile,
    HelixPath, LiteratureCurvature,
};
use epas_reference::curvature::{self, Surface, profile};
use epas_reference::published::{self, CONFORMITY, Row};

/// The four forms, the cheapest first.
pub const FORMS: [&str; 4] = ["literature", "circular groove", "fitted", "exact"];

/// Both grooves with their names.
pub const GROOVES: [(Groove, &str); 2] = [(Groove::Screw, "screw"), (Groove::Nut, "nut")];

/// The reference's name for a groove.
pub const fn reference(groove: Groove) -> curvature::Groove {
    match groove {
        Groove::Screw => curvature::Groove::Screw,
        Groove::Nut => curvature::Groove::Nut,
    }
}

/// The four forms of one groove, and the surface in float64.
pub struct Forms {
    /// The exact surface.
    pub surface: Surface,
    literature: LiteratureCurvature,
    circular: CircularGrooveCurvature,
    fitted: FittedCurvature,
    exact: GothicArch,
}

impl Forms {
    /// The forms of a surface, its numbers rounded to f32; the fit made for contact angles up to
    /// `fit_range`, rad.
    pub fn new(groove: Groove, surface: Surface, ball_radius: f64, fit_range: f32) -> Self {
        let path =
            HelixPath::from_lead_angle(surface.pitch_radius as f32, surface.lead_angle as f32);
        let section = GrooveProfile {
            groove_radius: surface.groove_radius as f32,
            offset_h: surface.offset_h as f32,
            offset_l: surface.offset_l as f32,
        };
        let exact = GothicArch::new(groove, &path, &section);
        Self {
            surface,
            literature: LiteratureCurvature::new(
                groove,
                surface.pitch_radius as f32,
                ball_radius as f32,
            ),
            circular: CircularGrooveCurvature::new(groove, &path, section.groove_radius),
            fitted: FittedCurvature::new(&exact, fit_range),
            exact,
        }
    }

    /// The forms of a row of the printed tables.
    pub fn of_row(groove: Groove, row: &Row) -> Self {
        Self::new(
            groove,
            row.surface(reference(groove)),
            0.5 * row.ball_diameter,
            epas_friction::curvature::DEFAULT_FIT_RANGE,
        )
    }

    /// First radius of curvature by each form at a contact angle, rad.
    pub fn radii(&self, contact_angle: f64) -> [f64; 4] {
        let angle = ContactAngle::new(contact_angle as f32);
        [
            self.literature.first(angle),
            self.circular.first(angle),
            self.fitted.first(angle),
            self.exact.principal(angle).kappa1,
        ]
        .map(|kappa1| 1.0 / f64::from(kappa1))
    }

    /// The true first radius of curvature.
    pub fn true_radius(&self, contact_angle: f64) -> f64 {
        1.0 / self.surface.principal(contact_angle).kappa1
    }

    /// Relative error of each form's radius at a contact angle.
    pub fn errors(&self, contact_angle: f64) -> [f64; 4] {
        let truth = self.true_radius(contact_angle);
        self.radii(contact_angle)
            .map(|radius| (radius / truth - 1.0).abs())
    }

    /// Mean and largest error of each form over the contact angles of the printed tables.
    pub fn table_errors(&self) -> [(f64, f64); 4] {
        let mut errors = [(0.0, 0.0_f64); 4];
        for degrees in 1..=70 {
            for (error, (mean, largest)) in self
                .errors(f64::from(degrees).to_radians())
                .into_iter()
                .zip(&mut errors)
            {
                *mean += error / 70.0;
                *largest = largest.max(error);
            }
        }
        errors
    }
}

/// The ball screw of Figures 8, 9 and 11 (lengths in mm) at a lead angle, rad.
pub fn figure_screw(groove: Groove, lead_angle: f64) -> Forms {
    const PITCH_RADIUS: f64 = 8.0;
    const BALL_RADIUS: f64 = 1.5875;
    // Contact angles reach 80 degrees.
    const FIT_RANGE: f32 = 1.431_17;
    let (groove_radius, offset_h, offset_l) =
        profile(BALL_RADIUS, CONFORMITY, std::f64::consts::FRAC_PI_4);
    let surface = Surface {
        groove: reference(groove),
        pitch_radius: PITCH_RADIUS,
        lead_angle,
        groove_radius,
        offset_h,
        offset_l,
    };
    Forms::new(groove, surface, BALL_RADIUS, FIT_RANGE)
}

/// The printed table of a groove.
pub const fn printed(groove: Groove) -> &'static [Row; 31] {
    match groove {
        Groove::Screw => &published::TABLE_A1,
        Groove::Nut => &published::TABLE_A2,
    }
}
