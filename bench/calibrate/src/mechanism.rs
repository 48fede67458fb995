//! Motion of a mass or an inertia under an effort, with friction that may hold it at rest.
//!
//! A step of time `h` is implicit in the speed: `I (v - v0)/h = effort - R(h v)`, with the resistance `R` at the end of the step. `R` does not
//! fall with the motion, so the speed is the one root between rest and the speed without a change of resistance. A mass that sticks
//! stays on its friction's spring: nothing chatters at any step. Euler's backward rule: the error of a motion falls with the step.
//!
//! A friction in single precision does not feel a displacement whose force is below its last digit: a body on its spring would creep on without end,
//! each step too small to be felt, or felt and taken back. Where effort and inertia are within its last digits, it holds the body at rest.

use roots::{SimpleConvergency, find_root_brent};

/// A step of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Position at its start, rad or m.
    pub position: f64,
    /// Speed at its start, rad/s or m/s.
    pub speed: f64,
    /// Way, rad or m.
    pub turn: f64,
    /// Speed at its end, rad/s or m/s; of a mechanism its displacement over its time (Euler's backward rule).
    pub end_speed: f64,
    /// Time, s, above 0.
    pub time: f64,
}

impl Step {
    /// To the turning point and back, where the motion turns round on the way: with the speed as a straight line over time.
    pub fn halves(&self) -> Option<(Self, Self)> {
        if self.speed * self.end_speed >= 0.0 {
            return None;
        }
        let time = self.time * self.speed / (self.speed - self.end_speed);
        let turn = 0.5 * self.speed * time;
        let there = Self {
            turn,
            end_speed: 0.0,
            time,
            ..*self
        };
        let back = Self {
            position: self.position + turn,
            speed: 0.0,
            turn: self.turn - turn,
            time: self.time - time,
            ..*self
        };
        Some((there, back))
    }
}

/// What opposes a motion: friction, drag, a load.
pub trait Resistance {
    /// Effort against the motion at the end of a step, N m or N. It must not fall with the displacement. Nothing is remembered.
    fn against(&self, step: &Step) -> f64;

    /// The same, remembered: the step was made.
    fn follow(&mut self, step: &Step) -> f64;

    /// Whether it holds the body at rest through this step: the effort is that at rest within its last digits, and it does not feel the
    /// step's displacement, or `inertial`, the effort that stops the body within the step, is within them too. A resistance that feels every
    /// displacement never does.
    fn holds(&self, _: &Step, _effort: f64, _inertial: f64) -> bool {
        false
    }
}

/// A mass or an inertia with what opposes its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism<R> {
    /// Mass, kg, or inertia, kg m^2; above 0.
    pub inertia: f64,
    /// Position, rad or m.
    pub position: f64,
    /// Speed, rad/s or m/s.
    pub speed: f64,
    /// What opposes its motion.
    pub resistance: R,
}

impl<R: Resistance> Mechanism<R> {
    /// Moves on by a time under an effort, N m or N; gives the resistance at its end.
    pub fn advance(&mut self, effort: f64, time: f64) -> f64 {
        let step = |end_speed: f64| Step {
            position: self.position,
            speed: self.speed,
            turn: end_speed * time,
            end_speed,
            time,
        };
        let excess = |end_speed: f64| {
            self.inertia * (end_speed - self.speed) / time
                + self.resistance.against(&step(end_speed))
                - effort
        };
        // Excess grows with the speed: it is below zero at rest if this speed is above, and not below zero at it.
        let free =
            self.speed + time / self.inertia * (effort - self.resistance.against(&step(0.0)));
        let end_speed = if free == 0.0 || excess(free) == 0.0 {
            free
        } else {
            root(&excess, free)
        };
        let inertial = self.inertia * end_speed.abs() / time;
        let end_speed = if self.resistance.holds(&step(end_speed), effort, inertial) {
            0.0
        } else {
            end_speed
        };
        let step = step(end_speed);
        let resistance = self.resistance.follow(&step);
        self.position += step.turn;
        self.speed = end_speed;
        resistance
    }
}

/// Root of a growing function between zero and another place, to a billionth of it.
fn root(function: &impl Fn(f64) -> f64, end: f64) -> f64 {
    let mut convergency = SimpleConvergency {
        eps: 1e-9 * end.abs(),
        max_iter: 60,
    };
    // Without a change of sign the function is flat there to rounding: the end is as good as any.
    find_root_brent(
        0.0_f64.min(end),
        0.0_f64.max(end),
        function,
        &mut convergency,
    )
    .unwrap_or(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spring that slips at a limit, with drag.
    #[derive(Clone, Debug, PartialEq)]
    struct Slider {
        stiffness: f64,
        limit: f64,
        drag: f64,
        held: f64,
    }

    impl Resistance for Slider {
        fn against(&self, step: &Step) -> f64 {
            let held = self.held + self.stiffness * step.turn;
            held.clamp(-self.limit, self.limit) + self.drag * step.end_speed
        }

        fn follow(&mut self, step: &Step) -> f64 {
            let resistance = self.against(step);
            self.held = (self.held + self.stiffness * step.turn).clamp(-self.limit, self.limit);
            resistance
        }
    }

    /// Moved so many times for a time, s, under an effort, from a speed.
    fn moved(
        [stiffness, limit, drag]: [f64; 3],
        (times, time): (usize, f64),
        (speed, effort): (f64, f64),
    ) -> [f64; 2] {
        let resistance = Slider {
            stiffness,
            limit,
            drag,
            held: 0.0,
        };
        let mut body = Mechanism {
            inertia: 2.0,
            position: 0.0,
            speed,
            resistance,
        };
        for _ in 0..times {
            body.advance(effort, time);
        }
        [body.position, body.speed]
    }

    #[test]
    fn a_mechanism_moves_and_rests_as_newton_says() {
        for (slider, steps, push, wanted, within) in [
            // On a spring of 1e9 N/m, far beyond what an explicit step of 1 ms stands: sqrt(k/m) h = 22.
            (
                [1e9, 10.0, 0.0],
                (1000, 1e-3),
                (0.0, 9.0),
                [9e-9, 0.0],
                [1e-14, 1e-12],
            ),
            // (14 - 10)/2 for one second; sliding sets in after 1e-8 m, within the first step. Euler's backward rule counts the speed at the
            // end of a step: half a step too much, 1 mm.
            (
                [1e9, 10.0, 0.0],
                (1000, 1e-3),
                (0.0, 14.0),
                [1.001, 2.0],
                [1e-4, 1e-4],
            ),
            // Drag sets the last speed.
            (
                [1e6, 10.0, 4.0],
                (20_000, 1e-3),
                (0.0, 18.0),
                [39.0, 2.0],
                [1.0, 1e-9],
            ),
            // It stops where friction has taken its energy: m v^2/2 = 10 N times the displacement, less half of that of the spring,
            // 1e-5 m. The step damps the swing on the spring that is left.
            (
                [1e6, 10.0, 0.0],
                (100_000, 1e-4),
                (0.1, 0.0),
                [1e-3, 0.0],
                [2e-5, 1e-9],
            ),
        ] {
            let found = moved(slider, steps, push);
            let off = [0, 1].map(|k| (found[k] - wanted[k]).abs());
            assert!(
                off[0] < within[0] && off[1] < within[1],
                "{found:?} for {wanted:?}"
            );
        }
    }
}
