//! Errors of the blocks that come with the crate, against the exact ball: over their range of friction coefficients, and of the nodes nearest to
//! the least, the default and the largest one alone: `cargo run --release -p epas-design --example built_in [NAME ...]`.

use epas_design::{Failure, Figure, built_in, files};
use epas_friction::defaults;
use epas_friction::scene::built_in as block;

/// Largest error and mean square so far.
#[derive(Default)]
struct Worst {
    blocks: u32,
    largest: f64,
    squares: f64,
}

impl Worst {
    fn add(&mut self, figure: &Figure) {
        self.blocks += 1;
        self.largest = self.largest.max(figure.largest);
        self.squares += figure.rms.powi(2);
    }

    fn print(&self, name: &str) {
        let rms = (self.squares / f64::from(self.blocks)).sqrt();
        println!(
            "{name}: {} blocks, largest {:.2} %, rms {:.3} %",
            self.blocks,
            100.0 * self.largest,
            100.0 * rms
        );
    }
}

fn main() -> Result<(), Failure> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let (mut between, mut alone) = (Worst::default(), Worst::default());
    for (name, parameters, balls) in files::built_in() {
        if !(names.is_empty() || names.iter().any(|wanted| wanted == name)) {
            continue;
        }
        let fold = built_in::fold_of(parameters, balls)?;
        let missing = || Failure::Domain(format!("{name}: no block; run epas design --store"));
        let design = block(name).ok_or_else(missing)?;
        let [torque] = fold.errors(&design)?.figures;
        between.add(&torque);
        print!(
            "{name}: {:.2} % largest, {:.3} % rms; alone",
            100.0 * torque.largest,
            100.0 * torque.rms
        );
        for friction in [0.05, defaults::FRICTION, 0.15] {
            let [torque] = fold.errors(&design.nearest(friction))?.figures;
            alone.add(&torque);
            print!(
                " {:.3} % ({:.4})",
                100.0 * torque.largest,
                100.0 * torque.rms
            );
        }
        println!();
    }
    between.print("range");
    alone.print("one coefficient");
    Ok(())
}
