//! Folds every catalogue size, steering size and published design over friction coefficients and clearances, and prints the errors of each
//! block: `cargo run --release -p epas-design --example sweep [range] [NAME ...]`.

use epas_design::Failure;
use epas_design::gears::{TESTED_CLEARANCES, TESTED_FRICTIONS, tested};
use epas_friction::geometry::{FINE_LEAD_SIZES, STEERING_SIZES};
use epas_friction::{CATALOGUE, DISSERTATION_DESIGNS};

fn main() -> Result<(), Failure> {
    let range = std::env::args().any(|argument| argument == "range");
    let names: Vec<String> = std::env::args()
        .skip(1)
        .filter(|name| name != "range")
        .collect();
    let sizes = CATALOGUE
        .iter()
        .chain(&FINE_LEAD_SIZES)
        .chain(&STEERING_SIZES);
    let sizes = sizes.map(|size| (size.name, size.parameters()));
    let designs = DISSERTATION_DESIGNS
        .iter()
        .map(|design| (design.name, design.parameters));
    let (mut blocks, mut largest, mut squares, mut seconds) = (0, 0.0_f64, 0.0, 0.0_f64);
    for (name, parameters) in sizes.chain(designs) {
        if !(names.is_empty() || names.iter().any(|wanted| wanted == name)) {
            continue;
        }
        for clearance in TESTED_CLEARANCES {
            for friction in if range {
                &TESTED_FRICTIONS[1..2]
            } else {
                &TESTED_FRICTIONS[..]
            } {
                let mut fold = tested(parameters, clearance, *friction)?;
                fold.friction = range.then_some([0.05, 0.15]);
                match fold.folded() {
                    Ok(folded) => {
                        let [torque] = &folded.certificate.figures;
                        blocks += 1;
                        largest = largest.max(torque.largest);
                        squares += torque.rms.powi(2);
                        seconds = seconds.max(folded.seconds);
                        if torque.largest > 6e-3
                            || torque.rms > 2e-3
                            || torque.unsolved > 0
                            || torque.flagged > 0.0
                        {
                            println!(
                                "{name}, {:.0} um, {friction}: largest {:.2e} at {:.2} N, {:.3}; rms {:.2e}, mean {:.1e}, two answers {:.1e}, unsolved {}, flagged {}, {:.2} s",
                                1e6 * clearance,
                                torque.largest,
                                torque.worst_load,
                                torque.worst_friction,
                                torque.rms,
                                torque.mean,
                                torque.two_answers,
                                torque.unsolved,
                                torque.flagged,
                                folded.seconds
                            );
                        }
                    }
                    Err(failure) => {
                        println!("{name}, {:.0} um, {friction}: {failure}", 1e6 * clearance);
                    }
                }
            }
        }
    }
    println!(
        "{blocks} blocks: largest {largest:.2e}, rms of rms {:.2e}, slowest {seconds:.2} s",
        (squares / f64::from(blocks)).sqrt()
    );
    Ok(())
}
