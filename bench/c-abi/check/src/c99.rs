//! The C99 file of `epas design`: the bits of the crate with every compiler at every level, on the host and on a Cortex-M4F, its own check of
//! the arithmetic, MISRA, and what it costs beside Rust.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "counts below their period, and the lengths of small lists"
)]

use std::fs;
use std::path::Path;
use std::process::Command;

use epas_friction::law::FrictionLevel;
use epas_friction::law::coefficient::{CoefficientLaw, TemperatureFade};
use epas_friction::law::memory::{Hysteresis, LoadExactElements, PreloadedElements};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, Freshness, WithMemory, WithMemoryConfiguration,
    WithMemoryInputs,
};
use epas_friction::{Error, FrictionModel, Inputs};

use crate::cases::{Numbers, Words as _};
use crate::gears;
use crate::setups;
use crate::target::{flash_alone, run_in_qemu};
use crate::tools::{Outcome, WARNINGS, run, run_to_end};

#[path = "../../../design/src/c99.rs"]
mod generator;

/// Ticks of each gear.
const TICKS: usize = 50_000;

/// Load, N, at which the elements are designed: that of the gears' preload and a little more.
const REFERENCE_LOAD: f32 = 500.0;

const SEED: u32 = 0x2026_0099;

const NAN: f32 = f32::NAN;

/// Fields of `rack_sensors_t`: sound ones, and then each out of its range.
#[rustfmt::skip]
const SENSORS: [(u32, [f32; 8]); 13] = [
    (16384, [1.533_981e-4, 1.2, 1e-4, 0.01, 0.09, 313.15, 10.0, 60.0]),
    (0, [-2e-3, 0.5, 0.0, 0.0, 0.5, 280.0, 0.0, 1e-3]),
    (5, [0.01, 0.024, 5e-3, 0.02, 1e-6, 500.0, 1.0, 7.0]),
    (1, [0.01, 0.005, 0.0, 0.0, 1.0, 300.0, 1.0, 1.0]),
    (5, [NAN, 0.02, 0.0, 0.0, 1.0, 300.0, 1.0, 1.0]),
    (5, [0.0, 0.02, 0.0, 0.0, 1.0, 300.0, 1.0, 1.0]),
    (5, [0.01, 0.026, 0.0, 0.0, 1.0, 300.0, 1.0, 1.0]),
    (5, [0.01, 0.02, -1e-3, 0.0, 1.0, 300.0, 1.0, 1.0]),
    (5, [0.01, 0.02, 0.0, NAN, 1.0, 300.0, 1.0, 1.0]),
    (5, [0.01, 0.02, 0.0, 0.0, 0.0, 300.0, 1.0, 1.0]),
    (5, [0.01, 0.02, 0.0, 0.0, 1.0, 20.0, 1.0, 1.0]),
    (5, [0.01, 0.02, 0.0, 0.0, 1.0, 300.0, 1e5, 1.0]),
    (5, [0.01, 0.02, 0.0, 0.0, 1.0, 300.0, 1.0, f32::INFINITY]),
];

/// Numbers that an input may be now and then; the last two are the reversal speed of the gears and the drag's largest speed.
#[rustfmt::skip]
const SPECIALS: [f32; 10] = [
    NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 4e-43, -f32::MIN_POSITIVE, f32::MAX, 0.5, 60.0,
];

type Remembering<const NODES: usize, E> =
    WithMemory<CagedBallScrew<NODES>, E, Deadband<CountSensor>, CoefficientLaw>;

/// A screw of the crate under random ticks.
struct Screw<const NODES: usize, E: Hysteresis + Copy> {
    block: CagedBallScrewConfiguration<NODES>,
    elements: E,
    numbers: Numbers,
    caged: FrictionModel<CagedBallScrew<NODES>>,
    memory: FrictionModel<Remembering<NODES, E>>,
    period: u32,
    count: u32,
}

/// A screw with memory behind these sensors.
fn remembering<const NODES: usize, E: Hysteresis + Copy>(
    scene: CagedBallScrewConfiguration<NODES>,
    elements: E,
    sensors: usize,
) -> Result<FrictionModel<Remembering<NODES, E>>, Error> {
    let (period, numbers) = SENSORS[sensors];
    let [
        turn_per_count,
        largest_turn,
        play,
        load_hold,
        load_fade,
        fallback,
        hold,
        fade,
    ] = numbers;
    let counts = CountSensor::new(CountSensorParameters {
        period,
        turn_per_count,
        largest_turn,
    })?;
    FrictionModel::<Remembering<NODES, E>>::new(&WithMemoryConfiguration {
        scene,
        elements,
        angle: Deadband::new(counts, play)?,
        reference_load: REFERENCE_LOAD,
        play: elements.breakaway(),
        coefficient: setups::law(0.12)?,
        temperature: TemperatureFade::new(fallback, hold, fade)?,
        freshness: Freshness {
            load_hold,
            load_fade,
        },
    })
}

impl<const NODES: usize, E: Hysteresis + Copy> Screw<NODES, E> {
    fn new(block: CagedBallScrewConfiguration<NODES>, elements: E) -> Result<Self, Error> {
        Ok(Self {
            block,
            elements,
            numbers: Numbers(SEED),
            caged: FrictionModel::<CagedBallScrew<NODES>>::new(&block)?,
            memory: remembering(block, elements, 0)?,
            period: SENSORS[0].0,
            count: 0,
        })
    }

    /// One of so many times.
    fn seldom(&mut self, times: u32) -> bool {
        self.numbers.below(times) == 0
    }

    /// A number up to a little more than a bound, of any size and sign; now and then a special one, or any bits.
    fn quantity(&mut self, bound: f32) -> f32 {
        let special = self.numbers.below(64) as usize;
        let size = 0.5_f32.powi(self.numbers.below(16) as i32);
        let any = f32::from_bits(self.numbers.word());
        match SPECIALS.get(special) {
            Some(&special) => special,
            None if special == 63 => any,
            None if special == 62 => bound,
            None => size * self.numbers.within(-1.1 * bound, 1.1 * bound),
        }
    }

    /// The next count, near the last one or far from it; seldom none.
    fn turned(&mut self) -> u32 {
        let most = if self.seldom(8) { 4000 } else { 3 };
        let ahead = i64::from(self.numbers.below(2 * most + 1)) - i64::from(most);
        let period = if self.period == 0 {
            1 << 32
        } else {
            i64::from(self.period)
        };
        self.count = (i64::from(self.count) + ahead).rem_euclid(period) as u32;
        if self.seldom(64) {
            self.period
        } else {
            self.count
        }
    }

    /// What is set now and then, with its numbers, and whether it was.
    fn set(&mut self) -> [u32; 4] {
        let what = self.numbers.below(128);
        let [first, second] = [0.6; 2].map(|most| self.numbers.within(0.02, most));
        let done = |what, first: f32, second: f32, done: bool| {
            [what, first.to_bits(), second.to_bits(), done.into()]
        };
        match what {
            0..4 => {
                let node = self.numbers.below(NODES as u32) as usize;
                let friction = match what {
                    0 => self.quantity(0.1),
                    1 => self.block.law.nodes[node].friction,
                    _ => 0.3 * first,
                };
                done(1, friction, 0.0, self.caged.set_friction(friction).is_ok())
            }
            4..8 => {
                let law = setups::law_of(first, second).and_then(|law| CoefficientLaw::new(&law));
                let set = law.and_then(|law| self.memory.set_coefficient(law));
                done(2, first, second, set.is_ok())
            }
            8..12 => {
                let [forward, backward] = [20.0 * first, 10.0 * second];
                let set = self.memory.set_level(FrictionLevel { forward, backward });
                done(3, forward, backward, set.is_ok())
            }
            12 => {
                let sensors = self.numbers.below(SENSORS.len() as u32);
                let made = remembering(self.block, self.elements, sensors as usize);
                if made.is_ok() {
                    (self.period, self.count) = (SENSORS[sensors as usize].0, 0);
                }
                done(
                    4,
                    sensors as f32,
                    0.0,
                    made.map(|made| self.memory = made).is_ok(),
                )
            }
            _ => done(0, 0.0, 0.0, true),
        }
    }

    /// An age, or seldom any up to a bound.
    fn age(&mut self, age: f32, bound: f32) -> f32 {
        if self.seldom(8) {
            self.quantity(bound)
        } else {
            age
        }
    }

    /// A tick as `test/c99.c` reads it.
    fn tick(&mut self) -> Vec<u32> {
        let [set, first, second, done] = self.set();
        let scene = Inputs {
            nut_speed: self.quantity(100.0),
            axial_load: self.quantity(20_000.0),
        };
        let inputs = WithMemoryInputs {
            scene,
            reading: self.turned(),
            load_age: self.age(0.001, 0.2),
            temperature: if self.seldom(16) {
                self.quantity(600.0)
            } else {
                self.numbers.within(240.0, 380.0)
            },
            temperature_age: self.age(0.5, 100.0),
        };
        let between = self.turned();
        let mut row = vec![
            set,
            first,
            second,
            scene.nut_speed.to_bits(),
            scene.axial_load.to_bits(),
            inputs.reading,
        ];
        row.extend([inputs.load_age, inputs.temperature, inputs.temperature_age].map(f32::to_bits));
        row.extend([between, done]);
        row.extend(self.caged.step(scene).words());
        row.extend(self.memory.step(inputs).words());
        row.extend(self.memory.between(between).words());
        row.push(self.memory.drag_torque().to_bits());
        row.push(self.caged.faulted_ticks() + self.memory.faulted_ticks());
        row
    }
}

/// A float as an expression of C.
fn float(number: f32) -> String {
    if number.is_finite() {
        format!("{number:e}f")
    } else {
        format!("({}.0f / 0.0f)", u8::from(!number.is_nan()))
    }
}

/// Writes a gear, and the ticks that are expected of it; its folder.
fn written<const NODES: usize, E: Hysteresis + Copy>(
    root: &Path,
    name: &'static str,
    words: &[u32],
    (elements, of): (E, fn(E) -> generator::Elements),
) -> Outcome<&'static str> {
    let folder = root.join(name);
    fs::create_dir_all(&folder)?;
    let block = CagedBallScrewConfiguration::<NODES>::read(words)?;
    let memory = generator::Memory {
        elements: of(elements),
        reference_load: REFERENCE_LOAD,
        law: setups::law_of(0.12, 0.05)?,
    };
    let files = generator::files(
        &["A gear of the tests.".into()],
        ["rack", "rack"],
        &block,
        &memory,
    )?;
    fs::write(folder.join("rack.h"), files.header)?;
    fs::write(folder.join("rack.c"), files.source)?;
    let mut screw = Screw::new(block, elements)?;
    let ticks: Vec<u8> = (0..TICKS)
        .flat_map(|_| screw.tick())
        .flat_map(u32::to_le_bytes)
        .collect();
    fs::write(folder.join("ticks.bin"), ticks)?;
    let sensors = SENSORS
        .map(|(period, numbers)| format!("{{{period}u, {}}}", numbers.map(float).join(", ")));
    fs::write(
        folder.join("ticks.h"),
        format!(
            "#define TICKS \"{}\"\n#define NUMBER {TICKS}u\n#define SENSORS {}\n",
            folder.join("ticks.bin").display(),
            sensors.join(", ")
        ),
    )?;
    Ok(name)
}

/// Runs a compiler in the root, with its warnings as errors.
fn compile(root: &Path, line: &str) -> Outcome<()> {
    let mut words = line.split_whitespace();
    let compiler = words.next().unwrap_or_default();
    let mut command = Command::new(compiler);
    run(command.current_dir(root).args(WARNINGS).args(words))?;
    Ok(())
}

/// Levels of optimisation, and flags under which the file's own check of the arithmetic has to fail.
const SOUND: [&str; 4] = ["-O0", "-O2", "-O3", "-O2 -DEPAS_PLAIN_C99"];
const UNSOUND: [&str; 3] = ["-O2 -ffp-contract=fast", "-O2 -DFLUSH", "-O2 -ffast-math"];

/// The ticks of a gear with every compiler at every level, by a function that compiles with a compiler and flags, and runs.
fn with_all_flags(
    compilers: [(&str, &[&str], &[&str]); 2],
    ran: impl Fn(&str, &str) -> Outcome<String>,
) -> Outcome<()> {
    for (compiler, sound, unsound) in compilers {
        for flags in sound {
            ran(compiler, &format!("-ffp-contract=off {flags}"))
                .map_err(|error| format!("{compiler} {flags}: {error}"))?;
        }
        for flags in unsound {
            let error = ran(compiler, &format!("-ffp-contract=off {flags}")).err();
            if !error.is_some_and(|error| error.to_string().contains("arithmetic is not sound")) {
                return Err(format!("{compiler} {flags}: the file does not find it out").into());
            }
        }
    }
    Ok(())
}

fn on_host(root: &Path, folder: &str) -> Outcome<()> {
    let compilers = ["gcc", "clang"].map(|name| (name, SOUND.as_slice(), UNSOUND.as_slice()));
    let ran = |compiler: &str, flags: &str| {
        let files = format!("-I{folder} {folder}/rack.c test/c99.c -o {folder}/host -lm");
        compile(root, &format!("{compiler} -std=c99 -mfma {flags} {files}"))?;
        run(&mut Command::new(root.join(folder).join("host")))
    };
    with_all_flags(compilers, ran)?;
    // Ticks with a subnormal load have other results then; the check passes.
    let flushed = "-ffp-contract=off -O2 -DFLUSH -DEPAS_NO_SUBNORMALS";
    let error = ran("gcc", flushed).err().map(|error| error.to_string());
    if error.is_none_or(|error| !error.contains("ticks, ")) {
        return Err("EPAS_NO_SUBNORMALS does not leave subnormal numbers out of the check".into());
    }
    Ok(())
}

/// On a Cortex-M4F in QEMU, the gear compiled by one compiler and the program around it by GCC; what it says.
fn on_target(root: &Path, folder: &str, compiler: &str, flags: &str) -> Outcome<String> {
    let core = "-std=c99 -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffreestanding -ffunction-sections -fdata-sections";
    let compiler = match compiler {
        "gcc" => "arm-none-eabi-gcc",
        _ => "clang --target=arm-none-eabi",
    };
    compile(
        root,
        &format!("{compiler} {core} {flags} -c {folder}/rack.c -o {folder}/rack.o"),
    )?;
    let program =
        "-Iinclude -Itest -Ifirmware firmware/startup.c firmware/semihosting.c test/c99.c";
    let linked = "-nostdlib -Wl,--gc-sections -Wl,-z,noexecstack -L../.. -Tfirmware/link.ld";
    let gcc = format!(
        "arm-none-eabi-gcc {core} -O2 {linked} {}",
        flags.replace("-ffast-math", "")
    );
    compile(
        root,
        &format!("{gcc} -I{folder} {program} {folder}/rack.o -o {folder}/target.elf"),
    )?;
    run_in_qemu("mps2-an386", &root.join(folder).join("target.elf"))
}

/// Advisory rules of MISRA C:2012 that the file's head says it violates; no required one is among them.
const DEVIATIONS: [&str; 3] = ["8.7", "8.9", "19.2"];

/// What cppcheck finds beyond the deviations, and whether the head names each.
fn misra(folder: &Path) -> Outcome<()> {
    let head = fs::read_to_string(folder.join("rack.c"))?;
    let (_, said) = run_to_end(
        Command::new("cppcheck")
            .args([
                "--std=c99",
                "--addon=misra",
                "--enable=warning,style,performance,portability",
            ])
            .args(["--suppress=unusedStructMember", "--quiet"])
            .arg(folder.join("rack.c")),
    )?;
    for line in said.lines().filter(|line| line.contains("rack.")) {
        let deviates = DEVIATIONS.iter().any(|rule| {
            line.ends_with(&format!("[misra-c2012-{rule}]"))
                && head.contains(&format!("\n *   {rule} "))
        });
        if !deviates {
            return Err(format!("cppcheck: {line}").into());
        }
    }
    if said.contains("[misra-c2012-19.2]") {
        Ok(())
    } else {
        Err(format!(
            "cppcheck finds no deviation, not even that of the union: did the addon run?\n{said}"
        )
        .into())
    }
}

/// A whole number of the function or the scene with a name in `bench/target.json`.
fn in_rust(root: &Path, name: &str, key: &str) -> Outcome<u32> {
    let text = fs::read_to_string(root.join("../target.json"))?;
    let after = |text: &str, what: &str| Some(text.split_once(what)?.1.to_owned());
    let found = after(&text, &format!("\"name\": \"{name}\""))
        .and_then(|rest| after(&rest, &format!("\"{key}\": ")))
        .and_then(|rest| rest.split([',', '\n']).next()?.parse().ok());
    Ok(found.ok_or(format!("target.json has no {key} of {name}"))?)
}

/// Prints what the target says of the C file beside the same of Rust, and refuses more than a few times that.
fn beside(root: &Path, said: &str, step: &str, scene: Option<&str>) -> Outcome<()> {
    let mut figures = vec![
        ("step", step, "instructions_max", 1.2),
        ("memory_step", "step_caged_law", "instructions_max", 1.2),
        ("memory_between", "between_caged", "instructions_max", 1.2),
        ("memory_ram", "caged_with_memory", "ram", 1.3),
        ("ram", "caged_ball_screw", "ram", 1.3),
    ];
    figures.extend(scene.map(|scene| ("flash", scene, "flash_beyond_empty", 1.3)));
    for (figure, name, key, most) in figures {
        let mut lines = said.lines();
        let found =
            lines.find_map(|line| line.strip_prefix(figure)?.strip_prefix(' ')?.parse().ok());
        let found: u32 = found.ok_or(format!("no {figure}: {said}"))?;
        let known = in_rust(root, name, key)?;
        let ratio = found as f32 / known as f32;
        println!("C99, {figure}: {found}, {ratio:.2} times {key} of {name} in Rust ({known})");
        if ratio > most {
            return Err(format!(
                "{figure}: {found} is more than {most} times that of Rust, {known}"
            )
            .into());
        }
    }
    Ok(())
}

/// Flash of block and step alone, bytes.
fn flash(root: &Path, folder: &str) -> Outcome<u32> {
    let alone = "-nostdlib -Wl,--gc-sections -Wl,--entry=0 -Wl,--undefined=rack_init -Wl,--undefined=rack_step";
    let core = "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16";
    compile(
        root,
        &format!("arm-none-eabi-gcc {core} {alone} {folder}/rack.o -o {folder}/step.elf"),
    )?;
    flash_alone(&root.join(folder).join("step.elf"))
}

/// Checks gears of all kinds of elements.
pub fn check(root: &Path, host_only: bool) -> Outcome<()> {
    use generator::Elements::{LoadExact, Preloaded, Proportional};
    let exact = LoadExactElements::<{ generator::ELEMENTS }>::new(0.04, 2e-3, 20.0)?;
    let proportional = (setups::elements()?, Proportional as fn(_) -> _);
    let preloaded = (PreloadedElements::new(exact), Preloaded as fn(_) -> _);
    let (gear, range) = (gears::GEAR_33X20, gears::GEAR_33X20_RANGE);
    let folders = [
        written::<1, _>(root, "target/c/c99/one", gear, proportional)?,
        written::<5, _>(root, "target/c/c99/range", range, proportional)?,
        written::<1, _>(root, "target/c/c99/exact", gear, (exact, LoadExact as _))?,
        written::<5, _>(root, "target/c/c99/preloaded", range, preloaded)?,
    ];
    for folder in folders {
        misra(&root.join(folder))?;
        on_host(root, folder)?;
    }
    let ticks = folders.len() * TICKS;
    println!("C99: {ticks} ticks have the bits of the crate on the host");
    if host_only {
        return Ok(());
    }
    // Without a root of the standard, for which there is no library; clang does not contract for a Cortex-M4.
    let compilers = [
        ("gcc", &SOUND[..3], UNSOUND.as_slice()),
        ("clang", &SOUND[..3], &UNSOUND[1..]),
    ];
    for folder in folders {
        with_all_flags(compilers, |compiler, flags| {
            on_target(root, folder, compiler, flags)
        })?;
    }
    let [one, range, ..] = folders;
    for (folder, step, scene) in [
        (one, "step_caged", Some("caged_ball_screw")),
        (range, "step_caged_range", None),
    ] {
        let said = on_target(root, folder, "gcc", "-O2 -ffp-contract=off")?;
        beside(
            root,
            &format!("{said}flash {}\n", flash(root, folder)?),
            step,
            scene,
        )?;
    }
    println!("C99: {ticks} ticks have the bits of the crate on the target");
    Ok(())
}
