//! Measurement files: any bytes are read or refused, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let _ = epas_cli::untrusted::measurement(data);
});
