//! Laws of friction over a motion, each with unit friction at its highest level: what one linear parameter multiplies.

pub mod cost;

use epas_friction::Error;
use epas_friction::law::memory::{MemoryState, Part, ProportionalElements, SLIP_8};
use epas_friction::law::{Elements, SlidingLimits};

use crate::bristle::{bristle, stribeck};
use crate::estimator::stretches::of_position;
use crate::fit::problem::Parameter;
use crate::mechanism::Step;
use crate::trace::channels::range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Not at all (Coulomb).
    Constant,
    /// `1 + (share at rest - 1) exp(-(v/v_s)^2)` (Stribeck).
    Stribeck,
    /// The crate's coefficient law: `1 + (share at rest - 1)/(1 + |v|/v_m)`.
    LoadShare,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// At once: where a motion is known, at its turning points; where it comes sample by sample, a bristle as short as a step of the
    /// sensor.
    AtOnce,
    /// By the speed: `v/sqrt(v^2 + v_r^2)`, as in the crate's scenes without memory.
    Speed,
    Dahl,
    /// LuGre: Dahl's bristles that follow the level, with a damping of their own.
    LuGre,
    Elements,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Law {
    pub name: &'static str,
    pub level: Level,
    pub passage: Passage,
    pub cost: Cost,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Sum of what was counted of these functions of the firmware.
    Counted(&'static [&'static str]),
    /// Modelled cycles of its operations, counted by hand.
    Estimated(u32),
}

/// What a motion is like: from it first guesses and bounds follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Largest speed, rad/s or m/s.
    pub speed: f64,
    /// Distance of the farthest places, rad or m.
    pub travel: f64,
    /// Step of the position's sensor, rad or m.
    pub resolution: f64,
    pub tick: f64,
}

const SHARE_AT_REST: &str = "friction_share_at_rest";
/// Speed at which half of the difference is gone, or Stribeck's.
const HALF_SHARE_SPEED: &str = "half_share_speed";
pub const BREAKAWAY: &str = "breakaway";
const REVERSAL_SPEED: &str = "reversal_speed";
/// Damping of a bristle over its stiffness, s.
const BRISTLE_TIME: &str = "bristle_time";

const ELEMENTS: usize = 8;

impl Law {
    /// Parameters that do not enter linearly, for a motion of such a size; rad or m as `units` says.
    pub fn parameters(&self, scales: &Scales, units: [&'static str; 2]) -> Vec<Parameter> {
        let [length, speed] = units;
        let shortest = scales.shortest();
        let speeds = |name, start: f64| {
            let bounds = [1e-3, 2.0].map(|part| part * scales.speed);
            Parameter::positive(name, speed, start * scales.speed, bounds)
        };
        let mut parameters = Vec::new();
        if self.level != Level::Constant {
            // It starts near a law without: from a share below 1 the best level of a screw under grease would be none.
            parameters.push(Parameter::positive(SHARE_AT_REST, "", 1.1, [0.1, 3.0]));
            parameters.push(speeds(HALF_SHARE_SPEED, 0.1));
        }
        match self.passage {
            Passage::AtOnce => {}
            Passage::Speed => parameters.push(speeds(REVERSAL_SPEED, 0.01)),
            Passage::Dahl | Passage::LuGre | Passage::Elements => {
                // A motion of some hundred steps of the sensor may be all before sliding.
                let start = (20.0 * shortest).min((1e-3 * scales.travel).max(3.0 * shortest));
                let bounds = [shortest, (0.1 * scales.travel).max(100.0 * shortest)];
                parameters.push(Parameter::positive(BREAKAWAY, length, start, bounds));
            }
        }
        if self.passage == Passage::LuGre {
            let [start, low, high] = [0.1, 1e-3, 100.0].map(|ticks| ticks * scales.tick);
            parameters.push(Parameter::positive(BRISTLE_TIME, "s", start, [low, high]));
        }
        parameters
    }

    pub fn friction(&self, scales: &Scales, values: &[f64]) -> Result<Friction, Error> {
        let mut values = values.iter().copied();
        let mut next = |has: bool, without: f64| {
            let value = if has { values.next() } else { Some(without) };
            value.unwrap_or(f64::NAN)
        };
        let has_level = self.level != Level::Constant;
        let has_breakaway = !matches!(self.passage, Passage::AtOnce | Passage::Speed);
        let whole = Part {
            backbone: &SLIP_8.elements,
            share: 1.0,
            breakaway_angle: 1.0,
        };
        Ok(Friction {
            law: *self,
            at_rest: next(has_level, 1.0),
            half_share_speed: next(has_level, 1.0),
            reversal_speed: next(self.passage == Passage::Speed, 0.0),
            breakaway: next(has_breakaway, scales.shortest()),
            bristle_time: next(self.passage == Passage::LuGre, 0.0),
            shortest_time: 0.1 * scales.tick,
            held: 0.0,
            elements: ProportionalElements::new(1.0, &[whole])?,
            state: ProportionalElements::<ELEMENTS>::VIRGIN,
        })
    }
}

impl Scales {
    pub fn of((position, speed): (&[f64], &[f64]), resolution: f64, tick: f64) -> Self {
        let ((low, high), (slow, fast)) = (range(position), range(speed));
        Self {
            speed: fast.max(-slow).max(f64::MIN_POSITIVE),
            travel: (high - low).max(f64::MIN_POSITIVE),
            resolution,
            tick,
        }
    }

    fn shortest(&self) -> f64 {
        (2.0 * self.resolution).max(1e-7 * self.travel)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    law: Law,
    at_rest: f64,
    half_share_speed: f64,
    reversal_speed: f64,
    breakaway: f64,
    bristle_time: f64,
    /// Time over which a bristle's speed is told, s: after a turn just before a sample there would be none.
    shortest_time: f64,
    held: f64,
    elements: ProportionalElements<ELEMENTS>,
    state: MemoryState<ELEMENTS>,
}

impl Friction {
    /// Friction at every sample of a motion, over its highest level.
    ///
    /// Where a motion turns round between two samples it goes to the turning point first, and comes back from there: the way from
    /// sample to sample alone would let friction turn round half a sample late. Friction that is late pushes where the acceleration
    /// is largest, and counts as inertia (1.5 % of it in a drive with half of its effort in friction, sampled at 500 Hz).
    pub fn along(mut self, position: &[f64], speed: &[f64], tick: f64) -> Vec<f64> {
        if self.law.passage == Passage::AtOnce {
            let directions = directions(position, self.breakaway);
            let levels = speed.iter().map(|speed| self.level(*speed));
            return directions
                .iter()
                .zip(levels)
                .map(|(direction, level)| direction * level)
                .collect();
        }
        let mut before = None;
        let samples = position.iter().zip(speed);
        samples
            .map(|(&position, &speed)| {
                let (start, start_speed) = before
                    .replace((position, speed))
                    .unwrap_or((position, speed));
                let whole = Step {
                    position: start,
                    speed: start_speed,
                    turn: position - start,
                    end_speed: speed,
                    time: tick,
                };
                match whole.halves() {
                    Some((there, back)) => {
                        self.follow(&there);
                        // A bristle's damping is that of its mean rate over the tick: the way back may be as short as one likes.
                        self.follow(&Step { time: tick, ..back })
                    }
                    None => self.follow(&whole),
                }
            })
            .collect()
    }

    fn level(&self, speed: f64) -> f64 {
        match self.law.level {
            Level::Constant => 1.0,
            Level::Stribeck => stribeck(speed, [self.at_rest, 1.0], self.half_share_speed),
            Level::LoadShare => {
                1.0 + (self.at_rest - 1.0) / (1.0 + speed.abs() / self.half_share_speed)
            }
        }
    }

    /// Friction after a step, over its highest level, and remembered. The level is that of the speed at the step's start.
    pub fn follow(&mut self, step: &Step) -> f64 {
        let level = self.level(step.speed);
        let turn = step.turn / self.breakaway;
        match self.law.passage {
            Passage::Speed => {
                let speed = step.end_speed;
                level * speed / speed.hypot(self.reversal_speed)
            }
            Passage::AtOnce | Passage::Dahl | Passage::LuGre => {
                let before = self.held;
                self.held = bristle(before, turn, level);
                let time = step.time.max(self.shortest_time);
                self.held + self.bristle_time * (self.held - before) / time
            }
            Passage::Elements => {
                let limits = SlidingLimits {
                    forward: level as f32,
                    backward: level as f32,
                    load: 1.0,
                };
                let friction = self.elements.follow(&mut self.state, turn as f32, &limits);
                friction.into()
            }
        }
    }
}

/// Direction at every sample, 1 or -1: it changes at the outermost place. What comes back by less than `dead` is no turn; 0 where nothing
/// moves that far.
fn directions(position: &[f64], dead: f64) -> Vec<f64> {
    let mut directions = vec![0.0; position.len()];
    let stretches = of_position(position, dead, position.len());
    let mut begin = 0;
    for (k, stretch) in stretches.iter().enumerate() {
        let next = stretches.get(k + 1);
        let between = stretch.last..next.map_or(position.len(), |next| next.first);
        let far = |sample: &usize| stretch.direction * position[*sample];
        let turn = between.max_by(|one, other| far(one).total_cmp(&far(other)));
        let end = next.and(turn).unwrap_or(position.len());
        directions[begin..end].fill(stretch.direction);
        begin = end;
    }
    directions
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Of a sine with rounding the direction is the sine's: no step of the sensor turns it round.
    #[test]
    fn rounding_turns_nothing_round() {
        let time = |sample: usize| 1e-3 * sample as f64 + 2.5e-4;
        let step = 1e-2;
        let rounded: Vec<f64> = (0..4000)
            .map(|k| ((TAU * time(k)).sin() / step).round() * step)
            .collect();
        let found = directions(&rounded, 2.0 * step).into_iter().enumerate();
        let wrong = found.filter(|(k, direction)| direction * (TAU * time(*k)).cos() <= 0.0);
        // A step lasts for 45 ms at the turn: half of it is the uncertainty of each of eight turns.
        assert!(wrong.count() <= 8 * 23);
        assert_eq!(directions(&[0.0, 0.1, 0.0], 0.2), [0.0; 3]);
        assert!(directions(&[], 0.2).is_empty());
    }

    /// However late in a tick a motion turns round, the damping of LuGre is at most that of two levels in a tick.
    #[test]
    fn a_late_turn_is_no_spike() {
        let scales = Scales {
            speed: 1.0,
            travel: 1.0,
            resolution: 1e-7,
            tick: 1e-3,
        };
        let law = crate::models::LITERATURE[3];
        let (share, breakaway, time) = (1.0, 2e-7, 0.5 * scales.tick);
        let friction = law
            .friction(&scales, &[share, 0.1, breakaway, time])
            .unwrap();
        let position = [0.0, 1e-3, 1.5e-3, 1.4999e-3];
        let speed = [1.0, 1.0, 1.0, -1e-3];
        let found = friction.along(&position, &speed, scales.tick);
        assert!(
            found.iter().all(|friction| friction.abs() <= 2.0),
            "{found:?}"
        );
    }

    #[test]
    fn a_start_is_within_its_bounds_for_any_way() {
        for steps in [4.0, 20.0, 500.0, 2000.0, 1e4, 1e6] {
            let scales = Scales {
                speed: 1.0,
                travel: steps * 1e-4,
                resolution: 1e-4,
                tick: 1e-3,
            };
            for passage in [Passage::Dahl, Passage::LuGre, Passage::Elements] {
                let law = Law {
                    name: "any",
                    level: Level::Stribeck,
                    passage,
                    cost: Cost::Estimated(1),
                };
                for parameter in law.parameters(&scales, ["rad", "rad/s"]) {
                    let Parameter {
                        low, start, high, ..
                    } = parameter;
                    assert!(
                        0.0 < low && low < start && start < high,
                        "{steps}: {parameter:?}"
                    );
                }
            }
        }
    }
}
