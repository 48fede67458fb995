//! One ball between its four arcs: penetration, force and stiffness of every contact.

use std::sync::Arc;

use nalgebra::{Matrix2, SMatrix, Vector2, Vector3};

use super::geometry::{Contact, Geometry, centre_signs};
use super::shaft::Shaft;
use super::surface::{Deviation, SurfaceError};

/// A surface's errors.
pub type Errors = Vec<Arc<dyn SurfaceError>>;

/// One ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Azimuth on the ball path, rad.
    pub azimuth: f64,
    /// Nominal axial position of its centre, m.
    pub position: f64,
    /// Oversize of its radius, m; negative where it is small.
    pub oversize: f64,
    /// Which of the four arcs (SL, SR, NL, NR) exist for it: an angular-contact row has two.
    pub arcs: [bool; 4],
}

impl Ball {
    /// A ball of nominal size that can touch all four arcs.
    pub const fn new(azimuth: f64, position: f64) -> Self {
        Self {
            azimuth,
            position,
            oversize: 0.0,
            arcs: [true; 4],
        }
    }
}

/// Where the rigid nut stands: a small motion off its nominal place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NutPose {
    /// Place on the axis that it turns about, m.
    pub position: f64,
    /// Displacement, m.
    pub displacement: [f64; 3],
    /// Rotation, rad.
    pub rotation: [f64; 3],
}

/// One contact of one ball, with everything that does not change while the loads are found.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Which arc.
    pub contact: Contact,
    /// Centre of the arc from the nominal ball centre, m, without shift.
    centre: Vector2<f64>,
    excess: f64,
    shift: Vector2<f64>,
    groove_radius: f64,
    oversize: f64,
    /// `C^(-3/2)`, N/m^(3/2).
    stiffness: f64,
    profile: Errors,
    azimuth: f64,
    /// First node of the shaft that moves the arc; none on the nut.
    pub node: Option<usize>,
    /// Motion of the arc's centre with that node and the next.
    pub motion: SMatrix<f64, 2, 12>,
}

/// State of one contact.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Force, N; 0 without contact.
    pub force: f64,
    /// Energy, J.
    pub energy: f64,
    /// Unit vector from the arc's centre to the ball's; the ball is pushed against it.
    pub normal: Vector2<f64>,
    /// Second derivative of the energy over the ball's centre, N/m.
    pub stiffness: Matrix2<f64>,
}

/// What the contacts of all balls have in common.
pub struct ArmInput<'a> {
    /// Nominal geometry.
    pub geometry: &'a Geometry,
    /// The shaft.
    pub shaft: &'a Shaft,
    /// The nut.
    pub nut: &'a NutPose,
    /// Errors of the surfaces SL, SR, NL, NR.
    pub errors: &'a [Errors; 4],
    /// Hertzian constants of nominal contacts with screw and nut, m/N^(2/3).
    pub deflection: [f64; 2],
}

impl Arm {
    /// The contact of a ball with one arc; `index` is the arc's place in [`Contact::ALL`].
    pub fn new(
        contact: Contact,
        index: usize,
        input: &ArmInput<'_>,
        ball: &Ball,
        deflection: f64,
    ) -> Self {
        let geometry = input.geometry;
        let errors = &input.errors[index];
        let mut shift = errors
            .iter()
            .map(|error| error.deviation(ball.azimuth, geometry.contact_angle).shift)
            .fold(Vector2::zeros(), |sum, [x, z]| sum + Vector2::new(x, z));
        // Motion is sampled at the nominal contact point: taken at the arc's centre instead, the axial
        // strain of the shaft changes the loads by percents.
        let (radial, along) = geometry.contact_point(contact, ball.azimuth);
        let place = ball.position + along;
        let axes = geometry.section_axes(ball.azimuth);
        let (node, motion) = if contact.on_nut() {
            let arm = radial + Vector3::new(0.0, 0.0, place - input.nut.position);
            let moved = Vector3::from(input.nut.displacement)
                + Vector3::from(input.nut.rotation).cross(&arm);
            shift += axes * moved;
            (None, SMatrix::zeros())
        } else {
            let (node, point) = input.shaft.point(place, radial);
            (Some(node), axes * point)
        };
        Self {
            contact,
            centre: geometry.arc_centre(contact),
            excess: geometry.excess(),
            shift,
            groove_radius: geometry.groove_radius,
            oversize: ball.oversize,
            stiffness: deflection.powf(-1.5),
            profile: errors
                .iter()
                .filter(|error| !error.keeps_the_arc())
                .cloned()
                .collect(),
            azimuth: ball.azimuth,
            node,
            motion,
        }
    }

    /// The contact where the ball's centre is at `ball` and the arc has moved by `moved`, m.
    pub fn touch(&self, ball: Vector2<f64>, moved: Vector2<f64>) -> Touch {
        let offset = ball - moved - self.shift;
        let from_centre = offset - self.centre;
        let distance = from_centre.norm();
        // |w| - D without the difference of nearly equal lengths.
        let approach =
            (offset.norm_squared() - 2.0 * self.centre.dot(&offset)) / (distance + self.excess);
        let mut normal = if distance > 0.0 {
            from_centre / distance
        } else {
            -self.centre / self.excess
        };
        let mut penetration = approach + self.oversize;
        // Radius of the tangential stiffness F / radius.
        let mut arm = distance;
        if !self.profile.is_empty() {
            let foot = self.foot_point(normal, distance);
            penetration += foot.gain;
            normal = foot.normal;
            arm = foot.arm;
        }
        if penetration <= 0.0 {
            return Touch {
                force: 0.0,
                energy: 0.0,
                normal,
                stiffness: Matrix2::zeros(),
            };
        }
        let root = penetration.sqrt();
        let force = self.stiffness * penetration * root;
        let along = normal * normal.transpose();
        let across = Matrix2::identity() - along;
        Touch {
            force,
            energy: 0.4 * force * penetration,
            normal,
            stiffness: 1.5 * self.stiffness * root * along + force / arm.max(1e-9) * across,
        }
    }

    /// The point of a bent section that is nearest to the ball's centre, which lies at `distance` from
    /// the section's centre in the direction `outward`.
    fn foot_point(&self, outward: Vector2<f64>, distance: f64) -> Foot {
        let [mirror_x, mirror_z] = centre_signs(self.contact);
        // Mirrored, the section is R(gamma) (cos gamma, sin gamma) and the ball is at `start`.
        let start = (-mirror_z * outward.y).atan2(-mirror_x * outward.x);
        let sample = |angle: f64| {
            self.profile
                .iter()
                .fold(Deviation::default(), |sum, error| {
                    sum + error.deviation(self.azimuth, angle)
                })
        };
        let mut angle = start;
        let mut deviation = sample(angle);
        for _ in 0..12 {
            let radius = self.groove_radius - deviation.offset;
            let (slope, bend) = (-deviation.slope, -deviation.bend);
            let (sin, cos) = (angle - start).sin_cos();
            let lack = radius - distance * cos;
            let first = slope * lack + radius * distance * sin;
            let second =
                bend * lack + slope * (slope + 2.0 * distance * sin) + radius * distance * cos;
            if second <= 0.0 {
                break;
            }
            let step = (-first / second).clamp(-0.2, 0.2);
            angle += step;
            deviation = sample(angle);
            if step.abs() < 1e-14 {
                break;
            }
        }
        let radius = self.groove_radius - deviation.offset;
        let (sin, cos) = (angle - start).sin_cos();
        let (radial, tangential) = (radius * cos - distance, radius * sin);
        let span = radial.hypot(tangential);
        let (sin_start, cos_start) = start.sin_cos();
        let normal = Vector2::new(
            -mirror_x * (radial * cos_start - tangential * sin_start),
            -mirror_z * (radial * sin_start + tangential * cos_start),
        ) / span;
        let (slope, bend) = (-deviation.slope, -deviation.bend);
        let speed = radius * radius + slope * slope;
        let curvature = (speed + slope * slope - radius * bend) / (speed * speed.sqrt());
        // span - (R - d) from the difference of their squares, 2 R d (1 - cos).
        let half = (0.5 * (angle - start)).sin();
        let over = 4.0 * radius * distance * half * half / (span + radius - distance);
        Foot {
            gain: deviation.offset - over,
            normal,
            arm: 1.0 / curvature - span,
        }
    }
}

struct Foot {
    /// Penetration more than that of the nominal arc, m.
    gain: f64,
    /// Unit vector from the ball's centre to it.
    normal: Vector2<f64>,
    /// Local radius of curvature less the distance of the ball's centre, m.
    arm: f64,
}
