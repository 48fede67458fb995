//! A design as the text of a design file.

use std::fmt::Write as _;

use crate::CagedDesign;
use epas_friction::{FrictionBranch, GrooveSize, Material};

use super::Design;
use super::coefficient::FrictionLaw;

/// The text of a design file that is read as this design: for one that has no file, a built-in one. Its row of balls and its
/// supports go by its name.
pub fn text(design: &Design) -> String {
    let CagedDesign {
        design: screw,
        friction,
        rolling_resistance,
        clearance,
        loaded_balls,
        reversal_speed,
        limits,
    } = &design.caged;
    let parameters = screw.parameters();
    let branch = match design.branch {
        None => "contacts",
        Some(FrictionBranch::Sliding) => "sliding",
        Some(_) => "rolling",
    };
    let mut text = format!("name = {:?}\n", design.name);
    for (key, value) in [
        ("pitch_radius", parameters.pitch_radius),
        ("lead", parameters.lead),
        ("ball_radius", parameters.ball_radius),
        ("contact_angle", parameters.contact_angle),
        ("friction", *friction),
        ("hysteresis_loss", rolling_resistance.hysteresis_loss),
        ("lubricant_drag", rolling_resistance.lubricant_drag),
        ("rolling_tangent", design.rolling_tangent),
        ("clearance", clearance.gap()),
        ("reversal_speed", *reversal_speed),
    ] {
        let _ = writeln!(text, "{key} = {value:?}");
    }
    let _ = write!(
        text,
        "branch = \"{branch}\"\nloaded_balls = {loaded_balls}\n"
    );
    if design.friction_law == FrictionLaw::Constant {
        text.push_str("friction_law = \"constant\"\n");
    }
    for (name, groove) in [
        ("screw_groove", parameters.screw_groove),
        ("nut_groove", parameters.nut_groove),
    ] {
        let (key, value) = match groove {
            GrooveSize::Conformity(conformity) => ("conformity", conformity),
            GrooveSize::Radius(radius) => ("groove_radius", radius),
        };
        let _ = write!(text, "\n[{name}]\n{key} = {value:?}\n");
    }
    for (name, material) in [
        ("ball_material", parameters.ball_material),
        ("groove_material", parameters.groove_material),
    ] {
        let Material {
            youngs_modulus,
            poisson_ratio,
            density,
        } = material;
        let _ = write!(
            text,
            "\n[{name}]\nyoungs_modulus = {youngs_modulus:?}\npoisson_ratio = {poisson_ratio:?}\ndensity = {density:?}\n"
        );
    }
    let _ = write!(
        text,
        "\n[limits]\nnut_speed = {:?}\naxial_load = {:?}\nfriction_torque = {:?}\n",
        limits.nut_speed, limits.axial_load, limits.friction_torque
    );
    text
}

#[cfg(test)]
mod tests {
    use super::super::{DesignSource, built_in, read};
    use super::*;

    #[test]
    fn every_built_in_design_is_read_from_its_own_text() {
        for (name, ..) in built_in() {
            let design = name.parse::<DesignSource>().unwrap().load().unwrap();
            let again = read(&text(&design), "other").unwrap();
            assert_eq!(again.caged, design.caged, "{name}");
            assert_eq!(again.name, name);
        }
    }
}
