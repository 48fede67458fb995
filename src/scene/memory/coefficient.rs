//! Which friction coefficient goes with which scene.

use crate::law::coefficient::{CoefficientLaw, CoefficientModel, OneCoefficient};
use crate::scene::contract::Inputs;

/// A friction coefficient that a scene with the inputs `I` takes, because it reads their speed in its own unit and what it adds
/// to the friction is of the scene's unit.
///
/// [`OneCoefficient`] reads no speed and adds nothing: it goes with every scene. [`CoefficientLaw`] reads the speed of a nut,
/// rad/s, and adds the lubricant's drag torque, N m: it goes with ball screws alone. Around a linear bearing, whose speed is
/// in m/s and whose friction is a force, it does not compile:
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
