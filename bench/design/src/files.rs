//! Designs by name or from a file.

mod built_in;
pub mod calibration;
pub mod capacity;
pub mod coefficient;
mod deviation;
pub mod fits;
pub mod fold;
pub mod loads;
pub mod plausible;
mod tables;
pub mod text;
pub mod train;

use std::f32::consts::TAU;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::CagedDesign;
use epas_friction::geometry::{FINE_LEAD_SIZES, STEERING_SIZES};
use epas_friction::ranges::ROLLING_CONTACT_ANGLE;
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, ClosedFormScrewConfiguration,
    ClosedFormScrewConstants, DISSERTATION_DESIGNS, Error, FrictionBranch, GrooveSize, Limits,
    RollingResistance, defaults,
};
use serde::Deserialize;

pub use plausible::SOURCES;

use crate::Failure;
use built_in::Settings;
use calibration::Calibrated;
use coefficient::FrictionLaw;
use fits::Fits;
use fold::FoldTable;
use loads::{LoadCase, LoadsTable};
use tables::{
    MaterialTable, ends, from_text, groove_size, mark, material, parsed, radius, replace, standard,
    text_of,
};
use train::{LinearDesign, UncagedDesign, UncagedTable};

/// A design with what the in-loop model has to know beside it.
#[derive(Clone, Debug)]
pub struct Design {
    /// Name, for headings and file names.
    pub name: String,
    /// Its numbers with a cage.
    pub caged: CagedDesign,
    /// Which closed form its friction follows, in the place of the contacts.
    pub branch: Option<FrictionBranch>,
    /// Lever arm of rolling friction of the closed forms.
    pub rolling_tangent: f32,
    /// Number of balls that share the load, where it is known.
    pub loaded_balls: Option<u16>,
    /// Its balls where they press on each other, where they are known.
    pub uncaged: Option<UncagedDesign>,
    /// Its screw between supports, where they are known.
    pub loads: Option<LoadCase>,
    /// What a measured trace has told of it, where there is one.
    pub calibrated: Option<Calibrated>,
    /// How its friction coefficient follows a trace's temperature without a calibration.
    pub friction_law: FrictionLaw,
    /// Whether a run follows the default law: one with a temperature.
    pub by_default_law: bool,
    /// Domain over which it is folded, where its file says it.
    pub fold: FoldTable,
    /// Keys that its file leaves to the defaults.
    pub defaulted: Vec<&'static str>,
}

/// Settings of a design that does not say them itself.
const ROLLING_RESISTANCE: RollingResistance = defaults::ROLLING_RESISTANCE;
const LIMITS: Limits = Limits {
    nut_speed: 2e3,
    axial_load: 1e5,
    friction_torque: 100.0,
};

impl Design {
    fn new(name: &str, design: BallScrew, loaded_balls: Option<u16>, settings: Settings) -> Self {
        let Settings {
            friction,
            clearance,
            reversal_speed,
        } = settings;
        let caged = CagedDesign {
            design,
            friction,
            rolling_resistance: ROLLING_RESISTANCE,
            clearance,
            loaded_balls: loaded_balls.unwrap_or_else(|| usual_balls(&design)),
            reversal_speed,
            limits: LIMITS,
        };
        Self {
            name: name.into(),
            caged,
            branch: None,
            rolling_tangent: 0.0,
            loaded_balls,
            uncaged: loaded_balls.and_then(|balls| train::built_in(name, caged, balls)),
            loads: loaded_balls.and_then(|balls| loads::built_in(name, balls)),
            calibrated: None,
            friction_law: FrictionLaw::Default,
            by_default_law: false,
            fold: FoldTable::default(),
            defaulted: Vec::new(),
        }
    }

    /// A screw with the defaults for what stands on no drawing.
    pub fn usual(screw: BallScrew, loaded_balls: Option<u16>) -> Self {
        Self::new("", screw, loaded_balls, Settings::USUAL)
    }

    /// The word behind a setting that its file leaves to the default.
    pub fn mark(&self, key: &str) -> &'static str {
        mark(&self.defaulted, key)
    }

    /// The geometry.
    pub fn screw(&self) -> &BallScrew {
        &self.caged.design
    }

    /// The closed form that its friction follows, where it does not follow the contacts.
    pub fn closed_form(&self) -> Option<ClosedFormScrewConfiguration> {
        self.branch.map(|branch| self.in_closed_form(branch))
    }

    /// Its friction by a closed form.
    pub fn in_closed_form(&self, branch: FrictionBranch) -> ClosedFormScrewConfiguration {
        let CagedDesign {
            design,
            friction,
            clearance,
            loaded_balls,
            reversal_speed,
            limits,
            ..
        } = self.caged;
        ClosedFormScrewConfiguration {
            design,
            friction,
            rolling_tangent: self.rolling_tangent,
            branch,
            clearance,
            loaded_balls,
            reversal_speed,
            limits,
        }
    }

    /// Refuses numbers out of range.
    pub fn check(&self) -> Result<(), Error> {
        let branch = self.branch.unwrap_or(FrictionBranch::Rolling);
        if self.branch.is_none() {
            self.caged.checked()?;
        }
        self.caged.rolling_resistance.checked()?;
        ClosedFormScrewConstants::new(&self.in_closed_form(branch)).map(drop)
    }
}

/// Every built-in design, those of the dissertation last.
pub fn built_in() -> impl Iterator<Item = (&'static str, BallScrewParameters, Option<u16>)> + Clone
{
    let sizes = CATALOGUE
        .iter()
        .chain(&FINE_LEAD_SIZES)
        .chain(&STEERING_SIZES);
    let catalogue = sizes.map(|size| (size.name, size.parameters(), None));
    let dissertation = DISSERTATION_DESIGNS
        .iter()
        .map(|design| (design.name, design.parameters, Some(design.loaded_balls)));
    catalogue.chain(dissertation)
}

/// Where a design comes from.
#[derive(Clone, Debug)]
pub enum DesignSource {
    /// A built-in design.
    BuiltIn {
        /// Its name.
        name: &'static str,
        /// Its dimensions and materials.
        parameters: BallScrewParameters,
        /// Number of balls that share the load.
        loaded_balls: Option<u16>,
    },
    /// The built-in linear bearing.
    LinearBearing,
    /// A TOML file; `-` is standard input.
    File(PathBuf),
}

impl FromStr for DesignSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let file = Path::new(text);
        if standard(file) || ends(file, &["toml"]) {
            return Ok(Self::File(text.into()));
        }
        if text == train::LINEAR {
            return Ok(Self::LinearBearing);
        }
        built_in()
            .find(|(name, ..)| *name == text)
            .map(|(name, parameters, loaded_balls)| Self::BuiltIn {
                name,
                parameters,
                loaded_balls,
            })
            .ok_or_else(|| {
                let near = plausible::nearest(text, built_in().map(|(name, ..)| name));
                format!(
                    "no built-in design has this name; perhaps {near} (`simulate --list` prints all), and a \
                     design file ends in .toml"
                )
            })
    }
}

impl DesignSource {
    /// The file, where it is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::BuiltIn { .. } | Self::LinearBearing => None,
        }
    }

    /// The text of its file, where it is one, with the samples of its charts in the place of their names: it stands for itself. Standard input can
    /// be read once.
    pub fn text(&self) -> Result<Option<String>, Failure> {
        let read = |path: &Path| deviation::with_charts(path, text_of(path)?);
        self.file().map(read).transpose()
    }

    /// The ball screw, checked.
    pub fn load(&self) -> Result<Design, Failure> {
        self.load_from(self.text()?.as_deref())
    }

    /// The same from the text of its file.
    pub fn load_from(&self, text: Option<&str>) -> Result<Design, Failure> {
        match self {
            Self::BuiltIn {
                name,
                parameters,
                loaded_balls,
            } => {
                let screw = BallScrew::new(*parameters)
                    .map_err(|error| Failure::Domain(format!("{name}: {error}")))?;
                Ok(Design::new(name, screw, *loaded_balls, Settings::of(name)))
            }
            Self::LinearBearing => Err(Failure::Domain(format!(
                "{} is a linear bearing: its scene is linear",
                train::LINEAR
            ))),
            Self::File(path) => from_text(path, text.unwrap_or_default(), DesignFile::design),
        }
    }

    /// The linear bearing, checked.
    pub fn load_bearing(&self) -> Result<LinearDesign, Failure> {
        self.load_bearing_from(self.text()?.as_deref())
    }

    /// The same from the text of its file.
    pub fn load_bearing_from(&self, text: Option<&str>) -> Result<LinearDesign, Failure> {
        match self {
            Self::LinearBearing => LinearDesign::built_in(),
            Self::File(path) => LinearDesign::read(path, text.unwrap_or_default()),
            Self::BuiltIn { name, .. } => Err(Failure::Domain(format!(
                "{name} is a ball screw; the built-in linear bearing is {}",
                train::LINEAR
            ))),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DesignFile {
    name: Option<String>,
    pitch_radius: Option<f32>,
    nominal_diameter: Option<f32>,
    lead: f32,
    ball_radius: Option<f32>,
    ball_diameter: Option<f32>,
    conformity: Option<f32>,
    groove_radius: Option<f32>,
    screw_groove: Option<GrooveTable>,
    nut_groove: Option<GrooveTable>,
    contact_angle: f32,
    youngs_modulus: Option<f32>,
    poisson_ratio: Option<f32>,
    density: Option<f32>,
    ball_material: Option<MaterialTable>,
    groove_material: Option<MaterialTable>,
    friction: Option<OneFriction>,
    friction_law: Option<FrictionLaw>,
    hysteresis_loss: Option<f32>,
    lubricant_drag: Option<f32>,
    rolling_tangent: Option<f32>,
    branch: Option<BranchName>,
    clearance: Option<f32>,
    preload: Option<f32>,
    axial_play: Option<f32>,
    axial_preload: Option<f32>,
    /// What `clearance` has replaced.
    fit: Option<toml::Value>,
    reversal_speed: Option<f32>,
    loaded_balls: Option<u16>,
    limits: Option<LimitsTable>,
    uncaged: Option<UncagedTable>,
    loads: Option<LoadsTable>,
    calibration: Option<Calibrated>,
    fold: Option<FoldTable>,
}

/// The friction coefficient of a design.
#[derive(Clone, Copy, Deserialize)]
#[serde(
    untagged,
    expecting = "expected a number; a range is [fold] friction = [least, most], beside this one coefficient"
)]
enum OneFriction {
    One(f32),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GrooveTable {
    conformity: Option<f32>,
    groove_radius: Option<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LimitsTable {
    nut_speed: Option<f32>,
    axial_load: Option<f32>,
    friction_torque: Option<f32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum BranchName {
    Contacts,
    Rolling,
    Sliding,
}

/// Reads a design file.
pub fn accepts(text: &str) -> Result<(), String> {
    read(text, "design").map(drop)
}

/// The design of a file's text; its name where it has none.
pub fn read(text: &str, name: &str) -> Result<Design, String> {
    let file: DesignFile = parsed(text)?;
    file.design(name)
}

impl DesignFile {
    fn design(self, stem: &str) -> Result<Design, String> {
        let ball_radius = radius(
            ("ball_radius", self.ball_radius),
            ("ball_diameter", self.ball_diameter),
        )?;
        let pitch_radius = radius(
            ("pitch_radius", self.pitch_radius),
            ("nominal_diameter", self.nominal_diameter),
        )?;
        let both = GrooveTable {
            conformity: self.conformity,
            groove_radius: self.groove_radius,
        };
        let common = MaterialTable {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
            density: self.density,
        };
        let parameters = BallScrewParameters {
            pitch_radius,
            lead: self.lead,
            ball_radius,
            screw_groove: groove("screw_groove", self.screw_groove.as_ref(), &both)?,
            nut_groove: groove("nut_groove", self.nut_groove.as_ref(), &both)?,
            contact_angle: self.contact_angle,
            ball_material: material(self.ball_material.as_ref(), &common),
            groove_material: material(self.groove_material.as_ref(), &common),
        };
        let given = plausible::Given {
            nominal_diameter: self.nominal_diameter.is_some(),
            ball_diameter: self.ball_diameter.is_some(),
        };
        let of_contacts = matches!(self.branch, None | Some(BranchName::Contacts));
        if of_contacts {
            // Narrower than the geometry's: one range, whichever is passed.
            let angle = ROLLING_CONTACT_ANGLE.checked("contact_angle", self.contact_angle);
            angle.map_err(|error| given.words(&error))?;
        }
        let screw = BallScrew::new(parameters).map_err(|error| given.words(&error))?;
        given.plausible(&parameters)?;
        if self.loaded_balls == Some(0) {
            return Err("loaded_balls = 0 is out of range; allowed: 1 to 1000".into());
        }
        train::refuse_fit(self.fit.as_ref())?;
        let fits = Fits {
            clearance: self.clearance,
            preload: self.preload,
            axial_play: self.axial_play,
            axial_preload: self.axial_preload,
        };
        let mut limits = LIMITS;
        if let Some(given) = self.limits {
            replace(&mut limits.nut_speed, given.nut_speed);
            replace(&mut limits.axial_load, given.axial_load);
            replace(&mut limits.friction_torque, given.friction_torque);
        }
        let clearance = fits.of(&screw, self.loaded_balls, &limits)?;

        let mut design = Design::new(
            &named(self.name.as_deref().unwrap_or(stem))?,
            screw,
            self.loaded_balls,
            Settings::USUAL,
        );
        let rows = self.uncaged.as_ref();
        design.defaulted = [
            ("friction", self.friction.is_some()),
            ("clearance", fits.any()),
            ("reversal_speed", self.reversal_speed.is_some()),
            ("loaded_balls", self.loaded_balls.is_some()),
            (
                "ball_friction",
                rows.is_none_or(UncagedTable::says_ball_friction),
            ),
        ]
        .into_iter()
        .filter_map(|(key, there)| (!there).then_some(key))
        .collect();
        let caged = &mut design.caged;
        replace(
            &mut caged.friction,
            self.friction.map(|OneFriction::One(friction)| friction),
        );
        let rolling = &mut caged.rolling_resistance;
        replace(&mut rolling.hysteresis_loss, self.hysteresis_loss);
        replace(&mut rolling.lubricant_drag, self.lubricant_drag);
        replace(&mut design.rolling_tangent, self.rolling_tangent);
        caged.clearance = clearance;
        replace(&mut caged.reversal_speed, self.reversal_speed);
        design.branch = match self.branch {
            None | Some(BranchName::Contacts) => None,
            Some(BranchName::Rolling) => Some(FrictionBranch::Rolling),
            Some(BranchName::Sliding) => Some(FrictionBranch::Sliding),
        };
        caged.limits = limits;
        capacity::check_limit(&screw, limits.axial_load, caged.loaded_balls)
            .map_err(|message| format!("limits: {message}"))?;
        design.check().map_err(|error| match error.field() {
            "nut_speed" | "axial_load" | "friction_torque" => format!("limits: {error}"),
            _ => error.to_string(),
        })?;
        let caged = design.caged;
        design.uncaged = self
            .uncaged
            .map(|table| {
                table
                    .design(caged)
                    .map_err(|message| format!("uncaged: {message}"))
            })
            .transpose()?;
        if let (Some(balls), Some(row)) = (self.loaded_balls, &design.uncaged) {
            row.check_loaded(balls)?;
        }
        design.loads = self
            .loads
            .map(|table| {
                table
                    .case(&screw, self.loaded_balls)
                    .map_err(|message| format!("loads: {message}"))
            })
            .transpose()?;
        design.calibrated = self
            .calibration
            .map(Calibrated::checked)
            .transpose()
            .map_err(|message| format!("calibration: {message}"))?;
        replace(&mut design.friction_law, self.friction_law);
        if let (FrictionLaw::Constant, Some(calibrated)) = (design.friction_law, &design.calibrated)
            && calibrated.has_law()
        {
            return Err(
                "friction_law = \"constant\" contradicts the law of [calibration]; remove one"
                    .into(),
            );
        }
        if let Some(table) = self.fold {
            table
                .check(&design)
                .map_err(|message| format!("fold: {message}"))?;
            design.fold = table;
        }
        Ok(design)
    }
}

/// A design's name, without what terminals obey: control characters and those that turn the direction of a text.
fn named(name: &str) -> Result<String, String> {
    const LONGEST: usize = 200;
    let letters = name.chars().count();
    if letters > LONGEST {
        return Err(format!(
            "name has {letters} letters; allowed: up to {LONGEST}"
        ));
    }
    let turns = |letter: char| matches!(letter, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    Ok(name.replace(|letter: char| letter.is_control() || turns(letter), " "))
}

/// Balls that a usual nut has under load: those of two turns and a half that touch.
fn usual_balls(design: &BallScrew) -> u16 {
    let turn = TAU * design.pitch_radius() / design.cos_lead_angle();
    // Not less than one, and within the range of a configuration.
    (2.5 * turn / (2.0 * design.ball_radius())).clamp(1.0, 1e3) as u16
}

fn groove(name: &str, own: Option<&GrooveTable>, both: &GrooveTable) -> Result<GrooveSize, String> {
    let table = own.unwrap_or(both);
    groove_size(name, table.conformity, table.groove_radius)
}

#[cfg(test)]
mod generated_tests;
#[cfg(test)]
mod tests;
