//! The stored cases: inputs, and what the crate makes of them on the host, called from Rust.

use std::fmt::Write as _;
use std::path::Path;

use epas_friction::curvature::{CircularGrooveCurvature, GothicArch, LiteratureCurvature};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::law::FrictionLevel;
use epas_friction::scene::{CagedConstants, Scene, WithMemoryInputs};
use epas_friction::{
    CATALOGUE, Error, FrictionModel, Inputs, LinearInputs, Outputs, Regime, UncagedOutputs,
};

use crate::gears;
use crate::places::{says, with_comma};
use crate::setups;
use crate::tools::Outcome;

const TICKS: u32 = 256;

/// Numbers from 0 to 1, the same at each run (xorshift).
pub struct Numbers(pub u32);

impl Numbers {
    pub fn word(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    fn next(&mut self) -> f32 {
        (self.word() >> 8) as f32 / 16_777_216.0
    }

    pub fn below(&mut self, most: u32) -> u32 {
        self.next();
        self.0 % most
    }

    pub fn within(&mut self, least: f32, most: f32) -> f32 {
        least + (most - least) * self.next()
    }
}

/// A quantity that wanders within plus and minus its `bound`, through 0 more often than not, and is now and
/// then no number, or beyond the bound.
struct Wander {
    value: f32,
    bound: f32,
}

impl Wander {
    fn next(&mut self, numbers: &mut Numbers, tick: u32, odd: u32) -> f32 {
        self.value += self.bound * numbers.within(-0.15, 0.15);
        if self.value.abs() > self.bound {
            self.value *= 0.5;
        }
        match (tick + odd) % 61 {
            17 => f32::NAN,
            18 => f32::INFINITY,
            19 => -2.0 * self.bound,
            20 | 21 => 0.0,
            22 => -0.0,
            23 => f32::MIN_POSITIVE / 4.0,
            24 => 1e-3 * self.bound,
            _ => self.value,
        }
    }
}

const fn regime(regime: Regime) -> u32 {
    match regime {
        Regime::Standing => 0,
        Regime::Driving => 1,
        Regime::BackDriving => 2,
        Regime::Locked => 3,
    }
}

/// Ticks of a screw that does not remember, with its nut's largest speed and load; something may change on the way.
fn ticks<S>(
    mut model: FrictionModel<S>,
    start: u32,
    change: impl Fn(&mut FrictionModel<S>, u32) -> Result<(), Error>,
) -> Result<Vec<Vec<u32>>, Error>
where
    S: Scene<Inputs = Inputs, Outputs: Words>,
{
    let mut numbers = Numbers(start);
    let mut speed = Wander {
        value: 0.0,
        bound: 100.0,
    };
    let mut load = Wander {
        value: 0.0,
        bound: 20_000.0,
    };
    (0..TICKS)
        .map(|tick| {
            change(&mut model, tick)?;
            let inputs = Inputs {
                nut_speed: speed.next(&mut numbers, tick, 0),
                axial_load: load.next(&mut numbers, tick, 30),
            };
            let mut row = vec![inputs.nut_speed.to_bits(), inputs.axial_load.to_bits()];
            row.extend(model.step(inputs).words());
            Ok(row)
        })
        .collect()
}

pub trait Words {
    fn words(&self) -> Vec<u32>;
}

impl Words for Outputs {
    fn words(&self) -> Vec<u32> {
        vec![
            self.friction_torque.to_bits(),
            self.load_torque.to_bits(),
            self.efficiency.to_bits(),
            regime(self.regime),
            self.faults.bits().into(),
        ]
    }
}

impl Words for UncagedOutputs {
    fn words(&self) -> Vec<u32> {
        vec![
            self.friction_torque.to_bits(),
            self.groove_torque.to_bits(),
            self.ball_torque.to_bits(),
            self.load_torque.to_bits(),
            self.largest_contact_force.to_bits(),
            self.contacts.into(),
            regime(self.regime),
            self.faults.bits().into(),
        ]
    }
}

/// Worn from the middle on.
fn caged() -> Result<Vec<Vec<u32>>, Error> {
    ticks(setups::caged()?, 0x1994_2019, |model, tick| {
        if tick == TICKS / 2 {
            model.swap_constants(CagedConstants::from_block(gears::GEAR_33X20_WORN)?)?;
        }
        Ok(())
    })
}

fn caged_range() -> Result<Vec<Vec<u32>>, Error> {
    ticks(setups::caged_range()?, 0x2026_0033, |model, tick| {
        model.set_friction(0.05 + tick as f32 * (0.1 / 256.0))
    })
}

fn closed_form() -> Result<Vec<Vec<u32>>, Error> {
    ticks(setups::closed_form()?, 0x1994_0003, |_, _| Ok(()))
}

/// A count that no encoder of the case gives.
const NO_COUNT: u32 = 16_384;

/// Reversals within the breakaway angle and beyond, with readings between two ticks; level, block and the coefficient's
/// law change on the way, and some readings, loads and temperatures are none, or old.
fn memory() -> Result<Vec<Vec<u32>>, Error> {
    let mut model = setups::memory()?;
    let mut numbers = Numbers(0x2026_0013);
    let mut load = Wander {
        value: 3_000.0,
        bound: 20_000.0,
    };
    let mut count = 16_300;
    let mut speed = 0.0_f32;
    (0..TICKS)
        .map(|tick| {
            match tick {
                64 => model.set_level(FrictionLevel {
                    forward: 1.2,
                    backward: 0.9,
                })?,
                128 => {
                    model.swap_constants(setups::swapped()?)?;
                }
                192 => model.set_coefficient(setups::law(0.15)?)?,
                _ => {}
            }
            // Slow for some dozen ticks, then fast.
            let most: u16 = if tick % 48 < 32 { 12 } else { 700 };
            let mut turned = || {
                count = (count + NO_COUNT + numbers.below(2 * u32::from(most) + 1)
                    - u32::from(most))
                    % NO_COUNT;
                count
            };
            let (first, second) = (turned(), turned());
            speed = 0.5 * speed + numbers.within(-1.0, 1.0) * f32::from(most) * 0.02;
            let inputs = WithMemoryInputs {
                scene: Inputs {
                    nut_speed: if tick % 97 == 96 { f32::NAN } else { speed },
                    axial_load: load.next(&mut numbers, tick, 30),
                },
                reading: if tick % 41 == 40 { NO_COUNT } else { first },
                load_age: if tick % 53 == 52 { 0.05 } else { 0.001 },
                temperature: match tick % 67 {
                    65 => f32::NAN,
                    66 => 600.0,
                    _ => 263.15 + 0.3 * tick as f32,
                },
                temperature_age: if tick % 71 == 70 { 40.0 } else { 0.5 },
            };
            let outputs = model.step(inputs);
            let between = model.between(second);
            let mut row = vec![
                inputs.scene.nut_speed.to_bits(),
                inputs.scene.axial_load.to_bits(),
                inputs.reading,
                inputs.load_age.to_bits(),
                inputs.temperature.to_bits(),
                inputs.temperature_age.to_bits(),
                second,
            ];
            row.extend(outputs.words());
            row.extend([
                between.friction_torque.to_bits(),
                regime(between.regime),
                between.faults.bits().into(),
            ]);
            Ok(row)
        })
        .collect()
}

/// Worn from the middle on.
fn screw() -> Result<Vec<Vec<u32>>, Error> {
    ticks(setups::screw()?, 0x0037_0037, |model, tick| {
        if tick == TICKS / 2 {
            model.swap_constants(setups::worn_screw()?)?;
        }
        Ok(())
    })
}

/// Its friction coefficient rises in every tick, from the least to the largest that was folded.
fn screw_range() -> Result<Vec<Vec<u32>>, Error> {
    let (least, largest) = gears::GEAR_33X20_BALL_RANGE.law.friction_range();
    ticks(setups::screw_range()?, 0x0037_0003, |model, tick| {
        model.set_friction(least + tick as f32 * ((largest - least) / 256.0))
    })
}

fn linear() -> Result<Vec<Vec<u32>>, Error> {
    let mut model = setups::linear()?;
    let mut numbers = Numbers(0x0343_0349);
    let mut speed = Wander {
        value: 0.0,
        bound: 2.0,
    };
    let mut normal = Wander {
        value: 2_000.0,
        bound: 5_000.0,
    };
    let mut side = Wander {
        value: 0.0,
        bound: 5_000.0,
    };
    Ok((0..TICKS)
        .map(|tick| {
            let inputs = LinearInputs {
                speed: speed.next(&mut numbers, tick, 0),
                normal_load: normal.next(&mut numbers, tick, 20),
                side_load: side.next(&mut numbers, tick, 40),
            };
            let outputs = model.step(inputs);
            vec![
                inputs.speed.to_bits(),
                inputs.normal_load.to_bits(),
                inputs.side_load.to_bits(),
                outputs.friction_force.to_bits(),
                outputs.groove_force.to_bits(),
                outputs.ball_force.to_bits(),
                outputs.largest_contact_force.to_bits(),
                outputs.contacts.into(),
                regime(outputs.regime),
                outputs.faults.bits().into(),
            ]
        })
        .collect())
}

fn efficiency() -> Result<Vec<Vec<u32>>, Error> {
    let mut numbers = Numbers(0x0014_0017);
    (0..128)
        .map(|case| {
            let lead_angle = match case {
                0 => 0.0,
                1 => 1.5,
                _ => numbers.within(0.01, 1.2),
            };
            let contact_angle = numbers.within(0.05, 1.5);
            let ball_ratio = numbers.within(0.02, 0.6);
            let friction = numbers.within(0.0, 0.4);
            let rolling = numbers.within(0.0, 0.02);
            let geometry = EfficiencyGeometry::new(lead_angle, contact_angle, ball_ratio)?;
            Ok(vec![
                lead_angle.to_bits(),
                contact_angle.to_bits(),
                ball_ratio.to_bits(),
                friction.to_bits(),
                rolling.to_bits(),
                geometry.rolling_efficiency(friction, rolling).to_bits(),
                geometry
                    .rolling_backdrive_efficiency(friction, rolling)
                    .to_bits(),
                geometry.sliding_efficiency(friction).to_bits(),
                geometry.sliding_backdrive_efficiency(friction).to_bits(),
                geometry.locks(Drive::Driving, friction).into(),
                geometry.locks(Drive::BackDriving, friction).into(),
            ])
        })
        .collect()
}

/// Both grooves of the 31 catalogue sizes, at two contact angles each.
fn curvature() -> Result<Vec<Vec<u32>>, Error> {
    let mut numbers = Numbers(0x2023_0031);
    let mut cases = Vec::new();
    for size in &CATALOGUE {
        for groove in [Groove::Screw, Groove::Nut] {
            for _ in 0..2 {
                let design = size.design()?;
                let angle = numbers.within(0.0, 1.25);
                let contact_angle = ContactAngle::new(angle);
                let exact = GothicArch::of(&design, groove).principal(contact_angle);
                cases.push(vec![
                    design.pitch_radius().to_bits(),
                    design.lead().to_bits(),
                    design.ball_radius().to_bits(),
                    u32::from(groove == Groove::Nut),
                    angle.to_bits(),
                    exact.kappa1.to_bits(),
                    exact.kappa2.to_bits(),
                    CircularGrooveCurvature::of(&design, groove)
                        .first(contact_angle)
                        .to_bits(),
                    LiteratureCurvature::of(&design, groove)
                        .first(contact_angle)
                        .to_bits(),
                ]);
            }
        }
    }
    Ok(cases)
}

fn table(text: &mut String, name: &str, columns: &str, rows: &[Vec<u32>]) -> Outcome<()> {
    let width = rows.first().map_or(0, Vec::len);
    writeln!(text, "\n/* {columns} */")?;
    writeln!(
        text,
        "static const uint32_t {name}[{}][{width}] = {{",
        rows.len()
    )?;
    for row in rows {
        let row: Vec<String> = row.iter().map(|word| format!("0x{word:08x}u")).collect();
        writeln!(text, "    {{{}}},", row.join(", "))?;
    }
    writeln!(text, "}};")?;
    Ok(())
}

/// Columns of a screw with a cage.
const CAGED: &str =
    "nut_speed, axial_load; friction_torque, load_torque, efficiency, regime, faults";

/// Columns of a screw without.
const UNCAGED: &str = "nut_speed, axial_load; friction_torque, groove_torque, ball_torque, load_torque, \
         largest_contact_force, contacts, regime, faults";

/// The file of stored cases.
pub fn generated() -> Outcome<String> {
    let mut text = String::from(
        "/* Written by `cargo run -p epas-c-check -- --write`; do not edit. Inputs and what the crate makes of\n\
         \x20* them on the host, called from Rust: floats by their bits. */\n",
    );
    let tables = [
        ("stored_caged", CAGED, caged()?),
        ("stored_caged_range", CAGED, caged_range()?),
        ("stored_closed_form", CAGED, closed_form()?),
        (
            "stored_memory",
            "nut_speed, axial_load, count, load_age, temperature, temperature_age, count between two steps; \
         friction_torque, load_torque, efficiency, regime, faults; between: friction_torque, regime, faults",
            memory()?,
        ),
        ("stored_screw", UNCAGED, screw()?),
        ("stored_screw_range", UNCAGED, screw_range()?),
        (
            "stored_linear",
            "speed, normal_load, side_load; friction_force, groove_force, ball_force, \
         largest_contact_force, contacts, regime, faults",
            linear()?,
        ),
        (
            "stored_efficiency",
            "lead_angle, contact_angle, ball_ratio, friction, rolling_tangent; rolling drive and back-drive, \
         sliding drive and back-drive, locked drive and back-drive",
            efficiency()?,
        ),
        (
            "stored_curvature",
            "pitch_radius, lead, ball_radius, groove, contact_angle; first, second, circular_groove, literature",
            curvature()?,
        ),
    ];
    for (name, columns, rows) in &tables {
        table(&mut text, name, columns, rows)?;
    }
    Ok(text)
}

/// Sees that both pages say how many cases are stored.
pub fn told(root: &Path, stored: &str) -> Outcome<()> {
    let cases = stored.lines().filter(|line| line.starts_with("    {"));
    let number = with_comma(cases.count());
    for (page, line) in [
        ("README.md", format!("(`test/stored.h`, {number} of them)")),
        ("../use-it-from.md", format!("| {number} stored cases")),
    ] {
        says(root, page, &line)?;
    }
    Ok(())
}
