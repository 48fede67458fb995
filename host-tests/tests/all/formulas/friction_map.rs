//! Friction of one contact: the library's maps against quadrature and against tabulated cases.

use epas_friction::contact::FrictionMap;
use epas_reference::friction::maps;
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::measured;

fn offsets() -> Vec<f32> {
    let inside = (0..=100).map(|step| step as f32 / 100.0);
    let outside = (0..=160).map(|step| 1.0 + 10_f32.powf(-4.0 + step as f32 / 20.0));
    inside
        .chain(outside)
        .flat_map(|offset| [offset, -offset])
        .collect()
}

#[test]
fn maps_equal_the_contact_integral() {
    let mut all = <[Errors; 3]>::default();
    for axis_ratio in [
        0.05_f32,
        0.08,
        0.12,
        0.18,
        0.232_146_37,
        0.3,
        0.4,
        0.5,
        0.65,
        0.8,
        0.95,
        1.0,
    ] {
        let map = FrictionMap::new(axis_ratio).unwrap();
        let integral = maps::FrictionMap::new(axis_ratio.into()).unwrap();
        let full_moment = integral.at(0.0).moment;
        let mut errors = <[Errors; 3]>::default();
        let mut inside = 0.0_f64;
        for offset in offsets() {
            let exact = integral.at(offset.into());
            let exact = [exact.force, exact.moment, exact.power];
            let fast = map.evaluate(offset);
            // Power grows with the offset: its error is taken relative to it outside the contact.
            let scale = f64::from(offset.abs()).max(1.0);
            let error = [
                f64::from(fast.force) - exact[0],
                (f64::from(fast.moment) - exact[1]) / full_moment,
                (f64::from(fast.power) - exact[2]) / scale,
            ];
            for ((sum, total), error) in errors.iter_mut().zip(&mut all).zip(error) {
                sum.add(error);
                total.add(error);
            }
            if offset.abs() <= 1.0 {
                inside = error.iter().fold(inside, |max, e| max.max(e.abs()));
            }
            // Documented, see below. Measured: 7.8e-4, 1.7e-3 and 2.4e-4.
            assert!(
                error[0].abs() <= 1e-3 && error[1].abs() <= 2e-3 && error[2].abs() <= 1e-3,
                "axis_ratio {axis_ratio} offset {offset}: {fast:?}, exact {exact:?}"
            );
        }
        // The quartic is exact: what is left are roundings (6e-8 each) of terms up to 1.5.
        measured::assert_at("friction map inside the contact", inside, axis_ratio);
    }
    // Documented errors of the maps: the two-term expansion outside the contact, continuous at its rim, is
    // chosen for its cost within 1e-3, 2e-3 and 1e-3.
    let [mut force, mut moment, mut power] = all;
    force.assert_promised(promises::of("friction_map"));
    force.name = "friction map, force".into();
    moment.name = "friction map, moment".into();
    power.name = "friction map, power".into();
    for errors in [force, moment, power] {
        errors.assert_measured();
    }
}

#[test]
fn power_is_force_times_offset_and_moment() {
    let map = FrictionMap::new(0.2321).unwrap();
    for offset in offsets() {
        let friction = map.evaluate(offset);
        assert_eq!(friction.force, map.force(offset));
        assert_eq!(friction.moment, map.moment(offset));
        assert_eq!(friction.power, map.power(offset));
        let sum = offset * friction.force + friction.moment;
        // Derived: a product, a sum and the power itself are rounded, 6e-8 each of at most the power.
        assert!(
            (friction.power - sum).abs() <= 2e-7 * friction.power,
            "{offset}"
        );
    }
    assert_eq!(map.force(f32::NEG_INFINITY), -1.0);
    assert_eq!(map.force(f32::INFINITY), 1.0);
}

#[test]
fn an_axis_ratio_out_of_range_is_named() {
    for axis_ratio in [0.0, 0.009, 1.001, f32::NAN, f32::INFINITY, -0.2] {
        let error = FrictionMap::new(axis_ratio).unwrap_err();
        assert_eq!(error.field(), "axis_ratio");
    }
}
