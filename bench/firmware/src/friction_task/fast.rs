//! The current loop's part: encoder to torque, every 50 us.

use epas_friction::Faults;

use super::gear::Gear;
use super::reaction::{Reaction, ReactionParameters};

/// Ticks after which a friction task that is not heard of counts as stopped: five of its own.
const SILENT: u32 = 100;

/// What the current loop's interrupt has for itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FastTask {
    reaction: Reaction,
    /// Whether the last angle was one.
    angle_known: bool,
    /// Steps of the friction task when they were last looked at, and ticks since they changed.
    steps: u32,
    silent: u32,
    /// Ticks that found the model in the friction task's hands.
    pub busy: u32,
}

impl FastTask {
    /// Before the first tick.
    pub const START: Self = Self {
        reaction: Reaction::START,
        angle_known: false,
        steps: 0,
        silent: 0,
        busy: 0,
    };

    /// One tick: the torque for the current controller, N m about the nut's axis.
    ///
    /// `gear` is `None` where the friction task has the model: the torque of the tick before stays for this one, and the next
    /// reading of the encoder spans both. `steps` counts the friction task's ticks.
    #[inline]
    pub fn tick(
        &mut self,
        gear: Option<&mut Gear>,
        counts: u32,
        steps: u32,
        parameters: &ReactionParameters,
    ) -> f32 {
        let friction = if let Some(gear) = gear {
            let outputs = gear.between(counts);
            self.angle_known = !outputs.faults.contains(Faults::ANGLE_NOT_VALID);
            Some(outputs.friction_torque)
        } else {
            self.busy = self.busy.saturating_add(1);
            None
        };
        if steps == self.steps {
            self.silent = self.silent.saturating_add(1);
        } else {
            self.steps = steps;
            self.silent = 0;
        }
        let known = self.angle_known && self.silent < SILENT;
        self.reaction.torque(friction, known, parameters)
    }
}
