//! Scenes whose balls press on each other, as a design file gives them.

use std::f64::consts::TAU;
use std::path::Path;

use crate::CagedDesign;
use epas_friction::{
    DeviationMap, GrooveSize, LinearBearing, LinearBearingConfiguration, LinearBearingParameters,
    LinearLimits, LoadShare, LoadShares, defaults,
};
use serde::Deserialize;

use super::deviation::{self, Given, Wavelet};
use super::plausible;
use super::tables::{
    MaterialTable, from_text, groove_size, mark, material, parsed, radius, replace,
};
use crate::Failure;
use crate::uncaged::BALL_FRICTION;

/// A ball screw without cage.
#[derive(Clone, Copy, Debug)]
pub struct UncagedDesign {
    /// Number of balls in the circuit.
    pub balls: u8,
    /// The screw with its numbers; how many balls share the load follows from the circuit.
    pub gear: CagedDesign,
    /// Friction coefficient of ball and ball.
    pub ball_friction: f32,
    /// Turns of the loaded track.
    pub turns: f32,
    /// Length of the return, m.
    pub return_length: f32,
    /// Deviation of the contact angles along the screw's groove.
    pub screw_deviation: &'static DeviationMap,
    /// Deviation of the contact angles along the nut's groove.
    pub nut_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, along the loaded track.
    pub load_shares: LoadShares,
    /// What its deviation is, where the closed form of the whole screw can follow it.
    pub wave: Option<Wave>,
}

impl UncagedDesign {
    /// Largest deviations of the contact angle on screw and nut, rad: bounds of what the maps give anywhere.
    pub fn deviations(&self) -> [f32; 2] {
        [self.screw_deviation, self.nut_deviation].map(DeviationMap::largest)
    }

    /// Balls that share the load: those on the loaded track.
    pub fn loaded_balls(&self) -> f32 {
        let screw = &self.gear.design;
        let loaded =
            self.turns * std::f32::consts::TAU * screw.pitch_radius() / screw.cos_lead_angle();
        f32::from(self.balls) * loaded / (loaded + self.return_length)
    }

    /// Refuses another number of loaded balls than those on the loaded track, beyond one ball and a twentieth of them: balls are not placed evenly.
    pub fn check_loaded(&self, loaded_balls: u16) -> Result<(), String> {
        let own = self.loaded_balls();
        let apart = (0.05 * own).max(1.0);
        let given = f32::from(loaded_balls);
        // Numbers that are no lengths are refused by their names, later.
        if (given - own).abs() <= apart || own.is_nan() {
            return Ok(());
        }
        Err(format!(
            "loaded_balls = {loaded_balls} does not follow from [uncaged]: of balls = {} with turns = {} and return_length = {}, {own:.1} are loaded; \
             allowed: {:.0} to {:.0}, or other numbers in [uncaged], which is one circuit",
            self.balls,
            self.turns,
            self.return_length,
            (own - apart).ceil().max(1.0),
            (own + apart).floor(),
        ))
    }

    /// Refuses more balls than there is track for.
    pub fn check_room(&self) -> Result<(), String> {
        let screw = &self.gear.design;
        let radius = f64::from(screw.pitch_radius());
        let path = radius.hypot(f64::from(screw.lead()) / TAU);
        let track = f64::from(self.turns) * TAU * path + f64::from(self.return_length);
        // Along the curved track a ball takes the arc over its diameter.
        let curved = path * path / radius;
        let ball = 2.0 * curved * (f64::from(screw.ball_radius()) / curved).asin();
        let needed = f64::from(self.balls) * ball;
        // Numbers that are no lengths are refused by their names, later.
        if track.is_finite() && track > 0.0 && needed > track {
            return Err(format!(
                "balls = {}: they need {:.1} mm, and track (turns) and return_length have {:.1}; at most {} go in; several circuits are several models",
                self.balls,
                1e3 * needed,
                1e3 * track,
                (track / ball) as u32
            ));
        }
        Ok(())
    }

    /// Largest load of one ball under an axial load, N.
    pub fn ball_load(&self, axial_load: f32) -> f32 {
        let LoadShares { positive, negative } = self.load_shares;
        let shares = positive.iter().chain(negative).map(LoadShare::share);
        axial_load.abs() / self.loaded_balls() * shares.fold(1.0, f32::max)
    }
}

/// A deviation of the screw alone, `amplitude sin(order phi)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Amplitude, rad.
    pub amplitude: f32,
    /// Periods in a turn.
    pub order: u8,
}

impl Wave {
    /// The only wave, or none of an amplitude.
    fn of(waves: &[Wavelet]) -> Option<Self> {
        match waves {
            [] => Some(Self {
                amplitude: 0.0,
                order: 1,
            }),
            [
                Wavelet {
                    order,
                    cosine: 0.0,
                    sine,
                },
            ] => Some(Self {
                amplitude: *sine,
                order: *order,
            }),
            _ => None,
        }
    }
}

/// A linear bearing: how many balls, and everything but the tick.
#[derive(Clone, Debug)]
pub struct LinearDesign {
    /// Name, for headings and file names.
    pub name: String,
    /// Number of balls in the circuit.
    pub balls: u8,
    /// Configuration; the tick is the trace's.
    pub configuration: LinearBearingConfiguration,
    /// Keys that its file leaves to the defaults.
    pub defaulted: Vec<&'static str>,
}

/// What a design lacks that says nothing of its balls.
pub fn no_row(design: &str) -> String {
    format!(
        "{design} says nothing of its balls: a design file does in a table [uncaged], and of the built-in designs lin-3.6"
    )
}

/// Name of the built-in linear bearing.
pub const LINEAR: &str = "lin-3.3";

/// Table `[uncaged]` of a design file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UncagedTable {
    balls: u8,
    turns: f32,
    ball_friction: Option<f32>,
    /// What the design's `clearance` has replaced.
    fit: Option<toml::Value>,
    return_length: Option<f32>,
    deviation_turns: Option<u16>,
    screw_deviation: Option<Given>,
    nut_deviation: Option<Given>,
    load_shares: Option<Vec<f32>>,
    negative_load_shares: Option<Vec<f32>>,
}

/// Says what stands in the place of a key that files have had.
pub fn refuse_fit(fit: Option<&toml::Value>) -> Result<(), String> {
    match fit {
        None => Ok(()),
        Some(_) => Err("fit is no key; a design has clearance (m; play above 0, oversize below), axial_play (of the nut, m), preload (of \
                        one contact, N) or axial_preload (of the nut, N)"
            .into()),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LinearFile {
    name: Option<String>,
    ball_radius: Option<f32>,
    ball_diameter: Option<f32>,
    conformity: Option<f32>,
    groove_radius: Option<f32>,
    contact_angle: f32,
    youngs_modulus: Option<f32>,
    poisson_ratio: Option<f32>,
    density: Option<f32>,
    ball_material: Option<MaterialTable>,
    groove_material: Option<MaterialTable>,
    friction: Option<f32>,
    ball_friction: Option<f32>,
    balls: u8,
    loaded_length: f32,
    return_length: Option<f32>,
    wavelength: Option<f32>,
    rail_deviation: Option<Vec<Wavelet>>,
    carriage_deviation: Option<Vec<Wavelet>>,
    load_shares: Option<Vec<f32>>,
    reversal_speed: Option<f32>,
    limits: Option<LinearLimitsTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LinearLimitsTable {
    speed: Option<f32>,
    load: Option<f32>,
    friction_force: Option<f32>,
}

/// The built-in train of a ball screw of Lin 2019: Section 3.4.4, with the amplitude of the deviation that
/// gives the printed peak of Figure 3.25.
pub fn built_in(name: &str, gear: CagedDesign, balls: u16) -> Option<UncagedDesign> {
    let text = format!(
        "balls = {balls}
turns = 2.0
screw_deviation = [{{ order = 2, sine = 0.040143 }}]
"
    );
    let table = (name == "lin-3.6").then(|| parsed::<UncagedTable>(&text));
    table?.ok()?.design(gear).ok()
}

impl UncagedTable {
    /// Whether it gives the friction of balls on each other.
    pub const fn says_ball_friction(&self) -> bool {
        self.ball_friction.is_some()
    }

    /// The screw with its balls.
    pub fn design(&self, gear: CagedDesign) -> Result<UncagedDesign, String> {
        refuse_fit(self.fit.as_ref())?;
        plausible::turns(self.turns)?;
        let turns = self.deviation_turns.unwrap_or(1);
        let map = |field, given: &Option<Given>| match given {
            None => deviation::of_waves(field, turns, &[]),
            Some(given) => given.map(field, turns),
        };
        let wave = match &self.screw_deviation {
            _ if turns != 1 || self.nut_deviation.as_ref().is_some_and(Given::any) => None,
            Some(Given::Waves(waves)) => Wave::of(waves),
            None => Wave::of(&[]),
            Some(_) => None,
        };
        Ok(UncagedDesign {
            balls: self.balls,
            gear,
            ball_friction: self.ball_friction.unwrap_or(BALL_FRICTION),
            turns: self.turns,
            return_length: self.return_length.unwrap_or(0.0),
            screw_deviation: map("screw_deviation", &self.screw_deviation)?,
            nut_deviation: map("nut_deviation", &self.nut_deviation)?,
            load_shares: self.load_shares()?,
            wave: wave
                .filter(|_| self.load_shares.is_none() && self.negative_load_shares.is_none()),
        })
    }

    /// Shares of both signs of the load: one table serves both where a second one is not given.
    fn load_shares(&self) -> Result<LoadShares, String> {
        let positive = shares("load_shares", self.load_shares.as_deref())?;
        let negative = match &self.negative_load_shares {
            None => positive,
            Some(_) if self.load_shares.is_none() => {
                return Err(
                    "negative_load_shares needs load_shares, those of positive loads".into(),
                );
            }
            Some(given) if given.len() != positive.len() => {
                return Err(format!(
                    "negative_load_shares has {} entries where load_shares has {}",
                    given.len(),
                    positive.len()
                ));
            }
            given => shares("negative_load_shares", given.as_deref())?,
        };
        Ok(LoadShares { positive, negative })
    }
}

impl LinearDesign {
    /// The word behind a setting that its file leaves to the default.
    pub fn mark(&self, key: &str) -> &'static str {
        mark(&self.defaulted, key)
    }

    /// The bearing of Lin 2019, Table 3.3; number of balls, length and deviation are this program's: the
    /// text has two balls.
    pub fn built_in() -> Result<Self, Failure> {
        const TEXT: &str = "\
ball_radius = 5e-3
conformity = 0.56
contact_angle = 0.7853982
friction = 0.1
ball_friction = 0.1
balls = 12
loaded_length = 0.1
return_length = 0.0205
wavelength = 0.04
rail_deviation = [{ order = 1, sine = 0.0349 }]
";
        Self::parse(TEXT, LINEAR).map_err(|message| Failure::Domain(format!("{LINEAR}: {message}")))
    }

    /// The bearing of a design file's text; its name where it has none.
    pub fn parse(text: &str, name: &str) -> Result<Self, String> {
        let file: LinearFile = parsed(text)?;
        file.design(name)
    }

    /// The bearing of a design file with this text.
    pub fn read(path: &Path, text: &str) -> Result<Self, Failure> {
        from_text(path, text, LinearFile::design)
    }
}

impl LinearFile {
    fn design(self, stem: &str) -> Result<LinearDesign, String> {
        let common = MaterialTable {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
            density: self.density,
        };
        let groove: GrooveSize = groove_size("groove", self.conformity, self.groove_radius)?;
        let ball_radius = radius(
            ("ball_radius", self.ball_radius),
            ("ball_diameter", self.ball_diameter),
        )?;
        let bearing = LinearBearing::new(LinearBearingParameters {
            ball_radius,
            groove,
            contact_angle: self.contact_angle,
            ball_material: material(self.ball_material.as_ref(), &common),
            groove_material: material(self.groove_material.as_ref(), &common),
        })
        .map_err(|error| plausible::Given::default().words(&error))?;
        plausible::conformity("groove", groove, ball_radius)?;
        let mut limits = LinearLimits {
            speed: 2.0,
            load: 1e5,
            friction_force: 1e4,
        };
        if let Some(table) = self.limits {
            replace(&mut limits.speed, table.speed);
            replace(&mut limits.load, table.load);
            replace(&mut limits.friction_force, table.friction_force);
        }
        let on = |field, waves: &Option<Vec<Wavelet>>| {
            deviation::of_waves(field, 1, waves.as_deref().unwrap_or_default())
        };
        Ok(LinearDesign {
            name: self.name.clone().unwrap_or_else(|| stem.into()),
            balls: self.balls,
            defaulted: [
                ("friction", self.friction),
                ("ball_friction", self.ball_friction),
            ]
            .into_iter()
            .filter_map(|(key, given)| given.is_none().then_some(key))
            .collect(),
            configuration: LinearBearingConfiguration {
                bearing,
                friction: self.friction.unwrap_or(defaults::FRICTION),
                ball_friction: self.ball_friction.unwrap_or(BALL_FRICTION),
                balls: self.balls.into(),
                loaded_length: self.loaded_length,
                return_length: self.return_length.unwrap_or(0.0),
                wavelength: self.wavelength.unwrap_or(self.loaded_length),
                rail_deviation: on("rail_deviation", &self.rail_deviation)?,
                carriage_deviation: on("carriage_deviation", &self.carriage_deviation)?,
                load_shares: shares("load_shares", self.load_shares.as_deref())?,
                reversal_speed: self.reversal_speed.unwrap_or(1e-3),
                tick: 1e-3,
                limits,
            },
        })
    }
}

fn shares(field: &str, given: Option<&[f32]>) -> Result<&'static [LoadShare], String> {
    let Some(given) = given else {
        return Ok(&[LoadShare::MEAN]);
    };
    let shares = given
        .iter()
        .map(|share| LoadShare::new(*share))
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| format!("{field}: {error}"))?;
    Ok(Vec::leak(shares))
}
