//! The blocks that come with the crate.

use std::fs;
use std::path::Path;

use epas_design::{built_in, files};
use epas_friction::scene::{CagedConstants, built_in as block};

/// Two designs folded anew are the bytes of the file, to the last one; `design --gate` folds all.
#[test]
fn the_file_is_what_is_folded() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let stored = fs::read(built_in::path(&root)).unwrap();
    let size = 4 * built_in::Block::WORDS;
    assert_eq!(stored.len(), size * files::built_in().count());
    for wanted in ["25x20x3.5", "lin-4.1"] {
        let (place, (_, parameters, balls)) = files::built_in()
            .enumerate()
            .find(|(_, (name, ..))| *name == wanted)
            .unwrap();
        let fold = built_in::fold_of(parameters, balls).unwrap();
        let anew = built_in::bytes_of(&fold).unwrap();
        assert!(
            anew == stored[place * size..(place + 1) * size],
            "{wanted}: epas design --store"
        );
    }
}

/// Every built-in design has a block of its own, which the crate takes: its lead, its digest, its balls.
#[test]
fn every_design_has_its_block() {
    for (name, parameters, balls) in files::built_in() {
        let design = block(name).unwrap();
        let fold = built_in::fold_of(parameters, balls).unwrap();
        assert_eq!(design.lead, parameters.lead, "{name}");
        assert_eq!(design.loaded_balls, fold.gear.loaded_balls, "{name}");
        assert_eq!(design.law.friction_range(), (0.05, 0.15), "{name}");
        assert_eq!(design.law.nodes.map(|node| node.friction), built_in::NODES);
        CagedConstants::new(&design).unwrap();
        let alone = design.nearest(0.104);
        assert_eq!(alone.law.friction_range(), (0.1, 0.1));
        CagedConstants::new(&alone).unwrap();
    }
    assert!(block("25x5").is_none());
}

/// At every friction coefficient of the block the torque is nearly that of a fold for it alone: 0.24 % at most; between them 2 %.
#[test]
fn blocks_are_as_exact_as_the_page_says() {
    for name in ["25x5x3.175", "lin-4.1", "50x20x6.35"] {
        let (_, parameters, balls) = files::built_in()
            .find(|(found, ..)| *found == name)
            .unwrap();
        let fold = built_in::fold_of(parameters, balls).unwrap();
        let design = block(name).unwrap();
        let [alone] = fold.errors(&design.nearest(0.1)).unwrap().figures;
        println!("{name}: {:.2e}, rms {:.1e}", alone.largest, alone.rms);
        assert!(
            alone.largest < 2.4e-3 && alone.rms < 6e-4,
            "{name}: {alone:?}"
        );
        let [range] = fold.errors(&design).unwrap().figures;
        println!("range {:.2e}, rms {:.1e}", range.largest, range.rms);
        assert!(
            range.largest < 0.02 && range.rms < 2.5e-3,
            "{name}: {range:?}"
        );
    }
}
