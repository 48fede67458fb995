//! Outputs of scenes: torques of a ball screw and forces of a bearing.

use super::contract::{Regime, ReversalState, SceneOutputs};
use super::faults::Faults;

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
