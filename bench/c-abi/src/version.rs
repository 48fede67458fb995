//! The version of what the header shows, and the marks that tell it in memory.

/// Version of the structures and functions of this header; `epas_abi_version` returns the library's. It rises
/// whenever a structure, a function or what a place holds changes. From version 11 on `epas_adaptation_inputs_t` has the lubricant's drag
/// beside the friction torque.
pub const EPAS_ABI_VERSION: u32 = 13u32;

/// Mark of an initialised place: it tells what the place holds, and by which version of the library.
pub(crate) const fn mark(kind: u8) -> u32 {
    const {
        assert!(
            EPAS_ABI_VERSION <= 0xFF,
            "the version takes one byte of the mark"
        );
    }
    0xE9A5_0000 | EPAS_ABI_VERSION << 8 | kind as u32
}
