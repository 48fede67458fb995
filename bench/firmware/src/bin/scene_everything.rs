//! Every scene in one program; those with memory have images of their own.

#![no_std]
#![no_main]

use epas_firmware::scenes::{Caged, Curvature, Efficiency, Linear, Uncaged};

epas_firmware::image!(Curvature, Efficiency, Caged, Linear, Uncaged);
