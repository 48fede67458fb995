//! One groove of a row of balls: its contact under any load.

use crate::contact::{Across, AcrossTable};
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::inverse_cube_roots;

/// Contact of a ball that slips across the track by a given speed and spins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Raceway {
    table: AcrossTable,
    /// Speed that the spin gives the end of the major axis under one newton, `a w`, `m/N^(1/3)` per unit of nut speed.
    end_speed: f32,
}

impl Raceway {
    /// The contact of a design's groove with a spin and a slip across the track, m, per unit of nut speed.
    ///
    /// # Errors
    /// [`Error`] naming `axis_ratio`.
    pub(super) const fn new(
        design: &BallScrew,
        groove: Groove,
        spin: f32,
        slip: f32,
    ) -> Result<Self, Error> {
        let contact = HertzContact::of(design, groove);
        Ok(Self {
            table: attempt!(AcrossTable::new(contact.axis_ratio(), slip)),
            end_speed: contact.semi_major_coefficient() * spin,
        })
    }

    /// The contact under a load of which this is the cube root.
    #[inline]
    pub(super) const fn under(&self, root: f32) -> Across {
        self.table.at(self.end_speed * root)
    }

    /// Speed that the spin gives the end of the major axis under one newton, `m/N^(1/3)` per unit of nut speed.
    #[inline]
    pub(super) const fn end_speed(&self) -> f32 {
        self.end_speed
    }

    /// Friction force over `mu F` by the ratio of slip and the end's speed, where that is small.
    pub(super) const fn share_slope(&self) -> f32 {
        self.table.share_slope()
    }
}

/// `x^(1/3)` of a positive normal number within 6e-5.
#[inline]
pub(super) const fn cube_root(x: f32) -> f32 {
    let [inverse, _] = inverse_cube_roots([x, 1.0]);
    x * inverse * inverse
}
