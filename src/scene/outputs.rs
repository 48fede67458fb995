//! Outputs of scenes: torques of a ball screw and forces of a bearing, and those of a row of balls from its sliding friction.

use super::contract::{Faults, Regime, ReversalState, SceneOutputs};
use super::sliding::SlidingFriction;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Least efficiency of an output: friction of a preload over a load near zero would make that of back-driving minus infinity.
const LEAST_EFFICIENCY: f32 = -1e6;

/// Outputs of a ball screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outputs {
    /// Torque about the nut's axis that the motor has to add to overcome friction, N m; friction itself acts on the nut with the opposite
    /// sign. It has the sign of the nut speed; with memory it keeps the old sign after a reversal until the elements have turned round.
    pub friction_torque: f32,
    /// Torque about the nut's axis that holds the load without friction, N m: `axial_load lead / 2 pi`.
    pub load_torque: f32,
    /// Work out over work in: `load/(load + friction)` of the torques above where the motor drives, `1 + friction/load` where
    /// the load does. 0 without a load, while standing and in a fault; negative where the motor has to help the load along (not below -1e6).
    pub efficiency: f32,
    /// What the mechanism does.
    pub regime: Regime,
    /// What was wrong with this tick's inputs, or limited in its outputs.
    pub faults: Faults,
}

/// Outputs of a ball screw whose balls press on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedOutputs {
    /// Friction torque as [`Outputs::friction_torque`], N m, within its limit: the sum of the next two, and of the lubricant's drag where a
    /// memory's law has one ([`CoefficientAtTemperature::drag_torque`](crate::law::coefficient::CoefficientAtTemperature::drag_torque)).
    pub friction_torque: f32,
    /// Its part from the grooves, N m.
    pub groove_torque: f32,
    /// Its part from balls that rub against each other (Lin 2019, eqs. (3.73), (3.74)), N m. With memory it and the forces below fall with
    /// the friction after a reversal.
    pub ball_torque: f32,
    /// Torque about the nut's axis that holds the load without friction, N m: `axial_load lead / 2 pi`.
    pub load_torque: f32,
    /// Pairs of balls that press on each other, 0 to `N`.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// What the mechanism does.
    pub regime: Regime,
    /// What was wrong with this tick's inputs, or limited in its outputs.
    pub faults: Faults,
}

/// Outputs of a linear bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearOutputs {
    /// Force along the rail that has to be added to overcome friction, N, with the sign of [`Outputs::friction_torque`]: the sum of the next
    /// two, within its limit.
    pub friction_force: f32,
    /// Its part from the grooves, N.
    pub groove_force: f32,
    /// Its part from balls that rub against each other (Lin 2019, eqs. (3.52), (3.53)), N.
    pub ball_force: f32,
    /// Pairs of balls that press on each other, 0 to `N`.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// What the mechanism does: [`Regime::Standing`] or [`Regime::Driving`].
    pub regime: Regime,
    /// What was wrong with this tick's inputs, or limited in its outputs.
    pub faults: Faults,
}

impl SceneOutputs for Outputs {
    const SAFE: Self = Self {
        friction_torque: 0.0,
        load_torque: 0.0,
        efficiency: 0.0,
        regime: Regime::Standing,
        faults: Faults::NONE,
    };

    #[inline(always)]
    fn safe(faults: Faults) -> Self {
        Self {
            faults,
            ..Self::SAFE
        }
    }

    #[inline(always)]
    fn faults(&self) -> Faults {
        self.faults
    }
}

impl SceneOutputs for UncagedOutputs {
    const SAFE: Self = Self {
        friction_torque: 0.0,
        groove_torque: 0.0,
        ball_torque: 0.0,
        load_torque: 0.0,
        contacts: 0,
        largest_contact_force: 0.0,
        regime: Regime::Standing,
        faults: Faults::NONE,
    };

    #[inline(always)]
    fn safe(faults: Faults) -> Self {
        Self {
            faults,
            ..Self::SAFE
        }
    }

    #[inline(always)]
    fn faults(&self) -> Faults {
        self.faults
    }
}

impl SceneOutputs for LinearOutputs {
    const SAFE: Self = Self {
        friction_force: 0.0,
        groove_force: 0.0,
        ball_force: 0.0,
        contacts: 0,
        largest_contact_force: 0.0,
        regime: Regime::Standing,
        faults: Faults::NONE,
    };

    #[inline(always)]
    fn safe(faults: Faults) -> Self {
        Self {
            faults,
            ..Self::SAFE
        }
    }

    #[inline(always)]
    fn faults(&self) -> Faults {
        self.faults
    }
}

impl Outputs {
    /// Outputs at a reversal state: `friction`, N m, cut to `largest` and flagged, 0 in the place of NaN; the regime from the friction
    /// `sliding` in the direction of motion, not negative.
    #[inline(always)]
    pub(super) fn new(
        friction: f32,
        sliding: f32,
        load_torque: f32,
        reversal: &ReversalState,
        faults: Faults,
        largest: f32,
    ) -> Self {
        let (friction_torque, faults) = if friction.abs() <= largest {
            (friction, faults)
        } else if friction.is_nan() {
            (0.0, faults | Faults::FRICTION_LIMIT)
        } else {
            (largest.copysign(friction), faults | Faults::FRICTION_LIMIT)
        };
        let opposing = reversal.direction * load_torque;
        let regime = if reversal.standing {
            Regime::Standing
        } else if opposing >= 0.0 {
            Regime::Driving
        } else if sliding < -opposing {
            Regime::BackDriving
        } else {
            Regime::Locked
        };
        // Signs, because the product of two small torques would vanish.
        let alike = friction_torque.is_sign_negative() == load_torque.is_sign_negative();
        let efficiency = if load_torque == 0.0 || reversal.standing {
            0.0
        } else if alike {
            load_torque / (load_torque + friction_torque)
        } else {
            let efficiency = 1.0 + friction_torque / load_torque;
            if efficiency > LEAST_EFFICIENCY {
                efficiency
            } else {
                LEAST_EFFICIENCY
            }
        };
        Self {
            friction_torque,
            load_torque,
            efficiency,
            regime,
            faults,
        }
    }
}

impl From<UncagedOutputs> for Outputs {
    fn from(outputs: UncagedOutputs) -> Self {
        let reversal = ReversalState {
            standing: matches!(outputs.regime, Regime::Standing),
            ..ReversalState::FORWARD
        };
        let all = Self::new(
            outputs.friction_torque,
            0.0,
            outputs.load_torque,
            &reversal,
            outputs.faults,
            f32::MAX,
        );
        let regime = outputs.regime;
        Self { regime, ..all }
    }
}

/// Largest fading that counts: it bounds what friction near none makes of a quotient.
const LARGEST_FADING: f32 = 10.0;

/// Sliding friction of a row of balls, in the direction in which they go: torques of a screw, N m, or forces of a bearing, N.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TrainFriction {
    /// Friction of the grooves, and of balls that rub against each other, not negative.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// Friction of the grooves where no ball presses on another, not negative.
    pub(super) free: f32,
    /// Groove friction forward and backward, each over that of the friction coefficient in the direction of the balls.
    pub(super) ratios: [f32; 2],
    /// What limits forward and backward still exceed this friction by, over it: see [`Self::continue_from`].
    pub(super) fading: [f32; 2],
    /// -1 where the balls go backward, else 1.
    pub(super) direction: f32,
    /// Load, preload counted, N.
    pub(super) load: f32,
    pub(super) contacts: u8,
    pub(super) largest_contact_force: f32,
}

pub(super) struct RowOutputs {
    /// Friction of the whole row, N m or N, with load torque, regime and faults.
    pub(super) whole: Outputs,
    /// Its parts of the grooves and between balls, with their sign.
    pub(super) groove: f32,
    pub(super) ball: f32,
    pub(super) contacts: u8,
    pub(super) largest_contact_force: f32,
}

impl TrainFriction {
    #[inline(always)]
    pub(super) fn friction(&self) -> SlidingFriction {
        let [forward, backward] = self.fading;
        SlidingFriction {
            forward: self.of(1.0) * (1.0 + forward),
            backward: self.of(-1.0) * (1.0 + backward),
            load: self.load,
        }
    }

    /// Sliding friction in the direction of a sign; against the direction of the balls that of the grooves alone.
    #[inline(always)]
    pub(super) fn of(&self, direction: f32) -> f32 {
        let [groove, ball] = self.parts(direction);
        groove + ball
    }

    #[inline(always)]
    fn parts(&self, direction: f32) -> [f32; 2] {
        let ratio = of_direction(self.ratios, direction);
        if direction * self.direction < 0.0 {
            [ratio * self.free, 0.0]
        } else {
            [ratio * self.groove, self.ball]
        }
    }

    /// Outputs of the row with a drag added: see [`Outputs::new`].
    #[inline(always)]
    pub(super) fn outputs_at(
        &self,
        reversal: ReversalState,
        load_torque: f32,
        drag: f32,
        faults: Faults,
        largest: f32,
    ) -> RowOutputs {
        let sliding = self.of(reversal.direction);
        let ReversalState {
            factor, carried, ..
        } = reversal;
        let [groove, ball] = self.parts(factor);
        let presses = factor * self.direction >= 0.0 && carried > 0.0;
        let factor = factor * (1.0 + of_direction(self.fading, factor));
        let (groove, ball) = (factor * groove, factor * ball);
        RowOutputs {
            whole: Outputs::new(
                groove + ball + drag,
                sliding,
                load_torque,
                &reversal,
                faults,
                largest,
            ),
            groove,
            ball,
            contacts: if presses { self.contacts } else { 0 },
            largest_contact_force: if presses {
                carried * self.largest_contact_force
            } else {
                0.0
            },
        }
    }

    /// See [`Sliding::continue_from`]. Where balls turn round, limits that fall begin where they were, in proportion to the load, and fade by
    /// the whole friction with each half of the play.
    #[inline(always)]
    pub(super) fn continue_from(&mut self, last: &Self, travelled: f32) {
        let excess = if self.direction == last.direction {
            last.fading
        } else {
            let (now, before) = (self.friction(), last.friction());
            let scale = self.load / last.load;
            let excess = |now: f32, before: f32| {
                let excess = before * scale / now - 1.0;
                if excess > LARGEST_FADING {
                    LARGEST_FADING
                } else {
                    excess
                }
            };
            [
                excess(now.forward, before.forward),
                excess(now.backward, before.backward),
            ]
        };
        self.fading = excess.map(|excess| not_negative(excess - travelled));
    }
}

#[inline(always)]
pub(super) const fn of_direction([forward, backward]: [f32; 2], direction: f32) -> f32 {
    if direction < 0.0 { backward } else { forward }
}

/// 0 for a number below 0, and for NaN.
#[inline(always)]
pub(super) const fn not_negative(number: f32) -> f32 {
    if number > 0.0 { number } else { 0.0 }
}

impl Stored for TrainFriction {
    const BYTES: usize = 10 * 4 + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("groove", &mut self.groove, ranges::STORED_FRICTION)?;
        port.number("ball", &mut self.ball, ranges::STORED_FRICTION)?;
        port.number("free", &mut self.free, ranges::STORED_FRICTION)?;
        port.numbers("ratios", &mut self.ratios, ranges::STORED_RATIOS)?;
        let fading = Range::new(0.0, LARGEST_FADING);
        port.numbers("fading", &mut self.fading, fading)?;
        port.number("direction", &mut self.direction, Range::new(-1.0, 1.0))?;
        port.number("load", &mut self.load, ranges::STORED_LOAD)?;
        port.count("contacts", &mut self.contacts, u8::MAX)?;
        port.number(
            "largest_contact_force",
            &mut self.largest_contact_force,
            Range::new(0.0, 1e12),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn efficiency_of(load_torque: f32, friction_torque: f32, regime: Regime) -> f32 {
        Outputs::from(UncagedOutputs {
            friction_torque,
            load_torque,
            regime,
            ..UncagedOutputs::SAFE
        })
        .efficiency
    }

    /// Work out over work in, for all signs of load and motion; friction has the sign of the motion.
    #[test]
    fn efficiency_in_all_four_quadrants() {
        use Regime::{BackDriving, Driving, Locked};
        for (load, friction, regime, expected) in [
            (2.0, 2.0, Driving, 0.5),
            (-2.0, -2.0, Driving, 0.5),
            (2.0, -0.5, BackDriving, 0.75),
            (-2.0, 0.5, BackDriving, 0.75),
            // Without friction nothing is lost, in either direction.
            (2.0, 0.0, Driving, 1.0),
            (-2.0, 0.0, Driving, 1.0),
            (2.0, -0.0, BackDriving, 1.0),
            // The motor helps the load along.
            (2.0, -3.0, Locked, -0.5),
            // No torque moves the load; friction is cut.
            (2.0, 6.0, Locked, 0.25),
            // No load: nothing comes out.
            (0.0, 1.0, Driving, 0.0),
            (-0.0, 1.0, Driving, 0.0),
            // A load that hardly counts beside the friction.
            (1e-9, -1.0, Locked, LEAST_EFFICIENCY),
            (-1e-9, 1.0, Locked, LEAST_EFFICIENCY),
        ] {
            assert_eq!(
                efficiency_of(load, friction, regime),
                expected,
                "{load} {friction} {regime:?}"
            );
            assert_eq!(efficiency_of(load, friction, Regime::Standing), 0.0);
        }
        // Twice the least is not cut.
        let half = 0.5 * LEAST_EFFICIENCY;
        assert_eq!(efficiency_of(1.0, half - 1.0, Regime::BackDriving), half);
    }

    /// Whatever a scene computes, friction is a number within its limit, and flagged where it is cut.
    #[test]
    fn friction_is_within_its_limit() {
        for (friction, output, cut) in [
            (1.5, 1.5, false),
            (-2.0, -2.0, false),
            (f32::NAN, 0.0, true),
            (-f32::NAN, 0.0, true),
            (f32::INFINITY, 2.0, true),
            (-2.1, -2.0, true),
        ] {
            let faults = Faults::LOAD_RANGE.with(cut, Faults::FRICTION_LIMIT);
            let reversal = &ReversalState::FORWARD;
            let found = Outputs::new(friction, 1.0, 0.0, reversal, Faults::LOAD_RANGE, 2.0);
            assert_eq!(found.friction_torque, output, "{friction}");
            assert_eq!(found.faults, faults, "{friction}");
        }
    }
}
