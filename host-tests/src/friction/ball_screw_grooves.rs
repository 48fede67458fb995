//! Grooves of a ball screw as elastic arcs: where a ball lies, and which contacts carry it (Lin 2019, eqs. (2.11) to (2.14)).

use nalgebra::{SMatrix, Vector3};

use super::ball_screw_ball::{Groove, ScrewContact, ScrewTrack};
use super::contact_law::HertzLaw;
use super::newton::Local;
use crate::curvature;
use crate::design::{BallScrewDesign, check_groove_radii};
use crate::error::{ReferenceError, within};

/// Grooves with their elasticity: four arcs around the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticGrooves {
    /// Track.
    pub track: ScrewTrack,
    /// Groove radius of the screw, m.
    pub screw_groove_radius: f64,
    /// Groove radius of the nut, m.
    pub nut_groove_radius: f64,
    /// Angles of the arc centres, SL, SR, NL, NR, rad: the nominal contact angle plus its deviation.
    pub arc_angles: [f64; 4],
    /// Contact law on the screw.
    pub screw: HertzLaw,
    /// Contact law on the nut.
    pub nut: HertzLaw,
    /// Ball radius above nominal, m; negative for play.
    pub oversize: f64,
}

impl ElasticGrooves {
    /// Grooves of a design with a radial gap of every contact at the centred ball, m: play above zero, oversize below; -0.05 to 0.2 ball radii.
    pub(crate) fn of(design: &BallScrewDesign, clearance: f64) -> Result<Self, ReferenceError> {
        let radius = design.ball_radius;
        design.check_grooves()?;
        within("clearance", clearance, -0.05 * radius, 0.2 * radius)?;
        Self {
            track: design.into(),
            screw_groove_radius: design.screw_groove_radius,
            nut_groove_radius: design.nut_groove_radius,
            arc_angles: [design.contact_angle; 4],
            screw: design.contact(curvature::Groove::Screw)?.into(),
            nut: design.contact(curvature::Groove::Nut)?.into(),
            oversize: -clearance,
        }
        .of_design()
    }

    fn of_design(self) -> Result<Self, ReferenceError> {
        self.check()
            .map_err(|error| error.renamed("contact_angle"))?;
        Ok(self)
    }

    /// These grooves with arc centres turned by the deviations of screw and nut, rad: less on the left flanks, more on the right.
    pub(crate) fn turned(&self, screw: f64, nut: f64) -> Self {
        let [angle, ..] = self.arc_angles;
        Self {
            arc_angles: [angle - screw, angle + screw, angle - nut, angle + nut],
            ..*self
        }
    }

    /// The same for deviations of -0.2 to 0.2.
    pub(crate) fn deviating(&self, screw: f64, nut: f64) -> Result<Self, ReferenceError> {
        within("screw_deviation", screw, -0.2, 0.2)?;
        within("nut_deviation", nut, -0.2, 0.2)?;
        self.turned(screw, nut).of_design()
    }

    /// Checks the design.
    pub fn check(&self) -> Result<(), ReferenceError> {
        self.track.check()?;
        let r = self.track.ball_radius;
        check_groove_radii(r, [self.screw_groove_radius, self.nut_groove_radius])?;
        for angle in self.arc_angles {
            within("arc_angles", angle, 0.05, 1.5)?;
        }
        within("oversize", self.oversize, -0.2 * r, 0.05 * r)?;
        for law in [self.screw, self.nut] {
            within("compliance", law.compliance, 1e-15, 1.0)?;
        }
        Ok(())
    }

    /// Distance of the arcs' centres from the centre of a ball that touches both flanks of a groove, m.
    pub(crate) fn offset(&self, groove: Groove) -> f64 {
        let radius = if groove.on_nut() {
            self.nut_groove_radius
        } else {
            self.screw_groove_radius
        };
        radius - self.track.ball_radius
    }

    /// Vector from each arc's centre to the ball centre at `position` in the cross section, with the screw displaced axially.
    fn arms(&self, position: [f64; 2], screw_displacement: f64) -> [[f64; 2]; 4] {
        let shift = screw_displacement * self.track.lead_angle().1;
        let mut arms = [[0.0; 2]; 4];
        for ((arm, groove), angle) in arms.iter_mut().zip(Groove::ALL).zip(self.arc_angles) {
            let (sx, sz) = groove.signs();
            let moved = if groove.on_nut() { 0.0 } else { shift };
            let offset = self.offset(groove);
            *arm = [
                position[0] + offset * sx * angle.cos(),
                position[1] + offset * sz * angle.sin() - moved,
            ];
        }
        arms
    }

    /// Contacts at a given position of the ball centre in the cross section (x, z) and axial displacement of the screw.
    ///
    /// `deflection = |p - o| - (r_G - r_B) + oversize`, `F = (deflection/C)^(3/2)`, contact angle from the direction `p - o`.
    /// An axial displacement `u` of the screw moves its arcs by `u cos a` along z: the rest is a slide along the helix.
    ///
    /// Source: Lin 2019, eqs. (2.11) to (2.14). Corrected: (2.11), the normal is orthogonal to the tangent.
    pub fn contacts_at(&self, position: [f64; 2], screw_displacement: f64) -> [ScrewContact; 4] {
        let arms = self.arms(position, screw_displacement);
        let mut contacts = Groove::ALL.map(|groove| ScrewContact {
            groove,
            load: 0.0,
            contact_angle: 0.0,
            ellipse: if groove.on_nut() {
                self.nut.ellipse
            } else {
                self.screw.ellipse
            },
        });
        for (contact, arm) in contacts.iter_mut().zip(arms) {
            let (sx, sz) = contact.groove.signs();
            let law = if contact.groove.on_nut() {
                self.nut
            } else {
                self.screw
            };
            contact.load =
                law.load(arm[0].hypot(arm[1]) - self.offset(contact.groove) + self.oversize);
            contact.contact_angle = (arm[1] * sz).atan2(arm[0] * sx);
        }
        contacts
    }

    /// Elastic energy of one ball by `(x, z, screw displacement)`, in units of `unit` for the displacements.
    pub(crate) fn energy(&self, y: &Vector3<f64>, unit: f64) -> Local<3> {
        let cos_a = self.track.lead_angle().1;
        let mut sum = Local {
            value: 0.0,
            gradient: Vector3::zeros(),
            hessian: SMatrix::zeros(),
        };
        for (arm, groove) in self
            .arms([y.x * unit, y.y * unit], y.z * unit)
            .iter()
            .zip(Groove::ALL)
        {
            let law = if groove.on_nut() {
                self.nut
            } else {
                self.screw
            };
            let length = arm[0].hypot(arm[1]);
            let deflection = (length - self.offset(groove) + self.oversize).max(0.0);
            let force = law.load(deflection);
            if force > 0.0 {
                let moved = if groove.on_nut() { 0.0 } else { -cos_a };
                let along = Vector3::new(arm[0], arm[1], moved * arm[1]) * (unit / length);
                let across = Vector3::new(-arm[1], arm[0], moved * arm[0]) * (unit / length);
                sum.value += 0.4 * force * deflection;
                sum.gradient += along * force;
                sum.hessian += along * along.transpose() * (1.5 * force / deflection)
                    + across * across.transpose() * (force / length);
            }
        }
        sum
    }

    /// Ball centre x, z and axial displacement of the screw under an axial load on the two contacts that carry it, without friction: the
    /// ball lies on the line between their arc centres, which the load keeps as far apart as both arms with their deflections.
    pub(crate) fn two_point_place(&self, axial_load: f64) -> Vector3<f64> {
        let (screw, nut) = if axial_load > 0.0 { (0, 3) } else { (1, 2) };
        let arms = self.arms([0.0; 2], 0.0);
        let cos_a = self.track.lead_angle().1;
        let normal = axial_load.abs() / (self.arc_angles[nut].sin() * cos_a);
        let length = |groove: usize, law: HertzLaw| {
            let arm = self.offset(Groove::ALL[groove]) - self.oversize;
            f64::max(arm + law.compliance * normal.powf(2.0 / 3.0), 0.0)
        };
        let (on_screw, on_nut) = (length(screw, self.screw), length(nut, self.nut));
        let across = arms[nut][0] - arms[screw][0];
        let side = axial_load.signum();
        let along = side
            * ((on_screw + on_nut).powi(2) - across.powi(2))
                .max(0.0)
                .sqrt();
        let share = on_nut / (on_screw + on_nut);
        let x = share * across - arms[nut][0];
        let z = share * along - arms[nut][1];
        let travel = along - arms[nut][1] + arms[screw][1];
        Vector3::new(x, z, travel / cos_a)
    }

    /// Approach of screw and nut under an axial load on the two-point pair that carries it: `(axial displacement, unit)`.
    pub(crate) fn two_point_start(&self, axial_load: f64) -> (f64, f64) {
        let angle = self.arc_angles.iter().sum::<f64>() / 4.0;
        let (sin, cos) = angle.sin_cos();
        let cos_a = self.track.lead_angle().1;
        let normal = axial_load.abs() / (sin * cos_a);
        let reach = (self.screw.compliance + self.nut.compliance) * normal.powf(2.0 / 3.0);
        let offsets = self.offset(Groove::ScrewLeft) + self.offset(Groove::NutLeft);
        let length = f64::max(offsets - 2.0 * self.oversize + reach, 0.0);
        let travel = (length.powi(2) - (offsets * cos).powi(2)).max(0.0).sqrt() - offsets * sin;
        (travel.max(0.0) / cos_a * axial_load.signum(), reach)
    }
}
