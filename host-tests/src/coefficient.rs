//! Friction coefficient of lubricated rolling contacts: viscosity, film, and the share that asperities carry.
//!
//! Sources: Vogel 1921; Walther 1931 in the form of ASTM D341; Hamrock and Dowson 1977 (film of an elliptical contact);
//! Johnson, Greenwood and Poon 1972 and Olver and Spikes 1998 (share of the asperities, `1/(1 + lambda)^2`); SKF, Rolling Bearings, "The SKF
//! model for calculating the frictional moment" (share of boundary lubrication in the sliding friction of a running bearing).

/// Vogel's law: `eta = eta_40 exp(B (1/(t + c) - 1/(40 + c)))`, temperatures in degrees Celsius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vogel {
    /// Viscosity at 40 degrees, Pa s.
    pub viscosity_40: f64,
    /// Viscosity at 100 degrees, Pa s.
    pub viscosity_100: f64,
    /// `c`: its pole lies at `-c` degrees.
    pub offset: f64,
}

impl Vogel {
    /// Viscosity, Pa s.
    pub fn at(&self, celsius: f64) -> f64 {
        let place = |t: f64| 1.0 / (t + self.offset);
        let b = (self.viscosity_40 / self.viscosity_100).ln() / (place(40.0) - place(100.0));
        self.viscosity_40 * (b * (place(celsius) - place(40.0))).exp()
    }
}

/// Walther's law: `lg lg (nu + 0.7)` is linear in `lg T`, with `nu` in mm²/s and `T` in K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walther {
    /// Kinematic viscosity at 40 degrees Celsius, mm²/s.
    pub viscosity_40: f64,
    /// Kinematic viscosity at 100 degrees Celsius, mm²/s.
    pub viscosity_100: f64,
}

impl Walther {
    /// Kinematic viscosity, mm²/s.
    pub fn at(&self, celsius: f64) -> f64 {
        let height = |nu: f64| (nu + 0.7).log10().log10();
        let place = |t: f64| (t + 273.15).log10();
        let (warm, cold) = (height(self.viscosity_100), height(self.viscosity_40));
        let slope = (warm - cold) / (place(100.0) - place(40.0));
        let double = cold + slope * (place(celsius) - place(40.0));
        10_f64.powf(10_f64.powf(double)) - 0.7
    }
}

/// A lubricated contact whose surfaces roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmContact {
    /// Relative radius along the direction of rolling, m.
    pub rolling_radius: f64,
    /// Axis of the ellipse across the direction of rolling over the one along it.
    pub ellipticity: f64,
    /// Load, N.
    pub load: f64,
    /// Contact modulus `1/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2)`, Pa; Hamrock and Dowson's `E'` is twice that.
    pub contact_modulus: f64,
    /// Growth of the viscosity's logarithm with pressure, 1/Pa.
    pub pressure_viscosity: f64,
    /// Roughness of both surfaces together, m.
    pub roughness: f64,
}

impl FilmContact {
    /// Central film thickness, m, at a viscosity, Pa s, and a mean speed of both surfaces, m/s:
    /// `H = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k))`.
    pub fn film(&self, viscosity: f64, speed: f64) -> f64 {
        let modulus = 2.0 * self.contact_modulus;
        let speed = viscosity * speed / (modulus * self.rolling_radius);
        let material = self.pressure_viscosity * modulus;
        let load = self.load / (modulus * self.rolling_radius * self.rolling_radius);
        self.rolling_radius
            * 2.69
            * speed.powf(0.67)
            * material.powf(0.53)
            * load.powf(-0.067)
            * (1.0 - 0.61 * (-0.73 * self.ellipticity).exp())
    }

    /// Share of the load that asperities carry: `1/(1 + film/roughness)^2`.
    pub fn asperities(&self, viscosity: f64, speed: f64) -> f64 {
        (1.0 + self.film(viscosity, speed) / self.roughness).powi(-2)
    }

    /// Mean speed of the surfaces, m/s, at which asperities carry one half: the film is `sqrt(2) - 1` of the roughness, and grows
    /// with the speed to the power of 0.67.
    pub fn half_share_speed(&self, viscosity: f64) -> f64 {
        let film = (std::f64::consts::SQRT_2 - 1.0) * self.roughness;
        (film / self.film(viscosity, 1.0)).powf(1.0 / 0.67)
    }
}

/// Friction coefficient: boundary where asperities carry, full film where the lubricant does.
pub fn coefficient(boundary: f64, full_film: f64, asperities: f64) -> f64 {
    full_film + (boundary - full_film) * asperities
}

/// A bearing's mixture of boundary and film friction by SKF's model: boundary lubrication has the share `exp(-2.6e-8 (n nu)^1.4 d_m)` of the
/// sliding friction coefficient, with `n` in 1/min, `nu` in mm²/s and `d_m` in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingMixture {
    /// Mean diameter of the bearing, of a ball screw its pitch circle, m.
    pub mean_diameter: f64,
    /// Kinematic viscosity of the lubricant, m²/s.
    pub kinematic_viscosity: f64,
}

impl BearingMixture {
    const FACTOR: f64 = 2.6e-8;
    const POWER: f64 = 1.4;

    /// Share of boundary lubrication at a speed, rad/s.
    pub fn boundary_share(&self, speed: f64) -> f64 {
        let product = speed.abs() * 30.0 / std::f64::consts::PI * (1e6 * self.kinematic_viscosity);
        (-Self::FACTOR * product.powf(Self::POWER) * (1e3 * self.mean_diameter)).exp()
    }

    /// Speed at which boundary and film friction have half each, rad/s: `(ln 2/(2.6e-8 d_m))^(1/1.4)/nu`.
    pub fn half_share_speed(&self) -> f64 {
        let exponent = std::f64::consts::LN_2 / (Self::FACTOR * (1e3 * self.mean_diameter));
        let product = exponent.powf(1.0 / Self::POWER);
        product / (1e6 * self.kinematic_viscosity) * std::f64::consts::PI / 30.0
    }
}
