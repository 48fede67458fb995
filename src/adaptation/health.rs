//! Slow drift of the level.

use super::constants::{HealthConfiguration, average_times};
use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Port, Refusal, Stored};

/// Slow drift of the friction level against the value at commissioning: the mean level of both directions, averaged over minutes or hours of sliding.
///
/// | | possible causes | what to do |
/// |---|---|---|
/// | `fallen` | worn grooves or balls, lost preload: play comes next | check backlash and noise |
/// | `risen` | lost, aged or soaked lubricant, dirt, a tight return; a friction coefficient that was set too low | check the lubricant, lower the assist's reliance on the compensation |
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Health {
    /// Relative change of the slow average since commissioning, -0.99 to 99: -0.2 is a friction that has fallen by a fifth.
    pub drift: f32,
    /// The level has fallen beyond its threshold.
    pub fallen: bool,
    /// The level has risen beyond its threshold.
    pub risen: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct HealthConstants {
    pub(super) share: f32,
    pub(super) fall: f32,
    pub(super) rise: f32,
    pub(super) hysteresis: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct HealthState {
    /// Slow average of the level, less 1: of a small number a small change is not lost to rounding.
    pub(super) average: f32,
    pub(super) commissioned: f32,
    pub(super) health: Health,
}

impl HealthConstants {
    pub(super) const fn new(
        configuration: &HealthConfiguration,
        tick: f32,
        round: f32,
    ) -> Result<Self, Error> {
        let HealthConfiguration {
            average_time,
            fall,
            rise,
            hysteresis,
        } = *configuration;
        attempt!(average_times(tick).checked("average_time", average_time));
        attempt!(in_range("fall", fall, 0.01, 0.9));
        attempt!(in_range("rise", rise, 0.01, 9.0));
        let smaller = if fall < rise { fall } else { rise };
        attempt!(in_range("hysteresis", hysteresis, 0.0, smaller));
        Ok(Self {
            share: round / (round + average_time),
            fall,
            rise,
            hysteresis,
        })
    }
}

impl HealthState {
    pub(super) const NEW: Self = Self {
        average: 0.0,
        commissioned: 0.0,
        health: Health {
            drift: 0.0,
            fallen: false,
            risen: false,
        },
    };

    #[inline(always)]
    pub(super) fn follow(&mut self, constants: &HealthConstants, level: f32) {
        self.average += constants.share * (level - self.average);
        let drift = (self.average - self.commissioned) / (1.0 + self.commissioned);
        let Health { fallen, risen, .. } = self.health;
        let back = |was: bool| if was { constants.hysteresis } else { 0.0 };
        self.health = Health {
            drift,
            fallen: drift < back(fallen) - constants.fall,
            risen: drift > constants.rise - back(risen),
        };
    }

    pub(super) fn commission(&mut self, level: f32) {
        *self = Self {
            average: level,
            commissioned: level,
            ..Self::NEW
        };
    }
}

impl Stored for HealthState {
    const BYTES: usize = 3 * 4 + 2;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let level = Range::new(-0.9, 9.0);
        port.number("average", &mut self.average, level)?;
        port.number("commissioned", &mut self.commissioned, level)?;
        port.number("drift", &mut self.health.drift, Range::new(-0.99, 99.0))?;
        port.flag("fallen", &mut self.health.fallen)?;
        port.flag("risen", &mut self.health.risen)
    }
}
