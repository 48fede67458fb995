//! Rolling resistance: the crate against the reference.

use epas_friction::contact::{RollingContact, RollingResistance};
use epas_friction::geometry::Groove;
use epas_friction::{BallScrew, CATALOGUE, DISSERTATION_DESIGNS, Error, defaults, math};
use epas_reference::curvature;
use epas_reference::friction::rolling_resistance as exact;
use epas_testkit::errors::Errors;
use epas_testkit::given;

const RESISTANCE: RollingResistance = RollingResistance {
    hysteresis_loss: 0.007,
    lubricant_drag: 0.02,
};

/// All designs, both grooves, 1 to 1000 N, each part and their sum. The contact ellipse is within 1e-5, the load's cube
/// root to the fourth within 2e-7; the sum of both parts errs less than the worse of them.
#[test]
fn the_crate_follows_the_reference() {
    let mut hysteresis = Errors::of("rolling resistance, hysteresis");
    let mut lubricant = Errors::of("rolling resistance, lubricant");
    let mut both = Errors::of("rolling resistance, both");
    let sizes = CATALOGUE.iter().map(|size| (size.name, size.parameters()));
    let printed = DISSERTATION_DESIGNS
        .iter()
        .map(|design| (design.name, design.parameters));
    for (name, parameters) in sizes.chain(printed) {
        let design = BallScrew::new(parameters).unwrap();
        let reference = given::ball_screw(&parameters);
        for (groove, side) in [
            (Groove::Screw, curvature::Groove::Screw),
            (Groove::Nut, curvature::Groove::Nut),
        ] {
            let ellipse = reference.contact(side).unwrap();
            let [radius, _] = exact::relative_radii(&reference, side).unwrap();
            for step in 0..=40 {
                let load = 1000_f32.powf(step as f32 / 40.0);
                let of = |resistance: RollingResistance| {
                    let contact = RollingContact::of(&design, groove, resistance).unwrap();
                    f64::from(contact.force(load, math::cbrt(load)))
                };
                let model = exact::RollingResistance {
                    hysteresis_loss: RESISTANCE.hysteresis_loss.into(),
                    lubricant_drag: RESISTANCE.lubricant_drag.into(),
                };
                let load64 = f64::from(load);
                let first = model.hysteresis_force(load64, ellipse.at(load64).semi_minor, radius);
                let second = model.lubricant_force(load64);
                let line = || format!("{name} {groove:?} {load} N");
                let dry = RollingResistance {
                    lubricant_drag: 0.0,
                    ..RESISTANCE
                };
                let soft = RollingResistance {
                    hysteresis_loss: 0.0,
                    ..RESISTANCE
                };
                hysteresis.add_case(of(dry) / first - 1.0, line);
                lubricant.add_case(of(soft) / second - 1.0, line);
                both.add_case(of(RESISTANCE) / (first + second) - 1.0, line);
            }
        }
    }
    // Hysteresis has the error of the ellipse's semi-axes. The lubricant's part is a constant of two roundings, which is a bias, a
    // root and two more roundings of 2^-24.
    for errors in [hysteresis, lubricant, both] {
        errors.assert_measured();
    }
}

/// Power is force times speed, and one whole ball's power is that of the reference with the reference's own loads and speeds.
#[test]
fn a_balls_power_is_that_of_the_reference() {
    use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
    let parameters = DISSERTATION_DESIGNS[2].parameters;
    let design = BallScrew::new(parameters).unwrap();
    let reference = given::ball_screw(&parameters);
    let contacts = [Groove::Screw, Groove::Nut]
        .map(|groove| RollingContact::of(&design, groove, RESISTANCE).unwrap());
    let path = reference
        .pitch_radius
        .hypot(reference.lead / std::f64::consts::TAU);
    for (clearance, load) in [(-2e-6, 20.0), (0.0, 100.0), (5e-6, -300.0)] {
        let found = LoadedScrew {
            design: reference,
            clearance,
            friction: 0.1,
            rolling: exact::RollingResistance {
                hysteresis_loss: RESISTANCE.hysteresis_loss.into(),
                lubricant_drag: RESISTANCE.lubricant_drag.into(),
            },
            balls: 1.0,
            axial_load: load,
        }
        .solve()
        .unwrap();
        let torque: f32 = found
            .ball
            .motion
            .contacts
            .iter()
            .map(|friction| {
                let contact = friction.contact;
                let nut = contact.groove.on_nut();
                let past = found.ball.motion.orbital_speed - if nut { 1.0 } else { 0.0 };
                let reach = reference.lead_angle().cos()
                    * reference.ball_radius
                    * if nut { 1.0 } else { -1.0 }
                    * contact.contact_angle.cos();
                let load = contact.load as f32;
                let speed = (past.abs() * (path + reach)) as f32;
                contacts[usize::from(nut)].power(load, math::cbrt(load), speed)
            })
            .sum();
        let exact = found.hysteresis + found.lubricant;
        assert!(
            (f64::from(torque) / exact - 1.0).abs() < 6e-7,
            "{torque} {exact}"
        );
    }
}

#[test]
fn defaults_are_valid() {
    const STEEL: Result<RollingResistance, Error> = defaults::ROLLING_RESISTANCE.checked();
    assert_eq!(STEEL, Ok(RollingResistance::STEEL));
    assert!(epas_friction::ranges::FRICTION_OF_A_ROW.contains(defaults::FRICTION));
    assert_eq!(defaults::CLEARANCE.gap(), -1e-6);
}
