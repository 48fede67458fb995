//! Groove surfaces as functions with geometric errors: Lin 2019, eq. (2.3), (2.27), (4.1), (4.3).

use std::fmt::Debug;

use super::geometry::Geometry;

/// How a groove surface deviates from its nominal arc at one azimuth and section angle.
///
/// `A(phi, gamma) = (r_G - offset(gamma)) (-cos gamma, -sin gamma) + o + shift`, in the section and
/// mirrored so that every nominal contact has `gamma = beta`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Shift of the arc's centre outward and along `z3`, m.
    pub shift: [f64; 2],
    /// Offset of the surface towards the arc's centre, m.
    pub offset: f64,
    /// Its first derivative over the section angle, m/rad.
    pub slope: f64,
    /// Its second derivative over the section angle, m/rad².
    pub bend: f64,
}

impl std::ops::Add for Deviation {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            shift: [
                self.shift[0] + other.shift[0],
                self.shift[1] + other.shift[1],
            ],
            offset: self.offset + other.offset,
            slope: self.slope + other.slope,
            bend: self.bend + other.bend,
        }
    }
}

/// A geometric error of one groove surface, twice differentiable over the section angle.
pub trait SurfaceError: Debug + Send + Sync {
    /// The deviation at an azimuth on the ball path and a section angle, rad.
    fn deviation(&self, azimuth: f64, section_angle: f64) -> Deviation;

    /// Whether the offset is zero everywhere, so that the section stays a circular arc.
    fn keeps_the_arc(&self) -> bool {
        false
    }
}

/// Profile error that is the same all along the groove: an offset `constant + slope gamma` towards the
/// arc's centre, as by uneven tool wear (Lin 2019, section 2.4.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileError {
    /// Offset at section angle zero, m.
    pub constant: f64,
    /// Change of the offset with the section angle, m/rad.
    pub slope: f64,
}

impl SurfaceError for ProfileError {
    fn deviation(&self, _: f64, section_angle: f64) -> Deviation {
        Deviation {
            offset: self.constant + self.slope * section_angle,
            slope: self.slope,
            ..Deviation::default()
        }
    }
}

/// Direction in which a harmonic error moves the arc's centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Outward, `x3`: runout and roundness.
    Radial,
    /// Across the groove, `z3`.
    Across,
}

/// The arc's centre moved by `amplitude sin(cycles phi + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicError {
    /// Direction.
    pub direction: Direction,
    /// Amplitude, m.
    pub amplitude: f64,
    /// Cycles per revolution.
    pub cycles: f64,
    /// Phase, rad.
    pub phase: f64,
}

impl HarmonicError {
    /// Pitch error, eq. (4.1): the ball path moved along the axis by `amplitude sin(phi)`. Of it only
    /// the part `cos(alpha)` across the groove moves the section; eq. (4.2).
    pub fn pitch(geometry: &Geometry, amplitude: f64) -> Self {
        Self {
            direction: Direction::Across,
            amplitude: amplitude * geometry.lead_angle().cos(),
            cycles: 1.0,
            phase: 0.0,
        }
    }

    /// Roundness error, eq. (4.3): the pitch radius changed by `amplitude sin(2 phi)`; eq. (4.4).
    pub const fn roundness(amplitude: f64) -> Self {
        Self {
            direction: Direction::Radial,
            amplitude,
            cycles: 2.0,
            phase: 0.0,
        }
    }

    /// Error of the groove centre across the groove, `amplitude sin(cycles phi)` (section 2.4.2).
    pub const fn across(amplitude: f64, cycles: f64) -> Self {
        Self {
            direction: Direction::Across,
            amplitude,
            cycles,
            phase: 0.0,
        }
    }
}

impl SurfaceError for HarmonicError {
    fn deviation(&self, azimuth: f64, _: f64) -> Deviation {
        let value = self.amplitude * (self.cycles * azimuth + self.phase).sin();
        Deviation {
            shift: match self.direction {
                Direction::Radial => [value, 0.0],
                Direction::Across => [0.0, value],
            },
            ..Deviation::default()
        }
    }

    fn keeps_the_arc(&self) -> bool {
        true
    }
}
