//! Configuration and constants of an adaptation.

use super::health::HealthConstants;
use super::state::START;
use super::tick::{AdaptationFlags, AdaptationInputs, ESTIMATES};
use crate::error::{Error, Range, all_in_range, attempt, in_range};
use crate::law::LEVEL;
use crate::scene::Regime;
use crate::stored::{Fingerprint, Fingerprinted};

/// Ticks in which data lose their weight: with 1e5 rounding is a thousandth of a variance's growth between two upkeeps.
const FORGETTING_TICKS: Range = Range::new(200.0, 1e5);

/// Ticks of the slow average's time constant: with 1e7 rounding stops an average of 0.1 within 8e-4 of the level that it follows.
const AVERAGE_TICKS: Range = Range::new(400.0, 1e7);

pub(super) const fn forgetting_times(tick: f32) -> Range {
    times(FORGETTING_TICKS, tick)
}

pub(super) const fn average_times(tick: f32) -> Range {
    times(AVERAGE_TICKS, tick)
}

const fn times(ticks: Range, tick: f32) -> Range {
    Range::new(ticks.minimum * tick, ticks.maximum * tick)
}

const fn nearest(value: f32, range: Range) -> f32 {
    value.max(range.minimum).min(range.maximum)
}

/// Configuration of an adaptation; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationConfiguration {
    /// Time between two updates, s, 1e-5 to 1. 1 ms to 10 ms are enough: levels change in minutes.
    pub tick: f32,
    /// Time in which data lose their weight, s, 200 to 1e5 ticks; only ticks that count run. Short follows fast, long is quiet.
    pub forgetting_time: f32,
    /// Time constant of the filter, s, 0 to 1: about that of the speed's own filter. 0 for no filter.
    pub filter_time: f32,
    /// Noise of the observed torque after the filter, one standard deviation, N m, 1e-6 to 1e3, at least 1e-5 of the deviations below times the limits.
    pub noise: f32,
    /// Deviation of a level from 1, one standard deviation, 0 to 10. 0 holds both levels.
    pub level_deviation: f32,
    /// Least level, 0.1 to 1.
    pub least_level: f32,
    /// Largest level, 1 to 10.
    pub largest_level: f32,
    /// Size of the drag, one standard deviation, N m s/rad, 0 to 1e3. 0 leaves it out.
    pub drag_deviation: f32,
    /// Largest drag of either sign, N m s/rad, 0 to 1e4; below 0 the model has too much of its own.
    pub largest_drag: f32,
    /// Size of the offset, one standard deviation, N m, 0 to 1e3. 0 leaves it out. Under a load that does not change it looks like two levels that
    /// differ.
    pub offset_deviation: f32,
    /// Largest offset of either sign, N m, 0 to 1e4.
    pub largest_offset: f32,
    /// Relative error of the load torque, one standard deviation, 0 to 1. 0 leaves it out.
    pub load_deviation: f32,
    /// Largest relative error of the load torque, of either sign, 0 to 1.
    pub largest_load_error: f32,
    /// Largest torque that is believed, N m, 1e-6 to 1e6: observed, of the model, and of the load.
    pub largest_torque: f32,
    /// Largest nut speed, rad/s, 1e-3 to 1e6.
    pub largest_speed: f32,
    /// Nut speed below which a tick does not count, rad/s, 0 to `largest_speed`.
    pub least_speed: f32,
    /// Friction torque of the model below which a tick does not count, N m, 0 to `largest_torque`.
    pub least_friction: f32,
    /// Slow drift of the level.
    pub health: HealthConfiguration,
}

/// Thresholds of a drift of the level; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HealthConfiguration {
    /// Time constant of the slow average, s, 400 to 1e7 ticks; only ticks that count run.
    pub average_time: f32,
    /// Relative fall of the level, against its commissioning, from which wear or lost preload is flagged: 0.01 to 0.9.
    pub fall: f32,
    /// Relative rise from which lost lubricant is flagged: 0.01 to 9.
    pub rise: f32,
    /// Way back of the drift until a flag is taken away, 0 to the smaller of the two above.
    pub hysteresis: f32,
}

impl HealthConfiguration {
    /// Ten minutes of sliding; flagged at a fall by 30 % or a rise by 50 %, until it has gone back by 10 %: assumed.
    pub const DEFAULT: Self = Self {
        average_time: 600.0,
        fall: 0.3,
        rise: 0.5,
        hysteresis: 0.1,
    };
}

impl AdaptationConfiguration {
    /// For a steering gear with some 10 to 100 mN m of friction at the nut, updated every `tick`, s, 1e-5 to 1: levels and the load's gain, with
    /// no drag and no offset. 5 s to forget (from 25 ms on 200 ticks, below 50 us 1e5); ten minutes of slow average (below 60 us 1e7 ticks).
    /// All numbers are assumed, and tried on a simulated drive of a minute.
    #[must_use]
    pub const fn every(tick: f32) -> Self {
        let health = HealthConfiguration::DEFAULT;
        Self {
            tick,
            forgetting_time: nearest(5.0, forgetting_times(tick)),
            // Two ticks of 10 ms.
            filter_time: 0.02,
            // Of 10 mN m in each tick of 1 ms the mean of ten and this filter leave 1.4 mN m.
            noise: 2e-3,
            // Up to a factor of 2.5 either way: two deviations down, five up.
            level_deviation: 0.3,
            least_level: 0.4,
            largest_level: 2.5,
            drag_deviation: 0.0,
            largest_drag: 0.0,
            offset_deviation: 0.0,
            largest_offset: 0.0,
            load_deviation: 0.01,
            largest_load_error: 0.1,
            largest_torque: 10.0,
            largest_speed: 500.0,
            least_speed: 0.2,
            least_friction: 5e-3,
            health: HealthConfiguration {
                average_time: nearest(health.average_time, average_times(tick)),
                ..health
            },
        }
    }
}

/// Ticks from one upkeep to the next: four looks with their corrections, two ticks each, and the upkeep.
pub(super) const UPKEEP: u8 = 9;

const ROUND: f32 = 45.0;

/// Largest regressor, times its deviation over the noise: such a reading leaves 1e-10 of a variance, ten times the
/// [least](super::factor::LEAST) that is kept.
const LARGEST_REGRESSOR: f32 = 1e5;

/// Constants of an adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationConstants {
    /// Share of a new value in the filter.
    pub(super) filter: f32,
    /// 1 over the noise, 1/(N m).
    pub(super) per_noise: f32,
    /// Deviations at set-up, in the estimates' own units.
    pub(super) deviations: [f32; ESTIMATES],
    /// Deviations over the noise, in the estimates' units over N m.
    pub(super) weights: [f32; ESTIMATES],
    /// Bounds of the estimates, in their own units; none of one that is held.
    pub(super) least: [f32; ESTIMATES],
    pub(super) largest: [f32; ESTIMATES],
    /// Variances grow by this factor from one upkeep to the next.
    pub(super) growth: f32,
    /// Weight of the pretended reading of one number that takes back the growth of its variance in a round of upkeeps.
    pub(super) prior: f32,
    /// Largest torque and speed that are believed, N m and rad/s.
    pub(super) largest_torque: f32,
    pub(super) largest_speed: f32,
    /// Speed and friction torque below which a tick does not count, rad/s and N m.
    pub(super) least_speed: f32,
    pub(super) least_friction: f32,
    pub(super) health: HealthConstants,
}

impl AdaptationConstants {
    /// Checks the configuration and folds the constants.
    pub const fn new(configuration: &AdaptationConfiguration) -> Result<Self, Error> {
        let c = configuration;
        attempt!(checked(configuration));
        let deviations = deviations(configuration);
        let (least, largest) = bounds(configuration, &deviations);
        // A level divides the model's torque: by 0.1 at the least.
        let regressors = [
            c.largest_torque / LEVEL.minimum,
            c.largest_torque / LEVEL.minimum,
            c.largest_speed,
            1.0,
            c.largest_torque,
        ];
        let noise = attempt!(checked_noise(c.noise, &deviations, &regressors));
        // Data lose their weight over the ticks of an upkeep.
        let growth = UPKEEP as f32 * c.tick / c.forgetting_time;
        Ok(Self {
            filter: c.tick / (c.tick + c.filter_time),
            per_noise: 1.0 / noise,
            deviations,
            weights: over(deviations, noise),
            least,
            largest,
            growth: 1.0 + growth,
            prior: crate::math::constant::sqrt(fifth_power_less_one(growth)),
            largest_torque: c.largest_torque,
            largest_speed: c.largest_speed,
            least_speed: c.least_speed,
            least_friction: c.least_friction,
            health: attempt!(HealthConstants::new(&c.health, c.tick, ROUND * c.tick)),
        })
    }

    pub(super) const fn binds(&self, estimates: &[f32; ESTIMATES]) -> bool {
        let mut index = 0;
        while index < ESTIMATES {
            let estimate = estimates[index];
            if estimate <= self.least[index] || estimate >= self.largest[index] {
                return true;
            }
            index += 1;
        }
        false
    }

    pub(super) fn allows(&self, estimates: &[f32; ESTIMATES]) -> bool {
        let bounds = self.least.iter().zip(&self.largest);
        let starts = START.iter().zip(&self.deviations);
        let mut all = estimates.iter().zip(bounds).zip(starts);
        all.all(|((estimate, (least, largest)), (start, &deviation))| {
            let found = deviation > 0.0 || estimate == start;
            found && estimate >= least && estimate <= largest
        })
    }

    #[inline(always)]
    pub(super) fn gate(&self, inputs: &AdaptationInputs) -> AdaptationFlags {
        let AdaptationInputs {
            observed,
            modelled,
            lubricant_drag,
            level,
            nut_speed,
            load_torque,
            regime,
            faults,
            saturated,
        } = *inputs;
        // False for NaN.
        let sound = observed.abs() <= self.largest_torque
            && modelled.abs() <= self.largest_torque
            && lubricant_drag.abs() <= self.largest_torque
            && load_torque.abs() <= self.largest_torque
            && nut_speed.abs() <= self.largest_speed
            && LEVEL.contains(level.of(nut_speed));
        let scaled = modelled - lubricant_drag;
        let slides = matches!(
            regime,
            Regime::Driving | Regime::BackDriving | Regime::Locked
        ) && nut_speed.abs() >= self.least_speed
            && (scaled < 0.0) == (nut_speed < 0.0);
        AdaptationFlags::NONE
            .with(!sound, AdaptationFlags::INPUT_RANGE)
            .with(faults.doubtful(), AdaptationFlags::FAULTED)
            .with(saturated, AdaptationFlags::SATURATED)
            .with(!slides, AdaptationFlags::STANDING)
            .with(
                !(scaled.abs() >= self.least_friction),
                AdaptationFlags::TOO_WEAK,
            )
    }
}

/// Checks every field but the noise and the health, which depend on others.
const fn checked(configuration: &AdaptationConfiguration) -> Result<(), Error> {
    let c = configuration;
    attempt!(in_range("tick", c.tick, 1e-5, 1.0));
    attempt!(forgetting_times(c.tick).checked("forgetting_time", c.forgetting_time));
    let (largest_torque, largest_speed) = (c.largest_torque, c.largest_speed);
    all_in_range(&[
        ("filter_time", c.filter_time, 0.0, 1.0),
        ("level_deviation", c.level_deviation, 0.0, 10.0),
        ("least_level", c.least_level, LEVEL.minimum, 1.0),
        ("largest_level", c.largest_level, 1.0, LEVEL.maximum),
        ("drag_deviation", c.drag_deviation, 0.0, 1e3),
        ("largest_drag", c.largest_drag, 0.0, 1e4),
        ("offset_deviation", c.offset_deviation, 0.0, 1e3),
        ("largest_offset", c.largest_offset, 0.0, 1e4),
        ("load_deviation", c.load_deviation, 0.0, 1.0),
        ("largest_load_error", c.largest_load_error, 0.0, 1.0),
        ("largest_torque", largest_torque, 1e-6, 1e6),
        ("largest_speed", largest_speed, 1e-3, 1e6),
        ("least_speed", c.least_speed, 0.0, largest_speed),
        ("least_friction", c.least_friction, 0.0, largest_torque),
    ])
}

const fn deviations(configuration: &AdaptationConfiguration) -> [f32; ESTIMATES] {
    [
        configuration.level_deviation,
        configuration.level_deviation,
        configuration.drag_deviation,
        configuration.offset_deviation,
        configuration.load_deviation,
    ]
}

const fn bounds(
    configuration: &AdaptationConfiguration,
    deviations: &[f32; ESTIMATES],
) -> ([f32; ESTIMATES], [f32; ESTIMATES]) {
    let c = configuration;
    let (drag, offset, load_error) = (c.largest_drag, c.largest_offset, c.largest_load_error);
    let mut least = [c.least_level, c.least_level, -drag, -offset, -load_error];
    let mut largest = [c.largest_level, c.largest_level, drag, offset, load_error];
    let mut index = 0;
    while index < ESTIMATES {
        if deviations[index] <= 0.0 {
            (least[index], largest[index]) = (f32::MIN, f32::MAX);
        }
        index += 1;
    }
    (least, largest)
}

const fn checked_noise(
    noise: f32,
    deviations: &[f32; ESTIMATES],
    regressors: &[f32; ESTIMATES],
) -> Result<f32, Error> {
    let mut least: f32 = 1e-6;
    let mut index = 0;
    while index < ESTIMATES {
        least = least.max(deviations[index] * regressors[index] / LARGEST_REGRESSOR);
        index += 1;
    }
    in_range("noise", noise, least, 1e3)
}

const fn over(mut values: [f32; ESTIMATES], divisor: f32) -> [f32; ESTIMATES] {
    let mut index = 0;
    while index < ESTIMATES {
        values[index] /= divisor;
        index += 1;
    }
    values
}

const fn fifth_power_less_one(x: f32) -> f32 {
    x * (5.0 + x * (10.0 + x * (10.0 + x * (5.0 + x))))
}

const ABOVE: usize = ESTIMATES * (ESTIMATES - 1) / 2;

impl Fingerprinted for AdaptationConstants {
    /// Not filter, gate, bounds and thresholds, which may change from one ignition to the next.
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(ABOVE as u32);
        fingerprint.number(self.per_noise);
        fingerprint.numbers(&self.deviations);
        fingerprint.numbers(&[self.growth, self.prior]);
    }
}

#[cfg(test)]
mod tests {
    use super::fifth_power_less_one;

    #[test]
    fn a_fifth_power() {
        assert_eq!(fifth_power_less_one(0.5), 1.5_f32.powi(5) - 1.0);
        assert_eq!(fifth_power_less_one(-1.0), -1.0);
    }
}
