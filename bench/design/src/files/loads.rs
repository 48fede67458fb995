//! A ball screw between its supports, from which the load of each ball follows.

use std::f64::consts::TAU;
use std::sync::Arc;

use epas_friction::{BallScrew, GrooveSize};
use epas_reference::ReferenceError;
use epas_reference::statics::cases::{CaseStudy, ScrewEnd};
use epas_reference::statics::surface::HarmonicError;
use epas_reference::statics::{Elastic, Geometry, HertzConvention, StaticLoad};
use serde::Deserialize;

/// Table `[loads]` of a design file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadsTable {
    screw_length: f64,
    screw_diameter: f64,
    nut_position: f64,
    axial_load: f64,
    loaded_end: Option<LoadedEnd>,
    turns: Option<f64>,
    ball_spacing: Option<f64>,
    ball_oversize: Option<Oversize>,
    end_offset: Option<f64>,
    pitch_error: Option<f64>,
    roundness_error: Option<f64>,
}

/// The end of the screw that is loaded and guided along the axis.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum LoadedEnd {
    #[default]
    Left,
    Right,
}

impl From<LoadedEnd> for ScrewEnd {
    fn from(end: LoadedEnd) -> Self {
        match end {
            LoadedEnd::Left => Self::Left,
            LoadedEnd::Right => Self::Right,
        }
    }
}

/// One for all balls, or one for each.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Oversize {
    All(f64),
    Each(Vec<f64>),
}

/// A load case of the static model.
#[derive(Clone, Debug)]
pub struct LoadCase {
    /// Everything but errors of the grooves.
    pub case: CaseStudy,
    /// Amplitude of the screw's pitch error, once a turn, m.
    pitch_error: f64,
    /// Amplitude of the screw's roundness error, twice a turn, m.
    roundness_error: f64,
}

impl LoadsTable {
    /// The load case of a checked geometry.
    pub fn case(self, screw: &BallScrew, loaded_balls: Option<u16>) -> Result<LoadCase, String> {
        let parameters = screw.parameters();
        let radius = |groove: GrooveSize| match groove {
            GrooveSize::Radius(radius) => f64::from(radius),
            GrooveSize::Conformity(conformity) => {
                2.0 * f64::from(conformity) * f64::from(parameters.ball_radius)
            }
        };
        let (groove_radius, of_nut) = (
            radius(parameters.screw_groove),
            radius(parameters.nut_groove),
        );
        if (groove_radius - of_nut).abs() > 1e-6 * groove_radius {
            return Err("the static model has one groove radius for screw and nut".into());
        }
        let material = parameters.groove_material;
        if material != parameters.ball_material {
            return Err("the static model has one material for balls and grooves".into());
        }
        let balls = loaded_balls.ok_or("loaded_balls is missing")?;
        let ball_spacing = match (self.ball_spacing, self.turns) {
            (Some(spacing), None) => spacing,
            (None, Some(turns)) => turns * TAU / f64::from(balls),
            (None, None) => return Err("turns or ball_spacing is missing".into()),
            (Some(_), Some(_)) => {
                return Err(
                    "turns and ball_spacing are both given; one of them follows from the other"
                        .into(),
                );
            }
        };
        Ok(LoadCase {
            case: CaseStudy {
                geometry: Geometry {
                    pitch_radius: parameters.pitch_radius.into(),
                    lead: parameters.lead.into(),
                    ball_radius: parameters.ball_radius.into(),
                    groove_radius,
                    contact_angle: parameters.contact_angle.into(),
                },
                elastic: Elastic {
                    youngs_modulus: material.youngs_modulus.into(),
                    poisson_ratio: material.poisson_ratio.into(),
                },
                screw_length: self.screw_length,
                screw_diameter: self.screw_diameter,
                balls: balls.into(),
                ball_spacing,
                first_azimuth: 0.0,
                nut_position: self.nut_position,
                axial_load: self.axial_load,
                loaded_end: self.loaded_end.unwrap_or_default().into(),
                ball_oversize: match self.ball_oversize {
                    None => Vec::new(),
                    Some(Oversize::All(all)) => vec![all; balls.into()],
                    Some(Oversize::Each(each)) if each.len() == usize::from(balls) => each,
                    Some(Oversize::Each(each)) => {
                        return Err(format!(
                            "ball_oversize has {} numbers for {balls} balls",
                            each.len()
                        ));
                    }
                },
                end_offset: self.end_offset,
                refinement: 1,
                convention: HertzConvention::Correct,
            },
            pitch_error: error("pitch_error", self.pitch_error)?,
            roundness_error: error("roundness_error", self.roundness_error)?,
        })
    }
}

fn error(field: &str, amplitude: Option<f64>) -> Result<f64, String> {
    let amplitude = amplitude.unwrap_or(0.0);
    if (-1e-3..=1e-3).contains(&amplitude) {
        Ok(amplitude)
    } else {
        Err(format!(
            "{field} = {amplitude} is out of range; allowed: -0.001 to 0.001"
        ))
    }
}

/// The load cases of Lin 2019, where a built-in design has one.
pub fn built_in(name: &str, loaded_balls: u16) -> Option<LoadCase> {
    let case = match name {
        "lin-2.1" => CaseStudy::table_2_1(),
        "lin-3.6" => {
            let case = CaseStudy::table_2_1();
            let mut geometry = case.geometry;
            geometry.groove_radius = 1.12 * geometry.ball_radius;
            // 37 balls on two turns under 1500 N (section 3.4.4).
            CaseStudy {
                geometry,
                balls: loaded_balls.into(),
                ball_spacing: 2.0 * TAU / f64::from(loaded_balls),
                axial_load: 1500.0,
                ..case
            }
        }
        "lin-4.1" => CaseStudy::table_4_1(),
        _ => return None,
    };
    Some(LoadCase {
        case,
        pitch_error: 0.0,
        roundness_error: 0.0,
    })
}

impl LoadCase {
    /// The same with other amplitudes of the screw's pitch and roundness errors, m.
    #[must_use]
    pub fn with_errors(self, pitch_error: f64, roundness_error: f64) -> Self {
        Self {
            pitch_error,
            roundness_error,
            ..self
        }
    }

    /// The same under another axial load, N.
    #[must_use]
    pub fn under(&self, axial_load: f64) -> Self {
        let mut other = self.clone();
        other.case.axial_load = axial_load;
        other
    }

    /// The load case, checked.
    pub fn load(&self) -> Result<StaticLoad, ReferenceError> {
        let mut setup = self.case.setup()?;
        let geometry = setup.geometry;
        for error in [
            HarmonicError::pitch(&geometry, self.pitch_error),
            HarmonicError::roundness(self.roundness_error),
        ] {
            if error.amplitude != 0.0 {
                for surface in &mut setup.errors[..2] {
                    surface.push(Arc::new(error));
                }
            }
        }
        StaticLoad::new(setup)
    }
}
