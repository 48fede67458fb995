//! Rows of balls at a reversal: no step where balls part, no energy out of nothing, and the reference's torque.

use epas_friction::law::coefficient::DirectionalCoefficient;
use epas_friction::law::memory::{Hysteresis, SLIP_8};
use epas_friction::law::motion::{Play, PlayState, SpeedOverTick};
use epas_friction::scene::{
    Motion, ReversalState, Sliding, WithMemory, WithMemoryConfiguration, WithMemoryState,
};
use epas_friction::{
    Faults, FrictionModel, LinearBearingConfiguration, LinearBearingTrain, LinearOutputs, Regime,
    UncagedOutputs,
};
use epas_reference::presliding::elements::Elements;
use epas_reference::presliding::row::{Row, RowMemory, Torque};
use epas_testkit::gears::linear_inputs;

use super::{BREAKAWAY, OneCoefficient, Slip, TICK, at, caged_by_angle, fresh, screw, slip_by};
use epas_testkit::gears::{
    CROWD, LINEAR_BALLS, UncagedConfiguration, UncagedScrew, crowded, linear,
};
use epas_testkit::random::Random;

type Memory<S> = WithMemory<S, Slip, SpeedOverTick, OneCoefficient>;
type Screw = UncagedScrew<CROWD>;
type Bearing = LinearBearingTrain<LINEAR_BALLS>;

struct Both<S: Sliding<Constants: Copy, State: Copy>> {
    model: FrictionModel<Memory<S>>,
    constants: S::Constants,
    reference: RowMemory,
    /// The scene's play, whose travel has the scene's bits.
    play: (Play, PlayState),
    coefficient: f32,
    tick: f32,
    elements: Slip,
    /// Limit and breakaway of the elements.
    limit: f64,
    breakaway: f64,
    outputs: Option<[S::Outputs; 2]>,
    parts: fn(&S::Outputs) -> [f32; 2],
}

#[derive(Clone, Copy, Debug)]
struct Seen {
    turn: f64,
    torque: f64,
    ball: f64,
    expected: Torque,
    row: Row,
    direction: f64,
    travel: f64,
}

impl<S> Both<S>
where
    S: Sliding<Constants: Copy, State: Copy, Configuration: Copy>,
{
    fn new(
        configuration: S::Configuration,
        (coefficient, tick): (f32, f32),
        (limit, breakaway): (f32, f32),
        parts: fn(&S::Outputs) -> [f32; 2],
    ) -> Self {
        let elements = slip_by(limit, breakaway);
        let sensor = SpeedOverTick::new(tick, 1.0).unwrap();
        let with =
            WithMemoryConfiguration::new(configuration, coefficient, elements, sensor, 1000.0);
        let table =
            |number: fn(usize) -> f32| (0..8).map(|at| f64::from(number(at))).collect::<Vec<_>>();
        let angles = table(|at| SLIP_8.elements[at].angle);
        let shares = table(|at| SLIP_8.elements[at].weight);
        Self {
            model: FrictionModel::new(&with.unwrap()).unwrap(),
            constants: S::constants(&configuration).unwrap(),
            reference: RowMemory::new(
                Elements::proportional(&angles, &shares),
                f64::from(elements.breakaway() / breakaway),
            ),
            play: (Play::new(elements.breakaway()).unwrap(), PlayState::FRESH),
            coefficient,
            tick,
            elements,
            limit: limit.into(),
            breakaway: breakaway.into(),
            outputs: None,
            parts,
        }
    }

    fn step(&mut self, load: S::Inputs, speed: f32) -> Seen {
        let Self {
            constants,
            tick,
            limit,
            breakaway,
            parts,
            ..
        } = *self;
        let WithMemoryState { scene, .. } = *self.model.state();
        let coefficients = DirectionalCoefficient {
            forward: self.coefficient,
            backward: self.coefficient,
        };
        let turn = speed * tick;
        let (play, at_play) = &mut self.play;
        let travel = play.follow(at_play, turn).turn;
        let turn = f64::from(turn) / breakaway;
        let (mut seen, mut sliding_outputs) = (None, None);
        let expected = self.reference.follow(turn, |direction, travelled| {
            // Where balls do not move the scene takes a creep in their last direction.
            let going = if travel == 0.0 {
                1e-9 * direction as f32
            } else {
                travel * (1.0 / tick)
            };
            let inputs = load.with(going, 1.0);
            let mut balls = scene;
            let sliding = S::sliding_friction(&constants, &mut balls, inputs, coefficients);
            let [with, against] = [direction, -direction].map(|factor| {
                let reversal = ReversalState {
                    factor: factor as f32,
                    carried: 1.0,
                    direction: direction as f32,
                    standing: false,
                };
                S::outputs_at(&constants, inputs, &sliding, reversal, 0.0, Faults::NONE)
            });
            sliding_outputs = Some(with);
            let [with, against] = [with, against]
                .map(|outputs| parts(&outputs).map(|part| f64::from(part.abs()) / limit));
            let row = Row {
                groove: with[0],
                ball: with[1],
                free: against[0],
                load: S::by_direction(&sliding).load.into(),
            };
            seen = Some((row, direction, travelled));
            row
        });
        let (row, direction, travel) = seen.unwrap();
        let outputs = self.model.step(at(load.with(speed, 1.0), speed, 313.15));
        self.outputs = sliding_outputs.map(|row| [outputs, row]);
        let [groove, ball] = parts(&outputs).map(|part| f64::from(part) / limit);
        Seen {
            turn,
            torque: groove + ball,
            ball,
            expected,
            row,
            direction,
            travel,
        }
    }

    fn energy(&self) -> f64 {
        let stored = self
            .elements
            .stored_energy(&self.model.state().remembered.elements);
        f64::from(stored) / (self.limit * self.breakaway)
    }
}

fn screw_of(tick: f32) -> Both<Screw> {
    let configuration = UncagedConfiguration { tick, ..crowded() };
    Both::new(
        configuration,
        (configuration.folded.friction, tick),
        (0.2, BREAKAWAY),
        |outputs: &UncagedOutputs| [outputs.groove_torque, outputs.ball_torque],
    )
}

fn bearing_of(tick: f32) -> Both<Bearing> {
    let configuration = LinearBearingConfiguration {
        return_length: 0.0402,
        ball_friction: 0.3,
        tick,
        ..linear()
    };
    Both::new(
        configuration,
        (configuration.friction, tick),
        (100.0, 1e-4),
        |outputs: &LinearOutputs| [outputs.groove_force, outputs.ball_force],
    )
}

#[derive(Debug, Default)]
struct Found {
    /// Times at which balls turned round, and those of them at which what pressed was a twentieth of the friction or more.
    reversals: u32,
    pressing: u32,
    /// Largest part of the friction that pressed then.
    part: f64,
    /// Largest change of the torque in a tick over what turn and sliding friction let it change.
    step: f64,
    /// Largest difference of torque and torque between balls from the reference's, over the friction.
    error: f64,
}

impl Found {
    fn add(&mut self, last: &Seen, seen: &Seen) {
        let full = seen.row.groove + seen.row.ball;
        let error = (seen.torque - seen.expected.groove - seen.expected.ball).abs();
        let of_balls = (seen.ball - seen.expected.ball).abs();
        self.error = self.error.max(error.max(of_balls) / full);
        // A backbone begins with the slope 1.5. Rounding: a few 2^-24 of the friction.
        // What fades does so by the friction with each half of the play.
        let mut smooth = 1.5 * seen.turn.abs() + seen.travel.abs() * full + 1e-6 * full;
        if last.direction == seen.direction {
            let before = last.row.groove + last.row.ball;
            let changes = [full - before, seen.row.free - last.row.free];
            smooth += changes[0].abs().max(changes[1].abs());
        } else {
            self.reversals += 1;
            self.pressing += u32::from(last.row.ball > 0.05 * full);
            self.part = self.part.max(last.row.ball / full);
        }
        self.step = self.step.max((seen.torque - last.torque).abs() / smooth);
    }
}

fn to_and_fro<S>(
    mut both: Both<S>,
    load: S::Inputs,
    fast: f32,
    random: &mut Random,
    found: &mut Found,
) where
    S: Sliding<Constants: Copy, State: Copy, Configuration: Copy>,
{
    let run_in = (0.5 / both.tick) as u32;
    let largest = f64::from(fast) * random.between(0.0, 1.0).powi(2);
    let period = random.between(40.0, 400.0);
    let other = random.between(2.0, 4.0);
    let mut last = both.step(load, fast);
    for number in 0..run_in + 1500 {
        let speed = if number < run_in {
            fast
        } else {
            let phase = f64::from(number - run_in) / period;
            (0.5 * largest * (phase.cos() + (other * phase).cos())) as f32
        };
        let seen = both.step(load, speed);
        found.add(&last, &seen);
        last = seen;
    }
}

/// Balls that press part in the tick in which they turn round. By then the grooves carry nothing of what pressed: in that tick the torque
/// changes by no more than the elements' stiffness and the fading let it with the turn, at any amplitude, load and tick. It is that of the reference.
#[test]
fn nothing_steps_where_balls_turn_round() {
    let mut random = Random(48);
    let mut found = Found::default();
    for _ in 0..100 {
        let tick = 5e-5 * 20.0_f32.powf(random.unit());
        let load = screw(0.0, random.sign() * 200.0 * 100.0_f32.powf(random.unit()));
        to_and_fro(screw_of(tick), load, 90.0, &mut random, &mut found);
    }
    let mut bearing = Found::default();
    for _ in 0..60 {
        let load = linear_inputs(0.0, 100.0 * 50.0_f32.powf(random.unit()), 20.0);
        let tick = 5e-5 * 20.0_f32.powf(random.unit());
        to_and_fro(bearing_of(tick), load, 2.0, &mut random, &mut bearing);
    }
    assert!(found.pressing > 60 && found.part > 0.2, "{found:?}");
    assert!(bearing.pressing > 10 && bearing.part > 0.08, "{bearing:?}");
    for found in [found, bearing] {
        assert!(found.step <= 1.0, "{found:?}");
        assert!(found.error < 2e-6, "{found:?}");
    }
}

/// Work in a tick is no less than what the elements store of it: over a closed path work is not negative, whatever path and load.
#[test]
fn a_row_makes_no_energy() {
    fn check<S>(mut both: Both<S>, loads: impl Fn(&mut Random) -> S::Inputs, fast: f32)
    where
        S: Sliding<Constants: Copy, State: Copy, Configuration: Copy>,
    {
        let mut random = Random(3);
        let mut load = loads(&mut random);
        let (mut speed, mut stored, mut work, mut least) = (fast, 0.0, 0.0, 0.0_f64);
        for number in 0..40_000 {
            if number > 2000 {
                if random.one_in(20) {
                    load = loads(&mut random);
                }
                if random.one_in(30) {
                    // From a hundredth of the play to the largest speed.
                    speed = fast * random.sign() * 1e-4_f32.powf(random.unit());
                }
            }
            let seen = both.step(load, speed);
            let done = seen.torque * seen.turn;
            let now = both.energy();
            least = least.min((done - (now - stored)) / (1e-3 + done.abs() + now));
            stored = now;
            work += done;
            assert!(work >= -1e-6, "{number}: {work}");
        }
        // Rounding of torque and stored energy: some 2^-24.
        assert!(least > -2e-6, "{least}");
    }
    let screw_load =
        |random: &mut Random| screw(0.0, random.sign() * 100.0 * 200.0_f32.powf(random.unit()));
    check(screw_of(5e-4), screw_load, 90.0);
    let bearing_load =
        |random: &mut Random| linear_inputs(0.0, 100.0 * 50.0_f32.powf(random.unit()), 20.0);
    check(bearing_of(1e-4), bearing_load, 2.0);
}

#[test]
fn steady_sliding_is_the_row_to_the_bit() {
    let mut both = screw_of(5e-4);
    let mut pressing = 0;
    for (speed, load) in [
        (90.0, 3000.0),
        (-60.0, 3000.0),
        (-60.0, -500.0),
        (30.0, 8000.0),
    ] {
        for number in 0..1500 {
            both.step(screw(0.0, load), speed);
            if number >= 100 {
                let [outputs, row] = both.outputs.unwrap();
                assert_eq!(outputs, row, "{speed} rad/s, {load} N, tick {number}");
                pressing += u32::from(outputs.ball_torque != 0.0);
            }
        }
    }
    assert!(pressing > 2000, "{pressing}");
}

/// Where the nut does not stand, friction has the sign of the turn, and regime and efficiency are those of the motion under the load; where
/// friction still has the old sign after a reversal there is no efficiency.
#[test]
fn efficiency_is_of_the_motion_after_a_reversal() {
    let mut model = caged_by_angle();
    let mut random = Random(7);
    let (mut angle, mut speed, mut load) = (0.0_f32, 5.0_f32, 3000.0_f32);
    let (mut old_sign, mut moves) = (0, [0; 2]);
    for _ in 0..20_000 {
        if random.one_in(40) {
            speed = -speed.signum() * 10.0_f32.powf(3.0 * random.unit() - 1.5);
        }
        if random.one_in(100) {
            load = -load;
        }
        let before = angle;
        angle += speed * TICK;
        let turn = angle - before;
        angle = if angle.abs() > 3.0 { 0.0 } else { angle };
        let outputs = model.step(fresh(screw(speed, load), before + turn));
        if angle == 0.0 {
            model.between(0.0);
        }
        let (friction, opposing) = (outputs.friction_torque, turn * outputs.load_torque);
        if friction * turn < 0.0 {
            old_sign += 1;
            assert_eq!(outputs.regime, Regime::Standing, "{outputs:?}");
        }
        if outputs.regime == Regime::Standing {
            assert_eq!(outputs.efficiency, 0.0, "{outputs:?}");
            continue;
        }
        let size = outputs.load_torque.abs();
        let (regime, efficiency) = if opposing > 0.0 {
            (Regime::Driving, size / (size + friction.abs()))
        } else {
            (Regime::BackDriving, 1.0 - friction.abs() / size)
        };
        moves[usize::from(opposing > 0.0)] += 1;
        assert_eq!(outputs.regime, regime, "{turn} {outputs:?}");
        assert!(
            (outputs.efficiency - efficiency).abs() < 2e-7,
            "{outputs:?}"
        );
    }
    assert!(
        old_sign > 100 && moves.iter().all(|&ticks| ticks > 1000),
        "{old_sign} {moves:?}"
    );
}
