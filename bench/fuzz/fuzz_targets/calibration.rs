//! `calibrate`: any trace is read and looked at or refused, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let _ = epas_cli::untrusted::calibration_trace(data);
});
