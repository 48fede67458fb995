//! `eval`: any line is answered, good or bad, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|line: &str| {
    epas_cli::untrusted::request(line);
});
