//! A ball screw whose balls do not touch.

use epas_friction::{CagedBallScrew, CagedBallScrewConfiguration, FrictionBranch};

use crate::design::{ball_screw, clearance, loaded_balls, rolling_resistance};
use crate::scene::{CScene, TablePointers, Tables, limits, regime, screw_inputs};
use crate::status::{EPAS_FIELD_BRANCH, Failure};
use crate::types::{
    CagedConfiguration, CagedPlace, EPAS_BRANCH_CONTACTS, EPAS_BRANCH_ROLLING, EPAS_BRANCH_SLIDING,
    EPAS_CAGED_STATE_BYTES, EPAS_FAULT_CALL, EPAS_REGIME_STANDING, Inputs, Outputs,
};
use crate::version::mark;

/// `epas_caged_t`
pub(crate) struct Caged;

impl CScene for Caged {
    type Scene = CagedBallScrew;
    type Place = CagedPlace;
    type Configuration = CagedConfiguration;
    type Inputs = Inputs;
    type Outputs = Outputs;

    const MARK: u32 = mark(1);
    const STATE_BYTES: u32 = EPAS_CAGED_STATE_BYTES;
    const REFUSED: Outputs = Outputs {
        friction_torque: 0.0,
        load_torque: 0.0,
        efficiency: 0.0,
        regime: EPAS_REGIME_STANDING,
        faults: EPAS_FAULT_CALL,
    };

    fn tables(_: &CagedConfiguration) -> TablePointers {
        TablePointers::NONE
    }

    fn configure(
        configuration: &CagedConfiguration,
        _: Tables,
    ) -> Result<CagedBallScrewConfiguration, Failure> {
        Ok(CagedBallScrewConfiguration {
            design: ball_screw(&configuration.design)?,
            friction: configuration.friction,
            rolling_resistance: rolling_resistance(
                configuration.hysteresis_loss,
                configuration.lubricant_drag,
            ),
            rolling_tangent: configuration.rolling_tangent,
            branch: match configuration.branch {
                EPAS_BRANCH_CONTACTS => FrictionBranch::Contacts,
                EPAS_BRANCH_ROLLING => FrictionBranch::Rolling,
                EPAS_BRANCH_SLIDING => FrictionBranch::Sliding,
                other => return Err(Failure::count(EPAS_FIELD_BRANCH, other, 0, 2)),
            },
            clearance: clearance(configuration.clearance)?,
            loaded_balls: loaded_balls(configuration.loaded_balls)?,
            reversal_speed: configuration.reversal_speed,
            limits: limits(&configuration.limits),
        })
    }

    #[inline]
    fn inputs(inputs: Inputs) -> epas_friction::Inputs {
        screw_inputs(inputs)
    }

    #[inline]
    fn outputs(outputs: epas_friction::Outputs) -> Outputs {
        Outputs {
            friction_torque: outputs.friction_torque,
            load_torque: outputs.load_torque,
            efficiency: outputs.efficiency,
            regime: regime(outputs.regime),
            faults: u32::from(outputs.faults.bits()),
        }
    }
}
