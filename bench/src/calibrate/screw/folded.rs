//! The caged scene with its laws over the load folded before, and kept while a fit changes what leaves them as they are.
//!
//! Folding them takes some thousand balls, as long as some ten thousand steps of the scene.

use epas_friction::law::coefficient::DirectionalCoefficient;
use epas_friction::scene::{
    Admitted, CagedBallScrewConfiguration, CagedCoefficients, CagedConstants, CagedFull,
    CagedState, Inputs, Outputs, Passage, Scene, Sliding, SlidingFriction,
};
use epas_friction::{CagedBallScrew, Error, Range};

use super::recent::Recent;

/// Configurations that are kept: those of all slopes at one place, and some of the next.
const KEPT: usize = 16;

/// [`CagedBallScrew`], of constants whose laws are folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoldedBallScrew;

/// Constants of a caged ball screw, with the state that they start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Folded {
    /// Its constants.
    pub constants: CagedConstants,
    /// Its laws for the configuration's own friction coefficient.
    pub state: CagedState,
}

/// The same with laws for other friction coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldedBetween {
    own: Folded,
    coefficients: CagedCoefficients,
}

/// Laws that were folded last.
#[derive(Debug)]
pub struct Folds {
    own: Recent<CagedBallScrewConfiguration, Folded>,
    between: Recent<(CagedBallScrewConfiguration, [f32; 2]), FoldedBetween>,
}

impl Folded {
    /// Folds a configuration.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub fn new(configuration: &CagedBallScrewConfiguration) -> Result<Self, Error> {
        let constants = CagedConstants::new(configuration)?;
        Ok(Self {
            state: CagedBallScrew::initial_state(&constants),
            constants,
        })
    }

    /// Full friction in both directions under an axial load, N, that opposes a forward motion, by a
    /// friction coefficient that counts in proportion.
    pub fn limits(&self, axial_load: f32, friction: f32) -> SlidingFriction {
        self.limits_between(None, axial_load, friction)
    }

    fn limits_between(
        &self,
        coefficients: Option<&CagedCoefficients>,
        axial_load: f32,
        friction: f32,
    ) -> SlidingFriction {
        let inputs = Inputs {
            nut_speed: 1.0,
            axial_load,
        };
        let both = DirectionalCoefficient {
            forward: friction,
            backward: friction,
        };
        // By its laws nothing of the state changes.
        let mut state = self.state;
        let full = CagedBallScrew::full(&self.constants, &mut state, coefficients, inputs, both);
        CagedBallScrew::friction(&full)
    }

    /// With laws for friction coefficients between two.
    pub fn between(self, least: f32, largest: f32) -> FoldedBetween {
        FoldedBetween {
            coefficients: CagedBallScrew::coefficients(&self.constants, least, largest),
            own: self,
        }
    }
}

impl FoldedBetween {
    /// Full friction in both directions under an axial load, N, that opposes a forward motion, by a friction coefficient.
    pub fn limits(&self, axial_load: f32, friction: f32) -> SlidingFriction {
        let coefficients = Some(&self.coefficients);
        self.own.limits_between(coefficients, axial_load, friction)
    }
}

impl Default for Folds {
    fn default() -> Self {
        Self {
            own: Recent::new(KEPT),
            between: Recent::new(KEPT),
        }
    }
}

impl Folds {
    /// The laws of a configuration for its own friction coefficient.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub fn own(&self, configuration: &CagedBallScrewConfiguration) -> Result<Folded, Error> {
        self.own.of(*configuration, || Folded::new(configuration))
    }

    /// The laws of a configuration for friction coefficients between two.
    ///
    /// # Errors
    /// As [`Self::own`].
    pub fn between(
        &self,
        configuration: &CagedBallScrewConfiguration,
        (least, largest): (f32, f32),
    ) -> Result<FoldedBetween, Error> {
        self.between.of((*configuration, [least, largest]), || {
            Ok(self.own(configuration)?.between(least, largest))
        })
    }
}

impl Scene for FoldedBallScrew {
    type Configuration = FoldedBetween;
    type Constants = FoldedBetween;
    type State = CagedState;
    type Inputs = Inputs;
    type Known = Inputs;
    type Outputs = Outputs;

    fn constants(folded: &FoldedBetween) -> Result<FoldedBetween, Error> {
        Ok(*folded)
    }

    fn initial_state(folded: &FoldedBetween) -> CagedState {
        folded.own.state
    }

    fn take_over(folded: &FoldedBetween, state: &mut CagedState) -> Result<(), Error> {
        CagedBallScrew::take_over(&folded.own.constants, state)
    }

    fn admit(folded: &FoldedBetween, inputs: Inputs) -> Admitted<Inputs> {
        CagedBallScrew::admit(&folded.own.constants, inputs)
    }

    fn outputs(folded: &FoldedBetween, state: &mut CagedState, known: Inputs) -> Outputs {
        CagedBallScrew::outputs(&folded.own.constants, state, known)
    }

    fn largest_friction(folded: &FoldedBetween) -> f32 {
        CagedBallScrew::largest_friction(&folded.own.constants)
    }
}

impl Sliding for FoldedBallScrew {
    const FRICTION: Range = CagedBallScrew::FRICTION;

    const COUNTS_PRELOAD: bool = CagedBallScrew::COUNTS_PRELOAD;

    type Coefficients = CagedCoefficients;
    type Full = CagedFull;

    fn coefficients(folded: &FoldedBetween, _: f32, _: f32) -> CagedCoefficients {
        folded.coefficients
    }

    fn full(
        folded: &FoldedBetween,
        state: &mut CagedState,
        coefficients: Option<&CagedCoefficients>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFull {
        CagedBallScrew::full(&folded.own.constants, state, coefficients, inputs, friction)
    }

    fn friction(full: &CagedFull) -> SlidingFriction {
        CagedBallScrew::friction(full)
    }

    fn passed(
        folded: &FoldedBetween,
        inputs: Inputs,
        full: &CagedFull,
        passage: Passage,
    ) -> Outputs {
        CagedBallScrew::passed(&folded.own.constants, inputs, full, passage)
    }

    fn in_a_tick(folded: &FoldedBetween, turn: f32, measured: f32) -> (f32, f32) {
        CagedBallScrew::in_a_tick(&folded.own.constants, turn, measured)
    }
}

#[cfg(test)]
mod tests {
    use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters, TemperatureFade};
    use epas_friction::law::memory::{Hysteresis, LoadExactElements};
    use epas_friction::law::motion::SpeedOverTick;
    use epas_friction::scene::{Freshness, WithMemory, WithMemoryConfiguration, WithMemoryInputs};
    use epas_friction::{FrictionModel, defaults};

    use super::*;
    use crate::designs::DesignSource;

    fn configuration() -> CagedBallScrewConfiguration {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        source.load().unwrap().configuration
    }

    fn with_memory<B>(
        scene: B,
        coefficient: CoefficientLaw,
    ) -> WithMemoryConfiguration<B, LoadExactElements<8>, SpeedOverTick, CoefficientLaw> {
        let elements = LoadExactElements::new(0.2, 0.002, 4.0).unwrap();
        WithMemoryConfiguration {
            scene,
            elements,
            angle: SpeedOverTick::new(1e-3, 1e3).unwrap(),
            reference_load: 2000.0,
            play: elements.breakaway(),
            coefficient,
            temperature: TemperatureFade::new(303.15, 1.0, 1.0).unwrap(),
            freshness: Freshness::DEFAULT,
        }
    }

    /// Bit by bit what the crate's scene with memory puts out, whose laws are folded by itself.
    #[test]
    fn folded_before_is_the_same() {
        let law = CoefficientLaw::new(&CoefficientParameters {
            boundary: 0.12,
            full_film: 0.05,
            half_share_speed: 5.0,
            forward: 1.02,
            backward: 0.98,
            ..CoefficientParameters::constant(0.12, defaults::VISCOSITY)
        })
        .unwrap();
        let folds = Folds::default();
        for friction in [0.12, 0.08, 0.12] {
            let scene = CagedBallScrewConfiguration {
                friction,
                ..configuration()
            };
            let folded = folds.between(&scene, law.extremes()).unwrap();
            let mut kept =
                FrictionModel::<WithMemory<FoldedBallScrew, _, _>>::new(&with_memory(folded, law))
                    .unwrap();
            let mut own =
                FrictionModel::<WithMemory<CagedBallScrew, _, _>>::new(&with_memory(scene, law))
                    .unwrap();
            for tick in 0..2000 {
                let time = 1e-3 * tick as f32;
                let speed = 20.0 * (9.0 * time).sin();
                let inputs = WithMemoryInputs {
                    scene: Inputs {
                        nut_speed: speed,
                        axial_load: 3000.0 * (5.0 * time).cos(),
                    },
                    reading: speed,
                    load_age: 0.0,
                    temperature: 290.0 + 10.0 * time,
                    temperature_age: 0.0,
                };
                assert_eq!(kept.step(inputs), own.step(inputs), "{friction}, {tick}");
            }
            assert_eq!(kept.faulted_ticks(), own.faulted_ticks());
        }
    }

    /// What a configuration refuses is refused again: nothing of it is kept.
    #[test]
    fn wrong_configurations_are_refused() {
        let folds = Folds::default();
        for _ in 0..2 {
            let wrong = CagedBallScrewConfiguration {
                friction: f32::NAN,
                ..configuration()
            };
            let error = folds.between(&wrong, (0.1, 0.2)).unwrap_err();
            assert_eq!(error.field(), "friction");
        }
    }
}
