//! Every scene in one program.

#![no_std]
#![no_main]

use epas_firmware::scenes::{
    Caged, CagedWithMemory, Curvature, Efficiency, Linear, Uncaged, UncagedWithMemory,
};

epas_firmware::image!(
    Curvature,
    Efficiency,
    Caged,
    CagedWithMemory,
    Linear,
    Uncaged,
    UncagedWithMemory
);
