//! `epas-papers screws`: random whole screws in the loop against the exact ones.

use std::f64::consts::TAU;

use clap::Parser;
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::iter::Either;
use rayon::prelude::*;

use epas_bench::exact_ring::{Case, Comparison, Deviation, Off, compare};
use epas_bench::report::draw::{table, told};
use epas_bench::report::statistics::Errors;
use epas_bench::timing::Spread;
use epas_page::document::{Block, Cell, Section};
use epas_page::failure::Failure;
use epas_page::progress::Progress;
use epas_reference::design::BallScrewDesign;

/// Balls of every screw.
const BALLS: usize = 16;

/// Stream of the random numbers; the seed is a screw's number.
const STREAM: u128 = 12;

/// Nominal diameter, lead and ball diameter, mm; conformity of both grooves.
const DESIGNS: [(f64, f64, f64, f64); 10] = [
    (16.0, 5.0, 3.175, 0.53),
    (20.0, 10.0, 3.969, 0.55),
    (21.0, 7.0, 3.0, 0.54),
    (26.0, 10.0, 3.969, 0.54),
    (29.0, 7.0, 4.0, 0.54),
    (32.0, 10.0, 6.35, 0.52),
    (33.0, 20.0, 5.556, 0.5857),
    (40.0, 10.0, 6.35, 0.53),
    (50.0, 20.0, 9.525, 0.54),
    (63.0, 20.0, 9.525, 0.52),
];

/// Random whole screws in the loop against the exact ones, two turns of the nut each: what the errors are over designs,
/// loads of both signs from 5 to 300 N a ball, friction 0.05 to 0.15, clearance -5 to 5 micrometres, deviations of both
/// grooves to 3 degrees, 1 to 5 turns a second in both directions.
#[derive(Debug, Parser)]
pub struct Arguments {
    /// Screws.
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000), allow_negative_numbers = true)]
    screws: u32,
    /// Number of the first one: a screw is made from its number alone.
    #[arg(long, default_value_t = 0, allow_negative_numbers = true)]
    first: u32,
}

/// A screw of a number.
fn case(number: u32) -> Case {
    let mut random = Pcg64::new(number.into(), STREAM);
    let mut between = |least: f64, most: f64| random.random_range(least..=most);
    let (diameter, lead, ball, conformity) = DESIGNS[between(0.0, 9.999) as usize];
    let mut sign = || between(-1.0, 1.0).signum();
    let signs = [sign(), sign()];
    let mut wave = || {
        Deviation::wave(
            between(-3.0, 3.0) / 360.0 * TAU,
            between(1.0, 4.999).floor() as usize,
        )
    };
    let waves = [wave(), wave()];
    let groove_radius = 1e-3 * conformity * ball;
    Case {
        design: BallScrewDesign {
            pitch_radius: 0.5e-3 * diameter,
            lead: 1e-3 * lead,
            ball_radius: 0.5e-3 * ball,
            screw_groove_radius: groove_radius,
            nut_groove_radius: groove_radius,
            contact_angle: between(42.0, 48.0) / 360.0 * TAU,
            ..BallScrewDesign::LIN
        },
        screw: waves[0],
        nut: waves[1],
        friction: between(0.05, 0.15),
        ball_friction: between(0.05, 0.15),
        clearance: between(-5e-6, 5e-6),
        load_per_ball: signs[0] * 5.0 * 60.0_f64.powf(between(0.0, 1.0)),
        speed: signs[1] * 5.0_f64.powf(between(0.0, 1.0)),
        ..Case::LIN
    }
}

/// A quantity of a comparison.
type Quantity = (&'static str, fn(&Comparison) -> &Off);

const QUANTITIES: [Quantity; 5] = [
    ("force between balls", |found| &found.force),
    ("friction torque", |found| &found.torque),
    ("grooves' torque", |found| &found.groove),
    ("balls' torque", |found| &found.ball),
    ("pairs that press", |found| &found.pairs),
];

const COLUMNS: &str =
    "quantity | screws | largest | rms | mean | median of rms | worst rms | its screw";

/// Errors of a quantity over many screws, from the largest, rms and mean error of each by its number; screws without the quantity have none.
fn row(name: &str, of_screws: impl Iterator<Item = (u32, [f64; 3])>) -> Vec<Cell> {
    let own: Vec<_> = of_screws
        .filter(|(_, errors)| errors[1].is_finite())
        .collect();
    let Some((number, [_, worst, _])) = own
        .iter()
        .max_by(|(_, one), (_, other)| one[1].total_cmp(&other[1]))
    else {
        return told(COLUMNS, [name, "0"], "none of these screws has it");
    };
    let of = |which: usize| own.iter().map(move |(_, errors)| 100.0 * errors[which]);
    let rms: Errors = of(1).collect();
    let means: Errors = of(2).collect();
    vec![
        name.into(),
        Cell::fixed(own.len() as f64, 0),
        Cell::fixed(of(0).fold(0.0, f64::max), 2),
        Cell::fixed(rms.rms(), 3),
        Cell::fixed(means.mean(), 3),
        Cell::fixed(Spread::of(&of(1).collect::<Vec<_>>()).median, 3),
        Cell::fixed(100.0 * worst, 3),
        format!("--screws 1 --first {number}").into(),
    ]
}

/// Runs them.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { screws, first } = *arguments;
    let progress = Progress::new("whole screws", screws as usize);
    let (found, refused): (Vec<_>, Vec<_>) = (first..first.saturating_add(screws))
        .into_par_iter()
        .partition_map(|number| {
            let found = compare::<BALLS>(&case(number));
            progress.step();
            match found {
                Ok(found) => Either::Left((number, found)),
                Err(error) => Either::Right(format!("screw {number}: {error}")),
            }
        });
    drop(progress);
    // A screw whose ball is not folded has no firmware, and no error: it is told.
    let mut blocks = vec![Block::Text(format!(
        "{} of {screws} screws are folded and compared. {}",
        found.len(),
        refused.join(" ")
    ))];
    let rows = QUANTITIES.map(|(name, of)| {
        let own = found.iter();
        row(
            name,
            own.map(|(number, found)| (*number, of(found).relative())),
        )
    });
    blocks.push(Block::Table(table(
        "screws",
        "Errors at the same state in per cent, flagged states in the count: torques of screw and grooves over their own exact value, the others \
         over the largest of each screw",
        COLUMNS,
        rows.into(),
    )));
    let sum =
        |of: fn(&Comparison) -> usize| found.iter().map(|(_, found)| of(found)).sum::<usize>();
    let compared = || found.iter().filter(|(_, found)| found.compared > 0);
    let within = |found: &Comparison| found.torque.relative()[1] <= 0.01;
    let unflagged = || compared().filter(|(_, found)| found.flagged == 0);
    blocks.push(Block::Text(format!(
        "Friction torque within 1 % rms: {} of {} screws; {} of the {} of which no state is flagged. States: {} compared, {} of them flagged; {} \
         without an exact solution, not compared.",
        compared().filter(|(_, found)| within(found)).count(),
        compared().count(),
        unflagged().filter(|(_, found)| within(found)).count(),
        unflagged().count(),
        sum(|found| found.compared),
        sum(|found| found.flagged),
        sum(|found| found.failed)
    )));
    if let [(number, found)] = found.as_slice() {
        let (force, case) = (found.largest_force, case(*number));
        blocks.push(Block::Text(format!("Largest force {force:.3} N; {case:?}")));
    }
    let title = "Random whole screws";
    Section { title, blocks }.print()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_screw_is_made_from_its_number() {
        assert_eq!(format!("{:?}", case(7)), format!("{:?}", case(7)));
        for number in 0..1000 {
            let case = case(number);
            assert!((5.0..=300.0).contains(&case.load_per_ball.abs()));
            assert!((1.0..=5.0).contains(&case.speed.abs()));
            assert!(case.clearance.abs() <= 5e-6);
        }
        let backward = (0..1000).filter(|number| case(*number).speed < 0.0).count();
        assert!((400..600).contains(&backward));
    }

    #[test]
    fn errors_over_screws() {
        let own = [
            (3, [0.5, 0.3, 0.1]),
            (4, [0.9, 0.4, -0.3]),
            (5, [f64::NAN; 3]),
        ];
        let shown = |row: &[Cell]| -> Vec<String> {
            row.iter().map(|cell| cell.shown().to_owned()).collect()
        };
        let row = |own: &[(u32, [f64; 3])]| shown(&row("force", own.iter().copied()));
        let found = row(&own);
        assert_eq!(found[1..3], ["2", "90.00"]);
        assert_eq!(found[3..7], ["35.355", "-10.000", "35.000", "40.000"]);
        assert_eq!(found[7], "--screws 1 --first 4");
        assert_eq!(row(&own[2..])[1], "0");
    }
}
