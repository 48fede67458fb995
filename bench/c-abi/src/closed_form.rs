//! A ball screw whose balls do not touch, by a closed form.

use epas_friction::{ClosedFormScrew, ClosedFormScrewConfiguration, FrictionBranch};

use crate::caged::{REFUSED, outputs};
use crate::design::{ball_screw, clearance, loaded_balls};
use crate::scene::{CScene, InHeader, Pointers, Tables, limits, screw_inputs};
use crate::status::{EPAS_FIELD_BRANCH, Failure};
use crate::tables::NoTable;
use crate::types::{
    ClosedFormConfiguration, ClosedFormPlace, EPAS_BRANCH_ROLLING, EPAS_BRANCH_SLIDING,
    EPAS_CLOSED_FORM_STATE_BYTES, Inputs, Outputs,
};
use crate::version::mark;

/// `epas_closed_form_t`
pub(crate) struct ClosedForm;

impl InHeader for ClosedForm {
    type Place = ClosedFormPlace;
    type Configuration = ClosedFormConfiguration;

    const MARK: u32 = mark(7);
    const STATE_BYTES: u32 = EPAS_CLOSED_FORM_STATE_BYTES;
}

impl CScene for ClosedForm {
    type Scene = ClosedFormScrew;
    type Folded = NoTable;
    type Inputs = Inputs;
    type Outputs = Outputs;

    const REFUSED: Outputs = REFUSED;

    fn pointers(_: &ClosedFormConfiguration) -> Pointers {
        Pointers::NONE
    }

    fn configure(
        configuration: &ClosedFormConfiguration,
        _: Tables,
    ) -> Result<ClosedFormScrewConfiguration, Failure> {
        Ok(ClosedFormScrewConfiguration {
            design: ball_screw(&configuration.design)?,
            friction: configuration.friction,
            rolling_tangent: configuration.rolling_tangent,
            branch: match configuration.branch {
                EPAS_BRANCH_ROLLING => FrictionBranch::Rolling,
                EPAS_BRANCH_SLIDING => FrictionBranch::Sliding,
                other => {
                    return Err(Failure::count(
                        EPAS_FIELD_BRANCH,
                        other,
                        EPAS_BRANCH_ROLLING,
                        EPAS_BRANCH_SLIDING,
                    ));
                }
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
    fn outputs(found: epas_friction::Outputs) -> Outputs {
        outputs(found)
    }
}
