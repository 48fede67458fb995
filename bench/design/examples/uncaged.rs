//! Folds a design whose balls press on each other, and prints the errors of its law:
//! `cargo run --release -p epas-design --example uncaged -- NAME [FRICTION [CLEARANCE_um [SCREW_deg NUT_deg]]]`; a friction coefficient `0.05:0.15`
//! is a range.

use epas_design::uncaged::RowFigures;
use epas_design::{CagedDesign, Failure, UncagedDesign, UncagedFold};
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, DISSERTATION_DESIGNS, Limits, RollingResistance,
};

fn figures(name: &str, figures: &RowFigures) {
    println!(
        "{name}: {} rows, {:.1} % flagged",
        figures.rows,
        100.0 * figures.flagged
    );
    for (name, figure) in [
        ("torque", &figures.torque),
        ("torque, unflagged", &figures.unflagged_torque),
        ("forces", &figures.forces),
        ("forces, unflagged", &figures.unflagged_forces),
    ] {
        println!(
            "    {name:18} rms {:.3} %, largest {:.3} % at {:.1} N, {:.4}; mean {:.4} %",
            100.0 * figure.rms,
            100.0 * figure.largest,
            figure.worst_load,
            figure.worst_friction,
            100.0 * figure.mean
        );
    }
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = arguments.first().map_or("lin-2.1", String::as_str);
    let number = |place: usize, otherwise: f32| {
        arguments
            .get(place)
            .and_then(|text| text.parse().ok())
            .unwrap_or(otherwise)
    };
    let range = arguments.get(1).and_then(|text| {
        let (least, largest) = text.split_once(':')?;
        Some([least.parse().ok()?, largest.parse().ok()?])
    });
    let friction = range.map_or(number(1, 0.1), |[least, largest]: [f32; 2]| {
        (least * largest).sqrt()
    });
    let catalogue = CATALOGUE.iter().map(|size| (size.name, size.parameters()));
    let designs = DISSERTATION_DESIGNS.iter();
    let Some((_, parameters)) = catalogue
        .chain(designs.map(|design| (design.name, design.parameters)))
        .find(|(known, _)| *known == name)
    else {
        return Err(Failure::Domain(format!("no design is called {name}")));
    };
    let gear = CagedDesign {
        design: BallScrew::new(parameters)?,
        friction,
        rolling_resistance: RollingResistance::STEEL,
        clearance: Clearance::new(1e-6 * number(2, 0.0))?,
        loaded_balls: 37,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 50_000.0,
            friction_torque: 50.0,
        },
    };
    let fold = UncagedFold {
        friction: range,
        ..UncagedFold::of(UncagedDesign {
            gear,
            deviations: [number(3, 1.0).to_radians(), number(4, 0.5).to_radians()],
        })
    };
    let folded = fold.folded()?;
    let certificate = &folded.certificate;
    println!(
        "{name}, digest {:016x}: {:.1} s; rows of {} balls, {} unsolved, seed {}",
        folded.digest, folded.seconds, certificate.balls, certificate.unsolved, certificate.seed,
    );
    figures("no friction between balls", &certificate.smooth);
    figures("friction 0.1 between balls", &certificate.rubbing);
    figures("in waves, no friction between balls", &certificate.waves);
    figures(
        "in waves, friction 0.1 between balls",
        &certificate.rubbing_waves,
    );
    Ok(())
}
