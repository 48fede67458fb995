//! A ball screw whose balls press on each other.

use epas_friction::{GrooveFit, UncagedBallScrew, UncagedBallScrewConfiguration};

use crate::caged::{limits, screw_inputs};
use crate::design::ball_screw;
use crate::scene::{CScene, TablePointers, Tables, regime};
use crate::status::{EPAS_FIELD_FIT, Failure};
use crate::types::{
    EPAS_FAULT_CALL, EPAS_FIT_PLAY, EPAS_FIT_PRELOAD, EPAS_FIT_ZERO, EPAS_REGIME_STANDING,
    EPAS_SCREW_BALLS, Inputs, ScrewConfiguration, ScrewPlace, TrainOutputs,
};

/// `epas_screw_t`
pub(crate) struct Screw;

impl CScene for Screw {
    type Scene = UncagedBallScrew<EPAS_SCREW_BALLS>;
    type Place = ScrewPlace;
    type Configuration = ScrewConfiguration;
    type Inputs = Inputs;
    type Outputs = TrainOutputs;

    const MARK: u32 = 0xE9A5_0102;
    const REFUSED: TrainOutputs = REFUSED;

    fn tables(configuration: &ScrewConfiguration) -> TablePointers {
        TablePointers {
            passing: configuration.screw_deviation,
            own: configuration.nut_deviation,
            load_shares: configuration.load_shares,
            load_share_count: configuration.load_share_count,
        }
    }

    fn configure(
        configuration: &ScrewConfiguration,
        tables: Tables,
    ) -> Result<UncagedBallScrewConfiguration, Failure> {
        Ok(UncagedBallScrewConfiguration {
            design: ball_screw(&configuration.design)?,
            friction: configuration.friction,
            ball_friction: configuration.ball_friction,
            fit: match configuration.fit {
                EPAS_FIT_ZERO => GrooveFit::Zero,
                EPAS_FIT_PLAY => GrooveFit::Play,
                EPAS_FIT_PRELOAD => GrooveFit::Preload {
                    contact_force: configuration.contact_preload,
                },
                other => return Err(Failure::count(EPAS_FIELD_FIT, other, 0, 2)),
            },
            turns: configuration.turns,
            return_length: configuration.return_length,
            screw_deviation: tables.passing,
            nut_deviation: tables.own,
            load_shares: tables.load_shares,
            reversal_speed: configuration.reversal_speed,
            tick: configuration.tick,
            limits: limits(&configuration.limits),
        })
    }

    #[inline]
    fn inputs(inputs: Inputs) -> epas_friction::Inputs {
        screw_inputs(inputs)
    }

    #[inline]
    fn outputs(outputs: epas_friction::TrainOutputs) -> TrainOutputs {
        train_outputs(outputs)
    }
}

/// What a refused call puts out.
pub(crate) const REFUSED: TrainOutputs = TrainOutputs {
    friction: 0.0,
    groove_friction: 0.0,
    ball_friction: 0.0,
    load_torque: 0.0,
    largest_contact_force: 0.0,
    contacts: 0,
    regime: EPAS_REGIME_STANDING,
    faults: EPAS_FAULT_CALL,
};

#[inline]
pub(crate) fn train_outputs(outputs: epas_friction::TrainOutputs) -> TrainOutputs {
    TrainOutputs {
        friction: outputs.friction,
        groove_friction: outputs.groove_friction,
        ball_friction: outputs.ball_friction,
        load_torque: outputs.load_torque,
        largest_contact_force: outputs.largest_contact_force,
        contacts: u32::from(outputs.contacts),
        regime: regime(outputs.regime),
        faults: u32::from(outputs.faults.bits()),
    }
}
