//! `ball_screw_pair`: a row of touching balls in a ball screw, each with its own axial load, in grooves with a clearance of either sign.
//!
//! The reference solves every ball's elastic equilibrium with Coulomb friction by contact integrals of 32 nodes
//! ([`Integration::Coarse`]), with which the stored cases were made: both agree within 6e-9 of a force. Twice the nodes
//! change a force by up to 2.9e-4 N: less than 1e-4 of it, but where a small force is left by two free speeds that are
//! nearly equal (0.4 % of 0.07 N).
//!
//! In the loop balls are what they are in the scene of a ball screw without cage, once it has settled ([`elastic`]); what
//! a closed form finds is answered beside it ([`closed_form`]).

mod closed_form;
mod elastic;
mod request;

use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields};
use request::{Request, Row};

/// What the crate computes: what its scene does, and a closed form.
#[derive(Default, Serialize)]
struct InLoop {
    #[serde(flatten)]
    scene: Row,
    closed_form: Row,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let request = Request::read(&mut fields)?;
    fields.finish()?;
    request.check()?;
    if request.nut_speed == 0.0 {
        // Coulomb friction has no direction at rest.
        return Answer::both(&InLoop::default(), &Row::default());
    }
    let design = request.design()?;
    let in_loop = InLoop {
        scene: elastic::row(&request, &design)?,
        closed_form: closed_form::row(&request, &design)?,
    };
    Answer::both(&in_loop, &request.reference()?)
}
