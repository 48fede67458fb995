//! What both scenes of a ball screw have in common: columns of the table, and the summary.

use std::f64::consts::TAU;

use epas_design::breakaway::ScrewContacts;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{Clearance, Limits};

use super::beyond::Beyond;
use super::samples::ScrewSample;
use super::scene::Row;
use super::summary::{Course, Lines, Pressing, Words};
use super::trace::Trace;
use epas_design::files::plausible::{FASTEST, FASTEST_BALLS, LONGEST};
use epas_design::files::{Design, capacity};

/// Settings that decide the friction of a scene, with what a design file leaves to the defaults.
pub fn settings(design: &Design, friction: f32, clearance: Clearance) -> Lines {
    let mut lines = Lines::default();
    lines.add(
        "friction coefficient",
        format!("{friction}{}", design.mark("friction")),
    );
    let words = capacity::clearance_words(design.screw(), clearance);
    lines.add("clearance", format!("{words}{}", design.mark("clearance")));
    lines
}

/// The speed over which friction turns round without memory, and what that costs at steering speeds on centre, 1 rad/s of the nut.
pub fn reversal_speed(design: &Design, speed: f32) -> String {
    let whole = 1.0 / 1_f32.hypot(speed);
    let at_it = if speed == 1.0 {
        String::new()
    } else {
        format!(", 71 % at {speed}")
    };
    format!(
        "{speed} rad/s{}: without --memory friction is {:.0} % of its full size at 1 rad/s{at_it}",
        design.mark("reversal_speed"),
        100.0 * whole
    )
}

/// A manoeuvre within what a screw is made for, its loads in proportion, where the heaviest ball carries one of so many equal parts: the limit of
/// its loads, the static limit of a ball, and the largest load that its block holds, N. Words where it was changed.
pub fn within(
    mut trace: Trace<ScrewSample>,
    design: &Design,
    balls: f32,
    block: Option<f32>,
) -> (Trace<ScrewSample>, Option<String>) {
    let limits = [
        (design.caged.limits.axial_load, "axial_load in [limits]"),
        (
            capacity::static_load(design.screw()) * balls,
            "the static limit of its balls",
        ),
        (
            block.unwrap_or(f32::INFINITY),
            "the largest load of its block",
        ),
    ];
    let least =
        |one: (f32, &'static str), other: (f32, _)| if other.0 < one.0 { other } else { one };
    let (most, of) = limits.into_iter().fold((f32::INFINITY, ""), least);
    let loads = trace.samples.iter().map(|sample| sample.axial_load.abs());
    let peak = loads.fold(0.0, f64::max);
    let factor = f64::from(most) / peak;
    if factor.is_nan() || factor >= 1.0 {
        return (trace, None);
    }
    for sample in &mut trace.samples {
        sample.axial_load *= factor;
    }
    let words = format!("loads scaled by {factor:.3}, from {peak:.0} to {most:.0} N at most: {of}");
    (trace, Some(words))
}

/// What a trace that is far too fast for its design, or goes too far, may be, by its peaks of speed, rad/s, and load, N, and the range of its travel, m.
fn too_fast(design: &Design, [speed, load]: [f64; 2], range: f64) -> Option<String> {
    let Limits {
        nut_speed,
        axial_load,
        ..
    } = design.caged.limits;
    let balls = f64::from(design.screw().pitch_radius()) * speed;
    let fits = balls <= FASTEST_BALLS && range <= LONGEST;
    if fits && speed <= FASTEST * f64::from(nut_speed) {
        return None;
    }
    let fits = if fits {
        String::new()
    } else {
        format!(
            "; a travel of {range:.1} m with balls at {balls:.1} m/s fits no screw of this size"
        )
    };
    let exchanged = if load <= nut_speed.into() && speed <= axial_load.into() {
        "; or are the names nut_speed and axial_load exchanged?"
    } else {
        ""
    };
    Some(format!(
        "{speed:.0} rad/s, and nut_speed in [limits] is {nut_speed}{fits}; is it in degrees or turns? Then its column is named nut_speed [deg/s] or nut_speed [rpm]{exchanged}"
    ))
}

pub const WORDS: Words = Words {
    load: "axial load",
    speed: "nut speed",
    speed_unit: "rad/s",
    friction: "torque",
    unit: "N m",
};

pub const DIFFERENCE: &str = "largest difference from f64";

#[derive(Clone, Debug)]
pub struct ScrewSummary {
    course: Course,
    peak_motor: f64,
    /// Least and largest angle of the nut, rad.
    reach: [f64; 2],
    driving: Work,
    back_driving: Work,
    reference: Option<Difference>,
    beyond: Option<Beyond>,
}

/// Work at the motor and at the load, J.
#[derive(Clone, Copy, Debug, Default)]
struct Work {
    motor: f64,
    load: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Difference {
    torque: f64,
    largest_torque: f64,
    efficiency: f64,
    open: usize,
}

impl ScrewSummary {
    pub fn new(design: &Design, beyond: Option<Beyond>) -> Self {
        Self {
            course: Course::new(f64::from(design.screw().lead()) / TAU),
            peak_motor: 0.0,
            reach: [0.0; 2],
            driving: Work::default(),
            back_driving: Work::default(),
            reference: None,
            beyond,
        }
    }

    /// Takes one more row in; the angle that it stands for, rad.
    pub fn add(&mut self, row: &Row<ScrewSample>) -> f64 {
        let Row {
            sample, outputs, ..
        } = row;
        let friction = f64::from(outputs.friction);
        let load = f64::from(outputs.load_torque);
        let motor = friction + load;
        let rotation = self.course.add(sample, outputs);
        if let Some(beyond) = &mut self.beyond {
            beyond.add(sample.nut_speed, sample.axial_load, outputs.faults);
        }
        self.peak_motor = self.peak_motor.max(motor.abs());
        let [least, most] = self.reach;
        self.reach = [least.min(row.motion), most.max(row.motion)];
        let work = if load * rotation >= 0.0 {
            &mut self.driving
        } else {
            &mut self.back_driving
        };
        work.motor += motor * rotation;
        work.load += load * rotation;
        if let Some(reference) = row.reference {
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
            difference.open += usize::from(reference.friction_torque.is_nan());
        }
        rotation
    }

    pub fn lines(
        self,
        trace: &Trace<ScrewSample>,
        design: &Design,
        settings: Lines,
        pressing: Option<&Pressing>,
    ) -> Lines {
        let mut lines = self.course.peaks(trace, &design.name, settings, &WORDS);
        lines.add(
            "peak torque on the nut",
            format!("{:.4} N m", self.peak_motor),
        );
        self.course.energy(&mut lines);
        if let Some(pressing) = pressing {
            pressing.lines(&mut lines, &WORDS);
        }
        if self.driving.motor > 0.0 {
            let efficiency = self.driving.load / self.driving.motor;
            lines.add("mean efficiency, driving", format!("{efficiency:.4}"));
        }
        if self.back_driving.load < 0.0 {
            let efficiency = self.back_driving.motor / self.back_driving.load;
            lines.add("mean efficiency, back-driving", format!("{efficiency:.4}"));
        }
        self.course.regimes(&mut lines, trace.samples.len());
        if let Some(balls) = design.loaded_balls {
            let pressure = 1e-9 * self.peak_pressure(design, balls);
            lines.add(
                "peak contact pressure",
                format!("{pressure:.2} GPa at the screw, {balls} loaded balls"),
            );
        }
        // The preload stands with the clearance; an axial load adds to it at most itself.
        let ball_load = self.course.peak_load() as f32 / f32::from(design.caged.loaded_balls);
        if let Some(words) = capacity::beyond(design.screw(), ball_load) {
            lines.add("beyond the static limit", words);
        }
        self.course.flags(&mut lines);
        let peaks = [self.course.peak_speed(), self.course.peak_load()];
        let [least, most] = self.reach;
        let range = (most - least) * f64::from(design.screw().lead()) / TAU;
        if let Some(words) = too_fast(design, peaks, range) {
            lines.add("speed limit", words);
        }
        let load = self.course.peak_load();
        if capacity::in_kilonewtons(design.screw(), load as f32, design.caged.loaded_balls) {
            let words = format!(
                "{load:.1} N at most, which hardly presses the balls; is it in kN? Then its column is named axial_load [kN]"
            );
            lines.add("load unit", words);
        }
        if let Some(beyond) = self.beyond {
            beyond.lines(&mut lines);
        }
        if let Some(difference) = self.reference {
            let open = match difference.open {
                0 => String::new(),
                open => format!(" ({open} samples left open)"),
            };
            lines.add(
                DIFFERENCE,
                format!(
                    "torque {:.1e} N m of {:.3} N m, efficiency {:.1e}{open}",
                    difference.torque, difference.largest_torque, difference.efficiency
                ),
            );
        }
        lines
    }

    /// Pressure at the screw with the peak load shared evenly beside the preload, Pa.
    fn peak_pressure(&self, design: &Design, balls: u16) -> f32 {
        let screw = design.screw();
        let load = self.course.peak_load() as f32;
        let contact_force = ScrewContacts::of(screw).preloaded(load, balls, design.caged.clearance);
        HertzContact::of(screw, Groove::Screw)
            .at(contact_force)
            .max_pressure
    }
}

#[cfg(test)]
mod tests {
    use epas_friction::Outputs;
    use epas_friction::scene::SceneOutputs as _;

    use super::*;
    use epas_design::files::read;

    fn pressure(preload: f32, axial_load: f64) -> f32 {
        let design = read(
            &format!(
                "pitch_radius = 0.0145\nlead = 0.007\nball_radius = 0.002\nconformity = 0.52\n\
                 contact_angle = 0.7853981633974483\nfriction = 0.1\npreload = {preload}\nloaded_balls = 71\n"
            ),
            "design",
        )
        .unwrap();
        let mut summary = ScrewSummary::new(&design, None);
        let sample = ScrewSample::new(0.0, 1.0, axial_load);
        summary.course.add(&sample, &Outputs::SAFE.into());
        1e-9 * summary.peak_pressure(&design, 71)
    }

    /// Loads are scaled to the least of what bears them, and only down.
    #[test]
    fn a_manoeuvre_is_kept_within_what_the_screw_bears() {
        let design = |limit: f32| {
            read(
                &format!(
                    "pitch_radius = 0.0145\nlead = 0.007\nball_radius = 0.002\nconformity = 0.52\ncontact_angle = 0.785\n\
                     loaded_balls = 20\n[limits]\naxial_load = {limit}\n"
                ),
                "design",
            )
            .unwrap()
        };
        let trace = || Trace {
            name: "parking".into(),
            samples: [-8e3, 4e3]
                .map(|axial_load| ScrewSample::new(0.0, 1.0, axial_load))
                .to_vec(),
        };
        let peak = |trace: &Trace<ScrewSample>| trace.samples[0].axial_load;
        let (kept, words) = within(trace(), &design(2e4), 20.0, Some(9e3));
        assert_eq!((peak(&kept), words), (-8e3, None));
        for (limit, balls, block, most, of) in [
            (2e3, 20.0, Some(6e3), 2e3, "axial_load in [limits]"),
            (2e4, 20.0, Some(6e3), 6e3, "its block"),
            (
                2e4,
                1.0,
                None,
                f64::from(capacity::static_load(design(2e4).screw())),
                "static limit",
            ),
        ] {
            let (scaled, words) = within(trace(), &design(limit), balls, block);
            assert!((peak(&scaled) / -most - 1.0).abs() < 1e-6, "{of}");
            assert!((scaled.samples[1].axial_load / (0.5 * most) - 1.0).abs() < 1e-6);
            assert!(words.unwrap().contains(of), "{of}");
        }
    }

    /// Units are asked for far above the limit of the speed, exchanged names where each peak is within the other's limit.
    #[test]
    fn a_trace_in_another_unit_is_asked_for() {
        let design = read(
            "pitch_radius = 0.0145\nlead = 0.007\nball_radius = 0.002\nconformity = 0.52\ncontact_angle = 0.785\n\
             [limits]\nnut_speed = 300\naxial_load = 20000\n",
            "design",
        )
        .unwrap();
        assert_eq!(too_fast(&design, [440.0, 5e3], 0.1), None);
        let words = too_fast(&design, [440.0, 5e3], 5.0).unwrap();
        assert!(
            words.contains("a travel of 5.0 m with balls at 6.4 m/s"),
            "{words}"
        );
        let words = too_fast(&design, [2e3, 5e3], 0.1).unwrap();
        assert!(
            words.contains("nut_speed [deg/s]") && !words.contains("exchanged"),
            "{words}"
        );
        let words = too_fast(&design, [14.5e3, 35.0], 0.1).unwrap();
        assert!(words.contains("axial_load exchanged"), "{words}");
    }

    /// The preload presses without a load; of a contact's load it adds at most itself, below the load at which it is gone (2.8 times the preload,
    /// here 2.8 kN). Pressures rise with the third root.
    #[test]
    fn the_preload_counts_in_the_pressure() {
        let free = pressure(20.0, 0.0);
        assert!((pressure(160.0, 0.0) / free - 2.0).abs() < 1e-3);
        let [bare, loaded] = [0.1, 20.0].map(|preload| pressure(preload, 1500.0));
        assert!(loaded > bare);
        assert!(loaded.powi(3) < 1.001 * (bare.powi(3) + free.powi(3)));
    }
}
