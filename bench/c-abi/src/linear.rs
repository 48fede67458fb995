//! A linear bearing whose balls press on each other.

use epas_friction::{LinearBearingConfiguration, LinearBearingTrain, LinearLimits};

use crate::design::linear_bearing;
use crate::scene::{CScene, TablePointers, Tables};
use crate::screw::{REFUSED, train_outputs};
use crate::status::Failure;
use crate::types::{
    EPAS_LINEAR_BALLS, LinearConfiguration, LinearInputs, LinearPlace, TrainOutputs,
};

/// `epas_linear_t`
pub(crate) struct Linear;

impl CScene for Linear {
    type Scene = LinearBearingTrain<EPAS_LINEAR_BALLS>;
    type Place = LinearPlace;
    type Configuration = LinearConfiguration;
    type Inputs = LinearInputs;
    type Outputs = TrainOutputs;

    const MARK: u32 = 0xE9A5_0103;
    const REFUSED: TrainOutputs = REFUSED;

    fn tables(configuration: &LinearConfiguration) -> TablePointers {
        TablePointers {
            passing: configuration.rail_deviation,
            own: configuration.carriage_deviation,
            load_shares: configuration.load_shares,
            load_share_count: configuration.load_share_count,
        }
    }

    fn configure(
        configuration: &LinearConfiguration,
        tables: Tables,
    ) -> Result<LinearBearingConfiguration, Failure> {
        Ok(LinearBearingConfiguration {
            bearing: linear_bearing(&configuration.bearing)?,
            friction: configuration.friction,
            ball_friction: configuration.ball_friction,
            loaded_length: configuration.loaded_length,
            return_length: configuration.return_length,
            wavelength: configuration.wavelength,
            rail_deviation: tables.passing,
            carriage_deviation: tables.own,
            load_shares: tables.load_shares,
            reversal_speed: configuration.reversal_speed,
            tick: configuration.tick,
            limits: LinearLimits {
                speed: configuration.limits.speed,
                load: configuration.limits.load,
                friction_force: configuration.limits.friction_force,
            },
        })
    }

    #[inline]
    fn inputs(inputs: LinearInputs) -> epas_friction::LinearInputs {
        epas_friction::LinearInputs {
            speed: inputs.speed,
            normal_load: inputs.normal_load,
            side_load: inputs.side_load,
        }
    }

    #[inline]
    fn outputs(outputs: epas_friction::TrainOutputs) -> TrainOutputs {
        train_outputs(outputs)
    }
}
