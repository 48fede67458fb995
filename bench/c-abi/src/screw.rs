//! A ball screw whose balls press on each other, by a folded block.

use epas_friction::scene::FoldedBall;
use epas_friction::{Error, LoadShares, UncagedBallScrew, UncagedBallScrewConfiguration};

use crate::design::balls;
use crate::scene::{CScene, InHeader, Pointers, Tables, TrackPointers, regime, screw_inputs};
use crate::status::{EPAS_FIELD_FOLDED, EPAS_NULL_POINTER, Failure};
use crate::tables::{PlacedTable, Table};
use crate::types::{
    EPAS_FAULT_CALL, EPAS_MOST_BALLS, EPAS_REGIME_STANDING, EPAS_SCREW_RANGE_NODES,
    EPAS_SCREW_RANGE_STATE_BYTES, EPAS_SCREW_STATE_BYTES, Inputs, ScrewCircuit, ScrewConfiguration,
    ScrewOutputs, ScrewPlace, ScrewRangeConfiguration, ScrewRangePlace,
};
use crate::version::mark;

/// `epas_screw_t`, and `epas_screw_range_t`.
pub(crate) struct Screw<const NODES: usize>;

/// `epas_screw_range_t`
pub(crate) type ScrewRange = Screw<EPAS_SCREW_RANGE_NODES>;

impl InHeader for Screw<1> {
    type Place = ScrewPlace;
    type Configuration = ScrewConfiguration;

    const MARK: u32 = mark(2);
    const STATE_BYTES: u32 = EPAS_SCREW_STATE_BYTES;
}

impl InHeader for Screw<EPAS_SCREW_RANGE_NODES> {
    type Place = ScrewRangePlace;
    type Configuration = ScrewRangeConfiguration;

    const MARK: u32 = mark(8);
    const STATE_BYTES: u32 = EPAS_SCREW_RANGE_STATE_BYTES;
}

/// A configuration of a ball screw for `NODES` friction coefficients.
pub(crate) trait OfNodes<const NODES: usize> {
    fn folded(&self) -> *const PlacedTable<FoldedBall<NODES>>;
    fn circuit(&self) -> &ScrewCircuit;
}

impl OfNodes<1> for ScrewConfiguration {
    fn folded(&self) -> *const PlacedTable<FoldedBall<1>> {
        self.folded.cast()
    }

    fn circuit(&self) -> &ScrewCircuit {
        &self.circuit
    }
}

impl OfNodes<EPAS_SCREW_RANGE_NODES> for ScrewRangeConfiguration {
    fn folded(&self) -> *const PlacedTable<FoldedBall<EPAS_SCREW_RANGE_NODES>> {
        self.folded.cast()
    }

    fn circuit(&self) -> &ScrewCircuit {
        &self.circuit
    }
}

impl<const NODES: usize> CScene for Screw<NODES>
where
    Self: InHeader<Configuration: OfNodes<NODES>>,
    FoldedBall<NODES>: Table,
{
    type Scene = UncagedBallScrew<EPAS_MOST_BALLS, NODES>;
    type Folded = FoldedBall<NODES>;
    type Inputs = Inputs;
    type Outputs = ScrewOutputs;

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

    fn pointers(configuration: &Self::Configuration) -> Pointers<FoldedBall<NODES>> {
        let circuit = configuration.circuit();
        Pointers {
            track: TrackPointers {
                passing: circuit.screw_deviation,
                recirculating: circuit.nut_deviation,
                load_shares: circuit.load_shares,
                load_share_count: circuit.load_share_count,
            },
            folded: configuration.folded(),
            ..Pointers::NONE
        }
    }

    fn configure(
        configuration: &Self::Configuration,
        tables: Tables<FoldedBall<NODES>>,
    ) -> Result<UncagedBallScrewConfiguration<NODES>, Failure> {
        let circuit = configuration.circuit();
        let none = || Failure::pointer(EPAS_NULL_POINTER, EPAS_FIELD_FOLDED);
        Ok(UncagedBallScrewConfiguration {
            folded: tables.folded.ok_or_else(none)?,
            ball_friction: circuit.ball_friction,
            balls: balls(circuit.balls)?,
            turns: circuit.turns,
            return_length: circuit.return_length,
            screw_deviation: tables.track.passing,
            nut_deviation: tables.track.recirculating,
            load_shares: LoadShares::same(tables.track.load_shares),
            tick: circuit.tick,
        })
    }

    /// Numbers of the folded ball that no field of a structure in C is named after.
    fn failure(error: Error) -> Failure {
        match error.field() {
            "path_radius" | "speed" => Failure::at(error, EPAS_FIELD_FOLDED),
            _ => Failure::of(error),
        }
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
