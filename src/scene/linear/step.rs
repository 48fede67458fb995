//! A step of a linear bearing.

use super::{LinearConstants, LinearInputs};
use crate::ball::GrooveLoss;
use crate::math;
use crate::scene::circuit::{CircuitState, UNLOADED};
use crate::scene::contract::direction;
use crate::scene::outputs::TrainFriction;
use crate::train::FreeBall;

/// Least force of a diagonal, N: the sum of two contacts of 1e-6 N. It keeps cube roots and impedances above zero: in the bearing of
/// Lin 2019, Table 3.3, also with a friction coefficient of 1e-6 and a hundredth of the mean load.
const SMALLEST_FORCE: f32 = 2e-6;

/// Sliding friction of a linear bearing, which is the same in both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearFriction {
    /// Its parts. `load`: the normal load that would put the same sum of forces on both diagonals, N.
    pub(super) row: TrainFriction,
    pub(super) beyond_model: bool,
}

/// What all balls have in common in a tick: a ball whose weight is 1.
struct Diagonals {
    /// Speed deviation for one radian of the deviation maps, with the sign of the motion.
    turn: f32,
    /// Compliance of the ball: speed deviation over the net push, 1/N.
    compliance: f32,
    /// Impedance of the ball, N.
    impedance: f32,
    loss: GrooveLoss,
    /// Forces of the diagonals, each the sum of its two contacts, N.
    forces: [f32; 2],
    /// Half the sum and half the difference of the diagonals' forces by the loads, N.
    loads: [f32; 2],
}

impl<const N: usize> LinearConstants<N> {
    /// What a tick computes: both diagonals, every ball at its position, then how they press.
    #[inline(always)]
    pub(super) fn friction_of_balls(
        &self,
        state: &mut CircuitState<N>,
        inputs: LinearInputs,
        friction: f32,
    ) -> LinearFriction {
        let LinearInputs { speed, .. } = inputs;
        let table = self.circuit.zone.shares(false);
        let zone = &self.circuit.zone;
        let sharing = zone.sharing(state.train.positions(), table);
        let tick = self.diagonals(inputs, sharing.per_weight);
        let (passing, recirculating) = self.circuit.zone.units();
        let units = [tick.turn * passing, tick.turn * recirculating];
        let travel = self.circuit.travel(speed);
        let shares = self.take_in(state, units, tick.impedance, travel);
        let pressing = state.train.press(travel, true, |_, _| ());
        state.advance(&self.circuit, speed);

        // Where the carriage is lifted off no ball rolls, and there is nothing to flag.
        let [normal, side] = tick.loads;
        let beyond_model = normal + side.abs() > SMALLEST_FORCE
            && self
                .grooves
                .leaves_four_points(&tick.loss, pressing.largest, tick.compliance);
        // Losses and forces are in proportion to the friction coefficient, the balls' compliances to its inverse.
        let groove = friction * (tick.loss.friction * shares);
        LinearFriction {
            row: TrainFriction {
                groove,
                ball: friction * (self.rubbing * pressing.force),
                free: groove,
                ratios: [1.0; 2],
                fading: [0.0; 2],
                direction: direction(speed),
                load: sharing.weights * (tick.forces[0] + tick.forces[1]) / (2.0 * self.normal),
                contacts: pressing.contacts,
                largest_contact_force: friction * pressing.largest,
            },
            beyond_model,
        }
    }

    /// Takes in each ball by its free speed and its impedance, and gives the sum of the powers of 4/3 of their weights. Not inlined: what the
    /// rest of a step holds would take its registers.
    #[inline(never)]
    fn take_in(
        &self,
        state: &mut CircuitState<N>,
        [passing, recirculating]: [f32; 2],
        impedance: f32,
        travel: f32,
    ) -> f32 {
        let phase = state.phase();
        let table = self.circuit.zone.shares(false);
        let mut shares = 0.0;
        state.train.take_in(travel, |_, position| {
            let Some(ball) = self.circuit.zone.at(position, phase) else {
                return FreeBall::smooth(0.0, UNLOADED);
            };
            let free = recirculating * ball.recirculating + passing * ball.passing;
            let share = self.circuit.zone.share(position, table);
            let (four_thirds, two_thirds) = powers(share * ball.run_in);
            shares += four_thirds;
            FreeBall::smooth(free, at_least(impedance * two_thirds, UNLOADED))
        });
        shares
    }

    #[inline(always)]
    fn diagonals(&self, inputs: LinearInputs, per_weight: f32) -> Diagonals {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let normal = normal_load * per_weight * self.normal;
        let side = side_load * per_weight * self.side;
        let up = at_least(normal + side, SMALLEST_FORCE);
        let down = at_least(normal - side, SMALLEST_FORCE);
        let (up_root, up_squared) = math::cbrt_and_squared(up);
        let (down_root, down_squared) = math::cbrt_and_squared(down);

        // For one radian by which the angles at TR and BR grow and those at TL and BL shrink: (3.43) is linear.
        let diagonals = [up_squared, down_squared];
        let mean = self.ball.closed_form(diagonals, [1.0, -1.0]);
        let spins = [up * up_root, down * down_root];
        Diagonals {
            turn: direction(speed) * mean.speed_deviation,
            compliance: mean.compliance,
            impedance: self.ball.impedance(diagonals),
            loss: self.grooves.at([up, down], spins, normal - side.abs()),
            forces: [up, down],
            loads: [normal, side],
        }
    }
}

/// Powers of 4/3 and of 2/3 of a ball's weight.
#[inline(always)]
fn powers(weight: f32) -> (f32, f32) {
    if weight == 1.0 {
        return (1.0, 1.0);
    }
    roots(weight)
}

/// Out of line, so that balls of even loads do not pay for it.
#[inline(never)]
fn roots(weight: f32) -> (f32, f32) {
    let (root, squared) = math::cbrt_and_squared(weight);
    (weight * root, squared)
}

#[inline]
fn at_least(value: f32, bound: f32) -> f32 {
    if value > bound { value } else { bound }
}
