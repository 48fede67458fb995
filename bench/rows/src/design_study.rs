//! What many designs of a ball screw do under one duty: friction torque, efficiency, contact pressure, force between balls.
//!
//! Torque and force between balls are those of the float64 reference: balls in elastic balance with Coulomb friction by contact integrals, which
//! is what a step is folded from; without rolling resistance, which is about 1 % of the friction. A design's figures follow from its own
//! numbers alone, so that any partition of a table of designs gives the same answers, to the bit: an engine that spreads a
//! table over threads or machines calls [`figures`] row by row, or [`columns`] for a slice.

use core::f32::consts::TAU;

use epas_design::drawing::drawing;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::law::breakaway::ScrewContacts;
use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, Error, GrooveSize, Material, Range,
};
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall, RowMotion};
use epas_reference::friction::caged_ball::CagedBall;
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::RollingResistance;

/// A design of steel balls in steel grooves, both grooves alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Design {
    /// Radius of the cylinder on which the ball centres run, m, 1e-3 to 0.5.
    pub pitch_radius: f32,
    /// Travel of the nut in one turn, m, 0 to 0.2.
    pub lead: f32,
    /// Ball radius, m, 1e-4 to 0.05, up to 0.9 of the pitch radius.
    pub ball_radius: f32,
    /// Groove radius over ball diameter, above 0.5.
    pub conformity: f32,
    /// Nominal contact angle, rad, 0.05 to 1.5.
    pub contact_angle: f32,
    /// Load of each contact of an oversized ball in a screw without load, N, 0 or from 1e-3 on.
    pub preload: f32,
}

/// Under which every design of a study is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duty {
    /// Axial load of the nut, N, 1e-3 to 1e7: it opposes the travel.
    pub axial_load: f32,
    /// Turns of the track that are filled with balls side by side, one ball's length to 100.
    pub turns: f32,
    /// Friction coefficient of ball and groove, 1e-3 to 0.5.
    pub friction: f32,
    /// Friction coefficient of ball and ball, 0 to 0.5.
    pub ball_friction: f32,
    /// By which the grooves' contact angle at one of two neighbouring balls is off, rad, either way, 0 to 0.2.
    pub deviation: f32,
}

impl Duty {
    /// 10 kN on two and a half turns, friction 0.1, grooves off by one degree.
    pub const DEFAULT: Self = Self {
        axial_load: 1e4,
        turns: 2.5,
        friction: epas_friction::defaults::FRICTION,
        ball_friction: epas_friction::defaults::FRICTION,
        deviation: TAU / 360.0,
    };
}

/// What a design does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Balls under load.
    pub loaded_balls: u16,
    /// Friction torque on the nut, N m.
    pub friction_torque: f32,
    /// Work out over work in of a nut that moves the load.
    pub efficiency: f32,
    /// Largest contact pressure in either groove, Pa.
    pub max_pressure: f32,
    /// Larger of the forces between two neighbouring balls, N, of which one has its contact angle off by the deviation, one way
    /// and the other; no number where a ball loses its grooves or leaves the model.
    pub contact_force: f32,
}

/// Figures of one design.
///
/// # Errors
/// Field, value and range of what is out of range.
pub fn figures(design: &Design, duty: &Duty) -> Result<Figures, Error> {
    let screw = screw(design)?;
    let clearance = clearance(&screw, design.preload)?;
    duty.check(&screw)?;
    let loaded_balls = duty.loaded_balls(&screw);
    let contact_load =
        ScrewContacts::of(&screw).preloaded(duty.axial_load, loaded_balls, clearance);
    let pressure = |groove| {
        HertzContact::of(&screw, groove)
            .at(contact_load)
            .max_pressure
    };
    let balls = Balls::of(&screw, clearance, loaded_balls, duty);
    let friction_torque = f32::from(loaded_balls) * balls.torque;
    let load_torque = duty.axial_load * design.lead / TAU;
    Ok(Figures {
        loaded_balls,
        friction_torque,
        efficiency: load_torque / (load_torque + friction_torque),
        max_pressure: pressure(Groove::Screw).max(pressure(Groove::Nut)),
        contact_force: balls.contact_force,
    })
}

fn screw(design: &Design) -> Result<BallScrew, Error> {
    let groove = GrooveSize::Conformity(design.conformity);
    BallScrew::new(BallScrewParameters {
        pitch_radius: design.pitch_radius,
        lead: design.lead,
        ball_radius: design.ball_radius,
        screw_groove: groove,
        nut_groove: groove,
        contact_angle: design.contact_angle,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
}

fn clearance(screw: &BallScrew, preload: f32) -> Result<Clearance, Error> {
    if preload == 0.0 {
        return Ok(Clearance::ZERO);
    }
    Clearance::of_preload(screw, preload)?.checked(screw)
}

impl Duty {
    fn check(&self, screw: &BallScrew) -> Result<(), Error> {
        in_range("axial_load", self.axial_load, 1e-3, 1e7)?;
        in_range("turns", self.turns, one_ball(screw), 100.0)?;
        in_range("friction", self.friction, 1e-3, 0.5)?;
        in_range("ball_friction", self.ball_friction, 0.0, 0.5)?;
        in_range("deviation", self.deviation, 0.0, 0.2)
    }

    /// Balls side by side on the loaded turns.
    fn loaded_balls(&self, screw: &BallScrew) -> u16 {
        // At least one: the range of the turns begins there, but for rounding.
        ((self.turns / one_ball(screw)) as u16).max(1)
    }
}

/// Turns that one ball takes.
fn one_ball(screw: &BallScrew) -> f32 {
    2.0 * screw.ball_radius() * screw.cos_lead_angle() / (TAU * screw.pitch_radius())
}

/// Balls of a design.
struct Balls {
    /// Friction torque of a ball whose grooves are as they should be, no neighbour pressing, N m.
    torque: f32,
    /// As in [`Figures`].
    contact_force: f32,
}

impl Balls {
    fn of(screw: &BallScrew, clearance: Clearance, loaded_balls: u16, duty: &Duty) -> Self {
        let axial_load = f64::from(duty.axial_load) / f64::from(loaded_balls);
        let ball = CagedBall {
            design: drawing(screw.parameters()),
            clearance: clearance.gap().into(),
            friction: duty.friction.into(),
            rolling: RollingResistance::NONE,
            integration: Integration::Full,
        };
        let torque = ball
            .along(&[axial_load])
            .ok()
            .and_then(|found| found.into_iter().next()?.ok())
            .map_or(f64::NAN, |found| found.torque);
        // Balls press in one of the two ways; in the other they part.
        let forces = [1.0, -1.0].map(|way| {
            let pair = pair(&ball, axial_load, way * f64::from(duty.deviation), duty);
            pair.and_then(|pair| pair.contact_forces.first().copied())
        });
        Self {
            torque: torque as f32,
            contact_force: match forces {
                [Some(one), Some(other)] => one.max(other) as f32,
                _ => f32::NAN,
            },
        }
    }
}

/// Two neighbours, the nut's groove off by a deviation at the one behind; none where they have no balance.
fn pair(ball: &CagedBall, axial_load: f64, deviation: f64, duty: &Duty) -> Option<RowMotion> {
    let of_row = |nut_deviation| RowBall {
        screw_deviation: 0.0,
        nut_deviation,
        axial_load,
    };
    ElasticRow {
        design: ball.design,
        clearance: ball.clearance,
        friction: ball.friction,
        ball_friction: duty.ball_friction.into(),
        nut_speed: 1.0,
        balls: vec![of_row(deviation), of_row(0.0)],
        integration: ball.integration,
    }
    .solve()
    .ok()
}

fn in_range(field: &'static str, value: f32, minimum: f32, maximum: f32) -> Result<(), Error> {
    let allowed = Range::new(minimum, maximum);
    if allowed.contains(value) {
        return Ok(());
    }
    Err(if value.is_finite() {
        Error::OutOfRange {
            field,
            value,
            allowed,
        }
    } else {
        Error::NotFinite {
            field,
            value,
            allowed,
        }
    })
}

/// Figures of every design of a slice, in order; a design out of range has its error in its place.
pub fn columns(designs: &[Design], duty: &Duty) -> Vec<Result<Figures, Error>> {
    designs.iter().map(|design| figures(design, duty)).collect()
}

#[cfg(test)]
mod tests;
