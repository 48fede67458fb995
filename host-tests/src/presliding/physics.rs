//! Stiffness of contacts before they slide, and breakaway angles of a ball screw.
//!
//! A tangential traction on a half space displaces its surface by Cerruti's solution. Along a ray through a point the
//! traction is integrated in closed form; the integral over the rays' directions `phi` is left. With
//! `C = cos^2(phi)/a^2 + sin^2(phi)/b^2` and the traction `p_0/sqrt(1 - x^2/a^2 - y^2/b^2)` times a polynomial,
//!
//! ```text
//! u_i = 1/(2 pi G) integral over phi in 0..pi of g_ij(phi) L_j(phi)    g_xx = 1 - nu sin^2   g_yy = 1 - nu cos^2   g_xy = nu sin cos
//! L = pi/sqrt(C)                                                       of 1
//! L = pi/sqrt(C) [c - (c cos + d sin)(cos/a^2, sin/b^2)/C] . (x, y)    of c x + d y
//! ```
//!
//! Sources: Mindlin 1949 (slip), Galin's theorem (a polynomial over the root displaces by a polynomial of the same degree),
//! Johnson 1985, chapters 7 and 8.

use std::f64::consts::PI;

use roots::{SimpleConvergency, find_root_brent};

use crate::curvature::Groove;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};
use crate::hertz::Hertz;
use crate::material::Elastic;

/// Directions of rays over the axis ratio: the rule for periodic functions errs by `exp(-2 n k)`, so by less than a rounding.
const RAYS: f64 = 40.0;

fn over_rays(k: f64, integrand: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let rays = (RAYS / k).ceil();
    let step = PI / rays;
    (0..rays as u32)
        .map(|ray| {
            let (sin, cos) = ((f64::from(ray) + 0.5) * step).sin_cos();
            let reach = cos * cos + sin * sin / (k * k);
            step * integrand(cos, sin, reach)
        })
        .sum()
}

/// Compliance of one half space along the major and the minor axis of an ellipse with the semi-axes 1 and `k`, times `G`.
///
/// Traction `1/(2 pi k sqrt(..))` of the resultant 1.
pub fn tangential_compliance(k: f64, nu: f64) -> [f64; 2] {
    let scale = 1.0 / (2.0 * PI * k) / (2.0 * PI);
    [
        scale
            * over_rays(k, |_, sin, reach| {
                (1.0 - nu * sin * sin) * PI / reach.sqrt()
            }),
        scale
            * over_rays(k, |cos, _, reach| {
                (1.0 - nu * cos * cos) * PI / reach.sqrt()
            }),
    ]
}

/// Displacement gradients times `G` of one half space under the tractions `-A y` and `B x` over the root: `u_x = y (xa A +
/// xb B)` and `u_y = x (ya A + yb B)`, in the order `xa, xb, ya, yb`; semi-axes 1 and `k`.
fn twisted(k: f64, nu: f64) -> [f64; 4] {
    let f = 1.0 / (2.0 * PI);
    let square = k * k;
    let part = |g: fn(f64, f64, f64) -> f64, of: [f64; 2], along_y: bool| {
        f * over_rays(k, |cos, sin, reach| {
            let [c, d] = of;
            let slope = (c * cos + d * sin) / reach;
            let linear = if along_y {
                d - slope * sin / square
            } else {
                c - slope * cos
            };
            g(cos, sin, nu) * PI / reach.sqrt() * linear
        })
    };
    let xx = |_: f64, sin: f64, nu: f64| 1.0 - nu * sin * sin;
    let yy = |cos: f64, _: f64, nu: f64| 1.0 - nu * cos * cos;
    let xy = |cos: f64, sin: f64, nu: f64| nu * sin * cos;
    [
        part(xx, [0.0, -1.0], true),
        part(xy, [1.0, 0.0], true),
        part(xy, [0.0, -1.0], false),
        part(yy, [1.0, 0.0], false),
    ]
}

/// Moment over the angle by which two bodies turn against each other that are bonded over an ellipse with semi-axes 1 and
/// `k`; each body by its shear modulus and Poisson's ratio.
pub fn torsion_stiffness(k: f64, bodies: [(f64, f64); 2]) -> f64 {
    let mut m = [0.0; 4];
    for (shear, nu) in bodies {
        for (sum, one) in m.iter_mut().zip(twisted(k, nu)) {
            *sum += one / shear;
        }
    }
    // Turned by 1: u_x = -y, u_y = x.
    let [xa, xb, ya, yb] = m;
    let det = xa * yb - xb * ya;
    let a = (-yb - xb) / det;
    let b = (xa + ya) / det;
    (a * k * k + b) * 2.0 * PI * k / 3.0
}

/// Mean distance of the points of an ellipse with semi-axes 1 and `k` from a velocity centre on its minor axis, weighed by a
/// Hertzian pressure: power lost over `mu F a w` by a contact that spins, and slips along its major axis with `slip` times
/// `a w`. The second number is its derivative by the slip, the friction force over `mu F`.
///
/// By Gauss' rule in the radius's angle and the trapezoidal rule round about; within 2e-5, where the centre lies inside.
pub fn slip_and_spin(k: f64, slip: f64) -> [f64; 2] {
    const RINGS: u32 = 600;
    const SECTORS: u32 = 1200;
    let step = PI / 2.0 / f64::from(RINGS);
    let sector = 2.0 * PI / f64::from(SECTORS);
    let mut sum = [0.0; 2];
    for ring in 0..RINGS {
        let (radius, depth) = ((f64::from(ring) + 0.5) * step).sin_cos();
        let weight = 1.5 / PI * radius * depth * depth * step * sector;
        for place in 0..SECTORS {
            let (sin, cos) = ((f64::from(place) + 0.5) * sector).sin_cos();
            let (across, along) = (radius * cos, slip - k * radius * sin);
            let distance = across.hypot(along);
            sum[0] += weight * distance;
            sum[1] += weight * along / distance;
        }
    }
    sum
}

/// One contact of two elastic bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickingContact {
    /// Its ellipse.
    pub hertz: Hertz,
    bodies: [(f64, f64); 2],
}

impl StickingContact {
    /// A contact of these two bodies.
    pub fn new(hertz: Hertz, first: &Elastic, second: &Elastic) -> Self {
        Self {
            hertz,
            bodies: [first, second].map(|body| (body.shear_modulus(), body.poisson_ratio)),
        }
    }

    /// Compliance against slip along the major axis and along the minor one, m/N, under a load, N.
    pub fn compliance(&self, load: f64) -> [f64; 2] {
        let semi_major = self.hertz.at(load).semi_major;
        let mut sum = [0.0; 2];
        for (shear, nu) in self.bodies {
            let unit = tangential_compliance(self.hertz.axis_ratio, nu);
            for (sum, unit) in sum.iter_mut().zip(unit) {
                *sum += unit / (shear * semi_major);
            }
        }
        sum
    }

    /// Stiffness against spin, N m/rad, under a load, N.
    pub fn torsion(&self, load: f64) -> f64 {
        torsion_stiffness(self.hertz.axis_ratio, self.bodies)
            * self.hertz.at(load).semi_major.powi(3)
    }

    /// Moment of gross spin, N m: friction times load times the mean distance from the centre, weighed by pressure.
    pub fn spin_moment(&self, friction: f64, load: f64) -> f64 {
        // The mean of the radius over a Hertzian pressure is 3 pi/16, that of the direction one integral.
        let k = self.hertz.axis_ratio;
        let round = over_rays(k, |cos, sin, _| (cos * cos + k * k * sin * sin).sqrt()) / PI;
        friction * load * self.hertz.at(load).semi_major * (3.0 * PI / 16.0) * round
    }
}

/// A ball on its two loaded contacts in a screw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewBall {
    design: BallScrewDesign,
    /// Contact with the screw.
    pub screw: StickingContact,
    /// Contact with the nut.
    pub nut: StickingContact,
}

/// Limit and initial stiffness of a mechanism, over the angle of the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielding {
    /// Torque of gross sliding, N m.
    pub limit: f64,
    /// Initial stiffness, N m/rad.
    pub stiffness: f64,
}

impl ScrewBall {
    /// The ball of a design, with exact curvatures.
    pub fn new(design: BallScrewDesign) -> Result<Self, ReferenceError> {
        let contact = |groove| {
            Ok(StickingContact::new(
                design.contact(groove)?,
                &design.ball,
                &design.groove,
            ))
        };
        Ok(Self {
            design,
            screw: contact(Groove::Screw)?,
            nut: contact(Groove::Nut)?,
        })
    }

    /// The same with other ellipses.
    pub fn with_ellipses(design: BallScrewDesign, screw: Hertz, nut: Hertz) -> Self {
        let contact = |hertz| StickingContact::new(hertz, &design.ball, &design.groove);
        Self {
            design,
            screw: contact(screw),
            nut: contact(nut),
        }
    }

    /// Slip across the path per angle of the nut, both contacts together, m.
    pub fn lever(&self) -> f64 {
        self.design.ball_radius * self.design.lead_angle().sin()
    }

    /// Spin of a contact per angle of the nut: on two points, and on three.
    pub fn spin_ratios(&self) -> [f64; 2] {
        let (sin, cos) = self.design.contact_angle.sin_cos();
        let cos_lead = self.design.lead_angle().cos();
        let rolled = self.design.pitch_radius / cos_lead;
        [
            sin * cos_lead / 2.0,
            rolled / (2.0 * self.design.ball_radius) * sin / cos,
        ]
    }

    /// Path that a contact rolls per angle of the nut, m.
    pub fn rolled(&self) -> f64 {
        self.design.pitch_radius / (2.0 * self.design.lead_angle().cos())
    }

    /// Load of a contact under an axial load of so many balls, N.
    pub fn contact_load(&self, axial_load: f64, balls: f64) -> f64 {
        axial_load / (balls * self.design.lead_angle().cos() * self.design.contact_angle.sin())
    }

    /// Slip across the path alone.
    pub fn slip(&self, friction: f64, load: f64) -> Yielding {
        let lever = self.lever();
        let [screw, _] = self.screw.compliance(load);
        let [nut, _] = self.nut.compliance(load);
        Yielding {
            limit: friction * load * lever,
            stiffness: lever * lever / (screw + nut),
        }
    }

    /// Spin of both contacts alone, by a spin ratio.
    pub fn spin(&self, friction: f64, load: f64, ratio: f64) -> Yielding {
        let both = [self.screw, self.nut];
        Yielding {
            limit: both
                .iter()
                .map(|contact| ratio * contact.spin_moment(friction, load))
                .sum(),
            stiffness: both
                .iter()
                .map(|contact| ratio * ratio * contact.torsion(load))
                .sum(),
        }
    }

    /// Torques of gross slip and of gross spin of a ball that does both.
    pub fn slip_and_spin(&self, friction: f64, load: f64, ratio: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for contact in [self.screw, self.nut] {
            let end = contact.hertz.at(load).semi_major * ratio;
            let slip = self.lever() / 2.0 / end;
            let [power, force] = slip_and_spin(contact.hertz.axis_ratio, slip);
            sum[0] += friction * load * end * slip * force;
            sum[1] += friction * load * end * (power - slip * force);
        }
        sum
    }

    /// Drift of the ball, m, under a share of the gross slip, with a gap of the third contact, m.
    pub fn drift(
        &self,
        friction: f64,
        load: f64,
        gap: f64,
        share: f64,
    ) -> Result<f64, ReferenceError> {
        within("share", share, 0.0, 1.0)?;
        let excess = |groove_radius: f64| 1.0 / (groove_radius - self.design.ball_radius);
        let slope = load
            * (excess(self.design.screw_groove_radius) + excess(self.design.nut_groove_radius));
        let pressed = |approach: f64| (approach.max(0.0) / self.screw.hertz.deflection).powf(1.5);
        let force = 2.0 * friction * load * share;
        let residual = |x: f64| (slope * x + pressed(x - gap) - pressed(-x - gap) - force) / load;
        if force <= 0.0 {
            return Ok(0.0);
        }
        let mut convergency = SimpleConvergency {
            eps: 1e-18,
            max_iter: 300,
        };
        find_root_brent(
            0.0,
            force / slope * (1.0 + 1e-12),
            residual,
            &mut convergency,
        )
        .map_err(|error| ReferenceError::input("share", format!("{error:?}")))
    }

    /// Nut angle until a share of the gross slip, rad: Cattaneo-Mindlin at both contacts, and the drift.
    pub fn angle(
        &self,
        friction: f64,
        load: f64,
        gap: f64,
        share: f64,
    ) -> Result<f64, ReferenceError> {
        let drift = self.drift(friction, load, gap, share)?;
        let slip = self.slip(friction, load);
        let breakaway = 1.5 * slip.limit / slip.stiffness;
        Ok(breakaway * (1.0 - (1.0 - share).powf(2.0 / 3.0)) + 2.0 / self.lever() * drift)
    }

    /// Gap of the third contact under a load, m: twice the clearance, and the mean deflection of the loaded contacts, which
    /// opens the other diagonal.
    pub fn third_gap(&self, clearance: f64, load: f64) -> f64 {
        2.0 * clearance
            + 0.5 * (self.screw.hertz.at(load).deflection + self.nut.hertz.at(load).deflection)
    }
}
