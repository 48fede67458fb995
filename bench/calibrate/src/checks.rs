//! Whether a trace may be believed, and what it cannot tell.
//!
//! What would make every number wrong is refused with a word. What only limits what can be told is a finding.
//!
//! | module | what |
//! |---|---|
//! | [`excitation`] | what a trace excites |
//! | [`relation`] | how effort and motion go together, roughly |
//! | [`finding`] | what a trace does not tell |

pub mod excitation;
pub mod finding;
pub mod relation;
#[cfg(test)]
mod tests;

use std::ops::Range;

use epas_page::failure::Failure;

use crate::checks::finding::{Finding, FindingKind};
use crate::checks::relation::{
    Against, Relation, Sliding, relation, root_mean_square, shift, speeds,
};
use crate::signals::Motion;
use crate::trace::channels::range;
use crate::trace::clipped::clipped;
use crate::trace::rests::{moving, rests, still};
use crate::trace::{Coordinate, Trace};

/// Fastest that a nut turns, rad/s (95,000 turns a minute), and that a carriage travels, m/s.
const FASTEST: [f64; 2] = [1e4, 50.0];
/// Largest share of samples at the effort's limit.
const CLIPPED: f64 = 0.05;
/// Certainty, in standard deviations, from which a sign is believed: far beyond chance, because the relation itself is rough.
const CERTAIN: f64 = 6.0;
/// A shifted clock is refused from this many ticks and this much less left with the shift, and said from the others. The
/// relation is rough: pre-sliding alone shifts the effort of the smallest motions by three ticks of 1 ms, but leaves hardly
/// less (measured: 1.04).
const SHIFT_REFUSED: [f64; 2] = [3.0, 1.3];
const SHIFT_SAID: [f64; 2] = [2.0, 1.1];
/// A shift that would not show within so many ticks is said.
const SHIFT_SEEN: f64 = 5.0;
/// Largest shift that is sought, s, and in ticks.
const SHIFT_SOUGHT: (f64, f64) = (0.03, 100.0);
/// A measured speed may differ from the position's derivative by this share.
const SPEED_AGREES: f64 = 0.05;

/// What limits what the trace can tell.
///
/// # Errors
/// A trace from which any number would be wrong.
pub fn examine(trace: &Trace, motion: &Motion) -> Result<Vec<Finding>, Failure> {
    look(trace, motion).map_err(Failure::Data)
}

fn look(trace: &Trace, motion: &Motion) -> Result<Vec<Finding>, String> {
    finite(trace)?;
    moves(trace, motion)?;
    let mut findings = told_by_reader(trace);
    let rests = rests(trace);
    let still = still(trace);
    excitation::stands_still(trace, &still, &mut findings)?;
    effort_lives(trace, &still, &mut findings)?;
    measured_speed(trace, motion, &mut findings)?;
    if let Some(relation) = relation(trace, motion) {
        exchanged(trace, &relation)?;
        signs(trace, motion, &relation)?;
        if relation.sliding.is_none() {
            findings.push(Finding::new(
                FindingKind::SignUnchecked,
                0.0,
                "the motion turns round before it slides for long: signs and clocks of effort and motion are not checked",
            ));
        }
        unexplained(trace, motion, &relation, &mut findings)?;
    }
    clocks(trace, motion, &mut findings)?;
    excitation::add(trace, motion, &rests, &mut findings)?;
    Ok(findings)
}

/// Whether the effort of the load is what the lead makes of it, on a trace whose load is worth it: `travel` is the
/// carriage's travel of a unit of the coordinate, m/rad or 1. Where nobody said a ratio of the motor's gear, the effort must be
/// that of a nut without one.
///
/// # Errors
/// A load in a wrong unit or of a wrong sign; a ratio that was forgotten.
pub fn load_gain(
    trace: &Trace,
    motion: &Motion,
    travel: f64,
    ratio_unsaid: bool,
) -> Result<(), Failure> {
    /// A friction that is not understood yet changes the gain by less.
    const WITHIN: f64 = 3.0;
    /// Load cells, leads and losses of a screw that is worth a calibration are known to less: the least ratios of gears are larger.
    const WITHOUT_GEAR: f64 = 1.4;
    /// Between a motor and a nut there is a belt, or one stage of a gear.
    const LARGEST_GEAR: f64 = 30.0;
    let Some(relation) = relation(trace, motion).filter(|r| r.gain_certainty.abs() > CERTAIN)
    else {
        return Ok(());
    };
    let gain = relation.gain / travel;
    let said =
        format!("a newton of axial load takes {gain:.3} of the effort that the lead makes of it");
    let factor = gain.max(1.0 / gain);
    if ratio_unsaid && gain > 0.0 && factor > WITHOUT_GEAR && factor < LARGEST_GEAR {
        return Err(Failure::Data(format!(
            "{said}: are torque and position the motor's, behind a gear? --ratio says its turns in a turn of the nut, as --ratio {:.2} (--ratio 1 says that there is none); else the load, the effort or the lead is in a wrong unit",
            1.0 / gain
        )));
    }
    if gain > 1.0 / WITHIN && gain < WITHIN {
        return Ok(());
    }
    let thousand = gain / 1e3;
    let unit = if thousand > 1.0 / WITHIN && thousand < WITHIN {
        "; is the load in kN or the torque in mN m? Then their columns are named axial_load [kN], motor_torque [mNm]"
    } else {
        ""
    };
    Err(Failure::Data(format!(
        "{said}: the load, the effort or the lead is in a wrong unit{unit}"
    )))
}

fn finite(trace: &Trace) -> Result<(), String> {
    let channels = [
        ("position", Some(&trace.position)),
        ("speed", trace.speed.as_ref()),
        ("effort", Some(&trace.effort)),
        ("reference position", trace.reference_position.as_ref()),
        ("load", trace.load.as_ref()),
        (
            "known effort",
            trace.known.as_ref().map(|known| &known.values),
        ),
        ("temperature", trace.temperature.as_ref()),
    ];
    for (name, channel) in channels {
        let Some(channel) = channel else {
            continue;
        };
        if channel.len() != trace.len() {
            return Err(format!(
                "the {name} has {} samples where the effort has {}",
                channel.len(),
                trace.len()
            ));
        }
        if let Some(sample) = channel.iter().position(|x| !x.is_finite()) {
            return Err(format!(
                "the {name} is not finite at {:.4} s (sample {sample})",
                trace.start + trace.step * sample as f64
            ));
        }
    }
    Ok(())
}

/// The trace moves, and not faster than anything does.
fn moves(trace: &Trace, motion: &Motion) -> Result<(), String> {
    let (low, high) = range(&trace.position);
    // Between two steps of the sensor nothing is known.
    if !(high - low > 3.0 * trace.resolution) {
        return Err(format!(
            "the position never moves by more than {:.3e}: no friction shows",
            high - low
        ));
    }
    let (fastest, unit, hint) = match trace.coordinate {
        Coordinate::Rotation => (FASTEST[0], "rad/s", "position_deg, speed_rpm"),
        Coordinate::Translation => (FASTEST[1], "m/s", "position_mm, speed_mm_s"),
    };
    let (low, high) = range(&motion.speed);
    let top = high.max(-low);
    if top > fastest {
        return Err(format!(
            "the speed reaches {top:.4} {unit}: a column that is not in SI units says so in its name ({hint}){OTHER_NAMES}"
        ));
    }
    Ok(())
}

fn told_by_reader(trace: &Trace) -> Vec<Finding> {
    let mut findings = Vec::new();
    let repairs = &trace.repairs;
    let repaired = repairs.missing + repairs.jittered + repairs.repeated;
    if repaired > 0 {
        findings.push(Finding::new(
            FindingKind::Repaired,
            repaired as f64,
            format!(
                "{} missing samples and {} beside their tick were interpolated, {} that stood twice were dropped",
                repairs.missing, repairs.jittered, repairs.repeated
            ),
        ));
    }
    if repairs.free_running > 0 {
        findings.push(Finding::new(
            FindingKind::Repaired,
            repairs.free_running as f64,
            format!(
                "the samples have no even tick, as of a logger that runs free: all {} of them were interpolated at their own times to ticks of {:.4} ms",
                repairs.free_running,
                1e3 * trace.step
            ),
        ));
    }
    for left_out in &repairs.left_out {
        let count = left_out.count() as f64;
        findings.push(Finding::new(FindingKind::LeftOut, count, left_out.told()));
    }
    for note in &repairs.notes {
        findings.push(Finding::new(FindingKind::Repaired, 1.0, note));
    }
    if !trace.ignored.is_empty() {
        findings.push(Finding::new(
            FindingKind::IgnoredColumns,
            trace.ignored.len() as f64,
            format!("columns left aside: {}", trace.ignored.join(", ")),
        ));
    }
    findings
}

/// The effort changes, and is not cut off.
fn effort_lives(
    trace: &Trace,
    still: &[Range<usize>],
    findings: &mut Vec<Finding>,
) -> Result<(), String> {
    let effort = moving(&trace.effort, still);
    let (low, high) = range(&effort);
    if !(high > low) {
        return Err(format!(
            "the effort is {low} at every sample: a dead channel"
        ));
    }
    let clipped: usize = clipped(&trace.effort, still).iter().map(Range::len).sum();
    let share = clipped as f64 / effort.len() as f64;
    if share > CLIPPED {
        return Err(format!(
            "{:.0} % of the effort stands at its limits of {low:.4} and {high:.4}: it is clipped; widen the range, or cut those parts out",
            100.0 * share
        ));
    }
    if share > 0.0 {
        findings.push(Finding::new(
            FindingKind::ClippedEffort,
            share,
            format!(
                "{:.1} % of the effort stands at its limits of {low:.4} and {high:.4}, as if clipped: left out",
                100.0 * share
            ),
        ));
    }
    Ok(())
}

/// Ticks that a shift is sought within.
fn sought(trace: &Trace) -> usize {
    (SHIFT_SOUGHT.0 / trace.step).min(SHIFT_SOUGHT.1) as usize
}

/// A speed that was measured beside the position is its derivative.
fn measured_speed(
    trace: &Trace,
    motion: &Motion,
    findings: &mut Vec<Finding>,
) -> Result<(), String> {
    let Some(measured) = trace.speed.as_ref().filter(|_| !trace.position_summed) else {
        return Ok(());
    };
    if !(root_mean_square(&motion.speed) > 5.0 * motion.noise[0]) {
        return Ok(());
    }
    let (low, high) = range(measured);
    if !(high > low) {
        findings.push(Finding::new(
            FindingKind::DeadChannel,
            low,
            format!("the measured speed is {low} at every sample, and is not used"),
        ));
        return Ok(());
    }
    let Some(found) = speeds(measured, motion, sought(trace)) else {
        return Ok(());
    };
    if found.correlation.abs() < 0.9 {
        return Err(format!(
            "the measured speed is not the derivative of the position (correlation {:.2}): other parts, or shifted clocks",
            found.correlation
        ));
    }
    // A speed that is filtered is a little smaller; what is late by design is not wrong.
    if (found.factor - 1.0).abs() > SPEED_AGREES {
        return Err(format!(
            "the measured speed is {:.4} times the derivative of the position: one of them has a wrong unit or sign",
            found.factor
        ));
    }
    if found.ticks.abs() >= SHIFT_SAID[0] {
        findings.push(Finding::new(
            FindingKind::ShiftedSpeed,
            found.ticks,
            format!(
                "the measured speed is {:.0} ticks {} than the position; the position alone is used",
                found.ticks.abs(),
                if found.ticks > 0.0 { "later" } else { "earlier" }
            ),
        ));
    }
    Ok(())
}

/// A newton of load takes less torque than a lead of 0.2 m makes of it; of columns that are exchanged it takes the inverse of a lead's.
fn exchanged(trace: &Trace, relation: &Relation) -> Result<(), String> {
    /// A lead of 6 m in a wrong unit of force, N m/N.
    const MOST: f64 = 30.0;
    let rotates = trace.coordinate == Coordinate::Rotation;
    let told = trace.load.is_some() && relation.gain_certainty.abs() > CERTAIN;
    if rotates && told && relation.gain.abs() > MOST {
        return Err(format!(
            "a newton of axial load takes {:.0} N m of torque: the names of motor_torque and axial_load are exchanged; compare the first line with the columns",
            relation.gain.abs()
        ));
    }
    Ok(())
}

/// What else a wrong sign may come from.
const OTHER_NAMES: &str = "; or the names of two columns are exchanged";

/// Friction takes power out of a motion, and inertia and load are positive.
fn signs(trace: &Trace, motion: &Motion, relation: &Relation) -> Result<(), String> {
    if !excitation::both_ways(motion) {
        return Ok(());
    }
    let resists = relation
        .sliding
        .is_none_or(|sliding| sliding.power > -CERTAIN);
    if trace.load.is_some() && relation.gain_certainty < -CERTAIN && resists {
        return Err(format!(
            "the effort falls as the load rises: turn the sign of the load, which is positive where it opposes a positive motion (of a left-hand thread, a positive turn travels the other way: turn the sign of the load, or of position and torque both){OTHER_NAMES}"
        ));
    }
    if !resists {
        return Err(format!(
            "the effort that goes with the speed's sign drives the motion instead of resisting it: turn the sign of the effort or of the position{OTHER_NAMES}"
        ));
    }
    let falls = |sliding: Sliding| sliding.inertia < -CERTAIN && sliding.left < 0.3;
    if relation.sliding.is_some_and(falls) {
        return Err(format!(
            "the effort falls as the acceleration rises: turn the sign of the effort or of the position{OTHER_NAMES}"
        ));
    }
    Ok(())
}

/// Most of the effort comes from something that is not in the trace.
fn unexplained(
    trace: &Trace,
    motion: &Motion,
    relation: &Relation,
    findings: &mut Vec<Finding>,
) -> Result<(), String> {
    /// Pre-sliding, load shares and ripple leave less than this.
    const SAID: f64 = 0.6;
    /// Without a load, and with motions that are no pre-sliding (twenty breakaway travels and more), nothing is left to fit.
    const REFUSED: f64 = 0.9;
    const BEYOND_PRESLIDING: [f64; 2] = [0.1, 1e-3];
    let beyond = match trace.coordinate {
        Coordinate::Rotation => BEYOND_PRESLIDING[0],
        Coordinate::Translation => BEYOND_PRESLIDING[1],
    };
    let (low, high) = range(&trace.position);
    let moves = high - low > beyond && excitation::both_ways(motion);
    if trace.load.is_none() && relation.left > REFUSED && moves {
        return Err(format!(
            "{:.0} % of the effort goes with neither acceleration nor speed: a load acts that the trace does not hold; add a column axial_load",
            100.0 * relation.left
        ));
    }
    if relation.left > SAID {
        let cause = if trace.load.is_some() {
            "a channel is wrong, or a part moves that is not in the model"
        } else {
            "a load acts that the trace does not hold"
        };
        findings.push(Finding::new(
            FindingKind::Unexplained,
            relation.left,
            format!(
                "{:.0} % of the effort goes with neither acceleration nor speed nor load: {cause}",
                100.0 * relation.left
            ),
        ));
    }
    Ok(())
}

/// All channels have one clock.
fn clocks(trace: &Trace, motion: &Motion, findings: &mut Vec<Finding>) -> Result<(), String> {
    if !excitation::both_ways(motion) {
        return Ok(());
    }
    for (against, other) in [(Against::Motion, "motion"), (Against::Load, "load")] {
        if against == Against::Load && trace.load.is_none() {
            continue;
        }
        let Some(found) = shift(trace, motion, against, sought(trace)) else {
            continue;
        };
        let way = if found.ticks > 0.0 {
            "later"
        } else {
            "earlier"
        };
        let ticks = found.ticks.abs();
        if against == Against::Motion && found.seen > SHIFT_SEEN {
            findings.push(Finding::new(
                FindingKind::ClockUnchecked,
                found.seen,
                format!(
                    "a shift of {SHIFT_SEEN} ticks between effort and motion would hardly show in this trace, and would go into the drag: move faster, or check the clocks"
                ),
            ));
        }
        if ticks >= SHIFT_REFUSED[0] && found.gain >= SHIFT_REFUSED[1] {
            return Err(format!(
                "the effort comes {ticks:.0} ticks ({:.1} ms) {way} than the {other}: shift the channels to one clock",
                1e3 * ticks * trace.step
            ));
        }
        if found.seen.is_finite() && ticks >= SHIFT_SAID[0] && found.gain >= SHIFT_SAID[1] {
            findings.push(Finding::new(
                FindingKind::ShiftedEffort,
                found.ticks,
                format!("the effort seems to come {ticks:.0} ticks {way} than the {other}"),
            ));
        }
    }
    Ok(())
}
