//! The load cases of the dissertation, and the one of the program's interface.

use super::ball::NutPose;
use super::contact::{ContactConstants, HertzConvention};
use super::geometry::Geometry;
use super::problem::{Load, Setup, StaticLoad, Support, even_train};
use super::shaft::Shaft;
use crate::error::{ReferenceError, within};
use crate::material::Elastic;

/// An end of a screw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScrewEnd {
    /// At position 0, before the first ball: the loaded end in Lin 2019.
    #[default]
    Left,
    /// At the screw's length, behind the last ball.
    Right,
}

/// A ball screw with a held nut, loaded at one end, which is guided along the axis, while the other one is free: the
/// case studies of Lin 2019, section 2.4.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseStudy {
    /// Nominal geometry.
    pub geometry: Geometry,
    /// Material of all bodies.
    pub elastic: Elastic,
    /// Length of the screw, m.
    pub screw_length: f64,
    /// Outer diameter of the screw, m.
    pub screw_diameter: f64,
    /// Number of balls.
    pub balls: usize,
    /// Angle between neighbouring balls on the path, rad.
    pub ball_spacing: f64,
    /// Azimuth of the first ball on the path, rad.
    pub first_azimuth: f64,
    /// Axial centre of the balls, m.
    pub nut_position: f64,
    /// Axial load on the loaded end, N; positive towards the right end.
    pub axial_load: f64,
    /// Which end is loaded, and guided along the axis.
    pub loaded_end: ScrewEnd,
    /// Oversize of the balls' radius, m: none, one for all, or one for each.
    pub ball_oversize: Vec<f64>,
    /// Displacement in x forced on the other end, m; free without.
    pub end_offset: Option<f64>,
    /// Division of each element.
    pub refinement: usize,
    /// Convention of the Hertzian constants.
    pub convention: HertzConvention,
}

impl CaseStudy {
    /// Table 2.1 with an outer diameter of 32 mm, which the dissertation does not print, under 5000 N.
    pub fn table_2_1() -> Self {
        Self {
            geometry: Geometry {
                pitch_radius: 16.5e-3,
                lead: 20e-3,
                ball_radius: 2.778e-3,
                groove_radius: 3.254e-3,
                contact_angle: std::f64::consts::FRAC_PI_4,
            },
            elastic: Elastic::STEEL,
            screw_length: 0.8,
            screw_diameter: 32e-3,
            balls: 32,
            ball_spacing: std::f64::consts::PI / 8.0,
            first_azimuth: 0.0,
            nut_position: 0.4,
            axial_load: 5000.0,
            loaded_end: ScrewEnd::Left,
            ball_oversize: Vec::new(),
            end_offset: None,
            refinement: 1,
            convention: HertzConvention::Correct,
        }
    }

    /// Table 4.1: 71 balls on 3.75 turns, the first half a spacing after azimuth zero, with an outer
    /// diameter of 28 mm, which is not printed, under 1000 N.
    pub fn table_4_1() -> Self {
        Self {
            geometry: Geometry {
                pitch_radius: 14.5e-3,
                lead: 7e-3,
                ball_radius: 2e-3,
                groove_radius: 2.16e-3,
                contact_angle: std::f64::consts::FRAC_PI_4,
            },
            screw_length: 0.75,
            screw_diameter: 28e-3,
            balls: 71,
            ball_spacing: 3.75 * std::f64::consts::TAU / 71.0,
            first_azimuth: 0.5 * 3.75 * std::f64::consts::TAU / 71.0,
            nut_position: 0.154,
            axial_load: 1000.0,
            ..Self::table_2_1()
        }
    }

    /// The load case with everything that can be added to it.
    pub fn setup(&self) -> Result<Setup, ReferenceError> {
        self.geometry.check()?;
        if !(1..=super::problem::LARGEST_TRAIN).contains(&self.balls) {
            return Err(ReferenceError::input(
                "balls",
                format!(
                    "{} is not within 1 to {}",
                    self.balls,
                    super::problem::LARGEST_TRAIN
                ),
            ));
        }
        within("ball_spacing", self.ball_spacing, 0.0, 1e3)?;
        within("first_azimuth", self.first_azimuth, -1e3, 1e3)?;
        within("nut_position", self.nut_position, 0.0, 100.0)?;
        within("axial_load", self.axial_load, -1e8, 1e8)?;
        let mut balls = even_train(
            &self.geometry,
            self.balls,
            self.ball_spacing,
            self.nut_position,
            self.first_azimuth,
        );
        match self.ball_oversize.as_slice() {
            [] => {}
            [all] => balls.iter_mut().for_each(|ball| ball.oversize = *all),
            each if each.len() == balls.len() => {
                for (ball, oversize) in balls.iter_mut().zip(each) {
                    ball.oversize = *oversize;
                }
            }
            each => {
                return Err(ReferenceError::input(
                    "ball_oversize",
                    format!("has {} entries for {} balls", each.len(), balls.len()),
                ));
            }
        }
        let train = [
            balls.first().map_or(0.0, |ball| ball.position),
            balls.last().map_or(0.0, |ball| ball.position),
        ];
        let shaft = Shaft::screw(
            &self.geometry,
            self.elastic,
            (self.screw_length, self.screw_diameter),
            train,
            self.refinement,
        )?;
        let (loaded, other) = match self.loaded_end {
            ScrewEnd::Left => (0.0, self.screw_length),
            ScrewEnd::Right => (self.screw_length, 0.0),
        };
        let mut supports = vec![Support::axial_guide(loaded)];
        if let Some(offset) = self.end_offset {
            within("end_offset", offset, -0.1, 0.1)?;
            supports.push(Support {
                position: other,
                held: [Some(offset), None, None, None, None, None],
            });
        }
        Ok(Setup {
            geometry: self.geometry,
            shaft,
            contact: ContactConstants::of_one_material(
                &self.geometry,
                self.elastic,
                self.convention,
            )?,
            balls,
            supports,
            loads: vec![Load::axial(loaded, self.axial_load)],
            nut: NutPose::default(),
            errors: std::array::from_fn(|_| Vec::new()),
            local_curvature: None,
        })
    }

    /// The load case.
    pub fn load(&self) -> Result<StaticLoad, ReferenceError> {
        StaticLoad::new(self.setup()?)
    }
}
