//! State of an adaptation.

use super::constants::{AdaptationConstants, UPKEEP};
use super::factor::{Factor, Projection};
use super::health::{Health, HealthState};
use super::tick::{AdaptationFlags, AdaptationInputs, ESTIMATES, Estimates};
use crate::error::Range;
use crate::math;
use crate::stored::{Port, Refusal, Stored};

/// Largest error that counts over its deviation, squared: normal noise passes four once in 16,000 readings.
const FURTHEST: f32 = 16.0;

/// State of an adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationState {
    pub(super) estimates: [f32; ESTIMATES],
    pub(super) covariance: Factor<ESTIMATES>,
    pub(super) observed: f32,
    pub(super) regressors: [f32; ESTIMATES],
    /// Of the last tick: the error over the noise, and the projection of the covariance on the reading.
    pub(super) error: f32,
    pub(super) seen: Projection<ESTIMATES>,
    /// Motion of the estimates at the next prediction, in their deviations.
    pub(super) moves: [f32; ESTIMATES],
    /// Ticks since the last upkeep, and which variance the next one renews.
    pub(super) tick: u8,
    pub(super) next: u8,
    pub(super) at_bound: bool,
    pub(super) health: HealthState,
}

pub(super) const START: [f32; ESTIMATES] = [1.0, 1.0, 0.0, 0.0, 0.0];

impl AdaptationState {
    pub(super) const fn new(constants: &AdaptationConstants) -> Self {
        // So small that no variance passes 1 before its own first upkeep.
        let squared = constants.growth * constants.growth;
        Self {
            estimates: START,
            covariance: Factor::independent(1.0 / (squared * squared * constants.growth)),
            observed: 0.0,
            regressors: [0.0; ESTIMATES],
            error: 0.0,
            seen: Projection::NONE,
            moves: [0.0; ESTIMATES],
            tick: 0,
            next: 0,
            at_bound: constants.binds(&START),
            health: HealthState::NEW,
        }
    }

    #[inline(always)]
    pub(super) fn learn(
        &mut self,
        constants: &AdaptationConstants,
        inputs: &AdaptationInputs,
    ) -> AdaptationFlags {
        self.tick = self.tick.wrapping_add(1);
        let mut cut = false;
        if self.tick >= UPKEEP {
            // Both sides of the equation leave this tick out of their filters, so that it stays exact.
            self.tick = 0;
            self.forget(constants);
        } else {
            self.filter(constants, inputs);
            if self.tick & 1 == 1 {
                self.apply(constants);
                self.predict(constants);
            } else {
                cut = self.correct();
            }
        }
        AdaptationFlags::NONE
            .with(cut, AdaptationFlags::ERROR_CUT)
            .with(self.at_bound, AdaptationFlags::AT_BOUND)
    }

    /// Torque and regressors through the same filter, in ticks that count.
    #[inline(always)]
    fn filter(&mut self, constants: &AdaptationConstants, inputs: &AdaptationInputs) {
        let AdaptationInputs {
            observed,
            modelled,
            lubricant_drag,
            level,
            nut_speed,
            load_torque,
            ..
        } = *inputs;
        let full = (modelled - lubricant_drag) / level.of(nut_speed);
        let (forward, backward) = if nut_speed < 0.0 {
            (0.0, full)
        } else {
            (full, 0.0)
        };
        let now = [forward, backward, nut_speed, 1.0, load_torque];
        let scaled = observed - lubricant_drag;
        self.observed += constants.filter * (scaled - self.observed);
        for (filtered, now) in self.regressors.iter_mut().zip(now) {
            *filtered += constants.filter * (now - *filtered);
        }
    }

    /// Error of the filtered torque, and the projection of the covariance on the reading.
    #[inline(always)]
    fn predict(&mut self, constants: &AdaptationConstants) {
        let mut error = self.observed;
        for (estimate, regressor) in self.estimates.iter().zip(&self.regressors) {
            error -= estimate * regressor;
        }
        self.error = error * constants.per_noise;
        let mut weighted = self.regressors;
        for (regressor, weight) in weighted.iter_mut().zip(&constants.weights) {
            *regressor *= weight;
        }
        self.seen = self.covariance.project(&weighted);
    }

    /// Takes the last prediction into the covariance. True where the error was cut.
    #[inline(always)]
    fn correct(&mut self) -> bool {
        let (error, projection) = (self.error, &self.seen);
        // The noise is taken as large as an error beyond four deviations needs.
        let most = error * error * (1.0 / FURTHEST) - projection.variance;
        let cut = most > 1.0;
        let noise = if cut { most } else { 1.0 };
        self.moves = self.covariance.read(projection, noise);
        for entry in &mut self.moves {
            *entry *= error;
        }
        cut
    }

    #[inline(always)]
    fn apply(&mut self, constants: &AdaptationConstants) {
        let mut at_bound = false;
        let bounds = constants.least.iter().zip(&constants.largest);
        let moves = self.moves.iter().zip(&constants.deviations);
        for ((estimate, (entry, deviation)), (&least, &largest)) in
            self.estimates.iter_mut().zip(moves).zip(bounds)
        {
            let moved = *estimate + deviation * entry;
            *estimate = if moved <= least {
                at_bound = true;
                least
            } else if moved >= largest {
                at_bound = true;
                largest
            } else {
                moved
            };
        }
        self.at_bound = at_bound;
    }

    /// Old data lose weight; one variance gets back what it lost; after a round the slow average goes on.
    #[inline(always)]
    fn forget(&mut self, constants: &AdaptationConstants) {
        self.covariance.forget(constants.growth);
        // The number is read off as it is: it does not move.
        let next = usize::from(self.next);
        let projection = self.covariance.project_one(next, constants.prior);
        let _ = self.covariance.read(&projection, 1.0);
        self.next += 1;
        if usize::from(self.next) >= ESTIMATES {
            self.next = 0;
            self.health.follow(&constants.health, self.level_less_one());
        }
    }

    /// Mean level of both directions, less 1.
    #[inline(always)]
    const fn level_less_one(&self) -> f32 {
        let [forward, backward, ..] = self.estimates;
        0.5 * ((forward - 1.0) + (backward - 1.0))
    }

    pub(super) const fn estimates(&self) -> Estimates {
        Estimates::of(&self.estimates)
    }

    pub(super) const fn health(&self) -> Health {
        self.health.health
    }

    pub(super) fn commission(&mut self) {
        self.health.commission(self.level_less_one());
    }

    pub(super) fn deviations(&self, constants: &AdaptationConstants) -> Estimates {
        let mut deviations = self.covariance.variances();
        for (entry, deviation) in deviations.iter_mut().zip(&constants.deviations) {
            *entry = deviation * math::sqrt(*entry);
        }
        Estimates::of(&deviations)
    }
}

/// The filter and the reading of the last tick begin anew.
impl Stored for AdaptationState {
    const BYTES: usize = 4 * ESTIMATES + Factor::<ESTIMATES>::BYTES + 2 + HealthState::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("estimates", &mut self.estimates, Range::new(-1e4, 1e4))?;
        self.covariance.exchange(port)?;
        port.count("tick", &mut self.tick, UPKEEP - 1)?;
        port.count("next", &mut self.next, ESTIMATES as u8 - 1)?;
        self.health.exchange(port)?;
        self.observed = 0.0;
        self.regressors = [0.0; ESTIMATES];
        self.error = 0.0;
        self.seen = Projection::NONE;
        self.moves = [0.0; ESTIMATES];
        Ok(())
    }
}
