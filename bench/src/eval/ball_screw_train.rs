//! `ball_screw_train`: a row of touching balls in a ball screw, each with given contacts.
//!
//! What is answered for just these contacts is the refined form, which no scene runs. Beside it stand what the scene computes
//! for balls that have such contacts ([`elastic`]) and what a closed form finds for them ([`closed_form`]).

mod closed_form;
mod contacts;
mod elastic;

use epas_friction::geometry::{LARGEST_CONFORMITY, SMALLEST_CONFORMITY};
use epas_friction::refined::{ScrewBall, ScrewBallState, ScrewChain};
use epas_friction::{BallScrew, Error};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ball::{Groove, ScrewContact, ScrewTrack};
use epas_reference::friction::ball_screw_train::solve_screw_train;
use epas_reference::friction::linear_ball::EllipseLaw;
use epas_reference::material::Elastic;
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};
use super::train::{LARGEST_TRAIN, ScrewNumbers, room_of_a_row, solved};
use closed_form::ClosedRow;
use contacts::{Given, Ways};
use elastic::ElasticRow;

/// Names of the grooves' flanks: screw or nut, left or right.
const FLANKS: [(&str, Groove); 4] = [
    ("SL", Groove::ScrewLeft),
    ("SR", Groove::ScrewRight),
    ("NL", Groove::NutLeft),
    ("NR", Groove::NutRight),
];

/// Most impedance steps of the whole row: friction between the balls lags one step behind.
const STEPS: usize = 24;

/// Change of a force in a step, over the largest force: below the first, steps end; below the second, the row
/// counts as settled after the last step. Forces are the means of two steps: where a third contact is about to
/// slide, single steps swing about the solution by some per cent. Where many contacts slide the steps diverge:
/// friction between the balls then changes the forces by more than the forces changed it.
const UNCHANGED: f32 = 1e-5;
const SETTLED: f32 = 2e-3;

/// A quantity that was not found is none.
#[derive(Default, Serialize)]
struct Row {
    /// Free speeds.
    orbital_speed: Option<Vec<f64>>,
    contact_force: Option<Vec<f64>>,
    power_loss: Option<f64>,
}

/// What the crate computes.
#[derive(Serialize)]
struct InLoop {
    /// Balls with just these contacts: the refined form, which no scene runs.
    #[serde(flatten)]
    given: Row,
    /// What the scene computes for the axial loads and deviations that the contacts follow from.
    elastic: Option<ElasticRow>,
    /// What the closed form of a row finds for them; its name is from when the scene ran it.
    scene: Option<ClosedRow>,
}

struct Request {
    pitch_radius: f64,
    lead: f64,
    ball_radius: f64,
    groove_radius: f64,
    youngs_modulus: f64,
    poisson_ratio: f64,
    friction: f64,
    nut_speed: f64,
    balls: Vec<Vec<Contact>>,
}

struct Contact {
    groove: Groove,
    load: f64,
    angle: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let request = Request {
        pitch_radius: fields.number("pitch_radius")?,
        lead: fields.number("lead")?,
        ball_radius: fields.number("ball_radius")?,
        groove_radius: fields.number("groove_radius")?,
        youngs_modulus: fields.number("youngs_modulus")?,
        poisson_ratio: fields.number("poisson_ratio")?,
        friction: fields.number("friction")?,
        nut_speed: fields.number("nut_speed")?,
        balls: fields.balls(LARGEST_TRAIN, contacts)?,
    };
    fields.finish()?;
    request.check()?;
    let (elastic, scene) = request.of_one_screw().unwrap_or_default();
    let in_loop = InLoop {
        given: request.refined()?,
        elastic,
        scene,
    };
    Answer::both(&in_loop, &request.reference()?)
}

fn contacts(mut ball: Fields) -> Result<Vec<Contact>, BadField> {
    let mut given = ball.object("contacts")?;
    ball.finish()?;
    let mut contacts = Vec::new();
    for (name, groove) in FLANKS {
        if let Some(mut contact) = given.optional_object(name)? {
            contacts.push(Contact {
                groove,
                load: contact.number("load")?,
                angle: contact.number("contact_angle")?,
            });
            contact.finish()?;
        }
    }
    given.finish()?;
    if contacts.len() < 2 {
        return Err(BadField::new(
            "contacts",
            format!("{} of them; a ball has two to four", contacts.len()),
        ));
    }
    Ok(contacts)
}

/// Whether screw and nut both carry the ball: one that either has lost does not move with the nut.
fn is_driven(ball: &[Contact]) -> bool {
    [false, true].into_iter().all(|on_nut| {
        ball.iter()
            .any(|contact| contact.groove.on_nut() == on_nut && contact.load > 0.0)
    })
}

impl Request {
    fn check(&self) -> Result<(), BadField> {
        in_range("pitch_radius", self.pitch_radius, 1e-4, 10.0)?;
        in_range("lead", self.lead, 0.0, 20.0 * self.pitch_radius)?;
        in_range(
            "ball_radius",
            self.ball_radius,
            1e-5,
            0.8 * self.pitch_radius,
        )?;
        let diameter = 2.0 * self.ball_radius;
        in_range(
            "groove_radius",
            self.groove_radius,
            f64::from(SMALLEST_CONFORMITY) * diameter,
            f64::from(LARGEST_CONFORMITY) * diameter,
        )?;
        in_range("youngs_modulus", self.youngs_modulus, 1e6, 1e13)?;
        in_range("poisson_ratio", self.poisson_ratio, 0.0, 0.5)?;
        in_range("friction", self.friction, 1e-6, 0.5)?;
        in_range("nut_speed", self.nut_speed, -1e6, 1e6)?;
        for (index, ball) in self.balls.iter().enumerate() {
            for contact in ball {
                in_range("load", contact.load, 0.0, 1e7)
                    .and_then(|_| in_range("contact_angle", contact.angle, 0.05, 1.5))
                    .map_err(|error| error.of_ball(index))?;
            }
        }
        Ok(())
    }

    /// What scene and closed form find, in f32, for balls that have such contacts; none where they are not of one screw.
    fn of_one_screw(&self) -> Option<(Option<ElasticRow>, Option<ClosedRow>)> {
        if self.nut_speed == 0.0 {
            return None;
        }
        let balls: Vec<Given> = self
            .balls
            .iter()
            .map(|ball| {
                let mut given = [None; 4];
                for contact in ball {
                    given[contact.groove as usize] =
                        Some((contact.load as f32, contact.angle as f32));
                }
                given
            })
            .collect();
        let given = contacts::Row::of(&balls)?;
        let design = self.design(given.nominal).ok()?;
        let ways = Ways {
            friction: self.friction as f32,
            nut_speed: self.nut_speed as f32,
        };
        Some((
            elastic::row(&given, |angle| self.design(angle), ways),
            closed_form::row(&given, &design, ways),
        ))
    }

    /// The impedance iteration, in f32.
    fn refined(&self) -> Result<Row, BadField> {
        let ball = self.ball()?;
        if self.nut_speed == 0.0 {
            return Ok(self.standstill());
        }
        if !self.balls.iter().all(|ball| is_driven(ball)) {
            return Ok(Row::default());
        }
        // The chain of the crate runs from rear to front for a nut that turns forward.
        let (direction, backward) = if self.nut_speed < 0.0 {
            (-1.0, true)
        } else {
            (1.0, false)
        };
        let count = self.balls.len();
        // Places without a ball have no contacts, and infinite room on both sides.
        let mut contacts = [ball.contacts(&[0.0; 4], &[0.0; 4]); LARGEST_TRAIN];
        let mut states = [ScrewBallState::default(); LARGEST_TRAIN];
        let mut orbital_speed = Vec::with_capacity(count);
        for (index, request) in self.balls.iter().enumerate() {
            let place = if backward { count - 1 - index } else { index };
            let (mut angles, mut loads) = ([0.0; 4], [0.0; 4]);
            for contact in request {
                let flank = contact.groove as usize;
                (angles[flank], loads[flank]) = (contact.angle as f32, contact.load as f32);
            }
            contacts[place] = ball.contacts(&angles, &loads);
            states[place] = ball.solve(&contacts[place]);
            let speed = ball.orbital_speed(&states[place].motion);
            orbital_speed.push(self.nut_speed * f64::from(speed));
        }

        let mut chain = ScrewChain::new(states);
        let room = room_of_a_row(count);
        let mut sound = true;
        let mut settled = false;
        let mut means = chain.forces;
        for _ in 0..STEPS {
            let before = chain.forces;
            sound &= ball.refine_chain(
                &contacts,
                &mut chain,
                &room,
                direction,
                self.friction as f32,
            );
            let (mut largest, mut change) = (0.0_f32, 0.0_f32);
            for ((force, before), mean) in chain.forces.iter().zip(&before).zip(&mut means) {
                let next = 0.5 * (force + before);
                change = change.max((next - *mean).abs());
                largest = largest.max(next);
                *mean = next;
            }
            settled = change <= SETTLED * largest;
            if change <= UNCHANGED * largest {
                break;
            }
        }
        let grooves: f64 = chain.balls[..count]
            .iter()
            .map(|state| f64::from(state.groove_torque))
            .sum();
        chain.forces = means;
        let between = f64::from(ball.ball_torque(&chain, self.friction as f32));
        let mut forces: Vec<_> = means[..count - 1]
            .iter()
            .map(|&force| force.into())
            .collect();
        if backward {
            forces.reverse();
        }
        Ok(if sound && settled {
            Row {
                orbital_speed: Some(orbital_speed),
                contact_force: Some(forces),
                power_loss: Some(self.nut_speed.abs() * (grooves + between)),
            }
        } else {
            Row {
                orbital_speed: Some(orbital_speed),
                ..Row::default()
            }
        })
    }

    /// The crate's ball, with the mean contact angle for its nominal one.
    fn ball(&self) -> Result<ScrewBall, BadField> {
        let angles = || self.balls.iter().flatten().map(|contact| contact.angle);
        let mean = angles().sum::<f64>() / angles().count() as f64;
        ScrewBall::new(&self.design(mean as f32)?, self.friction as f32)
            .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))
    }

    /// The screw with a nominal contact angle.
    fn design(&self, contact_angle: f32) -> Result<BallScrew, Error> {
        ScrewNumbers {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
            groove_radius: self.groove_radius,
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        }
        .design(contact_angle)
    }

    /// Nothing moves; forces between balls are undefined.
    fn standstill(&self) -> Row {
        Row {
            orbital_speed: Some(vec![0.0; self.balls.len()]),
            contact_force: None,
            power_loss: Some(0.0),
        }
    }

    fn reference(&self) -> Result<Row, BadField> {
        if self.nut_speed == 0.0 {
            return Ok(self.standstill());
        }
        let track = ScrewTrack {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
        };
        let balls = self
            .balls
            .iter()
            .enumerate()
            .map(|(index, ball)| {
                ball.iter()
                    .map(|contact| {
                        Ok(ScrewContact {
                            groove: contact.groove,
                            load: contact.load,
                            contact_angle: contact.angle,
                            ellipse: self
                                .ellipse(contact)
                                .map_err(|error| error.of_ball(index))?,
                        })
                    })
                    .collect::<Result<Vec<_>, BadField>>()
            })
            .collect::<Result<Vec<_>, _>>()?;
        // The request has one coefficient: balls rub on each other as they do in the grooves.
        let train = solved(solve_screw_train(
            &track,
            &balls,
            self.friction,
            self.friction,
            self.nut_speed,
        ))?;
        Ok(train.map_or_else(Row::default, |train| Row {
            power_loss: Some(train.power_loss()),
            orbital_speed: Some(train.free_speeds),
            contact_force: Some(train.contact_forces),
        }))
    }

    /// Ellipse of a contact, from the principal curvatures of the groove there: its arc meets the ball
    /// at the contact's own angle.
    fn ellipse(&self, contact: &Contact) -> Result<EllipseLaw, BadField> {
        let material = Elastic {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        };
        let design = BallScrewDesign {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
            screw_groove_radius: self.groove_radius,
            nut_groove_radius: self.groove_radius,
            contact_angle: contact.angle,
            ball: material,
            groove: material,
        };
        let hertz = design.contact(contact.groove.part()).map_err(|error| {
            BadField::from(error)
                .renamed("offset_h", "groove_radius")
                .renamed("relative_radius_1", "pitch_radius")
                .renamed("relative_radius_2", "groove_radius")
                .renamed("contact_modulus", "youngs_modulus")
        })?;
        Ok(hertz.into())
    }
}
