//! `simulate --loads`: how the balls of a design share the load, for the scene without a cage.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;

use epas_friction::LoadShare;
use epas_reference::statics::StaticSolution;

use crate::designs::Design;
use crate::designs::loads::LoadCase;
use crate::failure::Failure;
use crate::files::{self, Existing};

/// How a load table is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// A table [uncaged] of a design file
    #[default]
    Toml,
    /// Constants to paste into firmware
    Rust,
}

/// Most entries of a load table.
const MOST_ENTRIES: usize = 256;
/// What a ball without contact is given: the smallest share that a scene takes.
const LEAST_SHARE: f64 = 0.01;

/// Computes the load table of a design and writes it to a file, or to stdout without one.
pub fn run(
    design: &Design,
    axial_load: Option<f64>,
    format: Format,
    output: Option<&Path>,
    existing: Existing,
) -> Result<(), Failure> {
    let failure = |message: String| Failure::Data(format!("{}: {message}", design.name));
    let mut loads = design.loads.clone().ok_or_else(|| {
        failure(
            "says nothing of its screw: a design file does in a table [loads], and of the built-in \
             designs lin-2.1, lin-3.6 and lin-4.1"
                .into(),
        )
    })?;
    if let Some(axial_load) = axial_load {
        loads.case.axial_load = axial_load;
    }
    if let Some(path) = output {
        existing.check(path)?;
    }
    let solution = loads
        .load()
        .map_err(|error| failure(error.to_string()))?
        .solve()
        .map_err(|error| failure(error.to_string()))?;
    let table = Table::new(&loads, &solution).map_err(failure)?;
    let text = match format {
        Format::Toml => table.toml(&design.name),
        Format::Rust => table.rust(&design.name),
    };
    match output {
        None => io::stdout().lock().write_all(text.as_bytes())?,
        Some(path) => {
            files::write(path, &text, existing)?;
            writeln!(io::stdout().lock(), "wrote {}", path.display())?;
        }
    }
    Ok(())
}

/// Shares over the mean, in equal parts of the loaded track.
struct Table {
    shares: Vec<f32>,
    axial_load: f64,
    balls: usize,
    /// Balls that carry nothing along the axis, or push against the load.
    idle: usize,
}

impl Table {
    fn new(loads: &LoadCase, solution: &StaticSolution) -> Result<Self, String> {
        let parts = solution
            .axial_shares()
            .ok_or("no ball carries anything along the axis")?;
        let balls = parts.len();
        let shares: Vec<f64> = parts.iter().map(|part| part * balls as f64).collect();
        let shares: Vec<f64> = spread(&shares, balls.min(MOST_ENTRIES))
            .into_iter()
            .map(|share| share.max(LEAST_SHARE))
            .collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        let shares: Vec<f32> = shares
            .into_iter()
            .map(|share| (share / mean).max(LEAST_SHARE) as f32)
            .collect();
        for share in &shares {
            LoadShare::new(*share).map_err(|error| error.to_string())?;
        }
        Ok(Self {
            shares,
            axial_load: loads.case.axial_load,
            balls,
            idle: parts
                .iter()
                .filter(|part| *part * balls as f64 <= LEAST_SHARE)
                .count(),
        })
    }

    /// What stands above the table, without the marks of a comment.
    fn heading(&self, name: &str) -> Vec<String> {
        let (least, most) = self
            .shares
            .iter()
            .fold((f32::INFINITY, 0.0_f32), |(least, most), share| {
                (least.min(*share), most.max(*share))
            });
        let mut lines = vec![
            format!(
                "Load of each ball of {name} over the mean, under {} N along the axis,",
                self.axial_load
            ),
            "along the loaded track from the end where the load acts: the static model of".into(),
            format!(
                "Lin 2019, chapter 2. {} balls; the largest share is {:.3} of the smallest.",
                self.balls,
                most / least
            ),
        ];
        if self.idle > 0 {
            lines.push(format!(
                "{} balls carry nothing or push against the load; they stand with {LEAST_SHARE}, and the \
                 mean is kept.",
                self.idle
            ));
        }
        lines
    }

    fn toml(&self, name: &str) -> String {
        let mut text = String::new();
        for line in self.heading(name) {
            let _ = writeln!(text, "# {line}");
        }
        text.push_str("[uncaged]\nload_shares = [\n");
        for share in &self.shares {
            let _ = writeln!(text, "    {share:?},");
        }
        text.push_str("]\n");
        text
    }

    fn rust(&self, name: &str) -> String {
        let mut text = String::new();
        for line in self.heading(name) {
            let _ = writeln!(text, "/// {line}");
        }
        let _ = write!(
            text,
            "pub static LOAD_SHARES: [epas_friction::LoadShare; {}] = {{\n\
             \x20   const fn share(share: f32) -> epas_friction::LoadShare {{\n\
             \x20       match epas_friction::LoadShare::new(share) {{\n\
             \x20           Ok(share) => share,\n\
             \x20           Err(_) => panic!(\"a share is 0.01 to 100\"),\n\
             \x20       }}\n\
             \x20   }}\n\
             \x20   [\n",
            self.shares.len()
        );
        for share in &self.shares {
            let _ = writeln!(text, "        share({share:?}),");
        }
        text.push_str("    ]\n};\n");
        text
    }
}

/// The mean of a step function over equal steps in each of `count` equal parts.
fn spread(steps: &[f64], count: usize) -> Vec<f64> {
    let per_part = steps.len() as f64 / count as f64;
    (0..count)
        .map(|part| {
            let (start, end) = (part as f64 * per_part, (part + 1) as f64 * per_part);
            let sum: f64 = steps
                .iter()
                .enumerate()
                .skip(start as usize)
                .take(per_part.ceil() as usize + 1)
                .map(|(step, value)| {
                    let step = step as f64;
                    value * (end.min(step + 1.0) - start.max(step)).max(0.0)
                })
                .sum();
            sum / per_part
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn spreading_keeps_the_sum() {
        let steps: Vec<f64> = (0..1000).map(|step| f64::from(step).sin() + 2.0).collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        for count in [1, 3, 256, 999, 1000] {
            let parts = spread(&steps, count);
            assert_eq!(parts.len(), count);
            assert!((mean(&parts) - mean(&steps)).abs() < 1e-12, "{count}");
        }
        assert_eq!(spread(&steps, 1000), steps);
    }
}
