//! `epas-papers screws`: random whole screws in the loop against the exact ones.

use std::f64::consts::TAU;
use std::io::{self, Write as _};

use clap::Parser;
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::iter::Either;
use rayon::prelude::*;

use epas_bench::exact_ring::{Case, Comparison, Off, compare};
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
        (
            between(-3.0, 3.0) / 360.0 * TAU,
            between(1.0, 4.999).floor() as u8,
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

/// Errors of a quantity over many screws.
#[derive(Debug, Default, PartialEq)]
struct Over {
    screws: usize,
    largest: f64,
    /// Root of the mean square of the screws' own, and the mean of their means.
    rms: f64,
    mean: f64,
    median: f64,
    /// Largest of the screws' own rms, and its screw's number.
    worst: (f64, u32),
}

impl Over {
    /// Of the largest, rms and mean error of each screw; screws without the quantity have none.
    fn of(all: impl Iterator<Item = (u32, [f64; 3])>) -> Self {
        let mut over = Self::default();
        let mut own: Vec<f64> = Vec::new();
        for (number, [largest, rms, mean]) in all.filter(|(_, errors)| errors[1].is_finite()) {
            over.largest = over.largest.max(largest);
            over.mean += mean;
            if rms > over.worst.0 {
                over.worst = (rms, number);
            }
            own.push(rms);
        }
        over.screws = own.len();
        let count = own.len() as f64;
        over.rms = (own.iter().map(|rms| rms * rms).sum::<f64>() / count).sqrt();
        over.mean /= count;
        own.sort_by(f64::total_cmp);
        over.median = own.get(own.len() / 2).copied().unwrap_or(f64::NAN);
        over
    }
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
    let mut stdout = io::stdout().lock();
    // A screw whose ball is not folded has no firmware, and no error: it is told.
    writeln!(
        stdout,
        "{} of {screws} screws are folded and compared",
        found.len()
    )?;
    for refused in &refused {
        writeln!(stdout, "not folded: {refused}")?;
    }
    writeln!(
        stdout,
        "errors at the same state in per cent, flagged states in the count: torques of screw and grooves over their own exact value, the others \
         over the largest of each screw"
    )?;
    writeln!(
        stdout,
        "quantity             screws   largest       rms      mean    median of rms   worst rms, its screw"
    )?;
    for (name, of) in QUANTITIES {
        let over = Over::of(
            found
                .iter()
                .map(|(number, found)| (*number, of(found).relative())),
        );
        if over.screws == 0 {
            writeln!(stdout, "{name:20} {:6} none of these screws has it", 0)?;
            continue;
        }
        let [largest, rms, mean, median, worst] =
            [over.largest, over.rms, over.mean, over.median, over.worst.0].map(|part| 100.0 * part);
        writeln!(
            stdout,
            "{name:20} {:6} {largest:9.2} {rms:9.3} {mean:+9.3} {median:16.3} {worst:12.3}, epas-papers screws --screws 1 --first {}",
            over.screws, over.worst.1
        )?;
    }
    let sum =
        |of: fn(&Comparison) -> usize| found.iter().map(|(_, found)| of(found)).sum::<usize>();
    let compared = || found.iter().filter(|(_, found)| found.compared > 0);
    let within = |found: &Comparison| found.torque.relative()[1] <= 0.01;
    let unflagged = || compared().filter(|(_, found)| found.flagged == 0);
    writeln!(
        stdout,
        "friction torque within 1 % rms: {} of {} screws; {} of the {} of which no state is flagged",
        compared().filter(|(_, found)| within(found)).count(),
        compared().count(),
        unflagged().filter(|(_, found)| within(found)).count(),
        unflagged().count(),
    )?;
    writeln!(
        stdout,
        "states: {} compared, {} of them flagged; {} without an exact solution, not compared",
        sum(|found| found.compared),
        sum(|found| found.flagged),
        sum(|found| found.failed)
    )?;
    if let [(number, found)] = found.as_slice() {
        writeln!(
            stdout,
            "largest force {:.3} N; {:?}",
            found.largest_force,
            case(*number)
        )?;
    }
    Ok(())
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
        let over = Over::of(
            [
                (3, [0.5, 0.3, 0.1]),
                (4, [0.9, 0.4, -0.3]),
                (5, [f64::NAN; 3]),
            ]
            .into_iter(),
        );
        assert_eq!((over.screws, over.largest, over.worst), (2, 0.9, (0.4, 4)));
        assert!((over.rms - 0.125_f64.sqrt()).abs() < 1e-15 && (over.mean + 0.1).abs() < 1e-15);
    }
}
