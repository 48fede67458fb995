//! Which tables loads need, in sentences.

use epas_reference::statics::{Served, ShareError, ShareTable, ShareTables};

use super::table::{Tables, Wording};
use epas_design::files::loads::LoadCase;

/// Loads of a ball that tables are tried for, N: what the scenes' errors are stated for.
pub const BALL_LOADS: [f64; 2] = [5.0, 300.0];

/// What a table may be off where it serves.
const TOLERANCE: ShareError = ShareError::TOLERANCE;

pub struct Answer {
    pub said: Vec<String>,
    pub tables: Tables,
}

impl Answer {
    pub fn one(case: &LoadCase, said: Vec<String>, table: ShareTable) -> Self {
        Self {
            said,
            tables: Tables::One(Wording {
                load: table.axial_load.to_string(),
                loaded_end: case.case.loaded_end,
                table,
            }),
        }
    }
}

fn wording(case: &LoadCase, table: ShareTable) -> Wording {
    Wording {
        load: newtons(table.axial_load),
        loaded_end: case.case.loaded_end,
        table,
    }
}

/// The loads that the table of one load serves, of those of its sign and of the other one.
pub fn range_of(
    table: &ShareTable,
    alike: &[ShareTable],
    opposite: &[ShareTable],
) -> Result<Vec<String>, String> {
    let own = table.error_at(table).map_err(text)?;
    if !own.is_within(&TOLERANCE) {
        return Ok(vec![
            "No table serves this load: even under it, this one errs by".into(),
            format!("{}.", of(&own)),
            NO_TABLE.into(),
        ]);
    }
    let load = table.axial_load;
    let range = |loads: &[ShareTable]| table.range(loads, load.abs(), &TOLERANCE).map_err(text);
    let [from, to] = range(alike)?.unwrap_or([load, load]);
    Ok(vec![
        format!("It serves loads of {}", between(from, to)),
        match range(opposite)? {
            Some([from, to]) => format!("and, the other way, of {}", between(from, to)),
            None => "but none as large the other way, which takes a table of its own,".into(),
        },
        format!("within {}.", of(&TOLERANCE)),
    ])
}

/// The tables of all these loads: positive ones and negative ones, each in the order of their size.
pub fn answer(
    case: &LoadCase,
    name: &str,
    positive: &[ShareTable],
    negative: &[ShareTable],
) -> Result<Answer, String> {
    let all = [positive, negative].concat();
    let mut said = heading(case, name, positive, negative);
    let alone = best_alone(&all)?;
    let own = unit(alone.table.axial_load);
    let tables = if alone.serves(&TOLERANCE) {
        said.push(format!(
            "One table serves them all: the one computed at {own} is off by up to"
        ));
        said.push(format!("{}.", of(&alone.worst)));
        Tables::One(wording(case, alone.table))
    } else if positive.is_empty() || negative.is_empty() {
        Tables::One(wording(case, of_one_sign(&mut said, &all)?))
    } else {
        said.push(format!(
            "One table does not serve them all: the one computed at {own} is off by up to"
        ));
        said.push(format!(
            "{}, furthest at {}. So each sign has its own.",
            of(&alone.worst),
            unit(alone.worst_at)
        ));
        let positive = of_one_sign(&mut said, positive)?;
        let negative = of_one_sign(&mut said, negative)?;
        Tables::Two(wording(case, positive), wording(case, negative))
    };
    Ok(Answer { said, tables })
}

fn heading(
    case: &LoadCase,
    name: &str,
    positive: &[ShareTable],
    negative: &[ShareTable],
) -> Vec<String> {
    let ranges: Vec<String> = [positive, negative]
        .iter()
        .filter_map(|loads| {
            let [first, last] = [loads.first()?, loads.last()?];
            Some(between(first.axial_load, last.axial_load))
        })
        .collect();
    let mut said = vec![format!("Loads of {name}: {}.", ranges.join(" and "))];
    let largest = [positive, negative]
        .iter()
        .filter_map(|loads| loads.last())
        .fold(0.0, |most: f64, load| most.max(load.axial_load.abs()));
    let of_a_ball = largest / case.case.balls as f64;
    if of_a_ball > BALL_LOADS[1] {
        said.push(format!(
            "The largest is {of_a_ball:.0} N a ball; errors of the scenes are stated up to {} N a ball.",
            BALL_LOADS[1]
        ));
    }
    said
}

fn best_alone(loads: &[ShareTable]) -> Result<Served, String> {
    Served::best_alone(loads, &TOLERANCE)
        .map_err(text)?
        .ok_or_else(|| "no load along the axis".into())
}

fn of_one_sign(said: &mut Vec<String>, loads: &[ShareTable]) -> Result<ShareTable, String> {
    let alone = best_alone(loads)?;
    let range = between(alone.from, alone.to);
    let own = unit(alone.table.axial_load);
    if alone.serves(&TOLERANCE) {
        said.push(format!(
            "{range}: one table serves. The one computed at {own} is off by up to"
        ));
        said.push(format!("{}.", of(&alone.worst)));
        return Ok(alone.table);
    }
    said.push(format!(
        "{range}: one table does not serve. The one computed at {own} stands here; it is off by up to"
    ));
    said.push(format!(
        "{}, furthest at {};",
        of(&alone.worst),
        unit(alone.worst_at)
    ));
    said.push(format!(
        "against what the largest of these loads makes, by {}.",
        of(&alone.of_largest)
    ));
    let ShareTables { served, unserved } = ShareTables::fewest(loads, &TOLERANCE).map_err(text)?;
    if !served.is_empty() {
        said.push(format!(
            "It takes {}, each of which --axial-load writes, to stay within",
            count(served.len(), "table")
        ));
        said.push(format!("{}:", of(&TOLERANCE)));
    }
    // Where each load that was tried takes its own table, one line says so for all of them.
    let single = |served: &Served| served.from == served.to;
    for group in served.chunk_by(|one, other| single(one) && single(other)) {
        said.push(match group {
            [one] => format!(
                "  {}: that of {}",
                between(one.from, one.to),
                unit(one.table.axial_load)
            ),
            group => format!(
                "  {}: another one for each tenth more load",
                between(group[0].from, group[group.len() - 1].to)
            ),
        });
    }
    if let [first, .., last] | [first @ last] = unserved.as_slice() {
        said.push(format!("  {}: none. {NO_TABLE}", between(*first, *last)));
    }
    Ok(alone.table)
}

const NO_TABLE: &str = "Grooves press on the balls without any load, and some push against it.";

fn of(error: &ShareError) -> String {
    format!(
        "{} % of the grooves' friction and {} % of the largest ball load",
        percent(error.groove_torque.abs()),
        percent(error.ball_load)
    )
}

fn count(number: usize, name: &str) -> String {
    if number == 1 {
        format!("one {name}")
    } else {
        format!("{number} {name}s")
    }
}

fn percent(part: f64) -> f64 {
    (1e3 * part).round() / 10.0
}

/// A range of loads; one load where both are the same.
fn between(from: f64, to: f64) -> String {
    if from == to {
        unit(from)
    } else {
        format!("{} to {} N", newtons(from), newtons(to))
    }
}

fn unit(load: f64) -> String {
    format!("{} N", newtons(load))
}

fn newtons(load: f64) -> String {
    let above_one = load.abs().max(1e-6).log10().floor() as i32;
    let digits = usize::try_from(2 - above_one).unwrap_or(0);
    format!("{load:.digits$}")
}

pub fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}
