//! How balls fit between the grooves: one signed number for play, no play and preload.

use super::preload::preload_of;
use crate::error::{Error, Range, attempt, in_range};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::constant;

/// Smallest and largest clearance over the ball radius. Preloaded balls are oversized by a few micrometres; play is some tens.
const OVER_BALL_RADIUS: Range = Range::new(-0.02, 0.05);

/// The same in m, for a ball of 0.05 m.
const IN_METRES: Range = Range::new(-1e-3, 2.5e-3);

/// Preload of a contact, N: the smallest and the largest that [`Clearance::of_preload`] takes.
const CONTACT_FORCE: Range = Range::new(1e-3, 1e6);

/// Radial gap of every contact at a centred ball in a screw without load, m: play above zero, oversize below. Balls have the radius
/// `r_b - gap`, with the design's ball radius `r_b`; oversized ones press on all four contacts ([`Clearance::preload`]).
///
/// Not to be taken for [`BallScrew::clearance`], which is the radius of a groove less that of the ball.
///
/// ```
/// use epas_friction::{CATALOGUE, Clearance};
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// // What a supplier gives: nothing, a gap, a force of each contact, or the nut's lost travel.
/// let sizes = [
///     Clearance::ZERO,
///     Clearance::new(-3e-6)?,
///     Clearance::of_preload(&design, 100.0)?,
///     Clearance::of_axial_play(&design, 20e-6)?,
/// ];
/// assert!((sizes[2].preload(&design) - 100.0).abs() < 1e-3);
/// assert!(sizes[3].gap() > 0.0 && sizes[3].preload(&design) == 0.0);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Clearance {
    gap: f32,
}

impl Clearance {
    /// Neither play nor preload.
    pub const ZERO: Self = Self { gap: 0.0 };

    /// A gap, m, -1e-3 to 2.5e-3; a scene narrows that ([`Clearance::checked`]).
    pub const fn new(gap: f32) -> Result<Self, Error> {
        Ok(Self {
            gap: attempt!(IN_METRES.checked("clearance", gap)),
        })
    }

    /// The oversize that presses each of the four contacts with this force without a load, N, 1e-3 to 1e6 and up to
    /// that of -0.02 ball radii: `gap = -(c_S + c_N) F_0^(2/3) / 2` ([`HertzContact::deflection_coefficient`]).
    pub const fn of_preload(design: &BallScrew, contact_force: f32) -> Result<Self, Error> {
        let tightest = Self {
            gap: OVER_BALL_RADIUS.minimum * design.ball_radius(),
        };
        let hardest = tightest.preload(design).min(CONTACT_FORCE.maximum);
        let least = CONTACT_FORCE.minimum;
        let force = attempt!(in_range("contact_force", contact_force, least, hardest));
        let gap = -(mean_deflection(design) * constant::cbrt_squared(force));
        // The hardest preload is that of the tightest gap but for rounding.
        Ok(Self {
            gap: gap.max(tightest.gap),
        })
    }

    /// The gap of an axial travel of the nut from one flank to the other without a load, m, 0 to that of 0.05 ball radii.
    ///
    /// A diagonal closes when the arc centres of its two grooves, which stand `2 D_s` apart around a centred ball, have
    /// come to a distance of `2 (D_s + gap)`. A travel `z` off the middle moves them apart by `z cos(alpha)` along the binormal:
    ///
    /// ```text
    /// (D_s + gap)^2 = (D_s cos(beta))^2 + (D_s sin(beta) + z cos(alpha) / 2)^2     play = 2 z
    /// play ~ 4 gap / (sin(beta) cos(alpha))                                         gap << D_s
    /// ```
    ///
    /// with the mean `D_s` of both grooves' radii less the ball's; within 5e-5 of the travel between helical grooves.
    pub const fn of_axial_play(design: &BallScrew, axial_play: f32) -> Result<Self, Error> {
        let widest = Self {
            gap: OVER_BALL_RADIUS.maximum * design.ball_radius(),
        };
        let longest = widest.axial_play(design);
        let play = attempt!(in_range("axial_play", axial_play, 0.0, longest));
        let offset = mean_offset(design);
        // Along the binormal, from the middle, for each of the two arc centres.
        let shift = 0.25 * play * design.cos_lead_angle();
        // (D_s + gap)^2 - D_s^2
        let growth = shift * (2.0 * offset * design.contact_angle().sin + shift);
        let gap = growth / (constant::sqrt(offset * offset + growth) + offset);
        // The longest play is that of the widest gap but for rounding.
        Ok(Self {
            gap: gap.min(widest.gap),
        })
    }

    /// Checks the gap against the balls of a design: -0.02 to 0.05 ball radii.
    pub const fn checked(self, design: &BallScrew) -> Result<Self, Error> {
        self.checked_for(design.ball_radius())
    }

    /// The same for balls of a radius, m.
    pub(crate) const fn checked_for(self, radius: f32) -> Result<Self, Error> {
        let Range { minimum, maximum } = OVER_BALL_RADIUS;
        let (least, most) = (minimum * radius, maximum * radius);
        Ok(Self {
            gap: attempt!(in_range("clearance", self.gap, least, most)),
        })
    }

    /// The gap, m: play above zero, oversize below.
    pub const fn gap(self) -> f32 {
        self.gap
    }

    /// Preload: force of each of the four contacts without a load, N, `(-2 gap / (c_S + c_N))^(3/2)`; 0 with play, and below 1e-3 N.
    ///
    /// Within 3e-4 of the forces of a ball in elastic grooves up to an oversize of 1e-3 ball radii, and within 0.4 % up to 0.02.
    pub const fn preload(self, design: &BallScrew) -> f32 {
        if self.gap < 0.0 {
            let ratio = -self.gap / mean_deflection(design);
            preload_of(ratio, constant::sqrt(ratio))
        } else {
            0.0
        }
    }

    /// Axial preload on each flank of the nut, N: `N F_0 sin(beta) cos(alpha)` of `N` loaded balls with the preload `F_0` of a contact.
    pub const fn axial_preload(self, design: &BallScrew, loaded_balls: u16) -> f32 {
        loaded_balls as f32 * (self.preload(design) * design.axial_per_normal())
    }

    /// Travel of the nut along the axis from one flank to the other without a load, m; 0 without play.
    pub const fn axial_play(self, design: &BallScrew) -> f32 {
        if self.gap > 0.0 {
            let offset = mean_offset(design);
            let along_axis = offset * design.contact_angle().sin;
            let growth = self.gap * (2.0 * offset + self.gap);
            let reach = constant::sqrt(along_axis * along_axis + growth);
            4.0 * growth / ((reach + along_axis) * design.cos_lead_angle())
        } else {
            0.0
        }
    }
}

/// Mean deflection of a contact with the screw and one with the nut over the force to the power of 2/3, m/N^(2/3).
const fn mean_deflection(design: &BallScrew) -> f32 {
    let screw = HertzContact::of(design, Groove::Screw).deflection_coefficient();
    let nut = HertzContact::of(design, Groove::Nut).deflection_coefficient();
    0.5 * (screw + nut)
}

/// Mean radius of both grooves less the ball's, m.
const fn mean_offset(design: &BallScrew) -> f32 {
    0.5 * (design.clearance(Groove::Screw) + design.clearance(Groove::Nut))
}
