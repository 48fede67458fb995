//! A figure beside the computed one, and what a computation needs.

use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::RollingResistance;
use epas_reference::material::Elastic;

/// Parameters of friction that no drawing prints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    /// Friction coefficient of the grooves.
    pub friction: f64,
    /// Radial gap of every contact, m; below zero for oversize.
    pub clearance: f64,
    /// Rolling resistance.
    pub rolling: RollingResistance,
}

/// A ball screw by the numbers on its drawing, mm, with contact angles of 45 degrees, in steel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Name.
    pub name: &'static str,
    /// Diameter of the circle of ball centres.
    pub diameter: f64,
    /// Lead.
    pub lead: f64,
    /// Ball diameter.
    pub ball: f64,
    /// Groove radius over ball diameter.
    pub conformity: f64,
    /// Balls that carry.
    pub balls: f64,
}

impl Size {
    /// The design.
    #[must_use]
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
    #[must_use]
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

/// What became of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The computed number lies in the figure's band.
    Within,
    /// It lies outside.
    Apart,
    /// The figure is a tendency or an order, which the model shares.
    InKind,
    /// The model has no such effect, or too much is missing.
    NotComputed,
}

impl Standing {
    /// As printed.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Within => "within the band",
            Self::Apart => "apart",
            Self::InKind => "agrees in kind",
            Self::NotComputed => "not computed",
        }
    }

    /// Whether a range of computed numbers lies in a band.
    #[must_use]
    pub fn of(computed: [f64; 2], band: [f64; 2]) -> Self {
        if computed[0] >= band[0] && computed[1] <= band[1] {
            Self::Within
        } else {
            Self::Apart
        }
    }
}

/// How a figure is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Read in its source.
    Seen(&'static str),
    /// From memory: to be checked before a conclusion hangs on it.
    Recalled(&'static str),
}

impl Source {
    /// As printed.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Seen(source) => source.into(),
            Self::Recalled(source) => format!("{source} (from memory)"),
        }
    }
}

/// A figure beside the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// What it is.
    pub what: &'static str,
    /// As given.
    pub figure: &'static str,
    /// Where it is from.
    pub source: Source,
    /// As computed, with what had to be assumed.
    pub computed: String,
    /// What became of it.
    pub standing: Standing,
    /// Which parameter would have to be what to meet the figure; or what is missing.
    pub needed: String,
}
