//! Configuration, inputs and limits of a linear bearing.

use crate::ball::{
    AnalyticLinearBall, BorderParameters, GrooveFriction, LinearBallParameters, LoadShare,
    LoadShares, largest_deviation, spin_loss,
};
use crate::contact::FrictionMap;
use crate::error::{Error, attempt, in_range};
use crate::geometry::LinearBearing;
use crate::hertz::HertzContact;
use crate::scene::circuit::{Circuit, CircuitConfiguration, DeviationMap, LONGEST_TRACK};
use crate::scene::contract::{CheckedInputs, Motion};
use crate::scene::contract::{Faults, bounded};

/// Configuration of a linear bearing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearingConfiguration {
    /// The validated design.
    pub bearing: LinearBearing,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 1.
    pub friction: f32,
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// Balls in the circuit, 1 to the `N` of the model.
    pub balls: u16,
    /// Length of the loaded track, m, 1e-4 to 100.
    pub loaded_length: f32,
    /// Length of the return, m, 0 to 100, up to 250 times the loaded track: there balls carry no load.
    pub return_length: f32,
    /// Length that counts as one turn of the deviation maps, m, 1e-4 to 100, at least a thousandth of the
    /// track.
    pub wavelength: f32,
    /// Deviation of the contact angles along the rail, added on BR, taken off on BL: at most 0.2 rad for
    /// contact angles from 23 to 68 degrees, beyond half of the contact angle or its cotangent.
    pub rail_deviation: &'static DeviationMap,
    /// Deviation of the contact angles along the carriage, added on TR, taken off on TL; as large.
    pub carriage_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, at the middles of equal parts of the loaded track from its start; 1 to 256.
    pub load_shares: &'static [LoadShare],
    /// Speed over which friction changes its direction, m/s, 1e-9 to 10: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Time between two ticks, s, 1e-6 to 1; at the largest speed the balls may move by 3 % of the track
    /// in it, and the rail by half a period of its deviation map.
    pub tick: f32,
    /// Limits of inputs and outputs.
    pub limits: LinearLimits,
}

impl LinearBearingConfiguration {
    pub(super) const fn circuit(
        &self,
        limits: &LinearLimits,
        most: usize,
    ) -> Result<Circuit, Error> {
        let Self {
            loaded_length,
            return_length,
            wavelength,
            tick,
            ..
        } = *self;
        attempt!(in_range("loaded_length", loaded_length, 1e-4, 100.0));
        attempt!(in_range("return_length", return_length, 0.0, 100.0));
        attempt!(in_range("tick", tick, 1e-6, 1.0));
        let shortest = ((loaded_length + return_length) / LONGEST_TRACK).max(1e-4);
        attempt!(in_range("wavelength", wavelength, shortest, 100.0));
        CircuitConfiguration {
            balls: self.balls,
            loaded_length,
            loaded_turns: loaded_length / wavelength,
            return_length,
            turn_length: wavelength,
            pitch: 2.0 * self.bearing.ball_radius(),
            // A ball that rolls gets on half as far as the carriage.
            travel_per_motion: 0.5,
            motion_per_turn: wavelength,
            passing_deviation: self.rail_deviation,
            recirculating_deviation: self.carriage_deviation,
            load_shares: LoadShares::same(self.load_shares),
            tick,
            largest_speed: limits.speed,
        }
        .folded(most)
    }

    /// The ball, and what it loses in the grooves, with the deviations of both checked.
    pub(super) const fn friction(&self) -> Result<(AnalyticLinearBall, GrooveFriction), Error> {
        let Self {
            ref bearing,
            friction,
            ball_friction,
            rail_deviation,
            carriage_deviation,
            ..
        } = *self;
        let nominal = bearing.parameters().contact_angle;
        let angle = bearing.contact_angle();
        // The deviations' sum times half the tangent is a ball's speed deviation: no more than a half.
        let largest = largest_deviation(nominal, angle.sin / angle.cos);
        attempt!(rail_deviation.checked("rail_deviation", largest));
        attempt!(carriage_deviation.checked("carriage_deviation", largest));

        let contact = HertzContact::of_linear(bearing);
        let map = attempt!(FrictionMap::new(contact.axis_ratio()));
        let half_tangent = 0.5 * angle.sin / angle.cos;
        let parameters = LinearBallParameters {
            ball_radius: bearing.ball_radius(),
            contact_angle: nominal,
            axis_ratio: contact.axis_ratio(),
            semi_major_coefficient: contact.semi_major_coefficient(),
            friction,
        };
        let ball = AnalyticLinearBall::folded(&parameters, half_tangent, map.slope());
        let grooves = GrooveFriction::new(&BorderParameters {
            angle: (angle.sin, angle.cos),
            friction,
            ball_friction,
            spin: spin_loss(&parameters, half_tangent, map.spin_moment()),
            bottom: rail_deviation.extremes(),
            top: carriage_deviation.extremes(),
            shares: LoadShare::extremes(self.load_shares),
        });
        Ok((ball, grooves))
    }
}

/// Inputs of a linear bearing at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearInputs {
    /// Speed of the carriage on the rail, m/s; limited to that of the [`LinearLimits`].
    pub speed: f32,
    /// Force that presses the carriage on the row of balls, N, preload included; zero or less lifts it
    /// off. Within the limits, as the speed.
    pub normal_load: f32,
    /// Force across, N: positive loads the diagonal from bottom left to top right. Within the limits, as the speed.
    pub side_load: f32,
}

/// Limits of inputs and outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearLimits {
    /// Largest speed, m/s, 1e-6 to 1e3.
    pub speed: f32,
    /// Largest normal and side load, N, 1e-3 to 1e7.
    pub load: f32,
    /// Largest output friction force, N, 1e-6 to 1e6.
    pub friction_force: f32,
}

impl LinearLimits {
    /// The limits, checked.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("speed", self.speed, 1e-6, 1e3));
        attempt!(in_range("load", self.load, 1e-3, 1e7));
        attempt!(in_range("friction_force", self.friction_force, 1e-6, 1e6));
        Ok(self)
    }

    #[inline(always)]
    pub(super) fn check_inputs(&self, inputs: LinearInputs) -> CheckedInputs<LinearInputs> {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let loads_are_finite = normal_load.is_finite() && side_load.is_finite();
        if speed.is_finite() && loads_are_finite {
            CheckedInputs {
                inputs: Some(LinearInputs {
                    speed: bounded(speed, self.speed),
                    normal_load: bounded(normal_load, self.load),
                    side_load: bounded(side_load, self.load),
                }),
                faults: Faults::beyond(
                    speed.abs() > self.speed,
                    normal_load.abs() > self.load || side_load.abs() > self.load,
                ),
            }
        } else {
            CheckedInputs {
                inputs: None,
                faults: Faults::not_finite(!speed.is_finite(), !loads_are_finite),
            }
        }
    }
}

impl Motion for LinearInputs {
    const STILL: Self = Self {
        speed: 0.0,
        normal_load: 0.0,
        side_load: 0.0,
    };

    #[inline(always)]
    fn speed(&self) -> f32 {
        self.speed
    }

    #[inline(always)]
    fn load(&self) -> f32 {
        self.normal_load
    }

    #[inline(always)]
    fn with(self, speed: f32, load_factor: f32) -> Self {
        Self {
            speed,
            normal_load: load_factor * self.normal_load,
            side_load: load_factor * self.side_load,
        }
    }
}
