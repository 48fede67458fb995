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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::ScrewNumbers;
    use std::f64::consts::{FRAC_PI_4, PI};

    /// A row of twelve balls of lin-2.1 under 100 N each, in grooves whose deviations fall along it by a degree and a half: all press.
    fn row(ball_friction: f64, axial_load: f64) -> Request {
        let balls = (0..12)
            .map(|ball| {
                let phase = PI * (f64::from(ball) + 0.5) / 12.0;
                Ball {
                    screw_deviation: 0.0175 * phase.cos(),
                    nut_deviation: 0.0087 * phase.cos(),
                    axial_load,
                }
            })
            .collect();
        Request {
            screw: ScrewNumbers::LIN_2_1,
            contact_angle: FRAC_PI_4,
            friction: 0.1,
            ball_friction,
            clearance: 0.0,
            chord: true,
            nut_speed: 1.0,
            balls,
        }
    }

    /// What rubbing adds in the grooves is in the torques of both sides, and a step's flag is set where balls rub more than the law holds.
    #[test]
    fn groove_torques_of_rubbing_balls_are_alike() {
        for (ball_friction, load, allowed, flagged) in [
            (0.0, 100.0, 0.005, false),
            (0.0, -100.0, 0.005, false),
            (0.05, 100.0, 0.01, false),
            (0.05, -100.0, 0.01, false),
            (0.5, 100.0, 1.0, true),
        ] {
            let Both { in_loop, reference } = row(ball_friction, load).evaluate().unwrap();
            let law = &in_loop.law;
            let found = law.found.groove_torque.unwrap();
            assert_eq!(law.flagged, Some(flagged), "{ball_friction} {load}");
            if let Some(exact) = reference.groove_torque {
                let error = found / exact - 1.0;
                assert!(error.abs() < allowed, "{ball_friction} {load}: {error}");
                println!(
                    "{ball_friction} {load}: {error} {:?}",
                    reference.ball_torque
                );
            }
        }
    }
}
