//! The gears that the firmware holds are those that are folded.

use epas_design::gears;

/// Each file in `bench/firmware/src/gears` has the bits of its fold.
#[test]
fn firmware_holds_what_is_folded() {
    let files = [
        include_str!("../../firmware/src/gears/gear_33x20.rs"),
        include_str!("../../firmware/src/gears/gear_33x20_range.rs"),
        include_str!("../../firmware/src/gears/gear_33x20_worn.rs"),
        include_str!("../../firmware/src/gears/gear_29x7_range.rs"),
    ];
    for ((name, fold), file) in gears::firmware().unwrap().into_iter().zip(files) {
        let folded = fold.folded().unwrap().rust(name).unwrap();
        assert!(
            folded == file,
            "{name}: `cargo run --release -p epas-design --example gears -- bench/firmware/src/gears` writes another file"
        );
    }
}
