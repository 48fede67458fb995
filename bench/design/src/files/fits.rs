//! How balls fit between the grooves, in the words of a design file.

use epas_friction::{BallScrew, Clearance, Error, Limits, defaults};

use super::capacity::{self, Preload};
use super::plausible::Given;

/// The four keys, one of which says how balls fit.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fits {
    /// Radial gap of every contact, m; oversize below 0.
    pub clearance: Option<f32>,
    /// Force of one contact without a load, N.
    pub preload: Option<f32>,
    /// Axial play of the nut, from one flank to the other, m.
    pub axial_play: Option<f32>,
    /// Axial preload of the nut, N.
    pub axial_preload: Option<f32>,
}

impl Fits {
    fn given(&self) -> Vec<&'static str> {
        [
            ("clearance", self.clearance),
            ("preload", self.preload),
            ("axial_play", self.axial_play),
            ("axial_preload", self.axial_preload),
        ]
        .into_iter()
        .filter_map(|(key, value)| value.map(|_| key))
        .collect()
    }

    /// Whether a file gives one of them.
    pub fn any(&self) -> bool {
        !self.given().is_empty()
    }

    /// The clearance that they say, or the default.
    pub fn of(
        &self,
        design: &BallScrew,
        loaded_balls: Option<u16>,
        limits: &Limits,
    ) -> Result<Clearance, String> {
        let given = self.given();
        if let [one, other, ..] = given[..] {
            return Err(format!("{one} and {other} say the same; give one of them"));
        }
        let made = self.made(design, loaded_balls)?;
        if made.gap() < 0.0 && !given.is_empty() && loaded_balls.is_none() {
            return Err(COUNT.into());
        }
        if let (Some(force), Some(balls)) = (self.preload, loaded_balls) {
            within_load(design, (force, made), balls, limits.axial_load)?;
        }
        Ok(made)
    }

    fn made(&self, design: &BallScrew, loaded_balls: Option<u16>) -> Result<Clearance, String> {
        let said = |error: Error| Given::default().words(&error);
        let made = if let Some(gap) = self.clearance {
            let made = Clearance::new(gap).and_then(|clearance| clearance.checked(design));
            made.map_err(said)?
        } else if let Some(play) = self.axial_play {
            Clearance::of_axial_play(design, play).map_err(said)?
        } else if let Some(force) = self.preload {
            of_force(design, force)?
        } else if let Some(force) = self.axial_preload {
            let balls = loaded_balls.ok_or(COUNT)?;
            of_nut(design, force, balls)?
        } else {
            return defaults::CLEARANCE.checked(design).map_err(said);
        };
        self.bearable(design, made)?;
        Ok(made)
    }

    /// Refuses a preload that presses harder than a ball bears at rest.
    fn bearable(&self, design: &BallScrew, made: Clearance) -> Result<(), String> {
        let preload = Preload::of(design, made);
        if preload.pressure <= capacity::STATIC_PRESSURE {
            return Ok(());
        }
        let (key, value) = match (self.clearance, self.preload, self.axial_preload) {
            (Some(gap), _, _) => ("clearance", gap),
            (_, Some(force), _) => ("preload", force),
            (_, _, Some(force)) => ("axial_preload", force),
            _ => ("clearance", made.gap()),
        };
        let nut = if key == "preload" {
            format!(
                "; preload is the force of one contact, that of the nut is axial_preload = {value}"
            )
        } else {
            String::new()
        };
        let tightest = capacity::tightest(design);
        Err(format!(
            "{key} = {value} presses every contact with {}: beyond {}; allowed: a clearance of {:.3e} m and more, a preload of {:.0} N a contact{nut}",
            preload.words(),
            capacity::LIMIT,
            tightest.gap(),
            tightest.preload(design),
        ))
    }
}

const COUNT: &str = "loaded_balls is missing: all of them press on the flanks of a preloaded nut";

/// Refuses a force of one contact that preloads the nut beyond its largest axial load, N: a number of the nut in the key of a contact.
fn within_load(
    design: &BallScrew,
    (force, made): (f32, Clearance),
    balls: u16,
    most: f32,
) -> Result<(), String> {
    let nut = made.axial_preload(design, balls);
    // A limit that is no load is refused by its name, later.
    if !(nut > most && most > 0.0) {
        return Ok(());
    }
    Err(format!(
        "preload = {force} is the force of one contact: the nut's {balls} balls have {nut:.0} N together, beyond limits.axial_load = {most}; a preload of the nut is axial_preload = {force}"
    ))
}

/// The clearance of a force of one contact, N; 0 is none.
fn of_force(design: &BallScrew, force: f32) -> Result<Clearance, String> {
    if force == 0.0 {
        return Ok(Clearance::ZERO);
    }
    Clearance::of_preload(design, force).map_err(|error| {
        let nut = if force > error.allowed().maximum {
            format!(
                "; this is the force of one contact, that of the nut is axial_preload = {force}"
            )
        } else {
            String::new()
        };
        format!("preload: {error}{nut}")
    })
}

/// The clearance of an axial preload of a nut with so many loaded balls, N; 0 is none.
fn of_nut(design: &BallScrew, force: f32, balls: u16) -> Result<Clearance, String> {
    let per_contact = f32::from(balls) * design.axial_per_normal();
    let made = match force / per_contact {
        0.0 => Ok(Clearance::ZERO),
        contact => Clearance::of_preload(design, contact),
    };
    made.map_err(|error| {
        let allowed = error.allowed();
        let [low, high] = [allowed.minimum, allowed.maximum].map(|end| end * per_contact);
        format!("axial_preload = {force} is out of range; allowed: 0, or {low} to {high} N")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::DesignSource;

    const LIMITS: Limits = Limits {
        nut_speed: 2e3,
        axial_load: 2e4,
        friction_torque: 100.0,
    };

    fn screw() -> BallScrew {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        *source.load().unwrap().screw()
    }

    fn fits(key: &str, value: f32) -> Fits {
        let mut fits = Fits::default();
        let own = match key {
            "clearance" => &mut fits.clearance,
            "preload" => &mut fits.preload,
            "axial_play" => &mut fits.axial_play,
            _ => &mut fits.axial_preload,
        };
        *own = Some(value);
        fits
    }

    fn of(fits: Fits) -> Result<Clearance, String> {
        fits.of(&screw(), Some(71), &LIMITS)
    }

    #[test]
    fn four_keys_say_one_clearance() {
        let screw = screw();
        let force = of(fits("preload", 30.0)).unwrap();
        // The 2/3 power and its inverse: a few roundings.
        assert!((force.preload(&screw) / 30.0 - 1.0).abs() < 1e-5);
        let nut = of(fits("axial_preload", force.axial_preload(&screw, 71))).unwrap();
        assert!((nut.gap() / force.gap() - 1.0).abs() < 1e-5);
        let play = of(fits("axial_play", 20e-6)).unwrap();
        assert!((play.axial_play(&screw) / 20e-6 - 1.0).abs() < 1e-4);
        for fits in [fits("preload", 0.0), fits("axial_preload", 0.0)] {
            assert_eq!(of(fits).unwrap(), Clearance::ZERO);
        }
    }

    #[test]
    fn two_keys_are_refused() {
        let fits = Fits {
            axial_play: Some(0.0),
            axial_preload: Some(0.0),
            ..Fits::default()
        };
        assert_eq!(
            of(fits).unwrap_err(),
            "axial_play and axial_preload say the same; give one of them"
        );
    }

    /// Beyond 4.2 GPa in either groove a clearance is refused, in every key; the tightest that is allowed is not.
    #[test]
    fn a_preload_is_bounded_by_the_pressure() {
        let screw = screw();
        let tightest = capacity::tightest(&screw);
        for gap in [1.01 * tightest.gap(), -20e-6] {
            let refused = of(fits("clearance", gap));
            let words = refused.unwrap_err();
            assert!(
                words.contains("GPa") && words.contains("ISO 3408-5"),
                "{words}"
            );
        }
        let allowed = fits("clearance", 0.999 * tightest.gap());
        assert!(of(allowed).is_ok());
        // What a catalogue gives for the nut is no force of a contact.
        let nut = fits("preload", 1.1 * tightest.preload(&screw));
        let words = of(nut).unwrap_err();
        assert!(
            words.contains("that of the nut is axial_preload"),
            "{words}"
        );
    }

    /// Below the pressure that a contact bears, the nut's preload is still bounded by its largest load, in the key of a contact alone.
    #[test]
    fn a_preload_of_the_nut_in_the_key_of_a_contact_is_refused() {
        let screw = screw();
        let words = of(fits("preload", 744.0)).unwrap_err();
        assert!(words.contains("axial_preload = 744"), "{words}");
        // The force of a contact at which 71 balls have the largest load together.
        let most = LIMITS.axial_load / (71.0 * screw.axial_per_normal());
        assert!(of(fits("preload", 1.001 * most)).is_err());
        let clearance = of(fits("preload", 0.999 * most)).unwrap();
        let nut = fits("axial_preload", 744.0);
        assert!(of(nut).is_ok());
        let gap = fits("clearance", 1.01 * clearance.gap());
        assert!(of(gap).is_ok());
    }
}
