//! A figure beside the computed one, and what a computation needs.

use std::collections::BTreeMap;

use epas_page::failure::Failure;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::RollingResistance;
use epas_reference::material::Elastic;
use serde::Deserialize;

/// Parameters of friction that no drawing prints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    pub friction: f64,
    /// Radial gap of every contact, m; below zero for oversize.
    pub clearance: f64,
    pub rolling: RollingResistance,
}

/// A ball screw by the numbers on its drawing, mm, with contact angles of 45 degrees, in steel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub name: &'static str,
    pub diameter: f64,
    pub lead: f64,
    pub ball: f64,
    /// Groove radius over ball diameter.
    pub conformity: f64,
    pub balls: f64,
}

impl Size {
    pub fn design(&self) -> BallScrewDesign {
        let groove_radius = 1e-3 * self.conformity * self.ball;
        BallScrewDesign {
            pitch_radius: 0.5e-3 * self.diameter,
            lead: 1e-3 * self.lead,
            ball_radius: 0.5e-3 * self.ball,
            screw_groove_radius: groove_radius,
            nut_groove_radius: groove_radius,
            contact_angle: std::f64::consts::FRAC_PI_4,
            ball: Elastic::STEEL,
            groove: Elastic::STEEL,
        }
    }

    /// The screw under a load, N, with the usual parameters.
    pub fn under(&self, axial_load: f64, usual: &Usual) -> LoadedScrew {
        LoadedScrew {
            design: self.design(),
            clearance: usual.clearance,
            friction: usual.friction,
            rolling: usual.rolling,
            balls: self.balls,
            axial_load,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The computed number lies in the figure's band.
    Within,
    Apart,
    /// The figure is a tendency or an order, which the model shares.
    InKind,
    NotComputed,
}

impl Standing {
    pub fn name(self) -> &'static str {
        match self {
            Self::Within => "within the band",
            Self::Apart => "apart",
            Self::InKind => "agrees in kind",
            Self::NotComputed => "not computed",
        }
    }

    pub fn of(computed: [f64; 2], band: [f64; 2]) -> Self {
        if computed[0] >= band[0] && computed[1] <= band[1] {
            Self::Within
        } else {
            Self::Apart
        }
    }
}

/// Words of a figure as `measured.toml` has them.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Words {
    what: String,
    figure: String,
    source: String,
    /// From memory: to be checked before a conclusion hangs on it.
    #[serde(default)]
    recalled: bool,
    computed: String,
    needed: String,
}

pub(super) struct Found {
    standing: Standing,
    computed: Vec<String>,
    needed: Vec<String>,
}

impl Found {
    pub fn new(standing: Standing, computed: impl IntoIterator<Item = String>) -> Self {
        Self {
            standing,
            computed: computed.into_iter().collect(),
            needed: Vec::new(),
        }
    }

    pub fn needs(self, needed: impl IntoIterator<Item = String>) -> Self {
        Self {
            needed: needed.into_iter().collect(),
            ..self
        }
    }
}

pub(super) fn fixed(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}")
}

fn filled(text: &str, numbers: &[String]) -> String {
    let mut pieces = text.split("{}");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces
        .zip(numbers)
        .fold(first, |text, (piece, number)| text + number + piece)
}

#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    pub what: String,
    pub figure: String,
    /// Where it is from, and whether from memory.
    pub source: String,
    pub computed: String,
    pub standing: Standing,
    pub needed: String,
}

impl Measured {
    pub(super) fn of(name: &str, found: &Found) -> Result<Self, Failure> {
        let mut all: BTreeMap<String, Words> = toml::from_str(include_str!("../../measured.toml"))?;
        let missing = || Failure::Data(format!("measured.toml has no {name}"));
        let words = all.remove(name).ok_or_else(missing)?;
        let recalled = if words.recalled { " (from memory)" } else { "" };
        Ok(Self {
            what: words.what,
            figure: words.figure,
            source: words.source + recalled,
            computed: filled(&words.computed, &found.computed),
            standing: found.standing,
            needed: filled(&words.needed, &found.needed),
        })
    }
}
