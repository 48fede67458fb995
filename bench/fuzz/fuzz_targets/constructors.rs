//! Constructors: any numbers are refused with the field's name, or give an object whose answers are finite.
#![no_main]

#[path = "../../../host-tests/tests/all/objects.rs"]
mod objects;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let (bits, _) = data.as_chunks::<4>();
    let numbers = bits.iter().map(|bits| f32::from_le_bytes(*bits)).collect();
    objects::check(&mut objects::Numbers(numbers)).unwrap();
});
