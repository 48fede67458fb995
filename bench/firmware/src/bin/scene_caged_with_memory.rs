//! The scene alone: its flash, its memory, its stack.

#![no_std]
#![no_main]

use epas_firmware::scenes::CagedWithMemory;

epas_firmware::image!(CagedWithMemory);
