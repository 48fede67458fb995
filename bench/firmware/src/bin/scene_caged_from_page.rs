//! The README's example alone: its flash, its memory, its stack.

#![no_std]
#![no_main]

use epas_firmware::scenes::FromPage;

epas_firmware::image!(FromPage);
