//! Puts the memory map on the linker's search path. The library leaves that to whoever links a program.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo:rerun-if-env-changed=EPAS_MEMORY");
    println!("cargo:rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_ARCH").as_deref() != Ok("arm") {
        return;
    }
    // The reference board's, or that of the board at hand.
    let memory = env::var_os("EPAS_MEMORY")
        .map_or_else(|| Path::new("../../memory.x").to_owned(), PathBuf::from);
    println!("cargo:rerun-if-changed={}", memory.display());
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::copy(&memory, folder.join("memory.x"))
        .unwrap_or_else(|error| panic!("cannot copy {}: {error}", memory.display()));
    println!("cargo:rustc-link-search={}", folder.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    if env::var_os("CARGO_FEATURE_LOG").is_some() {
        println!("cargo:rustc-link-arg-bins=-Tdefmt.x");
    }
}
