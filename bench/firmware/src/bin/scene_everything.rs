//! Every scene in one program.

#![no_std]
#![no_main]

use epas_firmware::scenes::{Caged, Curvature, Efficiency, Linear, Uncaged};

epas_firmware::image!(Curvature, Efficiency, Caged, Linear, Uncaged);
