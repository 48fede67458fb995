//! A ball screw whose balls do not touch, by a folded block.

use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration};

use crate::scene::{CScene, TablePointers, Tables, regime, screw_inputs};
use crate::status::{EPAS_FIELD_BLOCK, EPAS_NULL_POINTER, Failure};
use crate::types::{
    Block, CagedPlace, CagedRangePlace, EPAS_CAGED_RANGE_STATE_BYTES, EPAS_CAGED_STATE_BYTES,
    EPAS_FAULT_CALL, EPAS_RANGE_NODES, EPAS_REGIME_STANDING, Inputs, Outputs,
};
use crate::version::mark;

/// `epas_caged_t`
pub(crate) struct Caged;

/// `epas_caged_range_t`
pub(crate) struct CagedRange;

/// What a refused call puts out.
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

/// What a screw puts out.
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

impl CScene for Caged {
    type Scene = CagedBallScrew;
    type Place = CagedPlace;
    type Configuration = Block;
    type Inputs = Inputs;
    type Outputs = Outputs;

    const MARK: u32 = mark(1);
    const STATE_BYTES: u32 = EPAS_CAGED_STATE_BYTES;
    const REFUSED: Outputs = REFUSED;

    fn tables(block: &Block) -> TablePointers {
        TablePointers::of_block(block)
    }

    fn configure(_: &Block, tables: Tables) -> Result<CagedBallScrewConfiguration, Failure> {
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

impl CScene for CagedRange {
    type Scene = CagedBallScrew<EPAS_RANGE_NODES>;
    type Place = CagedRangePlace;
    type Configuration = Block;
    type Inputs = Inputs;
    type Outputs = Outputs;

    const MARK: u32 = mark(6);
    const STATE_BYTES: u32 = EPAS_CAGED_RANGE_STATE_BYTES;
    const REFUSED: Outputs = REFUSED;

    fn tables(block: &Block) -> TablePointers {
        TablePointers::of_block(block)
    }

    fn configure(
        _: &Block,
        tables: Tables,
    ) -> Result<CagedBallScrewConfiguration<EPAS_RANGE_NODES>, Failure> {
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
