//! What firmware takes of a trace without a design: the numbers of the scene `LoadProportionalScrew`, and those of the rig.

use crate::answer::Estimate;
use crate::page::shown::digits;
use crate::trace::Coordinate;
use epas_page::failure::Failure;

/// Factor by which firmware believes in more than the trace has.
const ROOM: f64 = 2.0;

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
        let load_lever = self.value("load_gain")?.unwrap_or(1.0);
        let mut losses = [0.0; 2];
        if let Some(loss) = self.value("load_loss")? {
            losses = [loss / load_lever; 2];
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
        if let Some(rise) = self.told("stribeck_friction") {
            notes.push(format!(
                "Friction near rest differs from coulomb_friction by {} N m in the trace, which this scene does not have: it is left out",
                digits(rise.value, 3)
            ));
        }
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

    /// An estimate that firmware may have, where it was told.
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
