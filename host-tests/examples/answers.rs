//! Counts the states of the promised domain that the reference has no answer for, and the time that answers take.
//!
//! ```text
//! cargo run --release -p epas-reference --example answers -- [SEED] [SINGLE BALLS] [PAIRS]
//! ```

use epas_testkit::promised;
use epas_testkit::random::Random;

use std::time::{Duration, Instant};

fn main() {
    let mut numbers = std::env::args()
        .skip(1)
        .map(|text| text.parse::<u64>().unwrap_or(0));
    let seed = numbers.next().unwrap_or(1);
    for (balls, count) in [
        (1, numbers.next().unwrap_or(2000)),
        (2, numbers.next().unwrap_or(300)),
    ] {
        let mut random = Random(seed);
        let (mut missing, mut slowest, mut whole) = (0, Duration::ZERO, Duration::ZERO);
        let mut sorted = Vec::new();
        for _ in 0..count {
            let state = promised::row(&mut random, balls);
            let start = Instant::now();
            let found = state.row.solve();
            let time = start.elapsed();
            whole += time;
            sorted.push(time);
            if time > slowest {
                slowest = time;
                println!("slowest {time:?}: {}", state.line());
            }
            if let Err(error) = found {
                missing += 1;
                println!("{error}: {}", state.line());
            }
        }
        sorted.sort();
        let median = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
        println!(
            "{missing} of {count} rows of {balls} without an answer; {:.1} s, median {median:?}, largest {slowest:?}",
            whole.as_secs_f64()
        );
    }
}
