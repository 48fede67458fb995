//! `linear_train`: a row of touching balls in a four-point contact linear bearing.

use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::contact::FrictionMap;
use epas_friction::hertz::HertzContact;
use epas_friction::ranges::FRICTION;
use epas_friction::train::Press;
use epas_friction::{GrooveSize, LinearBearing, LinearBearingParameters, Material};
use epas_reference::friction::chain::{LinearChain, solve_chain};
use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall};
use epas_reference::hertz::{Hertz, contact_modulus};
use serde::Serialize;

use super::fields::{BadField, Fields, in_range, request};
use super::model::{Both, Model};
use super::train::{LARGEST_TRAIN, contact_forces, pressed, room_of_a_row, solved};

/// Contact angles are taken at most this far from the nominal one, rad.
const LARGEST_ANGLE_DEVIATION: f64 = 0.3;

/// What the crate finds.
#[derive(Clone, Debug, Serialize)]
pub struct InLoop {
    /// What the scene runs: the closed form with the exact slope of the contact.
    pub scene: Row,
    /// The closed form with the printed slope.
    pub analytic: Row,
}

/// A row by a closed form; none where balls run further from nominal rolling than the crate counts.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Speed of each ball over that of nominal rolling, less one.
    pub speed_deviation: Option<Vec<f64>>,
    /// Force between each ball and the next, N.
    pub contact_force: Option<Vec<f64>>,
}

/// What the reference finds; none where there is no solution.
#[derive(Clone, Debug, Serialize)]
pub struct Reference {
    /// Speed of each ball over that of nominal rolling, less one.
    pub speed_deviation: Option<Vec<f64>>,
    /// Force between each ball and the next, N.
    pub contact_force: Option<Vec<f64>>,
    /// Power lost, W.
    pub power_loss: Option<f64>,
}

request! {
    /// A row of touching balls.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Ball radius, m.
        ball_radius: f64,
        /// Groove radius over ball diameter.
        conformity: f64,
        /// Nominal contact angle, rad, 0.05 to 1.5.
        nominal_contact_angle: f64,
        /// Young's modulus of balls and grooves, Pa.
        youngs_modulus: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
        /// Friction coefficient in the grooves, 1e-6 to 1.
        friction: f64,
        /// Friction coefficient between balls, 0 to 1.
        ball_friction: f64 = |fields: &mut Fields| fields.or("ball_friction", 0.0),
        /// Speed of the track, m/s, up to 1e6 either way.
        speed: f64,
        /// Rear to front, 1 to 64 of them.
        balls: Vec<Ball>,
    }
}

request! {
    /// A ball, in the order BL, BR, TR, TL.
    #[derive(Clone, Debug, Serialize)]
    pub struct Ball {
        /// Contact angles, rad, within 0.3 of the nominal one.
        contact_angles: [f64; 4],
        /// Contact forces, N, 0 to 1e7; 0 is a lost contact.
        contact_forces: [f64; 4],
    }
}

impl Model for Request {
    const NAME: &'static str = "linear_train";
    type InLoop = InLoop;
    type Reference = Reference;

    fn evaluate(&self) -> Result<Both<InLoop, Reference>, BadField> {
        self.check()?;
        Ok(Both {
            in_loop: self.in_loop()?,
            reference: self.reference()?,
        })
    }
}

impl Request {
    fn check(&self) -> Result<(), BadField> {
        let nominal = in_range(
            "nominal_contact_angle",
            self.nominal_contact_angle,
            0.05,
            1.5,
        )?;
        in_range(
            "friction",
            self.friction,
            FRICTION.minimum.into(),
            FRICTION.maximum.into(),
        )?;
        in_range("ball_friction", self.ball_friction, 0.0, 1.0)?;
        in_range("speed", self.speed, -1e6, 1e6)?;
        let (lowest, highest) = (
            (nominal - LARGEST_ANGLE_DEVIATION).max(0.01),
            (nominal + LARGEST_ANGLE_DEVIATION).min(1.56),
        );
        for (index, ball) in self.balls.iter().enumerate() {
            let here = |error: BadField| error.of_ball(index);
            for angle in ball.contact_angles {
                in_range("contact_angles", angle, lowest, highest).map_err(here)?;
            }
            for force in ball.contact_forces {
                in_range("contact_forces", force, 0.0, 1e7).map_err(here)?;
            }
        }
        Ok(())
    }

    fn in_loop(&self) -> Result<InLoop, BadField> {
        let renamed = |error: epas_friction::Error| {
            BadField::from(error)
                .renamed("contact_angle", "nominal_contact_angle")
                .renamed("axis_ratio", "conformity")
                .renamed("semi_major_coefficient", "youngs_modulus")
        };
        let material = Material {
            youngs_modulus: self.youngs_modulus as f32,
            poisson_ratio: self.poisson_ratio as f32,
            ..Material::STEEL
        };
        let bearing = LinearBearing::new(LinearBearingParameters {
            ball_radius: self.ball_radius as f32,
            groove: GrooveSize::Conformity(self.conformity as f32),
            contact_angle: self.nominal_contact_angle as f32,
            ball_material: material,
            groove_material: material,
        })
        .map_err(renamed)?;
        let contact = HertzContact::of_linear(&bearing);
        let parameters = LinearBallParameters {
            ball_radius: bearing.ball_radius(),
            contact_angle: self.nominal_contact_angle as f32,
            axis_ratio: contact.axis_ratio(),
            semi_major_coefficient: contact.semi_major_coefficient(),
            friction: self.friction as f32,
        };
        let map = FrictionMap::new(contact.axis_ratio()).map_err(renamed)?;
        let closed_form =
            |slope| AnalyticLinearBall::new(&parameters, slope).map(|ball| self.analytic(&ball));
        Ok(InLoop {
            scene: closed_form(map.slope()).map_err(renamed)?,
            analytic: closed_form(PUBLISHED_SLOPE).map_err(renamed)?,
        })
    }

    fn direction(&self) -> f32 {
        if self.speed == 0.0 {
            0.0
        } else {
            self.speed.signum() as f32
        }
    }

    fn analytic(&self, ball: &AnalyticLinearBall) -> Row {
        let count = self.balls.len();
        let mut free = [0.0; LARGEST_TRAIN];
        let mut compliance = [1.0; LARGEST_TRAIN];
        for (request, (free, compliance)) in
            self.balls.iter().zip(free.iter_mut().zip(&mut compliance))
        {
            let (angles, forces) = request.rounded();
            let found = ball.speed_deviation(&angles, &forces);
            (*free, *compliance) = (found.speed_deviation, found.compliance);
        }
        let direction = self.direction();
        if direction == 0.0 {
            return Row::of(&free, &[0.0; LARGEST_TRAIN], count);
        }
        let mut press = Press::<LARGEST_TRAIN>::new();
        let forward = free.map(|deviation| direction * deviation);
        if !pressed(&mut press, &forward, &compliance, &room_of_a_row(count)) {
            return Row::NONE;
        }
        let actual: Vec<_> = press.speeds().map(|speed| direction * speed).collect();
        Row::of(&actual, &contact_forces(&press), count)
    }

    fn reference(&self) -> Result<Reference, BadField> {
        let material = (self.youngs_modulus, self.poisson_ratio);
        let groove_radius_factor = 2.0 * self.conformity / (2.0 * self.conformity - 1.0);
        let contact = Hertz::new(
            self.ball_radius,
            groove_radius_factor * self.ball_radius,
            contact_modulus(material, material),
        )
        .map_err(|error| {
            BadField::from(error)
                .renamed("relative_radius_1", "ball_radius")
                .renamed("relative_radius_2", "conformity")
                .renamed("contact_modulus", "youngs_modulus")
        })?;
        let balls: Vec<_> = self
            .balls
            .iter()
            .map(|ball| LinearBall {
                ball_radius: self.ball_radius,
                friction: self.friction,
                contact_angles: ball.contact_angles,
                contact_forces: ball.contact_forces,
                ellipse: EllipseLaw {
                    semi_major_constant: contact.semi_major,
                    axis_ratio: contact.axis_ratio,
                },
            })
            .collect();
        let chain = solved(solve_chain(&balls, self.ball_friction, self.speed))?;
        Ok(Reference {
            speed_deviation: chain.as_ref().map(|chain| {
                chain
                    .balls
                    .iter()
                    .map(|ball| ball.speed_deviation)
                    .collect()
            }),
            power_loss: if self.speed == 0.0 {
                Some(0.0)
            } else {
                chain.as_ref().map(LinearChain::power_loss)
            },
            contact_force: chain.map(|chain| chain.contact_forces),
        })
    }
}

impl Ball {
    fn rounded(&self) -> ([f32; 4], [f32; 4]) {
        (
            self.contact_angles.map(|angle| angle as f32),
            self.contact_forces.map(|force| force as f32),
        )
    }
}

impl Row {
    const NONE: Self = Self {
        speed_deviation: None,
        contact_force: None,
    };

    fn of(deviations: &[f32], forces: &[f32], count: usize) -> Self {
        let numbers = |values: &[f32], count: usize| {
            Some(values.iter().take(count).map(|&v| v.into()).collect())
        };
        Self {
            speed_deviation: numbers(deviations, count),
            contact_force: numbers(forces, count - 1),
        }
    }
}
