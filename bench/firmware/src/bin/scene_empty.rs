//! The same program with a scene that computes nothing: what the others are measured against.

#![no_std]
#![no_main]

use epas_firmware::scenes::Empty;

epas_firmware::image!(Empty);
