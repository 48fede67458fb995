//! `ball_screw_train`: a row of touching balls in a ball screw, each with given contacts.
//!
//! In the loop it is answered by the closed form of a row ([`closed_form`]), which no step runs and which finds the contacts itself.

mod closed_form;
mod contacts;

use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::geometry::{LARGEST_CONFORMITY, SMALLEST_CONFORMITY};
use epas_friction::ranges::FRICTION_OF_A_ROW;
use epas_reference::friction::ball_screw_ball::{Groove, ScrewContact, ScrewTrack};
use epas_reference::friction::ball_screw_train::solve_screw_train;
use epas_reference::friction::linear_ball::EllipseLaw;
use serde::Serialize;

use super::fields::{BadField, Fields, Object, in_range, request};
use super::model::{Answer, Both};
use super::train::{ScrewNumbers, of_contact, solved};
use closed_form::ClosedRow;
use contacts::{Given, Ways};

/// Names of the grooves' flanks: screw or nut, left or right.
const FLANKS: [(&str, Groove); 4] = [
    ("SL", Groove::ScrewLeft),
    ("SR", Groove::ScrewRight),
    ("NL", Groove::NutLeft),
    ("NR", Groove::NutRight),
];

/// A quantity that was not found is none.
#[derive(Default, Serialize)]
struct Row {
    /// Free speeds.
    orbital_speed: Option<Vec<f64>>,
    contact_force: Option<Vec<f64>>,
    power_loss: Option<f64>,
}

request! {
    struct Request {
        screw: ScrewNumbers = ScrewNumbers::read,
        friction: f64,
        nut_speed: f64,
        balls: Vec<Contacts>,
    }
}

struct Contacts(Vec<Contact>);

struct Contact {
    groove: Groove,
    load: f64,
    angle: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let request = Request::read(&mut fields)?;
    fields.finish()?;
    request.check()?;
    Both {
        in_loop: request.in_loop()?,
        reference: request.reference()?,
    }
    .json()
}

impl Object for Contacts {
    fn read(ball: &mut Fields) -> Result<Self, BadField> {
        let mut given = ball.object("contacts")?;
        ball.finish()?;
        let mut contacts = Vec::new();
        for (name, groove) in FLANKS {
            if let Some(mut contact) = given.optional_object(name)? {
                contacts.push(Contact {
                    groove,
                    load: contact.get("load")?,
                    angle: contact.get("contact_angle")?,
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
        Ok(Self(contacts))
    }
}

impl Request {
    fn check(&self) -> Result<(), BadField> {
        in_range("pitch_radius", self.screw.pitch_radius, 1e-4, 10.0)?;
        in_range("lead", self.screw.lead, 0.0, 20.0 * self.screw.pitch_radius)?;
        in_range(
            "ball_radius",
            self.screw.ball_radius,
            1e-5,
            0.8 * self.screw.pitch_radius,
        )?;
        let diameter = 2.0 * self.screw.ball_radius;
        in_range(
            "groove_radius",
            self.screw.groove_radius,
            f64::from(SMALLEST_CONFORMITY) * diameter,
            f64::from(LARGEST_CONFORMITY) * diameter,
        )?;
        in_range("youngs_modulus", self.screw.youngs_modulus, 1e6, 1e13)?;
        in_range("poisson_ratio", self.screw.poisson_ratio, 0.0, 0.5)?;
        in_range(
            "friction",
            self.friction,
            FRICTION_OF_A_ROW.minimum.into(),
            FRICTION_OF_A_ROW.maximum.into(),
        )?;
        in_range("nut_speed", self.nut_speed, -1e6, 1e6)?;
        for (index, ball) in self.balls.iter().enumerate() {
            for contact in &ball.0 {
                in_range("load", contact.load, 0.0, 1e7)
                    .and_then(|_| in_range("contact_angle", contact.angle, 0.05, 1.5))
                    .map_err(|error| error.of_ball(index))?;
            }
        }
        Ok(())
    }

    /// What the closed form finds, in f32.
    fn in_loop(&self) -> Result<ClosedRow, BadField> {
        self.check_design()?;
        if self.nut_speed == 0.0 {
            return Ok(self.standstill().into());
        }
        Ok(self.of_one_screw().unwrap_or_default())
    }

    /// The same for balls that have such contacts; none where they are not of one screw.
    fn of_one_screw(&self) -> Option<ClosedRow> {
        let balls: Vec<Given> = self
            .balls
            .iter()
            .map(|ball| {
                let mut given = [None; 4];
                for contact in &ball.0 {
                    given[contact.groove as usize] =
                        Some((contact.load as f32, contact.angle as f32));
                }
                given
            })
            .collect();
        let given = contacts::Row::of(&balls)?;
        let design = self.screw.design(given.nominal).ok()?;
        let ways = Ways {
            friction: self.friction as f32,
            nut_speed: self.nut_speed as f32,
        };
        closed_form::row(&given, &design, ways)
    }

    /// Whether the crate takes the screw, with the mean contact angle for its nominal one.
    fn check_design(&self) -> Result<(), BadField> {
        let angles = || {
            self.balls
                .iter()
                .flat_map(|ball| &ball.0)
                .map(|contact| contact.angle)
        };
        let mean = angles().sum::<f64>() / angles().count() as f64;
        let design = self.screw.design(mean as f32)?;
        ScrewRow::new(&design, self.friction as f32, GrooveFit::Zero)
            .map(drop)
            .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))
    }

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
            pitch_radius: self.screw.pitch_radius,
            lead: self.screw.lead,
            ball_radius: self.screw.ball_radius,
        };
        let balls = self
            .balls
            .iter()
            .enumerate()
            .map(|(index, ball)| {
                ball.0
                    .iter()
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
        let design = self.screw.exact(contact.angle);
        let hertz = design.contact(contact.groove.part()).map_err(of_contact)?;
        Ok(hertz.into())
    }
}
