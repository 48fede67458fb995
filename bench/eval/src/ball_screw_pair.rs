//! `ball_screw_pair`: a row of touching balls in a ball screw, each with its own axial load, in grooves with a clearance of either sign.
//!
//! The reference solves every ball's elastic equilibrium with Coulomb friction by contact integrals of 32 nodes
//! (`Integration::Coarse`), with which the stored cases were made: both agree within 6e-9 of a force. Twice the nodes
//! change a force by up to 2.9e-4 N: less than 1e-4 of it, but where a small force is left by two free speeds that are
//! nearly equal (0.4 % of 0.07 N).
//!
//! In the loop balls follow the law that the scene of a ball screw without cage evaluates, folded for the request ([`folded`]); what
//! a closed form finds is answered beside it ([`closed_form`]).

mod closed_form;
mod folded;
mod request;

use serde::Serialize;

use super::fields::BadField;
use super::model::{Both, Model};
pub use folded::FoldedRow;
pub use request::{Ball, Request, Row};

/// What the crate computes: by the law of its scene, and by a closed form.
#[derive(Clone, Debug, Default, Serialize)]
pub struct InLoop {
    /// By the law of the scene.
    #[serde(flatten)]
    pub law: FoldedRow,
    /// By the closed form, which no scene runs.
    pub closed_form: Row,
}

impl Model for Request {
    const NAME: &'static str = "ball_screw_pair";
    type InLoop = InLoop;
    type Reference = Row;

    fn evaluate(&self) -> Result<Both<InLoop, Row>, BadField> {
        self.check()?;
        if self.nut_speed == 0.0 {
            // Coulomb friction has no direction at rest.
            return Ok(Both {
                in_loop: InLoop::default(),
                reference: Row::default(),
            });
        }
        let design = self.design()?;
        Ok(Both {
            in_loop: InLoop {
                law: folded::row(self, &design),
                closed_form: closed_form::row(self, &design)?,
            },
            reference: self.reference()?,
        })
    }
}
