//! Numbers for a configuration where nothing has been measured: friction coefficient, clearance, rolling resistance, lubricant and its drag.
//!
//! They decide a screw's friction: at 14.5 kN the screw of 37 balls (33x20) has 0.8 to 5 N m between the friction coefficients 0.05 and 0.15, and 3.2 to
//! 1.2 N m between 5 um of oversize and 20 um of play (friction 0.1). With a measured torque, fit the friction coefficient to it.
//!
//! With the first three, all of the exact model (slip, spin, every contact that carries, rolling resistance):
//!
//! | | computed | makers print |
//! |---|---|---|
//! | efficiency 125x10, 29x7, 33x20 at 100 N a ball | 0.81, 0.89, 0.95 | 0.82, 0.93, 0.97 in theory, 0.9 of it in practice |
//! | efficiency at diameter 32, leads 6 to 64, 100 N a ball | 0.88 rising to 0.96 | 0.91 to 0.99 in theory |
//! | efficiency over load | rises | rises |
//! | drag torque of two braced nuts, 35 N a contact | 0.92 to 1.04 of the rule | 0.05 (tan lead angle)^-1/2 preload lead/2 pi |
//!
//! `bench/measured.md` judges the makers' rules by friction torque. Wipers, seals and the balls' return are not in them.

use crate::ball::Clearance;
use crate::contact::RollingResistance;
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, DISSERTATION_DESIGNS, NamedDesign};
use crate::law::coefficient::{CoefficientParameters, RollingDrag, Viscosity};

/// Coulomb friction coefficient of ball and groove, the one number here that is fitted: with it the drag torque of two braced nuts is that of the rule
/// of JIS B 1192 (within 8 %); a measured pair of screws means 0.09 to 0.16, by their assumed diameter.
///
/// In the literature: 0.02 to 0.2 assumed in models (Lin 2019: 0.1), 0.05 to 0.15 for boundary-lubricated steel.
pub const FRICTION: f32 = 0.1;

/// Clearance: 1 um of oversize at every contact, the least preload that sorting balls can set; it makes efficiency rise with load, as is measured, and
/// costs some 0.12 N m without load in a steering gear's screw (29x7, 71 balls). From 5 um of oversize (heavily preloaded) to 20 um of play.
pub const CLEARANCE: Clearance = match Clearance::new(-1e-6) {
    Ok(clearance) => clearance,
    Err(_) => Clearance::ZERO,
};

/// Rolling resistance: steel, about 1 % of a screw's friction, without lubricant drag, which a scene with memory has ([`DRAG`]).
pub const ROLLING_RESISTANCE: RollingResistance = RollingResistance::STEEL;

/// Viscosity of a mineral base oil of class VG 100, as in greases of machine tools' ball screws: 0.088 Pa s at 40 degrees Celsius,
/// 0.0095 at 100, flowing down to -45 (ISO 3448: 90 to 110 mm²/s at 40 degrees; data sheets: 11 to 15 at 100).
pub const VISCOSITY: Viscosity = match Viscosity::through((313.15, 0.088), (373.15, 0.0095), 228.15)
{
    Ok(viscosity) => viscosity,
    Err(_) => panic!("the viscosity of the mineral oil is out of range"),
};

/// Viscosity of the base oil of a steering gear's grease: a poly-alpha-olefin of 48 mm²/s at 40 degrees Celsius and 8 at 100.
///
/// Assumed, not measured on a gear: patents on greases for rack-assisted steering ask for base oils of 4 to 100 mm²/s at 40 degrees (Kyodo Yushi,
/// US 2023/0139040). For this class at -40 degrees 19,000 mm²/s, density 833 kg/m³; the formula is led through -40 and 40 degrees (16.4 and
/// 0.0393 Pa s), because the cold decides the drag.
pub const STEERING_GREASE: Viscosity =
    match Viscosity::through((233.15, 16.4), (313.15, 0.0393), 225.15) {
        Ok(viscosity) => viscosity,
        Err(_) => panic!("the viscosity of the default grease is out of range"),
    };

/// Share of the lubricant drag of flooded contacts that a film of grease leaves.
///
/// Between flooded contacts, a meniscus many contact widths ahead (Biboulet and Houpert 2010), and moderately starved ones, three
/// widths (Houpert 1987), lies a factor of 0.6 to 0.7; balls with two drops of oil had both (Balan, Houpert, Tufescu and Olaru 2015).
pub const FLOODING: f32 = 0.7;

/// Lubricant drag of the rolling contacts of a steering gear's screw, that of Lin 2019, Table 4.1 (29 x 7 x 4, 71 balls), under [`FLOODING`]: with
/// [`STEERING_GREASE`] and under 5 kN 0.006 N m at 20 degrees Celsius and 5 rad/s, and 0.3 N m at -40. Of another screw: [`RollingDrag::of`].
pub const DRAG: RollingDrag = match steering_drag() {
    Ok(drag) => drag,
    Err(_) => panic!("the drag of the default screw is out of range"),
};

const fn steering_drag() -> Result<RollingDrag, Error> {
    let [
        ..,
        NamedDesign {
            parameters,
            loaded_balls,
            ..
        },
    ] = DISSERTATION_DESIGNS;
    let design = attempt!(BallScrew::new(parameters));
    RollingDrag::of(&design, loaded_balls, FLOODING)
}

/// Density of [`STEERING_GREASE`]'s base oil at 15 degrees Celsius, kg/m³.
pub const STEERING_GREASE_DENSITY: f32 = 833.0;

/// Friction coefficient by speed and temperature: 0.12 at standstill, 0.05 on a full film, half-way at 15.35 rad/s of the nut and
/// 20 degrees Celsius, both directions alike; lubricant drag beside it, no churning.
///
/// Assumed, not measured. 0.12 is the middle of boundary-lubricated steel (0.1 to 0.15), 0.05 a usual traction of a rolling
/// contact's film (0.03 to 0.07). The speed is that at which SKF's model (Rolling Bearings, "The SKF model for
/// calculating the frictional moment") weighs boundary and film friction alike:
///
/// ```text
/// exp(-2.6e-8 (n nu)^1.4 d_m) = 1/2        n, 1/min    nu, mm²/s    d_m, mm
/// w_ref = (pi/30) (ln 2/(2.6e-8 d_m))^(1/1.4)/nu
/// ```
///
/// with the pitch circle of the screw of Lin 2019, Table 4.1, for the mean diameter (29 mm) and [`STEERING_GREASE`] at 20 degrees (124 mm²/s). For
/// another screw it goes with 1/(viscosity x pitch radius to the power of 0.714). SKF's share falls later and then faster than the law's
/// `1/(1 + w/w_ref)`: by up to 0.11 of the difference of both coefficients more below the half-share speed, 0.21 less at three times it. A film as thick
/// as 0.41 of a roughness of 0.15 um (Hamrock and Dowson 1977, Olver and Spikes 1998) has its half share at 12 rad/s, of 0.08 um at 5.
///
/// Cold grease makes a film at lower speeds, and resists rolling more. Without a load the sum rises from 20 to -40 degrees by 1.3 at 1 rad/s of the nut,
/// 3.6 at 5 and 10 at 20; under 5 kN it falls at 1 rad/s, by 0.42. Above 5 rad/s at -40 degrees the drag is an upper bound: that of contacts which
/// lubricant keeps supplied. Measured gears rise two- to threefold, by report: a traction of the film of 0.10 at -40 degrees would explain it (Wikström
/// and Höglund 1994, J. Tribol. 116:612), but for greases of this kind no figures were found.
pub const COEFFICIENT: CoefficientParameters = CoefficientParameters {
    boundary: 0.12,
    full_film: 0.05,
    half_share_speed: 15.35,
    reference_temperature: 293.15,
    viscosity: STEERING_GREASE,
    forward: 1.0,
    backward: 1.0,
    churning: 0.0,
    drag: DRAG,
};
