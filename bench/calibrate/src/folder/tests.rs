//! Folders of traces whose "fit" reads its answer from the file: friction, its relative error, offset.

use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};

use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use tempfile::{TempDir, tempdir};

use super::answered::merged as merged_texts;
use super::*;
use crate::answer::Estimate;

const OFFSET_ERROR: f64 = 1e-3;

/// What a trace of one positive and one free parameter gave: values, standard errors of the inner coordinates, correlation.
fn told(values: [f64; 2], [one, two]: [f64; 2], correlation: f64) -> Answered {
    let covariance = one * two * correlation;
    Answered {
        with_design: true,
        names: ["friction", "offset"].map(String::from).into(),
        logarithmic: vec![true, false],
        values: values.into(),
        covariance: vec![one * one, covariance, covariance, two * two],
        model_errors: vec![0.0; 2],
    }
}

/// What a trace told whose file says so.
fn fit(trace: &Path) -> Result<(Calibration, Answered), Failure> {
    let text = fs::read_to_string(trace).map_err(|error| Failure::file("read", trace, &error))?;
    let words = text.split(',').filter_map(|word| word.parse().ok());
    let [friction, error, offset] = words.collect::<Vec<f64>>()[..] else {
        return Err(Failure::Data("the speed is constant".into()));
    };
    let estimate = |name, value, error: f64| Estimate::told(name, "", value, 1.96 * error);
    let calibration = Calibration {
        parameters: vec![
            estimate("friction", friction, friction * error),
            estimate("offset", offset, OFFSET_ERROR),
            Estimate::fixed("gain", "", 1.0),
        ],
        residual_rms: 0.1,
        relative_error: 0.05,
        effective_rows: 7.3,
        ..Calibration::default()
    };
    let answered = told([friction, offset], [error, OFFSET_ERROR], 0.3);
    Ok((calibration, answered))
}

/// A folder of so many traces of one population.
fn traces(count: u64) -> TempDir {
    let folder = tempdir().unwrap();
    for index in 0..count {
        let mut source = Pcg64::seed_from_u64(index);
        let mut scattered = || -> f64 { source.random_range(-1.0..1.0) };
        let friction = 0.12 * (0.1 * scattered()).exp();
        let (error, offset) = (0.02 + 0.01 * scattered(), 0.01 + 3e-3 * scattered());
        let path = folder.path().join(format!("trace{index:03}.csv"));
        fs::write(path, format!("{friction},{error},{offset}")).unwrap();
    }
    fs::write(folder.path().join("notes.txt"), "no trace").unwrap();
    folder
}

fn arguments(part: &str, outputs: &[TempDir]) -> FolderArguments {
    FolderArguments {
        part: part.parse().ok(),
        merge: outputs.iter().map(|own| own.path().into()).collect(),
    }
}

/// The answer of a run, and how many traces it fitted.
fn run_of(
    traces: &Path,
    output: &Path,
    arguments: &FolderArguments,
    settings: &str,
) -> (Result<Together, Failure>, usize) {
    let count = AtomicUsize::new(0);
    let folder = Folder {
        traces,
        output,
        arguments,
        settings,
        json: false,
    };
    let together = answer(&folder, &|trace: &Path| {
        count.fetch_add(1, Ordering::Relaxed);
        fit(trace)
    });
    (together, count.into_inner())
}

fn word(together: Result<Together, Failure>) -> String {
    match together.and_then(|together| together.nothing_told().map_or(Ok(()), Err)) {
        Err(Failure::Data(word)) => word,
        other => panic!("{other:?}"),
    }
}

/// Merged by files, in any order, and as texts, in any grouping.
#[test]
fn any_partition_has_the_same_answer_to_the_last_bit() {
    let traces = traces(31);
    let output = tempdir().unwrap();
    let run = |output: &TempDir, arguments: &FolderArguments| {
        let (together, fitted) = run_of(traces.path(), output.path(), arguments, "");
        (together.unwrap(), fitted)
    };
    let (whole, fitted) = run(&output, &FolderArguments::default());
    assert_eq!(
        (fitted, whole.traces.len(), whole.population.len()),
        (31, 31, 2)
    );
    for count in [2, 5, 31] {
        let parts = (1..=count).rev().map(|index| {
            let own = tempdir().unwrap();
            run(&own, &arguments(&format!("{index}/{count}"), &[]));
            own
        });
        let parts: Vec<TempDir> = parts.collect();
        let (merged, fitted) = run(&output, &arguments("", &parts));
        assert_eq!((fitted, merged.json()), (0, whole.json()));
    }
    let text = |list: &[Answered]| serde_json::to_string(list).unwrap();
    let all: Vec<Answered> = whole
        .told()
        .map(|(_, told)| told.answered.clone())
        .collect();
    let once = merged_texts([text(&all).as_str()]).unwrap();
    let (one, two) = all.split_at(13);
    let one = merged_texts([text(&one[7..]).as_str(), &text(&one[..7])]).unwrap();
    let twice = merged_texts([text(two).as_str(), &text(&one)]).unwrap();
    assert_eq!(text(&twice), text(&once));
}

#[test]
fn a_stopped_run_goes_on_where_it_was() {
    let traces = traces(10);
    let output = tempdir().unwrap();
    let all = FolderArguments::default();
    let fitted = |arguments: &FolderArguments, settings: &str| {
        let (together, fitted) = run_of(traces.path(), output.path(), arguments, settings);
        (together.unwrap().json(), fitted)
    };
    let (_, half) = fitted(&arguments("1/2", &[]), "");
    let (whole, rest) = fitted(&all, "");
    assert_eq!((half, rest), (5, 5));
    assert_eq!(fitted(&all, ""), (whole.clone(), 0));

    // Damaged, cut off, or of another trace: fitted again.
    let place = |trace: &str| store::place(output.path(), trace);
    let other = fs::read_to_string(place("trace004.csv")).unwrap();
    for text in ["", "{\"trace\":", "[1]", &other] {
        fs::write(place("trace003.csv"), text).unwrap();
        assert_eq!(fitted(&all, ""), (whole.clone(), 1), "{text}");
    }

    // Other bytes are fitted again, and another copy of the same is not.
    let path = traces.path().join("trace007.csv");
    let mut bytes = fs::read(&path).unwrap();
    fs::remove_file(&path).unwrap();
    fs::write(&path, &bytes).unwrap();
    assert_eq!(fitted(&all, ""), (whole.clone(), 0));
    bytes[2] = b'2';
    fs::write(&path, bytes).unwrap();
    let (now, again) = fitted(&all, "");
    assert!(again == 1 && now != whole);
    // Other settings: all of them.
    assert_eq!(fitted(&all, "filter 100 Hz").1, 10);
}

#[test]
fn bad_traces_are_told_and_stop_nothing() {
    let traces = traces(4);
    fs::write(traces.path().join("bad.csv"), "nothing").unwrap();
    let output = tempdir().unwrap();
    let all = FolderArguments::default();
    let together = run_of(traces.path(), output.path(), &all, "").0.unwrap();
    assert!(together.told().count() == 4 && together.nothing_told().is_none());
    let page = tempdir().unwrap();
    page::document(&together).write(page.path()).unwrap();
    let text = fs::read_to_string(page.path().join("report.md")).unwrap();
    for line in [
        "4 of 5 traces tell something; 1 were refused.",
        "| bad.csv | the speed is constant |",
    ] {
        assert!(text.contains(line), "{text}");
    }
    // A bad answer is kept too: it needs no second look.
    assert_eq!(run_of(traces.path(), output.path(), &all, "").1, 0);

    let [empty, output] = [tempdir().unwrap(), tempdir().unwrap()];
    let said = |folder: &Path| word(run_of(folder, output.path(), &all, "").0);
    assert!(said(empty.path()).contains("no trace"));
    fs::write(empty.path().join("bad.csv"), "nothing").unwrap();
    assert!(said(empty.path()).contains("bad.csv: the speed is constant"));
    assert!(said(&empty.path().join("missing")).contains("missing"));
}

/// 19 traces within 10 % and one three times as large: it stands out, and the mean without it is that of the others.
#[test]
fn a_trace_that_stands_out_is_named() {
    let traces = traces(20);
    let output = tempdir().unwrap();
    fs::write(traces.path().join("trace005.csv"), "0.36,0.02,0.01").unwrap();
    let all = FolderArguments::default();
    let together = run_of(traces.path(), output.path(), &all, "").0.unwrap();
    let named = together
        .outliers
        .iter()
        .map(|out| (&*out.trace, &*out.parameter));
    assert_eq!(named.collect::<Vec<_>>(), [("trace005.csv", "friction")]);
    let [with, without] = [&together.population, &together.without_outliers].map(|all| all[0].mean);
    assert!(with > without * 1.03);
    // Spread of 0.1/sqrt(3) over 19 traces: 0.013 of the mean.
    assert!((without / 0.12 - 1.0).abs() < 0.04);
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let [one, other] = [traces(3), traces(3)];
    fs::write(other.path().join("trace001.csv"), "0.5,0.02,0.01").unwrap();
    let outputs = [tempdir().unwrap(), tempdir().unwrap()];
    let all = FolderArguments::default();
    for (traces, output) in [&one, &other].into_iter().zip(&outputs) {
        run_of(traces.path(), output.path(), &all, "").0.unwrap();
    }
    let both = run_of(one.path(), outputs[0].path(), &arguments("", &outputs), "").0;
    assert!(matches!(both, Err(Failure::Data(word)) if word.contains("trace001.csv")));
    // The same twice counts once.
    let mut twice = arguments("", &outputs[..1]);
    twice.merge.push(outputs[0].path().into());
    let twice = run_of(one.path(), outputs[0].path(), &twice, "").0;
    assert_eq!(twice.unwrap().traces.len(), 3);

    let good = told([0.12, 0.01], [0.1, 1e-3], 0.0);
    let mut wrong = [(); 4].map(|()| good.clone());
    wrong[0].values[0] = -1.0;
    wrong[1].values.pop();
    wrong[2].covariance[3] = 0.0;
    wrong[3].covariance[2] = 1.0;
    for answered in wrong {
        assert!(answered.clone().checked().is_err(), "{answered:?}");
    }
    let mut without_design = good.clone();
    without_design.with_design = false;
    let mut linear = good.clone();
    linear.logarithmic[0] = false;
    for other in [&without_design, &linear] {
        assert!(alike(&[&good, &good]).is_ok() && alike(&[&good, other]).is_err());
    }
    for text in ["", "2", "0/3", "4/3", "1/0", "-1/2", "1/2/3"] {
        assert!(text.parse::<Part>().is_err(), "{text}");
    }
    assert_eq!("2/8".parse(), Ok(Part { index: 1, count: 8 }));
}

/// Truth of the population: mean and spread of the logarithm and of the value.
const POPULATION: ([f64; 2], [f64; 2]) = ([0.12, 0.01], [0.2, 3e-3]);

/// Forty traces whose errors span a factor of ten.
fn drawn(seed: u64) -> Vec<Answered> {
    let mut source = Pcg64::seed_from_u64(seed);
    let mut normal = move || -> f64 { source.sample(StandardNormal) };
    let one = |k: u32| {
        let size = 10f64.powf(-f64::from(k) / 40.0);
        let errors = [0.4 * size, 5e-3 * size];
        let ([friction, offset], spread) = POPULATION;
        let log = friction.ln() + spread[0] * normal() + errors[0] * normal();
        let offset = offset + spread[1] * normal() + errors[1] * normal();
        told([log.exp(), offset], errors, 0.0)
    };
    (0..40).map(one).collect()
}

fn population_of(all: &[Answered]) -> Vec<Population> {
    populations(&all.iter().collect::<Vec<_>>())
}

/// Mean and spread of populations with known ones: in 200 populations of 40 traces the 95 % interval of the mean holds it in 180 to 199,
/// and the spread's mean is right within 5 % (its own deviation is about 15 % of it, 1 % for the mean of 200).
#[test]
fn mean_and_spread() {
    let (mut held, mut spreads) = ([0, 0], [0.0, 0.0]);
    for run in 0..200 {
        for (k, population) in population_of(&drawn(100 + run)).iter().enumerate() {
            let [low, high] = population.mean_interval;
            held[k] += u32::from((low..=high).contains(&POPULATION.0[k]));
            spreads[k] += population.spread.unwrap() / POPULATION.1[k] / 200.0;
        }
    }
    for k in 0..2 {
        assert!((180..=199).contains(&held[k]), "{held:?}");
        assert!((spreads[k] - 1.0).abs() < 0.05, "{spreads:?}");
    }
}

/// An error that all traces of a screw share does not average out: with a shift of the whole population drawn from the traces' own
/// model error, five times what the mean of 40 traces would be sure of, the interval holds the mean in 180 to 199 of 200; without it in
/// fewer than half.
#[test]
fn errors_of_the_model_stay_in_the_mean() {
    let shared = 0.3;
    let held = |model_error: f64| {
        let mut source = Pcg64::seed_from_u64(3);
        let runs = (0..200).filter(|run| {
            let shift: f64 = shared * source.sample::<f64, _>(StandardNormal);
            let mut all = drawn(100 + run);
            for answered in &mut all {
                answered.values[0] *= shift.exp();
                answered.model_errors[0] = model_error;
            }
            let [low, high] = population_of(&all)[0].mean_interval;
            (low..=high).contains(&POPULATION.0[0])
        });
        runs.count()
    };
    assert!((180..=199).contains(&held(shared)), "{}", held(shared));
    assert!(held(0.0) < 100, "{}", held(0.0));
}

/// One trace alone has its own value and error, and no spread.
#[test]
fn one_trace() {
    let alone = &population_of(&[told([0.12, 0.01], [0.1, 1e-3], 0.5)])[0];
    assert!((alone.mean - 0.12).abs() < 1e-15);
    assert!((alone.mean_interval[1] - 0.12 * (0.196f64).exp()).abs() < 1e-12);
    assert_eq!((alone.spread, alone.next), (None, None));
}
