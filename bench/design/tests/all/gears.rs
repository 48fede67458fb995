//! The gears that the firmware holds are those that are folded.

use epas_design::gears;

/// So many files in `bench/firmware/src/gears`, from the first on, have the bits of their folds.
fn files_hold_what_is_folded(most: usize) {
    let files = [
        include_str!("../../../firmware/src/gears/gear_33x20.rs"),
        include_str!("../../../firmware/src/gears/gear_33x20_range.rs"),
        include_str!("../../../firmware/src/gears/gear_33x20_worn.rs"),
        include_str!("../../../firmware/src/gears/gear_29x7_range.rs"),
    ];
    for ((name, fold), file) in gears::firmware().unwrap().into_iter().zip(files).take(most) {
        let folded = fold.folded().unwrap().rust(name).unwrap();
        assert!(
            folded == file,
            "{name}: `cargo run --release -p epas-design --example gears -- bench/firmware/src/gears` writes another file"
        );
    }
}

/// The gear of one friction coefficient; all of them in `firmware_holds_what_is_folded_whole`.
#[test]
fn firmware_holds_what_is_folded() {
    files_hold_what_is_folded(1);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-design --test all -- --ignored _whole"]
fn firmware_holds_what_is_folded_whole() {
    files_hold_what_is_folded(usize::MAX);
}
