//! Printed numbers of the four papers (`published.toml`) beside their values computed again: [`records`].

pub mod balls;
pub mod bearings;
pub mod curvature;
pub mod efficiency;
pub mod kinematics;
pub mod loads;

use std::collections::BTreeMap;

use epas_page::failure::Failure;
use serde::Deserialize;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Computed to the printed digits from what the text states.
    #[default]
    Reproduces,
    /// Computed to the printed digits once something is taken as the text does not say; what.
    Convention,
    Misprint,
    NotReproducible,
}

impl Verdict {
    pub const ALL: [Self; 4] = [
        Self::Reproduces,
        Self::Convention,
        Self::Misprint,
        Self::NotReproducible,
    ];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Reproduces => "reproduces",
            Self::Convention => "reproduces with stated convention",
            Self::Misprint => "misprint",
            Self::NotReproducible => "not reproducible",
        }
    }

    pub const fn agrees(self) -> bool {
        matches!(self, Self::Reproduces | Self::Convention)
    }
}

/// A printed number as the file has it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printed {
    pub quantity: String,
    #[serde(default)]
    pub unit: String,
    /// As printed, digit by digit.
    #[serde(rename = "printed")]
    pub digits: String,
    /// Largest difference that counts as reproduced; half a unit of the last printed digit where none is given.
    pub tolerance: Option<f64>,
    #[serde(default)]
    pub verdict: Verdict,
    #[serde(default)]
    pub reason: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Place {
    paper: String,
    name: String,
    numbers: Vec<Printed>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    reasons: BTreeMap<String, String>,
    radius_tables: [Vec<curvature::Row>; 2],
    place: Vec<Place>,
}

fn file() -> Result<File, Failure> {
    Ok(toml::from_str(include_str!("../published.toml"))?)
}

#[derive(Clone, Debug)]
pub struct Record {
    pub paper: String,
    /// Table, figure or section.
    pub place: String,
    pub printed: Printed,
    /// As computed; NaN where the text leaves out what the computation needs.
    pub computed: f64,
}

impl Record {
    pub fn value(&self) -> f64 {
        self.printed.digits.parse().unwrap_or(f64::NAN)
    }

    pub fn deviation(&self) -> f64 {
        self.computed - self.value()
    }

    /// Whether computed and printed number agree within the tolerance.
    pub fn agrees(&self) -> bool {
        let half = half_unit(&self.printed.digits);
        self.deviation().abs() <= self.printed.tolerance.unwrap_or(half)
    }
}

/// Half a unit of the last digit of a number as printed: `0.05` of `2.3`, `5e-11` of `1.812e-7`.
pub fn half_unit(printed: &str) -> f64 {
    let (digits, power) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
    let power: i32 = power.parse().unwrap_or(0);
    // A little more than half: a value that ends exactly in the half may lie on either side in binary.
    0.5000001 * 10_f64.powi(power - decimals as i32)
}

/// Computed numbers by place, in the order of the file.
type Computed = Vec<(&'static str, Vec<f64>)>;

/// The printed numbers of the four papers, in their order: all that can be computed, and those that cannot because the text leaves
/// out what the computation needs. Fails where a verdict is not what the numbers say.
pub fn records() -> Result<Vec<Record>, Failure> {
    let file = file()?;
    let mut records = curvature::records(&file.radius_tables)?;
    let mut computed = BTreeMap::new();
    for part in [
        curvature::computed(&file.radius_tables)?,
        efficiency::computed(),
        kinematics::computed()?,
        loads::computed()?,
        bearings::computed()?,
        balls::computed()?,
    ] {
        computed.extend(part);
    }
    for Place {
        paper,
        name,
        numbers,
    } in file.place
    {
        let values = computed.remove(name.as_str()).unwrap_or_default();
        if values.len() != numbers.len() {
            let counts = format!("{} printed, {} computed", numbers.len(), values.len());
            return Err(Failure::Data(format!("published.toml, {name}: {counts}")));
        }
        records.extend(
            numbers
                .into_iter()
                .zip(values)
                .map(|(printed, computed)| Record {
                    paper: paper.clone(),
                    place: name.clone(),
                    printed,
                    computed,
                }),
        );
    }
    if let Some(name) = computed.keys().next() {
        return Err(Failure::Data(format!("published.toml has no place {name}")));
    }
    for record in &mut records {
        if let Some(reason) = file.reasons.get(&record.printed.reason) {
            record.printed.reason.clone_from(reason);
        }
    }
    let wrong = |record: &&Record| record.agrees() != record.printed.verdict.agrees();
    let wrong: Vec<String> = records
        .iter()
        .filter(wrong)
        .map(|record| format!("{record:?}"))
        .collect();
    if wrong.is_empty() {
        Ok(records)
    } else {
        let wrong = wrong.join("\n");
        Err(Failure::Data(format!(
            "verdicts of published.toml that the numbers do not bear out:\n{wrong}"
        )))
    }
}
