//! Laws of a screw without cage, tick by tick: balances of the balls, where the torque comes from, mirrors, and what is no matter.

use epas_testkit::gears::screw_inputs;

use epas_friction::ball::pressed::{
    BallNumbers, FreeMotion, NeighbourNumbers, RUBBINGS, RowConstants, RubbedNode,
};
use epas_friction::{
    Faults, FrictionModel, Inputs, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};

use epas_testkit::gears::{self, BALL, SCREW_BALLS, screw_wave, wave};
use epas_testkit::measured;

const TICK: f32 = 1e-3;

type Model = FrictionModel<UncagedBallScrew<SCREW_BALLS>>;

fn inputs(nut_speed: f32, axial_load: f32) -> Inputs {
    screw_inputs(nut_speed, axial_load)
}

/// Two turns that 37 balls fill, with waves on screw and nut.
fn configuration(ball_friction: f32) -> UncagedBallScrewConfiguration {
    UncagedBallScrewConfiguration {
        ball_friction,
        nut_deviation: wave(1, 3, 0.0, 0.9 * BALL.law.deviations[1]),
        ..gears::full(screw_wave(0.9), TICK)
    }
}

struct Tick {
    outputs: UncagedOutputs,
    load: f32,
    branch: usize,
    numbers: BallNumbers,
    free: Vec<FreeMotion>,
    /// What neighbours change, the chord, friction coefficient times load, N, and deviations over the largest.
    neighbours: NeighbourNumbers,
    row: RowConstants,
    sliding: f64,
    deviations: Vec<[f32; 2]>,
    speeds: Vec<f64>,
    forces: Vec<f64>,
    /// Whether two balls have met in it.
    meets: bool,
}

/// A tick with what the law says of every ball where it began. The deviations are those of a crate's map, of which nothing is said here.
fn tick(
    model: &mut Model,
    configuration: &UncagedBallScrewConfiguration,
    inputs: Inputs,
    angle: f64,
) -> Tick {
    let law = &configuration.folded.law;
    let way = inputs.nut_speed.signum();
    let train = &model.state().circuit.train;
    let gaps: Vec<f32> = train.gaps().collect();
    let load = law.load_of(inputs.axial_load / SCREW_BALLS as f32);
    let branch = usize::from(way * inputs.axial_load < 0.0);
    let numbers = law.numbers(load, branch, law.interval(configuration.folded.friction));
    let turns = f64::from(configuration.turns);
    let deviations: Vec<[f32; 2]> = train
        .positions()
        .map(|position| {
            let place = f64::from(position) / 2_f64.powi(32) * turns;
            let phase = |turns: f64| (turns.rem_euclid(1.0) * 2_f64.powi(32)) as u32;
            let screw = configuration
                .screw_deviation
                .at(phase(place + angle / std::f64::consts::TAU));
            let nut = configuration.nut_deviation.at(phase(place));
            [
                way * screw / law.deviations[0],
                way * nut / law.deviations[1],
            ]
        })
        .collect();
    let interval = law.interval(configuration.folded.friction);
    let row = configuration.folded.row(configuration.ball_friction);
    let neighbours = law
        .neighbours(load, branch, interval, &numbers, row)
        .numbers;
    let outputs = model.step(inputs);
    let train = &model.state().circuit.train;
    let forces: Vec<f64> = train.forces().map(f64::from).collect();
    // The list of contacts has each pair that presses, at its rear ball.
    let contacts = train.contacts();
    assert_eq!(contacts.len(), usize::from(outputs.contacts));
    for contact in &contacts {
        let ball = usize::from(contact.ball);
        assert!(contact.force > 0.0 && f64::from(contact.force) == forces[ball]);
        assert_eq!(train.positions().nth(ball), Some(contact.position));
    }
    Tick {
        outputs,
        load: inputs.axial_load / SCREW_BALLS as f32,
        branch,
        numbers,
        free: deviations.iter().map(|at| numbers.at(*at)).collect(),
        neighbours,
        row,
        sliding: f64::from(law.sliding(load, interval)),
        deviations,
        speeds: train.speeds().map(f64::from).collect(),
        meets: forces
            .iter()
            .zip(&gaps)
            .any(|(force, gap)| *force > 0.0 && *gap > 1e-9),
        forces,
    }
}

fn ticks(ball_friction: f32, mut check: impl FnMut(&Tick, f32)) {
    let configuration = configuration(ball_friction);
    let mut model = Model::new(&configuration).unwrap();
    let mut angle = 0.0;
    for (speed, load) in [
        (10.0, 4000.0),
        (10.0, -3000.0),
        (-30.0, -3000.0),
        (-30.0, 5000.0),
    ] {
        for _ in 0..300 {
            let found = tick(&mut model, &configuration, inputs(speed, load), angle);
            angle += f64::from(speed) * f64::from(TICK);
            check(&found, speed.signum());
        }
    }
}

impl Tick {
    fn neighbours_of(&self, ball: usize) -> ([f64; 2], f64) {
        let behind = self.forces[(ball + SCREW_BALLS - 1) % SCREW_BALLS];
        let ahead = self.forces[ball];
        let rubbing = f64::from(self.row.ball_friction) * (behind + ahead) / self.sliding;
        ([behind, ahead], rubbing)
    }

    /// A number of the law that goes with the friction, of a ball: linear between its nodes, and in proportion beyond them.
    fn by_rubbing(&self, of: fn(&RubbedNode) -> &[f32; 3], ball: usize) -> f64 {
        let (_, rubbing) = self.neighbours_of(ball);
        let nodes = self.neighbours.nodes.map(|node| self.line(of(&node), ball));
        let [first, second, third] = RUBBINGS.map(f64::from);
        let between = |share: f64, low: f64, high: f64| low + share * (high - low);
        if rubbing < first {
            between(rubbing / first, 0.0, nodes[0])
        } else if rubbing < second {
            between((rubbing - first) / (second - first), nodes[0], nodes[1])
        } else if rubbing < third {
            between((rubbing - second) / (third - second), nodes[1], nodes[2])
        } else {
            rubbing / third * nodes[2]
        }
    }

    fn line(&self, [a, screw, nut]: &[f32; 3], ball: usize) -> f64 {
        let [s, n] = self.deviations[ball].map(f64::from);
        f64::from(*a) + s * f64::from(*screw) + n * f64::from(*nut)
    }
}

/// Every ball is in balance: the push of its neighbours is what changes its speed, and what their friction and their outward force take. Without
/// friction that is solved; with friction two passes leave an error of the second order.
#[test]
fn every_ball_is_in_balance() {
    for (ball_friction, name) in [
        (0.0, "screw without cage, balance of a ball"),
        (0.1, "screw without cage, balance of a rubbed ball"),
    ] {
        let mut pressing = 0;
        ticks(ball_friction, |tick, way| {
            let largest = tick.forces.iter().copied().fold(0.0, f64::max);
            let held = f64::from(tick.numbers.held_speed());
            for ball in 0..SCREW_BALLS {
                let ([behind, ahead], _) = tick.neighbours_of(ball);
                let free = &tick.free[ball];
                let speed = f64::from(way) * tick.speeds[ball];
                let alone = f64::from(free.impedance) * (speed - f64::from(free.speed));
                let rubbed = tick.sliding
                    * (tick.by_rubbing(|node| &node.push, ball)
                        + tick.by_rubbing(|node| &node.impedance, ball) * (speed - held));
                let outward = tick.line(&tick.neighbours.outward, ball) * (behind + ahead);
                let needed = f64::from(way) * (alone + rubbed + outward);
                // Places on a map to 2^-20 of a period change a free speed; forces add up to a cluster's roundings.
                let size = largest + f64::from(free.impedance) * 0.01;
                measured::assert(name, (behind - ahead - needed) / size);
            }
            pressing += u32::from(tick.outputs.contacts);
        });
        assert!(pressing > 1000, "{pressing}");
    }
}

/// A ball whose neighbours rub on it with more than 0.45 `mu W` is flagged, and only this where the law holds all else.
#[test]
fn balls_that_rub_hard_are_flagged() {
    let law = &BALL.law;
    let friction = law.interval(BALL.friction);
    let [mut hard, mut lightly] = [0, 0];
    for ball_friction in [0.0, 0.1, 0.3, 0.6] {
        ticks(ball_friction, |tick, _| {
            let load = law.load_of(tick.load);
            let over = (0..SCREW_BALLS)
                .map(|ball| tick.neighbours_of(ball).1)
                .fold(0.0, f64::max);
            let flagged = tick.outputs.faults.contains(Faults::BEYOND_MODEL);
            let forces_held =
                tick.outputs.contacts == 0 || law.holds_forces(load, tick.branch, friction);
            let forces_flagged = tick.outputs.faults.contains(Faults::FORCES_NOT_HELD);
            assert_eq!(forces_flagged, !forces_held, "{over}");
            if over > 0.4501 {
                assert!(flagged, "{over}");
                hard += 1;
            } else if over < 0.4499 {
                assert!(!flagged, "{over}");
                lightly += u32::from(over > 0.0);
            }
        });
    }
    assert!(hard > 300 && lightly > 300, "{hard} {lightly}");
}

/// The torque is what the balls lose: each in its grooves at its speed, and what their neighbours add; forces between them do no work, but in
/// a tick in which two of them meet.
#[test]
fn the_torque_is_what_the_balls_lose() {
    let half_speed = 0.5 * f64::from(BALL.speed);
    for ball_friction in [0.0, 0.1] {
        ticks(ball_friction, |tick, way| {
            let mut torque = 0.0;
            for (ball, free) in tick.free.iter().enumerate() {
                let x = f64::from(way) * tick.speeds[ball] - f64::from(free.speed);
                let push = f64::from(free.impedance) * x;
                let ([behind, ahead], _) = tick.neighbours_of(ball);
                torque += f64::from(free.torque)
                    + (f64::from(tick.numbers.slope)
                        + half_speed * f64::from(tick.numbers.work) * push)
                        * x
                    + tick.sliding * tick.by_rubbing(|node| &node.torque, ball)
                    + f64::from(tick.neighbours.outward_torque) * (behind + ahead);
            }
            let found = f64::from(way * tick.outputs.friction_torque);
            measured::assert(
                "screw without cage, losses of all balls",
                found / torque - 1.0,
            );
            if ball_friction == 0.0 {
                assert_eq!(tick.outputs.ball_torque, 0.0);
            }
            let work: f64 = (0..SCREW_BALLS)
                .map(|ball| {
                    tick.forces[ball] * (tick.speeds[(ball + 1) % SCREW_BALLS] - tick.speeds[ball])
                })
                .sum();
            if !tick.meets {
                // Balls that press are equally fast: to the last digit of a speed of a hundredth.
                let most = 1e-8 * tick.forces.iter().sum::<f64>();
                assert!(work.abs() <= most, "{work} {most}");
            }
        });
    }
}
