//! What to take for a ball screw of which nothing has been measured: friction coefficient, clearance, rolling
//! resistance, lubricant.
//!
//! Set-up: numbers for a configuration. No drawing prints them, and they decide a screw's friction: at 14.5 kN the
//! screw of 37 balls (33x20) has 0.8 to 5 N m between the friction coefficients 0.05 and 0.15, and 3.2 to 1.2 N m
//! between 5 um of oversize and 20 um of play (friction 0.1). Whoever has a measured torque should fit the friction
//! coefficient to it.
//!
//! With the first three, all of the exact model (slip, spin, every contact that carries, rolling resistance):
//!
//! | | computed | makers print |
//! |---|---|---|
//! | efficiency 125x10, 29x7, 33x20 at 100 N a ball | 0.81, 0.89, 0.95 | 0.82, 0.93, 0.97 in theory, 0.9 of it in practice |
//! | efficiency at diameter 32, leads 6 to 64, 100 N a ball | 0.88 rising to 0.96 | 0.91 to 0.99 in theory |
//! | efficiency over load | rises | rises |
//! | drag torque of two braced nuts | 0.92 to 1.04 of the rule | 0.05 (tan lead angle)^-1/2 preload lead/2 pi |
//!
//! The report's section "Measured and computed" has the figures, their sources and what other values would do. Wipers,
//! seals and the balls' return are not in them.

use crate::ball::Clearance;
use crate::contact::RollingResistance;
use crate::law::coefficient::{CoefficientParameters, Viscosity};

/// Coulomb friction coefficient of ball and groove: 0.1.
///
/// The one number here that is fitted: with it the drag torque of two braced nuts is that of the rule of JIS B 1192
/// (within 8 %); a measured pair of screws means 0.09 to 0.16, by their assumed diameter.
///
/// Range in the literature: 0.02 to 0.2 assumed in models, 0.05 to 0.15 for boundary-lubricated steel. Lin 2019 takes
/// 0.1.
pub const FRICTION: f32 = 0.1;

/// Clearance: a radial gap of every contact of -1 um, that is 1 um of oversize.
///
/// Steering gears and machine tools are built without play. A micrometre of oversize is the least preload that a maker
/// can set by sorting balls; it makes efficiency rise with load, as is measured, and keeps the friction of the makers'
/// rule down to small leads, where a ball that just fits loses its third contact. It costs some 0.12 N m without load
/// in a steering gear's screw (29x7, 71 balls).
///
/// Range: 5 um of oversize (heavily preloaded) to 20 um of play.
pub const CLEARANCE: Clearance = match Clearance::new(-1e-6) {
    Ok(clearance) => clearance,
    Err(_) => Clearance::ZERO,
};

/// Rolling resistance: steel, without lubricant drag.
///
/// Hysteresis is about 1 % of a screw's friction. Drag is zero because it depends on grease, temperature and speed:
/// with a viscosity of 0.1 Pa s it is 0.006 N a contact at 1 turn a second and 0.041 N at 20, which are 1 % and 8 % of
/// a loaded screw's friction.
pub const ROLLING_RESISTANCE: RollingResistance = RollingResistance::STEEL;

/// Viscosity of a base oil of class VG 100, as in greases of ball screws: 0.088 Pa s at 40 degrees Celsius, 0.0095 at 100,
/// flowing down to -45.
///
/// ISO 3448 sets 90 to 110 mm²/s at 40 degrees; data sheets print 11 to 15 at 100. The formula's pole is at -67 degrees.
pub const VISCOSITY: Viscosity = match Viscosity::through((313.15, 0.088), (373.15, 0.0095), 228.15)
{
    Ok(viscosity) => viscosity,
    Err(_) => panic!("the viscosity of the default lubricant is out of range"),
};

/// Friction coefficient by speed and temperature: 0.12 at standstill, 0.05 on a full film, half-way at 4.9 rad/s of the nut and
/// 20 degrees Celsius, both directions alike, no churning.
///
/// Assumed, not measured. 0.12 is the middle of boundary-lubricated steel (0.1 to 0.15), 0.05 a usual traction of a rolling
/// contact's film (0.03 to 0.07). The speed is that of a film as thick as 0.41 of a roughness of 0.15 um, by Hamrock and Dowson
/// 1977, in the screw of Lin 2019, Table 4.1, under 1 kN, with [`VISCOSITY`]; for another one it goes with 1/(viscosity x pitch
/// radius) and with roughness to the power of 3/2. Whoever has torques at two speeds and two temperatures should fit it.
pub const COEFFICIENT: CoefficientParameters = CoefficientParameters {
    boundary: 0.12,
    full_film: 0.05,
    half_share_speed: 4.9,
    reference_temperature: 293.15,
    viscosity: VISCOSITY,
    forward: 1.0,
    backward: 1.0,
    churning: 0.0,
};
