//! A tick of a train: each ball is taken in once, from the front backwards, then all are joined, settled and moved.

use super::ball::{Ball, FreeBall};
use super::positions::Train;
use super::press::InputCheck;
use super::settle::{BallState, Pressing, settle};
use super::track::{Motion, SIXTEENTHS, Slacks};

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
        self.press.join(check.passed());
        self.settle(travel, |_, _, _, _| ());
        check.passed()
    }

    /// Takes in each ball, from the last one backwards, by its free motion at its index and position, which is not checked.
    #[inline(always)]
    pub(crate) fn take_in(&mut self, travel: f32, mut free: impl FnMut(usize, u32) -> FreeBall) {
        let mut slacks = self.slacks(travel);
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
        let mut slacks = self.slacks(travel);
        self.press.join(true);
        let foremost = self.press.foremost();
        let balls = self.press.balls_mut();
        let mut rubs_ahead = 0.0;
        settle(balls, foremost, |index, ball, settled| {
            let neighbours = Neighbours::of(ball, settled, &mut rubs_ahead);
            let free = refined(index, &neighbours).unwrap_or_else(|| ball.free());
            ball.take_in(free, slacks.next(ball.position, free.speed));
        });
        if let Some(ball) = balls.get_mut(foremost) {
            ball.slack = slacks.next(ball.position, ball.speed);
        }
    }

    /// Presses and moves all balls, and passes each on with its index and its neighbours.
    #[inline(always)]
    pub(crate) fn press(
        &mut self,
        travel: f32,
        mut each: impl FnMut(usize, &Neighbours),
    ) -> Pressing {
        self.press.join(true);
        self.settle(travel, |index, ball, settled, rubs_ahead| {
            each(index, &Neighbours::of(ball, settled, rubs_ahead));
        })
    }

    #[inline(always)]
    fn settle(
        &mut self,
        travel: f32,
        mut each: impl FnMut(usize, &Ball, &BallState, &mut f32),
    ) -> Pressing {
        let motion = self.motion(travel);
        let foremost = self.press.foremost();
        // Nothing is near in front of the foremost one.
        let balls = self.press.balls();
        let mut limit = balls.get(foremost).map_or(0, |ball| motion.far_ahead(ball));
        let mut rubs_ahead = 0.0;
        self.press.settle(|index, ball, settled| {
            limit = if settled.touches {
                ball.position = limit;
                motion.touching(limit)
            } else {
                motion.advance(ball, limit)
            };
            each(index, ball, settled, &mut rubs_ahead);
        })
    }

    #[inline(always)]
    fn slacks(&self, travel: f32) -> Slacks {
        Slacks::new(self.track, self.track.in_units(travel))
    }

    #[inline(always)]
    fn motion(&mut self, travel: f32) -> Motion {
        let travel = self.track.in_units(travel);
        let distance = travel.abs();
        let travel = travel + self.carried;
        let nominal = travel as i32;
        self.carried = travel - nominal as f32;
        Motion {
            nominal: nominal as u32,
            sixteenths_per_speed: distance * SIXTEENTHS,
            pitch: self.track.pitch(),
        }
    }
}

impl Neighbours {
    /// Of a ball; `rubs_ahead` is the part of the force in front that rubs, and then that of the ball behind.
    #[inline(always)]
    fn of(ball: &Ball, settled: &BallState, rubs_ahead: &mut f32) -> Self {
        let rubs_behind = ball.rubs() * settled.behind;
        let rubbing = *rubs_ahead + rubs_behind;
        *rubs_ahead = rubs_behind;
        Self {
            speed: settled.speed,
            forces: settled.force + settled.behind,
            rubbing,
        }
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
            let pressing = asked.press(travel, |_, neighbours| both += neighbours.forces);
            assert_eq!(count, 5);
            assert_eq!(listed, asked);
            let forces = || asked.forces().filter(|&force| force > 0.0);
            assert_eq!(usize::from(pressing.contacts), forces().count());
            assert_eq!(pressing.largest, forces().fold(0.0, f32::max));
            assert!((both - 2.0 * forces().sum::<f32>()).abs() <= 1e-5 * pressing.largest);
        }
    }
}
