//! How many tables of load shares a screw takes, and what one table errs by.

use epas_reference::ReferenceError;
use epas_reference::statics::shares::loads_between;
use epas_reference::statics::{Served, ShareError, ShareTable, ShareTables};

use epas_bench::report::draw;
use epas_design::files::loads::{LoadCase, built_in};
use epas_page::document::{Cell, Table};

const TOLERANCE: ShareError = ShareError::TOLERANCE;

const BALL_LOADS: [f64; 2] = [5.0, 300.0];

fn tables(case: &LoadCase, sign: f64) -> Result<Vec<ShareTable>, ReferenceError> {
    let balls = case.case.balls as f64;
    let [least, most] = BALL_LOADS.map(|of_a_ball| sign * of_a_ball * balls);
    let loads = loads_between(least, most)?;
    ShareTable::of_loads(&loads, |load| case.under(load).load()?.solve())
}

/// How many tables serve, and the load of a ball, N, up to which none does.
fn needed(loads: &[ShareTable]) -> Result<[Cell; 2], ReferenceError> {
    let ShareTables { served, unserved } = ShareTables::fewest(loads, &TOLERANCE)?;
    let none = unserved.last().map_or_else(
        || Cell::from("-"),
        |load| {
            let balls = loads[0].shares.len() as f64;
            Cell::fixed(load.abs() / balls, 1)
        },
    );
    Ok([Cell::fixed(served.len() as f64, 0), none])
}

/// The table of three screws, without and with errors.
pub fn table() -> Result<Table, ReferenceError> {
    let mut rows = Vec::new();
    for (name, balls) in [("lin-2.1", 32), ("lin-3.6", 37), ("lin-4.1", 71)] {
        for (error, pitch_error, roundness_error) in [
            ("none", 0.0, 0.0),
            ("pitch 5 µm", 5e-6, 0.0),
            ("roundness 5 µm", 0.0, 5e-6),
        ] {
            let case = built_in(name, balls)
                .ok_or_else(|| ReferenceError::input("design", format!("{name} has no load case")))?
                .with_errors(pitch_error, roundness_error);
            let [push, pull] = [tables(&case, 1.0)?, tables(&case, -1.0)?];
            let [pushes, without_push] = needed(&push)?;
            let [pulls, without_pull] = needed(&pull)?;
            let alone = Served::best_alone(&[push, pull].concat(), &TOLERANCE)?
                .ok_or_else(|| ReferenceError::input("axial_load", "no load"))?;
            let percent = |part: f64| Cell::fixed(100.0 * part.abs(), 1);
            rows.push(vec![
                name.into(),
                error.into(),
                pushes,
                without_push,
                pulls,
                without_pull,
                percent(alone.worst.groove_torque),
                percent(alone.worst.ball_load),
                percent(alone.of_largest.groove_torque),
                percent(alone.of_largest.ball_load),
            ]);
        }
    }
    let columns = "screw | error of its groove | tables of a push | no table of a push up to (N a ball) | \
         tables of a pull | no table of a pull up to (N a ball) | one table: friction (%) | \
         one table: ball load (%) | of the largest friction (%) | of the largest ball load (%)";
    Ok(draw::table(
        "load_share_tables",
        "Tables of load shares from 5 to 300 N a ball, by push and pull: how many keep friction of the grooves within 1 % of \
         that with each load's own table and each ball's load within 5 % of the largest; up to which load none does, because \
         some balls push against it; and by how much the best single table for all loads errs, of the friction and largest ball \
         load under the same load and under the largest one",
        columns,
        rows,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What README says: of a screw without errors up to 0.3 % and 13 %, of one with errors up to 1.2 % and 10 % of what
    /// the largest load makes.
    #[test]
    fn figures_of_the_limits() {
        let table = table().unwrap();
        let number = |cell: &Cell| match cell {
            Cell::Number(value, _) => *value,
            Cell::Code(_) | Cell::Text(_) => f64::NAN,
        };
        assert_eq!(table.rows.len(), 9);
        for row in &table.rows {
            println!("{row:?}");
            let [.., friction, ball_load, of_friction, of_ball_load] = row.as_slice() else {
                panic!("{row:?}");
            };
            if matches!(&row[1], Cell::Text(error) if error == "none") {
                assert!(
                    number(friction) < 0.3 && number(ball_load) < 13.0,
                    "{row:?}"
                );
            }
            assert!(
                number(of_friction) < 1.2 && number(of_ball_load) < 10.0,
                "{row:?}"
            );
        }
    }
}
