//! What a block was folded from, as one number.

use std::fmt::Debug;

use sha2::{Digest, Sha256};

/// The first eight bytes of the SHA-256 of the version of a fold's algorithm and of all its inputs.
pub(crate) fn digest(algorithm: u32, inputs: &impl Debug) -> u64 {
    let text = format!("algorithm {algorithm}, {inputs:?}");
    let bytes = Sha256::digest(text.as_bytes());
    bytes
        .iter()
        .take(8)
        .fold(0, |digest, &byte| digest << 8 | u64::from(byte))
}

#[cfg(test)]
mod tests {
    use super::digest;

    /// Another version or another input is another number; the first byte of the hash is the highest one.
    #[test]
    fn a_digest_covers_the_algorithm_and_the_inputs() {
        let own = digest(1, &(0.1_f32, 300.0_f32));
        assert_eq!(own, digest(1, &(0.1_f32, 300.0_f32)));
        assert_ne!(own, digest(2, &(0.1_f32, 300.0_f32)));
        assert_ne!(own, digest(1, &(0.1_f32.next_up(), 300.0_f32)));
    }
}
