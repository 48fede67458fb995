//! Which losses in proportion to the load a trace without a design tells.
//!
//! Driving takes `gain (1 + driving loss)` of the load, back-driving `gain (1 - back-driving loss)`. A load in the effort's own unit
//! (`load_torque` beside a torque, `axial_load` beside a force) has a gain of 1, and both losses are told. An axial load beside a torque has
//! a gain that only a design knows: then gain and one loss for both directions are told.

use crate::fit::uncertainty::Uncertainty;
use crate::page::shown::digits;
use crate::signals::Motion;
use crate::trace::Trace;
use crate::trace::channels::range;
use crate::without_design::closed_loop::size;
use crate::without_design::slide::{GAIN, LOSS, LOSSES};
use crate::without_design::terms::LoadTerm;

/// Share of the moving time in which power has to flow in a direction for its loss to be told: as of the directions of motion.
const RARER: f64 = 0.01;
/// Share of the root mean square below which a speed rests, or a load is none.
const LITTLE: f64 = 0.1;
/// Half of an interval, over the load's effort, from which on a loss is not told: efficiencies of drives lie within it.
const TOO_WIDE: f64 = 0.25;

/// What may be told of the losses, by where power flows; and what may not.
pub fn possible(trace: &Trace, motion: &Motion) -> (LoadTerm, Vec<String>) {
    let Some(load) = &trace.load else {
        return (LoadTerm::None, Vec::new());
    };
    let given = if trace.load_is_effort {
        LoadTerm::GIVEN
    } else {
        LoadTerm::Gain
    };
    let (low, high) = range(load);
    if low == high {
        let term = if trace.load_is_effort {
            given
        } else {
            LoadTerm::None
        };
        let sentence = format!(
            "losses in proportion to the load: the load stays at {}, and its loss is one number with the Coulomb friction; measure at two loads or more",
            digits(low, 3)
        );
        return (term, vec![sentence]);
    }
    let [driving, back_driving] = flows(load, &motion.speed).map(|share| share > RARER);
    let mut untold = Vec::new();
    for (told, name, does) in [
        (driving, "driving", "the motor never drives the load"),
        (
            back_driving,
            "back-driving",
            "the load never drives the motor",
        ),
    ] {
        if !told {
            untold.push(format!(
                "loss of {name}: {does} in this trace; move against the load and with it"
            ));
        }
    }
    let term = match (trace.load_is_effort, driving, back_driving) {
        (true, ..) => LoadTerm::Losses {
            driving,
            back_driving,
        },
        (false, true, true) => LoadTerm::LossAlike,
        (false, ..) => LoadTerm::Gain,
    };
    (term, untold)
}

/// Shares of the moving time in which the motor drives the load, and the load the motor.
fn flows(load: &[f64], speed: &[f64]) -> [f64; 2] {
    let [slow, light] = [size(speed), size(load)].map(|size| LITTLE * size);
    let moving = speed.iter().filter(|speed| speed.abs() > slow).count();
    let both = load.iter().zip(speed);
    let loaded = both.filter(|(load, speed)| speed.abs() > slow && load.abs() > light);
    let (mut driving, mut back_driving) = (0_usize, 0_usize);
    for (load, speed) in loaded {
        if load * speed > 0.0 {
            driving += 1;
        } else {
            back_driving += 1;
        }
    }
    [driving, back_driving].map(|count| count as f64 / moving.max(1) as f64)
}

/// What a fit with these losses tells: the same, or none of them where an interval is too wide to say anything. One that is left out
/// alone would bias the other.
pub fn told(term: LoadTerm, sure: &Uncertainty) -> (LoadTerm, Vec<String>) {
    let interval = |name: &str| sure.intervals.iter().find(|interval| interval.name == name);
    let gain = interval(GAIN).map_or(1.0, |gain| gain.value.abs());
    let wide = LOSSES
        .into_iter()
        .chain([LOSS])
        .filter_map(interval)
        // No number is none.
        .find(|loss| !(loss.half_width <= TOO_WIDE * gain));
    match wide {
        Some(loss) => (
            term.without_losses(),
            vec![format!(
                "losses in proportion to the load: the {} would be {} +- {} of the load, which says nothing; vary the load's size, and move both against it and with it",
                loss.name.replace('_', " "),
                digits(loss.value / gain, 2),
                digits(loss.half_width / gain, 2)
            )],
        ),
        None => (term, Vec::new()),
    }
}

/// What is said of a loss that is taken to be the same for both directions of power.
pub fn alike(term: LoadTerm, sure: &Uncertainty) -> Option<String> {
    let value = |name: &str| {
        let mut intervals = sure.intervals.iter();
        let found = intervals.find(|interval| interval.name == name);
        found.map(|interval| interval.value)
    };
    let (gain, loss) = value(GAIN).zip(value(LOSS))?;
    (term == LoadTerm::LossAlike).then(|| {
        format!(
            "how the losses of driving and back-driving differ: the lead is not known, and with it neither is the load's own torque; as one number the loss is {} % of it; give the load as load_torque, or the screw's design",
            digits(100.0 * loss / gain, 3)
        )
    })
}

#[cfg(test)]
mod tests;
