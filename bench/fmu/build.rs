//! Leaves out of the library what nobody calls, and the debug information: a unit's file carries it.

fn main() {
    println!("cargo::rerun-if-env-changed=EPAS_FMU_BALLS");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,--gc-sections,--strip-all");
    }
}
