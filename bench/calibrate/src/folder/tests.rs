//! Folders of traces whose "fit" reads its answer from the file: friction, its relative error, offset.

use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, SystemTime};

use nalgebra::DMatrix;
use tempfile::{TempDir, tempdir};

use super::*;
use crate::answer::Estimate;
use crate::fit::problem::Scale;
use crate::fit::uncertainty::{Interval, Uncertainty};
use crate::sums::Reference;

/// Standard error of the offset.
const OFFSET_ERROR: f64 = 1e-3;

fn reference() -> Vec<Reference> {
    let reference = |name: &str, logarithmic, value| Reference {
        name: name.into(),
        logarithmic,
        value,
    };
    vec![
        reference("friction", true, 0.1),
        reference("offset", false, 0.02),
    ]
}

/// What a trace told whose file says so.
fn fit(trace: &Path) -> Result<(Calibration, Sums), Failure> {
    let text = fs::read_to_string(trace).map_err(|error| Failure::file("read", trace, &error))?;
    let numbers: Vec<f64> = text
        .split(',')
        .filter_map(|word| word.parse().ok())
        .collect();
    let [friction, error, offset] = numbers[..] else {
        return Err(Failure::Data("the speed is constant".into()));
    };
    let errors = [error, OFFSET_ERROR];
    let interval = |name, scale, value, error| Interval {
        name,
        unit: "",
        scale,
        value,
        low: value,
        high: value,
        standard_error: error,
        model_error: 0.0,
        half_width: 2.0 * error,
        bounds: [f64::MIN_POSITIVE, f64::MAX],
        at_bound: false,
    };
    let sure = Uncertainty {
        intervals: vec![
            interval("friction", Scale::Logarithmic, friction, error),
            interval("offset", Scale::Linear, offset, OFFSET_ERROR),
        ],
        covariance: DMatrix::from_fn(2, 2, |i, j| {
            errors[i] * errors[j] * if i == j { 1.0 } else { 0.3 }
        }),
        correlation: DMatrix::identity(2, 2),
        effective_rows: 7.3,
    };
    let mut sums = Sums::new(reference()).unwrap();
    sums.add(&[0.1; 10], &sure).unwrap();
    let estimate = |name: &str, value: f64, error: f64| Estimate {
        name: name.into(),
        unit: "",
        value,
        low: value - 1.96 * error,
        high: value + 1.96 * error,
        fixed: false,
        at_bound: false,
    };
    let calibration = Calibration {
        parameters: vec![
            estimate("friction", friction, friction * error),
            estimate("offset", offset, OFFSET_ERROR),
            Estimate::fixed("gain", "", 1.0),
        ],
        residual_rms: 0.1,
        relative_error: 0.05,
        effective_rows: 7.3,
        cannot_tell: Vec::new(),
        models: Vec::new(),
        winner: None,
    };
    Ok((calibration, sums))
}

/// A number between -1 and 1 that looks random.
fn scattered(index: u32) -> f64 {
    f64::from(index.wrapping_mul(2_654_435_769) >> 8) / f64::from(1u32 << 23) - 1.0
}

/// A folder of so many traces of one population.
fn traces(count: u32) -> TempDir {
    let folder = tempdir().unwrap();
    for index in 0..count {
        let friction = 0.12 * (0.1 * scattered(index)).exp();
        let error = 0.02 + 0.01 * scattered(index + 1000);
        let offset = 0.01 + 3e-3 * scattered(index + 2000);
        let path = folder.path().join(format!("trace{index:03}.csv"));
        fs::write(path, format!("{friction},{error},{offset}")).unwrap();
    }
    fs::write(folder.path().join("notes.txt"), "no trace").unwrap();
    folder
}

fn part(text: &str) -> FolderArguments {
    FolderArguments {
        part: Some(text.parse().unwrap()),
        merge: Vec::new(),
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

/// Compensated sums differ by their last rounding; what follows from them by some more of 1.1e-16 each: the spread is a difference
/// of squares that are ten times as large.
#[test]
fn any_partition_has_the_same_answer() {
    let traces = traces(31);
    let output = tempdir().unwrap();
    let all = FolderArguments::default();
    let (whole, fitted) = run_of(traces.path(), output.path(), &all, "");
    let whole = whole.unwrap();
    assert_eq!((fitted, whole.traces.len()), (31, 31));
    for count in [2, 5, 31] {
        let mut outputs: Vec<TempDir> = Vec::new();
        for index in 1..=count {
            let own = tempdir().unwrap();
            let arguments = part(&format!("{index}/{count}"));
            run_of(traces.path(), own.path(), &arguments, "").0.unwrap();
            outputs.push(own);
        }
        outputs.reverse();
        let merge = FolderArguments {
            part: None,
            merge: outputs.iter().map(|own| own.path().into()).collect(),
        };
        let (merged, fitted) = run_of(traces.path(), output.path(), &merge, "");
        let merged = merged.unwrap();
        assert_eq!(fitted, 0);
        assert_eq!(merged.json()["traces"], whole.json()["traces"]);
        assert_eq!(merged.population.len(), 2);
        for (one, other) in merged.population.iter().zip(&whole.population) {
            assert_eq!((&one.name, one.traces), (&other.name, other.traces));
            let pairs = [
                (one.mean, other.mean),
                (one.mean_interval[0], other.mean_interval[0]),
                (one.spread.unwrap(), other.spread.unwrap()),
            ];
            for (one, other) in pairs {
                assert!((one - other).abs() <= 1e-13 * other.abs(), "{one} {other}");
            }
        }
    }
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
    let (_, half) = fitted(&part("1/2"), "");
    let (whole, rest) = fitted(&all, "");
    assert_eq!((half, rest), (5, 5));
    assert_eq!(fitted(&all, ""), (whole.clone(), 0));

    // Damaged, cut off, or of another trace: fitted again.
    for text in ["", "{\"trace\":", "[1]"] {
        fs::write(store::place(output.path(), "trace003.csv"), text).unwrap();
        assert_eq!(fitted(&all, ""), (whole.clone(), 1), "{text}");
    }
    let other = fs::read(store::place(output.path(), "trace004.csv")).unwrap();
    fs::write(store::place(output.path(), "trace003.csv"), other).unwrap();
    assert_eq!(fitted(&all, ""), (whole.clone(), 1));

    // Other bytes are fitted again, and a later copy of the same is not.
    let path = traces.path().join("trace007.csv");
    let before = fs::read(&path).unwrap();
    let later = |hours: u64| {
        let file = fs::File::options().write(true).open(&path).unwrap();
        let time = SystemTime::now() + Duration::from_secs(3600 * hours);
        file.set_modified(time).unwrap();
    };
    later(1);
    assert_eq!(fitted(&all, ""), (whole.clone(), 0));
    let mut changed = before.clone();
    changed[2] = b'2';
    fs::write(&path, changed).unwrap();
    later(2);
    let (now, again) = fitted(&all, "");
    assert!(again == 1 && now != whole);

    // Other settings: all of them.
    assert_eq!(fitted(&all, "filter 100 Hz").1, 10);
}

#[test]
fn one_bad_trace_does_not_stop_the_others() {
    let traces = traces(4);
    fs::write(traces.path().join("bad.csv"), "nothing").unwrap();
    let output = tempdir().unwrap();
    let all = FolderArguments::default();
    let together = run_of(traces.path(), output.path(), &all, "").0.unwrap();
    assert_eq!(together.told().count(), 4);
    let refused: Vec<_> = together.refused().collect();
    assert_eq!(refused, [("bad.csv", "the speed is constant")]);
    assert!(together.nothing_told().is_none());
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
}

#[test]
fn a_folder_that_tells_nothing_is_a_failure() {
    let folder = tempdir().unwrap();
    let output = tempdir().unwrap();
    let all = FolderArguments::default();
    let failure = |together: Result<Together, Failure>| match together {
        Ok(together) => together.nothing_told().unwrap(),
        Err(failure) => failure,
    };
    let word = |failure: Failure| match failure {
        Failure::Data(word) => word,
        other => panic!("{other:?}"),
    };
    let empty = run_of(folder.path(), output.path(), &all, "").0;
    assert!(word(failure(empty)).contains("no trace"));
    fs::write(folder.path().join("bad.csv"), "nothing").unwrap();
    let bad = run_of(folder.path(), output.path(), &all, "").0;
    assert!(word(failure(bad)).contains("bad.csv: the speed is constant"));
    let missing = run_of(&folder.path().join("missing"), output.path(), &all, "").0;
    assert!(word(failure(missing)).contains("missing"));
}

/// 19 traces within 10 % and one three times as large: it stands out, and the mean without it is that of the others.
#[test]
fn a_trace_that_stands_out_is_named() {
    let traces = traces(20);
    let output = tempdir().unwrap();
    fs::write(traces.path().join("trace005.csv"), "0.36,0.02,0.01").unwrap();
    let all = FolderArguments::default();
    let together = run_of(traces.path(), output.path(), &all, "").0.unwrap();
    let named: Vec<_> = together
        .outliers
        .iter()
        .map(|out| (out.trace.as_str(), out.parameter.as_str()))
        .collect();
    assert_eq!(named, [("trace005.csv", "friction")]);
    let mean = |population: &[crate::sums::Population]| population[0].mean;
    assert!(mean(&together.population) > mean(&together.without_outliers) * 1.03);
    // Spread of 0.1/sqrt(3) over 19 traces: 0.013 of the mean.
    assert!((mean(&together.without_outliers) / 0.12 - 1.0).abs() < 0.04);
}

#[test]
fn other_data_under_one_name_is_refused() {
    let [one, other] = [traces(3), traces(3)];
    fs::write(other.path().join("trace001.csv"), "0.5,0.02,0.01").unwrap();
    let outputs = [tempdir().unwrap(), tempdir().unwrap()];
    let all = FolderArguments::default();
    for (traces, output) in [&one, &other].into_iter().zip(&outputs) {
        run_of(traces.path(), output.path(), &all, "").0.unwrap();
    }
    let merge = |folders: [&TempDir; 2]| FolderArguments {
        part: None,
        merge: folders.map(|folder| folder.path().into()).into(),
    };
    let both = run_of(
        one.path(),
        outputs[0].path(),
        &merge([&outputs[0], &outputs[1]]),
        "",
    )
    .0;
    assert!(matches!(both, Err(Failure::Data(word)) if word.contains("trace001.csv")));
    // The same twice counts once.
    let twice = run_of(
        one.path(),
        outputs[0].path(),
        &merge([&outputs[0], &outputs[0]]),
        "",
    )
    .0;
    assert_eq!(twice.unwrap().traces.len(), 3);
}

#[test]
fn a_part_is_one_of_some() {
    assert_eq!("2/8".parse(), Ok(Part { index: 1, count: 8 }));
    for text in ["", "2", "0/3", "4/3", "1/0", "-1/2", "1/2/3"] {
        assert!(text.parse::<Part>().is_err(), "{text}");
    }
}
