//! What a scene of the crate needs to be one in C.

use epas_friction::scene::{Scene, StoredScene};
use epas_friction::{
    DeviationMap, Error, FrictionModel, Limits as CrateLimits, LoadShare as CrateLoadShare, Regime,
};

use crate::status::Failure;
use crate::tables::{Deviation, LoadShare, NoTable, PlacedTable, Table};
use crate::types::{
    Block, EPAS_REGIME_BACK_DRIVING, EPAS_REGIME_DRIVING, EPAS_REGIME_LOCKED, EPAS_REGIME_STANDING,
    Inputs, Limits,
};

/// A model in its place, with the mark that says that there is one.
#[repr(C)]
pub(crate) struct Placed<S: Scene> {
    pub(crate) mark: u32,
    pub(crate) model: FrictionModel<S>,
}

/// Tables along a track, as a configuration points to them.
pub(crate) struct TrackPointers {
    /// Deviation of the groove that passes by (screw, rail).
    pub(crate) passing: *const Deviation,
    /// Deviation of the groove of the body in which balls recirculate (nut, carriage).
    pub(crate) recirculating: *const Deviation,
    pub(crate) load_shares: *const LoadShare,
    pub(crate) load_share_count: u32,
}

impl TrackPointers {
    const NONE: Self = Self {
        passing: core::ptr::null(),
        recirculating: core::ptr::null(),
        load_shares: core::ptr::null(),
        load_share_count: 0,
    };

    #[inline(always)]
    pub(crate) const fn are_null(&self) -> bool {
        self.passing.is_null() && self.recirculating.is_null() && self.load_shares.is_null()
    }
}

/// What a configuration points to: `F` is what a host has folded, decoded, in a scene that keeps a pointer to it.
pub(crate) struct Pointers<F = NoTable> {
    pub(crate) track: TrackPointers,
    /// Words of a block, in a scene that decodes it.
    pub(crate) block: Block,
    pub(crate) folded: *const PlacedTable<F>,
}

impl<F> Pointers<F> {
    pub(crate) const NONE: Self = Self {
        track: TrackPointers::NONE,
        block: Block {
            words: core::ptr::null(),
            count: 0,
        },
        folded: core::ptr::null(),
    };
}

/// Tables along a track that have been found initialised.
pub(crate) struct TrackTables {
    pub(crate) passing: &'static DeviationMap,
    pub(crate) recirculating: &'static DeviationMap,
    pub(crate) load_shares: &'static [CrateLoadShare],
}

impl TrackTables {
    /// What stands in for no table.
    pub(crate) const NONE: Self = Self {
        passing: &DeviationMap::NONE,
        recirculating: &DeviationMap::NONE,
        load_shares: &[CrateLoadShare::MEAN],
    };
}

/// What has been found where a configuration points to.
pub(crate) struct Tables<F: 'static = NoTable> {
    pub(crate) track: TrackTables,
    /// Words of a block, where a pointer to them is given.
    pub(crate) block: Option<&'static [u32]>,
    /// What a host has folded, decoded, where a pointer to it is given.
    pub(crate) folded: Option<&'static F>,
}

/// What the header has of a scene.
pub(crate) trait InHeader {
    /// Where the caller keeps it.
    type Place;
    /// What the engineer sets.
    type Configuration;

    /// Says that a place holds this scene, as this version of the library has it.
    const MARK: u32;
    /// Bytes of a state, as the header has them.
    const STATE_BYTES: u32;
}

/// A scene with the structures that stand for it in C.
pub(crate) trait CScene: InHeader {
    /// The crate's scene.
    type Scene: StoredScene;
    /// What a host has folded and the model points to; [`NoTable`] for nothing.
    type Folded: Table;
    /// What the control interrupt knows.
    type Inputs: Copy;
    /// What a tick returns.
    type Outputs: Copy;

    /// Outputs of a refused call: no friction, flagged.
    const REFUSED: Self::Outputs;

    /// The place is large enough; that it is no larger than it has to be is checked from outside.
    const FITS: () = assert!(
        size_of::<Placed<Self::Scene>>() <= size_of::<Self::Place>()
            && align_of::<Placed<Self::Scene>>() <= align_of::<Self::Place>(),
        "the place is too small: its number of words in types.rs"
    );

    /// The header's bytes of a state are the crate's.
    const STATE_FITS: () = assert!(
        FrictionModel::<Self::Scene>::STATE_BYTES == Self::STATE_BYTES as usize,
        "EPAS_..._STATE_BYTES in types.rs"
    );

    fn pointers(configuration: &Self::Configuration) -> Pointers<Self::Folded>;
    fn configure(
        configuration: &Self::Configuration,
        tables: Tables<Self::Folded>,
    ) -> Result<<Self::Scene as Scene>::Configuration, Failure>;
    /// What the crate refuses, at the field of the structure in C.
    fn failure(error: Error) -> Failure {
        Failure::of(error)
    }
    fn inputs(inputs: Self::Inputs) -> <Self::Scene as Scene>::Inputs;
    fn outputs(outputs: <Self::Scene as Scene>::Outputs) -> Self::Outputs;
}

/// The checked and folded model.
pub(crate) fn model<C: CScene>(
    configuration: &C::Configuration,
    tables: Tables<C::Folded>,
) -> Result<FrictionModel<C::Scene>, Failure> {
    let configuration = C::configure(configuration, tables)?;
    FrictionModel::new(&configuration).map_err(C::failure)
}

/// The checked and folded constants.
pub(crate) fn constants<C: CScene>(
    configuration: &C::Configuration,
    tables: Tables<C::Folded>,
) -> Result<<C::Scene as Scene>::Constants, Failure> {
    let configuration = C::configure(configuration, tables)?;
    C::Scene::constants(&configuration).map_err(C::failure)
}

/// Regime by its number.
pub(crate) const fn regime(regime: Regime) -> u32 {
    match regime {
        Regime::Standing => EPAS_REGIME_STANDING,
        Regime::Driving => EPAS_REGIME_DRIVING,
        Regime::BackDriving => EPAS_REGIME_BACK_DRIVING,
        Regime::Locked => EPAS_REGIME_LOCKED,
    }
}

/// Limits of a ball screw.
pub(crate) const fn limits(limits: &Limits) -> CrateLimits {
    CrateLimits {
        nut_speed: limits.nut_speed,
        axial_load: limits.axial_load,
        friction_torque: limits.friction_torque,
    }
}

/// Inputs of a ball screw.
#[inline]
pub(crate) const fn screw_inputs(inputs: Inputs) -> epas_friction::Inputs {
    epas_friction::Inputs {
        nut_speed: inputs.nut_speed,
        axial_load: inputs.axial_load,
    }
}
