//! `simulate`: any trace and any design file is read or refused, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    // The first byte says which reader; the corpora share what they find.
    match data {
        [b'#', text @ ..] => {
            if let Ok(text) = std::str::from_utf8(text) {
                let _ = epas_cli::untrusted::design(text);
            }
        }
        trace => {
            let _ = epas_cli::untrusted::trace(trace);
        }
    }
});
