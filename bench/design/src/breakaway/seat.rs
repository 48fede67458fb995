//! What holds a ball across its path.

use super::pair::ScrewContacts;
use super::parts::first_not_below;
use epas_friction::ball::Clearance;
use epas_friction::geometry::{BallScrew, Groove};
use epas_friction::math::constant;

/// What holds a ball of a screw across the path while its contacts slip: derived, no published screw to check with.
///
/// Friction across the path pushes the ball the same way at both of its contacts. It drifts by `l_1/2` for each radian of the
/// nut, until the grooves' slope and the third contact carry the friction of both:
///
/// ```text
/// F x (1/D_S + 1/D_N) + ((x - g)+ / c_3)^(3/2) - ((-x - g)+ / c_3)^(3/2) = 2 mu F tau
/// angle(tau) = theta_b [1 - (1 - tau)^(2/3)] + (2/l_1) x(tau)      theta_b = 1.5 mu F (C_S + C_N)/l_1
/// g = 2 gap + (delta_S + delta_N)/2
/// ```
///
/// with the share `tau` of the gross slip, the slip `l_1` of both contacts over the nut's angle ([`ScrewContacts`]), the load `F` of
/// each of the two, the excess `D_S`, `D_N` of a groove's radius over the ball's, the deflection `c_3` of the
/// third contact over its load to the power of 2/3 (that of the screw's groove), and the gap `g` that is left to it: twice the
/// [`Clearance`], and what the loaded diagonal's deflection opens. An oversized ball has `g < 0` up to a load, and a fourth
/// contact that lets go.
///
/// Series of a nonlinear spring and the contacts: hardly any torque within the gap, a stop at its end. Elements with a concave
/// backbone can have its angle, not its shape.
///
/// Cost: 40 halvings with up to two square roots ([`constant::sqrt`]) each, for a drift; set-up only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seat {
    /// Gap `g` of the third contact where no friction acts, m; below 0 it carries.
    gap: f32,
    /// `c_3`, m/N^(2/3).
    deflection: f32,
    /// `F (1/D_S + 1/D_N)`, N/m.
    slope: f32,
    /// `2 mu F`, N.
    friction: f32,
    /// `l_1/2`, m.
    per_angle: f32,
    /// Breakaway angle of both contacts, rad.
    contact_angle: f32,
}

impl Seat {
    /// The seat of a ball whose two loaded contacts carry `load`, N, with its third contact's gap by clearance and load;
    /// unchecked, for numbers that
    /// [`BreakawayConfiguration::checked`](super::BreakawayConfiguration::checked) would pass.
    #[must_use]
    pub fn of(
        design: &BallScrew,
        contacts: &ScrewContacts,
        clearance: Clearance,
        friction: f32,
        load: f32,
    ) -> Self {
        let deflection = contacts.mean_deflection() * constant::cbrt_squared(load);
        let gap = 2.0 * clearance.gap() + deflection;
        Self::with_gap(design, contacts, gap, friction, load)
    }

    /// The same with the gap that is left to the third contact, m.
    #[must_use]
    pub fn with_gap(
        design: &BallScrew,
        contacts: &ScrewContacts,
        gap: f32,
        friction: f32,
        load: f32,
    ) -> Self {
        let screw = contacts.contact(Groove::Screw).contact();
        let both_slopes =
            1.0 / design.clearance(Groove::Screw) + 1.0 / design.clearance(Groove::Nut);
        Self {
            gap,
            deflection: screw.deflection_coefficient(),
            slope: load * both_slopes,
            friction: 2.0 * friction * load,
            per_angle: 0.5 * contacts.slip_per_angle(),
            contact_angle: contacts.slip(friction, load).breakaway(),
        }
    }

    /// Gap of the third contact where no friction acts, m; below 0 it carries.
    #[must_use]
    pub fn gap(&self) -> f32 {
        self.gap
    }

    /// Deflection of the third contact over its load to the power of 2/3, m/N^(2/3).
    #[must_use]
    pub fn deflection_coefficient(&self) -> f32 {
        self.deflection
    }

    /// Drift `x`, m, where slip has so much of its gross friction, 0 to 1; beyond as at its end, NaN as 0.
    #[must_use]
    pub fn drift(&self, share: f32) -> f32 {
        let share = if share >= 1.0 {
            1.0
        } else if share > 0.0 {
            share
        } else {
            0.0
        };
        let force = self.friction * share;
        // The grooves' slope alone would hold the ball there.
        first_not_below(0.0, force / self.slope, |drift| self.holding(drift) < force)
    }

    /// Nut angle in which the ball drifts that far, rad; 0 without lead.
    #[must_use]
    pub fn drift_angle(&self, share: f32) -> f32 {
        if self.per_angle > 0.0 {
            self.drift(share) / self.per_angle
        } else {
            0.0
        }
    }

    /// Nut angle from the middle of the drift until slip has so much of its gross friction, 0 to 1, rad.
    ///
    /// `angle(0.9)` and `angle(1.0)` say how soon a screw breaks away.
    #[must_use]
    pub fn angle(&self, share: f32) -> f32 {
        let left = if share >= 1.0 {
            0.0
        } else if share > 0.0 {
            1.0 - share
        } else {
            1.0
        };
        self.contact_angle * (1.0 - constant::cbrt_squared(left)) + self.drift_angle(share)
    }

    /// Loads of the third contact and of the fourth one, N, where slip has so much of its gross friction, 0 to 1; the fourth one
    /// carries in preloaded balls only.
    #[must_use]
    pub fn side_contacts(&self, share: f32) -> [f32; 2] {
        let drift = self.drift(share);
        [
            self.pressed(drift - self.gap),
            self.pressed(-drift - self.gap),
        ]
    }

    /// Nut angle in which a ball goes from the middle of its drift to the third contact, with nothing but the grooves' slope to hold
    /// it, rad; 0 where that contact carries from the beginning.
    #[must_use]
    pub fn free_play(&self) -> f32 {
        if self.gap > 0.0 && self.per_angle > 0.0 {
            self.gap / self.per_angle
        } else {
            0.0
        }
    }

    /// Force that holds the ball at a drift, N; 0 in the middle, rising.
    fn holding(&self, drift: f32) -> f32 {
        self.slope * drift + self.pressed(drift - self.gap) - self.pressed(-drift - self.gap)
    }

    /// Load of a contact that is pressed in so far, m.
    fn pressed(&self, approach: f32) -> f32 {
        if approach > 0.0 {
            let ratio = approach / self.deflection;
            ratio * constant::sqrt(ratio)
        } else {
            0.0
        }
    }
}
