//! State across ignition: a model that takes a block over goes on to the bit, and a block that is not its own changes nothing.

mod refusals;

use epas_testkit::gears::{linear_inputs, screw_inputs};
use std::f32::consts::TAU;
use std::fmt::Debug;

use epas_friction::scene::{StoredScene, WithMemoryInputs};
use epas_friction::stored::crc32;
use epas_friction::{
    ClosedFormScrew, DeviationMap, FrictionBranch, FrictionModel, Inputs, LinearBearingTrain,
    LinearInputs, Refusal,
};

use crate::remembering::{
    COUNTS, CagedByAngle, LinearBySpeed, TEMPERATURE, TICK, UncagedByCounts, at, caged_by_angle,
    linear_by_speed, uncaged_by_counts,
};
use epas_testkit::gears::{
    CROWD, CagedScrew, LINEAR_BALLS, SCREW_BALLS, UncagedScrew, caged, closed_form, crowded,
    linear, uncaged,
};
use epas_testkit::random::Random;

type Uncaged = UncagedScrew<SCREW_BALLS>;
type Linear = LinearBearingTrain<LINEAR_BALLS>;

const VERSION_AT: usize = 4;
const KIND_AT: usize = 6;
const BALLS_AT: usize = 8;
const LENGTH_AT: usize = 10;
const FINGERPRINT_AT: usize = 12;
const STATE_AT: usize = 16;

/// A manoeuvre by lot: speed, loads and temperature wander, jump and turn round.
#[derive(Clone)]
struct Manoeuvre {
    random: Random,
    speed: f32,
    load: f32,
    temperature: f32,
    angle: f32,
    /// Whether the bus delivers no load.
    lost: bool,
}

impl Manoeuvre {
    fn new(seed: u64) -> Self {
        Self {
            random: Random(seed),
            speed: 0.0,
            load: 1000.0,
            temperature: TEMPERATURE,
            angle: 0.0,
            lost: false,
        }
    }

    fn next(&mut self) {
        let random = &mut self.random;
        match random.below(200) {
            0 => self.speed = -self.speed,
            1 => self.load = -self.load,
            2 => self.load = 8000.0 * (2.0 * random.unit() - 1.0),
            3 => self.speed = 40.0 * (2.0 * random.unit() - 1.0),
            4 => self.speed *= 0.01,
            5 => self.temperature = 250.0 + 100.0 * random.unit(),
            _ => {
                self.speed += 0.5 * (2.0 * random.unit() - 1.0);
                self.load += 20.0 * (2.0 * random.unit() - 1.0);
            }
        }
        self.angle = (self.angle + self.speed * TICK).rem_euclid(TAU);
    }

    fn screw(&self) -> Inputs {
        screw_inputs(self.speed, self.delivered())
    }

    fn bearing(&self) -> LinearInputs {
        linear_inputs(
            0.02 * self.speed,
            2000.0 + 0.2 * self.delivered(),
            0.05 * self.load,
        )
    }

    fn delivered(&self) -> f32 {
        if self.lost { f32::NAN } else { self.load }
    }

    fn with<I, R>(&self, scene: I, reading: R) -> WithMemoryInputs<I, R> {
        at(scene, reading, self.temperature)
    }
}

/// A kind of scene with what the tests do to it.
trait Kept: StoredScene<Outputs: Debug, State: Debug + PartialEq> + Sized {
    const STILL: bool = false;

    fn model() -> FrictionModel<Self>;
    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, tick: u32) -> Self::Outputs;
    fn set(_: &mut FrictionModel<Self>) {}
    fn import(model: &mut FrictionModel<Self>, block: &[u8]) -> Result<(), Refusal> {
        model.import(block)
    }
}

impl Kept for CagedScrew {
    const STILL: bool = true;

    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&caged()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, _: u32) -> Self::Outputs {
        model.step(manoeuvre.screw())
    }

    fn set(model: &mut FrictionModel<Self>) {
        model.set_friction(0.06).unwrap();
    }
}

impl Kept for Uncaged {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&uncaged()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, _: u32) -> Self::Outputs {
        model.step(manoeuvre.screw())
    }

    fn set(model: &mut FrictionModel<Self>) {
        model.set_friction(0.08).unwrap();
        model.set_nut_angle(1.0);
    }
}

impl Kept for UncagedScrew<CROWD> {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&crowded()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, _: u32) -> Self::Outputs {
        model.step(manoeuvre.screw())
    }
}

impl Kept for Linear {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&linear()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, _: u32) -> Self::Outputs {
        model.step(manoeuvre.bearing())
    }

    fn set(model: &mut FrictionModel<Self>) {
        model.set_friction(0.06).unwrap();
        model.set_carriage_position(0.01);
    }
}

impl Kept for CagedByAngle {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&caged_by_angle()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, tick: u32) -> Self::Outputs {
        if tick % 2 == 1 {
            model.between(manoeuvre.angle)
        } else {
            model.step(manoeuvre.with(manoeuvre.screw(), manoeuvre.angle))
        }
    }

    fn import(model: &mut FrictionModel<Self>, block: &[u8]) -> Result<(), Refusal> {
        model.import_with_reading(block)
    }
}

impl Kept for UncagedByCounts {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&uncaged_by_counts()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, tick: u32) -> Self::Outputs {
        let count = (manoeuvre.angle / TAU * COUNTS as f32) as u32 % COUNTS;
        if tick % 2 == 1 {
            model.between(count)
        } else {
            model.step(manoeuvre.with(manoeuvre.screw(), count))
        }
    }

    fn import(model: &mut FrictionModel<Self>, block: &[u8]) -> Result<(), Refusal> {
        model.import_with_reading(block)
    }
}

impl Kept for LinearBySpeed {
    fn model() -> FrictionModel<Self> {
        FrictionModel::new(&linear_by_speed()).unwrap()
    }

    fn drive(model: &mut FrictionModel<Self>, manoeuvre: &Manoeuvre, tick: u32) -> Self::Outputs {
        let inputs = manoeuvre.bearing();
        if tick % 2 == 1 {
            model.between(inputs.speed)
        } else {
            model.step(manoeuvre.with(inputs, inputs.speed))
        }
    }

    fn import(model: &mut FrictionModel<Self>, block: &[u8]) -> Result<(), Refusal> {
        model.import_with_reading(block)
    }
}

fn export<S: StoredScene>(model: &FrictionModel<S>) -> Vec<u8> {
    let [block, other] = [0xA5, 0x5A].map(|fill| {
        let mut block = vec![fill; FrictionModel::<S>::STATE_BYTES];
        assert_eq!(model.export(&mut block), Ok(block.len()));
        block
    });
    assert_eq!(block, other);
    block
}

/// A block with another checksum that fits to it, by a crate's.
fn sealed(mut block: Vec<u8>) -> Vec<u8> {
    let body = block.len() - 4;
    let checksum = crc32fast::hash(&block[..body]);
    block[body..].copy_from_slice(&checksum.to_le_bytes());
    block
}

fn driven<S: Kept>(seed: u64, ticks: u32) -> (FrictionModel<S>, Manoeuvre) {
    let (mut model, mut manoeuvre) = (S::model(), Manoeuvre::new(seed));
    for tick in 0..ticks {
        manoeuvre.next();
        S::drive(&mut model, &manoeuvre, tick);
    }
    (model, manoeuvre)
}

fn goes_on<S: Kept>(set: bool) {
    let (mut moved, mut known) = (0, 0);
    for seed in 0..6 {
        let ticks = 1 + Random(seed).below(3000) as u32;
        let (mut model, mut manoeuvre) = driven::<S>(seed, ticks);
        if set {
            S::set(&mut model);
            for tick in ticks..ticks + 7 {
                manoeuvre.next();
                S::drive(&mut model, &manoeuvre, tick);
            }
        }
        let block = export(&model);
        let mut next = S::model();
        known += u32::from(export(&next) != block);
        assert_eq!(S::import(&mut next, &block), Ok(()));
        assert_eq!(export(&next), block);
        let mut last = String::new();
        // What lies between two steps first, and then a step without a load: they read what the last step has left.
        for tick in 1..=1000 {
            manoeuvre.next();
            manoeuvre.lost = tick == 2;
            // The shortest decimal of an f32 tells every two of them apart.
            let was = format!("{:?}", S::drive(&mut model, &manoeuvre, tick));
            let is = format!("{:?}", S::drive(&mut next, &manoeuvre, tick));
            assert_eq!(was, is, "seed {seed}, tick {tick}");
            moved += u32::from(is != last);
            last = is;
        }
        assert_eq!(export(&next), export(&model), "seed {seed}");
    }
    assert!(moved > 3000, "{moved} ticks differ from those before");
    assert_eq!(known, if S::STILL && !set { 0 } else { 6 });
}

static TWO_TURNS: DeviationMap = match DeviationMap::from_harmonics(2, &[]) {
    Ok(map) => map,
    Err(_) => panic!("a deviation is too large"),
};

#[test]
fn a_scene_goes_on_to_the_bit() {
    for set in [false, true] {
        goes_on::<CagedScrew>(set);
        goes_on::<Uncaged>(set);
        goes_on::<Linear>(set);
    }
    goes_on::<UncagedScrew<CROWD>>(false);
}

#[test]
fn a_scene_with_memory_goes_on_to_the_bit() {
    goes_on::<CagedByAngle>(false);
    goes_on::<UncagedByCounts>(false);
    goes_on::<LinearBySpeed>(false);
}

#[test]
fn what_a_model_did_before_an_import_does_not_count() {
    fn check<S: Kept>() {
        let (model, mut manoeuvre) = driven::<S>(5, 700);
        let block = export(&model);
        let (mut fresh, mut used) = (S::model(), driven::<S>(9, 411).0);
        assert_eq!(S::import(&mut fresh, &block), Ok(()));
        assert_eq!(S::import(&mut used, &block), Ok(()));
        for tick in 0..500 {
            manoeuvre.next();
            let [one, other] = [&mut fresh, &mut used]
                .map(|model| format!("{:?}", S::drive(model, &manoeuvre, tick)));
            assert_eq!(one, other, "tick {tick}");
        }
    }
    check::<CagedScrew>();
    check::<Uncaged>();
    check::<Linear>();
    check::<CagedByAngle>();
    check::<UncagedByCounts>();
    check::<LinearBySpeed>();
}

#[test]
fn closed_forms_are_kept_too() {
    let of = |branch| FrictionModel::<ClosedFormScrew>::new(&closed_form(branch)).unwrap();
    let block = export(&of(FrictionBranch::Rolling));
    assert_eq!(of(FrictionBranch::Sliding).import(&block), Ok(()));
    let mut caged = CagedScrew::model();
    assert_eq!(caged.import(&block), Err(Refusal::OtherScene));
}

/// What the nut did without power is no turn; only an absolute sensor knows it.
#[test]
fn the_turn_of_the_time_without_power_is_the_callers_choice() {
    let (mut model, mut manoeuvre) = driven::<CagedByAngle>(3, 900);
    manoeuvre.speed = 0.0;
    let still = CagedByAngle::drive(&mut model, &manoeuvre, 0).friction_torque;
    let block = export(&model);
    let mut turned = manoeuvre.clone();
    turned.angle = (turned.angle + 1e-3).rem_euclid(TAU);

    let mut fresh = CagedByAngle::model();
    fresh.import(&block).unwrap();
    let first = CagedByAngle::drive(&mut fresh, &turned, 0).friction_torque;
    assert_eq!(first, still);

    let mut spanning = CagedByAngle::model();
    spanning.import_with_reading(&block).unwrap();
    CagedByAngle::drive(&mut model, &turned, 0);
    let first = CagedByAngle::drive(&mut spanning, &turned, 0).friction_torque;
    assert_ne!(first, still);
    assert_eq!(export(&spanning), export(&model));
}

#[test]
fn checksum_is_the_one_of_a_crate() {
    let mut random = Random(3);
    for length in 0..300 {
        let bytes: Vec<u8> = (0..length).map(|_| random.bits() as u8).collect();
        assert_eq!(crc32(&bytes), crc32fast::hash(&bytes));
    }
}

#[test]
fn a_refusal_says_what_is_wrong() {
    for (refusal, text) in [
        (
            Refusal::Length {
                found: 3,
                expected: 114,
            },
            "3 bytes; the block has 114",
        ),
        (Refusal::NotAState, "the bytes are no state"),
        (
            Refusal::Version {
                found: 2,
                expected: 1,
            },
            "version 2; 1 is read",
        ),
        (Refusal::Damaged, "the checksum is wrong"),
        (Refusal::OtherScene, "the state is of another kind of scene"),
        (
            Refusal::OtherBalls {
                found: 2,
                expected: 37,
            },
            "the state has 2 balls, the model 37",
        ),
        (Refusal::OtherConstants, "the state is of other constants"),
        (
            Refusal::OutOfRange { field: "torque" },
            "torque is out of range",
        ),
    ] {
        assert_eq!(refusal.to_string(), text);
    }
}

#[test]
fn blocks_are_as_small_as_said() {
    fn bytes<S: StoredScene>() -> usize {
        FrictionModel::<S>::STATE_BYTES
    }
    assert_eq!(bytes::<CagedScrew>(), 24);
    assert_eq!(bytes::<ClosedFormScrew>(), 20);
    assert_eq!(bytes::<Uncaged>(), 370);
    assert_eq!(bytes::<Linear>(), 181);
    assert_eq!(bytes::<CagedByAngle>(), 116);
    assert_eq!(bytes::<UncagedByCounts>(), 487);
    assert_eq!(bytes::<LinearBySpeed>(), 300);
}

/// A block says which scene it is of, by numbers that stay.
#[test]
fn kinds_of_scenes_have_their_numbers() {
    fn kind<S: Kept>() -> u16 {
        let block = export(&S::model());
        u16::from_le_bytes([block[KIND_AT], block[KIND_AT + 1]])
    }
    let plain = [kind::<CagedScrew>(), kind::<Uncaged>(), kind::<Linear>()];
    assert_eq!(plain, [4, 6, 3]);
    let remembering = [
        kind::<CagedByAngle>(),
        kind::<UncagedByCounts>(),
        kind::<LinearBySpeed>(),
    ];
    assert_eq!(remembering, plain.map(|kind| 0x100 + kind));
}
