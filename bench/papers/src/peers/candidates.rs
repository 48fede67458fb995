//! Every law that is compared, with its constants.

use epas_friction::Error;
use epas_friction::law::memory::{
    BackboneElement, LoadExactElements, Part, ProportionalElements, SLIP_4, SLIP_6, SLIP_8, SLIP_10,
};
use epas_reference::presliding::tables;

use super::Law;
use super::laws::{Dahl, ElastoPlastic, Generalized, Multiplied, Remembered};
use epas_page::failure::Failure;

/// A law with nothing remembered.
pub type Start = Box<dyn Law>;

/// What a step costs on a Cortex-M4F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycles {
    pub counted: Option<&'static str>,
    /// Static count, not run; or what the step consists of.
    pub expected: &'static str,
}

const fn expected(expected: &'static str) -> Cycles {
    Cycles {
        counted: None,
        expected,
    }
}

const fn counted(counted: &'static str, expected: &'static str) -> Cycles {
    Cycles {
        counted: Some(counted),
        expected,
    }
}

pub struct Candidate {
    pub name: String,
    pub cycles: Cycles,
    make: Box<dyn Fn() -> Result<Start, Error>>,
}

impl Candidate {
    fn new(
        name: impl Into<String>,
        cycles: Cycles,
        make: impl Fn() -> Result<Start, Error> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            cycles,
            make: Box::new(make),
        }
    }

    fn of<L: Law + 'static>(
        name: impl Into<String>,
        cycles: Cycles,
        make: impl Fn() -> L + 'static,
    ) -> Self {
        Self::new(name, cycles, move || Ok(Box::new(make())))
    }

    pub fn start(&self) -> Result<Start, Failure> {
        Ok((self.make)()?)
    }
}

/// First stiffness of the exact hysteresis.
const STIFFNESS: f64 = 1.5;

/// Lag of generalized Maxwell slip, `C` over the limit and tick: 20 a second at 1 kHz.
const ATTRACTION: f64 = 0.02;

const DAHL: Cycles = expected("38");
const LUGRE: Cycles = counted("lugre_step", "40");
const POWER: Cycles = expected("a power");
const SINE: Cycles = expected("a sine");
const EIGHT: Cycles = counted("memory_8", "185");

pub fn published() -> Vec<Candidate> {
    let dahl = |exponent| move || Dahl::new(STIFFNESS, exponent);
    let elastic = |share| move || ElastoPlastic::new(STIFFNESS, share);
    vec![
        Candidate::of("Dahl, LuGre, implicit", DAHL, dahl(None)),
        Candidate::of("LuGre, explicit", LUGRE, dahl(Some(1.0))),
        Candidate::of("Dahl, exponent 1/3, explicit", POWER, dahl(Some(1.0 / 3.0))),
        Candidate::of("elasto-plastic, sticks to 0.7", SINE, elastic(0.7)),
        Candidate::of("elasto-plastic, sticks to 0.3", SINE, elastic(0.3)),
    ]
}

/// Name, cost of a step, constants, and the law of some constants.
pub type Peer = (&'static str, Cycles, &'static [f64], fn(&[f64]) -> Start);

/// The same laws with the constants that come closest to the exact loops: the least rms error over first loading and loops at [`AMPLITUDES`].
///
/// [`AMPLITUDES`]: super::paths::AMPLITUDES
pub const BEST: [Peer; 5] = [
    (
        "Dahl, LuGre, implicit, best stiffness 1.17",
        DAHL,
        &[1.1688],
        |c| Box::new(Dahl::new(c[0], None)),
    ),
    (
        "LuGre, explicit, best stiffness 1.12",
        LUGRE,
        &[1.1234],
        |c| Box::new(Dahl::new(c[0], Some(1.0))),
    ),
    (
        "Dahl, explicit, best stiffness 1.22 and exponent 0.23",
        POWER,
        &[1.2211, 0.23456],
        |c| Box::new(Dahl::new(c[0], Some(c[1]))),
    ),
    (
        "elasto-plastic, best stiffness 1.25, sticks to 0.43",
        SINE,
        &[1.2532, 0.43485],
        |c| Box::new(ElastoPlastic::new(c[0], c[1])),
    ),
    (
        "generalized Maxwell slip, best 4 elements",
        expected("97 and its lag"),
        &[
            0.22213, 0.49470, 0.75538, 0.95937, 0.091941, 0.27144, 0.49955,
        ],
        |c| {
            let (angles, shares) = four(c);
            Box::new(Generalized::new(&angles, &shares, ATTRACTION))
        },
    ),
];

pub fn best() -> impl Iterator<Item = Candidate> {
    BEST.into_iter().map(|(name, cycles, constants, make)| {
        Candidate::new(name, cycles, move || Ok(make(constants)))
    })
}

/// Angles and shares of four elements from seven positive numbers: the angles, and three shares over the fourth.
fn four(constants: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (angles, ratios) = constants.split_at(4);
    let whole = 1.0 + ratios.iter().sum::<f64>();
    let shares = ratios.iter().chain(&[1.0]).map(|ratio| ratio / whole);
    (angles.to_vec(), shares.collect())
}

fn proportional<const N: usize>(backbone: &[BackboneElement; N]) -> Result<Start, Error> {
    let part = Part {
        backbone,
        share: 1.0,
        breakaway_angle: 1.0,
    };
    let elements = ProportionalElements::<N>::new(1.0, &[part])?;
    Ok(Remembered::start(elements))
}

fn load_exact<const N: usize>(largest_load: f64) -> Result<Start, Error> {
    let elements = LoadExactElements::<N>::new(1.0, 1.0, largest_load as f32)?;
    Ok(Remembered::start(elements))
}

pub fn ours() -> Vec<Candidate> {
    let [four, six, ten] = ["97", "141", "229"].map(expected);
    vec![
        Candidate::new("this crate, 4 elements", four, || {
            proportional(&SLIP_4.elements)
        }),
        Candidate::new("this crate, 6 elements", six, || {
            proportional(&SLIP_6.elements)
        }),
        Candidate::new("this crate, 8 elements", EIGHT, || {
            proportional(&SLIP_8.elements)
        }),
        Candidate::new("this crate, 10 elements", ten, || {
            proportional(&SLIP_10.elements)
        }),
    ]
}

/// Names of [`under_load`].
pub const PROPORTIONAL: &str = "in proportion, 8";
pub const MULTIPLIED: &str = "multiplied, 8";
pub const LOAD_EXACT: &str = "load-exact, 8";

/// Laws under a load that changes, up to `largest_load`.
pub fn under_load(largest_load: f64) -> Vec<Candidate> {
    let most = largest_load;
    let eight = counted("memory_load_exact_8", "382");
    vec![
        Candidate::new(PROPORTIONAL, EIGHT, || proportional(&SLIP_8.elements)),
        Candidate::of(MULTIPLIED, expected("as in proportion"), || Multiplied {
            elements: tables::SLIP_8.elements(),
            load: 1.0,
        }),
        Candidate::new("load-exact, 4", expected("252"), move || {
            load_exact::<4>(most)
        }),
        Candidate::new("load-exact, 6", expected("314"), move || {
            load_exact::<6>(most)
        }),
        Candidate::new(LOAD_EXACT, eight, move || load_exact::<8>(most)),
        Candidate::new("load-exact, 10", expected("450"), move || {
            load_exact::<10>(most)
        }),
    ]
}
