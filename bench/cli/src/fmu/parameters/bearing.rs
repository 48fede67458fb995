//! Parameters of a linear bearing.

use epas_friction::{LinearBearing, LinearBearingParameters};

use super::named::{BALL, BOTH, GROOVE, Values, list, named};
use crate::fmu::variables::Variable;
use epas_design::files::plausible;
use epas_design::files::train::LinearDesign;

pub fn of_bearing(design: &LinearDesign) -> Vec<Variable> {
    let own = &design.configuration;
    let bearing = own.bearing.parameters();
    let mut l = Vec::new();
    let (radius, angle) = (bearing.ball_radius, bearing.contact_angle);
    list(
        &mut l,
        [(
            "ball_radius",
            Some("m"),
            "ball radius, 1e-4 to 0.05",
            radius,
        )],
    );
    BOTH.list(&mut l, bearing.groove);
    let about = "nominal contact angle, 0.01 to 1.5533";
    list(&mut l, [("contact_angle", Some("rad"), about, angle)]);
    BALL.list(&mut l, &bearing.ball_material);
    GROOVE.list(&mut l, &bearing.groove_material);
    let friction = "Coulomb friction coefficient of ball and groove, 1e-3 to 1";
    let balls = "Coulomb friction coefficient of ball and ball, 0 to 1";
    let loaded = "length of the loaded track, 1e-4 to 100";
    let back = "length of the return, 0 to 100";
    let wave = "length that counts as one turn of the deviations, 1e-4 to 100";
    let reversal = "speed over which friction changes its direction, 1e-9 to 10";
    let speed = "largest speed that is believed, 1e-6 to 1e3";
    let load = "largest normal and side load that is believed, 1e-3 to 1e7";
    let force = "largest friction force output, 1e-6 to 1e6";
    list(
        &mut l,
        [
            ("friction", None, friction, own.friction),
            ("ball_friction", None, balls, own.ball_friction),
            ("loaded_length", Some("m"), loaded, own.loaded_length),
            ("return_length", Some("m"), back, own.return_length),
            ("wavelength", Some("m"), wave, own.wavelength),
            ("reversal_speed", Some("m/s"), reversal, own.reversal_speed),
            ("limits.speed", Some("m/s"), speed, own.limits.speed),
            ("limits.load", Some("N"), load, own.limits.load),
            (
                "limits.friction_force",
                Some("N"),
                force,
                own.limits.friction_force,
            ),
        ],
    );
    l
}

pub fn changed_bearing(design: &LinearDesign, values: &Values<'_>) -> Result<LinearDesign, String> {
    let parameters = LinearBearingParameters {
        ball_radius: values.single("ball_radius"),
        groove: BOTH.of(values, design.configuration.bearing.parameters().groove),
        contact_angle: values.single("contact_angle"),
        ball_material: BALL.of(values),
        groove_material: GROOVE.of(values),
    };
    let bearing =
        LinearBearing::new(parameters).map_err(|error| named(&error, &parameters.ball_material))?;
    plausible::conformity("groove", parameters.groove, parameters.ball_radius)?;
    let mut changed = design.clone();
    let configuration = &mut changed.configuration;
    configuration.bearing = bearing;
    configuration.friction = values.single("friction");
    configuration.ball_friction = values.single("ball_friction");
    configuration.loaded_length = values.single("loaded_length");
    configuration.return_length = values.single("return_length");
    configuration.wavelength = values.single("wavelength");
    configuration.reversal_speed = values.single("reversal_speed");
    configuration.limits.speed = values.single("limits.speed");
    configuration.limits.load = values.single("limits.load");
    configuration.limits.friction_force = values.single("limits.friction_force");
    Ok(changed)
}
