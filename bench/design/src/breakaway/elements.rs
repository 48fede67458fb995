//! Elements of a memory from the parts of a screw or a bearing.

use super::bearing::BearingBreakaway;
use super::parts::{BreakawayPart, Mechanism};
use super::screw::Breakaway;
use epas_friction::error::Error;
use epas_friction::law::memory::{BackboneElement, Part, ProportionalElements, SeatElement};

/// Least share of a part with a table: that of [`ProportionalElements::new`].
const LEAST_SHARE: f32 = 1e-6;

/// Tables of elements, one for each mechanism; an empty one leaves its mechanism out, whose share goes to the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tables<'a> {
    /// Slip across the path, as [`SLIP_6`](epas_friction::law::memory::SLIP_6)`.elements`; empty for a linear bearing.
    pub slip: &'a [BackboneElement],
    /// Spin, as [`SPIN_4`](epas_friction::law::memory::SPIN_4)`.elements`.
    pub spin: &'a [BackboneElement],
    /// Rolling resistance: a table of slip, by analogy. About one per cent of the friction; empty costs nothing.
    pub rolling_resistance: &'a [BackboneElement],
}

impl<'a> Tables<'a> {
    fn of(&self, mechanism: Mechanism) -> &'a [BackboneElement] {
        match mechanism {
            Mechanism::Slip => self.slip,
            Mechanism::Spin => self.spin,
            Mechanism::RollingResistance => self.rolling_resistance,
        }
    }

    /// Elements of the parts that have a table, `N` together, with a friction of gross sliding `whole`, N m or N.
    fn elements<const N: usize>(
        &self,
        parts: [BreakawayPart; 3],
        whole: f32,
    ) -> Result<ProportionalElements<N>, Error> {
        let mut taken: Vec<Part> = parts
            .iter()
            .map(|part| Part {
                backbone: self.of(part.mechanism),
                share: part.share.max(LEAST_SHARE),
                breakaway_angle: part.breakaway_angle,
            })
            .filter(|part| !part.backbone.is_empty())
            .collect();
        let sum: f32 = taken.iter().map(|part| part.share).sum();
        for part in &mut taken {
            part.share /= sum;
        }
        ProportionalElements::new(whole, &taken)
    }
}

impl Breakaway {
    /// `N` elements in these tables, for [`Self::parts`].
    ///
    /// ```
    /// use epas_design::breakaway::{Breakaway, BreakawayConfiguration, ScrewContacts, Tables};
    /// use epas_friction::law::memory::{ProportionalElements, SLIP_4, SPIN_4};
    /// use epas_friction::{CATALOGUE, defaults};
    /// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
    /// let breakaway = Breakaway::of(&design, &BreakawayConfiguration {
    ///     friction: defaults::FRICTION,
    ///     clearance: defaults::CLEARANCE,
    ///     rolling_resistance: defaults::ROLLING_RESISTANCE,
    ///     loaded_balls: 37,
    ///     contact_load: ScrewContacts::of(&design).preloaded(1000.0, 37, defaults::CLEARANCE),
    /// })?;
    /// let elements: ProportionalElements<8> = breakaway.elements(&Tables {
    ///     slip: &SLIP_4.elements,
    ///     spin: &SPIN_4.elements,
    ///     rolling_resistance: &[],
    /// })?;
    /// # Ok::<(), epas_friction::Error>(())
    /// ```
    pub fn elements<const N: usize>(
        &self,
        tables: &Tables<'_>,
    ) -> Result<ProportionalElements<N>, Error> {
        tables.elements(self.parts(), self.torque)
    }

    /// The seat as an element of its own, with the share of slip: for a screw with play, in
    /// [`ParallelElements`](epas_friction::law::memory::ParallelElements) with [`Self::elements_beside_seat`].
    pub fn seat_element(&self) -> Result<SeatElement, Error> {
        let slip = self.part(Mechanism::Slip);
        let play = self.seat.free_play();
        SeatElement::new(slip.share * self.torque, play, slip.breakaway_angle - play)
    }

    /// `N` elements of the other parts, to stand beside [`Self::seat_element`]; the table of slip is not used.
    pub fn elements_beside_seat<const N: usize>(
        &self,
        tables: &Tables<'_>,
    ) -> Result<ProportionalElements<N>, Error> {
        let tables = Tables {
            slip: &[],
            ..*tables
        };
        let rest = 1.0 - self.part(Mechanism::Slip).share;
        tables.elements(self.parts(), rest * self.torque)
    }
}

impl BearingBreakaway {
    /// `N` elements in these tables; that of slip is to be empty.
    pub fn elements<const N: usize>(
        &self,
        tables: &Tables<'_>,
    ) -> Result<ProportionalElements<N>, Error> {
        tables.elements(self.parts(), self.force)
    }
}
