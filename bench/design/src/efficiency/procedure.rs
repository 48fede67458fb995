//! The paper's ten-step design procedure.

use std::f32::consts::TAU;

use super::optimum::optimum_contact_angle;
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::error::{Error, Range};
use epas_friction::geometry::{
    BallScrew, BallScrewParameters, Groove, GrooveSize, LARGEST_CONTACT_ANGLE, PITCH_RADIUS,
};
use epas_friction::hertz::HertzContact;
use epas_friction::material::Material;
use epas_friction::math;
use epas_friction::ranges;

/// What the screw has to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Duty {
    /// Rotation moves an axial load, N, 0 to 1e7.
    MoveAxialLoad(f32),
    /// An axial force delivers a torque, N m, 0 to 1e6.
    DeliverTorque(f32),
}

/// The choices that the procedure leaves to the designer; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignRequest {
    /// What the screw has to do.
    pub duty: Duty,
    /// Step 1: preliminary lead angle, rad, 0.001 to 1.5.
    pub lead_angle: f32,
    /// Friction coefficient, 0 to 1.
    pub friction: f32,
    /// Step 3: length of the screw, m, 0.06 to 30.
    pub screw_length: f32,
    /// Step 4: pitch radius, m, at least a sixtieth of the length (Levit), 1e-3 to 0.5.
    pub pitch_radius: f32,
    /// Step 5: ball radius over pitch radius, 0.07 to 0.2.
    pub ball_ratio: f32,
    /// Step 6: ball radius over groove radius, 0.95 to 0.97.
    pub osculation: f32,
    /// Number of balls that share the load, 1 to 10 000.
    pub loaded_balls: u16,
    /// Step 8: rotation whose travel is asked for, rad, -1e6 to 1e6.
    pub rotation: f32,
    /// Material of balls and grooves.
    pub material: Material,
}

/// Every step's figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignFigures {
    /// Step 1: lead angle, rad.
    pub lead_angle: f32,
    /// Step 2: contact angle of highest efficiency, eq. (15) or (18), rad; the largest accepted one
    /// where the optimum does not exist or lies above it.
    pub contact_angle: f32,
    /// Step 2: whether the optimum exists at this lead angle.
    pub optimum_exists: bool,
    /// Step 3: length of the screw, m.
    pub screw_length: f32,
    /// Step 4: pitch radius, m.
    pub pitch_radius: f32,
    /// Step 5: ball radius, m.
    pub ball_radius: f32,
    /// Step 6: groove radius, m.
    pub groove_radius: f32,
    /// Step 7: approximate contact force of one ball, eq. (20) or (21), N.
    pub contact_force: f32,
    /// Step 8: travel at the requested rotation, m.
    pub advance: f32,
    /// Lead, m.
    pub lead: f32,
    /// Step 9: largest contact pressure at the screw, Pa.
    pub max_pressure_screw: f32,
    /// Step 9: largest contact pressure at the nut, Pa.
    pub max_pressure_nut: f32,
    /// Step 10: full-sliding efficiency, eq. (14) or (17).
    pub sliding_efficiency: f32,
    /// The efficiency to expect in service: rolling, eq. (3).
    pub rolling_efficiency: f32,
    /// Whether full sliding locks this duty's direction.
    pub locked: bool,
    /// The validated design.
    pub design: BallScrew,
}

impl DesignRequest {
    /// The ten steps of Lin, Velinsky, Ravani 1994, "Design Procedure", in their order.
    ///
    /// The paper iterates by hand: where a figure does not please (pressure too high, travel wrong),
    /// change a choice and call again.
    ///
    /// ```
    /// use epas_friction::Material;
    /// use epas_design::efficiency::{DesignRequest, Duty};
    /// let figures = DesignRequest {
    ///     duty: Duty::MoveAxialLoad(14_500.0),
    ///     lead_angle: 5f32.to_radians(),
    ///     friction: 0.075,
    ///     screw_length: 0.75,
    ///     pitch_radius: 14.5e-3,
    ///     ball_ratio: 0.14,
    ///     osculation: 0.95,
    ///     loaded_balls: 71,
    ///     rotation: 1.0,
    ///     material: Material::STEEL,
    /// }
    /// .figures()?;
    /// assert!(figures.optimum_exists && !figures.locked);
    /// assert!((figures.sliding_efficiency - 0.8608).abs() < 1e-4);
    /// # Ok::<(), epas_friction::Error>(())
    /// ```
    pub fn figures(&self) -> Result<DesignFigures, Error> {
        let (drive, demand) = self.checked_duty()?;
        let balls = self.checked_balls()?;
        let best = optimum_contact_angle(drive, self.lead_angle, self.friction)?;
        let contact_angle = best
            .contact_angle
            .unwrap_or(LARGEST_CONTACT_ANGLE)
            .min(LARGEST_CONTACT_ANGLE);

        let (sin_lead, cos_lead) = math::sin_cos(self.lead_angle);
        let tan_lead = sin_lead / cos_lead;
        let design = self.design(contact_angle, tan_lead)?;
        let geometry = EfficiencyGeometry::of(&design);
        let contact_force = demand / balls
            * match drive {
                Drive::Driving => geometry.normal_per_axial_load(),
                Drive::BackDriving => geometry.normal_per_torque() / self.pitch_radius,
            };

        Ok(DesignFigures {
            lead_angle: self.lead_angle,
            contact_angle,
            optimum_exists: best.contact_angle.is_some(),
            screw_length: self.screw_length,
            pitch_radius: self.pitch_radius,
            ball_radius: design.ball_radius(),
            groove_radius: design.profile(Groove::Screw).groove_radius,
            contact_force,
            advance: self.pitch_radius * tan_lead * self.rotation,
            lead: design.lead(),
            max_pressure_screw: max_pressure(&design, Groove::Screw, contact_force),
            max_pressure_nut: max_pressure(&design, Groove::Nut, contact_force),
            sliding_efficiency: match drive {
                Drive::Driving => geometry.sliding_efficiency(self.friction),
                Drive::BackDriving => geometry.sliding_backdrive_efficiency(self.friction),
            },
            rolling_efficiency: match drive {
                Drive::Driving => geometry.rolling_efficiency(self.friction, 0.0),
                Drive::BackDriving => geometry.rolling_backdrive_efficiency(self.friction, 0.0),
            },
            locked: geometry.locks(drive, self.friction),
            design,
        })
    }

    /// Which way power flows, and the axial load, N, or the torque, N m, of all balls.
    fn checked_duty(&self) -> Result<(Drive, f32), Error> {
        Ok(match self.duty {
            Duty::MoveAxialLoad(load) => {
                (Drive::Driving, ranges::LOAD.checked("axial_load", load)?)
            }
            Duty::DeliverTorque(torque) => (
                Drive::BackDriving,
                Range::new(0.0, 1e6).checked("torque", torque)?,
            ),
        })
    }

    /// Number of balls, with every other choice but the duty checked before it.
    fn checked_balls(&self) -> Result<f32, Error> {
        Range::new(0.001, 1.5).checked("lead_angle", self.lead_angle)?;
        ranges::FRICTION_OR_NONE.checked("friction", self.friction)?;
        Range::new(0.06, 30.0).checked("screw_length", self.screw_length)?;
        Range::new(self.screw_length / 60.0, PITCH_RADIUS.maximum)
            .checked("pitch_radius", self.pitch_radius)?;
        Range::new(0.07, 0.2).checked("ball_ratio", self.ball_ratio)?;
        Range::new(0.95, 0.97).checked("osculation", self.osculation)?;
        let balls = Range::new(1.0, 1e4).checked("loaded_balls", f32::from(self.loaded_balls))?;
        Range::new(-1e6, 1e6).checked("rotation", self.rotation)?;
        Ok(balls)
    }

    fn design(&self, contact_angle: f32, tan_lead: f32) -> Result<BallScrew, Error> {
        let groove = GrooveSize::Conformity(0.5 / self.osculation);
        BallScrew::new(BallScrewParameters {
            pitch_radius: self.pitch_radius,
            lead: TAU * self.pitch_radius * tan_lead,
            ball_radius: self.ball_ratio * self.pitch_radius,
            screw_groove: groove,
            nut_groove: groove,
            contact_angle,
            ball_material: self.material,
            groove_material: self.material,
        })
    }
}

/// Largest pressure, Pa, of a contact under a force, N.
fn max_pressure(design: &BallScrew, groove: Groove, contact_force: f32) -> f32 {
    HertzContact::of(design, groove)
        .at(contact_force)
        .max_pressure
}
