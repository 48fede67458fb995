//! Folds the gears of the firmware: `cargo run --release -p epas-design --example gears -- bench/firmware/src/gears`.

use std::path::Path;

use epas_design::{Failure, gears};

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    for (name, fold) in gears::firmware()? {
        fold.folded()?.write_rust(name, &folder)?;
    }
    for (name, fold) in gears::firmware_uncaged()? {
        let folded = fold.folded()?;
        let file = Path::new(&folder)
            .join(name.to_lowercase())
            .with_extension("bin");
        std::fs::write(file, folded.bytes()?).map_err(Failure::File)?;
        println!("{name}\n{}", folded.summary().join("\n"));
    }
    Ok(())
}
