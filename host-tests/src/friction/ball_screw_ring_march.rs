//! A ring of balls from instant to instant.
//!
//! Between two instants every ball moves with the speed of the last one, and with the change that this speed had before it: second order in
//! the step. Where two balls meet, where a force that falls ends, or where a ball crosses the border of the loaded part, the step is split.

use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{Drive, PlacedBall};
use super::ball_screw_ring::{ElasticRing, RingBall, RingSample, RingState, RingTrack};
use super::ball_screw_ring_order::Neighbours;
use super::ball_screw_ring_rates::{Last, Rates};
use super::ball_screw_ring_solve::{Instant, Seat, Settled};
use super::ball_screw_rubbing::BallContact;
use super::ball_screw_settle::settle;
use crate::error::{ReferenceError, within};

/// Gap at which balls touch, rad.
const TOUCHING: f64 = 1e-12;
/// Load below which a ball without preload carries none, N. A preloaded ball is given as much.
const NO_LOAD: f64 = 1e-6;
/// Part of its load below which a ball on the run-in counts as one of the return.
const LEAST_PART: f64 = 1e-3;
/// Part of a step below which it is not split for a force that ends.
const SHORT: f64 = 1e-3;
/// Forces that end by which a step is split at most.
const ENDINGS: usize = 4;
/// How far beyond the border of the loaded part a ball is put, rad.
const BEYOND: f64 = 1e-9;

/// Where a step is split.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// The balls of a pair meet.
    Meeting(usize),
    /// The force of a pair ends.
    Ending,
    /// A ball comes under load, or out of it.
    Border,
}

struct March<'a> {
    ring: &'a ElasticRing,
    track: RingTrack,
    /// Azimuth of the first ball from the start of the track, rad.
    first: f64,
    /// Gaps ahead of the balls in the order of the track, rad.
    gaps: Vec<f64>,
    nut_angle: f64,
    last: Option<Last>,
    rates: Rates,
    speeds: Vec<f64>,
    events: usize,
    /// Speed of a nominal ball, with the direction and the load that it belongs to.
    idle: Option<(f64, f64, f64)>,
}

impl ElasticRing {
    /// Follows the balls through the samples: a state for each. `progress` is told how many of how many are done.
    ///
    /// A state is solved from the one before; from nothing at the start, where the nut or the load turns, and where that does not lead
    /// to a balance. A sample at rest has no friction, and says so.
    pub fn simulate(
        &self,
        samples: &[RingSample],
        mut progress: impl FnMut(usize, usize),
    ) -> Result<Vec<RingState>, ReferenceError> {
        let track = self.checked()?;
        check_samples(samples)?;
        let mut march = March::new(self, track);
        let mut states = Vec::with_capacity(samples.len());
        for (at, sample) in samples.iter().enumerate() {
            states.push(march.state(sample));
            if let Some(next) = samples.get(at + 1) {
                march.advance(sample, next);
            }
            progress(at + 1, samples.len());
        }
        Ok(states)
    }
}

fn check_samples(samples: &[RingSample]) -> Result<(), ReferenceError> {
    if samples.is_empty() {
        return Err(ReferenceError::input("samples", "are none"));
    }
    let mut before = f64::NEG_INFINITY;
    for sample in samples {
        within("time", sample.time, -1e9, 1e9)?;
        within("nut_speed", sample.nut_speed, -1e6, 1e6)?;
        within("axial_load", sample.axial_load, -1e7, 1e7)?;
        if sample.time < before {
            return Err(ReferenceError::input("samples", "go back in time"));
        }
        before = sample.time;
    }
    Ok(())
}

impl<'a> March<'a> {
    fn new(ring: &'a ElasticRing, track: RingTrack) -> Self {
        let n = ring.balls;
        let gaps = if ring.places.is_empty() {
            vec![(track.length / n as f64 - track.pitch).max(0.0); n]
        } else {
            let first = ring.places[0] + track.length;
            let ahead = ring.places.iter().skip(1).chain(std::iter::once(&first));
            ring.places
                .iter()
                .zip(ahead)
                .map(|(place, next)| (next - place - track.pitch).max(0.0))
                .collect()
        };
        Self {
            ring,
            track,
            first: ring.places.first().copied().unwrap_or(0.0),
            gaps,
            nut_angle: 0.0,
            last: None,
            rates: Rates::none(n),
            speeds: vec![0.5; n],
            events: 0,
            idle: None,
        }
    }

    fn state(&mut self, sample: &RingSample) -> RingState {
        let events = std::mem::take(&mut self.events);
        let failure = if sample.nut_speed == 0.0 {
            Some(ReferenceError::Standstill)
        } else {
            let direction = sample.nut_speed.signum();
            self.solve(direction, sample.axial_load).err()
        };
        self.result(sample, events, failure).checked()
    }

    fn advance(&mut self, sample: &RingSample, next: &RingSample) {
        let whole = sample.nut_speed.abs() * (next.time - sample.time);
        let direction = sample.nut_speed.signum();
        let same = sample.axial_load * next.axial_load > 0.0;
        let rise = if same && whole > 0.0 {
            (next.axial_load - sample.axial_load) / whole
        } else {
            0.0
        };
        let mut done = 0.0;
        let mut endings = 0;
        for _ in 0..8 * self.ring.balls + 64 {
            let left = whole - done;
            if left <= 0.0 {
                return;
            }
            let Some((travel, event)) =
                self.next_event(direction, left, SHORT * whole, endings < ENDINGS)
            else {
                self.go(direction, left);
                return;
            };
            self.go(direction, travel);
            done += travel;
            self.events += 1;
            match event {
                Event::Meeting(pair) => self.gaps[pair] = 0.0,
                Event::Ending => endings += 1,
                Event::Border => {}
            }
            // Without a solution the balls go on as they were, and the next state says what is wrong.
            let _ = self.solve(direction, sample.axial_load + rise * done);
        }
        self.go(direction, whole - done);
    }

    fn next_event(
        &self,
        direction: f64,
        left: f64,
        short: f64,
        endings: bool,
    ) -> Option<(f64, Event)> {
        let n = self.gaps.len();
        let mut found: Option<(f64, Event)> = None;
        let mut take = |travel: f64, event: Event| {
            if travel < left && found.is_none_or(|(first, _)| travel < first) {
                found = Some((travel, event));
            }
        };
        let pressing = |pair: usize| {
            self.last
                .as_ref()
                .map_or(0.0, |last| last.settled.forces[pair])
        };
        for pair in 0..n {
            let force = pressing(pair);
            if force > 0.0 {
                let rate = self.rates.forces[pair];
                let travelled = self.last.as_ref().map_or(0.0, |last| last.travel);
                if endings && rate < 0.0 {
                    take((-force / rate - travelled).max(short), Event::Ending);
                }
                continue;
            }
            let next = (pair + 1) % n;
            let closing = direction * (self.speeds[pair] - self.speeds[next]);
            let faster = direction * (self.rates.speeds[pair] - self.rates.speeds[next]);
            if let Some(travel) = closes(self.gaps[pair], closing, faster) {
                take(travel.max(short * SHORT), Event::Meeting(pair));
            }
        }
        if self.ring.return_length > 0.0 {
            for (ball, place) in self.places().iter().enumerate() {
                let speed = direction * (self.speeds[ball] - 1.0);
                let faster = direction * self.rates.speeds[ball];
                let half = (0.5 - LEAST_PART) * self.track.run_in;
                for border in [-half, self.track.loaded + half] {
                    let ahead = (border - place) * speed.signum();
                    let ahead = ahead.rem_euclid(self.track.length);
                    let rate = faster * speed.signum();
                    if let Some(travel) = closes(ahead + BEYOND, speed.abs(), rate) {
                        take(travel, Event::Border);
                    }
                }
            }
        }
        found
    }

    fn go(&mut self, direction: f64, travel: f64) {
        let n = self.gaps.len();
        // Speeds of now: the solution may be a while ago where a state had none.
        let moved: Vec<f64> = (0..n)
            .map(|j| direction * travel * (self.speeds[j] + 0.5 * travel * self.rates.speeds[j]))
            .collect();
        self.first = (self.first + moved[0] - direction * travel).rem_euclid(self.track.length);
        for pair in 0..n {
            let gap = self.gaps[pair] + moved[(pair + 1) % n] - moved[pair];
            self.gaps[pair] = gap.max(0.0);
        }
        let slack = self.track.length - n as f64 * self.track.pitch;
        let excess = self.gaps.iter().sum::<f64>() - slack.max(0.0);
        if let Some(largest) = self.gaps.iter_mut().max_by(|a, b| a.total_cmp(b)) {
            *largest = (*largest - excess).max(0.0);
        }
        for (speed, rate) in self.speeds.iter_mut().zip(&self.rates.speeds) {
            *speed += rate * travel;
        }
        self.nut_angle += direction * travel;
        if let Some(last) = &mut self.last {
            last.travel += travel;
        }
    }

    fn places(&self) -> Vec<f64> {
        let mut place = self.first;
        let mut places = Vec::with_capacity(self.gaps.len());
        for gap in &self.gaps {
            places.push(place.rem_euclid(self.track.length));
            place += self.track.pitch + gap;
        }
        places
    }

    fn share(&self, azimuth: f64) -> f64 {
        let shares = &self.ring.load_shares;
        let Some(last) = shares.len().checked_sub(1) else {
            return 1.0;
        };
        let from_middle = azimuth / self.track.loaded * shares.len() as f64 - 0.5;
        let entry = |at: f64| {
            if self.track.run_in == 0.0 {
                shares[at.rem_euclid(shares.len() as f64) as usize % shares.len()]
            } else {
                shares[at.clamp(0.0, last as f64) as usize]
            }
        };
        let below = from_middle.floor();
        let (first, second) = (entry(below), entry(below + 1.0));
        first + (from_middle - below) * (second - first)
    }

    fn seats(&self, axial_load: f64) -> Vec<Option<Seat>> {
        let azimuths: Vec<f64> = self
            .places()
            .iter()
            .map(|place| self.track.azimuth(*place))
            .collect();
        let parts = azimuths.iter().map(|azimuth| self.track.part(*azimuth));
        let parts: Vec<f64> = parts
            .map(|part| if part < LEAST_PART { 0.0 } else { part })
            .collect();
        let weights: Vec<f64> = azimuths
            .iter()
            .zip(&parts)
            .map(|(azimuth, part)| part * self.share(*azimuth))
            .collect();
        let whole: f64 = weights.iter().sum();
        (0..azimuths.len())
            .map(|ball| {
                if parts[ball] == 0.0 {
                    return None;
                }
                let load = axial_load * weights[ball] / whole.max(f64::MIN_POSITIVE);
                let axial_load = if load.abs() > NO_LOAD {
                    load
                } else if self.ring.clearance < 0.0 {
                    NO_LOAD.copysign(load)
                } else {
                    return None;
                };
                let azimuth = azimuths[ball];
                let screw = self.ring.screw_deviation.at(azimuth + self.nut_angle);
                let nut = self.ring.nut_deviation.at(azimuth);
                let grooves = self.track.grooves.turned(screw, nut);
                Some(Seat {
                    grooves: ElasticGrooves {
                        oversize: grooves
                            .oversize
                            .max(0.0)
                            .mul_add(parts[ball].powf(2.0 / 3.0), grooves.oversize.min(0.0)),
                        ..grooves
                    },
                    axial_load,
                    part: parts[ball],
                })
            })
            .collect()
    }

    /// Speed of a ball that carries no load: that of one without deviation under the mean load.
    fn idle_speed(&mut self, direction: f64, axial_load: f64) -> Result<f64, ReferenceError> {
        if let Some((speed, for_direction, for_load)) = self.idle
            && for_direction == direction
            && for_load == axial_load
        {
            return Ok(speed);
        }
        let load = axial_load * self.track.per_ball;
        let ball = PlacedBall::alone(
            &self.track.grooves,
            self.ring.friction,
            direction,
            if load.abs() > NO_LOAD { load } else { 1.0 },
            self.ring.integration,
        );
        let speed = settle(&ball, Drive::Force(0.0), None)?.state.motion[0];
        self.idle = Some((speed, direction, axial_load));
        Ok(speed)
    }

    fn solve(&mut self, direction: f64, axial_load: f64) -> Result<(), ReferenceError> {
        let seats = self.seats(axial_load);
        let idle_speed = if seats.iter().all(Option::is_some) {
            0.5
        } else {
            self.idle_speed(direction, axial_load)?
        };
        let n = seats.len();
        let touching: Vec<bool> = self.gaps.iter().map(|gap| *gap <= TOUCHING).collect();
        let track = (&self.ring.design).into();
        let instant = Instant {
            seats: &seats,
            touching: &touching,
            friction: self.ring.friction,
            neighbours: Neighbours {
                balls: n,
                direction,
            },
            between: BallContact::new(&track, self.ring.ball_friction, direction, self.ring.chord),
            integration: self.ring.integration,
            idle_speed,
        };
        let follows = self
            .last
            .as_ref()
            .filter(|last| last.direction == direction && last.axial_load * axial_load > 0.0);
        let (states, forces) = match follows {
            Some(last) => last.expected(&self.rates),
            None => (vec![None; n], vec![0.0; n]),
        };
        let found = instant.settle(&states, &forces);
        match found {
            Ok(settled) => {
                self.speeds.clone_from(&settled.speeds);
                let load = |seat: &Option<Seat>| seat.as_ref().map_or(0.0, |seat| seat.axial_load);
                let now = Last {
                    settled,
                    direction,
                    axial_load,
                    loads: seats.iter().map(load).collect(),
                    travel: 0.0,
                };
                self.rates = self
                    .last
                    .as_ref()
                    .map_or_else(|| Rates::none(n), |last| last.rates(&now, &self.rates));
                self.last = Some(now);
                Ok(())
            }
            Err(error) => {
                self.rates = Rates::none(n);
                let (speeds, forces) = match &mut self.last {
                    Some(last) if last.direction == direction => {
                        instant.pool(&last.settled.unforced, &last.settled.compliance)
                    }
                    _ => instant.pool(&self.speeds, &vec![1.0; n]),
                };
                self.speeds = speeds;
                if let Some(last) = &mut self.last {
                    last.settled.forces = forces;
                }
                Err(error)
            }
        }
    }

    fn result(
        &self,
        sample: &RingSample,
        events: usize,
        failure: Option<ReferenceError>,
    ) -> RingState {
        let direction = sample.nut_speed.signum();
        let settled = match (&self.last, &failure) {
            (Some(last), None) => Some(&last.settled),
            _ => None,
        };
        let seats = self.seats(sample.axial_load);
        let track = (&self.ring.design).into();
        let between = BallContact::new(&track, self.ring.ball_friction, direction, self.ring.chord);
        let balls = self
            .places()
            .iter()
            .enumerate()
            .map(|(ball, place)| RingBall {
                place: *place,
                gap: self.gaps[ball],
                axial_load: seats[ball].map_or(0.0, |seat| seat.axial_load),
                speed: settled.map_or(f64::NAN, |s| s.speeds[ball] * sample.nut_speed),
                force: settled.map_or(f64::NAN, |s| between.normal_force(s.forces[ball])),
                loads: match (settled.map(|s| s.states[ball]), &seats[ball]) {
                    (Some(Some(state)), Some(seat)) => seat
                        .grooves
                        .contacts_at([state.place.x, state.place.y], state.place.z)
                        .map(|contact| contact.load),
                    (Some(_), _) => [0.0; 4],
                    (None, _) => [f64::NAN; 4],
                },
            })
            .collect::<Vec<_>>();
        let of = |value: fn(&Settled) -> f64| settled.map_or(f64::NAN, value);
        let arm = direction * self.ring.design.ball_radius;
        RingState {
            time: sample.time,
            nut_angle: self.nut_angle,
            groove_torque: arm * of(|s| s.power.grooves),
            ball_torque: arm * of(|s| s.power.balls),
            residual: of(|s| s.residual),
            power_error: of(|s| s.power.error()),
            complementarity: settled.map_or(f64::NAN, |s| self.violation(s, direction, &balls)),
            balls,
            events,
            failure,
        }
    }

    fn violation(&self, settled: &Settled, direction: f64, balls: &[RingBall]) -> f64 {
        let n = balls.len();
        let largest = balls
            .iter()
            .flat_map(|ball| ball.loads)
            .fold(f64::MIN_POSITIVE, f64::max);
        let mut worst = 0.0_f64;
        for (pair, gap) in self.gaps.iter().enumerate() {
            let force = settled.forces[pair] / largest;
            let parting = direction * (settled.speeds[(pair + 1) % n] - settled.speeds[pair]);
            let touching = *gap <= TOUCHING;
            worst = worst.max(-force);
            worst = worst.max(if touching { -parting } else { force });
            worst = worst.max(force.min(parting));
        }
        worst
    }
}

/// Travel in which a gap closes at a speed that grows in proportion to the travel.
fn closes(gap: f64, closing: f64, faster: f64) -> Option<f64> {
    // gap - closing s - faster s^2/2 = 0, in the form that does not cancel.
    let root = (closing * closing + 2.0 * faster * gap).sqrt();
    let travel = if gap <= 0.0 {
        -2.0 * closing / faster
    } else {
        2.0 * gap / (closing + root)
    };
    (travel > 0.0 && travel.is_finite()).then_some(travel)
}

#[cfg(test)]
mod tests {
    use super::closes;

    #[test]
    fn a_gap_closes_where_its_distance_ends() {
        for (gap, closing, faster) in [(0.3, 0.2, 0.1), (0.3, 0.5, -0.1), (0.3, -0.2, 0.4)] {
            let s = closes(gap, closing, faster).unwrap();
            assert!((gap - closing * s - 0.5 * faster * s * s).abs() < 1e-15);
        }
        assert_eq!(closes(0.3, -0.2, 0.0), None);
        assert_eq!(closes(0.3, 0.1, -0.5), None);
        assert_eq!(closes(0.0, -0.1, 0.2), Some(1.0));
        assert_eq!(closes(0.0, -0.1, -0.2), None);
        assert_eq!(closes(0.0, 0.0, 0.0), None);
    }
}
