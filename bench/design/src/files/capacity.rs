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

/// A clearance with its preload, where there is one, for a summary.
pub fn clearance_words(design: &BallScrew, clearance: Clearance) -> String {
    let gap = format!("{:.1} um", 1e6 * clearance.gap());
    let preload = Preload::of(design, clearance);
    if preload.force > 0.0 {
        format!("{gap}, preload of a contact {}", preload.words())
    } else {
        gap
    }
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
