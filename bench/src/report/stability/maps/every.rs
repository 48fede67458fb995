//! Every map: which formula, over which of its inputs.

use epas_eval::groove_curvature::Groove;

use super::requests::{
    dynamic, efficiency, ellipse, friction, groove, hugging, kinematics, linear, power, rising_row,
};
use super::sample::{Numbers, ask};
use super::{Map, PLAIN};

/// The first of a list; none where there is none.
fn first(list: Option<&Vec<f64>>) -> Option<f64> {
    list?.first().copied()
}

/// Every map.
pub const MAPS: [Map; 18] = [
    Map {
        title: "first curvature of the nut, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        at: |contact, lead| {
            ask(&groove(Groove::Nut, contact, lead, 1.0), |f, r| {
                Numbers::of(f.kappa1, r.kappa1).over(r.kappa2)
            })
        },
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the screw, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        at: |contact, lead| {
            ask(&groove(Groove::Screw, contact, lead, 1.0), |f, r| {
                Numbers::of(f.kappa1, r.kappa1).over(r.kappa2)
            })
        },
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "fitted curvature of the nut, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        at: |contact, lead| {
            ask(&groove(Groove::Nut, contact, lead, 1.0), |f, r| {
                Numbers::of(f.fitted, r.kappa1).over(r.kappa2)
            })
        },
        value: ("/fitted", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("fitted_curvature"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the screw until it folds",
        x: ("conformity", 0.5, 1.0),
        y: ("ball ratio", 0.0, 1.0),
        at: |conformity, ratio| {
            ask(&hugging(conformity, ratio), |f, r| {
                Numbers::of(f.kappa1, r.kappa1).over(r.kappa1)
            })
        },
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa1"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the nut, nm to km",
        x: ("log10 of all lengths over 10 mm", -7.0, 5.0),
        y: ("contact angle (deg)", 0.0, 90.0),
        at: |scale, contact| {
            ask(&groove(Groove::Nut, contact, 10.0, power(scale)), |f, r| {
                Numbers::of(f.kappa1, r.kappa1).over(r.kappa2)
            })
        },
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "sliding efficiency, absolute, up to the lock",
        x: ("friction", 0.0, 1.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        at: |friction, lead| {
            ask(&efficiency(friction, lead, 45.0, 0.2), |f, r| {
                Numbers::of(f.sliding_drive, r.sliding_drive).unless(r.locked_drive)
            })
        },
        value: ("/sliding_drive", "/sliding_drive"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "back-driving efficiency, absolute, from the lock",
        x: ("friction", 0.0, 1.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        at: |friction, lead| {
            ask(&efficiency(friction, lead, 45.0, 0.2), |f, r| {
                Numbers::of(f.sliding_backdrive, r.sliding_backdrive).unless(r.locked_backdrive)
            })
        },
        value: ("/sliding_backdrive", "/sliding_backdrive"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "loss 1 - efficiency, relative, up to the lock",
        x: ("log10 of the friction", -7.0, 0.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        at: |friction, lead| {
            ask(&efficiency(power(friction), lead, 45.0, 0.2), |f, r| {
                Numbers::of(f.loss_drive, r.loss_drive)
                    .over(r.loss_drive)
                    .unless(r.locked_drive)
            })
        },
        value: ("/loss_drive", "/loss_drive"),
        over: Some("/loss_drive"),
        ..PLAIN
    },
    Map {
        title: "rolling efficiency, absolute, where driving does not lock",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("ball ratio", 0.0, 1.0),
        at: |contact, ratio| {
            ask(&efficiency(0.1, 10.0, contact, ratio), |f, r| {
                Numbers::of(f.rolling_screw, r.rolling_screw).unless(r.locked_drive)
            })
        },
        value: ("/rolling_screw", "/rolling_screw"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "efficiency with the dynamic correction, absolute",
        x: ("speed (rad/s)", 0.0, 500.0),
        y: ("log10 of the load of a ball (N)", 0.0, 6.0),
        at: |speed, load| {
            ask(&dynamic(speed, power(load)), |f, r| {
                Numbers::of(f.efficiency, r.efficiency)
            })
        },
        value: ("/efficiency", "/efficiency"),
        ..PLAIN
    },
    Map {
        title: "rolling slip over the entrainment speed",
        x: ("lead angle (deg)", -68.0, 68.0),
        y: ("contact angle (deg)", -90.0, 90.0),
        at: |lead, contact| {
            ask(&kinematics(lead, contact, 40.0, 100.0), |f, r| {
                Numbers::of(f.screw.rolling_slip, r.screw.rolling_slip)
                    .over(r.screw.entrainment_speed)
            })
        },
        value: ("/screw/rolling_slip", "/screw/rolling_slip"),
        over: Some("/screw/entrainment_speed"),
        promise: Some("kinematics"),
        ..PLAIN
    },
    Map {
        // Subnormal numbers have fewer digits, down to one.
        title: "orbital speed, relative, smallest normal speeds to 1e6",
        x: ("log10 of the speed (rad/s)", -36.0, 6.0),
        y: ("pitch angle (deg)", -90.0, 90.0),
        at: |speed, pitch| {
            ask(&kinematics(10.0, 45.0, pitch, power(speed)), |f, r| {
                Numbers::of(f.orbital_speed, r.orbital_speed).over(r.orbital_speed)
            })
        },
        value: ("/orbital_speed", "/orbital_speed"),
        over: Some("/orbital_speed"),
        ..PLAIN
    },
    Map {
        title: "semi-major axis, relative",
        x: ("log10 of the ratio of the radii", 0.0, 4.99),
        y: ("log10 of the load (N)", -3.0, 6.0),
        at: |ratio, load| {
            ask(
                &ellipse(power(ratio), power(load), 2.5e-3, 1.139e11),
                |f, r| Numbers::of(f.semi_major, r.semi_major).over(r.semi_major),
            )
        },
        value: ("/semi_major", "/semi_major"),
        over: Some("/semi_major"),
        promise: Some("hertz"),
        ..PLAIN
    },
    Map {
        title: "largest pressure, relative, nm to km",
        x: ("log10 of the radius (m)", -9.0, 3.0),
        y: ("log10 of the contact modulus (Pa)", 5.0, 14.0),
        at: |radius, modulus| {
            ask(
                &ellipse(8.0, 100.0, power(radius), power(modulus)),
                |f, r| Numbers::of(f.max_pressure, r.max_pressure).over(r.max_pressure),
            )
        },
        value: ("/max_pressure", "/max_pressure"),
        over: Some("/max_pressure"),
        promise: Some("hertz"),
        ..PLAIN
    },
    Map {
        title: "friction force over mu F",
        x: ("axis ratio", 0.05, 1.0),
        y: ("log10 of the offset c/a", -2.0, 2.0),
        at: |ratio, offset| {
            ask(&friction(ratio, power(offset)), |f, r| {
                Numbers::of(f.force, r.force)
            })
        },
        value: ("/force", "/force"),
        promise: Some("friction_map"),
        ..PLAIN
    },
    Map {
        title: "moment of slender contacts over mu F a",
        x: ("log10 of the axis ratio", -2.0, 0.0),
        y: ("log10 of the offset c/a", -9.0, 9.0),
        at: |ratio, offset| {
            ask(&friction(power(ratio), power(offset)), |f, r| {
                Numbers::of(f.moment, r.moment)
            })
        },
        value: ("/moment", "/moment"),
        ..PLAIN
    },
    Map {
        title: "speed of a linear ball, closed form, over v/2",
        x: ("side force over normal force", -1.0, 1.0),
        y: ("deviation (deg)", -3.0, 3.0),
        at: |side, degrees| {
            ask(&linear([(degrees, side)]), |f, r| {
                Numbers::of(
                    first(f.analytic.speed_deviation.as_ref()),
                    first(r.speed_deviation.as_ref()),
                )
            })
        },
        value: ("/analytic/speed_deviation/0", "/speed_deviation/0"),
        promise: Some("analytic_ball"),
        ..PLAIN
    },
    Map {
        title: "force between the rear two of a row of linear balls, relative",
        x: ("balls", 2.0, 64.0),
        y: ("deviation (deg)", 0.5, 3.0),
        at: |balls, degrees| {
            ask(&rising_row(balls, degrees), |f, r| {
                Numbers::of(
                    first(f.scene.contact_force.as_ref()),
                    first(r.contact_force.as_ref()),
                )
                .over(first(r.contact_force.as_ref()))
            })
        },
        value: ("/scene/contact_force/0", "/contact_force/0"),
        over: Some("/contact_force/0"),
        fineness: 0.25,
        ..PLAIN
    },
];
