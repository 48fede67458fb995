//! Initial stiffness and breakaway travel of a linear bearing.

use super::contact::ContactStiffness;
use super::parts::Resistance;
use super::parts::{BreakawayPart, Mechanism};
use epas_friction::contact::{RollingContact, RollingResistance};
use epas_friction::error::{Error, Range};
use epas_friction::geometry::LinearBearing;
use epas_friction::ranges;

/// Load of a contact, N.
const CONTACT_LOAD: Range = Range::new(0.0, 1e6);

const LOADED_BALLS: Range = Range::new(1.0, 65_535.0);

/// A ball of a linear bearing on four contacts, and how far they move with the carriage.
///
/// For a travel of one metre each contact spins by `tan(beta)/(2 r_b)` about its normal and rolls along half a metre of the
/// track; none slips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingContacts {
    contact: ContactStiffness,
    /// Spin over the travel, 1/m.
    spin: f32,
}

/// Rolled path of a contact over the carriage's travel.
const PATH: f32 = 0.5;

impl BearingContacts {
    /// The contacts of a validated design.
    #[must_use]
    pub fn of(design: &LinearBearing) -> Self {
        let angle = design.contact_angle();
        Self {
            contact: ContactStiffness::of_linear(design),
            spin: 0.5 * angle.sin / (angle.cos * design.ball_radius()),
        }
    }

    /// The contact, which is the same on all four points.
    #[must_use]
    pub fn contact(&self) -> &ContactStiffness {
        &self.contact
    }

    /// Spin of each contact over the travel, rad/m.
    #[must_use]
    pub fn spin_per_travel(&self) -> f32 {
        self.spin
    }

    /// Spin of one contact under a load, N: limit in N, stiffness in N/m.
    #[must_use]
    pub fn spin(&self, friction: f32, load: f32) -> Resistance {
        self.contact.spin(friction, load, self.spin)
    }
}

/// How the friction of a linear bearing begins after a reversal: the parts for the elements of a memory, over the carriage's
/// travel.
///
/// The balls roll on four points that spin; rolling resistance builds up over a travel of `4 b`. Where so little is left on a
/// diagonal that balls change to two-point rolling, this says nothing.
///
/// ```
/// use epas_friction::contact::RollingResistance;
/// use epas_design::breakaway::{BearingBreakaway, Mechanism};
/// use epas_friction::{GrooveSize, LinearBearing, LinearBearingParameters, Material};
/// let bearing = LinearBearing::new(LinearBearingParameters {
///     ball_radius: 5e-3,
///     groove: GrooveSize::Conformity(0.56),
///     contact_angle: 45f32.to_radians(),
///     ball_material: Material::STEEL,
///     groove_material: Material::STEEL,
/// })?;
/// let breakaway = BearingBreakaway::of(&bearing, 0.1, RollingResistance::STEEL, 24, [100.0, 100.0])?;
/// // Some micrometres.
/// assert!(breakaway.part(Mechanism::Spin).breakaway_angle < 1e-5);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingBreakaway {
    /// Friction force of the whole bearing at these loads, N.
    pub force: f32,
    spin: BreakawayPart,
    resistance: BreakawayPart,
}

impl BearingBreakaway {
    /// The breakaway of so many balls, 1 to 65535, whose contacts carry these loads, N, 0 to 1e6: each of the two contacts of
    /// one diagonal, and each of the two of the other; with the friction coefficient of ball and groove, 1e-6 to 1.
    pub fn of(
        design: &LinearBearing,
        friction: f32,
        rolling_resistance: RollingResistance,
        loaded_balls: u16,
        contact_loads: [f32; 2],
    ) -> Result<Self, Error> {
        ranges::FRICTION.checked("friction", friction)?;
        let balls = LOADED_BALLS.checked("loaded_balls", f32::from(loaded_balls))?;
        let [up, down] = contact_loads;
        CONTACT_LOAD.checked("contact_load", up)?;
        CONTACT_LOAD.checked("contact_load", down)?;
        let contacts = BearingContacts::of(design);
        let rolling_contact = RollingContact::new(
            rolling_resistance,
            contacts.contact.contact().semi_minor_coefficient(),
            1.0 / design.ball_radius(),
        )?;
        let spin = contacts
            .spin(friction, up)
            .beside(contacts.spin(friction, down))
            .times(2.0 * balls);
        let resistance = rolled(&contacts, &rolling_contact, up)
            .beside(rolled(&contacts, &rolling_contact, down))
            .times(2.0 * balls);
        let force = spin.limit + resistance.limit;
        Ok(Self {
            force,
            spin: BreakawayPart::of(Mechanism::Spin, spin, force),
            resistance: BreakawayPart::of(Mechanism::RollingResistance, resistance, force),
        })
    }

    /// Slip, of which there is none, spin and rolling resistance; breakaway angles are travels, m.
    #[must_use]
    pub fn parts(&self) -> [BreakawayPart; 3] {
        [self.part(Mechanism::Slip), self.spin, self.resistance]
    }

    /// One of [`Self::parts`].
    #[must_use]
    pub fn part(&self, mechanism: Mechanism) -> BreakawayPart {
        match mechanism {
            Mechanism::Slip => BreakawayPart::of(Mechanism::Slip, Resistance::NONE, self.force),
            Mechanism::Spin => self.spin,
            Mechanism::RollingResistance => self.resistance,
        }
    }

    /// Initial stiffness of the parts together, N/m.
    #[must_use]
    pub fn stiffness(&self) -> f32 {
        self.spin.stiffness + self.resistance.stiffness
    }
}

fn rolled(contacts: &BearingContacts, resistance: &RollingContact, load: f32) -> Resistance {
    if load > 0.0 {
        contacts.contact.rolling(resistance, load, PATH)
    } else {
        Resistance::NONE
    }
}
