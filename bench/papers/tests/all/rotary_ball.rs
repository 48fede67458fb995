//! Four-point rotary bearing: Tables 3.1 and 3.2, stored cases, Hertz constants, and the laws of the Coulomb model.

use epas_papers::rotary_ball::{RotaryBearing, RotaryContacts, RotaryConvention};
use epas_reference::ReferenceError;
use epas_reference::friction::contact_law::{Eccentricity, HertzLaw};
use epas_testkit::measured;
use serde_json::Value;

fn golden(name: &str) -> Value {
    let path = format!(
        "{}/../../host-tests/golden/{name}.json",
        env!("CARGO_MANIFEST_DIR")
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn list(value: &Value) -> [f64; 4] {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect::<Vec<_>>()
        .try_into()
        .unwrap()
}

/// Table 3.1.
fn bearing(convention: RotaryConvention) -> RotaryBearing {
    RotaryBearing {
        ball_radius: 0.00625,
        pitch_radius: 0.035,
        conformity: 0.54,
        contact_angle: std::f64::consts::FRAC_PI_4,
        youngs_modulus: 2.1e11,
        poisson_ratio: 0.28,
        convention,
    }
}

const INNER_SPEED: f64 = 20.0 * std::f64::consts::PI;

#[test]
fn stored_hertz_constants() {
    for case in golden("friction")["hertz"].as_array().unwrap() {
        let value = |key: &str| case[key].as_f64().unwrap();
        let law = HertzLaw::new(
            value("R1"),
            value("R2"),
            value("Estar"),
            Eccentricity::Exact,
        )
        .unwrap();
        for (one, stored) in [
            (law.ellipse.axis_ratio, value("k")),
            (law.ellipse.semi_major_constant, value("Ca")),
            (
                law.ellipse.semi_major_constant * law.ellipse.axis_ratio,
                value("Cb"),
            ),
            (law.compliance, value("Cd")),
        ] {
            measured::assert_at(
                "stored Hertz constants",
                one / stored - 1.0,
                format_args!("{one:e}, stored {stored:e}"),
            );
        }
        let psi = law.ellipse.semi_major_constant / value("RB").cbrt();
        measured::assert("stored Hertz constants", psi / value("Psi") - 1.0);
    }
    // Table B.1 with the dissertation's radii (eigenvalues of the second form alone) and F1 = 1; mm.
    let printed = &golden("ballscrew")["hertz"]["S_rG3.11136"]["printed"];
    let radii: Vec<_> = printed["R"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap() * 1e-3)
        .collect();
    let modulus = 2.1e11 / (2.0 * (1.0 - 0.28 * 0.28));
    let law = HertzLaw::new(radii[0], radii[1], modulus, Eccentricity::Ignored).unwrap();
    // Derived: four digits are printed, half a unit of the last is 1/(2 x 1812) = 2.76e-4, and so on.
    assert!(
        (law.compliance / 1.812e-7 - 1.0).abs() < 2.76e-4,
        "{:e}",
        law.compliance
    );
    assert!(
        (law.ellipse.semi_major_constant / 7.962e-5 - 1.0).abs() < 6.3e-5,
        "{:e}",
        law.ellipse.semi_major_constant
    );
    let minor = law.ellipse.semi_major_constant * law.ellipse.axis_ratio;
    // Derived: 1/(2 x 1657).
    assert!((minor / 1.657e-5 - 1.0).abs() < 3.02e-4, "{minor:e}");
    assert!(HertzLaw::new(0.0, 1.0, 1e11, Eccentricity::Exact).is_err());
    assert!(HertzLaw::new(1.0, f64::NAN, 1e11, Eccentricity::Exact).is_err());
    // Derived: no root is sought for equal radii.
    let circle = HertzLaw::new(0.01, 0.01, 1e11, Eccentricity::Exact).unwrap();
    assert!((circle.ellipse.axis_ratio - 1.0).abs() < 1e-15);
}

#[test]
fn table_3_2_loads() {
    // Printed loads IL, IR, OR, OL at radial displacements of 0, 5.2 and 8.0 micrometres, 100 N axial.
    let printed = [
        (0.0, [140.4945, 0.0, 140.4945, 0.0]),
        (5.2e-6, [144.8352, 3.3582, 144.8371, 3.3643]),
        (8.0e-6, [188.5374, 46.8926, 188.5689, 46.9413]),
    ];
    for (lift, loads) in printed {
        let contacts = bearing(RotaryConvention::Dissertation)
            .contacts_under_load(100.0, lift)
            .unwrap();
        println!(
            "{lift:e}: {:?} {:?}",
            contacts.contact_forces,
            contacts.contact_angles.map(f64::to_degrees)
        );
        for (load, table) in contacts.contact_forces.iter().zip(loads) {
            // Half a unit of the last digit.
            assert!(
                (load - table).abs() < 5e-5,
                "at {lift} m: {load}, table {table}"
            );
        }
    }
}

#[test]
fn table_3_2_torques_and_stored_cases() {
    // Half a unit of the last digit, or less.
    let printed = [
        (2.4650e-3, 2.0e-8),
        (12.8769e-3, 5.0e-8),
        (33.6856e-3, 5.0e-8),
    ];
    for (case, (torque, bound)) in golden("friction")["rotary"]
        .as_array()
        .unwrap()
        .iter()
        .zip(printed)
    {
        let contacts = RotaryContacts {
            contact_angles: list(&case["beta"]),
            contact_forces: list(&case["F"]),
        };
        let one = bearing(RotaryConvention::Dissertation);
        let motion = one
            .motion_with_sigmoid(&contacts, 0.1, INNER_SPEED, 100.0)
            .unwrap();
        let name = case["case"].as_str().unwrap();
        println!(
            "{name}: {} N m, {} {} {}, residual {:e}",
            motion.friction_torque,
            motion.orbital_speed,
            motion.omega_x,
            motion.omega_y,
            motion.residual
        );
        assert!(
            (motion.friction_torque - torque).abs() < bound,
            "{name}: {}",
            motion.friction_torque
        );
        let value = |key: &str| case[key].as_f64().unwrap();
        measured::assert_at(
            "stored rotary cases, torque",
            motion.friction_torque / value("Mf") - 1.0,
            format_args!("{name}: torque {}", motion.friction_torque),
        );
        // Where a contact hardly spins, only the sigmoid's steepness shares the spin between the two contacts of a diagonal: a
        // change of 4e-5 in its argument shows in spins and powers, not in their sum. The stored cases I and II differ by
        // that much; the printed numbers are those computed here. Measured: 3.7e-4 rad/s and 1.4e-6 W; III: 8.5e-14 and 2.2e-16.
        let (spin_bound, power_bound) = if name == "III" {
            (3e-13, 7e-16)
        } else {
            (5e-4, 3e-6)
        };
        let printed = match name {
            "I" => (27.4754, -104.8742, 139.7872),
            "II" => (27.4469, -136.2569, 108.5585),
            _ => (27.4115, -242.2681, 1.6094),
        };
        // Four decimals. Measured: 5.2e-5, which is just above half a unit; case III, which rests on interpolated maps in the
        // dissertation, 4.4e-4.
        let digits = if name == "III" { 6e-4 } else { 6e-5 };
        assert!((motion.orbital_speed - printed.0).abs() < digits, "{name}");
        assert!(
            (motion.omega_x - printed.1).abs() < digits,
            "{name}: {}",
            motion.omega_x
        );
        assert!(
            (motion.omega_y - printed.2).abs() < digits,
            "{name}: {}",
            motion.omega_y
        );
        for (one, key) in [
            (motion.orbital_speed, "omega_B"),
            (motion.omega_x, "omega_x"),
            (motion.omega_y, "omega_y"),
        ] {
            assert!(
                (one - value(key)).abs() < spin_bound,
                "{name} {key}: {one}, stored {}",
                value(key)
            );
        }
        for (i, stored) in list(&case["P"]).iter().enumerate() {
            let c = motion.contacts[i];
            assert!(
                (c.power - stored).abs() < power_bound,
                "{name}: power {i} {}, stored {stored}",
                c.power
            );
            // Derived: a slip changes by the ball's radius times what its two rotations do.
            assert!(
                (c.slip - list(&case["V"])[i]).abs() < 2.0 * 0.00625 * spin_bound,
                "{name}: slip {i}"
            );
            assert!(
                (c.spin - list(&case["w"])[i]).abs() < spin_bound,
                "{name}: spin {i}"
            );
        }
        // The same from the loads of the model itself.
        let lift =
            [0.0, 5.2e-6, 8.0e-6][["I", "II", "III"].iter().position(|c| *c == name).unwrap()];
        let own = one.contacts_under_load(100.0, lift).unwrap();
        let again = one
            .motion_with_sigmoid(&own, 0.1, INNER_SPEED, 100.0)
            .unwrap();
        measured::assert(
            "rotary torque from its own loads",
            again.friction_torque / motion.friction_torque - 1.0,
        );
    }
}

/// Coulomb's law without the sigmoid: balance, energy, and the physical radii.
#[test]
fn coulomb_motion_balances() {
    for (lift, published) in [(0.0, 2.317e-3), (5.2e-6, 12.63e-3), (8.0e-6, 31.02e-3)] {
        let loads = bearing(RotaryConvention::Dissertation)
            .contacts_under_load(100.0, lift)
            .unwrap();
        let physical = bearing(RotaryConvention::Physical);
        let motion = physical.motion(&loads, 0.1, INNER_SPEED).unwrap();
        let sigmoid = physical
            .motion_with_sigmoid(&loads, 0.1, INNER_SPEED, 100.0)
            .unwrap();
        println!(
            "{lift:e}: {} N m, with the sigmoid {}",
            motion.friction_torque, sigmoid.friction_torque
        );
        measured::assert_at(
            "rotary torque by the physical radii",
            sigmoid.friction_torque / published - 1.0,
            format_args!("{}", sigmoid.friction_torque),
        );
        // The Coulomb model loses least.
        assert!(motion.friction_torque < sigmoid.friction_torque * 1.01);
        // Torque of the inner contacts on the ring against the losses.
        let mut along = 0.0;
        let mut torque = 0.0;
        for (i, c) in motion.contacts.iter().enumerate() {
            let (sin, cos) = loads.contact_angles[i].sin_cos();
            let (sx, sy) = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)][i];
            along += c.force;
            if sy < 0.0 {
                torque += c.force * (0.035 + sy * 0.00625 * cos) - c.moment * (-sx * sin);
            }
        }
        measured::assert_at(
            "rotary ball, force along the track in N",
            along,
            format_args!("{along:e}"),
        );
        measured::assert_at(
            "rotary ball, power balance",
            torque / motion.friction_torque - 1.0,
            format_args!("{torque} {}", motion.friction_torque),
        );
        // Mirrored: the same steps. Measured: 0.0 both; a unit of the last place is 3.6e-15 rad/s, and up to 3.5e-18 N m.
        let back = physical.motion(&loads, 0.1, -INNER_SPEED).unwrap();
        assert!((back.orbital_speed + motion.orbital_speed).abs() < 1.1e-14);
        assert!((back.friction_torque + motion.friction_torque).abs() < 1.1e-17);
    }
}

#[test]
fn bad_input_is_named() {
    let good = bearing(RotaryConvention::Physical);
    let contacts = good.contacts_under_load(100.0, 5e-6).unwrap();
    assert_eq!(
        good.motion(&contacts, 0.1, 0.0),
        Err(ReferenceError::Standstill)
    );
    assert!(good.motion(&contacts, -0.1, 1.0).is_err());
    assert!(good.motion(&contacts, 0.1, f64::NAN).is_err());
    assert!(good.contacts_under_load(-1.0, 0.0).is_err());
    assert!(
        RotaryBearing {
            conformity: 0.4,
            ..good
        }
        .contacts_under_load(1.0, 0.0)
        .is_err()
    );
    let empty = RotaryContacts {
        contact_forces: [0.0; 4],
        ..contacts
    };
    assert_eq!(good.motion(&empty, 0.1, 1.0), Err(ReferenceError::Undriven));
    assert_eq!(
        good.motion_with_sigmoid(&empty, 0.1, 1.0, 100.0),
        Err(ReferenceError::Undriven)
    );
    assert_eq!(
        good.motion(&contacts, 0.0, 1.0).unwrap().friction_torque,
        0.0
    );
    for load in [1e-6, 1.0, 1e5] {
        for lift in [-2e-5, 0.0, 8e-6, 5e-5] {
            let contacts = good
                .contacts_under_load(load, lift)
                .unwrap_or_else(|e| panic!("{load} N, {lift} m: {e}"));
            let axial: f64 = (0..2)
                .map(|i| {
                    contacts.contact_forces[i] * contacts.contact_angles[i].sin() * [1.0, -1.0][i]
                })
                .sum();
            let largest = contacts.contact_forces.iter().fold(load, |m, f| m.max(*f));
            measured::assert_at(
                "rotary ball, axial load",
                (axial - load) / largest,
                format_args!("{load} N, {lift} m: {axial}"),
            );
            for friction in [0.05, 0.3] {
                let motion = good
                    .motion(&contacts, friction, 10.0)
                    .unwrap_or_else(|e| panic!("{load} N, {lift} m: {e}"));
                assert!(motion.friction_torque.is_finite() && motion.friction_torque >= 0.0);
            }
        }
    }
}
