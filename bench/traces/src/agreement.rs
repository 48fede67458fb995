//! Whether position and speed of one part agree: a turned sign and a unit that no heading names show in their ratio.

use crate::channels::{median, resolution, unwrap};
use crate::table::{Column, Table};
use crate::units::{Dimension, Part, Quantity, Unit, names, quantity};

/// Least travel of a stretch in steps of the position's sensor: rounding at both ends is at most one step, 5 % of the travel.
const STEPS: f64 = 20.0;
/// Travel of a stretch over the whole, so that the noise of the speed adds up to little.
const SHARE: f64 = 5e-3;
/// Longest travel of a stretch, rad (m): of an angle that starts again after a turn, most stretches have no jump.
const LONGEST: f64 = 0.8;
/// Slowest mean speed of a stretch over the root mean square: slower ones hold the speed's offset.
const MOVING: f64 = 0.1;
/// Fewest stretches whose median counts.
const FEWEST: usize = 8;
/// Travel of the position over that of the speed: rounding, delay of the speed, sums over ticks stay far within.
const AGREES: std::ops::RangeInclusive<f64> = 0.8..=1.25;
/// Distance of the ratio from that of a unit, over it.
const NEAR: f64 = 0.05;

/// Refuses a table whose position moves otherwise than its speed says: the friction would follow the one, and its energy the other.
pub fn check(table: &Table) -> Result<(), String> {
    for part in [Part::Nut, Part::Motor, Part::Carriage, Part::Plain] {
        let position = table.column(Quantity::Position(part));
        let speed = table.column(Quantity::Speed(part));
        let (Some(position), Some(speed)) = (position, speed) else {
            continue;
        };
        if part == Part::Plain && position.unit.dimension != speed.unit.dimension {
            continue;
        }
        let found = ratio(table, position, speed).filter(|ratio| !AGREES.contains(ratio));
        found.map_or(Ok(()), |ratio| Err(words(table, [position, speed], ratio)))?;
    }
    Ok(())
}

/// Median of the position's travel over the speed's, of stretches in which it moves; none of too few.
fn ratio(table: &Table, position: &Column, speed: &Column) -> Option<f64> {
    let mut places = position.values.clone();
    if position.unit.dimension != Dimension::Length {
        unwrap(&mut places).ok()?;
    }
    let duration = table.times.last()? - table.times.first()?;
    let ticks = table.times.windows(2).zip(speed.values.windows(2));
    let steps = ticks.map(|(times, speeds)| {
        let time = times[1] - times[0];
        (time, 0.5 * (speeds[0] + speeds[1]) * time)
    });
    let steps: Vec<(f64, f64)> = steps.collect();
    let all: f64 = steps.iter().map(|(_, travel)| travel.abs()).sum();
    let squares: f64 = steps.iter().map(|(time, step)| step * step / time).sum();
    let slowest = MOVING * (squares / duration).sqrt();
    let moves = places.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let moves: Vec<f64> = moves.filter(|moved| *moved > 0.0).collect();
    let moved: f64 = moves.iter().sum();
    let step = match resolution(&places) {
        // Too few places for that.
        0.0 if !moves.is_empty() => median(moves),
        step => step,
    };
    // In shares of the whole travel, whatever the unit of either is.
    let rounded = STEPS * step / moved;
    let travel = (SHARE * all).min(LONGEST).max(rounded * all);
    let (mut first, mut begin, mut sum) = (0, 0.0, 0.0);
    let (mut now, mut ratios) = (0.0, Vec::new());
    for (sample, (time, step)) in steps.iter().enumerate() {
        now += time;
        sum += step;
        if sum.abs() < travel {
            continue;
        }
        if sum.abs() > slowest * (now - begin) {
            ratios.push((places[sample + 1] - places[first]) / sum);
        }
        (first, begin, sum) = (sample + 1, now, 0.0);
    }
    (ratios.len() >= FEWEST).then(|| median(ratios))
}

fn words(table: &Table, [position, speed]: [&Column; 2], ratio: f64) -> String {
    let [place, rate] = [position, speed].map(|column| column.name.as_str());
    let units = |column: &Column| column.quantity.accepted().collect::<Vec<Unit>>();
    let near = |factor: f64| (ratio.abs() / factor - 1.0).abs() < NEAR;
    let of_position = units(position)
        .into_iter()
        .find(|unit| near(position.unit.factor / unit.factor));
    let of_speed = units(speed)
        .into_iter()
        .find(|unit| near(unit.factor / speed.unit.factor));
    let of_time = Quantity::Time.units().iter().find(|unit| near(unit.factor));
    let named = |column: &Column, unit: Unit| {
        let own = |name: &&str| quantity(name) == Some(column.quantity);
        let heading = names().find(own).unwrap_or_default();
        let (name, shown) = (&column.name, unit.shown());
        format!("is {name} in {shown}? Then its heading is {heading} [{shown}]")
    };
    let cause = match (of_position, of_speed, of_time) {
        _ if near(1.0) => format!("turn the sign of {place} or {rate}"),
        (Some(unit), ..) => named(position, unit),
        (_, Some(unit), _) => named(speed, unit),
        (.., Some(unit)) if !table.time_unit_said => {
            let shown = unit.shown();
            format!("is the time in {shown}? Then its heading is time [{shown}]")
        }
        _ => "a gear between them, another unit, or one that comes later? Mend one of them, or leave it out".into(),
    };
    let turned = if ratio < 0.0 && !near(1.0) {
        "; and turn the sign of one"
    } else {
        ""
    };
    format!(
        "columns {place} and {rate} contradict each other: the position moves {ratio:.3} times as far as the speed says; {cause}{turned}"
    )
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::fmt::Write as _;
    use std::io::Cursor;

    use super::*;
    use crate::table::{Request, read};

    /// The cause is that of the ratio, for an angle that starts again after a turn, behind an encoder of 12 bits and a filter of the speed; a
    /// trace that agrees passes, and one that hardly moves.
    #[test]
    fn a_position_that_contradicts_the_speed_is_refused_with_the_cause() {
        let of_text = |text: String| {
            let everything = Request {
                wants: &|_| true,
                rated_torque: None,
            };
            check(&read(Cursor::new(text), everything).unwrap())
        };
        let checked = |headings: &str, [time, position, speed]: [f64; 3], turn: f64| {
            let mut text = format!("{headings}\n");
            for sample in 0..4000 {
                let now = 1e-3 * f64::from(sample);
                let angle = 20.0 * (1.0 - (1.5 * now).cos());
                let step = TAU / 4096.0;
                let mut angle = (angle / step).round() * step * position;
                if turn > 0.0 {
                    angle = angle.rem_euclid(turn);
                }
                let noise = 0.2 * (1e3 * now * now).sin();
                let rate = speed * (30.0 * (1.5 * (now - 4e-3)).sin() + noise);
                writeln!(text, "{},{angle},{rate}", time * now).unwrap();
            }
            of_text(text)
        };
        let nut = "time,nut_position,nut_speed";
        let rpm = 30.0 / std::f64::consts::PI;
        let deg = 1f64.to_degrees();
        for turn in [0.0, TAU] {
            assert_eq!(checked(nut, [1.0; 3], turn), Ok(()));
        }
        // Without visible motion, and by a few steps of the encoder.
        assert_eq!(checked(nut, [1.0, 1e-3, 1e-3], 0.0), Ok(()));
        let mut few = format!("{nut}\n");
        for sample in 0..8000 {
            let now = 1e-3 * f64::from(sample);
            let place = (4.0 * (3.0 * now).sin()).round() * TAU / 512.0;
            let noise = 0.1 * (1e4 * now * now).sin();
            writeln!(few, "{now},{place:.6},{}", 0.15 * (3.0 * now).cos() + noise).unwrap();
        }
        assert_eq!(of_text(few), Ok(()));
        let motor = "time,nut_position,motor_speed";
        assert_eq!(checked(motor, [1.0, 1.0, 9.0], 0.0), Ok(()));
        let degrees = "time,nut_position_deg,nut_speed_rpm";
        assert_eq!(checked(degrees, [1.0, deg, rpm], 360.0), Ok(()));
        let refused = |headings, factors, turn, cause: &str| {
            let message = checked(headings, factors, turn).expect_err(cause);
            assert!(message.contains(cause), "{cause}: {message}");
        };
        refused(nut, [1.0, -1.0, 1.0], 0.0, "turn the sign of nut_position");
        refused(nut, [1.0, deg, 1.0], 0.0, "is nut_position in deg?");
        refused(nut, [1.0, deg, 1.0], 360.0, "nut_position [deg]");
        refused(nut, [1.0, -deg, 1.0], 0.0, "and turn the sign");
        refused(nut, [1.0, 1.0, rpm], 0.0, "nut_speed [rpm]");
        refused(nut, [1.0, 1.0, deg], TAU, "nut_speed [deg/s]");
        refused(nut, [1e3, 1.0, 1.0], 0.0, "time [ms]");
        refused(nut, [1.0, 1.0, 3.0], 0.0, "a gear between them");
        let wrong = "time,nut_position_deg,nut_speed";
        refused(wrong, [1.0; 3], 0.0, "nut_position_deg in rad?");
        let plain = "time,position_mm,speed_mm_s";
        refused(plain, [1.0, 1e3, 1.0], 0.0, "position_mm in um?");
    }
}
