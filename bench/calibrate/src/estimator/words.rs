//! What a trace has that the equation has not, or has wrongly: the likeliest cause with its evidence.
//!
//! In this order, because each earlier cause makes the later ones look true: numbers that ran over; exchanged columns; sign, unit and ratio
//! of the load; a turned sign; a load that follows the position; a ripple over the angle; a late channel; friction that differs by
//! direction or falls away from rest.

use std::f64::consts::{PI, TAU};

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::choice::{Estimate, Wanted, estimate};
use super::fit::{Block, dot, solver};
use super::record::Record;
use super::rows::Rows;
use super::terms::Term;
use crate::page::shown::digits;
use crate::trace::channels::{median, range, resolution};
use crate::trace::{Coordinate, Trace};
use epas_traces::units::{Quantity, heading};

/// Share of the effort that is left from which on nothing is explained, and from which on a fit is doubted.
pub const NOTHING: f64 = 0.9;
const DOUBTED: f64 = 0.5;

const BITS: [i32; 4] = [8, 10, 12, 16];

/// Largest travel of a drive over its angle, m/rad: a rack of a pinion of 0.4 m, a lead of 1.3 m.
const LONGEST: f64 = 0.2;

/// Bins of the position, share of the residual's variance, height over the median line, and periods in the stroke of a ripple.
const BINS: usize = 4096;
const SHARE: f64 = 0.2;
const HEIGHT: f64 = 30.0;
const PERIODS: f64 = 5.0;

/// Longest shift of a channel that is sought, s; from so many ticks and this much less left with it, a trace is refused, but not where effort and
/// motion are apart by less than this time and the fit tells it. A kernel of this half-width, s, shows a shift under noise.
const LATEST: f64 = 0.1;
const LATE: (isize, f64) = (3, 1.3);
const IN_THE_FIT: f64 = 0.02;
const LONG: f64 = 0.034;

/// Residual with a friction that differs by direction, or changes towards rest, over that without, below which it is named.
const TAKES: f64 = 0.97;

/// Terms that are tried beside those of the equation: each speed below, a zero error of the load, viscous friction that differs by direction.
const TRIED: u32 = STRIBECK.len() as u32 + 2;

/// Speeds over which friction changes towards rest, over one that a tenth of the rows exceed. A faster one is a drag that is not linear.
const STRIBECK: [f64; 3] = [0.02, 0.05, 0.12];

#[derive(Clone, Debug)]
pub struct Diagnosis {
    pub estimate: Estimate,
    pub words: Vec<String>,
    /// The ripple over the position, or the load that follows it: its wave number, 1/rad or 1/m.
    pub wave: Option<f64>,
}

/// What a record tells, and what is in it beside the equation.
pub fn diagnose(record: &Record, trace: &Trace) -> Result<Diagnosis, String> {
    let mut look = Look::at(record, trace);
    let Some(found) = look.screened()? else {
        return Err("no stretch of one direction is long enough to tell anything: move to and fro by more, or faster, than the sensor's steps".into());
    };
    look.with_more(found)
}

/// What suits a trace whose friction has another equation.
pub struct Screened {
    /// Half-width of the kernel, s, and way after a turn, rad or m.
    pub kernel: (f64, f64),
    pub late: Option<String>,
}

/// Refuses a trace with something wrong in its columns; nothing where no stretch is long enough.
pub fn screened(record: &Record, trace: &Trace) -> Result<Option<Screened>, String> {
    let look = Look::at(record, trace);
    let Some(found) = look.screened()? else {
        return Ok(None);
    };
    let late = look.late(&found).map(|(_, word)| word);
    look.apart(&found, late.is_some()).map_or(Ok(()), Err)?;
    Ok(Some(Screened {
        kernel: (found.length, found.settling),
        late,
    }))
}

/// Share of the effort that is left from which on it is said.
const MUCH: f64 = 0.2;

struct Look<'a> {
    record: &'a Record,
    effort: &'a str,
    load: &'a str,
    motion: &'a str,
    unit: &'static str,
    length: &'static str,
    /// Columns between which a gear's ratio is missing.
    without_ratio: Option<[&'a str; 2]>,
    more: Vec<Term>,
}

fn about((value, half): (f64, f64)) -> String {
    format!("{} +- {}", digits(value, 3), digits(half, 2))
}

fn below(found: &Estimate, term: Term) -> Option<(f64, f64)> {
    found.of(term).filter(|(value, half)| *value < -half)
}

/// A fit that a drive cannot have.
fn bad(found: &Estimate) -> bool {
    let negative = |term| below(found, term).is_some();
    found.fit.relative > DOUBTED || negative(Term::Coulomb) || negative(Term::Inertia)
}

impl<'a> Look<'a> {
    fn at(record: &'a Record, trace: &'a Trace) -> Self {
        let [effort, load, unit, length] = match trace.coordinate {
            Coordinate::Rotation => ["motor_torque", "load_torque", "N m", "rad"],
            Coordinate::Translation => ["motor_force", "axial_load", "N", "m"],
        };
        let origins = &trace.origins;
        let named = Some(origins.effort.as_str()).filter(|name| !name.is_empty());
        let motion = origins.motion.as_ref().map(|(name, _)| name.as_str());
        Self {
            record,
            effort: named.unwrap_or(effort),
            load: origins.load.as_deref().unwrap_or(load),
            motion: motion.unwrap_or("the position"),
            unit,
            length,
            without_ratio: origins.without_ratio(),
            more: Vec::new(),
        }
    }

    /// What it tells with these terms more beside those that were found, with one kernel or the best.
    fn with(&self, terms: &[Term], lag: bool, kernel: Option<(f64, f64)>) -> Option<Estimate> {
        let wanted = Wanted {
            more: [&self.more, terms].concat(),
            lag,
            kernel,
        };
        estimate(std::slice::from_ref(self.record), &wanted)
    }

    /// What a record tells by the equation alone, where nothing is wrong with its columns; nothing where no stretch is long enough.
    fn screened(&self) -> Result<Option<Estimate>, String> {
        self.ran_over().map_or(Ok(()), Err)?;
        let found = self.with(&[], false, None);
        self.exchanged(found.as_ref()).map_or(Ok(()), Err)?;
        let wrong = found.as_ref().and_then(|found| {
            self.of_load(found)
                .or_else(|| self.hidden_jump(found))
                .or_else(|| self.turned(found))
        });
        wrong.map_or(Ok(found), Err)
    }

    fn with_more(&mut self, mut found: Estimate) -> Result<Diagnosis, String> {
        let (mut words, mut wave) = (Vec::new(), None);
        let moves = found.of(Term::OneSpeed).is_none();
        if moves && !self.record.speed_alone {
            let waved = self.load_of_position(&found);
            if let Some((better, number, word)) = waved.or_else(|| self.ripple(&found)) {
                (found, wave) = (better, Some(number));
                self.more = vec![Term::Sine(number), Term::Cosine(number)];
                words.push(word);
            }
        }
        let late = self.late(&found);
        if moves && !self.record.speed_alone {
            self.apart(&found, late.is_some()).map_or(Ok(()), Err)?;
        }
        if let Some((better, word)) = late {
            found = better;
            words.push(word);
        }
        if moves {
            words.extend(self.asymmetry(&found));
            if let Some((better, word)) = self.stribeck(&found) {
                found = better;
                words.push(word);
            }
        }
        words.extend(self.zero(&found));
        words.extend(self.doubts(&found));
        let left = found.fit.relative;
        if left > NOTHING {
            return Err(format!(
                "nothing in the trace explains its effort: {:.0} % of it are left; is the right column the {}, and does what moves belong to it?",
                100.0 * left,
                self.effort
            ));
        }
        if left > DOUBTED && below(&found, Term::Coulomb).is_some() {
            return Err(format!(
                "friction comes out below zero, and {:.0} % of the effort are left: are the columns of motion and {} exchanged?",
                100.0 * left,
                self.effort
            ));
        }
        Ok(Diagnosis {
            estimate: found,
            words,
            wave,
        })
    }

    /// What no drive has: friction or losses below zero, much of the effort unexplained.
    fn doubts(&self, found: &Estimate) -> Vec<String> {
        let lacks = "the equation lacks a term; the numbers beside it are in doubt too".to_string();
        let of_load = format!(
            "{} reads too much or too little, or has an offset",
            self.load
        );
        let mut words = Vec::new();
        for (term, name, why) in [
            (Term::Coulomb, "Coulomb friction", &lacks),
            (Term::OneSpeed, "friction", &lacks),
            (Term::Viscous, "viscous friction", &lacks),
            (Term::Driving, "the driving loss", &of_load),
            (Term::BackDriving, "the back-driving loss", &of_load),
        ] {
            if let Some(told) = below(found, term) {
                let told = about(told);
                words.push(format!(
                    "{name} is {told}, below zero, which none is: {why}"
                ));
            }
        }
        if (MUCH..NOTHING).contains(&found.fit.relative) {
            words.push(format!(
                "the equation leaves {:.0} % of the effort: something acts that is not in it, and the intervals do not hold that",
                100.0 * found.fit.relative
            ));
        }
        words
    }

    /// An effort that fills a power of two of its steps, and jumps by as much between two samples.
    fn ran_over(&self) -> Option<String> {
        let effort = &self.record.effort;
        let step = resolution(effort);
        let (low, high) = range(effort);
        BITS.into_iter().find_map(|bits| {
            let whole = step * 2_f64.powi(bits);
            let jumps = effort.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 0.8 * whole);
            let count = jumps.count();
            let fills = (0.85 * whole..=1.0001 * whole).contains(&(high - low));
            (step > 0.0 && fills && count > 1).then(|| {
                let why = if low >= -0.5 * step {
                    "a number that was read without its sign"
                } else {
                    "a number that ran over its range"
                };
                format!(
                    "{} jumps by 2^{bits} of its steps ({} {}) between two samples, {count} times: {why}",
                    self.effort,
                    digits(whole, 4),
                    self.unit
                )
            })
        })
    }

    /// Position and effort are exchanged: the other way round the equation holds.
    fn exchanged(&self, found: Option<&Estimate>) -> Option<String> {
        let left = found.map_or(1.0, |found| found.fit.relative);
        if self.record.speed_alone || left < DOUBTED {
            return None;
        }
        let other = estimate(&[self.record.exchanged()], &Wanted::default())?;
        let (inertia, half) = other.of(Term::Inertia)?;
        let (coulomb, _) = other.of(Term::Coulomb)?;
        let holds = other.fit.relative < 0.2_f64.min(0.5 * left);
        (holds && inertia > 2.0 * half && coulomb > 0.0).then(|| {
            format!(
                "{} and {} are exchanged: the other way round the equation leaves {:.0} % of the effort, as it stands {:.0} %",
                self.motion,
                self.effort,
                100.0 * other.fit.relative,
                100.0 * left
            )
        })
    }

    /// Sign, unit or ratio of the load, by how much of it the effort carries: `((1 + driving_loss) + (1 - back_driving_loss))/2`.
    fn of_load(&self, found: &Estimate) -> Option<String> {
        let Self {
            effort, load, unit, ..
        } = self;
        if let Some((gain, half)) = found.of(Term::Gain)
            && gain.abs() - half > LONGEST
        {
            return Some(format!(
                "a newton of {load} takes {} N m of {effort}, as on a lever of that many metres: is the load in kN? Then its name is {load}_kN; or is the torque in mN m ({effort}_mNm)?",
                digits(gain, 3)
            ));
        }
        if let Some((gain, half)) = found.of(Term::Gain)
            && gain < 0.0
            && half < 0.2 * -gain
            && found.fit.relative < DOUBTED
        {
            let turned = self.turned_beside(found);
            return Some(format!(
                "a newton of {load} takes {} N m of {effort}, which assists what it should oppose: turn the sign of {turned}",
                digits(gain, 3)
            ));
        }
        let ((driving, half), (back, _)) = (found.of(Term::Driving)?, found.of(Term::BackDriving)?);
        let carried = 1.0 + 0.5 * (driving - back);
        let sure = half < 0.2 * carried.abs().max(0.1);
        if found.fit.relative > DOUBTED || !sure || (0.7..1.4).contains(&carried) {
            return None;
        }
        let force = matches!(heading(load), Ok(Some((Quantity::Load, _))));
        let load_unit = if force { "N" } else { unit };
        let cause = if (-1.4..-0.7).contains(&carried) {
            format!("turn the sign of {}", self.turned_beside(found))
        } else if (700.0..1400.0).contains(&carried) {
            format!("{effort} is in m{unit}, or {load} in k{load_unit}")
        } else if (7e-4..1.4e-3).contains(&carried) {
            format!("{effort} is in k{unit}, or {load} in m{load_unit}")
        } else {
            let ratio = digits(1.0 / carried, 3);
            match self.without_ratio {
                Some([one, other]) => format!(
                    "a gear between {one} and {other} would do that: give --ratio (here {ratio}), or mend a unit"
                ),
                None => format!("mend a unit, or give the ratio of a gear (--ratio; here {ratio})"),
            }
        };
        let carried = digits(carried, 3);
        Some(format!("{effort} carries {carried} times {load}: {cause}"))
    }

    /// Which of effort and load has the wrong sign: a turned effort turns the friction too.
    fn turned_beside(&self, found: &Estimate) -> &str {
        let coulomb = found.of(Term::Coulomb).map_or(0.0, |(coulomb, _)| coulomb);
        if coulomb < 0.0 {
            self.effort
        } else {
            self.load
        }
    }

    /// A jump that hides in the turns: Coulomb friction below zero beside a sound inertia and drag.
    fn hidden_jump(&self, found: &Estimate) -> Option<String> {
        let (coulomb, _) = below(found, Term::Coulomb)?;
        let above = |term: Term| found.of(term).is_some_and(|(value, _)| value > 0.0);
        let step = resolution(&self.record.effort);
        let (low, high) = range(&self.record.effort);
        let mut whole = BITS.into_iter().map(|bits| step * 2_f64.powi(bits));
        let whole =
            whole.find(|whole| *whole > 0.0 && (high - low..3.0 * (high - low)).contains(whole))?;
        let Self { effort, unit, .. } = self;
        (above(Term::Inertia) && above(Term::Viscous)).then(|| {
            format!(
                "Coulomb friction is {} {unit} beside a sound inertia: {effort} ran over by {} {unit} at the turns, a power of two of its steps",
                digits(coulomb, 3),
                digits(whole, 4)
            )
        })
    }

    /// Power out of friction: over closed ways inertia and a load of the position give none.
    fn turned(&self, found: &Estimate) -> Option<String> {
        let coulomb = found.of(Term::Coulomb);
        let (coulomb, _) = coulomb.or_else(|| found.of(Term::OneSpeed))?;
        let share = energy(self.record);
        let taken = coulomb < 0.0 && share < -0.02 || bad(found) && share < -0.1;
        taken.then(|| {
            format!(
                "over closed motions the motor would gain energy from friction ({:.0} % of what flows): turn the sign of {}, or of the motion",
                -100.0 * share,
                self.effort
            )
        })
    }

    /// A better fit with a wave of the position, chosen again over all kernels, and its amplitude.
    fn waved(&self, wave: f64) -> Option<(Estimate, String)> {
        let terms = [Term::Sine(wave), Term::Cosine(wave)];
        let found = self.with(&terms, false, None)?;
        let [sine, cosine] = terms.map(|term| found.of(term).map_or(0.0, |(value, _)| value));
        let amplitude = digits(sine.hypot(cosine), 3);
        Some((found, format!("{amplitude} {}", self.unit)))
    }

    /// A load that follows the position: a sine and a cosine of it, of a turn or of a part of the stroke, take two fifths of the residual.
    fn load_of_position(&self, found: &Estimate) -> Option<(Estimate, f64, String)> {
        let (low, high) = range(&self.record.path);
        let stroke = high - low;
        let mut waves = [1.5, 3.0, 6.0].map(|part| part / stroke).to_vec();
        if self.length == "rad" && stroke < 30.0 {
            waves.insert(0, 1.0);
        }
        let mut best: Option<(f64, f64)> = None;
        let kernel = Some((found.length, found.settling));
        for wave in waves {
            let terms = [Term::Sine(wave), Term::Cosine(wave)];
            let Some(other) = self.with(&terms, false, kernel) else {
                continue;
            };
            let left = other.fit.residual_rms;
            if !bad(&other) && best.is_none_or(|(_, before)| left < 0.8 * before) {
                best = Some((wave, left));
            }
        }
        let (wave, left) = best?;
        if left > 0.6 * found.fit.residual_rms {
            return None;
        }
        let (better, amplitude) = self.waved(wave)?;
        let word = format!(
            "a load that follows the position is not in the trace: a wave of {amplitude} over {} {} takes the residual from {:.1} to {:.1} %; give {}",
            digits(TAU / wave, 3),
            self.length,
            100.0 * found.fit.relative,
            100.0 * better.fit.relative,
            self.load
        );
        Some((better, wave, word))
    }

    fn ripple(&self, found: &Estimate) -> Option<(Estimate, f64, String)> {
        // Short kernels let it through.
        let kernel = Some((found.length.min(6e-3), found.settling));
        let sharp = self.with(&[], false, kernel)?;
        let rows = sharp.rows.first()?.as_ref()?;
        let places = rows.centres.iter().map(|centre| self.record.path[*centre]);
        let places: Vec<f64> = places.collect();
        let (wave, share) = strongest_wave(&places, &sharp.fit.residual)?;
        if share < SHARE {
            return None;
        }
        let (better, amplitude) = self.waved(wave)?;
        let turns = if self.length == "rad" {
            format!("{} a turn", digits(wave, 4))
        } else {
            format!("a period of {} m", digits(TAU / wave, 4))
        };
        let word = format!(
            "the effort has a ripple over the position: {turns}, {amplitude}, {:.0} % of what the equation leaves; it is in the fit",
            100.0 * share
        );
        Some((better, wave, word))
    }

    /// One channel that comes later or earlier than all others: the effort, the load, or the motion, as both of them together show it. Looked for
    /// behind the kernel that was chosen, and behind a longer one, which leaves less of the noise.
    fn apart(&self, found: &Estimate, in_the_fit: bool) -> Option<String> {
        let record = self.record;
        let own = record.load.as_deref().filter(|_| record.load_is_effort);
        let behind = |length: f64| {
            let half = (length / record.tick).round() as usize;
            let rows = Rows::of(record, half, found.settling, 0)?;
            let columns = Block::of(record, &rows, &found.terms).columns;
            let none = vec![0.0; rows.len()];
            let shift = |channel: &[f64], rest: &[f64]| shift(&rows, &columns, channel, rest);
            let Some(load) = own else {
                return Some((shift(&record.effort, &none)?, self.effort));
            };
            let both = record.effort.iter().zip(load);
            let both: Vec<f64> = both.map(|(effort, load)| effort - load).collect();
            let later = |(by, left): (isize, f64)| (-by, left);
            let told = [
                (shift(&record.effort, &rows.sums(0, load)), self.effort),
                (shift(load, &rows.sums(0, &record.effort)), self.load),
                (shift(&both, &none).map(later), self.motion),
            ];
            told.into_iter()
                .filter_map(|(found, name)| Some((found?, name)))
                .min_by(|one, other| one.0.1.total_cmp(&other.0.1))
        };
        let ((by, _), name) =
            behind(found.length).or_else(|| behind(LONG.max(2.0 * found.length)))?;
        let time = record.tick * by as f64;
        (!(in_the_fit && time.abs() < IN_THE_FIT)).then(|| {
            format!(
                "{name} comes {:.0} ms {} than the other channels, which it fits best there: shift the channels to one clock",
                1e3 * time.abs(),
                if by > 0 { "later" } else { "earlier" }
            )
        })
    }

    /// The lag of a measured speed, or of effort and position against each other.
    fn late(&self, found: &Estimate) -> Option<(Estimate, String)> {
        let ms = |(lag, half): (f64, f64)| format!("{:.2} +- {:.2} ms", 1e3 * lag, 1e3 * half);
        if self.record.speed_alone {
            let lag = found.of(Term::Lag).filter(|(lag, half)| lag > half)?;
            let word = format!("the measured speed is {} late: it is in the fit", ms(lag));
            return Some((found.clone(), word));
        }
        let sure = |estimate: &Estimate| {
            let told = estimate.of(Term::Lag);
            told.filter(|(lag, half)| lag.abs() > 1.5 * half && lag.abs() > self.record.tick)
        };
        sure(&self.with(&[], true, Some((found.length, found.settling)))?)?;
        let better = self.with(&[], true, None)?;
        let (lag, half) = sure(&better)?;
        let word = format!(
            "the effort comes {} {} than the motion: it is in the fit; put both on one clock",
            ms((lag.abs(), half)),
            if lag < 0.0 { "later" } else { "earlier" }
        );
        Some((better, word))
    }

    /// A term more that is surely not zero, with the kernel that was chosen.
    fn surely(&self, found: &Estimate, term: Term, settling: f64) -> Option<Estimate> {
        let other = self.with(&[term], self.lags(found), Some((found.length, settling)))?;
        other.surely(term, TRIED).and(Some(other))
    }

    fn lags(&self, found: &Estimate) -> bool {
        !self.record.speed_alone && found.of(Term::Lag).is_some()
    }

    /// Zero error of a load's channel: it moves the sign of the load's power, so that losses step by `-c (driving_loss + back_driving_loss)/2`
    /// where the measured load changes from assisting to opposing. As an effort that is always there it is one with the offset.
    fn zero(&self, found: &Estimate) -> Option<String> {
        found.of(Term::Driving).and(found.of(Term::BackDriving))?;
        let other = self.surely(found, Term::LoadZero, found.settling)?;
        let (step, half) = other.of(Term::LoadZero)?;
        let ((driving, _), (back, _)) = (other.of(Term::Driving)?, other.of(Term::BackDriving)?);
        let [zero, half] = [step, half].map(|of| -2.0 * of / (driving + back));
        Some(format!(
            "{} reads {} {} without a load: set its zero; the offset holds it",
            self.load,
            about((zero, half.abs())),
            self.unit
        ))
    }

    fn asymmetry(&self, found: &Estimate) -> Option<String> {
        found.of(Term::Offset)?;
        let other = self.surely(found, Term::Asymmetry, found.settling)?;
        if other.fit.residual_rms > TAKES * found.fit.residual_rms {
            return None;
        }
        let ((drag, _), (differs, half)) = (other.of(Term::Viscous)?, other.of(Term::Asymmetry)?);
        Some(format!(
            "viscous friction differs by direction: {} forward, {} backward, each +- {}; the offset is {} {} then",
            digits(drag + differs, 3),
            digits(drag - differs, 3),
            digits(half, 2),
            about(other.of(Term::Offset)?),
            self.unit
        ))
    }

    /// Friction that is larger, or smaller, near rest: `s T_S exp(-|w|/w_s)`, the speed one of three, well below those of the motion.
    fn stribeck(&self, found: &Estimate) -> Option<(Estimate, String)> {
        found.of(Term::Coulomb)?;
        let rows = found.rows.first()?.as_ref()?;
        let speeds = rows.sums(self.record.order(1), &self.record.motion);
        let mut speeds: Vec<f64> = speeds.into_iter().map(f64::abs).collect();
        speeds.sort_by(f64::total_cmp);
        let fast = speeds[speeds.len() * 9 / 10];
        let tried = STRIBECK.map(|share| share * fast);
        // Slow rows are those near the turns.
        let plain = self.with(&[], self.lags(found), Some((found.length, 0.0)))?;
        let (speed, _) = tried
            .into_iter()
            .filter_map(|speed| Some((speed, self.surely(found, Term::Stribeck(speed), 0.0)?)))
            .filter(|(_, other)| other.fit.residual_rms < TAKES * plain.fit.residual_rms)
            .min_by(|one, other| one.1.fit.residual_rms.total_cmp(&other.1.fit.residual_rms))?;
        let term = Term::Stribeck(speed);
        let better = self.with(&[term], self.lags(found), None)?;
        let (rise, half) = better.surely(term, TRIED)?;
        better
            .of(Term::Coulomb)
            .filter(|(coulomb, _)| *coulomb > 0.0)?;
        let word = format!(
            "friction {} towards rest by {} {} over {} {}/s: it is in the fit",
            if rise > 0.0 { "rises" } else { "falls" },
            about((rise.abs(), half)),
            self.unit,
            digits(speed, 2),
            self.length
        );
        Some((better, word))
    }
}

/// Work of the effort, without its median, over the sum of its sizes.
fn energy(record: &Record) -> f64 {
    let own = record.load.as_deref().filter(|_| record.load_is_effort);
    let at = |sample: usize| record.effort[sample] - own.map_or(0.0, |load| load[sample]);
    let efforts: Vec<f64> = (0..record.len()).map(at).collect();
    let median = median(efforts.clone());
    let (mut work, mut size) = (0.0, 0.0);
    for (effort, pair) in efforts.iter().zip(record.path.windows(2)) {
        let part = (effort - median) * (pair[1] - pair[0]);
        work += part;
        size += part.abs();
    }
    work / size.max(f64::MIN_POSITIVE)
}

/// By how many samples a channel less `rest` comes later than what the columns explain, where that leaves far less; and what it leaves.
fn shift(rows: &Rows, columns: &[Vec<f64>], channel: &[f64], rest: &[f64]) -> Option<(isize, f64)> {
    let solver = solver(columns)?;
    let left = |by: isize| -> f64 {
        let mut target = rows.later(by, channel);
        for (target, rest) in target.iter_mut().zip(rest) {
            *target -= rest;
        }
        for (column, value) in columns.iter().zip(&solver(&target)) {
            for (target, entry) in target.iter_mut().zip(column) {
                *target -= value * entry;
            }
        }
        dot(&target, &target).sqrt()
    };
    let least = |shifts: &mut dyn Iterator<Item = isize>| {
        let tried = shifts.map(|by| (by, left(by)));
        tried.min_by(|one, other| one.1.total_cmp(&other.1))
    };
    // Behind the kernel a channel changes little within half of it.
    let step = (rows.kernel.half() / 2).max(1) as isize;
    let most = (LATEST / rows.kernel.tick()).ceil() as isize / step;
    let (near, _) = least(&mut (-most..=most).map(|k| k * step))?;
    let (by, less) = least(&mut (near - step..=near + step))?;
    (by.abs() >= LATE.0 && LATE.1 * less < left(0)).then_some((by, less))
}

/// Wave number of the strongest line of a residual over the position, and its share of the variance.
pub fn strongest_wave(places: &[f64], residual: &[f64]) -> Option<(f64, f64)> {
    let (low, high) = range(places);
    let stroke = high - low;
    let bins = BINS.min(places.len() / 4);
    if bins < 64 || !(stroke > 0.0) {
        return None;
    }
    let mean = residual.iter().sum::<f64>() / residual.len().max(1) as f64;
    let residual: Vec<f64> = residual.iter().map(|rest| rest - mean).collect();
    let mut sums = vec![(0.0, 0.0_f64); bins];
    for (place, rest) in places.iter().zip(&residual) {
        let bin = (((place - low) / stroke * bins as f64) as usize).min(bins - 1);
        sums[bin].0 += rest;
        sums[bin].1 += 1.0;
    }
    let mut line: Vec<Complex<f64>> = sums
        .iter()
        .map(|(sum, count)| Complex::new(sum / count.max(1.0), 0.0))
        .collect();
    line.resize(2 * bins, Complex::new(0.0, 0.0));
    FftPlanner::new()
        .plan_fft_forward(2 * bins)
        .process(&mut line);
    let powers: Vec<f64> = line[..bins].iter().map(Complex::norm_sqr).collect();
    let first = (2.0 * PERIODS).ceil() as usize;
    let top = (first..bins).max_by(|one, other| powers[*one].total_cmp(&powers[*other]))?;
    if powers[top] < HEIGHT * median(powers[first..].to_vec()) {
        return None;
    }
    let total = dot(&residual, &residual);
    let near = (-10..=10).map(|part| (top as f64 + 0.1 * f64::from(part)) * PI / stroke);
    near.map(|wave| (wave, explained(places, &residual, wave) / total))
        .max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Squares that a sine and a cosine of the position take from a residual.
fn explained(places: &[f64], residual: &[f64], wave: f64) -> f64 {
    let column = |of: fn(f64) -> f64| places.iter().map(|place| of(wave * place)).collect();
    let columns: [Vec<f64>; 2] = [f64::sin, f64::cos].map(column);
    let taken = solver(&columns).map(|solver| {
        let values = solver(residual);
        let parts = values.iter().zip(&columns);
        parts
            .map(|(value, column)| value * dot(column, residual))
            .sum()
    });
    taken.unwrap_or(0.0)
}
