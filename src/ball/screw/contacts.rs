//! Loads of a ball's contacts: the loaded diagonal, and what friction across the track and a preload put on the other.

use super::raceway::{Raceway, cube_root};
use crate::ball::preload::Preload;
use crate::contact::Across;
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::math::constant;

/// Load of a light contact below which it does not count, over that of the main contacts. A numerical floor: such a contact adds
/// about a millionth to friction, and its ellipse, a hundredth of the main contact's, has not vanished.
const LEAST_LOAD: f32 = 1e-6;

/// Both grooves with the preload between them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Contacts {
    /// Friction coefficient of ball and groove.
    pub(super) friction: f32,
    pub(super) screw: Raceway,
    pub(super) nut: Raceway,
    /// Contact forces of the two diagonals without a load.
    preload: Preload,
    /// Slip across the track in the contact with the screw, times the slope of its share of sliding friction, m.
    sliding: f32,
}

/// Loads of a ball's contacts, N, and friction of the loaded pair.
#[derive(Clone, Copy)]
pub(super) struct Loads {
    /// Each contact of the loaded diagonal.
    pub(super) main: f32,
    /// The contact of the other diagonal towards which friction across the track pushes the ball.
    pub(super) third: f32,
    /// The contact opposite to it; 0 where it is lost.
    pub(super) fourth: f32,
    /// The main contact with the screw, over `mu` times its load.
    pub(super) screw: Across,
    /// The main contact with the nut.
    pub(super) nut: Across,
}

impl Contacts {
    /// The contacts of a design's ball that spins by `spins` (screw, nut) and slips by `slip`, m, per unit of nut speed, with a
    /// preload, N.
    ///
    /// # Errors
    /// [`Error`] naming `axis_ratio`.
    pub(super) const fn new(
        design: &BallScrew,
        friction: f32,
        [screw_spin, nut_spin]: [f32; 2],
        slip: f32,
        preload: f32,
    ) -> Result<Self, Error> {
        let screw = attempt!(Raceway::new(design, Groove::Screw, screw_spin, slip));
        let nut = attempt!(Raceway::new(design, Groove::Nut, nut_spin, slip));
        Ok(Self {
            friction,
            preload: Preload::new(preload),
            sliding: screw.share_slope() * slip,
            screw,
            nut,
        })
    }

    /// Loads of the contacts under a given difference of the two diagonals.
    #[inline]
    pub(super) const fn loads(&self, normal: f32) -> Loads {
        // Share of sliding friction across the track, to some per cent.
        let sliding = self.sliding;
        let spinning = self.screw.end_speed() * cube_root(normal);
        let size = constant::sqrt(spinning * spinning + sliding * sliding + 1e-30);
        let main = self
            .preload
            .larger(normal * size / (size - self.friction * sliding));
        let root = cube_root(main);
        let screw = self.screw.under(root);
        let nut = self.nut.under(root);
        let loss = 0.5 * self.friction * (screw.share + nut.share);
        let (main, other) = self.preload.both(normal / (1.0 - loss));

        // Friction across the track of the loaded diagonal pushes the ball along the other one.
        let push = loss * main;
        // Without lead there is no such friction, and a lost diagonal carries nothing at all: the floor
        // keeps its ellipse from vanishing.
        let least = LEAST_LOAD * main;
        let third = larger(if other > push { other } else { push } + push, least);
        let fourth = if other - push > least {
            other - push
        } else {
            0.0
        };
        Loads {
            main,
            third,
            fourth,
            screw,
            nut,
        }
    }
}

#[inline]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}
