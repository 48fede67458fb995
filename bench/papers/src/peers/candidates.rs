//! Every law that is compared, with its constants.

use epas_friction::law::memory::{SLIP_4, SLIP_6, SLIP_8, SLIP_10};
use epas_reference::presliding::tables;

use super::dahl::{Explicit, Implicit};
use super::elasto_plastic::ElastoPlastic;
use super::fit::fitted;
use super::generalized::Generalized;
use super::multiplied::Multiplied;
use super::{Law, remembered};
use epas_page::failure::Failure;

/// What a step costs on a Cortex-M4F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycles {
    /// Name of the function that is counted on the target, where there is one.
    pub counted: Option<&'static str>,
    /// Static count, not run; or what the step consists of.
    pub expected: &'static str,
}

impl Cycles {
    const fn expected(expected: &'static str) -> Self {
        Self {
            counted: None,
            expected,
        }
    }
}

/// A law and how it is made.
pub struct Candidate {
    /// Name.
    pub name: String,
    /// What a step costs.
    pub cycles: Cycles,
    make: Box<dyn Fn() -> Result<Box<dyn Law>, Failure>>,
}

impl Candidate {
    fn new<L: Law + 'static>(name: &str, cycles: Cycles, make: impl Fn() -> L + 'static) -> Self {
        Self {
            name: name.into(),
            cycles,
            make: Box::new(move || Ok(Box::new(make()))),
        }
    }

    fn ours(
        name: &str,
        cycles: Cycles,
        make: fn() -> Result<Box<dyn Law>, epas_friction::Error>,
    ) -> Self {
        Self {
            name: name.into(),
            cycles,
            make: Box::new(move || make().map_err(|error| Failure::Data(error.to_string()))),
        }
    }

    /// The law with nothing remembered.
    pub fn start(&self) -> Result<Box<dyn Law>, Failure> {
        (self.make)()
    }
}

/// First stiffness of the exact hysteresis.
const STIFFNESS: f64 = 1.5;

/// Lag of generalized Maxwell slip, `C` over the limit and tick: 20 a second at 1 kHz.
const ATTRACTION: f64 = 0.02;

const LUGRE: Cycles = Cycles {
    counted: Some("lugre_step"),
    expected: "40",
};
/// Eight elements in proportion.
const EIGHT: Cycles = Cycles {
    counted: Some("memory_8"),
    expected: "185",
};
const DAHL: Cycles = Cycles::expected("38");
const POWER: Cycles = Cycles::expected("a power");
const SINE: Cycles = Cycles::expected("a sine");

/// Laws in use today with the exact first stiffness, as published.
pub fn published() -> Vec<Candidate> {
    vec![
        Candidate::new("Dahl, LuGre, implicit", DAHL, || Implicit::new(STIFFNESS)),
        Candidate::new("LuGre, explicit", LUGRE, || Explicit::new(STIFFNESS, 1.0)),
        Candidate::new("Dahl, exponent 1/3, explicit", POWER, || {
            Explicit::new(STIFFNESS, 1.0 / 3.0)
        }),
        Candidate::new("elasto-plastic, sticks to 0.7", SINE, || {
            ElastoPlastic::new(STIFFNESS, 0.7)
        }),
        Candidate::new("elasto-plastic, sticks to 0.3", SINE, || {
            ElastoPlastic::new(STIFFNESS, 0.3)
        }),
    ]
}

/// The same laws with the constants that come closest to the exact loops.
pub fn best() -> Result<Vec<Candidate>, Failure> {
    let one = |start: &[f64], make: fn(&[f64]) -> Box<dyn Law>| fitted(start, &make);
    let implicit = one(&[1.5], |c| Box::new(Implicit::new(c[0])))?;
    let explicit = one(&[1.5], |c| Box::new(Explicit::new(c[0], 1.0)))?;
    let power = one(&[1.5, 0.33], |c| Box::new(Explicit::new(c[0], c[1])))?;
    let elastic = one(&[1.5, 0.5], |c| {
        Box::new(ElastoPlastic::new(c[0], c[1].min(0.999)))
    })?;
    // Angles and three shares of the fourth: the shares sum to one.
    let generalized = one(&[0.26, 0.54, 0.78, 0.97, 0.13, 0.31, 0.55], |c| {
        let (angles, shares) = four(c);
        Box::new(Generalized::new(&angles, &shares, ATTRACTION))
    })?;
    let (angles, shares) = four(&generalized);
    let [k, ke, kp, p, kz, z] = [
        implicit[0],
        explicit[0],
        power[0],
        power[1],
        elastic[0],
        elastic[1].min(0.999),
    ];
    Ok(vec![
        Candidate::new(
            &format!("Dahl, LuGre, implicit, best stiffness {k:.2}"),
            DAHL,
            move || Implicit::new(k),
        ),
        Candidate::new(
            &format!("LuGre, explicit, best stiffness {ke:.2}"),
            LUGRE,
            move || Explicit::new(ke, 1.0),
        ),
        Candidate::new(
            &format!("Dahl, explicit, best stiffness {kp:.2} and exponent {p:.2}"),
            POWER,
            move || Explicit::new(kp, p),
        ),
        Candidate::new(
            &format!("elasto-plastic, best stiffness {kz:.2}, sticks to {z:.2}"),
            SINE,
            move || ElastoPlastic::new(kz, z),
        ),
        Candidate::new(
            "generalized Maxwell slip, best 4 elements",
            Cycles::expected("97 and its lag"),
            move || Generalized::new(&angles, &shares, ATTRACTION),
        ),
    ])
}

/// Angles and shares of four elements from seven positive numbers.
fn four(constants: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (angles, ratios) = constants.split_at(4);
    let whole = 1.0 + ratios.iter().sum::<f64>();
    let shares = ratios
        .iter()
        .chain(&[1.0])
        .map(|ratio| ratio / whole)
        .collect();
    (angles.to_vec(), shares)
}

/// The crate's elements in proportion.
pub fn ours() -> Vec<Candidate> {
    vec![
        Candidate::ours("this crate, 4 elements", Cycles::expected("97"), || {
            remembered::proportional(&SLIP_4.elements)
        }),
        Candidate::ours("this crate, 6 elements", Cycles::expected("141"), || {
            remembered::proportional(&SLIP_6.elements)
        }),
        Candidate::ours("this crate, 8 elements", EIGHT, || {
            remembered::proportional(&SLIP_8.elements)
        }),
        Candidate::ours("this crate, 10 elements", Cycles::expected("229"), || {
            remembered::proportional(&SLIP_10.elements)
        }),
    ]
}

/// A law that may follow a load, nothing remembered.
pub struct UnderLoad {
    /// Name.
    pub name: &'static str,
    /// What a step costs.
    pub cycles: Cycles,
    /// The law.
    pub law: Box<dyn Law>,
}

/// Names of [`under_load`].
pub const PROPORTIONAL: &str = "in proportion, 8";
/// As [`PROPORTIONAL`].
pub const MULTIPLIED: &str = "multiplied, 8";
/// As [`PROPORTIONAL`].
pub const LOAD_EXACT: &str = "load-exact, 8";

/// Laws under a load that changes, up to `largest_load`.
pub fn under_load(largest_load: f64) -> Result<Vec<UnderLoad>, Failure> {
    let failed = |error: epas_friction::Error| Failure::Data(error.to_string());
    let law = |name, cycles, law| UnderLoad { name, cycles, law };
    let expected = Cycles::expected;
    Ok(vec![
        law(
            PROPORTIONAL,
            EIGHT,
            remembered::proportional(&SLIP_8.elements).map_err(failed)?,
        ),
        law(
            MULTIPLIED,
            expected("as in proportion"),
            Box::new(Multiplied::new(&tables::SLIP_8)),
        ),
        law(
            "load-exact, 4",
            expected("252"),
            remembered::load_exact::<4>(largest_load).map_err(failed)?,
        ),
        law(
            "load-exact, 6",
            expected("314"),
            remembered::load_exact::<6>(largest_load).map_err(failed)?,
        ),
        law(
            LOAD_EXACT,
            Cycles {
                counted: Some("memory_load_exact_8"),
                expected: "382",
            },
            remembered::load_exact::<8>(largest_load).map_err(failed)?,
        ),
        law(
            "load-exact, 10",
            expected("450"),
            remembered::load_exact::<10>(largest_load).map_err(failed)?,
        ),
    ])
}
