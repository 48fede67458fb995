//! Runs at one speed each, and traces with reversals beside them, as one measurement.
//!
//! A run is one row, its means: `effort - tau = b w + offset + s (T_C + losses)`, beside the rows of the traces that turn. Where friction
//! rises towards rest the runs tell it as `s T_S exp(-|w|/w_s)`.

use std::path::Path;

use crate::answer::Calibration;
use crate::estimator::choice::{Estimate, Wanted, estimate};
use crate::estimator::fit::Block;
use crate::estimator::record::Record;
use crate::estimator::terms::Term;
use crate::estimator::words::NOTHING;
use crate::folder::list;
use crate::page::shown::digits;
use crate::trace::{Coordinate, Trace};
use crate::without_design::drive::Drive;
use crate::without_design::{self, largest};
use epas_page::failure::Failure;

const FEWEST: usize = 3;

/// Share of the efforts that is left from which on it is said.
const MUCH: f64 = 0.1;

/// Residual with friction that changes towards rest over that without it, from which on it is told.
const TAKES: f64 = 0.9;

/// Speeds over which friction may change towards rest that are tried.
const TRIED: u32 = 9;

#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub name: String,
    /// Speed, rad/s or m/s.
    pub speed: f64,
    /// Mean effort without the load's, N m or N.
    pub effort: f64,
    pub model: f64,
}

#[derive(Clone, Debug)]
pub struct Steady {
    pub coordinate: Coordinate,
    pub answer: Calibration,
    pub runs: Vec<Run>,
    pub drive: Drive,
}

/// Traces of a folder among which a run at one speed is looked for.
const LOOKED_AT: usize = 16;

/// What the traces of a folder tell together, read by `read`, where some of them are runs at one speed; `None` where none of the first
/// sixteen is.
pub fn of_folder(
    folder: &Path,
    read: impl Fn(&Path) -> Result<Trace, Failure>,
) -> Result<Option<Steady>, Failure> {
    let paths = list(folder, &["csv", "mf4"])?;
    let (mut traces, mut refused) = (Vec::new(), Vec::new());
    for (number, path) in paths.iter().enumerate() {
        match read(path) {
            Ok(trace) => traces.push(trace),
            Err(Failure::Data(word)) => refused.push(format!("left out: {word}")),
            Err(other) => return Err(other),
        }
        if number + 1 == LOOKED_AT && !steady(&records(&traces)) {
            return Ok(None);
        }
    }
    let mut found = told(&traces)?;
    if let Some(found) = &mut found {
        found.answer.cannot_tell.extend(refused);
    }
    Ok(found)
}

fn records(traces: &[Trace]) -> Vec<Record> {
    traces.iter().map(without_design::record).collect()
}

/// Whether some of them are runs at one speed, or move at one by turns.
fn steady(records: &[Record]) -> bool {
    let one_speed = |record: &Record| {
        record.one_speed().is_some()
            || estimate(std::slice::from_ref(record), &Wanted::default())
                .is_some_and(|found| found.of(Term::OneSpeed).is_some())
    };
    records.iter().filter(|record| one_speed(record)).count() >= FEWEST
}

/// What traces tell together, where some of them are runs at one speed; `None` where they are not.
pub fn told(traces: &[Trace]) -> Result<Option<Steady>, Failure> {
    let records = records(traces);
    if !steady(&records) {
        return Ok(None);
    }
    let speeds: Vec<Option<f64>> = records
        .iter()
        .map(|record| record.one_speed().map(|(speed, _)| speed))
        .collect();
    let coordinate = traces[0].coordinate;
    if let Some(other) = traces.iter().find(|trace| trace.coordinate != coordinate) {
        return Err(Failure::Data(format!(
            "{} and {} are not of one coordinate: one is of an angle and a torque, one of a travel and a force",
            traces[0].name, other.name
        )));
    }
    let untold = || {
        Failure::Data("the runs tell nothing: give three or more speeds, in both directions".into())
    };
    let plain = estimate(&records, &Wanted::default()).ok_or_else(untold)?;
    let found = dip(&records, &speeds, &plain).unwrap_or(plain);
    let left = found.fit.relative;
    if left > NOTHING {
        return Err(Failure::Data(format!(
            "nothing explains the runs: {:.0} % of their efforts are left; has each effort its sign, and is it in one unit?",
            100.0 * left
        )));
    }
    let mut answer = without_design::of_estimate(&found, coordinate, Vec::new());
    let has = |term: Term| found.of(term).is_some();
    if !has(Term::Offset) {
        answer.cannot_tell.push(
            "offset: all runs go one way, and it is one number with the friction; run both ways"
                .into(),
        );
    }
    if has(Term::OneSpeed) {
        answer.cannot_tell.push("viscous friction: all runs have one speed; run at several, over a factor of three or more".into());
    }
    if let Some(Term::Stribeck(speed)) = found
        .terms
        .iter()
        .copied()
        .find(|term| matches!(term, Term::Stribeck(_)))
    {
        answer.cannot_tell.push(format!(
            "how friction changes below the slowest run; over the runs it changes towards rest over {} {}",
            digits(speed, 2),
            match coordinate {
                Coordinate::Rotation => "rad/s",
                Coordinate::Translation => "m/s",
            }
        ));
    }
    let runs = traces.iter().zip(&records).zip(&speeds);
    let mut runs: Vec<Run> = runs
        .filter_map(|((trace, record), speed)| run(trace, record, (*speed)?, &found))
        .collect();
    runs.sort_by(|one, other| one.speed.total_cmp(&other.speed));
    let off = |run: &Run| (run.effort - run.model).abs();
    let farthest = runs
        .iter()
        .max_by(|one, other| off(one).total_cmp(&off(other)));
    if let Some(run) = farthest.filter(|_| left > MUCH) {
        answer.cannot_tell.push(format!(
            "the numbers leave {:.0} % of the efforts, most of them in {}: look at it, and whether friction differs by direction",
            100.0 * left,
            run.name
        ));
    }
    let loaded = traces.iter().all(|trace| trace.load.is_some());
    if loaded && !has(Term::Driving) && !has(Term::BackDriving) && !has(Term::Loss) {
        answer.cannot_tell.push(without_design::OF_ONE_SIZE.into());
    }
    let speeds: Vec<f64> = speeds.into_iter().flatten().collect();
    let loads = traces.iter().filter_map(|trace| trace.load.as_deref());
    let drive = Drive {
        coordinate,
        estimates: answer.parameters.clone(),
        reversal_speed: None,
        largest: [largest(&speeds), loads.map(largest).fold(0.0, f64::max)],
    };
    Ok(Some(Steady {
        coordinate,
        answer,
        runs,
        drive,
    }))
}

fn run(trace: &Trace, record: &Record, speed: f64, found: &Estimate) -> Option<Run> {
    let block = Block::of_run(record, &found.terms, 1.0)?;
    let model = block.columns.iter().zip(&found.fit.coefficients);
    Some(Run {
        name: trace.name.clone(),
        speed,
        effort: *block.target.first()?,
        model: model.map(|(column, value)| column[0] * value).sum(),
    })
}

/// Friction that changes towards rest, over the speed that explains the runs best, where it is told and takes a tenth of the residual.
fn dip(records: &[Record], speeds: &[Option<f64>], plain: &Estimate) -> Option<Estimate> {
    plain.of(Term::Viscous)?;
    let mut sizes: Vec<f64> = speeds.iter().flatten().map(|speed| speed.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let (slow, fast) = (*sizes.first()?, *sizes.last()?);
    let most = fast / 4.0;
    if most <= slow {
        return None;
    }
    let tried = (0..TRIED).map(|k| slow * (most / slow).powf(f64::from(k) / f64::from(TRIED - 1)));
    tried
        .filter_map(|speed| {
            let term = Term::Stribeck(speed);
            let wanted = Wanted {
                more: vec![term],
                ..Wanted::default()
            };
            let found = estimate(records, &wanted)?;
            found.surely(term, TRIED)?;
            let (coulomb, _) = found.of(Term::Coulomb)?;
            (coulomb > 0.0).then_some(found)
        })
        .filter(|found| found.fit.residual_rms < TAKES * plain.fit.residual_rms)
        .min_by(|one, other| one.fit.residual_rms.total_cmp(&other.fit.residual_rms))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::toys::noise;
    use crate::without_design::drive::Numbers;

    const TRUTH: [(&str, f64); 3] = [
        ("coulomb_friction", 0.1),
        ("viscous_friction", 2e-3),
        ("offset", 0.01),
    ];

    /// A run of 20 s at 25 Hz with a ripple of the turn; `rise` is friction near rest beyond Coulomb's, over 6 rad/s.
    fn run(number: u64, speed: f64, rise: f64) -> Trace {
        let (tick, count) = (0.04, 500);
        let [coulomb, viscous, offset] = TRUTH.map(|(_, value)| value);
        let rough = noise(number, count, 0.0);
        let mean = (coulomb + rise * (-speed.abs() / 6.0).exp()) * speed.signum()
            + viscous * speed
            + offset;
        let at = |sample: usize| speed * tick * sample as f64;
        Trace {
            name: format!("run {speed}"),
            step: tick,
            position: (0..count).map(at).collect(),
            position_summed: true,
            speed: Some(rough.iter().map(|rough| speed + 0.01 * rough).collect()),
            effort: (0..count)
                .map(|k| mean + 5e-3 * at(k).sin() + 2e-3 * rough[k])
                .collect(),
            ..Trace::default()
        }
    }

    fn runs(rise: f64) -> Vec<Trace> {
        let speeds = [1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 60.0, 80.0];
        let both = speeds.into_iter().flat_map(|speed| [speed, -speed]);
        both.zip(1..)
            .map(|(speed, number)| run(number, speed, rise))
            .collect()
    }

    /// Each within its interval joined with a hundredth of the truth: three intervals of 95 % hold in 6 of 7 samples only.
    fn holds(found: &Steady) {
        for (name, truth) in TRUTH {
            let told = found.answer.parameter(name).unwrap();
            let off = (told.value - truth).abs();
            assert!(off <= told.half_width() + 0.01 * truth, "{name}: {told:?}");
            assert!(told.half_width() < 0.4 * truth, "{name}: {told:?}");
        }
    }

    #[test]
    fn runs_are_one_measurement() {
        let found = told(&runs(0.0)).unwrap().unwrap();
        holds(&found);
        assert!(found.answer.parameter("stribeck_friction").is_none());
        assert_eq!(found.runs.len(), 16);
        let risen = told(&runs(0.05)).unwrap().unwrap();
        let rise = risen.answer.parameter("stribeck_friction").unwrap();
        assert!((rise.value - 0.05).abs() < 0.01, "{rise:?}");
        // Their constants need no inertia, and say that a dip is left out.
        let [plain, risen] = [&found, &risen].map(|found| found.drive.numbers().unwrap());
        assert_eq!((plain.inertia, plain.offset.is_some()), (None, true));
        let said = |numbers: &Numbers| {
            numbers
                .notes
                .iter()
                .any(|note| note.contains("stribeck friction"))
        };
        assert!(said(&risen) && !said(&plain));
        let text = crate::outputs::drive::text(&risen, "runs").unwrap();
        assert!(text.contains("which this scene does not have"), "{text}");
        assert!(told(&runs(0.0)[..1]).unwrap().is_none());
    }

    #[test]
    fn what_does_not_fit_is_said() {
        let mut signless = runs(0.0);
        for effort in signless.iter_mut().flat_map(|run| &mut run.effort) {
            *effort = effort.abs();
        }
        assert!(told(&signless).is_err());
        let mut off = runs(0.0);
        for effort in &mut off[4].effort {
            *effort += 0.3;
        }
        let said = told(&off).unwrap().unwrap().answer.cannot_tell.join(" ");
        assert!(said.contains("most of them in run 5"), "{said}");
        let one_way: Vec<Trace> = runs(0.0).into_iter().step_by(2).collect();
        let said = told(&one_way)
            .unwrap()
            .unwrap()
            .answer
            .cannot_tell
            .join(" ");
        assert!(said.contains("all runs go one way"), "{said}");
    }
}
