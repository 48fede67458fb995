//! What opposes the motion of a slide: friction, drag, the load with its losses.

use crate::laws::Friction;
use crate::mechanism::{Resistance, Step};

/// What opposes the motion of a slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlideResistance {
    friction: Friction,
    numbers: Numbers,
    /// Load, N or N m.
    pub load: f64,
}

/// Numbers of a resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Friction without a load, N or N m.
    pub level: f64,
    /// Drag over the speed, forward and backward.
    pub drag: [f64; 2],
    /// Effort that is always there, N or N m.
    pub offset: f64,
    /// Place where the terms of the position are zero, rad or m.
    pub middle: f64,
    /// Effort over the position.
    pub stiffness: f64,
    /// Friction over the position.
    pub slope: f64,
    /// Sine and cosine of a wave over the position, N or N m.
    pub wave: [f64; 2],
    /// Its wavenumber, rad/rad or rad/m.
    pub wavenumber: f64,
    /// Effort of a unit of load.
    pub gain: f64,
    /// Friction of a unit of load, of driving and of back-driving.
    pub losses: [f64; 2],
}

impl SlideResistance {
    /// A resistance without a load.
    pub const fn new(friction: Friction, numbers: Numbers) -> Self {
        Self {
            friction,
            numbers,
            load: 0.0,
        }
    }

    fn with(&self, friction: f64, step: &Step) -> f64 {
        let of = &self.numbers;
        let place = step.position - of.middle;
        let (sine, cosine) = (of.wavenumber * step.position).sin_cos();
        let [forward, backward] = of.drag;
        let speed = step.end_speed;
        let drag = if speed > 0.0 { forward } else { backward };
        let [driving, back_driving] = of.losses;
        let loss = if self.load * friction > 0.0 {
            driving
        } else {
            back_driving
        };
        ((of.level + of.slope * place).max(0.0) + loss * self.load.abs()) * friction
            + drag.max(0.0) * speed
            + of.offset
            + of.stiffness * place
            + of.wave[0] * sine
            + of.wave[1] * cosine
            + of.gain * self.load
    }
}

impl Resistance for SlideResistance {
    fn against(&self, step: &Step) -> f64 {
        let mut friction = self.friction;
        self.with(friction.follow(step), step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        let friction = self.friction.follow(step);
        self.with(friction, step)
    }
}
