//! Nothing to build: without this file Cargo leaves the build dependencies out.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
}
