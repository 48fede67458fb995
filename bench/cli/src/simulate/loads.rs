//! `simulate --loads`: how the balls of a design share the load, for the scene without a cage.

mod said;
mod table;

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use epas_reference::statics::ShareTable;
use epas_reference::statics::shares::loads_between;

use super::manoeuvre::{Manoeuvre, trace};
use super::samples::ScrewSample;
use super::trace;
use epas_design::files::Design;
use epas_design::files::loads::LoadCase;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing};
use epas_traces::mdf4::Mapping;
use epas_traces::source::Source as Input;
use said::{Answer, BALL_LOADS, answer, range_of, text};
pub use table::Format;

/// What is asked of a load table.
#[derive(Debug, clap::Args)]
pub struct LoadArguments {
    /// Compute how the loaded balls share the axial load, as a table of load_shares, and for which loads that table
    /// serves: of the design's axial load, or of all loads of a trace or a manoeuvre
    #[arg(
        long,
        requires = "design",
        conflicts_with_all = ["plot", "reference", "scene", "list", "memory", "mechanism"]
    )]
    loads: bool,
    /// What the load table is written as
    #[arg(
        long,
        value_enum,
        default_value_t,
        requires = "loads",
        conflicts_with_all = ["plot", "reference", "scene", "memory", "mechanism"]
    )]
    format: Format,
    /// Axial load in place of the design's, N; several with commas stand for all loads between them, of each sign
    // What requires an argument is not heard where that argument conflicts with another: so each conflict is
    // said again.
    #[arg(
        long,
        value_name = "N,...",
        requires = "loads",
        conflicts_with_all = ["input", "manoeuvre"],
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    axial_load: Vec<f64>,
}

impl LoadArguments {
    pub const fn wanted(&self) -> bool {
        self.loads
    }
}

/// Loads of one sign count where the largest of them is this part of the largest of both.
const COUNTED: f64 = 0.01;

#[derive(Clone, Copy)]
pub struct Source<'a> {
    pub input: Option<&'a PathBuf>,
    pub channels: Option<&'a Path>,
    pub manoeuvre: Option<Manoeuvre>,
}

/// Computes the load table of a design and writes it to a file, or to stdout without one.
pub fn run(
    design: &Design,
    arguments: &LoadArguments,
    source: Source<'_>,
    output: Option<&Path>,
    existing: Existing,
) -> Result<(), Failure> {
    let failure = |message: String| Failure::Data(format!("{}: {message}", design.name));
    let case = design.loads.clone().ok_or_else(|| {
        failure(
            "says nothing of its screw: a design file does in a table [loads], and of the built-in \
             designs lin-2.1, lin-3.6 and lin-4.1"
                .into(),
        )
    })?;
    let wanted = Wanted::new(design, arguments, source, &case)?;
    if let Some(path) = output {
        existing.check(path)?;
    }
    let Answer { said, tables } = wanted.answer(&case).map_err(failure)?;
    let text = table::text(arguments.format, &design.name, &said, &tables).map_err(failure)?;
    match output {
        None => io::stdout().lock().write_all(text.as_bytes())?,
        Some(path) => {
            files::write(path, &text, existing)?;
            let mut stdout = io::stdout().lock();
            for line in said {
                writeln!(stdout, "{line}")?;
            }
            writeln!(stdout, "wrote {}", path.display())?;
        }
    }
    Ok(())
}

enum Wanted {
    /// A table of this load, N.
    One(f64),
    /// Tables that serve all loads of each sign between a smallest and a largest size, N.
    All {
        name: String,
        positive: Option<[f64; 2]>,
        negative: Option<[f64; 2]>,
    },
}

impl Wanted {
    fn new(
        design: &Design,
        arguments: &LoadArguments,
        source: Source<'_>,
        case: &LoadCase,
    ) -> Result<Self, Failure> {
        let trace = match source {
            Source {
                input: Some(path), ..
            } => {
                let mapping = source.channels.map(Mapping::read).transpose()?;
                let input = Input(path);
                Some(trace::read::<ScrewSample>(&input, mapping.as_ref(), Err(trace::UNREAD))?.0)
            }
            Source {
                manoeuvre: Some(manoeuvre),
                ..
            } => Some(trace(manoeuvre, design.screw())?),
            _ => None,
        };
        if let Some(trace) = trace {
            let smallest = BALL_LOADS[0] * case.case.balls as f64;
            let loads: Vec<f64> = trace
                .samples
                .iter()
                .map(|sample| sample.axial_load)
                .collect();
            return Self::of_trace(trace.name, &loads, smallest);
        }
        Ok(match arguments.axial_load.as_slice() {
            [] => Self::One(case.case.axial_load),
            [load] => Self::One(*load),
            loads => {
                let sizes = |sign: f64| ends(loads.iter().map(|load| sign * load));
                Self::All {
                    name: "--axial-load".into(),
                    positive: sizes(1.0),
                    negative: sizes(-1.0),
                }
            }
        })
    }

    /// From the smallest load that counts to the largest of each sign.
    fn of_trace(name: String, loads: &[f64], smallest: f64) -> Result<Self, Failure> {
        let [positive, negative] =
            [1.0, -1.0].map(|sign| ends(loads.iter().map(|load| sign * load)));
        let largest = [positive, negative]
            .iter()
            .flatten()
            .fold(0.0, |most: f64, [_, size]| most.max(*size));
        if largest == 0.0 {
            return Err(Failure::Data(format!("{name}: no load along the axis")));
        }
        let counted = |sizes: Option<[f64; 2]>| {
            sizes
                .filter(|[_, size]| *size >= COUNTED * largest)
                .map(|[least, size]| [least.max(smallest).min(size), size])
        };
        Ok(Self::All {
            name,
            positive: counted(positive),
            negative: counted(negative),
        })
    }

    fn answer(&self, case: &LoadCase) -> Result<Answer, String> {
        let tables = |[least, most]: [f64; 2], sign: f64| -> Result<Vec<ShareTable>, String> {
            let loads = loads_between(sign * least, sign * most).map_err(text)?;
            ShareTable::of_loads(&loads, |load| case.under(load).load()?.solve()).map_err(text)
        };
        let balls = case.case.balls as f64;
        match self {
            Self::One(axial_load) => {
                let solution = case.under(*axial_load).load().and_then(|load| load.solve());
                let table = ShareTable::new(*axial_load, &solution.map_err(text)?).map_err(text)?;
                let size = axial_load.abs();
                let sizes = [
                    size.min(BALL_LOADS[0] * balls),
                    size.max(BALL_LOADS[1] * balls),
                ];
                let sign = axial_load.signum();
                let [alike, opposite] = [sign, -sign].map(|sign| tables(sizes, sign));
                // Its own load is tried too.
                let mut alike = alike?;
                let place =
                    alike.partition_point(|other| other.axial_load.abs() < axial_load.abs());
                alike.insert(place, table.clone());
                let said = range_of(&table, &alike, &opposite?)?;
                Ok(Answer::one(case, said, table))
            }
            Self::All {
                name,
                positive,
                negative,
            } => {
                let of = |sizes: &Option<[f64; 2]>, sign: f64| {
                    sizes.map_or_else(|| Ok(Vec::new()), |sizes| tables(sizes, sign))
                };
                answer(case, name, &of(positive, 1.0)?, &of(negative, -1.0)?)
            }
        }
    }
}

/// Smallest and largest of the loads above zero; what is NaN or infinite is none.
fn ends(loads: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    loads.filter(|load| *load > 0.0).fold(None, |ends, load| {
        let [least, most] = ends.unwrap_or([load, load]);
        Some([load.min(least), load.max(most)])
    })
}

#[cfg(test)]
mod tests {
    use super::{Wanted, ends};

    #[test]
    fn ends_of_loads() {
        assert_eq!(
            ends([3.0, -1.0, 0.0, 2.0, 5.0].into_iter()),
            Some([2.0, 5.0])
        );
        assert_eq!(ends([-1.0, 0.0, f64::NAN].into_iter()), None);
    }

    /// Loads below the smallest that counts are left out where there are larger ones, and so is a sign whose loads
    /// are all below a hundredth of the largest one.
    #[test]
    fn loads_that_count() {
        let of = |loads: &[f64]| match Wanted::of_trace("t".into(), loads, 100.0) {
            Ok(Wanted::All {
                positive, negative, ..
            }) => Some((positive, negative)),
            _ => None,
        };
        assert_eq!(of(&[1.0, 5000.0, 0.0]), Some((Some([100.0, 5000.0]), None)));
        assert_eq!(
            of(&[200.0, 5000.0, -49.0]),
            Some((Some([200.0, 5000.0]), None))
        );
        assert_eq!(
            of(&[200.0, 5000.0, -51.0]),
            Some((Some([200.0, 5000.0]), Some([51.0, 51.0])))
        );
        assert_eq!(of(&[0.0, 20.0, 50.0]), Some((Some([50.0, 50.0]), None)));
        assert_eq!(of(&[0.0, 0.0]), None);
    }
}
