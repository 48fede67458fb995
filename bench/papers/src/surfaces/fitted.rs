//! Measured groove surfaces: profiles from a CSV file, interpolated with two continuous derivatives.

use std::io::Read;

use nalgebra::Vector2;

use super::spline::{CardinalSplines, Ends, Knots, Spline};
use epas_reference::error::{ReferenceError, within};
use epas_reference::statics::surface::{Deviation, SurfaceError};
use epas_reference::statics::{Contact, Geometry};

/// Largest number of measured points, and of measured sections.
const MOST_POINTS: usize = 1_000_000;
const MOST_SECTIONS: usize = 2_000;
/// Largest deviation as a share of the groove radius: beyond, the points belong to another groove.
const LARGEST_DEVIATION: f64 = 0.2;

/// Course along the groove.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// Measured from one end to the other; beyond them the error goes on as a straight line.
    Open,
    /// One turn was measured, and every turn is like it.
    EveryTurn,
}

/// One measured point of a groove surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredPoint {
    /// Azimuth of the section on the ball path, rad.
    pub azimuth: f64,
    /// Section angle, rad; the nominal contact is at the contact angle.
    pub section_angle: f64,
    /// Offset of the surface towards the arc's centre, m.
    pub offset: f64,
}

impl MeasuredPoint {
    /// A point by its coordinates in the section, m, from the nominal ball centre: `x` outward from the
    /// screw's axis, `z` across the groove.
    #[must_use]
    pub fn from_section(
        geometry: &Geometry,
        contact: Contact,
        azimuth: f64,
        [x, z]: [f64; 2],
    ) -> Self {
        let [outward, along] = contact.signs();
        let arm = geometry.arc_centre(contact) - Vector2::new(x, z);
        Self {
            azimuth,
            section_angle: (along * arm.y).atan2(outward * arm.x),
            offset: geometry.groove_radius - arm.norm(),
        }
    }
}

/// A measured groove surface: `C2` functions fitted to point clouds (Lin 2019, after eq. (2.3)).
///
/// Each measured section, which is all points of one azimuth, is a natural cubic spline over the section
/// angle; the sections are joined by a cubic spline over the azimuth. The surface goes through every point
/// and its second derivatives are continuous. `e(phi, gamma) = sum over k of w_k(phi) s_k(gamma)`, with the
/// sections' splines `s_k` and the cardinal splines `w_k` of their azimuths.
#[derive(Debug)]
pub struct FittedSurface {
    along: CardinalSplines,
    sections: Vec<Spline>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct PolarRow {
    azimuth: f64,
    section_angle: f64,
    deviation: f64,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct SectionRow {
    azimuth: f64,
    x: f64,
    z: f64,
}

impl FittedSurface {
    /// Reads a table with the columns `azimuth,section_angle,deviation` (rad, rad, m; the deviation
    /// towards the arc's centre) or `azimuth,x,z` (rad, m, m; see [`MeasuredPoint::from_section`]), in any
    /// order of rows. Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// [`ReferenceError`] naming `profile`, with the line.
    pub fn from_csv(
        geometry: &Geometry,
        contact: Contact,
        table: impl Read,
        along: Along,
    ) -> Result<Self, ReferenceError> {
        let bad = |error: csv::Error| ReferenceError::input("profile", error.to_string());
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(table);
        let cartesian = reader
            .headers()
            .map_err(bad)?
            .iter()
            .any(|name| name == "x");
        let mut points = Vec::new();
        if cartesian {
            for row in reader.deserialize() {
                let SectionRow { azimuth, x, z } = row.map_err(bad)?;
                points.push(MeasuredPoint::from_section(
                    geometry,
                    contact,
                    azimuth,
                    [x, z],
                ));
            }
        } else {
            for row in reader.deserialize() {
                let row: PolarRow = row.map_err(bad)?;
                points.push(MeasuredPoint {
                    azimuth: row.azimuth,
                    section_angle: row.section_angle,
                    offset: row.deviation,
                });
            }
        }
        Self::new(geometry, points, along)
    }

    /// Fits points in any order.
    ///
    /// # Errors
    /// [`ReferenceError`] naming `profile` where there are no points, too many, one far off the nominal
    /// surface, or two at the same place.
    pub fn new(
        geometry: &Geometry,
        mut points: Vec<MeasuredPoint>,
        along: Along,
    ) -> Result<Self, ReferenceError> {
        if points.is_empty() || points.len() > MOST_POINTS {
            return Err(ReferenceError::input(
                "profile",
                format!("{} points; allowed: 1 to {MOST_POINTS}", points.len()),
            ));
        }
        let largest = LARGEST_DEVIATION * geometry.groove_radius;
        for point in &points {
            within("profile", point.azimuth, -1e7, 1e7)?;
            within("profile", point.section_angle, -3.2, 3.2)?;
            within("profile", point.offset, -largest, largest)?;
        }
        points.sort_by(|a, b| {
            (a.azimuth, a.section_angle)
                .partial_cmp(&(b.azimuth, b.section_angle))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let mut azimuths = Vec::new();
        let mut sections = Vec::new();
        for section in points.chunk_by(|a, b| b.azimuth - a.azimuth <= 1e-9) {
            azimuths.push(section[0].azimuth);
            let places = section.iter().map(|point| point.section_angle).collect();
            let values = section.iter().map(|point| point.offset).collect();
            let knots = Knots::new("profile", places, Ends::Natural)?;
            sections.push(Spline::new("profile", knots, values)?);
        }
        if sections.len() > MOST_SECTIONS {
            return Err(ReferenceError::input(
                "profile",
                format!("{} sections; allowed: 1 to {MOST_SECTIONS}", sections.len()),
            ));
        }
        let ends = match along {
            Along::Open => Ends::Natural,
            Along::EveryTurn => Ends::Periodic(std::f64::consts::TAU),
        };
        Ok(Self {
            along: CardinalSplines::new(Knots::new("profile", azimuths, ends)?),
            sections,
        })
    }
}

impl SurfaceError for FittedSurface {
    fn deviation(&self, azimuth: f64, section_angle: f64) -> Deviation {
        self.along
            .weights(azimuth)
            .into_iter()
            .zip(&self.sections)
            // Weights fall by a factor of 3.7 from section to section; those below a rounding are none.
            .filter(|(weight, _)| weight.abs() > 1e-16)
            .fold(Deviation::default(), |sum, (weight, section)| {
                let here = section.offset(section_angle);
                sum + Deviation {
                    shift: [0.0; 2],
                    offset: weight * here.offset,
                    slope: weight * here.slope,
                    bend: weight * here.bend,
                }
            })
    }
}
