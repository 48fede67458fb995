//! Sums and peaks of a run, and their lines in the summary.

use std::io::{self, Write};

use epas_friction::{Faults, Regime};

use super::trace::{Sample, Trace};
use crate::model::TickOutputs;
use epas_traces::flags::FLAGS;

#[derive(Clone, Debug, Default)]
pub struct Lines(Vec<(String, String)>);

impl Lines {
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) {
        self.0.push((name.into(), text.into()));
    }

    pub fn add_some(&mut self, name: &str, text: Option<String>) {
        if let Some(text) = text {
            self.add(name, text);
        }
    }

    /// More words at the end of the line with a name, where it is there.
    pub fn amend(&mut self, name: &str, words: &str) {
        if let Some((_, text)) = self.0.iter_mut().find(|(own, _)| own == name) {
            text.push_str(words);
        }
    }

    pub fn append(&mut self, mut others: Self) {
        self.0.append(&mut others.0);
    }

    pub fn print(&self, out: &mut impl Write) -> io::Result<()> {
        for (name, text) in &self.0 {
            writeln!(out, "{name:30} {text}")?;
        }
        Ok(())
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Words {
    pub load: &'static str,
    pub speed: &'static str,
    pub speed_unit: &'static str,
    pub friction: &'static str,
    pub unit: &'static str,
}

#[derive(Clone, Debug)]
pub struct Course {
    /// Travel, m, of a unit of motion.
    travel_per_motion: f64,
    last: Option<f64>,
    direction: f64,
    reversals: usize,
    travel: f64,
    peak_load: f64,
    peak_speed: f64,
    peak_friction: f64,
    /// Energy that friction turned into heat, J.
    energy: f64,
    regimes: [usize; REGIMES.len()],
    flags: Flags,
}

#[derive(Clone, Debug, Default)]
pub struct Flags {
    faulted: usize,
    faults: [usize; FLAGS.len()],
}

const REGIMES: [Regime; 4] = [
    Regime::Driving,
    Regime::BackDriving,
    Regime::Standing,
    Regime::Locked,
];

pub fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::Standing => "standing",
        Regime::Driving => "driving",
        Regime::BackDriving => "back-driving",
        Regime::Locked => "locked",
    }
}

impl Course {
    /// Nothing yet, of a mechanism that travels so many metres for a unit of motion.
    pub fn new(travel_per_motion: f64) -> Self {
        Self {
            travel_per_motion,
            last: None,
            direction: 0.0,
            reversals: 0,
            travel: 0.0,
            peak_load: 0.0,
            peak_speed: 0.0,
            peak_friction: 0.0,
            energy: 0.0,
            regimes: [0; REGIMES.len()],
            flags: Flags::default(),
        }
    }

    /// Takes one more moment in; the motion since the one before, which this one stands for.
    pub fn add(&mut self, sample: &impl Sample, outputs: &TickOutputs) -> f64 {
        let (time, speed, load) = (sample.time(), sample.speed(), sample.load());
        let friction = f64::from(outputs.friction);
        let TickOutputs { regime, faults, .. } = *outputs;
        self.peak_load = self.peak_load.max(load.abs());
        self.peak_speed = self.peak_speed.max(speed.abs());
        self.peak_friction = self.peak_friction.max(friction.abs());
        let motion = speed * self.last.map_or(0.0, |last| time - last);
        self.last = Some(time);
        self.travel += (motion * self.travel_per_motion).abs();
        self.energy += friction * motion;
        if speed != 0.0 {
            if speed * self.direction < 0.0 {
                self.reversals += 1;
            }
            self.direction = speed.signum();
        }
        for (count, known) in self.regimes.iter_mut().zip(REGIMES) {
            *count += usize::from(regime == known);
        }
        self.flags.add(faults);
        motion
    }

    pub const fn peak_load(&self) -> f64 {
        self.peak_load
    }

    pub const fn peak_speed(&self) -> f64 {
        self.peak_speed
    }

    pub fn peaks<S: Sample>(
        &self,
        trace: &Trace<S>,
        design: &str,
        settings: Lines,
        words: &Words,
    ) -> Lines {
        let mut lines = Lines::default();
        lines.add("trace", trace.name.clone());
        lines.add("design", design);
        lines.append(settings);
        let (duration, samples) = (trace.duration(), trace.samples.len());
        lines.add("duration", format!("{duration:.3} s, {samples} samples"));
        lines.add("travel", format!("{:.1} mm", 1e3 * self.travel));
        lines.add("reversals", self.reversals.to_string());
        lines.add(
            format!("peak {}", words.load),
            format!("{:.1} N", self.peak_load),
        );
        lines.add(
            format!("peak {}", words.speed),
            format!("{:.2} {}", self.peak_speed, words.speed_unit),
        );
        lines.add(
            format!("peak friction {}", words.friction),
            format!("{:.4} {}", self.peak_friction, words.unit),
        );
        lines
    }

    pub fn energy(&self, lines: &mut Lines) {
        lines.add("friction energy", format!("{:.3} J", self.energy));
    }

    pub fn regimes(&self, lines: &mut Lines, samples: usize) {
        let regimes: Vec<_> = REGIMES
            .into_iter()
            .zip(self.regimes)
            .filter(|(_, count)| *count > 0)
            .map(|(regime, count)| {
                let share = 100.0 * count as f64 / samples as f64;
                format!("{} {share:.1} %", regime_name(regime))
            })
            .collect();
        lines.add("regimes", regimes.join(", "));
    }

    pub fn flags(&self, lines: &mut Lines) {
        self.flags.lines(lines);
    }
}

impl Flags {
    pub fn add(&mut self, faults: Faults) {
        self.faulted += usize::from(faults.any());
        for (count, flag) in self.faults.iter_mut().zip(FLAGS) {
            *count += usize::from(faults.contains(flag.fault));
        }
    }

    pub fn lines(&self, lines: &mut Lines) {
        let faults: Vec<_> = FLAGS
            .iter()
            .zip(self.faults)
            .filter(|(_, count)| *count > 0)
            .map(|(flag, count)| format!("{} {count}", flag.short))
            .collect();
        lines.add(
            "flagged samples",
            if faults.is_empty() {
                self.faulted.to_string()
            } else {
                format!("{} ({})", self.faulted, faults.join(", "))
            },
        );
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Pressing {
    /// Energy that balls turn into heat on each other, J.
    energy: f64,
    peak: f64,
    most_contacts: u8,
    largest_force: f32,
}

impl Pressing {
    /// Takes in friction between balls, pairs that press and their largest force, N, over a motion.
    pub fn add(&mut self, outputs: &TickOutputs, motion: f64) {
        let friction = f64::from(outputs.ball);
        self.energy += friction * motion;
        self.peak = self.peak.max(friction.abs());
        self.most_contacts = self.most_contacts.max(outputs.contacts);
        // False for NaN.
        if outputs.largest_contact_force > self.largest_force {
            self.largest_force = outputs.largest_contact_force;
        }
    }

    pub fn lines(&self, lines: &mut Lines, words: &Words) {
        lines.add("of it from ball to ball", format!("{:.3} J", self.energy));
        lines.add(
            format!("peak ball-to-ball {}", words.friction),
            format!("{:.4} {}", self.peak, words.unit),
        );
        lines.add(
            "ball-to-ball contacts",
            format!(
                "at most {}, largest force {:.2} N",
                self.most_contacts, self.largest_force
            ),
        );
    }
}
