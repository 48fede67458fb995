//! Viscosity of a lubricant by temperature.

use crate::error::{Error, Range, attempt, in_range};

/// Temperature, K, of a lubricant: -123 to 227 degrees Celsius.
pub const TEMPERATURE: Range = Range::new(150.0, 500.0);

/// Dynamic viscosity, Pa s.
const VISCOSITY: Range = Range::new(1e-4, 1e4);

/// Least distance from the pole of the formula, K: no oil flows there.
pub(super) const MARGIN: f32 = 10.0;

/// Least and largest ratio of the two viscosities: 3 to 30 of oils between 40 and 100 degrees Celsius.
const RATIO: Range = Range::new(1.5, 1e4);

/// Temperatures at which data sheets print viscosities, K: 40 and 100 degrees Celsius.
const PRINTED: (f32, f32) = (313.15, 373.15);

/// Loss of density of an oil, 1/K, and the temperature at which its density is printed, K.
const EXPANSION: (f32, f32) = (6.5e-4, 288.15);

/// Steps of Newton's method for a fifth root: from 1e8, the largest ratio of two viscosities, `ln(1e8/40)/ln(1.25)` = 66, and six more for the digits.
const ROOT_STEPS: u8 = 80;

/// Data sheet of an oil, or of the base oil of a grease; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OilData {
    /// Kinematic viscosity at 40 degrees Celsius, m²/s; 1 cSt, or mm²/s, is 1e-6. At least 1.5 times that at 100 degrees.
    pub kinematic_viscosity_40: f32,
    /// Kinematic viscosity at 100 degrees Celsius, m²/s; 1e-7 to 1e-2.
    pub kinematic_viscosity_100: f32,
    /// Density at 15 degrees Celsius, kg/m³, 500 to 2000.
    pub density: f32,
    /// Pour point, K, 150 to 313: the oil does not flow below it.
    pub pour_point: f32,
}

/// Dynamic viscosity of a lubricant by temperature.
///
/// ```text
/// visc(Theta) = visc_1 ((Theta_1 - Theta_s)/(Theta - Theta_s))^5
/// Theta_s = Theta_1 - (Theta_2 - Theta_1)/(v - 1)        v = (visc_1/visc_2)^(1/5)
/// ```
///
/// through two viscosities `visc_1`, `visc_2` at the temperatures `Theta_1 < Theta_2`, with the pole `Theta_s`; below the pour point, or 10 K above
/// `Theta_s` if that is more, viscosity counts as there.
///
/// Four multiplications and a division where the laws of Vogel and of Walther (ASTM D341) take exponentials. Largest errors
/// of the viscosity, from two printed at 40 and 100 degrees Celsius:
///
/// | oil | 0 to 100 C | -20 to 120 C | -40 to 120 C |
/// |---|---|---|---|
/// | Vogel, 0.088 and 0.0095 Pa s, its pole at -150 C | 12 % | 16 % | 16 % |
/// | the same, `Theta_s` fitted over -20 to 120 C (-64 C) | 5 % | 6 % | 87 % |
/// | Walther, 100 and 11.2 mm²/s (mineral, viscosity index 98) | 43 % | 67 % | 81 % |
/// | Walther, 100 and 14.5 mm²/s (synthetic, viscosity index 150) | 35 % | 59 % | 77 % |
///
/// Walther's oils are three times stiffer at -20 degrees; that shifts a coefficient by at most 0.27 of the difference of both coefficients. Through 0
/// and 40 degrees ([`Viscosity::through`]) the mineral oil of the table is within 20 % from -20 to 60 degrees.
///
/// ```
/// use epas_friction::law::coefficient::{OilData, Viscosity};
/// let oil = Viscosity::of_oil(&OilData {
///     kinematic_viscosity_40: 100e-6,
///     kinematic_viscosity_100: 11.2e-6,
///     density: 880.0,
///     pour_point: 233.15,
/// })?;
/// assert!((oil.at(313.15) - 0.0866).abs() < 1e-4);
/// assert!(oil.at(273.15) > 5.0 * oil.at(313.15));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Viscosity {
    /// `Theta_1`, K, and `visc_1`, Pa s.
    point: (f32, f32),
    /// `Theta_s`, K.
    pole: f32,
    /// Temperature below which nothing changes, K.
    floor: f32,
}

impl Viscosity {
    /// From an oil's data sheet.
    pub const fn of_oil(data: &OilData) -> Result<Self, Error> {
        let OilData {
            kinematic_viscosity_40: cold,
            kinematic_viscosity_100: warm,
            density,
            pour_point,
        } = *data;
        attempt!(in_range("kinematic_viscosity_100", warm, 1e-7, 1e-2));
        let (least, most) = (RATIO.minimum * warm, RATIO.maximum * warm);
        attempt!(in_range("kinematic_viscosity_40", cold, least, most));
        attempt!(in_range("density", density, 500.0, 2000.0));
        let (coldest, flows) = (TEMPERATURE.minimum, PRINTED.0);
        attempt!(in_range("pour_point", pour_point, coldest, flows));
        let (at_cold, at_warm) = PRINTED;
        let (expansion, printed) = EXPANSION;
        let dense_cold = density * (1.0 - expansion * (at_cold - printed));
        let dense_warm = density * (1.0 - expansion * (at_warm - printed));
        Self::folded(
            (at_cold, cold * dense_cold),
            (at_warm, warm * dense_warm),
            pour_point,
        )
    }

    /// Through two temperatures, K, 150 to 500, 10 K apart or more, with their dynamic viscosities, Pa s, 1e-4 to 1e4: the colder one
    /// first, at least 1.5 times as viscous, and at most as a pole 10 K below allows. The pour point, K, is at most the colder one.
    pub const fn through(
        cold: (f32, f32),
        warm: (f32, f32),
        pour_point: f32,
    ) -> Result<Self, Error> {
        attempt!(TEMPERATURE.checked("temperature", cold.0));
        let (least, most) = (cold.0 + MARGIN, TEMPERATURE.maximum);
        attempt!(in_range("temperature", warm.0, least, most));
        attempt!(VISCOSITY.checked("viscosity", warm.1));
        attempt!(VISCOSITY.checked("viscosity", cold.1));
        let coldest = TEMPERATURE.minimum;
        attempt!(in_range("pour_point", pour_point, coldest, cold.0));
        Self::folded(cold, warm, pour_point)
    }

    const fn folded(cold: (f32, f32), warm: (f32, f32), pour_point: f32) -> Result<Self, Error> {
        // A stiffer oil would have its pole next to the colder temperature.
        let growth = 1.0 + (warm.0 - cold.0) / MARGIN;
        let square = growth * growth;
        let least = RATIO.minimum * warm.1;
        let most = square * square * growth * warm.1;
        attempt!(in_range("viscosity", cold.1, least, most));
        let root = fifth_root(cold.1 / warm.1);
        let pole = cold.0 - (warm.0 - cold.0) / (root - 1.0);
        let floor = pour_point.max(pole + MARGIN);
        Ok(Self {
            point: cold,
            pole,
            floor,
        })
    }

    /// Dynamic viscosity, Pa s, at a temperature, K; below [`Self::floor`] as there. NaN gives NaN.
    pub const fn at(&self, temperature: f32) -> f32 {
        let temperature = if temperature < self.floor {
            self.floor
        } else {
            temperature
        };
        let (reference, viscosity) = self.point;
        let ratio = (reference - self.pole) / (temperature - self.pole);
        let square = ratio * ratio;
        viscosity * (square * square * ratio)
    }

    /// Temperature `Theta_s` at which the formula has its pole, K.
    pub const fn pole(&self) -> f32 {
        self.pole
    }

    /// Temperature below which viscosity counts as there, K.
    pub const fn floor(&self) -> f32 {
        self.floor
    }
}

/// `x^(1/5)` of a number 1e-5 to 1e8, by Newton's method from above: within a rounding.
pub(super) const fn fifth_root(x: f32) -> f32 {
    let mut root = if x > 1.0 { x } else { 1.0 };
    let mut step = 0;
    while step < ROOT_STEPS {
        let square = root * root;
        root -= 0.2 * (root - x / (square * square));
        step += 1;
    }
    root
}
