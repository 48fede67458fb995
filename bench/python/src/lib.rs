//! `epas-friction` from Python: the crate's own functions and scenes over numpy arrays.

mod argument;
mod arrays;
mod blocks;
mod calibration;
mod contacts;
mod curvature;
mod design;
mod efficiency;
mod errors;
mod interrupt;
mod kept;
mod kinematics;
mod memory;
mod numbers;
mod press;
mod reference;
mod restored;
mod results;
mod runs;
mod scenes;
mod studies;

use pyo3::prelude::*;

/// What is compiled of the package `epas_friction`.
#[pymodule]
mod _native {
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "its name in Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use crate::calibration::calibrate;
    #[pymodule_export]
    use crate::contacts::{ellipse, friction_map};
    #[pymodule_export]
    use crate::curvature::{
        circular_groove_curvature, fitted_curvature, groove_curvature, literature_curvature,
    };
    #[pymodule_export]
    use crate::design::{
        Design, LinearDesign, design_names, restored_design, restored_linear_design,
    };
    #[pymodule_export]
    use crate::efficiency::efficiency;
    #[pymodule_export]
    use crate::kinematics::{contact_kinematics, reference_contact_kinematics};
    #[pymodule_export]
    use crate::press::contact_forces;
    #[pymodule_export]
    use crate::reference::{
        reference_efficiency, reference_ellipse, reference_friction_map, reference_groove_curvature,
    };
    #[pymodule_export]
    use crate::runs::{
        eval_json, manoeuvre, reference_measured_trace, reference_simulate_caged,
        reference_simulate_uncaged, simulate_caged, simulate_linear, simulate_uncaged,
    };
    #[pymodule_export]
    use crate::scenes::caged::{CagedBallScrew, fold_design, restored_caged};
    #[pymodule_export]
    use crate::scenes::remembering::{CagedBallScrewWithMemory, restored_remembering};
    #[pymodule_export]
    use crate::scenes::trains::{
        LinearBearingTrain, UncagedBallScrew, restored_bearing, restored_uncaged,
    };
    #[pymodule_export]
    use crate::studies::{design_figures, merge_sums, population, trace_sums};
}
