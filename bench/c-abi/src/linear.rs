//! A linear bearing whose balls press on each other.

use epas_friction::{LinearBearingConfiguration, LinearBearingTrain, LinearLimits};

use crate::design::{balls, linear_bearing};
use crate::scene::{CScene, InHeader, Pointers, Tables, TrackPointers, regime};
use crate::status::Failure;
use crate::tables::NoTable;
use crate::types::{
    EPAS_FAULT_CALL, EPAS_LINEAR_STATE_BYTES, EPAS_MOST_BALLS, EPAS_REGIME_STANDING,
    LinearConfiguration, LinearInputs, LinearOutputs, LinearPlace,
};
use crate::version::mark;

/// `epas_linear_t`
pub(crate) struct Linear;

impl InHeader for Linear {
    type Place = LinearPlace;
    type Configuration = LinearConfiguration;

    const MARK: u32 = mark(3);
    const STATE_BYTES: u32 = EPAS_LINEAR_STATE_BYTES;
}

impl CScene for Linear {
    type Scene = LinearBearingTrain<EPAS_MOST_BALLS>;
    type Folded = NoTable;
    type Inputs = LinearInputs;
    type Outputs = LinearOutputs;

    const REFUSED: LinearOutputs = LinearOutputs {
        friction_force: 0.0,
        groove_force: 0.0,
        ball_force: 0.0,
        largest_contact_force: 0.0,
        contacts: 0,
        regime: EPAS_REGIME_STANDING,
        faults: EPAS_FAULT_CALL,
    };

    fn pointers(configuration: &LinearConfiguration) -> Pointers {
        Pointers {
            track: TrackPointers {
                passing: configuration.rail_deviation,
                recirculating: configuration.carriage_deviation,
                load_shares: configuration.load_shares,
                load_share_count: configuration.load_share_count,
            },
            ..Pointers::NONE
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
            balls: balls(configuration.balls)?,
            loaded_length: configuration.loaded_length,
            return_length: configuration.return_length,
            wavelength: configuration.wavelength,
            rail_deviation: tables.track.passing,
            carriage_deviation: tables.track.recirculating,
            load_shares: tables.track.load_shares,
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
    fn outputs(outputs: epas_friction::LinearOutputs) -> LinearOutputs {
        LinearOutputs {
            friction_force: outputs.friction_force,
            groove_force: outputs.groove_force,
            ball_force: outputs.ball_force,
            largest_contact_force: outputs.largest_contact_force,
            contacts: u32::from(outputs.contacts),
            regime: regime(outputs.regime),
            faults: u32::from(outputs.faults.bits()),
        }
    }
}
