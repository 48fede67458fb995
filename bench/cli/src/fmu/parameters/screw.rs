//! Parameters of a ball screw.

use epas_design::CagedDesign;
use epas_friction::{BallScrew, BallScrewParameters, FrictionBranch, Limits};

use super::named::{BALL, GROOVE, NUT, SCREW, Values, list, named};
use crate::fmu::scene::SceneName;
use crate::fmu::variables::{Choice, Kind, Variable, parameter};
use epas_design::files::Design;
use epas_design::files::fits::Fits;
use epas_design::files::plausible::{self, Given};
use epas_design::files::train::UncagedDesign;

/// What both scenes of a ball screw have; a built-in design has other numbers of its own where its balls press on each other.
fn gear(design: &Design, scene: SceneName) -> &CagedDesign {
    match (scene.has_row(), &design.uncaged) {
        (true, Some(train)) => &train.gear,
        _ => &design.caged,
    }
}

pub fn of_screw(design: &Design, scene: SceneName) -> Vec<Variable> {
    let gear = gear(design, scene);
    let mut l = Vec::new();
    geometry(&mut l, design.screw().parameters());
    contacts(&mut l, gear);
    match (scene.has_row(), &design.uncaged) {
        (true, Some(train)) => row(&mut l, train),
        _ => caged(&mut l, design),
    }
    limits(&mut l, &gear.limits);
    l
}

fn contacts(l: &mut Vec<Variable>, gear: &CagedDesign) {
    let friction = "Coulomb friction coefficient of ball and groove, 1e-6 to 0.5";
    let loss = "share of the elastic energy that is lost while a contact passes, 0 to 0.2";
    let drag = "drag of the lubricant on one contact under 100 N, 0 to 10";
    let gap = "radial gap of every contact without load; play above 0, oversize below; -0.02 to 0.05 ball radii, contact pressure without load up to 4.2 GPa";
    let reversal = "nut speed over which friction changes its direction, 1e-6 to 1e3";
    let rolling = gear.rolling_resistance;
    list(
        l,
        [
            ("friction", None, friction, gear.friction),
            ("hysteresis_loss", None, loss, rolling.hysteresis_loss),
            ("lubricant_drag", Some("N"), drag, rolling.lubricant_drag),
            ("clearance", Some("m"), gap, gear.clearance.gap()),
            (
                "reversal_speed",
                Some("rad/s"),
                reversal,
                gear.reversal_speed,
            ),
        ],
    );
}

fn limits(l: &mut Vec<Variable>, limits: &Limits) {
    let Limits {
        nut_speed,
        axial_load,
        friction_torque,
    } = *limits;
    let speed = "largest nut speed that is believed, 1e-3 to 1e6";
    let load = "largest axial load that is believed, 1e-3 to 1e7";
    let torque = "largest friction torque output, 1e-6 to 1e6";
    list(
        l,
        [
            ("limits.nut_speed", Some("rad/s"), speed, nut_speed),
            ("limits.axial_load", Some("N"), load, axial_load),
            (
                "limits.friction_torque",
                Some("N.m"),
                torque,
                friction_torque,
            ),
        ],
    );
}

fn row(l: &mut Vec<Variable>, train: &UncagedDesign) {
    let friction = "Coulomb friction coefficient of ball and ball, 0 to 1";
    let turns = "turns of the loaded track, 0.1 to 10";
    list(
        l,
        [
            ("ball_friction", None, friction, train.ball_friction),
            ("turns", None, turns, train.turns),
            (
                "return_length",
                Some("m"),
                "length of the return, 0 to 10",
                train.return_length,
            ),
        ],
    );
}

fn geometry(l: &mut Vec<Variable>, screw: &BallScrewParameters) {
    let pitch = "radius of the cylinder on which the ball centres run, 1e-3 to 0.5";
    let lead =
        "axial travel in one turn, from the ball diameter to 0.2; a lead angle up to 60 degrees";
    let ball = "ball radius, 1e-4 to 0.05; 0.01 to 0.5 pitch radii";
    let angle = "nominal contact angle, 0.01 to 1.5533";
    list(
        l,
        [
            ("pitch_radius", Some("m"), pitch, screw.pitch_radius),
            ("lead", Some("m"), lead, screw.lead),
            ("ball_radius", Some("m"), ball, screw.ball_radius),
        ],
    );
    SCREW.list(l, screw.screw_groove);
    NUT.list(l, screw.nut_groove);
    list(
        l,
        [("contact_angle", Some("rad"), angle, screw.contact_angle)],
    );
    BALL.list(l, &screw.ball_material);
    GROOVE.list(l, &screw.groove_material);
}

fn caged(l: &mut Vec<Variable>, design: &Design) {
    let tangent = "lever arm of rolling friction over ball_radius sin(contact_angle), 0 to 0.1; for the closed forms alone";
    list(
        l,
        [("rolling_tangent", None, tangent, design.rolling_tangent)],
    );
    let branch = match design.branch {
        None => 0.0,
        Some(FrictionBranch::Sliding) => 2.0,
        Some(_) => 1.0,
    };
    l.push(parameter(
        Kind::Choice(Choice::Branch),
        "branch",
        None,
        "which state of a ball friction is computed for",
        branch,
    ));
    l.push(parameter(
        Kind::Int32,
        "loaded_balls",
        None,
        "balls that carry load, 1 to 1000",
        design.caged.loaded_balls.into(),
    ));
}

pub fn changed_screw(
    design: &Design,
    scene: SceneName,
    values: &Values<'_>,
) -> Result<Design, String> {
    let as_in = design.screw().parameters();
    let parameters = BallScrewParameters {
        pitch_radius: values.single("pitch_radius"),
        lead: values.single("lead"),
        ball_radius: values.single("ball_radius"),
        screw_groove: SCREW.of(values, as_in.screw_groove),
        nut_groove: NUT.of(values, as_in.nut_groove),
        contact_angle: values.single("contact_angle"),
        ball_material: BALL.of(values),
        groove_material: GROOVE.of(values),
    };
    let screw =
        BallScrew::new(parameters).map_err(|error| named(&error, &parameters.ball_material))?;
    Given::default().plausible(&parameters)?;
    let fits = Fits {
        clearance: Some(values.single("clearance")),
        ..Fits::default()
    };
    // A preload is one of a contact here: how many balls share the load changes nothing.
    let clearance = fits.of(&screw, Some(1), &design.caged.limits)?;
    let mut changed = design.clone();
    let caged = &mut changed.caged;
    caged.design = screw;
    caged.friction = values.single("friction");
    caged.rolling_resistance.hysteresis_loss = values.single("hysteresis_loss");
    caged.rolling_resistance.lubricant_drag = values.single("lubricant_drag");
    caged.clearance = clearance;
    caged.reversal_speed = values.single("reversal_speed");
    caged.limits.nut_speed = values.single("limits.nut_speed");
    caged.limits.axial_load = values.single("limits.axial_load");
    caged.limits.friction_torque = values.single("limits.friction_torque");
    if scene.has_row() {
        changed_row(&mut changed, values)?;
    } else {
        changed.rolling_tangent = values.single("rolling_tangent");
        changed.branch = match values.within("branch", 0.0, 2.0)? {
            1.0 => Some(FrictionBranch::Rolling),
            2.0 => Some(FrictionBranch::Sliding),
            _ => None,
        };
        changed.caged.loaded_balls = values.within("loaded_balls", 1.0, 1000.0)? as u16;
    }
    Ok(changed)
}

fn changed_row(design: &mut Design, values: &Values<'_>) -> Result<(), String> {
    let caged = design.caged;
    if let Some(train) = &mut design.uncaged {
        train.gear = caged;
        train.ball_friction = values.single("ball_friction");
        train.turns = values.single("turns");
        plausible::turns(train.turns)?;
        train.return_length = values.single("return_length");
    }
    Ok(())
}
