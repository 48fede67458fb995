//! A tick of a train: each ball is taken in once, from the front backwards, then all are joined, settled and moved.

use super::ball::Ball;
use super::losses::{Losses, RubbedBall, RubbedRow};
use super::positions::Train;
use super::press::InputCheck;
use super::settle::Pressing;
use super::track::Rooms;
use super::track::{Motion, SIXTEENTHS};

/// A tick of a train that has begun: the balls that are still to come, from the last one (the front of the row)
/// backwards to the first.
///
/// [`Intake::press`] ends the tick. An intake that is dropped before leaves all positions and forces as they were,
/// and the next tick takes all balls in anew; only the speeds of the last tick are lost.
#[must_use = "balls move when `press` is called"]
pub(crate) struct Intake<'train, const N: usize> {
    train: &'train mut Train<N>,
    /// Balls still to come: those with an index below this.
    left: usize,
    /// Travel of the nominal speed in this tick, in units.
    travel: f32,
    ahead: Ahead,
    /// Ball that was foremost in the last tick.
    overlap: usize,
}

/// What a ball has to know of the one in front of it.
struct Ahead {
    rooms: Rooms,
    free_speed: f32,
}

/// One ball that is to be taken in: it asks for its free speed and impedance.
#[must_use = "a ball needs its free speed and impedance"]
pub(crate) struct FreeBall<'intake> {
    ball: &'intake mut Ball,
    ahead: &'intake mut Ahead,
    /// Force and position of the ball behind, before it is taken in.
    force_behind: f32,
    position_behind: u32,
}

impl<const N: usize> Train<N> {
    /// Moves the train by one tick.
    ///
    /// `travel`, m, is the nominal travel of a ball in this tick, signed along the track. `free[j]` is the
    /// speed ball `j` would take on its own, less the nominal one, over the size of the nominal one;
    /// `impedance[j]` the force that takes all of the nominal speed from it, N. Speeds are signed along
    /// the track: of a train that runs backwards, a ball that is faster than the nominal one has a negative
    /// speed.
    ///
    /// Without travel the forces are those with which motion sets in; what the free speeds' signs say
    /// then is up to the caller. A travel that is NaN counts as zero, one beyond
    /// [`LARGEST_TRAVEL`](super::LARGEST_TRAVEL) of the track as that. Speeds and impedances as in
    /// [`Press::solve`](super::Press::solve), whose answer is returned: where it is false, all balls move with the
    /// nominal speed and press on none.
    pub fn step(&mut self, free: &[f32], impedance: &[f32], travel: f32) -> bool {
        let mut check =
            InputCheck::of_lengths(self.press.balls().len(), [free.len(), impedance.len()]);
        let (travel, mut ahead) = self.begin(travel);
        let inputs = free.iter().zip(impedance);
        for (ball, (&speed, &impedance)) in self.press.balls_mut().iter_mut().zip(inputs).rev() {
            check.add(speed, impedance);
            let slack = ahead.slack(ball, speed);
            ball.take_in(speed, impedance, slack);
        }
        let overlap = self.press.foremost();
        self.complete(&ahead.rooms, overlap);
        let motion = self.motion(travel);
        self.press.join::<false>(check.passed());
        self.press.settle(motion);
        check.passed()
    }

    /// Begins a tick; `travel`, m, as in [`Train::step`].
    #[inline(always)]
    pub(crate) fn intake(&mut self, travel: f32) -> Intake<'_, N> {
        let (travel, ahead) = self.begin(travel);
        Intake {
            left: self.balls().min(N),
            travel,
            ahead,
            overlap: self.press.foremost(),
            train: self,
        }
    }

    /// The travel in units, and what the last ball has to know of the first, which is ahead of it on the ring.
    #[inline(always)]
    fn begin(&self, travel: f32) -> (f32, Ahead) {
        let travel = self.track.in_units(travel);
        let first = self.first_position();
        let ahead = Ahead {
            rooms: Rooms::behind(first, self.track, travel),
            // Not known before the first ball comes, at the end: `complete` puts it in.
            free_speed: 0.0,
        };
        (travel, ahead)
    }

    /// Puts in the two slacks that a walk from the front backwards cannot know: that of the last ball, because the ball in
    /// front of it, the first, comes at the end; and that of the ball that was foremost in the last tick. That tick moved
    /// it first and the ball in front of it last: these two pairs alone may overlap by rounding.
    #[inline(always)]
    fn complete(&mut self, rooms: &Rooms, foremost: usize) {
        let last = usize::from(self.press.last());
        let balls = self.press.balls_mut();
        for index in [last, foremost] {
            let ahead = if index == last { 0 } else { index + 1 };
            let Some(&ahead) = balls.get(ahead) else {
                continue;
            };
            if let Some(ball) = balls.get_mut(index) {
                let room = rooms.without_overlap(ball.position(), ahead.position());
                ball.set_slack(room + (ahead.free_speed() - ball.free_speed()));
            }
        }
    }

    /// How far a speed moves a ball in this tick, with a nominal travel in units.
    #[inline(always)]
    fn motion(&mut self, travel: f32) -> Motion {
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

impl<const N: usize> Intake<'_, N> {
    /// The next ball, backwards from the last one; none when all have come.
    #[inline(always)]
    pub(crate) fn next_ball(&mut self) -> Option<FreeBall<'_>> {
        self.left = self.left.checked_sub(1)?;
        let press = &mut self.train.press;
        let behind = self
            .left
            .checked_sub(1)
            .unwrap_or(usize::from(press.last()));
        let (force_behind, position_behind) = press
            .places
            .get(behind)
            .map_or((0.0, 0), |ball| (ball.force(), ball.position()));
        let ball = press.places.get_mut(self.left)?;
        Some(FreeBall {
            ball,
            ahead: &mut self.ahead,
            force_behind,
            position_behind,
        })
    }

    /// Which balls press on each other, and how hard; moves all balls.
    #[inline(always)]
    pub(crate) fn press(self) -> Pressing {
        self.train.complete(&self.ahead.rooms, self.overlap);
        let motion = self.train.motion(self.travel);
        self.train.press.join::<false>(true);
        self.train.press.settle(motion)
    }

    /// The same for balls that rub on each other, with what they lose.
    #[inline(always)]
    pub(crate) fn press_rubbing(self, losses: &Losses) -> RubbedRow {
        self.train.complete(&self.ahead.rooms, self.overlap);
        let motion = self.train.motion(self.travel);
        self.train.press.join::<true>(true);
        self.train.press.settle_rubbing(motion, losses, true)
    }

    /// A first pass of balls that rub, which moves none; all balls come once more.
    #[inline(always)]
    pub(crate) fn press_once(self) -> Self {
        let Self {
            train,
            travel,
            ahead,
            overlap,
            ..
        } = self;
        train.complete(&ahead.rooms, overlap);
        train.press.join::<true>(true);
        let losses = Losses::default();
        train.press.settle_rubbing(Motion::NONE, &losses, false);
        let first = train.first_position();
        Self {
            left: train.balls().min(N),
            travel,
            ahead: Ahead {
                rooms: Rooms::behind(first, train.track, travel),
                free_speed: 0.0,
            },
            overlap,
            train,
        }
    }
}

impl Ahead {
    /// Slack of a ball with this free speed, which then is the one ahead.
    #[inline(always)]
    fn slack(&mut self, ball: &Ball, speed: f32) -> f32 {
        let slack = self.rooms.next(ball.position()) + (self.free_speed - speed);
        self.free_speed = speed;
        slack
    }
}

impl FreeBall<'_> {
    /// Position of the ball, as a part of the track's length in units of 2^-32.
    #[inline(always)]
    pub(crate) fn position(&self) -> u32 {
        self.ball.position()
    }

    /// Position of the ball behind, as [`Self::position`].
    #[inline(always)]
    pub(crate) fn position_behind(&self) -> u32 {
        self.position_behind
    }

    /// Forces of the ball behind and of the one ahead by the pass before.
    #[inline(always)]
    pub(crate) fn forces(&self) -> [f32; 2] {
        [self.force_behind, self.ball.force()]
    }

    /// Speed by the pass before.
    #[inline(always)]
    pub(crate) fn speed(&self) -> f32 {
        self.ball.speed()
    }

    /// What the ball would do on its own: its free speed, a deviation from the nominal one over the size of that, within
    /// [`LARGEST_FREE_SPEED`](super::LARGEST_FREE_SPEED), and its impedance, N, within [`IMPEDANCE_RANGE`](super::IMPEDANCE_RANGE). Neither is
    /// checked here: the scene's set-up has to see to it.
    #[inline(always)]
    pub(crate) fn put(self, speed: f32, impedance: f32) {
        let slack = self.ahead.slack(self.ball, speed);
        self.ball.take_in(speed, impedance, slack);
    }

    /// The same of a train whose balls rub on each other.
    #[inline(always)]
    pub(crate) fn put_rubbed(self, rubbed: &RubbedBall) {
        let slack = self.ahead.slack(self.ball, rubbed.speed);
        self.ball.take_in_rubbed(rubbed, slack);
    }

    /// The same of a ball there on which no neighbour rubs.
    #[inline(always)]
    pub(crate) fn put_smooth(self, speed: f32, impedance: f32) {
        self.ball.set_smooth();
        self.put(speed, impedance);
    }
}

#[cfg(test)]
mod tests {
    use super::super::positions::Train;

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
