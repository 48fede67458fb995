//! Every map: which formula, over which of its inputs.

use epas_eval::groove_curvature::Groove::{Nut, Screw};

use super::requests::{
    dynamic, efficiency, ellipse, friction, groove, hugging, kinematics, linear, power, rising_row,
};
use super::sample::ask;
use super::{Axis, Map, map};

const CONTACT: Axis = ("contact angle (deg)", 0.0, 90.0);
const LEAD: Axis = ("lead angle (deg)", 0.0, 90.0);
const DRIVEN_LEAD: Axis = ("lead angle (deg)", 0.0, 85.0);
const FRICTION: Axis = ("friction", 0.0, 1.0);
const RATIO: Axis = ("ball ratio", 0.0, 1.0);

/// Every map: title, axes, what is asked at a point; number of both sides and what its error is over ("" for an absolute one); promise.
#[rustfmt::skip]
pub const MAPS: [Map; 18] = [
    map("first curvature of the nut, over the second", CONTACT, LEAD,
        |contact, lead| ask(&groove(Nut, contact, lead, 1.0)), ["/kappa1", "/kappa1", "/kappa2"], "gothic_arch"),
    map("first curvature of the screw, over the second", CONTACT, LEAD,
        |contact, lead| ask(&groove(Screw, contact, lead, 1.0)), ["/kappa1", "/kappa1", "/kappa2"], "gothic_arch"),
    map("fitted curvature of the nut, over the second", CONTACT, LEAD,
        |contact, lead| ask(&groove(Nut, contact, lead, 1.0)), ["/fitted", "/kappa1", "/kappa2"], "fitted_curvature"),
    map("first curvature of the screw until it folds", ("conformity", 0.5, 1.0), RATIO,
        |conformity, ratio| ask(&hugging(conformity, ratio)), ["/kappa1"; 3], "gothic_arch"),
    map("first curvature of the nut, nm to km", ("log10 of all lengths over 10 mm", -7.0, 5.0), CONTACT,
        |scale, contact| ask(&groove(Nut, contact, 10.0, power(scale))), ["/kappa1", "/kappa1", "/kappa2"], "gothic_arch"),
    map("sliding efficiency, absolute, up to the lock", FRICTION, DRIVEN_LEAD,
        |friction, lead| ask(&efficiency(friction, lead, 45.0, 0.2)), ["/sliding_drive", "/sliding_drive", ""], "efficiency")
        .unless("/locked_drive"),
    map("back-driving efficiency, absolute, from the lock", FRICTION, DRIVEN_LEAD,
        |friction, lead| ask(&efficiency(friction, lead, 45.0, 0.2)), ["/sliding_backdrive", "/sliding_backdrive", ""], "efficiency")
        .unless("/locked_backdrive"),
    map("loss 1 - efficiency, relative, up to the lock", ("log10 of the friction", -7.0, 0.0), DRIVEN_LEAD,
        |friction, lead| ask(&efficiency(power(friction), lead, 45.0, 0.2)), ["/loss_drive"; 3], "")
        .unless("/locked_drive"),
    map("rolling efficiency, absolute, where driving does not lock", CONTACT, RATIO,
        |contact, ratio| ask(&efficiency(0.1, 10.0, contact, ratio)), ["/rolling_screw", "/rolling_screw", ""], "efficiency")
        .unless("/locked_drive"),
    map("efficiency with the dynamic correction, absolute", ("speed (rad/s)", 0.0, 500.0), ("log10 of the load of a ball (N)", 0.0, 6.0),
        |speed, load| ask(&dynamic(speed, power(load))), ["/efficiency", "/efficiency", ""], ""),
    map("rolling slip over the entrainment speed", ("lead angle (deg)", -68.0, 68.0), ("contact angle (deg)", -90.0, 90.0),
        |lead, contact| ask(&kinematics(lead, contact, 40.0, 100.0)),
        ["/screw/rolling_slip", "/screw/rolling_slip", "/screw/entrainment_speed"], "kinematics"),
    // Subnormal numbers have fewer digits, down to one.
    map("orbital speed, relative, smallest normal speeds to 1e6", ("log10 of the speed (rad/s)", -36.0, 6.0), ("pitch angle (deg)", -90.0, 90.0),
        |speed, pitch| ask(&kinematics(10.0, 45.0, pitch, power(speed))), ["/orbital_speed"; 3], ""),
    map("semi-major axis, relative", ("log10 of the ratio of the radii", 0.0, 4.99), ("log10 of the load (N)", -3.0, 6.0),
        |ratio, load| ask(&ellipse(power(ratio), power(load), 2.5e-3, 1.139e11)), ["/semi_major"; 3], "hertz"),
    map("largest pressure, relative, nm to km", ("log10 of the radius (m)", -9.0, 3.0), ("log10 of the contact modulus (Pa)", 5.0, 14.0),
        |radius, modulus| ask(&ellipse(8.0, 100.0, power(radius), power(modulus))), ["/max_pressure"; 3], "hertz"),
    map("friction force over mu F", ("axis ratio", 0.05, 1.0), ("log10 of the offset c/a", -2.0, 2.0),
        |ratio, offset| ask(&friction(ratio, power(offset))), ["/force", "/force", ""], "friction_map"),
    map("moment of slender contacts over mu F a", ("log10 of the axis ratio", -2.0, 0.0), ("log10 of the offset c/a", -9.0, 9.0),
        |ratio, offset| ask(&friction(power(ratio), power(offset))), ["/moment", "/moment", ""], ""),
    map("speed of a linear ball, closed form, over v/2", ("side force over normal force", -1.0, 1.0), ("deviation (deg)", -3.0, 3.0),
        |side, degrees| ask(&linear([(degrees, side)])), ["/analytic/speed_deviation/0", "/speed_deviation/0", ""], "analytic_ball"),
    map("force between the rear two of a row of linear balls, relative", ("balls", 2.0, 64.0), ("deviation (deg)", 0.5, 3.0),
        |balls, degrees| ask(&rising_row(balls, degrees)), ["/scene/contact_force/0", "/contact_force/0", "/contact_force/0"], "")
        .coarse(),
];
