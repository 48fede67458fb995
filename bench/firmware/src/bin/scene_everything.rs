//! Every scene in one program; those with memory have images of their own.

#![no_std]
#![no_main]

use epas_firmware::scenes::{Curvature, Efficiency, Folded, Linear, Uncaged};

epas_firmware::image!(Curvature, Efficiency, Folded, Linear, Uncaged);
