//! Friction of a steering gear's screw over temperature: slip and spin by the exact ball with a coefficient that follows the film, and the
//! lubricant's drag.

use rayon::prelude::*;

use super::figure::{Size, Usual};
use epas_reference::coefficient::coefficient;
use epas_reference::curvature::Groove;
use epas_reference::drag::screw_torque;
use epas_reference::error::ReferenceError;

/// The screw of Table 4.1 of Lin 2019, of a steering gear's size.
pub const STEERING: Size = Size {
    name: "29x7, 71 balls",
    diameter: 29.0,
    lead: 7.0,
    ball: 4.0,
    conformity: 0.54,
    balls: 71.0,
};

/// Temperatures, degrees Celsius.
pub const TEMPERATURES: [f64; 13] = [
    -40.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0,
];

/// Speeds of the nut, rad/s: a slow correction, on-centre steering, a fast turn.
pub const SPEEDS: [f64; 3] = [1.0, 5.0, 20.0];

/// Axial loads, N: none, and that of slow driving.
pub const LOADS: [f64; 2] = [0.0, 5000.0];

/// Speed of the nut, rad/s, and axial load, N, at which friction falls furthest in the cold: slow parking.
pub const LEAST: (f64, f64) = (0.7, 14_000.0);

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubricant {
    /// Two temperatures, degrees Celsius, with the viscosities, Pa s, between which it goes with the fifth power of the distance from a pole.
    pub viscosities: [(f64, f64); 2],
    /// Density, kg/m³.
    pub density: f64,
    /// Drag over that of flooded contacts.
    pub flooding: f64,
    /// Friction coefficient at standstill and on a full film.
    pub coefficients: [f64; 2],
    /// Speed of the nut, rad/s, at which half of the difference is gone, at 20 degrees.
    pub half_share_speed: f64,
}

/// A steering gear's grease with its film, assumed: a poly-alpha-olefin of 48 mm²/s at 40 degrees, 19,000 at -40, 833 kg/m³ at 15.
pub const GREASE: Lubricant = Lubricant {
    viscosities: [(-40.0, 16.4), (40.0, 0.0393)],
    density: 850.0,
    flooding: 0.7,
    coefficients: [0.12, 0.05],
    half_share_speed: 15.35,
};

impl Lubricant {
    /// Viscosity, Pa s, at a temperature, degrees Celsius.
    pub fn viscosity(&self, celsius: f64) -> f64 {
        let [(cold, thick), (warm, thin)] = self.viscosities;
        let root = (thick / thin).powf(0.2);
        let pole = cold - (warm - cold) / (root - 1.0);
        thick * ((cold - pole) / (celsius - pole)).powi(5)
    }

    /// Friction coefficient at a speed, rad/s.
    pub fn coefficient(&self, celsius: f64, speed: f64) -> f64 {
        let half = self.half_share_speed * self.viscosity(20.0) / self.viscosity(celsius);
        let [boundary, full_film] = self.coefficients;
        coefficient(boundary, full_film, half / (half + speed))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    pub celsius: f64,
    /// Speed of the nut, rad/s.
    pub speed: f64,
    /// Axial load, N.
    pub load: f64,
    pub grooves: f64,
    pub drag: f64,
}

impl Friction {
    pub fn torque(&self) -> f64 {
        self.grooves + self.drag
    }
}

/// Both flanks' axial loads, N, of a screw whose balls are too large by `oversize`, m, under a load: Hertzian flanks that share one deflection.
fn flanks(size: &Size, oversize: f64, load: f64) -> Result<[f64; 2], ReferenceError> {
    let design = size.design();
    let compliance =
        design.contact(Groove::Screw)?.deflection + design.contact(Groove::Nut)?.deflection;
    let sine = design.contact_angle.sin() * design.lead_angle().cos();
    let preload = size.balls * sine * (2.0 * oversize / compliance).powf(1.5);
    if load >= 8_f64.sqrt() * preload {
        return Ok([load, 0.0]);
    }
    let power = |force: f64| force.cbrt().powi(2);
    let (mut low, mut high) = (0.0, preload);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if power(middle) + power(middle + load) < 2.0 * power(preload) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok([low + load, low])
}

/// Friction of [`STEERING`] at a state.
pub fn friction(
    usual: &Usual,
    lubricant: &Lubricant,
    (celsius, speed, load): (f64, f64, f64),
) -> Result<Friction, ReferenceError> {
    let usual = Usual {
        friction: lubricant.coefficient(celsius, speed),
        ..*usual
    };
    // A load that hardly counts, because a balance needs one.
    let grooves = STEERING.under(load.max(1.0), &usual).solve()?.torque();
    let oil = (lubricant.viscosity(celsius), lubricant.density);
    let mut drag = 0.0;
    for flank in flanks(&STEERING, (-usual.clearance).max(0.0), load)? {
        if flank > 0.0 {
            drag += screw_torque(&STEERING.design(), STEERING.balls, flank, oil, speed)?;
        }
    }
    Ok(Friction {
        celsius,
        speed,
        load,
        grooves,
        drag: lubricant.flooding * drag,
    })
}

/// Friction at -40 degrees Celsius over that at 20, at a speed of the nut, rad/s, and an axial load, N.
pub fn growth(
    usual: &Usual,
    lubricant: &Lubricant,
    (speed, load): (f64, f64),
) -> Result<f64, ReferenceError> {
    let at = |celsius| Ok(friction(usual, lubricant, (celsius, speed, load))?.torque());
    Ok(at(-40.0)? / at(20.0)?)
}

/// Friction at all of [`LOADS`], [`SPEEDS`] and [`TEMPERATURES`], in this order.
pub fn over_temperature(
    usual: &Usual,
    lubricant: &Lubricant,
) -> Result<Vec<Friction>, ReferenceError> {
    let mut states = Vec::new();
    for load in LOADS {
        for speed in SPEEDS {
            states.extend(TEMPERATURES.map(|celsius| (celsius, speed, load)));
        }
    }
    states
        .par_iter()
        .map(|state| friction(usual, lubricant, *state))
        .collect()
}
