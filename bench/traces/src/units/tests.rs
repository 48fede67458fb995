//! Names and units, known and refused.

use super::*;

#[test]
fn names_say_quantity_and_unit() {
    for (name, quantity, one) in [
        ("time", Quantity::Time, 1.0),
        ("time_ms", Quantity::Time, 1e-3),
        (
            "nut_position_deg",
            Quantity::Position(Part::Nut),
            PI / 180.0,
        ),
        ("motor_speed_rpm", Quantity::Speed(Part::Motor), PI / 30.0),
        ("position_um", Quantity::Position(Part::Plain), 1e-6),
        ("carriage_speed_mm_s", Quantity::Speed(Part::Carriage), 1e-3),
        ("motor_torque_mNm", Quantity::MotorTorque, 1e-3),
        ("motor_force", Quantity::MotorForce, 1.0),
        ("axial_load_kN", Quantity::Load, 1e3),
        ("rack_force", Quantity::Load, 1.0),
        ("temperature_C", Quantity::Temperature, 274.15),
        ("temperature_K", Quantity::Temperature, 1.0),
        ("reference_position_mm", Quantity::ReferencePosition, 1e-3),
    ] {
        let (found, unit) = heading(name).unwrap().unwrap();
        assert_eq!(found, quantity, "{name}");
        let value = unit.factor + unit.offset;
        assert!((value - one).abs() <= 1e-15 * one, "{name}: {value}");
    }
}

#[test]
fn other_names_are_left_alone_and_wrong_units_refused() {
    for name in [
        "gear",
        "",
        "steering_angle",
        "positions",
        "timer",
        "\u{e9}\u{e9}\u{e9}",
    ] {
        assert_eq!(heading(name), Ok(None), "{name}");
    }
    for (name, word) in [
        ("nut_position_counts", "counts of a turn"),
        ("nut_position_mm", "nut_position_deg"),
        ("carriage_position_deg", "carriage_position_mm"),
        ("motor_torque_Ncm", "motor_torque_mNm"),
        ("temperature_F", "temperature_C"),
        ("time_h", "time_ms"),
        (
            "nut_speed_rpm [rad/s]",
            "its name says rpm, and the brackets rad/s",
        ),
    ] {
        let message = heading(name).unwrap_err();
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn headings_may_have_brackets_and_capitals() {
    for (name, quantity, factor) in [
        ("Time (s)", Quantity::Time, 1.0),
        ("TIME [ms]", Quantity::Time, 1e-3),
        ("Nut speed [1/min]", Quantity::Speed(Part::Nut), TAU / 60.0),
        (
            "nut-position (\u{b0})",
            Quantity::Position(Part::Nut),
            PI / 180.0,
        ),
        ("axial_load[kN]", Quantity::Load, 1e3),
        ("side_load", Quantity::SideLoad, 1.0),
    ] {
        let (found, unit) = heading(name).unwrap().unwrap();
        assert_eq!((found, unit.factor), (quantity, factor), "{name}");
        assert_eq!(
            channel(name).unwrap().is_some(),
            name == "side_load",
            "{name}"
        );
    }
    assert_eq!(heading("axial_load_kN [kN]"), heading("axial_load_kN"));
    let message = heading("nut_speed (bar)").unwrap_err();
    assert!(message.contains("rad/s, deg/s, rpm"), "{message}");
}

#[test]
fn units_of_metadata_are_known_or_refused() {
    let motor = Quantity::Speed(Part::Motor);
    for (quantity, text, factor) in [
        (motor, "rpm", TAU / 60.0),
        (motor, "RPM", TAU / 60.0),
        (motor, "U/min", TAU / 60.0),
        (motor, "\u{b0}/s", PI / 180.0),
        (Quantity::Speed(Part::Carriage), "km/h", 1.0 / 3.6),
        (Quantity::MotorTorque, "N\u{b7}m", 1.0),
        (Quantity::MotorTorque, "N m", 1.0),
        (Quantity::Position(Part::Plain), "\u{b5}m", 1e-6),
        (Quantity::Temperature, "\u{b0}C", 1.0),
    ] {
        let unit = written(quantity, text).unwrap();
        assert_eq!(unit.factor, factor, "{text}");
    }
    for (quantity, text) in [
        (motor, "m/s"),
        (motor, "km/h"),
        (Quantity::MotorTorque, "MNm"),
        (Quantity::Load, "bar"),
        (Quantity::Temperature, "\u{b0}F"),
        (Quantity::Position(Part::Plain), "Mm"),
        (Quantity::Position(Part::Plain), ""),
    ] {
        assert!(written(quantity, text).is_err(), "{text}");
    }
}

#[test]
fn the_sign_of_a_zero_stays() {
    let (_, unit) = heading("axial_load").unwrap().unwrap();
    assert!(unit.si(-0.0).is_sign_negative());
}

#[test]
fn seconds_may_be_written_out() {
    for (text, one) in [
        ("rad/sec", 1.0),
        ("deg/sec", PI / 180.0),
        ("\u{b0}/sec", PI / 180.0),
        ("m/sec", 1.0),
        ("mm/sec", 1e-3),
    ] {
        let unit = written(Quantity::Speed(Part::Plain), text).unwrap();
        assert_eq!(unit.factor, one, "{text}");
    }
    let (quantity, _) = heading("timestamps").unwrap().unwrap();
    assert_eq!(quantity, Quantity::Time);
}
