//! Random mechanisms, random inputs, and what every tick has to keep.

use std::fmt::Debug;
use std::sync::LazyLock;

use super::gears::{linear_inputs, screw_inputs};
use super::random::Random;
use epas_friction::ball::folded::{FrictionNode, LoadCurve, LoadLaw};
use epas_friction::ball::pressed::{
    BallLaw, BallNode, BallNumbers, Knot, NeighbourNumbers, RubbedNode,
};
use epas_friction::ball::{ScrewTick, ScrewTickBall};
use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration, FoldedBall};
use epas_friction::train::Train;
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, Clearance, ClosedFormScrew,
    ClosedFormScrewConfiguration, DeviationMap, Faults, FrictionBranch, FrictionModel, GrooveSize,
    Inputs, Limits, LinearBearing, LinearBearingConfiguration, LinearBearingParameters,
    LinearBearingTrain, LinearInputs, LinearLimits, LinearOutputs, LoadShare, LoadShares, Material,
    Outputs, Regime, Scene, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};

/// Numbers at which formulas break.
pub const EDGES: [f32; 24] = [
    0.0,
    -0.0,
    1e-45,
    -1e-45,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-38,
    1e-30,
    1e-20,
    -1e-20,
    1.0,
    -1.0,
    0.99999994,
    1.0000001,
    1e6,
    -1e6,
    1e7,
    1e20,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    -f32::NAN,
];

impl Random {
    /// Uniform; the ends more often than by chance.
    pub fn within(&mut self, low: f32, high: f32) -> f32 {
        match self.below(32) {
            0 => low,
            1 => high,
            _ => low + (high - low) * self.unit(),
        }
    }

    /// Uniform in the logarithm; the ends more often than by chance.
    pub fn size(&mut self, low: f32, high: f32) -> f32 {
        match self.below(32) {
            0 => low,
            1 => high,
            _ => (low * (high / low).powf(self.unit())).clamp(low, high),
        }
    }

    /// Every f32 alike, NaN and subnormals with the rest.
    pub fn anything(&mut self) -> f32 {
        f32::from_bits(self.bits() as u32)
    }

    /// A signal that a sensor with full scale `limit` may deliver, sound or not.
    pub fn signal(&mut self, limit: f32, last: f32) -> f32 {
        match self.below(16) {
            0..=5 => limit * (2.0 * self.unit() - 1.0),
            6..=8 => self.sign() * limit * 1e-9_f32.powf(self.unit()),
            9 => last,
            10 => -last,
            11 => self.anything(),
            12 => self.of(&EDGES),
            13 => self.sign() * limit,
            14 => self.sign() * limit * 1.0000001,
            _ => self.sign() * 1e-30 * 1e30_f32.powf(self.unit()) * limit,
        }
    }
}

/// Maps of contact angle deviations: none, gentle, the largest allowed, a saw tooth, a long period.
static MAPS: LazyLock<Vec<DeviationMap>> = LazyLock::new(|| {
    let mut random = Random(7);
    let mut maps = vec![DeviationMap::NONE];
    for (turns, size) in [(1, 0.04), (1, 0.2), (3, 0.2), (100, 0.1), (2, 1e-9)] {
        let samples = std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0));
        maps.push(DeviationMap::from_samples(turns, &samples).unwrap());
    }
    let steps = std::array::from_fn(|sample| if sample % 2 == 0 { 0.2 } else { -0.2 });
    maps.push(DeviationMap::from_samples(1, &steps).unwrap());
    maps
});

/// Load shares: even, one ball alone with nearly all, 64 random ones, the longest table.
static SHARES: LazyLock<Vec<Vec<LoadShare>>> = LazyLock::new(|| {
    let mut random = Random(8);
    let mut table = |entries: usize, low: f32, high: f32| -> Vec<LoadShare> {
        (0..entries)
            .map(|_| LoadShare::new(random.size(low, high)).unwrap())
            .collect()
    };
    vec![
        vec![LoadShare::MEAN],
        table(2, 0.01, 100.0),
        table(64, 0.3, 2.0),
        table(256, 0.01, 100.0),
    ]
});

/// One of a lot of deviation maps.
pub fn map(random: &mut Random) -> &'static DeviationMap {
    let count = MAPS.len();
    &MAPS[random.below(count)]
}

/// One of a lot of tables of load shares.
pub fn shares(random: &mut Random) -> &'static [LoadShare] {
    let count = SHARES.len();
    &SHARES[random.below(count)]
}

fn material(random: &mut Random) -> Material {
    match random.below(8) {
        0 => Material {
            youngs_modulus: random.size(1e6, 1e13),
            poisson_ratio: random.within(0.0, 0.5),
            density: random.size(1.0, 1e5),
        },
        1..=2 => Material::SILICON_NITRIDE,
        _ => Material::STEEL,
    }
}

fn groove(random: &mut Random) -> GrooveSize {
    GrooveSize::Conformity(if random.one_in(3) {
        random.within(0.5005, 1.0)
    } else {
        random.within(0.51, 0.56)
    })
}

/// What a drawing may say, from the likely to the extreme.
pub fn screw_parameters(random: &mut Random) -> BallScrewParameters {
    if random.one_in(2) {
        return random.of(&CATALOGUE).parameters();
    }
    let pitch_radius = random.size(1e-3, 0.5);
    BallScrewParameters {
        pitch_radius,
        lead: match random.below(4) {
            0 => 0.0,
            1 => random.size(1e-8, 0.2),
            _ => pitch_radius * random.size(0.01, 10.0),
        },
        ball_radius: pitch_radius * random.size(0.01, 0.9),
        screw_groove: groove(random),
        nut_groove: groove(random),
        contact_angle: random.within(0.01, 1.5533),
        ball_material: material(random),
        groove_material: material(random),
    }
}

fn clearance(random: &mut Random, design: &BallScrew) -> Clearance {
    let gap = match random.below(4) {
        0 | 1 => 0.0,
        2 => -random.size(1e-8, 0.02) * design.ball_radius(),
        _ => random.size(1e-8, 0.05) * design.ball_radius(),
    };
    Clearance::new(gap).unwrap()
}

/// A random design that the crate takes.
pub fn design(random: &mut Random) -> BallScrew {
    loop {
        if let Ok(design) = BallScrew::new(screw_parameters(random)) {
            return design;
        }
    }
}

fn limits(random: &mut Random) -> Limits {
    Limits {
        nut_speed: if random.one_in(2) {
            random.size(50.0, 1000.0)
        } else {
            random.size(1e-3, 1e6)
        },
        axial_load: if random.one_in(2) {
            random.size(1e3, 3e4)
        } else {
            random.size(1e-3, 1e7)
        },
        friction_torque: random.size(1e-6, 1e6),
    }
}

/// A scene that can be drawn by lot and checked tick by tick.
pub trait Trial: Scene<Configuration: Debug> + Sized {
    /// Name of the scene, for messages.
    fn name() -> String;
    /// A random configuration, which may be refused.
    fn configuration(random: &mut Random) -> Self::Configuration;
    /// Full scales of three sensors; 0 for one that the scene has not.
    fn full_scales(configuration: &Self::Configuration) -> [f32; 3];
    /// Three sensor signals of the next tick, sound or not.
    fn sensors(
        random: &mut Random,
        configuration: &Self::Configuration,
        last: [f32; 3],
    ) -> [f32; 3] {
        let full_scales = Self::full_scales(configuration);
        std::array::from_fn(|sensor| match full_scales[sensor] {
            0.0 => 0.0,
            full_scale => random.signal(full_scale, last[sensor]),
        })
    }
    /// The inputs of these signals.
    fn inputs(sensors: [f32; 3]) -> Self::Inputs;
    /// The tick by its outputs alone.
    fn check(
        configuration: &Self::Configuration,
        sensors: [f32; 3],
        outputs: &Self::Outputs,
    ) -> Result<(), String>;
    /// The state, now and then.
    fn check_state(_: &FrictionModel<Self>) -> Result<(), String> {
        Ok(())
    }
    /// All bits of the outputs, for comparisons.
    fn numbers(outputs: &Self::Outputs) -> Vec<u32>;
}

/// Whether flags say what the sensors deliver: nothing silent, nothing invented.
fn flags(
    faults: Faults,
    speed: (f32, f32),
    loads: &[f32],
    largest_load: f32,
) -> Result<bool, String> {
    let (speed, largest_speed) = speed;
    let mut expected = Faults::NONE;
    let load_lost = loads.iter().any(|load| !load.is_finite());
    if !speed.is_finite() {
        expected |= Faults::SPEED_NOT_FINITE;
    }
    if load_lost {
        expected |= Faults::LOAD_NOT_FINITE;
    }
    let lost = expected.any();
    if !lost {
        if speed.abs() > largest_speed {
            expected |= Faults::SPEED_RANGE;
        }
        if loads.iter().any(|load| load.abs() > largest_load) {
            expected |= Faults::LOAD_RANGE;
        }
    }
    // What the sensors deliver says nothing of friction's limit, nor of the model's accuracy.
    let said = Faults::FRICTION_LIMIT | Faults::BEYOND_MODEL | Faults::FORCES_NOT_HELD;
    let beside_torque = faults.bits() & !said.bits();
    if beside_torque == expected.bits() {
        Ok(lost)
    } else {
        Err(format!("flags {faults:?}, expected {expected:?}"))
    }
}

/// Friction: finite, within its limit, never a source of power, none in a fault.
fn friction(value: f32, limit: f32, speed: f32, lost: bool) -> Result<(), String> {
    if !value.is_finite() {
        Err(format!("friction {value}"))
    } else if value.abs() > limit {
        Err(format!("friction {value} beyond its limit {limit}"))
    } else if lost && value != 0.0 {
        Err(format!("friction {value} although a sensor is lost"))
    } else if !lost && value * speed.signum() < 0.0 {
        Err(format!("friction {value} drives at speed {speed}"))
    } else {
        Ok(())
    }
}

fn finite(name: &str, value: f32) -> Result<(), String> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(format!("{name} = {value}"))
    }
}

impl Trial for ClosedFormScrew {
    fn name() -> String {
        "ball screw by a closed form".into()
    }

    fn configuration(random: &mut Random) -> ClosedFormScrewConfiguration {
        let design = design(random);
        ClosedFormScrewConfiguration {
            friction: random.within(0.0, 1.0),
            rolling_tangent: random.of(&[0.0, 0.001, 0.1]),
            branch: random.of(&[FrictionBranch::Rolling, FrictionBranch::Sliding]),
            clearance: clearance(random, &design),
            loaded_balls: random.of(&[1, 7, 120, 1000]),
            design,
            reversal_speed: random.size(1e-6, 1e3),
            limits: limits(random),
        }
    }

    fn full_scales(configuration: &ClosedFormScrewConfiguration) -> [f32; 3] {
        scales(&configuration.limits)
    }

    fn inputs([nut_speed, axial_load, _]: [f32; 3]) -> Inputs {
        screw_inputs(nut_speed, axial_load)
    }

    fn check(
        configuration: &ClosedFormScrewConfiguration,
        sensors: [f32; 3],
        outputs: &Outputs,
    ) -> Result<(), String> {
        screw_outputs(&configuration.limits, sensors, outputs).map(drop)
    }

    fn numbers(outputs: &Outputs) -> Vec<u32> {
        vec![
            outputs.friction_torque.to_bits(),
            outputs.load_torque.to_bits(),
            outputs.efficiency.to_bits(),
            outputs.regime as u32,
            u32::from(outputs.faults.bits()),
        ]
    }
}

fn curve(random: &mut Random) -> LoadCurve {
    let mut start = random.within(0.0, 140.0);
    let steepest = random.size(1e-6, 1e9);
    LoadCurve {
        starts: std::array::from_fn(|_| {
            start += random.of(&[0.0, 0.1, 3.0, f32::MAX]);
            start.min(f32::MAX)
        }),
        cubics: std::array::from_fn(|_| {
            let [_, b, c, d] = std::array::from_fn(|_| random.within(-steepest, steepest));
            [random.within(0.0, steepest), b, c, d]
        }),
    }
}

impl<const N: usize> Trial for CagedBallScrew<N> {
    fn name() -> String {
        format!("caged ball screw of {N} nodes")
    }

    fn configuration(random: &mut Random) -> CagedBallScrewConfiguration<N> {
        let mut friction = random.size(1e-6, 0.02);
        let nodes = std::array::from_fn(|_| {
            friction *= random.of(&[1.02, 1.5, 2.0]);
            FrictionNode {
                friction,
                curves: [curve(random), curve(random)],
                shift: [random.within(-30.0, 30.0), random.within(-30.0, 30.0)],
            }
        });
        let least = random.within(1.0, 254.0);
        let law = LoadLaw {
            nodes,
            ends: [least, random.within(least, 254.0)],
            lift_off: random.of(&[0.0, 1e-30, 10.0, 1e7]),
            shifted_from: random.within(1.0, 254.0),
        };
        let (from, to) = law.friction_range();
        CagedBallScrewConfiguration {
            friction: random.within(from, to),
            law,
            lead: random.of(&[0.0, 1e-9, 0.01, 0.2]),
            loaded_balls: random.of(&[1, 7, 120, 1000]),
            reversal_speed: random.size(1e-6, 1e3),
            limits: limits(random),
        }
    }

    fn full_scales(configuration: &CagedBallScrewConfiguration<N>) -> [f32; 3] {
        scales(&configuration.limits)
    }

    fn inputs(sensors: [f32; 3]) -> Inputs {
        ClosedFormScrew::inputs(sensors)
    }

    fn check(
        configuration: &CagedBallScrewConfiguration<N>,
        sensors: [f32; 3],
        outputs: &Outputs,
    ) -> Result<(), String> {
        screw_outputs(&configuration.limits, sensors, outputs).map(drop)
    }

    fn numbers(outputs: &Outputs) -> Vec<u32> {
        ClosedFormScrew::numbers(outputs)
    }
}

fn scales(limits: &Limits) -> [f32; 3] {
    [limits.nut_speed, limits.axial_load, 0.0]
}

/// Outputs of a ball screw with or without a cage: finite, within their limits, with flags that say what was wrong. Whether a sensor is lost.
fn screw_outputs(
    limits: &Limits,
    [speed, load, _]: [f32; 3],
    outputs: &Outputs,
) -> Result<bool, String> {
    let lost = flags(
        outputs.faults,
        (speed, limits.nut_speed),
        &[load],
        limits.axial_load,
    )?;
    friction(outputs.friction_torque, limits.friction_torque, speed, lost)?;
    finite("load_torque", outputs.load_torque)?;
    if (-1e6..=1.0).contains(&outputs.efficiency) {
        Ok(lost)
    } else {
        Err(format!("efficiency {}", outputs.efficiency))
    }
}

struct TrainNumbers {
    friction: f32,
    groove: f32,
    ball: f32,
    contacts: u8,
    largest_contact_force: f32,
}

impl From<&UncagedOutputs> for TrainNumbers {
    fn from(outputs: &UncagedOutputs) -> Self {
        Self {
            friction: outputs.friction_torque,
            groove: outputs.groove_torque,
            ball: outputs.ball_torque,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
        }
    }
}

impl From<&LinearOutputs> for TrainNumbers {
    fn from(outputs: &LinearOutputs) -> Self {
        Self {
            friction: outputs.friction_force,
            groove: outputs.groove_force,
            ball: outputs.ball_force,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
        }
    }
}

impl TrainNumbers {
    fn check(&self, balls: usize, speed: f32, limit: f32, lost: bool) -> Result<(), String> {
        friction(self.friction, limit, speed, lost)?;
        for (name, value) in [
            ("groove", self.groove),
            ("ball", self.ball),
            ("largest_contact_force", self.largest_contact_force),
        ] {
            finite(name, value)?;
        }
        if !lost {
            friction(self.groove, f32::MAX, speed, false)
                .map_err(|error| format!("grooves: {error}"))?;
            friction(self.ball, f32::MAX, speed, false)
                .map_err(|error| format!("balls: {error}"))?;
        }
        if usize::from(self.contacts) > balls || self.largest_contact_force < 0.0 {
            return Err(format!(
                "{} contacts, largest force {}",
                self.contacts, self.largest_contact_force
            ));
        }
        if (self.contacts == 0) != (self.largest_contact_force == 0.0) {
            return Err(format!(
                "{} contacts with a largest force of {}",
                self.contacts, self.largest_contact_force
            ));
        }
        Ok(())
    }

    fn bits(&self, load_torque: f32, regime: Regime, faults: Faults) -> Vec<u32> {
        vec![
            self.friction.to_bits(),
            self.groove.to_bits(),
            self.ball.to_bits(),
            load_torque.to_bits(),
            u32::from(self.contacts),
            self.largest_contact_force.to_bits(),
            regime as u32,
            u32::from(faults.bits()),
        ]
    }
}

/// No ball lost, none through another: from ball to ball once around the track and no more, gaps not
/// below what rounding of positions leaves, numbers finite.
pub fn sound_train<const N: usize>(train: &Train<N>) -> Result<(), String> {
    let positions: Vec<u32> = train.positions().collect();
    let around: u64 = (0..N)
        .map(|ball| {
            let ahead = positions[(ball + 1) % N];
            u64::from(ahead.wrapping_sub(positions[ball]))
        })
        .sum();
    if N > 1 && around != 1 << 32 {
        return Err(format!(
            "balls out of order: {around} units around the track, {positions:?}"
        ));
    }
    if let Some((ball, gap)) = train
        .gaps()
        .enumerate()
        .find(|(_, gap)| !(gap.is_finite() && *gap >= -1e-6))
    {
        return Err(format!("gap {gap} in front of ball {ball}"));
    }
    for (force, speed) in train.forces().zip(train.speeds()) {
        if !(force.is_finite() && force >= 0.0 && speed.is_finite()) {
            return Err(format!("force {force}, speed {speed}"));
        }
    }
    Ok(())
}

fn ball_numbers(random: &mut Random) -> BallNumbers {
    let (free, torque) = (powers(random), powers(random));
    let impedance = random.size(0.02, 900.0);
    let steep = random.of(&[0.0, 0.01, 0.4]) * impedance;
    BallNumbers {
        free,
        impedance: [
            impedance,
            random.within(-steep, steep),
            random.within(-steep, steep),
        ],
        torque,
        slope: random.of(&[0.0, 1e-4, 1.0]) * random.sign(),
        work: random.of(&[0.0, 1.0, 4.0]),
    }
}

/// Numbers whose sizes add up to less than 1.
fn powers<const P: usize>(random: &mut Random) -> [f32; P] {
    let size = random.of(&[0.0, 6e-3, 0.6, 0.96]) / P as f32;
    std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0))
}

fn neighbour_numbers(random: &mut Random) -> NeighbourNumbers {
    let mut line = |sizes: &[f32]| -> [f32; 3] {
        let size = random.of(sizes);
        std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0))
    };
    NeighbourNumbers {
        nodes: std::array::from_fn(|_| RubbedNode {
            push: line(&[0.0, 1e-3, 0.5, 8.0, 1e3]),
            impedance: line(&[0.0, 1.0, 30.0, 1e3]),
            torque: line(&[0.0, 1e-4, 0.01, 1e3]),
        }),
        outward: line(&[0.0, 0.1, 5.0, 1e3]),
        outward_torque: line(&[0.0, 1e-3, 1e3])[0],
    }
}

fn knots<T: Copy, const K: usize>(
    random: &mut Random,
    numbers: fn(&mut Random) -> T,
) -> [Knot<T>; K] {
    let mut load = random.size(1e-6, 100.0);
    let widest = random.of(&[0.0, 1e-3, 1.0, 100.0, 1e5]);
    let needed = random.of(&[1, 2, K]);
    let loads: [f32; K] = std::array::from_fn(|knot| {
        if knot < needed {
            load += widest * random.unit();
        }
        load
    });
    std::array::from_fn(|knot| {
        Knot::between(loads[knot], loads[(knot + 1).min(K - 1)], numbers(random))
    })
}

fn folded_ball<const NODES: usize>(random: &mut Random) -> FoldedBall<NODES> {
    let mut friction = random.size(1e-6, 0.1);
    let nodes = std::array::from_fn(|_| {
        friction *= random.of(&[1.02, 1.5, 2.0]);
        BallNode {
            friction,
            branches: [knots(random, ball_numbers), knots(random, ball_numbers)],
            neighbours: [
                knots(random, neighbour_numbers),
                knots(random, neighbour_numbers),
            ],
            unheld: [0, random.bits() as u32],
        }
    });
    let law = BallLaw {
        nodes,
        deviations: [random.of(&[0.2, 0.2, 1.0]), random.of(&[0.2, 0.2, 1.0])],
        lift_off: random.of(&[0.0, 0.0, 10.0, 1e7]),
    };
    let (least, largest) = law.friction_range();
    let ball_radius = random.size(1e-4, 0.05);
    let path_radius = (ball_radius * random.size(1.02, 100.0)).min(1.0);
    FoldedBall {
        law,
        friction: random.within(least, largest),
        lead: random.of(&[0.0, 1e-9, 0.01, 0.2]),
        ball_radius,
        path_radius,
        speed: path_radius * random.of(&[1e-3, 0.2, 0.5, 1.0]),
        reversal_speed: random.size(1e-6, 1e3),
        limits: limits(random),
    }
}

/// Folded balls that can be drawn by lot.
pub trait Lot: Sized + 'static {
    /// All of the lot.
    fn all() -> &'static [Self];
}

/// Balls of a lot.
const LOT: usize = 400;

fn lot<const NODES: usize>(seed: u64) -> Vec<FoldedBall<NODES>> {
    let mut random = Random(seed);
    (0..LOT).map(|_| folded_ball(&mut random)).collect()
}

impl Lot for FoldedBall<1> {
    fn all() -> &'static [Self] {
        static ALL: LazyLock<Vec<FoldedBall<1>>> = LazyLock::new(|| lot(31));
        &ALL
    }
}

impl Lot for FoldedBall<3> {
    fn all() -> &'static [Self] {
        static ALL: LazyLock<Vec<FoldedBall<3>>> = LazyLock::new(|| lot(33));
        &ALL
    }
}

impl<const N: usize, const NODES: usize> Trial for UncagedBallScrew<N, NODES>
where
    FoldedBall<NODES>: Lot,
{
    fn name() -> String {
        format!("ball screw without cage, {N} balls, {NODES} nodes")
    }

    fn configuration(random: &mut Random) -> UncagedBallScrewConfiguration<NODES> {
        let folded = &FoldedBall::<NODES>::all()[random.below(LOT)];
        let limits = folded.limits;
        let pitch = 2.0 * (folded.ball_radius / folded.path_radius).asin();
        let full = N as f32 * pitch / std::f32::consts::TAU;
        let turns = (full * random.of(&[0.3, 0.999, 1.001, 1.05, 1.5, 5.0])).clamp(0.1, 100.0);
        UncagedBallScrewConfiguration {
            folded,
            ball_friction: random.of(&[0.0, 0.1, 0.1, 1.0]) * random.unit(),
            balls: N as u16,
            turns: if random.one_in(4) {
                random.size(0.1, 100.0)
            } else {
                turns
            },
            return_length: match random.below(4) {
                0 => 0.0,
                1 => random.size(1e-4, 10.0),
                _ => (folded.path_radius * random.size(0.01, 10.0)).min(10.0),
            },
            screw_deviation: map(random),
            nut_deviation: map(random),
            load_shares: LoadShares::same(shares(random)),
            tick: if random.one_in(2) {
                random.size(1e-6, 1e-2)
            } else {
                (0.03 / limits.nut_speed).clamp(1e-6, 1.0)
            },
        }
    }

    fn full_scales(configuration: &UncagedBallScrewConfiguration<NODES>) -> [f32; 3] {
        scales(&configuration.folded.limits)
    }

    fn inputs(sensors: [f32; 3]) -> Inputs {
        ClosedFormScrew::inputs(sensors)
    }

    fn check(
        configuration: &UncagedBallScrewConfiguration<NODES>,
        sensors: [f32; 3],
        outputs: &UncagedOutputs,
    ) -> Result<(), String> {
        let limits = &configuration.folded.limits;
        let lost = screw_outputs(limits, sensors, &Outputs::from(*outputs))?;
        TrainNumbers::from(outputs).check(N, sensors[0], limits.friction_torque, lost)
    }

    fn check_state(model: &FrictionModel<Self>) -> Result<(), String> {
        sound_train(&model.state().circuit.train)
    }

    fn numbers(outputs: &UncagedOutputs) -> Vec<u32> {
        TrainNumbers::from(outputs).bits(outputs.load_torque, outputs.regime, outputs.faults)
    }
}

impl<const N: usize> Trial for LinearBearingTrain<N> {
    fn name() -> String {
        format!("linear bearing, {N} balls")
    }

    fn configuration(random: &mut Random) -> LinearBearingConfiguration {
        let bearing = loop {
            let parameters = LinearBearingParameters {
                ball_radius: if random.one_in(2) {
                    random.size(1e-3, 1e-2)
                } else {
                    random.size(1e-4, 0.05)
                },
                groove: groove(random),
                contact_angle: random.within(0.01, 1.5533),
                ball_material: material(random),
                groove_material: material(random),
            };
            if let Ok(bearing) = LinearBearing::new(parameters) {
                break bearing;
            }
        };
        let full = 2.0 * bearing.ball_radius() * N as f32;
        let loaded = if random.one_in(4) {
            random.size(1e-4, 100.0)
        } else {
            full * random.of(&[0.3, 0.999, 1.000001, 1.05, 3.0])
        };
        let speed = random.size(1e-6, 1e3);
        LinearBearingConfiguration {
            friction: random.size(1e-6, 1.0),
            ball_friction: random.within(0.0, 1.0),
            balls: N as u16,
            loaded_length: loaded,
            return_length: match random.below(4) {
                0 => 0.0,
                1 => random.size(1e-4, 100.0),
                _ => loaded * random.unit(),
            },
            wavelength: loaded * random.size(0.01, 10.0),
            rail_deviation: map(random),
            carriage_deviation: map(random),
            load_shares: shares(random),
            reversal_speed: random.size(1e-9, 10.0),
            tick: if random.one_in(2) {
                random.size(1e-6, 1e-2)
            } else {
                (0.06 * loaded / speed).clamp(1e-6, 1.0)
            },
            bearing,
            limits: LinearLimits {
                speed,
                load: random.size(1e-3, 1e7),
                friction_force: random.size(1e-6, 1e6),
            },
        }
    }

    fn full_scales(configuration: &LinearBearingConfiguration) -> [f32; 3] {
        let LinearLimits { speed, load, .. } = configuration.limits;
        [speed, load, load]
    }

    fn inputs([speed, normal_load, side_load]: [f32; 3]) -> LinearInputs {
        linear_inputs(speed, normal_load, side_load)
    }

    fn check(
        configuration: &LinearBearingConfiguration,
        [speed, normal, side]: [f32; 3],
        outputs: &LinearOutputs,
    ) -> Result<(), String> {
        let limits = &configuration.limits;
        let lost = flags(
            outputs.faults,
            (speed, limits.speed),
            &[normal, side],
            limits.load,
        )?;
        TrainNumbers::from(outputs).check(N, speed, limits.friction_force, lost)
    }

    fn check_state(model: &FrictionModel<Self>) -> Result<(), String> {
        sound_train(&model.state().circuit.train)
    }

    fn numbers(outputs: &LinearOutputs) -> Vec<u32> {
        TrainNumbers::from(outputs).bits(0.0, outputs.regime, outputs.faults)
    }
}

/// A model of a random configuration that the constructor takes; how many it refused.
pub fn accepted<S: Trial>(random: &mut Random) -> (S::Configuration, FrictionModel<S>, u32) {
    let mut refused = 0;
    loop {
        let configuration = S::configuration(random);
        match FrictionModel::<S>::new(&configuration) {
            Ok(model) => return (configuration, model, refused),
            Err(error) => {
                assert!(
                    !error.allowed().contains(error.value()),
                    "{}: {error} refuses an allowed value: {configuration:?}",
                    S::name(),
                );
                refused += 1;
                assert!(refused < 100_000, "{}: {error}", S::name());
            }
        }
    }
}

/// Random models, each run through random inputs; panics with a line that reproduces the case.
pub fn soak<S: Trial>(seed: u64, models: u64, ticks: u64) -> u64
where
    S::State: Debug,
{
    let mut refused = 0;
    for model in 0..models {
        let start = seed.wrapping_add(model.wrapping_mul(0x1000_0000_01b3));
        let mut random = Random(start);
        let (configuration, mut friction, no) = accepted::<S>(&mut random);
        refused += u64::from(no);
        let mut sensors = [0.0; 3];
        for tick in 0..ticks {
            sensors = S::sensors(&mut random, &configuration, sensors);
            let outputs = friction.step(S::inputs(sensors));
            let mut checked = S::check(&configuration, sensors, &outputs);
            if checked.is_ok() && (tick & 63 == 63 || tick + 1 == ticks) {
                checked = S::check_state(&friction);
            }
            if let Err(error) = checked {
                panic!(
                    "{}, seed {start:#x}, tick {tick}, sensors {sensors:?}: {error}\n{configuration:?}",
                    S::name(),
                );
            }
        }
    }
    println!(
        "{}: {} random ticks in {models} models, {refused} configurations refused",
        S::name(),
        models * ticks,
    );
    models * ticks
}

/// What a row in closed form gives of a ball in a tick.
pub fn row_numbers(tick: &ScrewTick, ball: &ScrewTickBall) -> [f32; 6] {
    [
        ball.speed_deviation,
        ball.compliance,
        ball.groove_torque,
        ball.rubbing,
        tick.main_load(),
        tick.third_load(),
    ]
}
