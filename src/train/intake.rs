//! A tick of the train, ball by ball: the caller is handed each ball once and says what it would do on its own.

use super::ball::Ball;
use super::pool::Pressing;
use super::track::{Room, Train};

/// Impedance of a ball of which nobody said what it would do: the least that counts, so that it goes along with its
/// neighbours.
const UNSAID: f32 = super::press::IMPEDANCE_RANGE.0;

/// A tick of a train under way: the balls that are still to come, from the last one (the front of the row) backwards
/// to the first.
///
/// [`Intake::press`] ends the tick. An intake that is dropped before leaves all positions and forces as they were,
/// and the next tick starts anew; only the speeds of the last tick are lost.
#[must_use = "balls move when `press` is called"]
pub(crate) struct Intake<'train, const N: usize> {
    train: &'train mut Train<N>,
    /// Balls still to come: indices below this.
    left: usize,
    /// Travel of the nominal speed in this tick, in units.
    travel: f32,
    ahead: Ahead,
}

/// What a ball has to know of the one in front of it.
struct Ahead {
    room: Room,
    /// Its free speed.
    speed: f32,
}

/// One ball that is asked for; dropped without an answer it runs at the nominal speed and hardly pushes.
#[must_use = "a ball needs its free speed and impedance"]
pub(crate) struct FreeBall<'intake> {
    ball: &'intake mut Ball,
    ahead: &'intake mut Ahead,
}

impl<const N: usize> Train<N> {
    /// Begins a tick; `travel`, m, as in [`Train::step`].
    #[inline(always)]
    pub(crate) fn intake(&mut self, travel: f32) -> Intake<'_, N> {
        let travel = self.counted(travel);
        let ahead = Ahead {
            room: self.room(travel),
            // Of the first ball, which comes last: `without_overlap` puts it in.
            speed: 0.0,
        };
        Intake {
            train: self,
            left: N,
            travel,
            ahead,
        }
    }
}

impl<const N: usize> Intake<'_, N> {
    /// The next ball, backwards from the last one; none when all have come.
    #[inline(always)]
    pub(crate) fn next_ball(&mut self) -> Option<FreeBall<'_>> {
        self.left = self.left.checked_sub(1)?;
        let ball = self.train.press.balls.get_mut(self.left)?;
        Some(FreeBall {
            ball,
            ahead: &mut self.ahead,
        })
    }

    /// Which balls press on each other, and how hard; moves all balls. Balls that have not come are taken as dropped.
    #[inline(always)]
    pub(crate) fn press(mut self) -> Pressing {
        while let Some(ball) = self.next_ball() {
            drop(ball);
        }
        self.train.without_overlap(self.ahead.room);
        self.train.press.join(true);
        self.train.advance(self.travel)
    }
}

impl FreeBall<'_> {
    /// Position of the ball, as a part of the track's length in units of 2^-32.
    #[inline(always)]
    pub(crate) fn position(&self) -> u32 {
        self.ball.position
    }

    /// What the ball would do on its own: its free speed, a deviation from the nominal one over the size of that, within
    /// [`LARGEST_FREE_SPEED`](super::LARGEST_FREE_SPEED), and its impedance, N, within
    /// [`IMPEDANCE_RANGE`](super::IMPEDANCE_RANGE). Neither is checked here: the scene's set-up has to see to it.
    #[inline(always)]
    pub(crate) fn put(mut self, speed: f32, impedance: f32) {
        self.take(speed, impedance);
        core::mem::forget(self);
    }

    #[inline(always)]
    fn take(&mut self, speed: f32, impedance: f32) {
        let room = self.ahead.room.next(self.ball.position);
        self.ball
            .set(speed, impedance, room + (self.ahead.speed - speed));
        self.ahead.speed = speed;
    }
}

impl Drop for FreeBall<'_> {
    #[inline(always)]
    fn drop(&mut self) {
        self.take(0.0, UNSAID);
    }
}

#[cfg(test)]
mod tests {
    use super::super::track::Train;

    /// Five balls in contact, the fastest at the rear.
    fn train() -> Train<5> {
        Train::new(1.0, 0.01, &[0.0; 5]).unwrap()
    }

    const FREE: [f32; 5] = [0.02, 0.01, 0.0, 0.0, -0.01];

    /// What `step` makes of two lists is what an intake makes of the same numbers, and the sums are those of the forces.
    #[test]
    fn each_ball_comes_once_from_the_front_backwards() {
        let (mut listed, mut asked) = (train(), train());
        for travel in [1e-4, 0.0, -2e-4] {
            assert!(listed.step(&FREE, &[1e3; 5], travel));
            let positions: [u32; 5] = core::array::from_fn(|j| asked.positions().nth(j).unwrap());
            let mut count = 0;
            let mut balls = asked.intake(travel);
            while let Some(ball) = balls.next_ball() {
                count += 1;
                assert_eq!(ball.position(), positions[5 - count]);
                ball.put(FREE[5 - count], 1e3);
            }
            let pressing = balls.press();
            assert_eq!(count, 5);
            assert_eq!(listed, asked);
            let forces = || asked.forces().filter(|&force| force > 0.0);
            assert_eq!(usize::from(pressing.contacts), forces().count());
            assert_eq!(pressing.largest, forces().fold(0.0, f32::max));
        }
    }

    /// Balls without an answer, and balls that were never asked for, run at the nominal speed and hardly push.
    #[test]
    fn forgotten_balls_run_at_the_nominal_speed() {
        let (mut listed, mut asked) = (train(), train());
        assert!(listed.step(
            &[0.0, 0.0, 0.0, 0.02, 0.0],
            &[1e-9, 1e-9, 1e-9, 1e3, 1e-9],
            1e-4
        ));
        let mut balls = asked.intake(1e-4);
        drop(balls.next_ball());
        if let Some(ball) = balls.next_ball() {
            ball.put(0.02, 1e3);
        }
        let _ = balls.press();
        assert_eq!(listed, asked);
    }

    /// A tick that is given up moves nothing, and the next one is whole.
    #[test]
    fn a_dropped_intake_leaves_positions_and_forces() {
        let (mut whole, mut broken) = (train(), train());
        assert!(whole.step(&FREE, &[1e3; 5], 1e-4));
        assert!(broken.step(&FREE, &[1e3; 5], 1e-4));
        let mut balls = broken.intake(1e-4);
        if let Some(ball) = balls.next_ball() {
            ball.put(1.0, 1e9);
        }
        drop(balls);
        assert!(whole.positions().eq(broken.positions()));
        assert!(whole.forces().eq(broken.forces()));
        assert!(whole.step(&FREE, &[1e3; 5], 1e-4));
        assert!(broken.step(&FREE, &[1e3; 5], 1e-4));
        assert_eq!(whole, broken);
    }
}
