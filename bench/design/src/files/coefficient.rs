//! Friction coefficient over speed and temperature of a design that no trace has been measured of: the crate's default law, with the design's own
//! coefficient, size and balls.

use epas_friction::law::coefficient::{CoefficientParameters, RollingDrag};
use epas_friction::{BallScrew, Error, defaults};
use epas_reference::coefficient::BearingMixture;
use serde::Deserialize;

use super::Design;

/// Loss of density of an oil, 1/K, and the temperature at which its density is given, K.
const EXPANSION: (f32, f32) = (6.5e-4, 288.15);

/// How the friction coefficient of a design follows a trace's temperature, where no `[calibration]` says it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FrictionLaw {
    /// By the default law.
    #[default]
    Default,
    /// Not at all.
    Constant,
}

/// Speed of the nut at which boundary and film friction of a screw have half each, with the default grease at its reference temperature, rad/s:
/// [`BearingMixture`] with the pitch circle for the mean diameter.
pub fn half_share_speed(screw: &BallScrew) -> f32 {
    let law = defaults::COEFFICIENT;
    let (expansion, given) = EXPANSION;
    let density =
        defaults::STEERING_GREASE_DENSITY * (1.0 - expansion * (law.reference_temperature - given));
    let mixture = BearingMixture {
        mean_diameter: 2.0 * f64::from(screw.pitch_radius()),
        kinematic_viscosity: f64::from(law.viscosity.at(law.reference_temperature) / density),
    };
    mixture.half_share_speed() as f32
}

impl Design {
    /// The default law with the design's friction coefficient at standstill.
    pub fn default_coefficient(&self) -> Result<CoefficientParameters, Error> {
        let law = defaults::COEFFICIENT;
        let caged = &self.caged;
        Ok(CoefficientParameters {
            boundary: caged.friction,
            full_film: caged.friction * (law.full_film / law.boundary),
            half_share_speed: half_share_speed(&caged.design),
            drag: RollingDrag::of(&caged.design, caged.loaded_balls, defaults::FLOODING)?,
            ..law
        })
    }

    /// Whether a trace's temperature moves its friction, and if not, why.
    pub fn follows_temperature(&self) -> Result<(), &'static str> {
        match (&self.calibrated, self.friction_law) {
            (Some(calibrated), _) if calibrated.follows_temperature() => Ok(()),
            (Some(_), _) => Err("the design's [calibration] has no full_film_ratio"),
            (None, FrictionLaw::Constant) => {
                Err("the design file says friction_law = \"constant\"")
            }
            (None, FrictionLaw::Default) => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::{DesignSource, read};

    /// The screw of the default has the default's law; a size twice as large, a half-share speed lower by 2^(1/1.4).
    #[test]
    fn half_share_speed_goes_with_size() {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        let design = source.load().unwrap();
        let law = design.default_coefficient().unwrap();
        let default = defaults::COEFFICIENT;
        assert!((law.half_share_speed / default.half_share_speed - 1.0).abs() < 5e-4);
        assert_eq!(law.drag, default.drag);
        assert!((law.full_film / law.boundary - 0.05 / 0.12).abs() < 1e-7);
        let speed = |diameter: f32| {
            let text = format!(
                "nominal_diameter = {diameter}\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.785\n"
            );
            half_share_speed(read(&text, "gear").unwrap().screw())
        };
        let ratio = speed(0.025) / speed(0.05);
        assert!((ratio - 2_f32.powf(1.0 / 1.4)).abs() < 1e-5, "{ratio}");
    }

    /// A file switches the law off; a calibration without a law leaves friction as it was measured.
    #[test]
    fn a_file_switches_the_law_off() {
        let design = |more: &str| {
            let text = format!(
                "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.785\n{more}"
            );
            read(&text, "gear")
        };
        assert!(design("").unwrap().follows_temperature().is_ok());
        assert!(
            design("friction_law = \"default\"")
                .unwrap()
                .follows_temperature()
                .is_ok()
        );
        let constant = design("friction_law = \"constant\"").unwrap();
        assert!(
            constant
                .follows_temperature()
                .unwrap_err()
                .contains("friction_law")
        );
        let measured = design("[calibration]\nbacklash = 0.001").unwrap();
        assert!(
            measured
                .follows_temperature()
                .unwrap_err()
                .contains("full_film_ratio")
        );
        let refused = design(
            "friction_law = \"constant\"\n[calibration]\nfull_film_ratio = 0.5\nhalf_share_speed = 5",
        );
        assert!(refused.unwrap_err().contains("friction_law"));
    }
}
