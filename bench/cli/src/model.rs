//! One model of every scene at run time: what `simulate`, co-simulation units and Python step.

use epas_design::caged::{self, Block};
use epas_design::caged_scene::CagedScene;
use epas_design::uncaged::{Folded, NODES};
use epas_design::uncaged_scene::ScrewConfiguration;
use epas_friction::law::Elements as MemoryElements;
use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient};
use epas_friction::law::memory::ProportionalElements;
use epas_friction::law::motion::{Deadband, NutAngle, SpeedOverTick};
use epas_friction::scene::{
    CagedBallScrew, CagedConstants, ChangingFriction, ClosedFormScrew,
    ClosedFormScrewConfiguration, ClosedFormScrewConstants, CoefficientFor, Sliding, StoredScene,
    UncagedBallScrew, WithMemory, WithMemoryInputs,
};
use epas_friction::stored::{Fingerprinted, Stored};
use epas_friction::train::Train;
use epas_friction::{
    Error, Faults, FrictionModel, Inputs, LinearBearingConfiguration, LinearBearingTrain,
    LinearInputs, LinearOutputs, Outputs, Range, Refusal, Regime, Scene, UncagedOutputs,
};

use crate::simulate::memory::{self, Remembered};

/// Most balls of a row: one compiled model serves all numbers up to it.
const CAPACITY: usize = 64;

pub const ELEMENTS: usize = 8;

/// The elements of a memory that follow from a design.
pub type Elements = ProportionalElements<ELEMENTS>;

/// A row of balls with a memory that follows the speed of every tick, behind a dead band of an encoder's step.
type Remembering<S> = WithMemory<S, Elements, Deadband<SpeedOverTick>, OneCoefficient>;

/// Temperature without one of a trace, K.
pub const TEMPERATURE: f32 = 293.15;

/// What a tick is told; a scene takes what it has.
#[derive(Clone, Copy, Debug)]
pub struct TickInputs {
    /// Speed of the nut, rad/s, or of the carriage, m/s.
    pub speed: f32,
    /// Axial load of a screw, normal load of a bearing, N.
    pub load: f32,
    /// Load across a bearing, N.
    pub side_load: f32,
    /// Reading of a memory's sensor: the speed, or the angle of the nut within half a turn either way, rad.
    pub reading: f32,
    /// Temperature that a memory follows, K.
    pub temperature: f32,
}

impl TickInputs {
    /// A tick whose sensor reads the speed.
    pub const fn new(speed: f32, load: f32) -> Self {
        Self {
            speed,
            load,
            side_load: 0.0,
            reading: speed,
            temperature: TEMPERATURE,
        }
    }
}

/// Outputs of a tick; 0 where a scene has no such quantity.
#[derive(Clone, Copy, Debug)]
pub struct TickOutputs {
    /// Friction torque of a screw, N m; friction force of a bearing, N.
    pub friction: f32,
    /// Torque that holds the load without friction, N m.
    pub load_torque: f32,
    /// Work out over work in.
    pub efficiency: f32,
    /// Friction of the grooves of a row of balls, N m or N.
    pub groove: f32,
    /// Friction between its balls, N m or N.
    pub ball: f32,
    /// Pairs of balls that press on each other.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// What the mechanism does.
    pub regime: Regime,
    /// What was wrong, or limited.
    pub faults: Faults,
}

impl From<Outputs> for TickOutputs {
    fn from(outputs: Outputs) -> Self {
        Self {
            friction: outputs.friction_torque,
            load_torque: outputs.load_torque,
            efficiency: outputs.efficiency,
            groove: 0.0,
            ball: 0.0,
            contacts: 0,
            largest_contact_force: 0.0,
            regime: outputs.regime,
            faults: outputs.faults,
        }
    }
}

impl From<UncagedOutputs> for TickOutputs {
    fn from(outputs: UncagedOutputs) -> Self {
        Self {
            groove: outputs.groove_torque,
            ball: outputs.ball_torque,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
            ..Outputs::from(outputs).into()
        }
    }
}

impl From<LinearOutputs> for TickOutputs {
    fn from(outputs: LinearOutputs) -> Self {
        Self {
            friction: outputs.friction_force,
            load_torque: 0.0,
            efficiency: 0.0,
            groove: outputs.groove_force,
            ball: outputs.ball_force,
            contacts: outputs.contacts,
            largest_contact_force: outputs.largest_contact_force,
            regime: outputs.regime,
            faults: outputs.faults,
        }
    }
}

/// A scene that runs on this machine.
pub trait Model: Send + Sync {
    /// One tick.
    fn step(&mut self, inputs: &TickInputs) -> TickOutputs;
    /// Friction at a reading between two ticks; none without memory.
    fn between(&mut self, _reading: f32) -> Option<TickOutputs> {
        None
    }
    /// Balls that press on the one in front, one bit each.
    fn pressing(&self) -> u64 {
        0
    }
    /// Back to the state before the first tick.
    fn reset(&mut self);
    /// Consecutive ticks with a fault.
    fn faulted_ticks(&self) -> u32;
    /// Sets the friction coefficient of ball and groove.
    fn set_friction(&mut self, friction: f32) -> Result<(), Error>;
    /// Goes on with the block of these words, of as many friction coefficients: a caged screw.
    fn swap(&mut self, _words: &[u32]) -> Result<(), Error> {
        Err(NO_BLOCK)
    }
    /// Sets where the grooves' deviations are counted from: angle of the nut, rad, or place of the carriage, m. False where
    /// the scene does not take it.
    fn set_place(&mut self, _place: f32) -> bool {
        false
    }
    /// Its state as a block.
    fn export(&self) -> Result<Vec<u8>, Refusal>;
    /// Takes the state of a block over, with the last reading of its sensor.
    fn import(&mut self, block: &[u8]) -> Result<(), Refusal>;
    /// The same model in the same state.
    fn copied(&self) -> Box<dyn Model>;
}

impl Clone for Box<dyn Model> {
    fn clone(&self) -> Self {
        self.copied()
    }
}

/// A model, or the number of its design that is out of range.
pub type Built = Result<Box<dyn Model>, Error>;

/// The refusal of a block by a scene that has none.
const NO_BLOCK: Error = Error::OutOfRange {
    field: "branch",
    value: 1.0,
    allowed: Range::new(0.0, 0.0),
};

/// A caged screw without memory.
pub fn caged(scene: &CagedScene) -> Built {
    Ok(match scene {
        CagedScene::Folded(Block::One(block)) => {
            Box::new(FrictionModel::<CagedBallScrew>::new(block)?)
        }
        CagedScene::Folded(Block::Range(block)) => Box::new(FrictionModel::<
            CagedBallScrew<{ caged::NODES }>,
        >::new(block)?),
        CagedScene::ClosedForm(form) => Box::new(ClosedForm {
            model: FrictionModel::new(form)?,
            form: *form,
        }),
    })
}

pub fn uncaged(
    configuration: &ScrewConfiguration,
    remembered: Option<&Remembered>,
    friction: f32,
) -> Built {
    let tick = configuration.tick;
    match configuration.folded {
        Folded::One(folded) => {
            let scene = configuration.with(folded);
            row::<UncagedBallScrew<CAPACITY, 1>>(scene, remembered, tick, friction)
        }
        Folded::Range(folded) => {
            let scene = configuration.with(folded);
            row::<UncagedBallScrew<CAPACITY, NODES>>(scene, remembered, tick, friction)
        }
    }
}

pub fn linear(configuration: LinearBearingConfiguration, remembered: Option<&Remembered>) -> Built {
    let (tick, friction) = (configuration.tick, configuration.friction);
    row::<LinearBearingTrain<CAPACITY>>(configuration, remembered, tick, friction)
}

fn row<S: HostScene + ChangingFriction>(
    scene: S::Configuration,
    remembered: Option<&Remembered>,
    tick: f32,
    friction: f32,
) -> Built
where
    FrictionModel<S>: Model + 'static,
    FrictionModel<Remembering<S>>: Model + 'static,
{
    let Some(remembered) = remembered else {
        return Ok(Box::new(FrictionModel::<S>::new(&scene)?));
    };
    let speed = memory::rows_speed(tick, remembered.encoder_step)?;
    let whole = memory::configuration(scene, remembered, speed, friction)?;
    Ok(Box::new(FrictionModel::<Remembering<S>>::new(&whole)?))
}

/// A scene that a host steps without knowing which it is.
pub trait HostScene:
    StoredScene
    + Sliding<
        Inputs: Stored,
        Outputs: Into<TickOutputs>,
        Constants: Copy + Send + Sync,
        State: Send + Sync,
        Friction: Stored + Default + Send + Sync,
    > + Copy
    + Send
    + Sync
    + 'static
{
    fn inputs(inputs: &TickInputs) -> Self::Inputs;

    fn pressing(_: &Self::State) -> u64 {
        0
    }

    fn set_place(_: &mut FrictionModel<Self>, _: f32) -> bool {
        false
    }

    fn swap(_: &mut FrictionModel<Self>, _: &[u32]) -> Result<(), Error> {
        Err(NO_BLOCK)
    }

    fn set_remembered_place<E, A, L>(
        _: &mut FrictionModel<WithMemory<Self, E, A, L>>,
        _: f32,
    ) -> bool
    where
        E: MemoryElements + Copy,
        A: NutAngle + Copy,
        L: CoefficientFor<Self::Inputs>,
    {
        false
    }
}

const fn screw_inputs(inputs: &TickInputs) -> Inputs {
    Inputs {
        nut_speed: inputs.speed,
        axial_load: inputs.load,
    }
}

fn pressing<const N: usize>(train: &Train<N>) -> u64 {
    train
        .contacts()
        .iter()
        .fold(0, |bits, contact| bits | 1 << contact.ball)
}

impl<const K: usize> HostScene for CagedBallScrew<K> {
    fn inputs(inputs: &TickInputs) -> Inputs {
        screw_inputs(inputs)
    }

    fn swap(model: &mut FrictionModel<Self>, words: &[u32]) -> Result<(), Error> {
        model.swap_constants(CagedConstants::from_block(words)?)?;
        Ok(())
    }
}

impl HostScene for ClosedFormScrew {
    fn inputs(inputs: &TickInputs) -> Inputs {
        screw_inputs(inputs)
    }
}

impl<const N: usize, const K: usize> HostScene for UncagedBallScrew<N, K> {
    fn inputs(inputs: &TickInputs) -> Inputs {
        screw_inputs(inputs)
    }

    fn pressing(state: &Self::State) -> u64 {
        pressing(&state.circuit.train)
    }

    fn set_place(model: &mut FrictionModel<Self>, angle: f32) -> bool {
        model.set_nut_angle(angle);
        true
    }

    fn set_remembered_place<E, A, L>(
        model: &mut FrictionModel<WithMemory<Self, E, A, L>>,
        angle: f32,
    ) -> bool
    where
        E: MemoryElements + Copy,
        A: NutAngle + Copy,
        L: CoefficientFor<Inputs>,
    {
        model.set_nut_angle(angle);
        true
    }
}

impl<const N: usize> HostScene for LinearBearingTrain<N> {
    fn inputs(inputs: &TickInputs) -> LinearInputs {
        LinearInputs {
            speed: inputs.speed,
            normal_load: inputs.load,
            side_load: inputs.side_load,
        }
    }

    fn pressing(state: &Self::State) -> u64 {
        pressing(&state.circuit.train)
    }

    fn set_place(model: &mut FrictionModel<Self>, position: f32) -> bool {
        model.set_carriage_position(position);
        true
    }
}

fn exported<S: StoredScene>(model: &FrictionModel<S>) -> Result<Vec<u8>, Refusal> {
    let mut block = vec![0; FrictionModel::<S>::STATE_BYTES];
    let length = model.export(&mut block)?;
    block.truncate(length);
    Ok(block)
}

/// A caged screw by a closed form, with what was set for it: any friction coefficient may be.
#[derive(Clone, Copy)]
struct ClosedForm {
    model: FrictionModel<ClosedFormScrew>,
    form: ClosedFormScrewConfiguration,
}

impl Model for ClosedForm {
    fn step(&mut self, inputs: &TickInputs) -> TickOutputs {
        self.model.step(screw_inputs(inputs)).into()
    }

    fn reset(&mut self) {
        self.model.reset();
    }

    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        let form = ClosedFormScrewConfiguration {
            friction,
            ..self.form
        };
        self.model
            .swap_constants(ClosedFormScrewConstants::new(&form)?)?;
        self.form = form;
        Ok(())
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        exported(&self.model)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        self.model.import(block)
    }

    fn copied(&self) -> Box<dyn Model> {
        Box::new(*self)
    }
}

impl<S: HostScene + ChangingFriction> Model for FrictionModel<S>
where
    Self: Copy + Send + Sync + 'static,
{
    fn step(&mut self, inputs: &TickInputs) -> TickOutputs {
        Self::step(self, S::inputs(inputs)).into()
    }

    fn pressing(&self) -> u64 {
        S::pressing(self.state())
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Self::faulted_ticks(self)
    }

    fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        Self::set_friction(self, friction)
    }

    fn swap(&mut self, words: &[u32]) -> Result<(), Error> {
        S::swap(self, words)
    }

    fn set_place(&mut self, place: f32) -> bool {
        S::set_place(self, place)
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        exported(self)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        Self::import(self, block)
    }

    fn copied(&self) -> Box<dyn Model> {
        Box::new(*self)
    }
}

/// A friction coefficient that one number may take the place of.
pub trait Coefficient: Sized {
    fn one(friction: f32) -> Result<Self, Error>;
}

impl Coefficient for OneCoefficient {
    fn one(friction: f32) -> Result<Self, Error> {
        Self::new(friction)
    }
}

impl Coefficient for CoefficientLaw {
    fn one(friction: f32) -> Result<Self, Error> {
        Self::constant(friction)
    }
}

/// A sensor of an angle or a speed whose last reading can be kept.
pub trait Sensor:
    NutAngle<Reading = f32, State: Stored + Send + Sync> + Fingerprinted + Copy + Send + Sync + 'static
{
}

impl<A> Sensor for A where
    A: NutAngle<Reading = f32, State: Stored + Send + Sync>
        + Fingerprinted
        + Copy
        + Send
        + Sync
        + 'static
{
}

impl<S, E, A, L> Model for FrictionModel<WithMemory<S, E, A, L>>
where
    S: HostScene,
    E: MemoryElements<State: Stored> + Fingerprinted + Copy,
    A: Sensor,
    L: Coefficient + CoefficientFor<<S as Scene>::Inputs>,
    Self: Copy + Send + Sync + 'static,
{
    fn step(&mut self, inputs: &TickInputs) -> TickOutputs {
        let inputs = WithMemoryInputs {
            scene: S::inputs(inputs),
            reading: inputs.reading,
            load_age: 0.0,
            temperature: inputs.temperature,
            temperature_age: 0.0,
        };
        Self::step(self, inputs).into()
    }

    fn between(&mut self, reading: f32) -> Option<TickOutputs> {
        Some(Self::between(self, reading).into())
    }

    fn pressing(&self) -> u64 {
        S::pressing(&self.state().scene)
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Self::faulted_ticks(self)
    }

    fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        self.set_coefficient(L::one(friction)?)
    }

    fn set_place(&mut self, place: f32) -> bool {
        S::set_remembered_place(self, place)
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        exported(self)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        self.import_with_reading(block)
    }

    fn copied(&self) -> Box<dyn Model> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use epas_design::caged_scene::words;
    use epas_design::files::read;

    use super::*;

    const DESIGN: &str = "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\n\
                          contact_angle = 0.7853982\nloaded_balls = 71\n";

    /// A block takes another one of as many coefficients, and its own coefficient alone; a closed form takes any coefficient and no block.
    #[test]
    fn blocks_and_coefficients_are_set() {
        let inputs = TickInputs::new(1e3, 3000.0);
        let design = read(DESIGN, "gear").unwrap();
        let own = words(&design, (0.1, 0.1)).unwrap().unwrap();
        let mut other = own.clone();
        *other.last_mut().unwrap() ^= 1;
        let mut model = caged(&CagedScene::of(&design).unwrap()).unwrap();
        let torque = model.step(&inputs).friction;
        assert_eq!(model.swap(&other).unwrap_err().field(), "checksum");
        model.swap(&own).unwrap();
        assert_eq!(model.step(&inputs).friction, torque);
        assert_eq!(model.set_friction(0.2).unwrap_err().field(), "friction");
        let sliding = read(&format!("{DESIGN}branch = \"sliding\"\n"), "gear").unwrap();
        let mut model = caged(&CagedScene::of(&sliding).unwrap()).unwrap();
        let before = model.step(&inputs).friction;
        model.set_friction(0.2).unwrap();
        assert!(model.step(&inputs).friction > 1.5 * before);
        assert_eq!(model.swap(&own).unwrap_err().field(), "branch");
    }
}
