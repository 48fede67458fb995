//! The stored cases: inputs, and what the crate makes of them on the host, called from Rust.
//!
//! The set-ups are written twice: here, and in `test/setups.c` as a user would.

use std::fmt::Write as _;

use epas_friction::curvature::{CircularGrooveCurvature, GothicArch, LiteratureCurvature};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, CagedBallScrew, CagedBallScrewConfiguration,
    DeviationMap, Error, FrictionBranch, FrictionModel, GrooveFit, GrooveSize, Harmonic, Inputs,
    Limits, LinearBearing, LinearBearingConfiguration, LinearBearingParameters, LinearBearingTrain,
    LinearInputs, LinearLimits, LoadShare, Material, Regime, TrainOutputs, UncagedBallScrew,
    UncagedBallScrewConfiguration,
};

use crate::outcome::Outcome;

/// Ticks of each scene.
const TICKS: u32 = 256;

/// Numbers from 0 to 1, the same at each run (xorshift).
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    /// Between two numbers.
    fn within(&mut self, least: f32, most: f32) -> f32 {
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

/// The rack-assist gear of Lin 2019, chapter 4.
fn caged() -> Result<Vec<Vec<u32>>, Error> {
    let mut model = FrictionModel::<CagedBallScrew>::new(&CagedBallScrewConfiguration {
        design: BallScrew::new(BallScrewParameters {
            pitch_radius: 14.5e-3,
            lead: 7e-3,
            ball_radius: 2e-3,
            screw_groove: GrooveSize::Conformity(0.54),
            nut_groove: GrooveSize::Conformity(0.54),
            contact_angle: std::f32::consts::FRAC_PI_4,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })?,
        friction: 0.075,
        rolling_tangent: 0.002,
        branch: FrictionBranch::Rolling,
        preload: 100.0,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 20_000.0,
            friction_torque: 2.0,
        },
    })?;
    let mut numbers = Numbers(0x1994_2019);
    let mut speed = Wander {
        value: 0.0,
        bound: 500.0,
    };
    let mut load = Wander {
        value: 0.0,
        bound: 20_000.0,
    };
    Ok((0..TICKS)
        .map(|tick| {
            let inputs = Inputs {
                nut_speed: speed.next(&mut numbers, tick, 0),
                axial_load: load.next(&mut numbers, tick, 30),
            };
            let outputs = model.step(inputs);
            vec![
                inputs.nut_speed.to_bits(),
                inputs.axial_load.to_bits(),
                outputs.friction_torque.to_bits(),
                outputs.load_torque.to_bits(),
                outputs.efficiency.to_bits(),
                regime(outputs.regime),
                outputs.faults.bits().into(),
            ]
        })
        .collect())
}

fn train_outputs(outputs: &TrainOutputs) -> [u32; 8] {
    [
        outputs.friction.to_bits(),
        outputs.groove_friction.to_bits(),
        outputs.ball_friction.to_bits(),
        outputs.load_torque.to_bits(),
        outputs.largest_contact_force.to_bits(),
        outputs.contacts.into(),
        regime(outputs.regime),
        outputs.faults.bits().into(),
    ]
}

/// A table that lives as long as the program.
fn kept<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

/// The ball screw of Lin 2019, Table 3.6, with two waves of deviation a turn on the screw and a triangle on
/// the nut.
fn screw() -> Result<Vec<Vec<u32>>, Error> {
    let triangle = std::array::from_fn(|sample: usize| {
        let sample = sample as f32;
        let rise = if sample < 32.0 { sample } else { 64.0 - sample };
        (rise - 16.0) * 0.00125
    });
    let shares = [1.4_f32, 1.2, 1.1, 0.9, 0.8, 0.6]
        .into_iter()
        .map(LoadShare::new)
        .collect::<Result<Vec<_>, _>>()?;
    let mut model = FrictionModel::<UncagedBallScrew<37>>::new(&UncagedBallScrewConfiguration {
        design: BallScrew::new(BallScrewParameters {
            pitch_radius: 16.5e-3,
            lead: 20e-3,
            ball_radius: 2.778e-3,
            screw_groove: GrooveSize::Conformity(0.56),
            nut_groove: GrooveSize::Conformity(0.56),
            contact_angle: std::f32::consts::FRAC_PI_4,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })?,
        friction: 0.1,
        ball_friction: 0.12,
        fit: GrooveFit::Zero,
        turns: 1.8,
        return_length: 20e-3,
        screw_deviation: kept(DeviationMap::from_harmonics(
            1,
            &[
                Harmonic {
                    order: 1,
                    cosine: 0.005,
                    sine: 0.0,
                },
                Harmonic {
                    order: 2,
                    cosine: 0.0,
                    sine: 0.04014,
                },
            ],
        )?),
        nut_deviation: kept(DeviationMap::from_samples(2, &triangle)?),
        load_shares: kept(shares),
        reversal_speed: 0.5,
        tick: 0.5e-3,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 20_000.0,
            friction_torque: 5.0,
        },
    })?;
    model.set_nut_angle(1.25);
    let mut numbers = Numbers(0x0037_0037);
    let mut speed = Wander {
        value: 0.0,
        bound: 500.0,
    };
    let mut load = Wander {
        value: 0.0,
        bound: 20_000.0,
    };
    Ok((0..TICKS)
        .map(|tick| {
            let inputs = Inputs {
                nut_speed: speed.next(&mut numbers, tick, 0),
                axial_load: load.next(&mut numbers, tick, 30),
            };
            let outputs = model.step(inputs);
            let mut words = vec![inputs.nut_speed.to_bits(), inputs.axial_load.to_bits()];
            words.extend(train_outputs(&outputs));
            words
        })
        .collect())
}

/// A linear bearing with balls of 10 mm.
fn linear() -> Result<Vec<Vec<u32>>, Error> {
    let mut model = FrictionModel::<LinearBearingTrain<32>>::new(&LinearBearingConfiguration {
        bearing: LinearBearing::new(LinearBearingParameters {
            ball_radius: 5e-3,
            groove: GrooveSize::Conformity(0.52),
            contact_angle: std::f32::consts::FRAC_PI_4,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })?,
        friction: 0.1,
        ball_friction: 0.12,
        loaded_length: 0.2,
        return_length: 0.13,
        wavelength: 0.05,
        rail_deviation: kept(DeviationMap::from_harmonics(
            1,
            &[Harmonic {
                order: 1,
                cosine: 0.01,
                sine: 0.02,
            }],
        )?),
        carriage_deviation: &DeviationMap::NONE,
        load_shares: &[LoadShare::MEAN],
        reversal_speed: 1e-3,
        tick: 1e-3,
        limits: LinearLimits {
            speed: 2.0,
            load: 5_000.0,
            friction_force: 50.0,
        },
    })?;
    model.set_carriage_position(0.0125);
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
            let mut words = vec![
                inputs.speed.to_bits(),
                inputs.normal_load.to_bits(),
                inputs.side_load.to_bits(),
            ];
            words.extend(train_outputs(&outputs));
            words
        })
        .collect())
}

/// Over the whole domain, locked drives among them.
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

/// One table in C.
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

/// The file of stored cases.
pub fn generated() -> Outcome<String> {
    const TRAIN: &str = "friction, groove_friction, ball_friction, load_torque, largest_contact_force, \
                         contacts, regime, faults";
    let mut text = String::from(
        "/* Written by `cargo run -p epas-c-check -- --write`; do not edit. Inputs and what the crate makes of\n\
         \x20* them on the host, called from Rust: floats by their bits. */\n",
    );
    table(
        &mut text,
        "stored_caged",
        "nut_speed, axial_load; friction_torque, load_torque, efficiency, regime, faults",
        &caged()?,
    )?;
    table(
        &mut text,
        "stored_screw",
        &format!("nut_speed, axial_load; {TRAIN}"),
        &screw()?,
    )?;
    table(
        &mut text,
        "stored_linear",
        &format!("speed, normal_load, side_load; {TRAIN}"),
        &linear()?,
    )?;
    table(
        &mut text,
        "stored_efficiency",
        "lead_angle, contact_angle, ball_ratio, friction, rolling_tangent; rolling drive and back-drive, \
         sliding drive and back-drive, locked drive and back-drive",
        &efficiency()?,
    )?;
    table(
        &mut text,
        "stored_curvature",
        "pitch_radius, lead, ball_radius, groove, contact_angle; first, second, circular_groove, literature",
        &curvature()?,
    )?;
    Ok(text)
}
