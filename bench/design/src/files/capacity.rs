//! What a contact bears at rest, and what its preload is.

use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{BallScrew, Clearance};

/// Largest contact pressure of a ball at rest, Pa: it leaves a dent of 1e-4 ball diameters (ISO 76, on which the static load rating C0a of
/// ISO 3408-5 rests).
pub const STATIC_PRESSURE: f32 = 4.2e9;

/// The same in words.
pub const LIMIT: &str = "4.2 GPa, the static limit of ISO 3408-5";

/// Preload of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preload {
    /// Force of each of the four contacts without a load, N.
    pub force: f32,
    /// Largest pressure in the harder of both grooves, Pa.
    pub pressure: f32,
}

impl Preload {
    /// That of a clearance; none with play.
    pub fn of(design: &BallScrew, clearance: Clearance) -> Self {
        let force = clearance.preload(design);
        Self {
            force,
            pressure: hardest(design) * force.cbrt(),
        }
    }

    /// In words.
    pub fn words(self) -> String {
        format!("{:.3} N, {:.2} GPa", self.force, 1e-9 * self.pressure)
    }
}

/// Usual preloads over the static limit of a contact: 1 to 10 % of the dynamic rating `C_a`, which is 0.25 to 0.7 of the static one, with a reserve.
const USUAL: [f32; 2] = [1e-3, 0.1];

/// A word for a preload that no nut has: a number of the nut in the key of a contact, or the reverse.
pub fn unusual(design: &BallScrew, preload: Preload) -> Option<String> {
    let [low, high] = USUAL.map(|share| static_force(design) * share);
    if preload.force == 0.0 || (low..=high).contains(&preload.force) {
        return None;
    }
    let [least, most] = USUAL.map(|share| 1e-9 * STATIC_PRESSURE * share.cbrt());
    Some(format!(
        "usual are {least:.2} to {most:.2} GPa, {low:.1} to {high:.0} N a contact: preload is the force of one contact, axial_preload that of the nut"
    ))
}

/// Refuses a largest axial load, N, that may be one in kN.
pub fn check_limit(design: &BallScrew, axial_load: f32, balls: u16) -> Result<(), String> {
    if !in_kilonewtons(design, axial_load, balls) {
        return Ok(());
    }
    Err(format!(
        "axial_load = {axial_load} is out of range; allowed: {:.1} N and more, a thousandth of what {balls} loaded balls bear at rest ({axial_load} kN? that is {})",
        1e-3 * static_load(design) * f32::from(balls),
        1e3 * f64::from(axial_load)
    ))
}

/// Whether a largest axial load is so small that it may be one in kN: loaded balls bear a thousand times that at rest. False for what is no load.
pub fn in_kilonewtons(design: &BallScrew, axial_load: f32, balls: u16) -> bool {
    axial_load > 0.0 && axial_load < 1e-3 * static_load(design) * f32::from(balls)
}

/// A clearance with its preload, where there is one, for a summary.
pub fn clearance_words(design: &BallScrew, clearance: Clearance) -> String {
    let gap = format!("{:.1} um", 1e6 * clearance.gap());
    let preload = Preload::of(design, clearance);
    if preload.force == 0.0 {
        return gap;
    }
    let unusual = unusual(design, preload).map_or_else(String::new, |words| format!("; {words}"));
    format!("{gap}, preload of a contact {}{unusual}", preload.words())
}

/// Axial load of a ball without preload at which its contact reaches [`STATIC_PRESSURE`], N: the static load rating over the number of
/// loaded balls.
pub fn static_load(design: &BallScrew) -> f32 {
    static_force(design) * design.axial_per_normal()
}

/// The smallest clearance whose preload a contact bears.
pub fn tightest(design: &BallScrew) -> Clearance {
    // A force within the range of a preload, or what its range ends with.
    let most = Clearance::of_preload(design, static_force(design));
    most.unwrap_or_else(|error| {
        Clearance::of_preload(design, error.allowed().maximum).unwrap_or(Clearance::ZERO)
    })
}

/// Force of a contact at [`STATIC_PRESSURE`], N.
fn static_force(design: &BallScrew) -> f32 {
    (STATIC_PRESSURE / hardest(design)).powi(3)
}

/// Largest pressure in the harder of both grooves over the third root of the force, Pa/N^(1/3).
fn hardest(design: &BallScrew) -> f32 {
    let pressure = |groove| HertzContact::of(design, groove).max_pressure_coefficient();
    pressure(Groove::Screw).max(pressure(Groove::Nut))
}

/// A word for a ball that bears more than its static limit, N; none below.
pub fn beyond(design: &BallScrew, ball_load: f32) -> Option<String> {
    let limit = static_load(design);
    (ball_load > limit).then(|| {
        format!("{ball_load:.0} N a ball are beyond {limit:.0} N, where a contact reaches {LIMIT}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::DesignSource;

    /// The word comes beyond the limit, and only there.
    #[test]
    fn a_load_beyond_the_limit_gets_a_word() {
        let source: DesignSource = "25x5x3.175".parse().unwrap();
        let screw = *source.load().unwrap().screw();
        let load = static_load(&screw);
        assert!(beyond(&screw, 0.999 * load).is_none());
        assert!(beyond(&screw, 1.001 * load).unwrap().contains("4.2 GPa"));
    }

    /// A preload of the nut in the key of a contact and the reverse, both ways, and that of no built-in design with the default clearance; a limit in
    /// kN.
    #[test]
    fn wrong_keys_and_kilonewtons_get_a_word() {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        let screw = *source.load().unwrap().screw();
        let said = |force: f32| {
            let clearance = Clearance::of_preload(&screw, force).unwrap();
            unusual(&screw, Preload::of(&screw, clearance))
        };
        // 71 balls of a nut with 744 N: 14.8 N a contact.
        let per_contact = 71.0 * screw.axial_per_normal();
        assert_eq!(said(744.0 / per_contact), None);
        for force in [744.0, 14.8 / per_contact] {
            assert!(said(force).unwrap().contains("axial_preload"), "{force}");
        }
        for (name, parameters, _) in crate::files::built_in() {
            let screw = BallScrew::new(parameters).unwrap();
            let preload = Preload::of(&screw, epas_friction::defaults::CLEARANCE);
            assert_eq!(unusual(&screw, preload), None, "{name}");
        }
        for (load, refused) in [(13.0, true), (13e3, false), (500.0, false), (-1.0, false)] {
            let message = check_limit(&screw, load, 71).err();
            let asked = message.map(|message| message.contains("13 kN? that is 13000"));
            assert_eq!(asked, refused.then_some(true), "{load}");
        }
    }

    /// The pressure follows the third root of the force: at the limit it is the limit.
    #[test]
    fn the_limit_is_the_pressure_at_the_limit() {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        let screw = *source.load().unwrap().screw();
        let force = static_load(&screw) / screw.axial_per_normal();
        let at = |groove| HertzContact::of(&screw, groove).at(force).max_pressure;
        let most = at(Groove::Screw).max(at(Groove::Nut));
        // A cube root and a cube in single precision.
        assert!((most / STATIC_PRESSURE - 1.0).abs() < 1e-5, "{most}");
        let preload = Preload::of(&screw, tightest(&screw));
        assert!((preload.pressure / STATIC_PRESSURE - 1.0).abs() < 1e-4);
    }
}
