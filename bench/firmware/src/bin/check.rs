//! Runs every function on the stored cases and compares the results bit for bit with those that a host
//! found. On a board whose cycle counter runs it also prints what each function takes.

#![no_std]
#![no_main]

use epas_firmware::board::{Console, clock, entry, finish, start_clock};
use epas_firmware::check::stored_cases;

#[entry]
fn main() -> ! {
    start_clock();
    finish(stored_cases(&mut Console::open(), clock))
}
