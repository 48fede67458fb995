//! What many designs of a ball screw do under one duty: friction torque, efficiency, contact pressure, force between balls.
//!
//! Torque and force between balls are those of the exact ball of the float64 reference that the constants of firmware are folded from: a ball
//! in elastic balance with Coulomb friction by contact integrals, free or held by its neighbours. Nothing is folded: a design is looked at
//! under one load. Left out is rolling resistance, about 1 % of the friction. The torque is off by up to 3.5e-4 (contact integrals of 32 nodes
//! against 160, 200 designs of the studies, friction 0.1); the force by up to 1.2 % against a row of two balls with all of the friction between them
//! (100 designs), because a ball takes its neighbour's motion for its own.
//!
//! The closed form of a catalogue would be a thousand times as fast and is no substitute: over 40 designs of the studies it has 1.06 to 3.6 times the
//! torque, and up to 13 times the force.
//!
//! A design's figures follow from its own numbers alone, so that any partition of a table of designs gives the same answers, to the bit: an
//! engine that spreads a table over threads or machines calls [`figures`] row by row, or [`columns`] for a slice.
//!
//! One core looks at some 1,500 designs a second without a deviation, for torque, efficiency and pressure, and at 75 with the force between balls
//! (processor time of an AMD EPYC): thousands are looked at without, and the best of them with it. One in a thousand of the studies'
//! designs has no torque, and one in a hundred no force, where the reference finds no balance.

use core::f32::consts::TAU;

use epas_design::breakaway::ScrewContacts;
use epas_design::drawing::drawing;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, Error, GrooveSize, Material, Range,
};
use epas_reference::friction::held_ball::{
    AlongTrack, BallDrive, BallStart, DeviatingBall, HeldBall, HeldBallFriction,
};
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
    /// By which the grooves' contact angle at one of two neighbouring balls is off, rad, either way, 0 to 0.2. At 0 no ball presses, and a
    /// design takes a twentieth of the time.
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
    /// and the other, and the faster one follows the slower; no number where a ball has no balance.
    pub contact_force: f32,
}

/// Figures of one design.
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
    let nominal = balls.alone(0.0, None);
    let torque = |ball: &Alone| f64::from(loaded_balls) * ball.free.torque;
    let friction_torque = nominal.as_ref().map_or(f64::NAN, torque) as f32;
    let force = |ball: &Alone| balls.contact_force(ball, duty.deviation.into());
    let contact_force = nominal.as_ref().and_then(force).unwrap_or(f64::NAN) as f32;
    let load_torque = duty.axial_load * design.lead / TAU;
    Ok(Figures {
        loaded_balls,
        friction_torque,
        efficiency: load_torque / (load_torque + friction_torque),
        max_pressure: pressure(Groove::Screw).max(pressure(Groove::Nut)),
        contact_force,
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
        for (field, value, least, most) in [
            ("axial_load", self.axial_load, 1e-3, 1e7),
            ("turns", self.turns, one_ball(screw), 100.0),
            ("friction", self.friction, 1e-3, 0.5),
            ("ball_friction", self.ball_friction, 0.0, 0.5),
            ("deviation", self.deviation, 0.0, 0.2),
        ] {
            Range::new(least, most).checked(field, value)?;
        }
        Ok(())
    }

    fn loaded_balls(&self, screw: &BallScrew) -> u16 {
        // At least one: the range of the turns begins there, but for rounding.
        ((self.turns / one_ball(screw)) as u16).max(1)
    }
}

fn one_ball(screw: &BallScrew) -> f32 {
    2.0 * screw.ball_radius() * screw.cos_lead_angle() / (TAU * screw.pitch_radius())
}

struct Balls {
    ball: HeldBall,
    axial_load: f64,
    ball_friction: f64,
}

struct Alone {
    grooves: DeviatingBall,
    free: HeldBallFriction,
}

/// Rounds in which the force between two balls settles, friction between them following it.
const ROUNDS: usize = 20;

impl Balls {
    fn of(screw: &BallScrew, clearance: Clearance, loaded_balls: u16, duty: &Duty) -> Self {
        Self {
            ball: HeldBall {
                design: drawing(screw.parameters()),
                clearance: clearance.gap().into(),
                friction: duty.friction.into(),
                rolling: RollingResistance::NONE,
                integration: Integration::Coarse,
            },
            axial_load: f64::from(duty.axial_load) / f64::from(loaded_balls),
            ball_friction: duty.ball_friction.into(),
        }
    }

    /// A ball in a nut's groove that deviates, found from the state of another one, or from one that is near.
    fn alone(&self, nut_deviation: f64, start: Option<&BallStart>) -> Option<Alone> {
        let grooves = self.ball.in_grooves(0.0, nut_deviation).ok()?;
        let near = || grooves.near(self.axial_load);
        let start = start.copied().or_else(near);
        let free = self.run(&grooves, AlongTrack::Free, [0.0; 2], start.as_ref())?;
        Some(Alone { grooves, free })
    }

    /// Force of two balls that press, over that along the track.
    fn normal(&self) -> f64 {
        self.ball.outward().hypot(1.0)
    }

    fn run(
        &self,
        grooves: &DeviatingBall,
        along: AlongTrack,
        neighbours: [f64; 2],
        start: Option<&BallStart>,
    ) -> Option<HeldBallFriction> {
        let drive = BallDrive {
            axial_load: self.axial_load,
            along,
            rubbing: neighbours.map(|force| self.ball_friction * self.normal() * force),
            outward: self.ball.outward() * (neighbours[0] + neighbours[1]),
        };
        grooves.solve(&drive, start).ok()
    }

    /// Force with which the faster of two balls presses on the slower one, which it follows, N; none where they have no balance.
    ///
    /// Newton's method on the speed that both have.
    fn pressing(&self, one: &Alone, other: &Alone) -> Option<f64> {
        let speed = |ball: &Alone| ball.free.orbital_speed;
        let (behind, ahead) = if speed(one) > speed(other) {
            (one, other)
        } else {
            (other, one)
        };
        let [mut rear, mut front] = [behind.free, ahead.free];
        let faster = rear.orbital_speed - front.orbital_speed;
        let mut force = faster / (1.0 / rear.stiffness + 1.0 / front.stiffness);
        let mut speed = front.orbital_speed + force / front.stiffness;
        for _ in 0..ROUNDS {
            let held = AlongTrack::Held(speed);
            rear = self.run(&behind.grooves, held, [0.0, force], Some(&rear.start))?;
            front = self.run(&ahead.grooves, held, [force, 0.0], Some(&front.start))?;
            let left = rear.force + front.force;
            let found = 0.5 * (front.force - rear.force).max(0.0);
            let change = (found - force).abs();
            // A hundredth of what the law of one ball leaves; balls that hardly press are as precise as their balance is.
            let allowed = 1e-4 * found + 1e-8 * self.axial_load;
            force = found;
            if left.abs() <= allowed && change <= allowed {
                return Some(self.normal() * force);
            }
            speed -= left / (rear.stiffness + front.stiffness);
        }
        None
    }

    fn contact_force(&self, nominal: &Alone, deviation: f64) -> Option<f64> {
        if deviation == 0.0 {
            return Some(0.0);
        }
        let of = |nut_deviation| {
            let off = self.alone(nut_deviation, Some(&nominal.free.start))?;
            self.pressing(&off, nominal)
        };
        Some(of(deviation)?.max(of(-deviation)?))
    }
}

/// Figures of every design of a slice, in order; a design out of range has its error in its place.
pub fn columns(designs: &[Design], duty: &Duty) -> Vec<Result<Figures, Error>> {
    designs.iter().map(|design| figures(design, duty)).collect()
}

#[cfg(test)]
mod tests;
