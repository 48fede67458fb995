//! A thousand design files made from their numbers: valid ones, and ones with a value, key, type, unit or nesting that is wrong.

use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rand::RngExt;
use rand_pcg::Pcg64;

use super::*;

const FILES: u32 = 1_000;
const STREAM: u128 = 36;

/// A line of a file: table ("" for none), key, value.
type Line = (&'static str, &'static str, String);

fn lines(random: &mut Pcg64) -> Vec<Line> {
    let mut between = |least: f64, most: f64| random.random_range(least..=most);
    let diameter = between(0.016, 0.063);
    let ball = diameter * between(0.09, 0.16);
    let friction = between(0.06, 0.14);
    let number = |value: f64| format!("{value:.6e}");
    let mut lines: Vec<Line> = [
        ("", "nominal_diameter", diameter),
        ("", "lead", ball * between(1.2, 3.0)),
        ("", "ball_diameter", ball),
        ("", "conformity", between(0.52, 0.56)),
        ("", "contact_angle", between(0.7, 0.87)),
        ("", "friction", friction),
        ("", "clearance", between(-1e-6, 5e-6)),
        ("", "hysteresis_loss", between(0.0, 0.05)),
        ("", "lubricant_drag", between(0.0, 1.0)),
        ("", "reversal_speed", between(0.1, 5.0)),
        ("", "youngs_modulus", between(1.9e11, 2.2e11)),
        ("", "poisson_ratio", between(0.25, 0.32)),
        ("limits", "nut_speed", between(50.0, 2e3)),
        ("limits", "axial_load", between(1e3, 5e4)),
        ("limits", "friction_torque", between(1.0, 50.0)),
        ("uncaged", "turns", between(1.0, 3.0)),
        ("uncaged", "ball_friction", between(0.0, 0.2)),
        // So short that all balls are loaded, to one.
        ("uncaged", "return_length", between(0.0, 1e-3)),
        ("fold", "screw_deviation", between(0.05, 0.1)),
    ]
    .into_iter()
    .map(|(table, key, value)| (table, key, number(value)))
    .collect();
    let most = between(50.0, 300.0);
    lines.push(("fold", "axial_load", format!("[5, {most:.1}]")));
    lines.push(("fold", "friction", "[0.05, 0.15]".into()));
    let balls = between(10.0, 40.0).floor();
    lines.push(("", "loaded_balls", format!("{balls}")));
    lines.push(("uncaged", "balls", format!("{balls}")));
    let wave = between(0.0, 0.04);
    let wave = format!("[{{ order = 2, sine = {wave:.4} }}]");
    lines.push(("uncaged", "screw_deviation", wave));
    lines
}

fn text(lines: &[Line]) -> String {
    let mut text = String::new();
    for table in ["", "limits", "uncaged", "fold"] {
        if !table.is_empty() {
            writeln!(text, "[{table}]").unwrap();
        }
        for (_, key, value) in lines.iter().filter(|line| line.0 == table) {
            writeln!(text, "{key} = {value}").unwrap();
        }
    }
    text
}

#[derive(Clone, Debug, PartialEq)]
enum Done {
    Nothing,
    /// A key has another number.
    Number(&'static str, String),
    /// A key has what is not a number.
    Type(&'static str),
    Key(String),
    /// A key that is needed is missing.
    Missing(&'static str),
    /// A key stands twice.
    Twice(&'static str),
    /// Characters are gone, or the file ends early.
    Torn,
}

const NEEDED: [&str; 5] = [
    "nominal_diameter",
    "lead",
    "ball_diameter",
    "contact_angle",
    "balls",
];

const TYPES: [&str; 7] = [
    "true",
    "\"low\"",
    "1979-05-27",
    "{ least = 1 }",
    "[[true]]",
    "[true]",
    "\"0.1\"",
];

/// A number that is wrong, at a border, or in another unit.
fn spoiled(value: &str, choice: usize) -> String {
    let number: f64 = value.parse().unwrap_or(1.0);
    let scaled = |factor: f64| format!("{:e}", number * factor);
    match choice {
        0 => "nan".into(),
        1 => "inf".into(),
        2 => "-inf".into(),
        3 => "0.0".into(),
        4 => "1e300".into(),
        5 => "-1e300".into(),
        6 => "1e-300".into(),
        7 => "3.5e38".into(),
        8 => scaled(-1.0),
        // Millimetres, degrees, GPa, pounds of force.
        9 => scaled(1e3),
        10 => scaled(57.295_78),
        11 => scaled(1e-9),
        12 => scaled(0.224_8),
        // Near the value: at a border of what is plausible.
        13 => scaled(2.0),
        14 => scaled(0.5),
        _ => scaled(1.000_001),
    }
}

fn renamed(lines: &[Line], place: usize, at: usize, letter: char) -> (String, Done) {
    let (_, key, value) = &lines[place];
    let mut name = (*key).to_owned();
    name.insert(at, letter);
    let text = text(lines).replacen(&format!("{key} = {value}"), &format!("{name} = 1"), 1);
    (text, Done::Key(name))
}

fn file(number: u32) -> (String, Done) {
    let mut random = Pcg64::new(number.into(), STREAM);
    let mut lines = lines(&mut random);
    let mut below = |end: usize| random.random_range(0..end);
    let kind = below(10);
    let place = below(lines.len());
    let key = lines[place].1;
    let single = |lines: &[Line]| !lines[place].2.starts_with('[');
    let done = match kind {
        0 | 1 => Done::Nothing,
        2..=5 if single(&lines) => {
            let value = spoiled(&lines[place].2, below(16));
            lines[place].2.clone_from(&value);
            Done::Number(key, value)
        }
        6 => {
            lines[place].2 = TYPES[below(TYPES.len())].into();
            Done::Type(key)
        }
        7 => {
            let at = below(key.len());
            return renamed(&lines, place, at, ['x', '_', 'q'][below(3)]);
        }
        8 => {
            let needed = NEEDED[below(NEEDED.len())];
            lines.retain(|line| line.1 != needed);
            Done::Missing(needed)
        }
        9 if below(2) == 0 => {
            lines.push(lines[place].clone());
            Done::Twice(key)
        }
        _ => {
            let mut text = text(&lines);
            for _ in 0..=below(3) {
                text.remove(below(text.len()));
            }
            if below(2) == 0 {
                text.truncate(below(text.len()));
            }
            return (text, Done::Torn);
        }
    };
    (text(&lines), done)
}

/// What is wrong with the answer to a file; none where it is as it should be.
fn wrong(text: &str, done: &Done) -> Option<String> {
    let Ok(answer) = catch_unwind(AssertUnwindSafe(|| read(text, "made"))) else {
        return Some("panic".into());
    };
    match (done, answer) {
        (Done::Nothing, Err(message)) => Some(format!("refused: {message}")),
        (Done::Nothing | Done::Number(..) | Done::Torn, Ok(design)) => unsound(&design),
        (Done::Number(key, value), Err(message)) => {
            // As the file has it, or as f32 shows it; two keys that contradict each other are both named.
            let shown = value
                .parse::<f32>()
                .map_or(String::new(), |value| value.to_string());
            let named = message.contains(key)
                && (message.contains(&**value) || message.contains(&shown) || shown == "0");
            (!named)
                .then(|| format!("names neither {key} nor {value}: {message}"))
                .or_else(|| {
                    let range = [
                        "allowed",
                        "at least",
                        "missing",
                        "is not within",
                        "expected",
                    ];
                    let ranged = range.iter().any(|word| message.contains(word));
                    (!ranged).then(|| format!("no range: {message}"))
                })
        }
        (Done::Type(_) | Done::Key(_) | Done::Missing(_) | Done::Twice(_), Ok(_)) => {
            Some("accepted".into())
        }
        (Done::Type(key) | Done::Missing(key) | Done::Twice(key), Err(message)) => {
            (!message.contains(key)).then(|| format!("does not name {key}: {message}"))
        }
        (Done::Key(name), Err(message)) => {
            (!message.contains(&**name)).then(|| format!("does not name {name}: {message}"))
        }
        (Done::Torn, Err(message)) => message.is_empty().then(|| "no word".into()),
    }
}

fn unsound(design: &Design) -> Option<String> {
    let caged = design.check().map_err(|error| error.to_string());
    let asked = design.fold.says_axial_load() || design.fold.says_deviations();
    let folded = if asked {
        design.fold.check(design)
    } else {
        Ok(())
    };
    caged
        .and(folded)
        .err()
        .map(|message| format!("taken: {message}"))
}

/// No file panics, none is taken with a number out of range, and an error names field, value and range.
#[test]
fn a_thousand_files_are_taken_or_refused_with_a_word() {
    let mut found = Vec::new();
    let mut taken = 0;
    for number in 0..FILES {
        let (text, done) = file(number);
        taken += u32::from(read(&text, "made").is_ok());
        if let Some(message) = wrong(&text, &done) {
            found.push(format!("{number}, {done:?}: {message}"));
        }
    }
    assert!(
        found.is_empty(),
        "{} of {FILES}\n{}",
        found.len(),
        found.join("\n")
    );
    // A generator that makes only good or only bad files shows nothing.
    assert!((FILES / 5..4 * FILES / 5).contains(&taken), "{taken} taken");
}

/// What is taken is folded with a certificate within 3 %, or refused with a word: the first few, because each takes seconds.
#[test]
fn what_is_taken_is_folded_or_refused() {
    const FOLDED: usize = 5;
    const KEYS: [&str; 4] = ["contact_angle", "conformity", "lead", "clearance"];
    let taken = (0..FILES).filter_map(|number| {
        let (text, done) = file(number);
        let Done::Number(key, _) = done else {
            return None;
        };
        let design = KEYS.contains(&key).then(|| read(&text, "made").ok())??;
        Some((number, design))
    });
    let mut folded = 0;
    for (number, design) in taken.take(FOLDED) {
        let mut fold = design.fold.fold(&design).unwrap();
        fold.friction = None;
        match fold.folded() {
            Ok(made) => {
                let [torque] = &made.certificate.figures;
                assert!(torque.largest <= 0.03, "{number}: {}", torque.largest);
                folded += 1;
            }
            Err(failure) => assert!(!failure.to_string().is_empty(), "{number}"),
        }
    }
    assert!(folded > 0);
}
