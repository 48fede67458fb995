//! Friction of a four-point and of a double-row angular contact ball bearing under a load that turns from axial to radial (Lin 2019,
//! section 4.3.1, Table 4.2 and Figure 4.7).
//!
//! The text leaves out the undersize of the balls, the friction coefficient, whether the inner ring can tilt, the azimuth of the
//! balls, and distance and arrangement of the two rows: they are inputs here, with defaults. The comparison is in kind: the
//! four-point bearing's friction varies several times over, the double-row bearing's little.

use crate::rotary_ball::{RotaryBearing, RotaryConvention};
use crate::rotary_bearing::{BallRow, LoadedBearing, Raceways, RingLoad, Tilt, distribute};
use epas_reference::error::ReferenceError;

/// The case study; [`TurningLoad::default`] is Table 4.2 with the defaults named at each field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningLoad {
    /// Force on the inner ring, N; printed, 3000.
    pub force: f64,
    /// Speed of the inner ring, rad/s; printed, 10 revolutions a second.
    pub inner_speed: f64,
    /// Friction coefficient; not printed, 0.1 as in Table 3.1.
    pub friction: f64,
    /// Ball radius less than fits the grooves, m, of both bearings; not printed, 0.
    pub undersize: f64,
    /// Whether the inner ring can tilt; not printed, the rack holds it.
    pub tilt: Tilt,
    /// Distance of the two rows, m; not printed, half the printed thickness, 12 mm. Back to back. Of no effect without tilt.
    pub row_distance: f64,
    /// Azimuth of the first ball from the plane of the load, rad; not printed, 0.
    pub phase: f64,
    /// Curvature and Hertz conventions; physically right ones.
    pub convention: RotaryConvention,
}

impl Default for TurningLoad {
    fn default() -> Self {
        Self {
            force: 3000.0,
            inner_speed: 20.0 * std::f64::consts::PI,
            friction: 0.1,
            undersize: 0.0,
            tilt: Tilt::Held,
            row_distance: 12e-3,
            phase: 0.0,
            convention: RotaryConvention::Physical,
        }
    }
}

/// Both bearings under one direction of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningPoint {
    /// Angle of the force from the axis, rad.
    pub angle: f64,
    /// Friction torque of the four-point bearing, N m.
    pub four_point: f64,
    /// Friction torque of the double-row bearing, N m.
    pub double_row: f64,
    /// Balls of the four-point bearing with all four contacts loaded.
    pub four_point_balls: usize,
    /// Balls of the four-point bearing without load.
    pub lost_balls: usize,
}

impl TurningLoad {
    fn bearing(&self, ball_radius: f64) -> RotaryBearing {
        RotaryBearing {
            ball_radius,
            pitch_radius: 35e-3,
            conformity: 0.54,
            contact_angle: std::f64::consts::FRAC_PI_4,
            youngs_modulus: 2.1e11,
            poisson_ratio: 0.28,
            convention: self.convention,
        }
    }

    /// The four-point bearing: nine balls of 6.25 mm radius in grooves of 6.75 mm.
    #[must_use]
    pub fn four_point(&self) -> [BallRow; 1] {
        [BallRow {
            bearing: self.bearing(6.25e-3),
            raceways: Raceways::FourPoint,
            balls: 9,
            position: 0.0,
            phase: self.phase,
            oversize: -self.undersize,
        }]
    }

    /// The double-row bearing: twice nine balls of 4 mm radius in grooves of 4.32 mm, back to back.
    #[must_use]
    pub fn double_row(&self) -> [BallRow; 2] {
        [
            (Raceways::Forward, -0.5 * self.row_distance),
            (Raceways::Backward, 0.5 * self.row_distance),
        ]
        .map(|(raceways, position)| BallRow {
            bearing: self.bearing(4e-3),
            raceways,
            balls: 9,
            position,
            phase: self.phase,
            oversize: -self.undersize,
        })
    }

    /// Load distribution under a force at `angle` from the axis, in the plane of axis and first ball.
    ///
    /// # Errors
    /// As [`distribute`].
    pub fn loaded(&self, rows: &[BallRow], angle: f64) -> Result<LoadedBearing, ReferenceError> {
        let (sin, cos) = angle.sin_cos();
        let load = RingLoad {
            axial: self.force * cos,
            radial: [self.force * sin, 0.0],
            moment: [0.0; 2],
        };
        distribute(rows, &load, self.tilt)
    }

    /// Both bearings under a force at `angle` (rad) from the axis.
    ///
    /// # Errors
    /// As [`distribute`] and [`LoadedBearing::friction`].
    pub fn at(&self, angle: f64) -> Result<TurningPoint, ReferenceError> {
        let (four, double) = (self.four_point(), self.double_row());
        let torque = |rows: &[BallRow], loaded: &LoadedBearing| {
            loaded
                .friction(rows, self.friction, self.inner_speed)
                .map(|friction| friction.torque)
        };
        let loaded = self.loaded(&four, angle)?;
        Ok(TurningPoint {
            angle,
            four_point: torque(&four, &loaded)?,
            double_row: torque(&double, &self.loaded(&double, angle)?)?,
            four_point_balls: loaded.four_point_balls(),
            lost_balls: loaded.lost_balls(),
        })
    }

    /// `steps + 1` directions from axial to radial.
    ///
    /// # Errors
    /// As [`TurningLoad::at`].
    pub fn sweep(&self, steps: usize) -> Result<Vec<TurningPoint>, ReferenceError> {
        (0..=steps)
            .map(|step| self.at(std::f64::consts::FRAC_PI_2 * step as f64 / steps.max(1) as f64))
            .collect()
    }
}

/// Largest over least of the values of a sweep: of the four-point and of the double-row bearing.
#[must_use]
pub fn variation(points: &[TurningPoint]) -> [f64; 2] {
    let ratio = |value: fn(&TurningPoint) -> f64| {
        let values = points.iter().map(value);
        values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
    };
    [
        ratio(|point| point.four_point),
        ratio(|point| point.double_row),
    ]
}
