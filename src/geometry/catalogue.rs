//! Built-in designs: sizes of Bertolino et al. 2023, of makers and near a steering gear's, and three of Lin 2019.

use core::f32::consts::FRAC_PI_4;

use super::ball_screw::{BallScrew, BallScrewParameters};
use super::profile::GrooveSize;
use crate::error::Error;
use crate::material::Material;

/// A size as a catalogue prints it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CatalogueSize {
    /// Nominal diameter x lead x ball diameter in mm, e.g. `32x20x6.35`.
    pub name: &'static str,
    /// Nominal diameter, m.
    pub nominal_diameter: f32,
    /// Lead, m.
    pub lead: f32,
    /// Ball diameter, m.
    pub ball_diameter: f32,
}

impl CatalogueSize {
    /// Conformity of both grooves with which the published error tables reproduce.
    pub const CONFORMITY: f32 = 0.528;

    /// Nominal contact angle with which the published error tables reproduce, rad (45 degrees).
    pub const CONTACT_ANGLE: f32 = FRAC_PI_4;

    /// The parameters of this size: half the nominal diameter, conformity 0.528, contact angle 45 degrees, steel.
    pub const fn parameters(&self) -> BallScrewParameters {
        BallScrewParameters {
            pitch_radius: 0.5 * self.nominal_diameter,
            lead: self.lead,
            ball_radius: 0.5 * self.ball_diameter,
            screw_groove: GrooveSize::Conformity(Self::CONFORMITY),
            nut_groove: GrooveSize::Conformity(Self::CONFORMITY),
            contact_angle: Self::CONTACT_ANGLE,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        }
    }

    /// The validated design of this size; for constants too.
    ///
    /// # Errors
    /// As [`BallScrew::new`]; none of [`CATALOGUE`], [`FINE_LEAD_SIZES`] and [`STEERING_SIZES`] fails.
    pub const fn design(&self) -> Result<BallScrew, Error> {
        BallScrew::new(self.parameters())
    }
}

/// A design with a name and the number of balls that carry load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NamedDesign {
    /// Name, e.g. `lin-4.1`.
    pub name: &'static str,
    /// Its dimensions and materials.
    pub parameters: BallScrewParameters,
    /// Number of balls in the loaded turns.
    pub loaded_balls: u16,
}

/// The three ball screws of Lin 2019: Table 2.1 (`lin-2.1`, load distribution), Table 3.6 (`lin-3.6`,
/// ball-to-ball contact) and Table 4.1 (`lin-4.1`, close to a rack-assist steering gear).
pub const DISSERTATION_DESIGNS: [NamedDesign; 3] = [
    NamedDesign {
        name: "lin-2.1",
        parameters: dissertation(16.5e-3, 20e-3, 2.778e-3, GrooveSize::Radius(3.254e-3)),
        loaded_balls: 32,
    },
    NamedDesign {
        name: "lin-3.6",
        parameters: dissertation(16.5e-3, 20e-3, 2.778e-3, GrooveSize::Conformity(0.56)),
        loaded_balls: 37,
    },
    NamedDesign {
        name: "lin-4.1",
        parameters: dissertation(14.5e-3, 7e-3, 2e-3, GrooveSize::Radius(2.16e-3)),
        loaded_balls: 71,
    },
];

const fn dissertation(
    pitch_radius: f32,
    lead: f32,
    ball_radius: f32,
    groove: GrooveSize,
) -> BallScrewParameters {
    BallScrewParameters {
        pitch_radius,
        lead,
        ball_radius,
        screw_groove: groove,
        nut_groove: groove,
        contact_angle: FRAC_PI_4,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    }
}

/// The 31 sizes of Tables A1 and A2 (Bertolino et al. 2023), in their order. The row printed as 20 x 65 x 3.5 is here 20 x 60 x 3.5: its printed lead
/// angle (43.68 degrees) and its printed errors are those of a lead of 60 mm.
pub const CATALOGUE: [CatalogueSize; 31] = [
    size("125x10x7.144", 125e-3, 10e-3, 7.144e-3),
    size("160x25x12.7", 160e-3, 25e-3, 12.7e-3),
    size("125x20x12.7", 125e-3, 20e-3, 12.7e-3),
    size("160x30x12.7", 160e-3, 30e-3, 12.7e-3),
    size("125x25x12.7", 125e-3, 25e-3, 12.7e-3),
    size("125x30x12.7", 125e-3, 30e-3, 12.7e-3),
    size("100x30x12.7", 100e-3, 30e-3, 12.7e-3),
    size("80x25x12.7", 80e-3, 25e-3, 12.7e-3),
    size("125x40x12.7", 125e-3, 40e-3, 12.7e-3),
    size("80x30x9.525", 80e-3, 30e-3, 9.525e-3),
    size("63x25x9.525", 63e-3, 25e-3, 9.525e-3),
    size("50x20x6.35", 50e-3, 20e-3, 6.35e-3),
    size("100x40x12.7", 100e-3, 40e-3, 12.7e-3),
    size("32x15x6.35", 32e-3, 15e-3, 6.35e-3),
    size("50x25x6.35", 50e-3, 25e-3, 6.35e-3),
    size("32x20x6.35", 32e-3, 20e-3, 6.35e-3),
    size("80x60x9.525", 80e-3, 60e-3, 9.525e-3),
    size("25x20x3.5", 25e-3, 20e-3, 3.5e-3),
    size("40x40x6.35", 40e-3, 40e-3, 6.35e-3),
    size("32x32x4.762", 32e-3, 32e-3, 4.762e-3),
    size("50x60x6.35", 50e-3, 60e-3, 6.35e-3),
    size("32x40x4.762", 32e-3, 40e-3, 4.762e-3),
    size("63x80x7.144", 63e-3, 80e-3, 7.144e-3),
    size("40x60x6.35", 40e-3, 60e-3, 6.35e-3),
    size("40x60x7.144", 40e-3, 60e-3, 7.144e-3),
    size("25x50x3.5", 25e-3, 50e-3, 3.5e-3),
    size("32x64x4.762", 32e-3, 64e-3, 4.762e-3),
    size("50x100x7.144", 50e-3, 100e-3, 7.144e-3),
    size("20x50x3.5", 20e-3, 50e-3, 3.5e-3),
    size("20x60x3.5", 20e-3, 60e-3, 3.5e-3),
    size("25x80x3.5", 25e-3, 80e-3, 3.5e-3),
];

const fn size(
    name: &'static str,
    nominal_diameter: f32,
    lead: f32,
    ball_diameter: f32,
) -> CatalogueSize {
    CatalogueSize {
        name,
        nominal_diameter,
        lead,
        ball_diameter,
    }
}

/// Fine-lead sizes that are usual in the catalogues of makers of ball screws, with a ball diameter that they print.
pub const FINE_LEAD_SIZES: [CatalogueSize; 15] = [
    size("16x5x3.175", 16e-3, 5e-3, 3.175e-3),
    size("20x5x3.175", 20e-3, 5e-3, 3.175e-3),
    size("25x5x3.175", 25e-3, 5e-3, 3.175e-3),
    size("25x10x3.969", 25e-3, 10e-3, 3.969e-3),
    size("25x10x4.762", 25e-3, 10e-3, 4.762e-3),
    size("32x5x3.175", 32e-3, 5e-3, 3.175e-3),
    size("32x5x3.5", 32e-3, 5e-3, 3.5e-3),
    size("32x10x3.969", 32e-3, 10e-3, 3.969e-3),
    size("32x10x6.35", 32e-3, 10e-3, 6.35e-3),
    size("40x5x3.175", 40e-3, 5e-3, 3.175e-3),
    size("40x5x3.5", 40e-3, 5e-3, 3.5e-3),
    size("40x10x6.35", 40e-3, 10e-3, 6.35e-3),
    size("50x5x3.175", 50e-3, 5e-3, 3.175e-3),
    size("50x10x6.35", 50e-3, 10e-3, 6.35e-3),
    size("63x10x6.35", 63e-3, 10e-3, 6.35e-3),
];

/// Round sizes near that of a rack-assist steering gear (Lin 2019, Table 4.1: 29 x 7 x 4). Assumed, of no maker.
pub const STEERING_SIZES: [CatalogueSize; 3] = [
    size("25x7x3.5", 25e-3, 7e-3, 3.5e-3),
    size("28x7x3.969", 28e-3, 7e-3, 3.969e-3),
    size("30x8x4.762", 30e-3, 8e-3, 4.762e-3),
];

/// The parameters of a built-in design by its name, as `25x5x3.175` or `lin-4.1`; for constants too.
///
/// ```
/// use epas_friction::{BallScrew, geometry::named};
///
/// let design = BallScrew::new(named("25x5x3.175").unwrap())?;
/// assert_eq!(design.lead(), 5e-3);
/// assert!(named("25x5").is_none());
/// # Ok::<(), epas_friction::Error>(())
/// ```
pub const fn named(name: &str) -> Option<BallScrewParameters> {
    match place(name) {
        Some((list, index)) if list < SIZES.len() => Some(SIZES[list][index].parameters()),
        Some((_, index)) => Some(DISSERTATION_DESIGNS[index].parameters),
        None => None,
    }
}

/// Place of a built-in design among [`CATALOGUE`], [`FINE_LEAD_SIZES`], [`STEERING_SIZES`] and [`DISSERTATION_DESIGNS`] one after another.
pub(crate) const fn position(name: &str) -> Option<usize> {
    let Some((list, index)) = place(name) else {
        return None;
    };
    let (mut before, mut earlier) = (0, 0);
    while earlier < list {
        before += SIZES[earlier].len();
        earlier += 1;
    }
    Some(before + index)
}

const SIZES: [&[CatalogueSize]; 3] = [&CATALOGUE, &FINE_LEAD_SIZES, &STEERING_SIZES];

/// List of a name and its place there; behind [`SIZES`] is [`DISSERTATION_DESIGNS`].
const fn place(name: &str) -> Option<(usize, usize)> {
    let mut list = 0;
    while list < SIZES.len() {
        let mut index = 0;
        while index < SIZES[list].len() {
            if same(SIZES[list][index].name, name) {
                return Some((list, index));
            }
            index += 1;
        }
        list += 1;
    }
    let mut index = 0;
    while index < DISSERTATION_DESIGNS.len() {
        if same(DISSERTATION_DESIGNS[index].name, name) {
            return Some((list, index));
        }
        index += 1;
    }
    None
}

const fn same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    if one.len() != other.len() {
        return false;
    }
    let mut index = 0;
    while index < one.len() {
        if one[index] != other[index] {
            return false;
        }
        index += 1;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found_and_says_its_size() {
        let sizes = CATALOGUE
            .iter()
            .chain(&FINE_LEAD_SIZES)
            .chain(&STEERING_SIZES);
        for size in sizes {
            assert_eq!(named(size.name), Some(size.parameters()), "{}", size.name);
            let said = size
                .name
                .split('x')
                .map(|number| number.parse::<f32>().unwrap());
            let own = [size.nominal_diameter, size.lead, size.ball_diameter];
            for (said, own) in said.zip(own) {
                // One rounding of the printed number, one of the length, one of the product.
                let off = (own * 1e3 - said).abs();
                assert!(off <= 3.0 * f32::EPSILON * said, "{}", size.name);
            }
            assert!(size.design().is_ok(), "{}", size.name);
        }
        for design in &DISSERTATION_DESIGNS {
            assert_eq!(named(design.name), Some(design.parameters));
        }
        assert_eq!(named("25x5"), None);
        const _: () = assert!(named("lin-4.1").is_some() && named("lin-4.2").is_none());
    }
}
