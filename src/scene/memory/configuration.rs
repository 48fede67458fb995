//! Configuration and inputs of a scene with memory, and which friction coefficient goes with which scene.

use crate::error::{Error, Range};
use crate::law::coefficient::{CoefficientLaw, CoefficientModel, OneCoefficient, TemperatureFade};
use crate::law::fade::Fade;
use crate::law::memory::Hysteresis;
use crate::scene::contract::Inputs;

/// Inputs of a scene with memory at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WithMemoryInputs<I, R> {
    /// Speed and loads. The friction coefficient follows this speed; the memory follows the angle.
    pub scene: I,
    /// Reading of the angle sensor.
    pub reading: R,
    /// Time since the loads were found, s, 0 or more; 0 where they are of this tick.
    pub load_age: f32,
    /// Temperature of the screw, K, 150 to 500.
    pub temperature: f32,
    /// Time since the temperature was found, s, 0 or more.
    pub temperature_age: f32,
}

/// How old a load may be; NaN is too old, an age below zero counts as none. Friction fades; the torque that holds the load, and the
/// efficiency beside it, are those of the whole load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Freshness {
    /// Age up to which a load counts as it is, s, 0 to 1e3.
    pub load_hold: f32,
    /// Time after that in which it fades to none, s, 1e-6 to 1e3.
    pub load_fade: f32,
}

impl Freshness {
    /// Loads of the last 10 ms as they are, which fade in 90 ms: assumed for an estimator that runs every 10 ms, not measured.
    pub const DEFAULT: Self = Self {
        load_hold: 0.01,
        load_fade: 0.09,
    };

    /// These times, checked.
    pub(super) const fn fade(self) -> Result<Fade, Error> {
        Fade::new(
            ("load_hold", self.load_hold, Range::new(0.0, 1e3)),
            ("load_fade", self.load_fade, Range::new(1e-6, 1e3)),
        )
    }
}

/// Configuration of a scene with memory; elements, sensor and law are checked already.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithMemoryConfiguration<C, E, A, L = CoefficientLaw> {
    /// Configuration of the scene without memory. Its friction coefficient is one that the law gives, best the boundary
    /// coefficient; its tick is that of [`FrictionModel::step`](crate::FrictionModel::step).
    pub scene: C,
    /// Elements of the memory.
    pub elements: E,
    /// Sensor of the nut's angle, or of the carriage's place.
    pub angle: A,
    /// Axial load of a screw, or normal load of a bearing, N, at which the elements are designed; 1e-3 to 1e7. Only
    /// load-exact elements read it.
    pub reference_load: f32,
    /// Half the turn, rad (m), by which the motion has to go back before balls go back too; 0 to 1e3. Set it to the elements'
    /// breakaway angle: after twice that angle friction has turned round. With 0 what presses leaves at a reversal in one step.
    pub play: f32,
    /// Friction coefficient: by speed, temperature and direction, or one alone.
    pub coefficient: L,
    /// How old a temperature may be, and which one replaces it then.
    pub temperature: TemperatureFade,
    /// How old loads may be.
    pub freshness: Freshness,
}

impl<C: Copy, E: Hysteresis + Copy, A: Copy> WithMemoryConfiguration<C, E, A, OneCoefficient> {
    /// A scene with one friction coefficient, 1e-6 to 1, and the elements' breakaway as play.
    pub fn new(
        scene: C,
        friction: f32,
        elements: E,
        angle: A,
        reference_load: f32,
    ) -> Result<Self, Error> {
        Ok(Self {
            scene,
            elements,
            angle,
            reference_load,
            play: elements.breakaway(),
            coefficient: OneCoefficient::new(friction)?,
            temperature: TemperatureFade::DEFAULT,
            freshness: Freshness::DEFAULT,
        })
    }
}

/// A friction coefficient that a scene with the inputs `I` takes: it reads their speed in its own unit and adds to the friction in the
/// scene's unit.
///
/// [`OneCoefficient`] reads no speed and adds nothing: it goes with every scene. [`CoefficientLaw`] reads the speed of a nut,
/// rad/s, and adds the lubricant's drag torque, N m: around a linear bearing it does not compile:
///
/// ```compile_fail,E0277
/// use epas_friction::law::coefficient::CoefficientLaw;
/// # use epas_friction::law::{memory::ProportionalElements, motion::SpeedOverTick};
/// # use epas_friction::{LinearBearingTrain, Scene, scene::WithMemory};
/// # fn is_a_scene<S: Scene>() {}
/// is_a_scene::<WithMemory<LinearBearingTrain<12>, ProportionalElements<8>, SpeedOverTick, CoefficientLaw>>();
/// ```
///
/// ```
/// use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient};
/// # use epas_friction::law::{memory::ProportionalElements, motion::SpeedOverTick};
/// # use epas_friction::{CagedBallScrew, LinearBearingTrain, Scene, scene::WithMemory};
/// # fn is_a_scene<S: Scene>() {}
/// is_a_scene::<WithMemory<LinearBearingTrain<12>, ProportionalElements<8>, SpeedOverTick, OneCoefficient>>();
/// is_a_scene::<WithMemory<CagedBallScrew, ProportionalElements<8>, SpeedOverTick, CoefficientLaw>>();
/// ```
pub trait CoefficientFor<I>: CoefficientModel {}

impl<I> CoefficientFor<I> for OneCoefficient {}

impl CoefficientFor<Inputs> for CoefficientLaw {}
