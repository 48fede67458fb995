//! One tick of a screw without cage beside the exact ring of balls at the same places, under the same load: torque and every force.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use epas_design::{CagedDesign, UncagedDesign, UncagedFold};
use epas_friction::scene::FoldedBall;
use epas_friction::{
    BallScrew, Clearance, DISSERTATION_DESIGNS, DeviationMap, FrictionModel, Inputs, Limits,
    LoadShare, LoadShares, RollingResistance, UncagedBallScrew, UncagedBallScrewConfiguration,
};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ring::{
    ElasticRing, GrooveDeviation, RingSample, RingState,
};
use epas_reference::friction::patch::Integration;

use epas_testkit::errors::Errors;
use epas_testkit::folded;
use epas_testkit::gears::wave;
use epas_testkit::given;

pub const BALLS: usize = 16;

pub const TICK: f32 = 1e-3;

/// Largest deviations of screw and nut, rad.
pub const DEVIATIONS: [f32; 2] = [0.017_453_3, 0.008_726_65];

/// Gap below which balls touch, m: the crate's places have a resolution of 2e-11 m.
const TOUCHING: f64 = 1e-9;

/// Share of a ball's load below which the largest force of a state is taken as that share.
const SMALL: f64 = 1e-2;

pub fn design() -> BallScrew {
    BallScrew::new(DISSERTATION_DESIGNS[1].parameters).unwrap()
}

pub fn exact_design() -> BallScrewDesign {
    given::ball_screw(design().parameters())
}

/// What a host folds of it: 10 to 300 N a ball, without rolling resistance, which the ring of the reference has not.
pub fn fold(clearance: Clearance, friction: Option<[f32; 2]>) -> UncagedFold {
    let gear = CagedDesign {
        design: design(),
        friction: 0.1,
        rolling_resistance: RollingResistance::NONE,
        clearance,
        loaded_balls: BALLS as u16,
        reversal_speed: 1e-6,
        limits: Limits {
            nut_speed: 100.0,
            axial_load: 20_000.0,
            friction_torque: 100.0,
        },
    };
    UncagedFold {
        friction,
        axial_load: [10.0, 300.0],
        ..UncagedFold::of(UncagedDesign {
            gear,
            deviations: DEVIATIONS,
        })
    }
}

/// Oversize with which each contact of a ball is pressed with 15 N.
pub fn oversize() -> Clearance {
    Clearance::of_preload(&design(), 15.0).unwrap()
}

pub fn folds() -> [UncagedFold; 3] {
    [
        fold(Clearance::ZERO, None),
        fold(oversize(), None),
        fold(Clearance::ZERO, Some([0.075, 0.15])),
    ]
}

/// Balls without play and preload, for a friction coefficient of 0.1.
pub static PLAIN: LazyLock<FoldedBall> = LazyLock::new(|| folded::uncaged(&folds()[0]));

pub static PRELOADED: LazyLock<FoldedBall> = LazyLock::new(|| folded::uncaged(&folds()[1]));

/// Balls without play and preload, for friction coefficients of 0.075 to 0.15.
pub static RANGE: LazyLock<FoldedBall<3>> = LazyLock::new(|| folded::uncaged(&folds()[2]));

/// A screw that [`BALLS`] nearly fill, with waves as large as was folded for on both grooves.
pub fn screw<const NODES: usize>(
    folded: &'static FoldedBall<NODES>,
    ball_friction: f32,
) -> UncagedBallScrewConfiguration<NODES> {
    UncagedBallScrewConfiguration {
        folded,
        ball_friction,
        balls: BALLS as u16,
        turns: 0.8463,
        return_length: 0.0,
        screw_deviation: wave(1, 3, 0.0, DEVIATIONS[0]),
        nut_deviation: wave(1, 2, DEVIATIONS[1], 0.0),
        load_shares: LoadShares::EVEN,
        tick: TICK,
    }
}

/// Loads of the balls over their mean, 0.7 to 1.4, another table for each sign.
pub fn uneven() -> LoadShares {
    let table = |shares: [f32; 4]| -> &'static [LoadShare] {
        Box::leak(Box::new(shares.map(|share| LoadShare::new(share).unwrap())))
    };
    LoadShares {
        positive: table([1.4, 1.0, 0.7, 0.9]),
        negative: table([0.8, 0.7, 1.1, 1.4]),
    }
}

/// A map of the crate along a groove, from an azimuth on, for the reference: values so close that lines between them are the map's lines.
fn along(map: &DeviationMap, from: f64) -> GrooveDeviation {
    const VALUES: usize = 8192;
    let turns = f64::from(map.turns());
    let values = (0..VALUES)
        .map(|at| {
            let periods = at as f64 / VALUES as f64 + from / (TAU * turns);
            f64::from(map.at((periods.rem_euclid(1.0) * 2_f64.powi(32)) as u32))
        })
        .collect();
    GrooveDeviation::Samples { turns, values }
}

pub struct Beside<const NODES: usize> {
    configuration: UncagedBallScrewConfiguration<NODES>,
    clearance: Clearance,
    friction: f32,
    pub model: FrictionModel<UncagedBallScrew<BALLS, NODES>>,
    nut_angle: f64,
}

pub struct Pair {
    pub torque: f64,
    pub flagged: bool,
    pub forces: Vec<f64>,
    /// Whether two balls meet within this tick: until then the exact ones press on no other, and the crate's with a part of the force.
    pub meeting: bool,
    pub exact: RingState,
    pub exact_forces: Vec<f64>,
    load: f64,
}

impl<const NODES: usize> Beside<NODES> {
    pub fn new(configuration: UncagedBallScrewConfiguration<NODES>, clearance: Clearance) -> Self {
        Self {
            model: FrictionModel::new(&configuration).unwrap(),
            friction: configuration.folded.friction,
            configuration,
            clearance,
            nut_angle: 0.0,
        }
    }

    pub fn set_friction(&mut self, friction: f32) {
        self.model.set_friction(friction).unwrap();
        self.friction = friction;
    }

    pub fn run(&mut self, inputs: Inputs) {
        let _ = self.model.step(inputs);
        self.nut_angle += f64::from(inputs.nut_speed) * f64::from(TICK);
    }

    pub fn step(&mut self, inputs: Inputs) -> Pair {
        let train = &self.model.state().circuit.train;
        let gaps: Vec<f64> = train.gaps().map(f64::from).collect();
        let places: Vec<u32> = train.positions().collect();
        let angle = self.nut_angle;
        let outputs = self.model.step(inputs);
        self.nut_angle += f64::from(inputs.nut_speed) * f64::from(TICK);
        // The ring has them along the line between the centres.
        let normal = f64::from(self.configuration.folded.row(0.0).normal);
        let train = &self.model.state().circuit.train;
        let forces: Vec<f64> = train
            .forces()
            .map(|along| normal * f64::from(along))
            .collect();
        let meeting = forces
            .iter()
            .zip(&gaps)
            .any(|(force, gap)| *force > 0.0 && *gap > TOUCHING);
        let shares = &self.configuration.load_shares;
        let shares = if inputs.axial_load < 0.0 {
            shares.negative
        } else {
            shares.positive
        };
        let (ring, order) = self.ring(&places, &gaps, angle);
        let ring = ElasticRing {
            load_shares: shares.iter().map(|share| share.share().into()).collect(),
            ..ring
        };
        let exact = ring
            .simulate(
                &[RingSample {
                    time: 0.0,
                    nut_speed: inputs.nut_speed.into(),
                    axial_load: inputs.axial_load.into(),
                }],
                |_, _| (),
            )
            .unwrap()
            .remove(0);
        assert!(exact.solved(), "{:?}", exact.failure);
        let mut exact_forces = vec![0.0; BALLS];
        for (ball, state) in order.iter().zip(&exact.balls) {
            exact_forces[*ball] = state.force;
        }
        Pair {
            torque: outputs.friction_torque.into(),
            flagged: outputs.faults.any(),
            forces,
            meeting,
            exact_forces,
            exact,
            load: f64::from(inputs.axial_load).abs() / BALLS as f64,
        }
    }

    pub fn started(&self) -> ElasticRing {
        let design = exact_design();
        let UncagedBallScrewConfiguration {
            ball_friction,
            turns,
            return_length,
            screw_deviation,
            nut_deviation,
            ..
        } = self.configuration;
        ElasticRing {
            design,
            clearance: self.clearance.gap().into(),
            friction: self.friction.into(),
            ball_friction: ball_friction.into(),
            balls: BALLS,
            turns: turns.into(),
            return_length: return_length.into(),
            screw_deviation: along(screw_deviation, 0.0),
            nut_deviation: along(nut_deviation, 0.0),
            load_shares: Vec::new(),
            chord: true,
            places: Vec::new(),
            integration: Integration::Full,
        }
    }

    /// The exact ring with balls at these places, and the crate's ball that each of its balls is.
    fn ring(&self, places: &[u32], gaps: &[f64], angle: f64) -> (ElasticRing, Vec<usize>) {
        let started = self.started();
        let design = &started.design;
        let path = (design.pitch_radius.powi(2) + (design.lead / TAU).powi(2)).sqrt();
        let length = TAU * started.turns + started.return_length / path;
        let pitch = 2.0 * (design.ball_radius / path).asin();
        // From behind a gap on, so that balls that touch do so to the last digit.
        let last = (0..BALLS)
            .max_by(|a, b| gaps[*a].total_cmp(&gaps[*b]))
            .unwrap();
        let mut place = f64::from(places[(last + 1) % BALLS]) / 2_f64.powi(32) * length;
        let mut balls = Vec::with_capacity(BALLS);
        for step in 1..=BALLS {
            let ball = (last + step) % BALLS;
            balls.push((place.rem_euclid(length), ball));
            let gap = if gaps[ball] > TOUCHING {
                gaps[ball] / path
            } else {
                0.0
            };
            place += pitch + gap;
        }
        balls.sort_by(|a, b| a.0.total_cmp(&b.0));
        (
            ElasticRing {
                screw_deviation: along(self.configuration.screw_deviation, angle),
                places: balls.iter().map(|(place, _)| *place).collect(),
                ..started
            },
            balls.iter().map(|(_, ball)| *ball).collect(),
        )
    }
}

impl Pair {
    pub fn torque_error(&self) -> f64 {
        self.torque / self.exact.torque() - 1.0
    }

    pub fn force_errors(&self) -> impl Iterator<Item = f64> + '_ {
        let largest = self.exact.largest_force().max(SMALL * self.load);
        let pairs = self.forces.iter().zip(&self.exact_forces);
        pairs.map(move |(found, exact)| (found - exact) / largest)
    }
}

#[derive(Default)]
pub struct Found {
    pub torque: Errors,
    pub torque_apart: Errors,
    pub forces: Errors,
    pub forces_apart: Errors,
    pub ticks: u32,
    pub flagged: u32,
    pub meeting: u32,
    pub pressing: u32,
}

impl Found {
    pub fn add(&mut self, pair: &Pair, case: impl Fn() -> String) {
        self.ticks += 1;
        self.flagged += u32::from(pair.flagged);
        self.meeting += u32::from(pair.meeting);
        self.pressing += u32::from(pair.exact.pressing() > 0);
        self.torque.add_case(pair.torque_error(), &case);
        for error in pair.force_errors() {
            self.forces.add_case(error, &case);
        }
        if !pair.meeting {
            self.torque_apart.add_case(pair.torque_error(), &case);
            for error in pair.force_errors() {
                self.forces_apart.add_case(error, &case);
            }
        }
    }

    pub fn join(&mut self, other: &Self) {
        self.torque.join(&other.torque);
        self.torque_apart.join(&other.torque_apart);
        self.forces.join(&other.forces);
        self.forces_apart.join(&other.forces_apart);
        self.ticks += other.ticks;
        self.flagged += other.flagged;
        self.meeting += other.meeting;
        self.pressing += other.pressing;
    }

    pub fn print(&self, name: &str) {
        println!(
            "{name}: {} ticks, {} flagged, {} in which balls meet, {} in which balls press\n  torque {}\n  torque where none meet {}\n  \
             forces {}\n  forces where none meet {}",
            self.ticks,
            self.flagged,
            self.meeting,
            self.pressing,
            self.torque,
            self.torque_apart,
            self.forces,
            self.forces_apart
        );
    }
}
