//! A tick of a train: each ball is taken in once, from the front backwards, then all are joined, settled and moved.

use super::pool::{Pressing, settle};
use super::press::{FreeBall, InputCheck};
use super::track::{LARGEST_TRAVEL, OVERLAP, Track, Train, UNITS};

/// Nominal travel, in units, below which it counts as none: its inverse times a gap of the whole track, 2^32 units, is finite.
const NO_TRAVEL: f32 = 1e-20;

/// A position keeps sixteenths of a unit: slow balls move by less than a unit in a tick.
const SIXTEENTHS: f32 = 16.0;
const SIXTEENTH_BITS: u32 = 4;

/// Neighbours of a ball in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbours {
    /// Actual speed of the ball.
    pub speed: f32,
    /// Sum of the forces of the ball behind and of the one ahead.
    pub forces: f32,
    /// Sum of those parts of them that rub.
    pub rubbing: f32,
}

impl<const N: usize> Train<N> {
    /// Moves the train by one tick.
    ///
    /// `travel`, m: nominal travel of a ball in this tick, signed along the track. `free[j]`: the speed of ball `j` on its own less the nominal
    /// one, over the size of the nominal one, signed along the track; `impedance[j]`: the force that takes all of the nominal speed from it, N.
    ///
    /// Without travel the forces are those with which motion sets in. A travel that is NaN counts as zero, one beyond
    /// [`LARGEST_TRAVEL`](super::LARGEST_TRAVEL) of the track as that. Where [`Press::solve`](super::Press::solve), whose answer is returned,
    /// refuses the numbers, all balls move with the nominal speed and press on none.
    pub fn step(&mut self, free: &[f32], impedance: &[f32], travel: f32) -> bool {
        let balls = self.balls();
        let mut check = InputCheck::of(free.len() == balls && impedance.len() == balls);
        self.take_in(travel, |index, _| {
            let (Some(&speed), Some(&impedance)) = (free.get(index), impedance.get(index)) else {
                return FreeBall::smooth(0.0, 1.0);
            };
            check.add(speed, impedance);
            FreeBall::smooth(speed, impedance)
        });
        self.press(travel, check.passed(), |_, _| ());
        check.passed()
    }

    /// Takes in each ball, from the last one backwards, by its free motion at its index and position, which is not checked.
    #[inline(always)]
    pub(crate) fn take_in(&mut self, travel: f32, mut free: impl FnMut(usize, u32) -> FreeBall) {
        let mut slacks = Slacks::new(self.track, travel);
        let balls = self.press.balls_mut();
        for (index, ball) in balls.iter_mut().enumerate().rev() {
            let free = free(index, ball.position);
            ball.take_in(free, slacks.next(ball.position, free.speed));
        }
        if let Some(last) = balls.last_mut() {
            last.slack = slacks.next(last.position, last.speed);
        }
    }

    /// Sets how far balls rub, by the part of its load that each carries at a position, 0 to 1: a contact as far as the lesser of its two.
    #[inline(never)]
    pub(crate) fn rub_in_part(&mut self, part: impl Fn(u32) -> f32) {
        let balls = self.press.balls_mut();
        let mut behind = balls.last().map_or(0.0, |last| part(last.position));
        for ball in balls {
            let own = part(ball.position);
            ball.set_rubs(if own < behind { own } else { behind });
            behind = own;
        }
    }

    /// Presses balls that rub, without moving them, and takes each in anew by `refined` of its index and its neighbours, or as before.
    #[inline(always)]
    pub(crate) fn refine(
        &mut self,
        travel: f32,
        mut refined: impl FnMut(usize, &Neighbours) -> Option<FreeBall>,
    ) {
        let mut slacks = Slacks::new(self.track, travel);
        self.press.join(true);
        let foremost = self.press.foremost();
        let balls = self.press.balls_mut();
        settle(balls, foremost, |index, ball, settled| {
            let free = refined(index, &settled.neighbours).unwrap_or_else(|| ball.free());
            ball.take_in(free, slacks.next(ball.position, free.speed));
        });
        if let Some(ball) = balls.get_mut(foremost) {
            ball.slack = slacks.next(ball.position, ball.speed);
        }
    }

    /// Presses and moves all balls, and passes each on with its index and its neighbours; all go at the nominal speed where what was taken in is
    /// not `valid`.
    #[inline(always)]
    pub(crate) fn press(
        &mut self,
        travel: f32,
        valid: bool,
        mut each: impl FnMut(usize, &Neighbours),
    ) -> Pressing {
        self.press.join(valid);
        let travel = self.track.in_units(travel);
        // Sixteenths of a unit by which a ball moves beyond the nominal travel, over its speed.
        let sixteenths_per_speed = travel.abs() * SIXTEENTHS;
        let travel = travel + self.carried;
        // Whole units that the nominal speed moves every ball, signed along the track.
        let nominal = travel as i32;
        self.carried = travel - nominal as f32;
        let (nominal, pitch) = (nominal as u32, self.track.pitch());
        // Nothing is near in front of the foremost one: a quarter of the track from where it goes.
        let mut limit = match self.press.balls().get(self.press.foremost()) {
            Some(ball) => ball.position.wrapping_add(nominal.wrapping_add(1 << 30)),
            None => 0,
        };
        self.press.settle(|index, ball, settled| {
            each(index, &settled.neighbours);
            let place = if settled.touches {
                limit
            } else {
                let sixteenths = (ball.speed * sixteenths_per_speed) as i32;
                let sixteenths = sixteenths.wrapping_add(i32::from(ball.sixteenths));
                ball.sixteenths = (sixteenths & 15) as u8;
                let place = ball.position.wrapping_add(nominal);
                let place = place.wrapping_add_signed(sixteenths >> SIXTEENTH_BITS);
                // Clusters do not run into each other, but rounding may leave that much.
                if limit.wrapping_sub(place) > u32::MAX - OVERLAP {
                    limit
                } else {
                    place
                }
            };
            ball.position = place;
            // Where the ball behind touches this one.
            limit = place.wrapping_sub(pitch);
        })
    }
}

impl Track {
    /// A travel, m, in units: at most [`LARGEST_TRAVEL`] of the track in size, and zero where it is NaN.
    #[inline]
    fn in_units(&self, travel: f32) -> f32 {
        let travel = travel * self.units_per_metre;
        let largest = LARGEST_TRAVEL * UNITS;
        if travel > largest {
            largest
        } else if travel < -largest {
            -largest
        } else if travel.is_nan() {
            0.0
        } else {
            travel
        }
    }
}

/// Slacks of balls that come one after the other, each behind the one before it: the room in front of a ball, the gap over the nominal travel (0
/// where rounding lets two balls overlap), and the free speed of the one ahead less its own.
#[derive(Clone, Copy)]
struct Slacks {
    track: Track,
    /// 1 / nominal travel in this tick, 1/units.
    per_unit: f32,
    /// Position and free speed of the ball ahead.
    ahead: (u32, f32),
}

impl Slacks {
    /// In a tick with a nominal travel, m. The first ball comes once more at the end, when the one ahead of it is known.
    #[inline(always)]
    fn new(track: Track, travel: f32) -> Self {
        let distance = track.in_units(travel).abs();
        Self {
            track,
            per_unit: if distance > NO_TRAVEL {
                1.0 / distance
            } else {
                1.0 / NO_TRAVEL
            },
            ahead: (0, 0.0),
        }
    }

    #[inline(always)]
    fn next(&mut self, position: u32, speed: f32) -> f32 {
        let (ahead, speed_ahead) = self.ahead;
        let gap = self.track.gap(position, ahead);
        let gap = if gap > u32::MAX - OVERLAP { 0 } else { gap };
        self.ahead = (position, speed);
        gap as f32 * self.per_unit + (speed_ahead - speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn train() -> Train<5> {
        Train::new(1.0, 0.01, &[0.0; 5]).unwrap()
    }

    const FREE: [f32; 5] = [0.02, 0.01, 0.0, 0.0, -0.01];

    /// `step` with two lists is a tick with the same numbers, and the sums are those of the forces.
    #[test]
    fn each_ball_comes_once_from_the_front_backwards() {
        let (mut listed, mut asked) = (train(), train());
        for travel in [1e-4, 0.0, -2e-4] {
            assert!(listed.step(&FREE, &[1e3; 5], travel));
            let positions: [u32; 5] = core::array::from_fn(|j| asked.positions().nth(j).unwrap());
            let mut count = 0;
            asked.take_in(travel, |index, position| {
                count += 1;
                assert_eq!((index, position), (5 - count, positions[5 - count]));
                FreeBall::smooth(FREE[index], 1e3)
            });
            let mut both = 0.0;
            let pressing = asked.press(travel, true, |_, neighbours| both += neighbours.forces);
            assert_eq!(count, 5);
            assert_eq!(listed, asked);
            let forces = || asked.forces().filter(|&force| force > 0.0);
            assert_eq!(usize::from(pressing.contacts), forces().count());
            assert_eq!(pressing.largest, forces().fold(0.0, f32::max));
            assert!((both - 2.0 * forces().sum::<f32>()).abs() <= 1e-5 * pressing.largest);
        }
    }
}
