//! Leaves out of the library what nobody calls, the debug information, and every symbol but FMI's: those of the crates it is linked from are
//! archives'.

fn main() {
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,--gc-sections,--strip-all,--exclude-libs,ALL");
    }
}
