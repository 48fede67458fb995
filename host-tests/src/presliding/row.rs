//! A row of balls that press on each other, behind elements that stick and slip.
//!
//! Sliding friction of a row is found in the direction in which its balls go. A ball pushes the next one with what its own grooves hold it
//! back less than the other's: so the row slides forward with grooves and balls, against its direction with the grooves alone, and the
//! elements are limited by the two. After a reversal the balls themselves go back after the play: a limit that falls then begins where it
//! was, over the load, and fades by its own size with each half width of the play that the balls go on.

use super::Limits;
use super::elements::Elements;

/// Friction of a row that slides in the direction in which its balls go, each over the limit under the reference load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Of its grooves.
    pub groove: f64,
    /// Of its balls on each other.
    pub ball: f64,
    /// Of its grooves where no ball presses on another.
    pub free: f64,
    /// Load over the reference load.
    pub load: f64,
}

impl Row {
    fn limits(&self, direction: f64) -> Limits {
        let (with, against) = (self.groove + self.ball, self.free);
        if direction < 0.0 {
            Limits {
                forward: against,
                backward: with,
            }
        } else {
            Limits {
                forward: with,
                backward: against,
            }
        }
    }
}

/// What the row carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torque {
    /// By its grooves.
    pub groove: f64,
    /// By its balls on each other.
    pub ball: f64,
}

/// A row with its memory.
#[derive(Clone, Debug)]
pub struct RowMemory {
    elements: Elements,
    half_width: f64,
    /// Turn within the play.
    position: f64,
    /// Direction in which the balls went last.
    direction: f64,
    last: Option<Last>,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    direction: f64,
    limits: Limits,
    load: f64,
    /// Excess of the limits over those of sliding, over those.
    fading: [f64; 2],
}

impl RowMemory {
    /// A row at rest whose balls go back after twice `half_width`, over the breakaway angle.
    pub fn new(elements: Elements, half_width: f64) -> Self {
        Self {
            elements,
            half_width,
            position: 0.0,
            direction: 1.0,
            last: None,
        }
    }

    fn play(&mut self, turn: f64) -> (f64, f64) {
        let position = self.position + turn;
        self.position = position.clamp(-self.half_width, self.half_width);
        let travel = position - self.position;
        if travel != 0.0 {
            self.direction = travel.signum();
        }
        (self.direction, travel)
    }

    /// What the row carries after a turn; `row`: its sliding friction by direction and travel of the balls.
    pub fn follow(&mut self, turn: f64, row: impl FnOnce(f64, f64) -> Row) -> Torque {
        let (direction, travel) = self.play(turn);
        let row = row(direction, travel);
        let sliding = row.limits(direction);
        let excess = self.last.map_or([0.0; 2], |last| {
            if last.direction == direction {
                last.fading
            } else {
                let excess = |now: f64, before: f64| before / last.load * row.load / now - 1.0;
                [
                    excess(sliding.forward, last.limits.forward),
                    excess(sliding.backward, last.limits.backward),
                ]
            }
        });
        let travelled = travel.abs() / self.half_width;
        let fading = excess.map(|excess| (excess - travelled).max(0.0));
        let limits = Limits {
            forward: sliding.forward * (1.0 + fading[0]),
            backward: sliding.backward * (1.0 + fading[1]),
        };
        self.last = Some(Last {
            direction,
            limits,
            load: row.load,
            fading,
        });
        let friction = self.elements.follow(turn, limits, row.load);
        let ball = if friction * direction > 0.0 {
            friction * row.ball / (row.groove + row.ball)
        } else {
            0.0
        };
        Torque {
            groove: friction - ball,
            ball,
        }
    }
}
