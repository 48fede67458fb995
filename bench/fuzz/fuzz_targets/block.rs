//! `block`: any words are refused with what is wrong with them, or give a screw whose ticks are finite, limited and never drive.
//!
//! The first eight bytes draw a scene, what is set beside its block, what sensors say, and whether the rest is the block itself or changes of a
//! sound one, sealed again: six bytes a change, which word and its bits.
#![no_main]

#[path = "../../firmware/src/gears/balls.rs"]
mod balls;

use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use balls::{GEAR_33X20_BALL, GEAR_33X20_BALL_RANGE};
use epas_friction::ball::folded::{FrictionNode, LoadCurve, LoadLaw, PARTS};
use epas_friction::scene::{
    CagedBallScrewConfiguration, ChangingFriction, FoldedBall, StoredScene,
};
use epas_friction::stored::crc32;
use epas_friction::{
    CagedBallScrew, DeviationMap, Error, Faults, FrictionModel, Inputs, Limits, LoadShare,
    LoadShares, Outputs, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};
use epas_testkit::random::Random;
use libfuzzer_sys::fuzz_target;

/// Balls of a screw without cage.
const BALLS: usize = 7;
const TICKS: u32 = 30;

/// A model keeps its folded ball for ever: so many are made, 5 KB each or 15.
const MOST_KEPT: usize = 60_000;
static KEPT: AtomicUsize = AtomicUsize::new(0);

/// Words of a block before its numbers, and fields of a refusal that speak of them.
const HEADER: usize = 6;
const FRAME: [&str; 5] = ["magic", "version", "nodes", "words", "checksum"];

fuzz_target!(|data: &[u8]| {
    let Some((seed, bytes)) = data.split_first_chunk::<8>() else {
        return;
    };
    let seed = u64::from_le_bytes(*seed);
    match seed & 3 {
        0 => run::<CagedBallScrewConfiguration<1>>(seed, bytes),
        1 => run::<CagedBallScrewConfiguration<5>>(seed, bytes),
        2 => run::<FoldedBall<1>>(seed, bytes),
        _ => run::<FoldedBall<3>>(seed, bytes),
    }
});

/// What a block is decoded to.
trait Folded: Copy {
    type Scene: ChangingFriction + StoredScene + epas_friction::Scene<Inputs = Inputs>;

    const WORDS: usize;

    /// One that a host may have folded.
    fn sound() -> Self;
    fn read(words: &[u32]) -> Result<Self, Error>;
    fn write(&self, words: &mut [u32]);
    /// A model of it; `None` where no more are made.
    fn model(&self, random: &mut Random) -> Option<Result<FrictionModel<Self::Scene>, Error>>;
    fn limits(&self) -> Limits;
    fn frictions(&self) -> (f32, f32);
    /// Friction torque, other numbers, and flags.
    fn numbers(outputs: &<Self::Scene as epas_friction::Scene>::Outputs)
    -> (f32, Vec<f32>, Faults);
}

impl<const NODES: usize> Folded for CagedBallScrewConfiguration<NODES> {
    type Scene = CagedBallScrew<NODES>;

    const WORDS: usize = Self::WORDS;

    /// In proportion to the load.
    fn sound() -> Self {
        let mut starts = [f32::MAX; PARTS];
        starts[0] = 120.0;
        let curve = LoadCurve {
            starts,
            cubics: [[2e-3, 0.0, 0.0, 0.0]; PARTS],
        };
        let mut friction = 0.04;
        Self {
            law: LoadLaw {
                nodes: std::array::from_fn(|_| {
                    friction *= 1.5;
                    FrictionNode {
                        friction,
                        curves: [curve; 2],
                        shift: [0.0; 2],
                    }
                }),
                ends: [120.0, 136.0],
                lift_off: 0.0,
                shifted_from: 1.0,
            },
            friction: 0.06,
            lead: 0.02,
            loaded_balls: 36,
            reversal_speed: 0.5,
            limits: GEAR_33X20_BALL.limits,
        }
    }

    fn read(words: &[u32]) -> Result<Self, Error> {
        Self::read(words)
    }

    fn write(&self, words: &mut [u32]) {
        self.write(0, words).unwrap();
    }

    fn model(&self, _: &mut Random) -> Option<Result<FrictionModel<Self::Scene>, Error>> {
        Some(FrictionModel::new(self))
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    fn frictions(&self) -> (f32, f32) {
        self.law.friction_range()
    }

    fn numbers(outputs: &Outputs) -> (f32, Vec<f32>, Faults) {
        let numbers = vec![outputs.load_torque, outputs.efficiency];
        (outputs.friction_torque, numbers, outputs.faults)
    }
}

/// A folded ball of the firmware, by its number of nodes.
trait OfFirmware {
    fn of_firmware() -> Self;
}

impl OfFirmware for FoldedBall<1> {
    fn of_firmware() -> Self {
        GEAR_33X20_BALL
    }
}

impl OfFirmware for FoldedBall<3> {
    fn of_firmware() -> Self {
        GEAR_33X20_BALL_RANGE
    }
}

/// Deviations: none, small, and as large as any.
static MAPS: LazyLock<[DeviationMap; 3]> = LazyLock::new(|| {
    [0.0, 0.01, 0.2].map(|size| {
        let samples = std::array::from_fn(|sample| if sample % 3 == 0 { size } else { -size });
        DeviationMap::from_samples(1, &samples).unwrap()
    })
});

static SHARES: LazyLock<[LoadShare; 3]> =
    LazyLock::new(|| [0.3, 1.0, 1.7].map(|share| LoadShare::new(share).unwrap()));

impl<const NODES: usize> Folded for FoldedBall<NODES>
where
    Self: OfFirmware,
{
    type Scene = UncagedBallScrew<BALLS, NODES>;

    const WORDS: usize = Self::WORDS;

    fn sound() -> Self {
        Self::of_firmware()
    }

    fn read(words: &[u32]) -> Result<Self, Error> {
        let folded = Self::read(words)?;
        let mut again = vec![0; Self::WORDS];
        <Self as Folded>::write(&folded, &mut again);
        let numbers = HEADER..Self::WORDS - 1;
        assert_eq!(words[numbers.clone()], again[numbers], "words that change");
        Ok(folded)
    }

    fn write(&self, words: &mut [u32]) {
        self.write(0, words).unwrap();
    }

    fn model(&self, random: &mut Random) -> Option<Result<FrictionModel<Self::Scene>, Error>> {
        if let Err(error) = self.law.checked() {
            return Some(Err(error));
        }
        if KEPT.fetch_add(1, Ordering::Relaxed) >= MOST_KEPT {
            return None;
        }
        // Turns that hold the balls, where the block's radii are any.
        let full =
            BALLS as f32 * (self.ball_radius / self.path_radius).asin() / std::f32::consts::PI;
        let turns = full * random.of(&[0.9, 1.01, 1.5]);
        let shares = if random.one_in(2) {
            &SHARES[..]
        } else {
            &[LoadShare::MEAN]
        };
        Some(FrictionModel::new(&UncagedBallScrewConfiguration {
            folded: Box::leak(Box::new(*self)),
            ball_friction: random.of(&[0.0, 0.12, 0.6]),
            balls: BALLS as u16,
            turns: if turns > 0.1 { turns } else { 0.2 },
            return_length: random.of(&[0.0, 0.01]),
            screw_deviation: &MAPS[random.below(3)],
            nut_deviation: &MAPS[random.below(3)],
            load_shares: LoadShares::same(shares),
            tick: random.of(&[1e-6, 1e-4, 1e-3]),
        }))
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    fn frictions(&self) -> (f32, f32) {
        self.law.friction_range()
    }

    fn numbers(outputs: &UncagedOutputs) -> (f32, Vec<f32>, Faults) {
        assert!(usize::from(outputs.contacts) <= BALLS && outputs.largest_contact_force >= 0.0);
        let numbers = vec![
            outputs.groove_torque,
            outputs.ball_torque,
            outputs.load_torque,
            outputs.largest_contact_force,
        ];
        (outputs.friction_torque, numbers, outputs.faults)
    }
}

/// The words of a case.
fn words<F: Folded>(random: &mut Random, bytes: &[u8]) -> Vec<u32> {
    if random.one_in(8) {
        let (words, _) = bytes.as_chunks::<4>();
        return words.iter().map(|word| u32::from_le_bytes(*word)).collect();
    }
    let mut words = vec![0; F::WORDS];
    F::sound().write(&mut words);
    let replaced = random.one_in(2);
    let (changes, _) = bytes.as_chunks::<6>();
    for &[at, high, ref bits @ ..] in changes {
        let at = usize::from(u16::from_le_bytes([at, high])) % F::WORDS;
        let bits = u32::from_le_bytes(*bits);
        words[at] = if replaced { bits } else { words[at] ^ bits };
    }
    if !random.one_in(8) {
        let body = words.len() - 1;
        let counted: Vec<u8> = words[..body].iter().flat_map(|w| w.to_le_bytes()).collect();
        words[body] = crc32(&counted);
    }
    words
}

/// A refusal names a field, and a value that it does not allow.
fn is_refusal(error: &Error) {
    let field = error.field();
    assert!(
        !field.is_empty() && (FRAME.contains(&field) || !error.allowed().contains(error.value())),
        "{error}"
    );
}

fn run<F: Folded>(seed: u64, bytes: &[u8]) {
    let mut random = Random(seed >> 2);
    let words = words::<F>(&mut random, bytes);
    let folded = match F::read(&words) {
        Ok(folded) => folded,
        Err(error) => return is_refusal(&error),
    };
    let mut model = match folded.model(&mut random) {
        Some(Ok(model)) => model,
        Some(Err(error)) => return is_refusal(&error),
        None => return,
    };
    let limits = folded.limits();
    let mut state = vec![0; FrictionModel::<F::Scene>::STATE_BYTES];
    for tick in 0..TICKS {
        let inputs = Inputs {
            nut_speed: signal(&mut random, limits.nut_speed),
            axial_load: signal(&mut random, limits.axial_load),
        };
        step::<F>(&mut model, inputs, &limits);
        match tick % 8 {
            3 => {
                let (least, largest) = folded.frictions();
                let friction = random.of(&[least, largest, 0.5 * (least + largest), 0.0, f32::NAN]);
                let held = (least..=largest).contains(&friction);
                assert_eq!(model.set_friction(friction).is_ok(), held, "{friction}");
            }
            5 => assert_eq!(model.export(&mut state), Ok(state.len())),
            7 => assert_eq!(model.import(&state), Ok(())),
            _ => {}
        }
    }
}

/// Sound, at its limit, beyond it, or none.
fn signal(random: &mut Random, limit: f32) -> f32 {
    let sign = random.sign();
    sign * match random.below(8) {
        0 => 0.0,
        1 => limit,
        2 => 3.0 * limit,
        3 => f32::from_bits(random.bits() as u32),
        4 => limit * 1e-6_f32.powf(random.unit()),
        _ => limit * random.unit(),
    }
}

fn step<F: Folded>(model: &mut FrictionModel<F::Scene>, inputs: Inputs, limits: &Limits) {
    let outputs = model.step(inputs);
    let (friction, numbers, faults) = F::numbers(&outputs);
    let lost = !inputs.nut_speed.is_finite() || !inputs.axial_load.is_finite();
    let driving = friction * inputs.nut_speed.signum() < 0.0;
    assert!(
        friction.is_finite()
            && friction.abs() <= limits.friction_torque
            && numbers.iter().all(|number| number.is_finite())
            && if lost { friction == 0.0 } else { !driving },
        "{inputs:?}: friction {friction}, {numbers:?}"
    );
    let not_finite = Faults::SPEED_NOT_FINITE | Faults::LOAD_NOT_FINITE;
    assert_eq!(faults.bits() & not_finite.bits() != 0, lost, "{faults:?}");
}
