//! A printed number beside the computed one, and what became of it.

use std::fmt;

/// Where a number is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// Bertolino et al., Machines 11(2):261, 2023: groove curvature.
    Bertolino2023,
    /// Lin, Velinsky, Ravani, Journal of Mechanical Design 116, 1994: efficiency.
    LinVelinskyRavani1994,
    /// Alberdi et al.: contact kinematics.
    Alberdi,
    /// Bo Lin, dissertation, University of Michigan, 2019: loads and friction.
    Lin2019,
}

impl Paper {
    /// Every paper.
    pub const ALL: [Self; 4] = [
        Self::Bertolino2023,
        Self::LinVelinskyRavani1994,
        Self::Alberdi,
        Self::Lin2019,
    ];

    /// Name as cited.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bertolino2023 => "Bertolino et al. 2023",
            Self::LinVelinskyRavani1994 => "Lin, Velinsky, Ravani 1994",
            Self::Alberdi => "Alberdi et al.",
            Self::Lin2019 => "Lin 2019",
        }
    }
}

/// What became of a printed number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Computed to the printed digits from what the text states.
    Reproduces,
    /// Computed to the printed digits once something is taken as the text does not say; what.
    Convention(&'static str),
    /// The print is wrong; how.
    Misprint(&'static str),
    /// Not reached from what the text states; why, and how near.
    NotReproducible(&'static str),
}

impl Verdict {
    /// Name without the reason.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduces => "reproduces",
            Self::Convention(_) => "reproduces with stated convention",
            Self::Misprint(_) => "misprint",
            Self::NotReproducible(_) => "not reproducible",
        }
    }

    /// The reason; empty where none is needed.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::Reproduces => "",
            Self::Convention(text) | Self::Misprint(text) | Self::NotReproducible(text) => text,
        }
    }
}

/// A printed number beside the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Where it is printed.
    pub paper: Paper,
    /// Table, figure or section.
    pub place: String,
    /// What it is.
    pub quantity: String,
    /// Unit of both numbers.
    pub unit: &'static str,
    /// As printed, digit by digit.
    pub printed: String,
    /// As computed; NaN where the text leaves out what the computation needs.
    pub computed: f64,
    /// Largest difference that counts as reproduced: half a unit of the last printed digit, unless said otherwise.
    pub tolerance: f64,
    /// What became of it.
    pub verdict: Verdict,
}

impl Record {
    /// The printed number.
    #[must_use]
    pub fn printed_value(&self) -> f64 {
        self.printed.parse().unwrap_or(f64::NAN)
    }

    /// Computed less printed.
    #[must_use]
    pub fn deviation(&self) -> f64 {
        self.computed - self.printed_value()
    }

    /// Whether computed and printed number agree within the tolerance.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.deviation().abs() <= self.tolerance
    }

    /// The same with another tolerance.
    #[must_use]
    pub fn within(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }
}

impl fmt::Display for Record {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "{}, {}, {}: printed {} {}, computed {}; {} {}",
            self.paper.name(),
            self.place,
            self.quantity,
            self.printed,
            self.unit,
            self.computed,
            self.verdict.name(),
            self.verdict.reason()
        )
    }
}

/// Half a unit of the last digit of a number as printed: `0.05` of `2.3`, `5e-8` of `1.812e-7`.
#[must_use]
pub fn half_unit(printed: &str) -> f64 {
    let (digits, power) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
    let power: i32 = power.parse().unwrap_or(0);
    // A little more than half: a value that ends exactly in the half may lie on either side in binary.
    0.5000001 * 10_f64.powi(power - decimals as i32)
}

/// Records of one place of a paper.
pub(crate) struct Page<'a> {
    pub paper: Paper,
    pub place: &'a str,
    pub records: &'a mut Vec<Record>,
}

impl<'a> Page<'a> {
    /// The first page of a paper.
    pub fn new(records: &'a mut Vec<Record>, paper: Paper) -> Self {
        Self {
            paper,
            place: "",
            records,
        }
    }

    /// Another place of the paper.
    pub fn turn<'b>(&'b mut self, place: &'b str) -> Page<'b> {
        Page {
            paper: self.paper,
            place,
            records: self.records,
        }
    }

    /// A number, with half a unit of its last digit as the tolerance.
    pub fn add(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        printed: impl Into<String>,
        computed: f64,
        verdict: Verdict,
    ) {
        let printed = printed.into();
        self.records.push(Record {
            paper: self.paper,
            place: self.place.into(),
            quantity: quantity.into(),
            unit,
            tolerance: half_unit(&printed),
            printed,
            computed,
            verdict,
        });
    }

    /// A number that counts as reproduced within `tolerance`.
    pub fn roughly(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        (printed, tolerance): (&str, f64),
        computed: f64,
        verdict: Verdict,
    ) {
        self.add(quantity, unit, printed, computed, verdict);
        if let Some(last) = self.records.last_mut() {
            last.tolerance = tolerance;
        }
    }
}
