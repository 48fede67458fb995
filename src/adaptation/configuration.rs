//! What the engineer sets for an adaptation.

use crate::error::Range;

/// Ticks in which data lose their weight. With 1e5 of them a variance grows by 9e-5 from one upkeep to the next, and the rounding of
/// the growth is a thousandth of that; with 1e6 it would be a hundredth.
const FORGETTING_TICKS: Range = Range::new(200.0, 1e5);

/// Ticks of the slow average's time constant. With 1e7 of them rounding stops an average of 0.1 within 8e-4 of the level that it
/// follows; with 1e8 within 8e-3.
const AVERAGE_TICKS: Range = Range::new(400.0, 1e7);

/// Times to forget, s, that a tick, s, allows.
pub(super) const fn forgetting_times(tick: f32) -> Range {
    times(FORGETTING_TICKS, tick)
}

/// Time constants of the slow average, s, that a tick, s, allows.
pub(super) const fn average_times(tick: f32) -> Range {
    times(AVERAGE_TICKS, tick)
}

const fn times(ticks: Range, tick: f32) -> Range {
    Range::new(ticks.minimum * tick, ticks.maximum * tick)
}

/// The number of a range that is nearest to `value`.
const fn nearest(value: f32, range: Range) -> f32 {
    if value < range.minimum {
        range.minimum
    } else if value > range.maximum {
        range.maximum
    } else {
        value
    }
}

/// What the engineer sets for an adaptation; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationConfiguration {
    /// Time between two updates, s, 1e-5 to 1. 1 ms to 10 ms are enough: levels change in minutes.
    pub tick: f32,
    /// Time in which data lose their weight, s, 200 to 1e5 ticks; only ticks that count run. Short follows fast, long is quiet.
    pub forgetting_time: f32,
    /// Time constant of the filter, s, 0 to 1: about that of the speed's own filter. 0 for no filter.
    pub filter_time: f32,
    /// Noise of the observed torque after the filter, one standard deviation, N m, 1e-6 to 1e3. At least one 100,000th of what
    /// the deviations below make of the limits.
    pub noise: f32,
    /// How far a level may be from 1, one standard deviation, 0 to 10. 0 holds both levels.
    pub level_deviation: f32,
    /// Least level, 0.1 to 1.
    pub least_level: f32,
    /// Largest level, 1 to 10.
    pub largest_level: f32,
    /// How large the drag may be, one standard deviation, N m s/rad, 0 to 1e3. 0 leaves it out.
    pub drag_deviation: f32,
    /// Largest drag of either sign, N m s/rad, 0 to 1e4; below 0 the model has too much of its own.
    pub largest_drag: f32,
    /// How large the offset may be, one standard deviation, N m, 0 to 1e3. 0 leaves it out. An offset and two levels that differ look the same
    /// under a load that does not change: what the motion does not tell is shared by the deviations.
    pub offset_deviation: f32,
    /// Largest offset of either sign, N m, 0 to 1e4.
    pub largest_offset: f32,
    /// How wrong the load torque may be, one standard deviation, 0 to 1. 0 leaves it out, as where no load was taken off.
    pub load_deviation: f32,
    /// Largest relative error of the load torque, of either sign, 0 to 1.
    pub largest_load_error: f32,
    /// Largest torque that is believed, N m, 1e-6 to 1e6: observed, of the model, and of the load.
    pub largest_torque: f32,
    /// Largest nut speed, rad/s, 1e-3 to 1e6.
    pub largest_speed: f32,
    /// Nut speed below which a tick does not count, rad/s, 0 to `largest_speed`.
    pub least_speed: f32,
    /// Friction torque of the model below which a tick does not count, N m, 0 to `largest_torque`: beside less than the noise nothing is to be learnt.
    pub least_friction: f32,
    /// Slow drift of the level.
    pub health: HealthConfiguration,
}

/// When a drift of the level is flagged; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HealthConfiguration {
    /// Time constant of the slow average, s, 400 to 1e7 ticks; only ticks that count run.
    pub average_time: f32,
    /// Relative fall of the level, against its commissioning, from which wear or lost preload is flagged: 0.01 to 0.9.
    pub fall: f32,
    /// Relative rise from which lost lubricant is flagged: 0.01 to 9.
    pub rise: f32,
    /// How far the drift has to go back before a flag is taken away, 0 to the smaller of the two above.
    pub hysteresis: f32,
}

impl HealthConfiguration {
    /// Ten minutes of sliding; flagged at a fall by 30 % or a rise by 50 %, until it has gone back by 10 %. Assumed: a two-fold
    /// change of the coefficient is usual between 20 degrees below and 80 above zero, of which a law of the coefficient leaves
    /// some 10 %.
    pub const DEFAULT: Self = Self {
        average_time: 600.0,
        fall: 0.3,
        rise: 0.5,
        hysteresis: 0.1,
    };
}

impl AdaptationConfiguration {
    /// For a steering gear with some 10 to 100 mN m of friction at the nut, updated every `tick`: levels and the load's gain, with
    /// no drag and no offset. Valid for every tick of 1e-5 to 1 s: 5 s to forget, but at least 200 ticks (from 25 ms on) and at most
    /// 1e5 (below 50 us); ten minutes of slow average, but at most 1e7 ticks (below 60 us).
    ///
    /// All numbers are assumed, and tried on a simulated drive of a minute; none comes from a measurement.
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
