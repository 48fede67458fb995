//! Every tick is as exact as any other: the first one, and those that follow a reversal and steps of the load. At 1 kHz, from 3 to 60 rad/s,
//! each tick against the exact ring of balls at the same places.

use epas_friction::scene::FoldedBall;
use epas_friction::{Clearance, LoadShares, UncagedBallScrewConfiguration};
use epas_reference::promises;
use epas_testkit::gears::screw_inputs;

use super::exact::{BALLS, Beside, Found, PLAIN, PRELOADED, RANGE, TICK, oversize, screw, uneven};
use epas_testkit::errors::Errors;
use epas_testkit::measured;

/// What happens, in order: each is compared in its first ticks.
const EVENTS: [&str; 4] = [
    "start",
    "reversal",
    "load step of +50 %",
    "load step to ten times",
];

/// Ticks of an event that may be compared, the first of which is that in which it happens.
const COMPARED: u32 = 30;

const SAMPLE: u32 = 6;

const TURN: f32 = 1.0;

#[derive(Clone, Copy)]
struct Case<const NODES: usize> {
    screw: UncagedBallScrewConfiguration<NODES>,
    clearance: Clearance,
    friction: f32,
    speed: f32,
    load: f32,
}

impl<const NODES: usize> Case<NODES> {
    fn line(&self) -> String {
        format!(
            "friction {}, between balls {}, {} rad/s, {} N a ball",
            self.friction, self.screw.ball_friction, self.speed, self.load
        )
    }

    /// The screw through all events: it starts and turns round under the load, which then grows by half, and from a fifth to ten times
    /// this.
    fn through_events(&self, stride: u32) -> [Found; 4] {
        let Self { speed, load, .. } = *self;
        let mut beside = Beside::new(self.screw, self.clearance);
        beside.set_friction(self.friction);
        let inputs =
            |direction: f32, load: f32| screw_inputs(direction * speed, load * BALLS as f32);
        let events = [
            (inputs(1.0, load), inputs(1.0, load)),
            (inputs(1.0, load), inputs(-1.0, load)),
            (inputs(-1.0, load), inputs(-1.0, 1.5 * load)),
            (inputs(-1.0, 0.2 * load), inputs(-1.0, 2.0 * load)),
        ];
        let mut turn = 0.0;
        std::array::from_fn(|event| {
            let (before, after) = events[event];
            for _ in 0..(turn / (speed.abs() * TICK)) as u32 {
                beside.run(before);
            }
            turn = TURN;
            let mut found = Found::default();
            for tick in 0..COMPARED {
                if tick % stride != 0 {
                    beside.run(after);
                    continue;
                }
                let pair = beside.step(after);
                found.add(&pair, || {
                    format!("{}, {}, tick {tick}", self.line(), EVENTS[event])
                });
            }
            found
        })
    }
}

/// All ticks of some cases. In each event by itself the ticks are within what is accepted of all: none is worse than the whole.
///
/// Where two balls meet within a tick the crate lets them press with the part of their force that the tick has left, and the exact ring, which
/// stands where the tick begins, not at all: these ticks count by themselves, and their share is printed.
fn all_events<const NODES: usize>(name: &str, cases: &[Case<NODES>], stride: u32) -> Found {
    let mut by_event = [(); 4].map(|()| Found::default());
    for case in cases {
        for (sum, found) in by_event.iter_mut().zip(&case.through_events(stride)) {
            sum.join(found);
        }
    }
    let mut all = Found::default();
    for (event, found) in EVENTS.iter().zip(&by_event) {
        found.print(&format!("{name}, {event}"));
        assert!(found.pressing > found.ticks / 2, "{name}, {event}");
        all.join(found);
    }
    all.print(name);
    assert!(all.meeting < all.ticks / 3 && all.flagged < all.ticks / 3);
    let worst = |errors: fn(&Found) -> &Errors| -> [f64; 3] {
        by_event.iter().map(errors).fold([0.0; 3], |most, errors| {
            let figures = [errors.largest, errors.rms(), errors.mean().abs()];
            std::array::from_fn(|at| most[at].max(figures[at]))
        })
    };
    let of = |errors: &Errors| [errors.largest, errors.rms(), errors.mean().abs()];
    let figures = [
        ("torque", of(&all.torque_apart)),
        ("torque of an event", worst(|found| &found.torque_apart)),
        ("torque, ticks with a meeting too", of(&all.torque)),
        ("forces", of(&all.forces_apart)),
        ("forces of an event", worst(|found| &found.forces_apart)),
    ];
    for (what, figures) in figures {
        let [largest, rms, mean] = figures;
        println!("{name}: {what} [{largest:.2e}, {rms:.2e}, {mean:.2e}]");
    }
    for (what, figures) in figures {
        let accepted = measured::of(&format!("{name}: {what}")).accepted();
        let mut both = figures.iter().zip(&accepted);
        let held = both.all(|(found, accepted)| found <= accepted);
        assert!(held, "{name}: {what} {figures:?}, {accepted:?}");
    }
    all
}

/// Both directions, both signs of the load, slow and fast: speed, rad/s, and load, N a ball.
const QUADRANTS: [(f32, f32); 4] = [
    (10.0, 100.0),
    (60.0, -110.0),
    (-3.0, 140.0),
    (-30.0, -140.0),
];

fn cases(
    folded: &'static FoldedBall,
    ball_friction: f32,
    clearance: Clearance,
    (load_shares, part): (LoadShares, f32),
) -> Vec<Case<1>> {
    QUADRANTS
        .into_iter()
        .map(|(speed, load)| Case {
            screw: UncagedBallScrewConfiguration {
                load_shares,
                ..screw(folded, ball_friction)
            },
            clearance,
            friction: folded.friction,
            speed,
            load: part * load,
        })
        .collect()
}

const EVEN: (LoadShares, f32) = (LoadShares::EVEN, 1.0);

fn ticks_of_even_loads(stride: u32) {
    let of = |ball_friction| cases(&PLAIN, ball_friction, Clearance::ZERO, EVEN);
    let mut found = all_events("even loads, smooth balls", &of(0.0), stride);
    found.join(&all_events("even loads, rubbing balls", &of(0.1), stride));
    found
        .torque_apart
        .assert_promised(promises::of("step_uncaged"));
}

fn ticks_of_own_loads(stride: u32) {
    let of = |ball_friction| cases(&PLAIN, ball_friction, Clearance::ZERO, (uneven(), 0.7));
    let mut found = all_events("own loads, smooth balls", &of(0.0), stride);
    found.join(&all_events("own loads, rubbing balls", &of(0.1), stride));
    found
        .torque_apart
        .assert_promised(promises::of("step_uncaged_shares"));
}

fn ticks_with_preload(stride: u32) {
    let cases = cases(&PRELOADED, 0.1, oversize(), EVEN);
    let found = all_events("preload, rubbing balls", &cases, stride);
    found
        .torque_apart
        .assert_promised(promises::of("step_uncaged"));
}

fn ticks_between_nodes(stride: u32) {
    let range: &'static FoldedBall<3> = &RANGE;
    let [low, middle, high] = range.law.frictions();
    let cases: Vec<_> = QUADRANTS
        .into_iter()
        .zip([
            (low * middle).sqrt(),
            (middle * high).sqrt(),
            1.02 * low,
            1.2 * middle,
        ])
        .zip([0.1, 0.1, 0.0, 0.0])
        .map(|(((speed, load), friction), ball_friction)| Case {
            screw: screw(range, ball_friction),
            clearance: Clearance::ZERO,
            friction,
            speed,
            load,
        })
        .collect();
    let found = all_events("between nodes", &cases, stride);
    found
        .torque_apart
        .assert_promised(promises::of("step_uncaged_range"));
}

#[test]
fn ticks_of_even_loads_regression() {
    ticks_of_even_loads(SAMPLE);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn ticks_of_even_loads_regression_whole() {
    ticks_of_even_loads(1);
}

#[test]
fn ticks_of_own_loads_regression() {
    ticks_of_own_loads(SAMPLE);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn ticks_of_own_loads_regression_whole() {
    ticks_of_own_loads(1);
}

#[test]
fn ticks_with_preload_regression() {
    ticks_with_preload(SAMPLE);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn ticks_with_preload_regression_whole() {
    ticks_with_preload(1);
}

#[test]
fn ticks_between_nodes_regression() {
    ticks_between_nodes(SAMPLE);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn ticks_between_nodes_regression_whole() {
    ticks_between_nodes(1);
}
