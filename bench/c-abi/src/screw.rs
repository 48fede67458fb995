//! A ball screw whose balls press on each other.

use epas_friction::{LoadShares, UncagedBallScrew, UncagedBallScrewConfiguration};

use crate::design::{ball_screw, clearance, rolling_resistance};
use crate::scene::{CScene, TablePointers, Tables, limits, regime, screw_inputs};
use crate::status::Failure;
use crate::types::{
    EPAS_FAULT_CALL, EPAS_REGIME_STANDING, EPAS_SCREW_BALLS, EPAS_SCREW_STATE_BYTES, Inputs,
    ScrewConfiguration, ScrewOutputs, ScrewPlace,
};
use crate::version::mark;

/// `epas_screw_t`
pub(crate) struct Screw;

impl CScene for Screw {
    type Scene = UncagedBallScrew<EPAS_SCREW_BALLS>;
    type Place = ScrewPlace;
    type Configuration = ScrewConfiguration;
    type Inputs = Inputs;
    type Outputs = ScrewOutputs;

    const MARK: u32 = mark(2);
    const STATE_BYTES: u32 = EPAS_SCREW_STATE_BYTES;
    const REFUSED: ScrewOutputs = ScrewOutputs {
        friction_torque: 0.0,
        groove_torque: 0.0,
        ball_torque: 0.0,
        load_torque: 0.0,
        largest_contact_force: 0.0,
        contacts: 0,
        regime: EPAS_REGIME_STANDING,
        faults: EPAS_FAULT_CALL,
    };

    fn tables(configuration: &ScrewConfiguration) -> TablePointers {
        TablePointers {
            passing: configuration.screw_deviation,
            recirculating: configuration.nut_deviation,
            load_shares: configuration.load_shares,
            load_share_count: configuration.load_share_count,
            ..TablePointers::NONE
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
            rolling_resistance: rolling_resistance(
                configuration.hysteresis_loss,
                configuration.lubricant_drag,
            ),
            clearance: clearance(configuration.clearance)?,
            turns: configuration.turns,
            return_length: configuration.return_length,
            screw_deviation: tables.passing,
            nut_deviation: tables.recirculating,
            load_shares: LoadShares::same(tables.load_shares),
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
    fn outputs(outputs: epas_friction::UncagedOutputs) -> ScrewOutputs {
        ScrewOutputs {
            friction_torque: outputs.friction_torque,
            groove_torque: outputs.groove_torque,
            ball_torque: outputs.ball_torque,
            load_torque: outputs.load_torque,
            largest_contact_force: outputs.largest_contact_force,
            contacts: u32::from(outputs.contacts),
            regime: regime(outputs.regime),
            faults: u32::from(outputs.faults.bits()),
        }
    }
}
