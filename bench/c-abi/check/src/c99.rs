//! The C99 file of `epas design`: the bits of the crate with every compiler at every level, on the host and on a Cortex-M4F, its own check of
//! the arithmetic, MISRA, and what it costs beside Rust.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use epas_friction::law::FrictionLevel;
use epas_friction::law::coefficient::{CoefficientLaw, TemperatureFade};
use epas_friction::law::memory::{Hysteresis as _, ProportionalElements};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, Freshness, WithMemory, WithMemoryConfiguration,
    WithMemoryInputs,
};
use epas_friction::{Error, FrictionModel, Inputs, Outputs};

use crate::cases::{Numbers, Words as _};
use crate::gears;
use crate::outcome::Outcome;
use crate::setups;
use crate::target::{compiler, run_in_qemu};
use crate::tools::{WARNINGS, run, run_to_end};

#[path = "../../../design/src/c99.rs"]
mod generator;

/// Ticks of each gear: those that are stored, and a thousand times this many in all.
const STORED: usize = 1000;
const THOUSANDS: usize = 50;
const WORDS: usize = 18;

const SEED: u32 = 0x2026_0099;

type Remembering<const NODES: usize> =
    WithMemory<CagedBallScrew<NODES>, ProportionalElements<8>, Deadband<CountSensor>, CoefficientLaw>;

/// `period`, `turn_per_count`, `largest_turn`, `play`, `load_hold`, `load_fade`, `fallback_temperature`, `temperature_hold`, `temperature_fade`:
/// those of `test/c99.c`.
const SENSORS: [(u32, [f32; 8]); 3] = [
    (16384, [1.533_981e-4, 1.2, 1e-4, 0.01, 0.09, 313.15, 10.0, 60.0]),
    (0, [-2e-3, 0.5, 0.0, 0.0, 0.5, 280.0, 0.0, 1e-3]),
    (5, [0.01, 0.025, 5e-3, 0.02, 1e-6, 500.0, 1.0, 7.0]),
];

/// What `test/c99.c` has, in Rust.
struct Screw<const NODES: usize> {
    block: CagedBallScrewConfiguration<NODES>,
    numbers: Numbers,
    caged: FrictionModel<CagedBallScrew<NODES>>,
    memory: FrictionModel<Remembering<NODES>>,
    period: u32,
    count: u32,
}

/// A screw with memory behind these sensors.
fn remembering<const NODES: usize>(
    scene: CagedBallScrewConfiguration<NODES>,
    sensors: usize,
) -> Result<FrictionModel<Remembering<NODES>>, Error> {
    let (period, numbers) = SENSORS[sensors];
    let [turn_per_count, largest_turn, play, load_hold, load_fade, fallback, hold, fade] = numbers;
    let elements = setups::elements()?;
    let counts = CountSensor::new(CountSensorParameters {
        period,
        turn_per_count,
        largest_turn,
    })?;
    FrictionModel::<Remembering<NODES>>::new(&WithMemoryConfiguration {
        scene,
        elements,
        angle: Deadband::new(counts, play)?,
        reference_load: 1.0,
        play: elements.breakaway(),
        coefficient: setups::law(0.12)?,
        temperature: TemperatureFade::new(fallback, hold, fade)?,
        freshness: Freshness {
            load_hold,
            load_fade,
        },
    })
}

impl<const NODES: usize> Screw<NODES> {
    fn new(block: CagedBallScrewConfiguration<NODES>) -> Result<Self, Error> {
        let mut memory = remembering(block, 0)?;
        memory.between(5);
        Ok(Self {
            block,
            numbers: Numbers(SEED),
            caged: FrictionModel::<CagedBallScrew<NODES>>::new(&block)?,
            memory,
            period: SENSORS[0].0,
            count: 0,
        })
    }

    fn within(&mut self, bound: f32) -> f32 {
        ((self.numbers.word() >> 8) as f32 - 8_388_608.0) * (bound / 8_388_608.0)
    }

    fn between(&mut self, least: f32, most: f32) -> f32 {
        least + (self.numbers.word() >> 8) as f32 * ((most - least) / 16_777_216.0)
    }

    fn quantity(&mut self, bound: f32) -> f32 {
        const SPECIAL: [u32; 8] = [
            0x7FC0_0000,
            0x7F80_0000,
            0xFF80_0000,
            0,
            0x8000_0000,
            0x0000_0123,
            0x8040_0000,
            0x7F7F_FFFF,
        ];
        let kind = self.numbers.word() % 64;
        let size = self.numbers.word() % 16;
        let found = (0..size).fold(self.within(1.1 * bound), |found, _| 0.5 * found);
        match (SPECIAL.get(kind as usize), kind) {
            (Some(&bits), _) => f32::from_bits(bits),
            (None, 8) => bound,
            (None, 9) => f32::from_bits(self.numbers.word()),
            _ => found,
        }
    }

    fn turned(&mut self) -> u32 {
        let kind = self.numbers.word() % 64;
        let most = if kind < 8 { 4000 } else { 3 };
        let ahead = self.numbers.word() % (2 * most + 1);
        self.count = if self.period == 0 {
            self.count.wrapping_add(ahead).wrapping_sub(most)
        } else {
            (self.count + ahead + (most * self.period - most)) % self.period
        };
        if kind == 63 { u32::MAX } else { self.count }
    }

    fn change(&mut self) -> u32 {
        let kind = self.numbers.word() % 256;
        let (first, second) = (self.between(0.02, 0.6), self.between(0.02, 0.2));
        let set = |done: bool| u32::from(done);
        match kind {
            0..8 => set(self.caged.set_friction(first).is_ok()),
            8..12 => {
                let law = setups::law_of(first, second).and_then(|law| CoefficientLaw::new(&law));
                set(law
                    .and_then(|law| self.memory.set_coefficient(law))
                    .is_ok())
            }
            12..16 => {
                let (forward, backward) = (10.0 * first, 10.0 * second);
                let level = FrictionLevel { forward, backward };
                set(self.memory.set_level(level).is_ok())
            }
            16 => {
                let sensors = (self.numbers.word() % 3) as usize;
                let made = remembering(self.block, sensors);
                (self.period, self.count) = (SENSORS[sensors].0, 0);
                set(made.map(|made| self.memory = made).is_ok())
            }
            17 => {
                let friction = self.quantity(0.1);
                set(self.caged.set_friction(friction).is_ok())
            }
            _ => 2,
        }
    }

    /// This age, or seldom any up to a bound.
    fn age(&mut self, bound: f32, age: f32) -> f32 {
        if self.numbers.word() % 8 == 0 {
            self.quantity(bound)
        } else {
            age
        }
    }

    fn tick(&mut self) -> Vec<u32> {
        let mut row = vec![self.change()];
        let scene = Inputs {
            nut_speed: self.quantity(100.0),
            axial_load: self.quantity(20_000.0),
        };
        row.extend(self.caged.step(scene).words());
        let reading = self.turned();
        let inputs = WithMemoryInputs {
            scene,
            reading,
            load_age: self.age(0.2, 0.001),
            temperature: if self.numbers.word() % 16 == 0 {
                self.quantity(600.0)
            } else {
                self.between(240.0, 380.0)
            },
            temperature_age: self.age(100.0, 0.5),
        };
        row.extend(self.memory.step(inputs).words());
        let reading = self.turned();
        let between: Outputs = self.memory.between(reading);
        row.extend(between.words());
        row.push(self.memory.drag_torque().to_bits());
        row.push(self.caged.faulted_ticks() + self.memory.faulted_ticks());
        row
    }
}

/// What `test/c99.c` compares with: the first ticks with all outputs, and sums over all that went before after every thousand.
fn expected<const NODES: usize>(block: CagedBallScrewConfiguration<NODES>) -> Outcome<String> {
    let mut screw = Screw::new(block)?;
    let mut text = format!(
        "#include <stdint.h>\n\n#define SEED {SEED}u\n#define WORDS {WORDS}u\n#define THOUSANDS {THOUSANDS}u\n\n\
         static const uint32_t stored[{STORED}][WORDS] = {{\n"
    );
    let mut sums = String::new();
    let mut sum = 0x811c_9dc5_u32;
    for tick in 0..1000 * THOUSANDS {
        let row = screw.tick();
        assert_eq!(row.len(), WORDS);
        for word in &row {
            sum = (sum ^ word).wrapping_mul(0x0100_0193);
        }
        if tick < STORED {
            let row: Vec<_> = row.iter().map(|word| format!("0x{word:08x}u")).collect();
            writeln!(text, "    {{{}}},", row.join(", "))?;
        }
        if tick % 1000 == 999 {
            writeln!(sums, "    {sum}u,")?;
        }
    }
    write!(
        text,
        "}};\n\nstatic const uint32_t sums[THOUSANDS] = {{\n{sums}}};\n"
    )?;
    Ok(text)
}

/// Writes a gear and what is expected of it; its folder.
fn written<const NODES: usize>(root: &Path, name: &str, words: &[u32]) -> Outcome<PathBuf> {
    let folder = root.join("target/c/c99").join(name);
    fs::create_dir_all(&folder)?;
    let block = CagedBallScrewConfiguration::<NODES>::read(words)?;
    let memory = generator::Memory {
        elements: setups::elements()?,
        law: setups::law_of(0.12, 0.05)?,
    };
    let summary = [format!("A gear of the tests: {name} of friction coefficients.")];
    let files = generator::files(&summary, "rack", &block, &memory)?;
    fs::write(folder.join("rack.h"), files.header)?;
    fs::write(folder.join("rack.c"), files.source)?;
    fs::write(folder.join("expected.h"), expected(block)?)?;
    Ok(folder)
}

/// A C compiler of the host or of the target, with what it needs to make the test of a gear.
fn compile(root: &Path, mut command: Command, folder: &Path, flags: &[&str], image: &Path) -> Outcome<()> {
    run(command
        .args(["-std=c99", "-pedantic"])
        .args(WARNINGS)
        .arg("-I")
        .arg(folder)
        .arg(folder.join("rack.c"))
        .arg(root.join("test/c99.c"))
        .arg("-o")
        .arg(image)
        .args(flags))?;
    Ok(())
}

/// Ticks on the host with every compiler at every level, and flags under which the file's own check has to fail.
fn on_host(root: &Path, folder: &Path) -> Outcome<()> {
    let image = folder.join("host");
    for name in ["gcc", "clang"] {
        for level in ["-O0", "-O2", "-O3", "-O2 -DEPAS_PLAIN_C99"] {
            let flags: Vec<_> = level.split(' ').chain(["-ffp-contract=off", "-lm"]).collect();
            compile(root, Command::new(name), folder, &flags, &image)?;
            run(&mut Command::new(&image)).map_err(|error| format!("{name} {level}: {error}"))?;
        }
        for wrong in ["-ffp-contract=fast -mfma", "-ffp-contract=off -DFLUSH", "-ffast-math"] {
            let flags: Vec<_> = wrong.split(' ').chain(["-O2", "-lm"]).collect();
            compile(root, Command::new(name), folder, &flags, &image)?;
            unsound(run(&mut Command::new(&image)), &format!("{name} {wrong}"))?;
        }
    }
    Ok(())
}

/// Sees that a program has refused its arithmetic.
fn unsound(ran: Outcome<String>, flags: &str) -> Outcome<()> {
    match ran {
        Err(error) if error.to_string().contains("arithmetic is not sound") => Ok(()),
        Err(error) => Err(format!("{flags}: {error}").into()),
        Ok(_) => Err(format!("{flags}: the file's own check of the arithmetic has passed").into()),
    }
}

/// Checks both gears on the host.
pub fn check(root: &Path, _host_only: bool) -> Outcome<()> {
    for folder in gears_of(root)? {
        on_host(root, &folder)?;
    }
    println!("C99: {} ticks have the bits of the crate", 2000 * THOUSANDS);
    Ok(())
}

fn gears_of(root: &Path) -> Outcome<[PathBuf; 2]> {
    Ok([
        written::<1>(root, "one", gears::GEAR_33X20)?,
        written::<5>(root, "range", gears::GEAR_33X20_RANGE)?,
    ])
}
