//! What a run comes to, in a few lines.

use std::f64::consts::TAU;
use std::io::{self, Write};

use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{Faults, Regime};

use super::subject::Subject;
use super::trace::{Sample, Trace};
use super::train::TrainRow;
use super::{Row, regime_name};
use crate::designs::Design;

/// Sums and peaks of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    reduced_lead: f64,
    last: Option<Row>,
    direction: f64,
    reversals: usize,
    travel: f64,
    peak_load: f64,
    peak_speed: f64,
    peak_friction: f64,
    peak_motor: f64,
    /// Work at the motor and at the load while driving and while back-driving, J.
    driving: Work,
    back_driving: Work,
    /// Energy that friction turned into heat, J.
    friction_energy: f64,
    regimes: [usize; 4],
    faulted: usize,
    faults: [usize; FAULTS.len()],
    reference: Option<Difference>,
    train: Option<Pressing>,
}

/// Of balls that press on each other.
#[derive(Clone, Copy, Debug, Default)]
struct Pressing {
    /// Energy that balls turn into heat on each other, J.
    energy: f64,
    peak: f64,
    most_contacts: u8,
    largest_force: f32,
}

#[derive(Clone, Copy, Debug, Default)]
struct Work {
    motor: f64,
    load: f64,
}

/// Largest difference from the reference.
#[derive(Clone, Copy, Debug, Default)]
struct Difference {
    torque: f64,
    largest_torque: f64,
    efficiency: f64,
}

const FAULTS: [(Faults, &str); 5] = [
    (Faults::SPEED_NOT_FINITE, "speed not finite"),
    (Faults::LOAD_NOT_FINITE, "load not finite"),
    (Faults::SPEED_RANGE, "speed limit"),
    (Faults::LOAD_RANGE, "load limit"),
    (Faults::FRICTION_LIMIT, "torque limit"),
];

const REGIMES: [Regime; 4] = [
    Regime::Driving,
    Regime::BackDriving,
    Regime::Standing,
    Regime::Locked,
];

impl Summary {
    /// Nothing yet.
    pub fn new(subject: &Subject) -> Self {
        Self {
            // Of a linear bearing the way is the speed's own.
            reduced_lead: subject
                .screw()
                .map_or(1.0, |design| f64::from(design.screw().lead()) / TAU),
            last: None,
            direction: 0.0,
            reversals: 0,
            travel: 0.0,
            peak_load: 0.0,
            peak_speed: 0.0,
            peak_friction: 0.0,
            peak_motor: 0.0,
            driving: Work::default(),
            back_driving: Work::default(),
            friction_energy: 0.0,
            regimes: [0; 4],
            faulted: 0,
            faults: [0; FAULTS.len()],
            reference: None,
            train: None,
        }
    }

    /// Takes one more row in.
    pub fn add(&mut self, row: &Row) {
        let Row {
            sample,
            outputs,
            reference,
            train,
        } = row;
        let Sample {
            time, nut_speed, ..
        } = *sample;
        let friction = f64::from(outputs.friction_torque);
        let load = f64::from(outputs.load_torque);
        let motor = friction + load;
        self.peak_load = self.peak_load.max(sample.axial_load.abs());
        self.peak_speed = self.peak_speed.max(nut_speed.abs());
        self.peak_friction = self.peak_friction.max(friction.abs());
        self.peak_motor = self.peak_motor.max(motor.abs());

        // Each sample stands for the time since the one before.
        let step = self.last.map_or(0.0, |last| time - last.sample.time);
        let rotation = nut_speed * step;
        self.travel += (rotation * self.reduced_lead).abs();
        self.friction_energy += friction * rotation;
        let work = if load * rotation >= 0.0 {
            &mut self.driving
        } else {
            &mut self.back_driving
        };
        work.motor += motor * rotation;
        work.load += load * rotation;

        if nut_speed != 0.0 {
            if nut_speed * self.direction < 0.0 {
                self.reversals += 1;
            }
            self.direction = nut_speed.signum();
        }
        for (count, regime) in self.regimes.iter_mut().zip(REGIMES) {
            *count += usize::from(outputs.regime == regime);
        }
        self.faulted += usize::from(outputs.faults.any());
        for (count, (fault, _)) in self.faults.iter_mut().zip(FAULTS) {
            *count += usize::from(outputs.faults.contains(fault));
        }
        if let Some(TrainRow { outputs, .. }) = train {
            let pressing = self.train.get_or_insert_default();
            let friction = f64::from(outputs.ball);
            pressing.energy += friction * rotation;
            pressing.peak = pressing.peak.max(friction.abs());
            pressing.most_contacts = pressing.most_contacts.max(outputs.contacts);
            if outputs.largest_contact_force > pressing.largest_force {
                pressing.largest_force = outputs.largest_contact_force;
            }
        }
        if let Some(reference) = reference {
            let difference = self.reference.get_or_insert_default();
            difference.torque = difference
                .torque
                .max((friction - reference.friction_torque).abs());
            difference.largest_torque = difference
                .largest_torque
                .max(reference.friction_torque.abs());
            difference.efficiency = difference
                .efficiency
                .max((f64::from(outputs.efficiency) - reference.efficiency).abs());
        }
        self.last = Some(*row);
    }

    /// Prints the table.
    pub fn print(&self, out: &mut impl Write, trace: &Trace, subject: &Subject) -> io::Result<()> {
        let screw = subject.screw();
        let (load, speed, torque) = match screw {
            Some(_) => ("axial load", "nut speed", ("torque", "N m")),
            None => ("normal load", "speed", ("force", "N")),
        };
        let (torque, unit) = torque;
        let mut line = |name: &str, text: String| writeln!(out, "{name:30} {text}");
        let samples = trace.samples.len();
        let duration = match (trace.samples.first(), trace.samples.last()) {
            (Some(first), Some(last)) => last.time - first.time,
            _ => 0.0,
        };
        line("trace", trace.name.clone())?;
        line("design", subject.name().into())?;
        line("duration", format!("{duration:.3} s, {samples} samples"))?;
        line("travel", format!("{:.1} mm", 1e3 * self.travel))?;
        line("reversals", self.reversals.to_string())?;
        line(&format!("peak {load}"), format!("{:.1} N", self.peak_load))?;
        let speed_unit = if screw.is_some() { "rad/s" } else { "m/s" };
        line(
            &format!("peak {speed}"),
            format!("{:.2} {speed_unit}", self.peak_speed),
        )?;
        line(
            &format!("peak friction {torque}"),
            format!("{:.4} {unit}", self.peak_friction),
        )?;
        if screw.is_some() {
            line("peak motor torque", format!("{:.4} N m", self.peak_motor))?;
        }
        line("friction energy", format!("{:.3} J", self.friction_energy))?;
        if let Some(pressing) = self.train {
            line(
                "of it from ball to ball",
                format!("{:.3} J", pressing.energy),
            )?;
            line(
                &format!("peak ball-to-ball {torque}"),
                format!("{:.4} {unit}", pressing.peak),
            )?;
            line(
                "ball-to-ball contacts",
                format!(
                    "at most {}, largest force {:.2} N",
                    pressing.most_contacts, pressing.largest_force
                ),
            )?;
        }
        if screw.is_some() && self.driving.motor > 0.0 {
            let efficiency = self.driving.load / self.driving.motor;
            line("mean efficiency, driving", format!("{efficiency:.4}"))?;
        }
        if screw.is_some() && self.back_driving.load < 0.0 {
            let efficiency = self.back_driving.motor / self.back_driving.load;
            line("mean efficiency, back-driving", format!("{efficiency:.4}"))?;
        }
        let regimes: Vec<_> = REGIMES
            .into_iter()
            .zip(self.regimes)
            .filter(|(_, count)| *count > 0)
            .map(|(regime, count)| {
                let share = 100.0 * count as f64 / samples as f64;
                format!("{} {share:.1} %", regime_name(regime))
            })
            .collect();
        line("regimes", regimes.join(", "))?;
        if let Some((design, balls)) =
            screw.and_then(|design| design.loaded_balls.map(|balls| (design, balls)))
        {
            let pressure = self.peak_pressure(design, balls);
            line(
                "peak contact pressure",
                format!(
                    "{:.2} GPa at the screw, {balls} loaded balls",
                    1e-9 * pressure
                ),
            )?;
        }
        let faults: Vec<_> = FAULTS
            .iter()
            .zip(self.faults)
            .filter(|(_, count)| *count > 0)
            .map(|((_, name), count)| format!("{name} {count}"))
            .collect();
        line(
            "flagged samples",
            if faults.is_empty() {
                self.faulted.to_string()
            } else {
                format!("{} ({})", self.faulted, faults.join(", "))
            },
        )?;
        if let Some(difference) = self.reference {
            line(
                "largest difference from f64",
                format!(
                    "torque {:.1e} N m of {:.3} N m, efficiency {:.1e}",
                    difference.torque, difference.largest_torque, difference.efficiency
                ),
            )?;
        }
        Ok(())
    }

    /// Pressure at the screw with the peak load shared evenly, Pa.
    fn peak_pressure(&self, design: &Design, balls: u16) -> f32 {
        let screw = design.screw();
        let per_load = EfficiencyGeometry::of(screw).normal_per_axial_load();
        let contact_force = self.peak_load as f32 / f32::from(balls) * per_load;
        HertzContact::of(screw, Groove::Screw)
            .at(contact_force)
            .max_pressure
    }
}
