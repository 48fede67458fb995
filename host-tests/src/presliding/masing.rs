//! Exact hysteresis under constant limits: every branch is the backbone, stretched, from the last turning point that is not forgotten
//! (Masing 1926; the rules of memory are Madelung's of 1905).

use super::Limits;
use super::backbone::Backbone;

/// A place where the motion turned, and the torque there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turn {
    angle: f64,
    torque: f64,
}

/// Hysteresis with all its turning points.
///
/// First loading to either side is `T+ h(angle / T+)` and `-T- h(-angle / T-)`; a branch after a turn passes from one limit to the other,
/// `(T+ + T-) h(distance / (T+ + T-))` from its turning point. With both limits one that is Masing's `2 h(distance / 2)`. Any limits are exact
/// as long as they stay the same: parallel elements with limits in the same proportion do the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Masing {
    backbone: Backbone,
    limits: Limits,
    /// Turning points that are not forgotten, the oldest first; the first one lies on first loading.
    turns: Vec<Turn>,
    now: Turn,
    /// Direction of the last motion, 0 before the first.
    direction: f64,
}

impl Masing {
    /// Nothing remembered, at angle zero, which first loading starts from. The limits are not negative.
    pub fn new(backbone: Backbone, limits: Limits) -> Self {
        Self {
            backbone,
            limits,
            turns: Vec::new(),
            now: Turn {
                angle: 0.0,
                torque: 0.0,
            },
            direction: 0.0,
        }
    }

    /// Torque after a motion straight to `angle`.
    pub fn follow(&mut self, angle: f64) -> f64 {
        let way = angle - self.now.angle;
        if way == 0.0 {
            return self.now.torque;
        }
        let direction = way.signum();
        if self.direction != 0.0 && direction != self.direction {
            self.turns.push(self.now);
        }
        self.direction = direction;
        self.forget(angle);
        let torque = self.branch(angle);
        self.now = Turn { angle, torque };
        torque
    }

    /// Turning points that are remembered.
    pub fn depth(&self) -> usize {
        self.turns.len()
    }

    /// Forgets what the motion to `angle` passes: a pair of turning points where it passes the older of the two, and the first one where
    /// first loading in the other direction goes on.
    fn forget(&mut self, angle: f64) {
        while let [.., older, _] = self.turns.as_slice()
            && (angle - older.angle) * self.direction >= 0.0
        {
            self.turns.truncate(self.turns.len() - 2);
        }
        if let [first] = self.turns.as_slice()
            && first.angle * angle < 0.0
            && angle.abs() / self.limit(angle) >= first.angle.abs() / self.limit(first.angle)
        {
            self.turns.clear();
        }
    }

    fn branch(&self, angle: f64) -> f64 {
        let rise = |from: f64, width: f64| {
            if width > 0.0 {
                width * self.backbone.torque((angle - from).abs() / width)
            } else {
                0.0
            }
        };
        match self.turns.last() {
            None => angle.signum() * rise(0.0, self.limit(angle)),
            Some(turn) => {
                turn.torque
                    + self.direction * rise(turn.angle, self.limits.forward + self.limits.backward)
            }
        }
    }

    fn limit(&self, angle: f64) -> f64 {
        if angle < 0.0 {
            self.limits.backward
        } else {
            self.limits.forward
        }
    }
}
