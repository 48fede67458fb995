//! A ball screw whose balls do not touch, by a folded block.

use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration};

use crate::scene::{CScene, InHeader, Pointers, Tables, regime, screw_inputs};
use crate::status::{EPAS_FIELD_BLOCK, EPAS_NULL_POINTER, Failure};
use crate::tables::NoTable;
use crate::types::{
    Block, CagedPlace, CagedRangePlace, EPAS_CAGED_RANGE_STATE_BYTES, EPAS_CAGED_STATE_BYTES,
    EPAS_FAULT_CALL, EPAS_RANGE_NODES, EPAS_REGIME_STANDING, Inputs, Outputs,
};
use crate::version::mark;

/// `epas_caged_t`, and `epas_caged_range_t`.
pub(crate) struct Caged<const NODES: usize>;

/// `epas_caged_range_t`
pub(crate) type CagedRange = Caged<EPAS_RANGE_NODES>;

/// Outputs of a refused call.
pub(crate) const REFUSED: Outputs = Outputs {
    friction_torque: 0.0,
    load_torque: 0.0,
    efficiency: 0.0,
    regime: EPAS_REGIME_STANDING,
    faults: EPAS_FAULT_CALL,
};

/// The configuration in a block.
pub(crate) fn block<const N: usize>(
    tables: &Tables,
) -> Result<CagedBallScrewConfiguration<N>, Failure> {
    let none = || Failure::pointer(EPAS_NULL_POINTER, EPAS_FIELD_BLOCK);
    CagedBallScrewConfiguration::read(tables.block.ok_or_else(none)?).map_err(Failure::of_block)
}

/// Outputs of a screw.
#[inline]
pub(crate) fn outputs(outputs: epas_friction::Outputs) -> Outputs {
    Outputs {
        friction_torque: outputs.friction_torque,
        load_torque: outputs.load_torque,
        efficiency: outputs.efficiency,
        regime: regime(outputs.regime),
        faults: u32::from(outputs.faults.bits()),
    }
}

impl InHeader for Caged<1> {
    type Place = CagedPlace;
    type Configuration = Block;

    const MARK: u32 = mark(1);
    const STATE_BYTES: u32 = EPAS_CAGED_STATE_BYTES;
}

impl InHeader for Caged<EPAS_RANGE_NODES> {
    type Place = CagedRangePlace;
    type Configuration = Block;

    const MARK: u32 = mark(6);
    const STATE_BYTES: u32 = EPAS_CAGED_RANGE_STATE_BYTES;
}

impl<const NODES: usize> CScene for Caged<NODES>
where
    Self: InHeader<Configuration = Block>,
{
    type Scene = CagedBallScrew<NODES>;
    type Folded = NoTable;
    type Inputs = Inputs;
    type Outputs = Outputs;

    const REFUSED: Outputs = REFUSED;

    fn pointers(block: &Block) -> Pointers {
        Pointers {
            block: *block,
            ..Pointers::NONE
        }
    }

    fn configure(_: &Block, tables: Tables) -> Result<CagedBallScrewConfiguration<NODES>, Failure> {
        block(&tables)
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
