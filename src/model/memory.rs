//! What a model can do whose friction remembers.

use core::borrow::Borrow;

use super::FrictionModel;
use crate::error::Error;
use crate::law::motion::NutAngle;
use crate::law::{Elements, FrictionLevel};
use crate::scene::{
    CoefficientFor, Inputs, LinearBearingTrain, LinearConstants, LinearInputs, Sliding,
    UncagedBallScrew, UncagedConstants, WithMemory, WithMemoryConstants,
};

impl<S, E, A, L, C> FrictionModel<WithMemory<S, E, A, L>, C>
where
    S: Sliding<Constants: Copy>,
    E: Elements + Copy,
    A: NutAngle + Copy,
    L: CoefficientFor<S::Inputs>,
    C: Borrow<WithMemoryConstants<S::Constants, E, A, L>>,
{
    /// Friction between two steps, after a new reading of the angle: elements follow it under the limits that the last step
    /// found. Balls, loads and the friction coefficient stay as they are until the next step, which takes the balls on by all turns
    /// since the last one, up to the scene's largest speed.
    ///
    /// For a current loop that runs faster than the balls need: a step every millisecond, this in every tick. It costs what
    /// the elements do, and some tens of cycles. Before the first step there is no friction.
    #[inline]
    pub fn between(&mut self, reading: A::Reading) -> S::Outputs {
        let constants = self.constants.borrow();
        constants.between::<S>(&mut self.state.remembered, reading)
    }

    /// Sets the law of the friction coefficient, from the next step on. [`FrictionModel::reset`] brings the configuration's back.
    pub fn set_coefficient(&mut self, law: L) -> Result<(), Error> {
        self.state.remembered.set_coefficient(law)
    }

    /// Sets friction over that of the constants, in each direction, from the next step or reading on: what an
    /// [`Adaptation`](crate::adaptation::Adaptation) has found.
    ///
    /// It scales the limits of the elements, not their stiffness: friction takes out of every motion what it stored, however often the level
    /// changes. Efficiency and regime are those of the constants' friction. Not part of an exported state; [`FrictionModel::reset`] brings 1 back.
    pub fn set_level(&mut self, level: FrictionLevel) -> Result<(), Error> {
        self.state.remembered.set_level(level)
    }

    /// Lubricant drag in the friction torque of the last step, N m, which no level scales: for
    /// [`AdaptationInputs`](crate::adaptation::AdaptationInputs). 0 before the first step.
    #[inline]
    pub fn drag_torque(&self) -> f32 {
        self.state.remembered.drag()
    }
}

impl<const N: usize, const NODES: usize, E, A, L, C>
    FrictionModel<WithMemory<UncagedBallScrew<N, NODES>, E, A, L>, C>
where
    E: Elements + Copy,
    A: NutAngle + Copy,
    L: CoefficientFor<Inputs>,
    C: Borrow<WithMemoryConstants<UncagedConstants<N, NODES>, E, A, L>>,
{
    /// Sets the nut's angle at the last reading, rad, from which the screw's deviations are counted.
    pub fn set_nut_angle(&mut self, angle: f32) {
        let scene = self.constants.borrow().scene();
        // The next step takes the balls on by the turns since the last one.
        let at_last_step = angle - self.state.remembered.moved();
        scene.set_nut_angle(&mut self.state.scene, at_last_step);
    }
}

impl<const N: usize, E, A, L, C> FrictionModel<WithMemory<LinearBearingTrain<N>, E, A, L>, C>
where
    E: Elements + Copy,
    A: NutAngle + Copy,
    L: CoefficientFor<LinearInputs>,
    C: Borrow<WithMemoryConstants<LinearConstants<N>, E, A, L>>,
{
    /// Sets the carriage's place along the rail at the last reading, m, from which the rail's deviations are counted.
    pub fn set_carriage_position(&mut self, position: f32) {
        let scene = self.constants.borrow().scene();
        let at_last_step = position - self.state.remembered.moved();
        scene.set_carriage_position(&mut self.state.scene, at_last_step);
    }
}
