//! Lubricant drag of rolling contacts by viscosity, speed and load.

use crate::curvature::GothicArch;
use crate::error::{Error, Range, attempt, in_range};
use crate::geometry::{BallScrew, Groove};
use crate::material::contact_modulus;
use crate::math::constant::{cbrt, cbrt_squared, sqrt};

/// Drag torque at 1 Pa s, 1 rad/s and 1 N, N m (0.002 for a steering gear's screw).
const TORQUE: Range = Range::new(0.0, 1e3);

/// Inlet shear heating at 1 Pa s and 1 rad/s (0.0005 for a steering gear's screw).
const HEATING: Range = Range::new(0.0, 1e3);

/// Share of the drag that the supply of lubricant leaves: to twice that of flooded contacts.
const FLOODING: Range = Range::new(0.0, 2.0);

/// State at which the drag is that of the published formulas (at a viscosity of 1 Pa s): speed of the nut, rad/s; axial load of a ball, N.
const SPEED: f32 = 20.0;
const BALL_LOAD: f32 = 30.0;

/// Density at which the kinematic viscosity of the shear heating's formula is taken, kg/m³.
const DENSITY: f32 = 850.0;

/// Up to this many times the lift-off load of a preload both flanks drag about as much as without a load.
const BOTH_FLANKS: f32 = 2.1;

/// Drag of the lubricant that the rolling contacts of a ball screw displace; unchecked.
///
/// ```text
/// T = torque eta^0.8 |omega_N|^0.75 F_d^0.25 / (1 + heating eta^0.8 |omega_N|)
/// F_d = max(|F|, 2.1 F_0)
/// ```
///
/// `eta` is the dynamic viscosity of the base oil, Pa s, `omega_N` the speed of the nut, rad/s, `F` the axial load, N, and `F_0` the axial
/// load at which the preload's unloaded flank lifts off, N (0 with play). The memory does not hold it.
///
/// [`Self::of`] takes both numbers from a design. One rolling contact pumps lubricant into its inlet with the force
///
/// ```text
/// FR = FR_e + (FR_i - FR_e)/(1 + M/6.6)                  U = eta u/(E' Rx)     W = Q/(E' Rx^2)     k = Ry/Rx
/// FR_i = 2.9766 E' Rx^2 k^0.3316 W^(1/3) U^(2/3)         rigid contact
/// FR_e = 7.5826 E' Rx^2 k^0.4055 W^(1/3) U^(3/4)         elastic contact
/// M = 0.5549 k^-0.6029 W U^-0.75
/// ```
///
/// on each of its surfaces (Biboulet and Houpert 2010, part 2, eqs. (30) to (32), as printed by Balan, Houpert, Tufescu and Olaru
/// 2015, Lubricants 3:222, eqs. (1) to (7)). `u` is the mean speed of both surfaces, `Q` the contact's load, `Rx` and `Ry` the relative radii
/// along and across the track, `E'` twice the contact modulus. A ball has two such contacts, each with the power `2 FR u`. Inlet shear heating
/// is the factor of SKF's friction model (General Catalogue, "The SKF model for calculating the frictional moment"):
///
/// ```text
/// phi_ish = 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64)         n, 1/min    d_m, mm    nu, mm^2/s
/// ```
///
/// with the pitch circle of the screw for the mean diameter of the bearing. SKF's rolling moment `G_rr (nu n)^0.6` agrees within a factor of two for
/// the bearing 6206; its constants are for bearings with 7 to 15 balls and radial grooves.
///
/// The powers above approximate all of this. Largest difference -26 and +25 %, rms 10 %: 0.02 to 16 Pa s, 0.5 to 60 rad/s, 5 to 200
/// N a ball, five sizes of 20 to 50 mm. Preloaded flanks are counted within 22 % below lift-off.
///
/// Left out: churning of grease in the nut and its return ([`churning`](super::CoefficientParameters::churning)), the yield stress of a grease's
/// thickener, wipers and seals, and starvation that grows with speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RollingDrag {
    /// Torque at 1 Pa s, 1 rad/s of the nut and 1 N of axial load, without heating, N m, 0 to 1e3; 0 without drag.
    pub torque: f32,
    /// Inlet shear heating at 1 Pa s and 1 rad/s: by that much the drag is smaller, 0 to 1e3.
    pub heating: f32,
}

impl RollingDrag {
    /// Speed of the nut up to which the powers were fitted, rad/s; above it a scene with memory sets
    /// [`Faults::BEYOND_MODEL`](crate::Faults::BEYOND_MODEL).
    pub const FITTED_SPEED: f32 = 60.0;

    /// No drag.
    pub const NONE: Self = Self {
        torque: 0.0,
        heating: 0.0,
    };

    /// The drag of a ball screw with so many loaded balls, 1 to 1e3, and a supply of lubricant, 0 to 2: 1 where every contact is flooded, 0.7
    /// where drops of oil or a film of grease supply it ([`defaults::FLOODING`](crate::defaults::FLOODING)). For set-up and constants.
    pub const fn of(design: &BallScrew, loaded_balls: u16, flooding: f32) -> Result<Self, Error> {
        let balls = attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        let flooding = attempt!(FLOODING.checked("flooding", flooding));
        let ball = design.ball_radius() * design.contact_angle().cos / design.pitch_radius();
        // Mean speed of the surfaces over that of the nut, m.
        let entrainment = 0.5 * design.path_radius() * (1.0 - ball * ball);
        let load = BALL_LOAD / design.axial_per_normal();
        let speed = SPEED * entrainment;
        let force = contact_force(design, Groove::Screw, speed, load)
            + contact_force(design, Groove::Nut, speed, load);
        let quarter = sqrt(sqrt(SPEED * SPEED * SPEED * BALL_LOAD * balls));
        Ok(Self {
            torque: flooding * balls * 2.0 * entrainment * force / quarter,
            heating: shear_heating(design.pitch_radius()) / SPEED,
        })
    }

    /// This drag times a factor that a calibration has found.
    #[must_use]
    pub const fn times(&self, factor: f32) -> Self {
        Self {
            torque: factor * self.torque,
            heating: self.heating,
        }
    }

    pub(super) const fn checked(self) -> Result<Self, Error> {
        attempt!(TORQUE.checked("drag_torque", self.torque));
        attempt!(HEATING.checked("drag_heating", self.heating));
        Ok(self)
    }

    /// Drag torque, N m, not negative, from `eta^-0.8`, a speed's size, rad/s, the size of the axial load and the lift-off load, N.
    #[inline]
    pub(super) fn at(&self, fluidity: f32, speed: f32, loads: [f32; 2]) -> f32 {
        use crate::math::sqrt;
        let [load, lift_off] = loads;
        let both = BOTH_FLANKS * lift_off;
        let dragging = if load > both { load } else { both };
        let quarter = sqrt(sqrt(speed * speed * speed * dragging));
        self.torque * quarter / (fluidity + self.heating * speed)
    }
}

/// Force of one contact with a groove at a viscosity of 1 Pa s, a mean speed of its surfaces, m/s, and a load, N. Powers of the ratio of radii by
/// roots of two and three: 13/32 for 0.4055, 1/3 for 0.3316, 19/32 for 0.6029.
const fn contact_force(design: &BallScrew, groove: Groove, speed: f32, load: f32) -> f32 {
    let relative =
        GothicArch::of(design, groove).relative(design.contact_angle(), design.clearance(groove));
    let radius = 1.0 / relative.along;
    let ratio = relative.along / relative.across;
    let parameters = design.parameters();
    let modulus = 2.0 * contact_modulus(&parameters.ball_material, &parameters.groove_material);
    let area = modulus * radius * radius;
    let u = speed / (modulus * radius);
    let w = load / area;
    let root = sqrt(u);
    let three_quarters = root * sqrt(root);
    let fourth = sqrt(sqrt(ratio));
    let (eighth, sixteenth) = (sqrt(fourth), sqrt(sqrt(fourth)));
    let wide = fourth * eighth * sqrt(sixteenth);
    let rigid = 2.9766 * area * cbrt(ratio) * cbrt(w) * cbrt_squared(u);
    let elastic = 7.5826 * area * wide * cbrt(w) * three_quarters;
    let transition = 0.5549 * w / (wide * eighth * sixteenth * three_quarters);
    elastic + (rigid - elastic) / (1.0 + transition / 6.6)
}

/// `1.84e-9 (n d_m)^1.28 nu^0.64` at 1 Pa s: the first power by roots of two, 1 + 9/32.
const fn shear_heating(pitch_radius: f32) -> f32 {
    const PER_MINUTE: f32 = 60.0 / core::f32::consts::TAU;
    const MILLIMETRES: f32 = 1e3;
    let product = SPEED * PER_MINUTE * (2.0 * MILLIMETRES * pitch_radius);
    let fourth = sqrt(sqrt(product));
    // 1e6/DENSITY = 1176.47 mm²/s, of which 0.64 is 5/8 and 1/64.
    let viscosity = sqrt(sqrt(sqrt(1e6 / DENSITY)));
    let square = viscosity * viscosity;
    let viscosity = square * square * viscosity * sqrt(sqrt(sqrt(viscosity)));
    1.84e-9 * (product * fourth * sqrt(sqrt(sqrt(fourth)))) * viscosity
}
