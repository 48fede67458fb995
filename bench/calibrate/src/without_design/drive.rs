//! What firmware takes of a trace without a design: the numbers of the scene `LoadProportionalScrew`, and those of the rig.

use crate::answer::Estimate;
use crate::page::shown::digits;
use crate::trace::Coordinate;
use epas_page::failure::Failure;

/// Factor by which firmware believes in more than the trace has.
const ROOM: f64 = 2.0;

/// Estimates that the constants hold.
const HELD: [&str; 8] = [
    "inertia",
    "viscous_friction",
    "offset",
    "coulomb_friction",
    "driving_loss",
    "back_driving_loss",
    "load_gain",
    "load_loss",
];

#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    pub coordinate: Coordinate,
    pub estimates: Vec<Estimate>,
    /// Speed over which friction reverses, where the trace tells it, rad/s.
    pub reversal_speed: Option<f64>,
    /// Largest speed, rad/s, and load.
    pub largest: [f64; 2],
}

#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// Torque of a unit of load, m; 1 where the load is a torque.
    pub load_lever: f64,
    /// Friction torque without a load, N m.
    pub coulomb_friction: f64,
    /// Friction torque over the speed, N m s/rad.
    pub viscous_friction: f64,
    /// Losses of driving and back-driving over the load's torque.
    pub losses: [f64; 2],
    /// Speed over which friction reverses, rad/s.
    pub reversal_speed: f64,
    /// Largest speed, rad/s, load, and friction torque, N m, that firmware believes.
    pub limits: [f64; 3],
    /// Inertia, kg m^2, and torque that is always there, N m, where they were told.
    pub inertia: Option<f64>,
    /// See `inertia`.
    pub offset: Option<f64>,
    /// What was not told, or is left out: a sentence each, without its point.
    pub notes: Vec<String>,
}

impl Drive {
    pub fn numbers(&self) -> Result<Numbers, Failure> {
        if self.coordinate != Coordinate::Rotation {
            return Err(Failure::Data(
                "constants without a design are those of an angle and a torque, and the trace is of a travel and a force: give motor_torque and an angle, or the design".into(),
            ));
        }
        let mut notes = Vec::new();
        let [coulomb_friction, viscous_friction] = [
            self.needed("coulomb_friction")?,
            self.needed("viscous_friction")?,
        ];
        let lever = self.value("load_gain")?;
        let load_lever = lever.unwrap_or(1.0);
        if lever.is_none() {
            notes.push("The load is a torque here: axial_load, as limit and as what a step is given, is in N m, and load_lever is 1".into());
        }
        let mut losses = [0.0; 2];
        if let Some(loss) = self.value("load_loss")? {
            losses = [loss / load_lever; 2];
            notes.push("The trace tells one loss for both directions of power: driving_loss and back_driving_loss are it, and half of their difference is in load_lever".into());
        } else {
            for (loss, name) in losses.iter_mut().zip(["driving", "back_driving"]) {
                let told = self.value(&format!("{name}_loss"))?;
                let name = name.replace('_', "-");
                let word = || format!("The trace does not tell the loss of {name}: it is 0 here");
                notes.extend(told.is_none().then(word));
                *loss = told.unwrap_or(0.0);
            }
        }
        if self.reversal_speed.is_none() {
            notes.push("The trace shows no speed over which friction reverses: a thousandth of its largest stands for it".into());
        }
        let inertia = self.value("inertia")?;
        let offset = self.told("offset").map(|of| of.value);
        for (name, value) in [("inertia", inertia), ("offset", offset)] {
            notes.extend(
                value.is_none().then(|| {
                    format!("The trace does not tell the {name}: it has no constant here")
                }),
            );
        }
        let beside = self.estimates.iter();
        let beside = beside.filter(|of| !HELD.contains(&of.name.as_str()));
        notes.extend(beside.map(|of| {
            let (name, value) = (of.name.replace('_', " "), digits(of.value, 3));
            format!("The trace has a {name} of {value} {}, which this scene does not have: it is left out", of.unit)
        }));
        let [speed, load] = self.largest.map(|largest| ROOM * largest);
        // A trace without a load has no limit of one.
        let load = if load > 0.0 { load } else { 1e3 };
        let friction = coulomb_friction
            + viscous_friction * speed
            + losses[0].max(losses[1]) * load_lever * load;
        Ok(Numbers {
            load_lever,
            coulomb_friction,
            viscous_friction,
            losses,
            reversal_speed: self.reversal_speed.unwrap_or(1e-3 * self.largest[0]),
            limits: [speed, load, ROOM * friction],
            inertia,
            offset,
            notes,
        })
    }

    fn told(&self, name: &str) -> Option<&Estimate> {
        self.estimates.iter().find(|found| found.name == name)
    }

    fn value(&self, name: &str) -> Result<Option<f64>, Failure> {
        match self.told(name) {
            Some(found) if found.value < 0.0 => Err(refused(name, "is below zero")),
            found => Ok(found.map(|found| found.value)),
        }
    }

    fn needed(&self, name: &str) -> Result<f64, Failure> {
        self.value(name)?
            .ok_or_else(|| refused(name, "is not told by the trace"))
    }
}

fn refused(name: &str, why: &str) -> Failure {
    let name = name.replace('_', " ");
    Failure::Data(format!("no constants: the {name} {why}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::drives;
    use crate::trace::Trace;
    use crate::without_design::{largest, plain};

    fn notes(trace: &Trace) -> (String, Numbers) {
        let (answer, _) = plain(trace).unwrap();
        let drive = Drive {
            coordinate: trace.coordinate,
            estimates: answer.parameters,
            reversal_speed: None,
            largest: [1.0, largest(trace.load.as_deref().unwrap_or_default())],
        };
        let numbers = drive.numbers().unwrap();
        let said = [&answer.cannot_tell[..], &numbers.notes].concat();
        (said.join("; "), numbers)
    }

    /// What the constants of a load's torque, and of a load's force, leave out or hold otherwise is said.
    #[test]
    fn constants_say_what_they_hold() {
        let mut drawn = drives::Drive::drawn(3);
        drawn.stribeck = (0.5, 10.0);
        let (mut trace, _) = drawn.trace(3, 20.0, 14, None);
        let (said, numbers) = notes(&trace);
        for word in [
            "a zero error of the load's channel",
            "is in N m, and load_lever is 1",
            "stribeck friction",
        ] {
            assert!(said.contains(word), "{word}: {said}");
        }
        assert_ne!(numbers.losses[0], numbers.losses[1]);
        let lever = 0.01;
        for load in trace.load.iter_mut().flatten() {
            *load /= lever;
        }
        trace.load_is_effort = false;
        let (said, numbers) = notes(&trace);
        assert!(said.contains("one loss for both directions"), "{said}");
        // The lever holds half of the difference of the losses.
        let [driving, back_driving] = drawn.losses;
        let whole = 1.0 + 0.5 * (driving - back_driving);
        let loss = 0.5 * (driving + back_driving) / whole;
        for (found, truth) in [
            (numbers.load_lever, lever * whole),
            (numbers.losses[0], loss),
        ] {
            assert!((found / truth - 1.0).abs() < 0.05, "{found} {truth}");
        }
    }
}
