//! All figures of a run: functions, scenes, proofs.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use epas_firmware::subjects::{COUNTED, PEERS, SUBJECTS};
use serde::{Deserialize, Serialize};

use super::budgets::{BUDGETS, figure};
use super::image::{Image, code};
use super::stored;
use super::tools::{Built, Core, build, check};
use super::trace::Calls;
use crate::failure::Failure;

/// Scenes, each with an image of its own, a module of the crate that it has, and those that it leaves out.
const SCENES: [(&str, &str, &[&str]); 6] = [
    (
        "curvature",
        "curvature",
        &[
            "efficiency",
            "kinematics",
            "contact",
            "ball",
            "train",
            "scene",
            "model",
        ],
    ),
    (
        "efficiency",
        "efficiency",
        &[
            "curvature",
            "hertz",
            "kinematics",
            "contact",
            "ball",
            "train",
            "scene",
            "model",
        ],
    ),
    (
        "caged_ball_screw",
        "scene::caged",
        &[
            "curvature",
            "hertz",
            "kinematics",
            "contact",
            "ball",
            "train",
            "scene::linear",
            "scene::screw",
            "scene::uncaged",
            "scene::zone",
        ],
    ),
    (
        "linear_bearing",
        "train",
        &[
            "curvature",
            "efficiency",
            "kinematics",
            "geometry::ball_screw",
            "ball::screw::across",
            "ball::four_point",
            "scene::caged",
            "scene::screw",
        ],
    ),
    (
        "ball_screw_37",
        "ball::screw::row",
        &[
            "efficiency",
            "kinematics",
            "geometry::linear_bearing",
            "ball::four_point",
            "scene::caged",
            "scene::linear",
        ],
    ),
    ("everything", "train", &[]),
];

/// What a run found.
// Each says by itself whether something holds.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Functions of the crate, then what others offer.
    pub functions: Vec<FunctionFigures>,
    /// Scenes.
    pub scenes: Vec<SceneFigures>,
    /// The program that computes nothing.
    pub empty: SceneFigures,
    /// Whether every image links without any way to the panic handler.
    pub panic_free: bool,
    /// Whether any image of the crate's own holds arithmetic in double precision by software.
    pub soft_double: bool,
    /// Whether every result on the target has the bits of the host's.
    pub equal_to_host: bool,
    /// Whether each scene alone gives what it gives among all the others.
    pub scenes_equal: bool,
    /// Names that no image may hold and one does: an allocator, formatting.
    pub unwanted: Vec<String>,
    /// Functions that can call themselves, directly or through others.
    pub recursive: Vec<String>,
    /// Code of the crate in the image of a scene that leaves it out, inlined code included.
    pub out_of_place: Vec<String>,
}

/// What a function takes, from its first instruction to its return.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FunctionFigures {
    /// Its name.
    pub name: String,
    /// Least and most instructions over the inputs, on a Cortex-M4F.
    pub instructions_min: u32,
    /// See above.
    pub instructions_max: u32,
    /// Least and most cycles over the inputs, by Arm's table for the Cortex-M4F.
    pub cycles_min: u32,
    /// See above.
    pub cycles_max: u32,
    /// Most cycles of the same function built for size.
    pub cycles_max_small: u32,
    /// Most instructions of the same function built for a Cortex-M7.
    pub instructions_max_cortex_m7: u32,
    /// How many inputs.
    pub inputs: u32,
}

/// What a scene takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneFigures {
    /// Its name.
    pub name: String,
    /// Bytes of flash of its whole image.
    pub flash: u64,
    /// Bytes of flash more than the program that computes nothing.
    pub flash_beyond_empty: u64,
    /// Bytes of memory, the stack not counted.
    pub ram: u64,
    /// Bytes of stack of a tick, at most.
    pub stack: u64,
    /// Bytes of stack of the set-up.
    pub stack_set_up: u64,
    /// Bytes of flash of its whole image built for size.
    pub flash_small: u64,
    /// Bytes of stack of a tick, at most, built for size.
    pub stack_small: u64,
}

/// What an image of a scene prints: for each of its scenes the digest of its results and the stack.
struct Line {
    name: String,
    digest: u32,
    stack: u64,
    set_up: u64,
}

/// Builds, runs and counts everything.
pub fn measure() -> Result<Figures, Failure> {
    check()?;
    stored::check_cases()?;
    let names: Vec<String> = SCENES
        .iter()
        .map(|(name, _, _)| *name)
        .chain(["empty"])
        .map(|scene| format!("scene_{scene}"))
        .collect();
    let images: Vec<&str> = names
        .iter()
        .map(String::as_str)
        .chain(["check", "control_loop", "count"])
        .collect();
    let (small, small_panic_free) = built(&images, "small")?;
    let (folder, panic_free) = built(&images, "release")?;
    let panic_free = panic_free && small_panic_free;

    let checked = Core::M4.run(&folder.join("check"))?;
    let looped = Core::M4.run(&folder.join("control_loop"))?;
    for run in [&checked, &looped] {
        if !run.passed {
            eprint!("{}", run.text());
        }
    }

    let mut figures = Figures {
        functions: functions(&folder, &small)?,
        scenes: Vec::new(),
        empty: scene([&folder, &small], "empty", 0)?.0,
        panic_free,
        soft_double: false,
        equal_to_host: checked.passed && looped.passed,
        scenes_equal: true,
        unwanted: Vec::new(),
        recursive: Vec::new(),
        out_of_place: Vec::new(),
    };
    let mut alone = Vec::new();
    let mut together = Vec::new();
    for (name, has, left_out) in SCENES {
        let (scene, lines) = scene([&folder, &small], name, figures.empty.flash)?;
        figures
            .out_of_place
            .extend(out_of_place(&folder, name, has, left_out)?);
        figures.scenes.push(scene);
        let digests = lines.into_iter().map(|line| (line.name, line.digest));
        if name == "everything" {
            together.extend(digests);
        } else {
            alone.extend(digests);
        }
    }
    figures.scenes_equal = alone == together;
    for name in names.iter().map(String::as_str).chain(["check"]) {
        let image = Image::read(&folder.join(name))?;
        figures.soft_double |= image.names().any(|name| name.starts_with("__aeabi_d"));
        for (list, found) in [
            (&mut figures.unwanted, image.unwanted()),
            (&mut figures.recursive, image.recursive()),
        ] {
            for function in found {
                if !list.contains(&function) {
                    list.push(function);
                }
            }
        }
    }
    Ok(figures)
}

/// Builds images for the Cortex-M4F, and whether they link without any way to the panic handler.
fn built(images: &[&str], profile: &str) -> Result<(PathBuf, bool), Failure> {
    match build(images, Core::M4, profile, "")? {
        Built::In(folder) => Ok((folder, true)),
        Built::Panics(said) => {
            eprintln!("{said}");
            match build(images, Core::M4, profile, "halt")? {
                Built::In(folder) => Ok((folder, false)),
                Built::Panics(said) => Err(Failure::Data(said)),
            }
        }
    }
}

/// Counts every function on both cores, on the first one built for size as well.
fn functions(folder: &Path, small: &Path) -> Result<Vec<FunctionFigures>, Failure> {
    let on_m4 = count(Core::M4, &folder.join("count"))?;
    let small = count(Core::M4, &small.join("count"))?;
    let on_m7 = match build(&["count"], Core::M7, "release", "halt")? {
        Built::In(folder) => count(Core::M7, &folder.join("count"))?,
        Built::Panics(said) => return Err(Failure::Data(said)),
    };
    on_m4
        .iter()
        .zip(&small)
        .zip(&on_m7)
        .map(|(((name, calls), (_, small)), (_, other))| {
            let missing = || Failure::Data(format!("{name} was never called"));
            let [instructions, cycles] = calls.ranges().ok_or_else(missing)?;
            let [_, small] = small.ranges().ok_or_else(missing)?;
            let [other, _] = other.ranges().ok_or_else(missing)?;
            Ok(FunctionFigures {
                name: (*name).into(),
                instructions_min: instructions.0,
                instructions_max: instructions.1,
                cycles_min: cycles.0,
                cycles_max: cycles.1,
                cycles_max_small: small.1,
                instructions_max_cortex_m7: other.1,
                inputs: calls.calls.len() as u32,
            })
        })
        .collect()
}

/// Counts every function of an image.
fn count(core: Core, path: &Path) -> Result<Vec<(&'static str, Calls)>, Failure> {
    let image = Image::read(path)?;
    let mut addresses = Vec::new();
    // For each function the place of its address, and how many with the same address come before it:
    // functions with the same instructions share one.
    let mut places = Vec::new();
    for subject in SUBJECTS.iter().chain(PEERS) {
        let address = image
            .address(&format!("count_{}", subject.name))
            .ok_or_else(|| Failure::Data(format!("no function count_{}", subject.name)))?;
        let known = addresses.iter().position(|&known| known == address);
        let place = known.unwrap_or(addresses.len());
        if known.is_none() {
            addresses.push(address);
        }
        let before = places
            .iter()
            .filter(|(_, other, _)| *other == place)
            .count();
        places.push((subject.name, place, before));
    }
    let calls = core.count(path, &addresses)?;
    let inputs = COUNTED as usize;
    places
        .into_iter()
        .map(|(name, place, before)| {
            let calls = calls
                .get(place)
                .and_then(|function| function.calls.get(before * inputs..(before + 1) * inputs))
                .ok_or_else(|| Failure::Data(format!("{name}: calls are missing")))?;
            Ok((
                name,
                Calls {
                    calls: calls.to_vec(),
                },
            ))
        })
        .collect()
}

/// Functions in the image of a scene that belong to modules that it leaves out; one module that it has is
/// looked for as well, or else nothing found would prove nothing.
fn out_of_place(
    folder: &Path,
    name: &str,
    has: &str,
    left_out: &[&str],
) -> Result<Vec<String>, Failure> {
    let code = code(&folder.join(format!("scene_{name}")))?;
    let belongs =
        |function: &str, module: &str| function.contains(&format!("epas_friction::{module}::"));
    if !code.iter().any(|function| belongs(function, has)) {
        return Err(Failure::Data(format!(
            "the debug information of scene {name} knows nothing of {has}"
        )));
    }
    Ok(code
        .into_iter()
        .filter(|function| left_out.iter().any(|module| belongs(function, module)))
        .map(|function| format!("{function} in {name}"))
        .collect())
}

/// What the image of a scene prints.
fn lines(path: &Path) -> Result<Vec<Line>, Failure> {
    let run = Core::M4.run(path)?;
    let text = run.text();
    let lines: Option<Vec<Line>> = text
        .lines()
        .map(|line| {
            let mut words = line.split_whitespace();
            Some(Line {
                name: words.next()?.to_owned(),
                digest: words.next()?.parse().ok()?,
                stack: words.next()?.parse().ok()?,
                set_up: words.next()?.parse().ok()?,
            })
        })
        .collect();
    lines
        .filter(|lines| run.passed && !lines.is_empty())
        .ok_or_else(|| Failure::Data(format!("{} failed:\n{text}", path.display())))
}

/// Runs the image of a scene, built for speed and built for size.
fn scene(
    folders: [&Path; 2],
    name: &str,
    empty: u64,
) -> Result<(SceneFigures, Vec<Line>), Failure> {
    let [fast, small] = folders.map(|folder| folder.join(format!("scene_{name}")));
    let image = Image::read(&fast)?;
    let most = |lines: &[Line], value: fn(&Line) -> u64| lines.iter().map(value).max().unwrap_or(0);
    let (found, of_small) = (lines(&fast)?, lines(&small)?);
    if !found
        .iter()
        .map(|line| line.digest)
        .eq(of_small.iter().map(|line| line.digest))
    {
        return Err(Failure::Data(format!(
            "scene {name} built for size gives other results"
        )));
    }
    let figures = SceneFigures {
        name: name.into(),
        flash: image.flash,
        flash_beyond_empty: image.flash.saturating_sub(empty),
        ram: image.ram,
        stack: most(&found, |line| line.stack),
        stack_set_up: most(&found, |line| line.set_up),
        flash_small: Image::read(&small)?.flash,
        stack_small: most(&of_small, |line| line.stack),
    };
    Ok((figures, found))
}

impl Figures {
    /// A function by its name.
    pub fn function(&self, name: &str) -> Option<&FunctionFigures> {
        self.functions.iter().find(|entry| entry.name == name)
    }

    /// A scene by its name.
    pub fn scene(&self, name: &str) -> Option<&SceneFigures> {
        self.scenes.iter().find(|entry| entry.name == name)
    }

    /// Everything as text.
    pub fn text(&self) -> String {
        let mut text = String::from(
            "Cortex-M4F, cycles by Arm's table (a model, no wait states), each call from its first instruction\n\
             to its return; `small` is what is built for size\n\n",
        );
        let _ = writeln!(
            text,
            "{:26}{:>8}{:>8}{:>10}{:>8}{:>8}{:>12}",
            "function", "instr.", "most", "cycles", "most", "small", "M7 instr."
        );
        for entry in &self.functions {
            let _ = writeln!(
                text,
                "{:26}{:>8}{:>8}{:>10}{:>8}{:>8}{:>12}",
                entry.name,
                entry.instructions_min,
                entry.instructions_max,
                entry.cycles_min,
                entry.cycles_max,
                entry.cycles_max_small,
                entry.instructions_max_cortex_m7
            );
        }
        let _ = writeln!(
            text,
            "\n{:26}{:>8}{:>14}{:>8}{:>8}{:>16}{:>8}{:>8}",
            "scene, bytes",
            "flash",
            "beyond empty",
            "RAM",
            "stack",
            "set-up's stack",
            "small",
            "stack"
        );
        for scene in self.scenes.iter().chain([&self.empty]) {
            let _ = writeln!(
                text,
                "{:26}{:>8}{:>14}{:>8}{:>8}{:>16}{:>8}{:>8}",
                scene.name,
                scene.flash,
                scene.flash_beyond_empty,
                scene.ram,
                scene.stack,
                scene.stack_set_up,
                scene.flash_small,
                scene.stack_small
            );
        }
        let _ = writeln!(text, "\n{:44}{:>10}{:>10}", "budget", "allowed", "found");
        for budget in &BUDGETS {
            if let Some(found) = figure(self, budget) {
                let missed = if found > budget.most {
                    format!("  missed by {:.0} %", 100.0 * (found / budget.most - 1.0))
                } else {
                    String::new()
                };
                let decimals = usize::from(budget.most < 10.0);
                let _ = writeln!(
                    text,
                    "{:44}{:>10.decimals$}{found:>10.decimals$}{missed}",
                    budget.what(),
                    budget.most
                );
            }
        }
        let _ = writeln!(text, "\n{}", self.proofs());
        text
    }

    /// What holds of the images, a line each.
    pub fn proofs(&self) -> String {
        let yes = |yes: bool| if yes { "yes" } else { "NO" };
        [
            (
                "results equal to the host's bit for bit",
                self.equal_to_host,
            ),
            ("no way to a panic", self.panic_free),
            ("no double precision by software", !self.soft_double),
            ("scenes alone equal to all in one", self.scenes_equal),
            ("no allocator, no formatting", self.unwanted.is_empty()),
            ("no recursion", self.recursive.is_empty()),
            (
                "every scene without what it leaves out",
                self.out_of_place.is_empty(),
            ),
        ]
        .map(|(what, holds)| format!("{what}: {}", yes(holds)))
        .join("\n")
    }

    /// Fails where something does not hold that must hold whatever it costs.
    pub fn require(&self) -> Result<(), Failure> {
        let mut broken = Vec::new();
        let mut require = |holds: bool, what: String| {
            if !holds {
                broken.push(what);
            }
        };
        require(
            self.equal_to_host,
            "results on the target differ from the host's".into(),
        );
        require(self.panic_free, "a way to the panic handler is left".into());
        require(
            !self.soft_double,
            "double precision by software is linked".into(),
        );
        require(
            self.scenes_equal,
            "a scene gives other numbers alone than among the others".into(),
        );
        require(
            self.unwanted.is_empty(),
            format!("unwanted in an image: {}", self.unwanted.join(", ")),
        );
        require(
            self.recursive.is_empty(),
            format!("recursive: {}", self.recursive.join(", ")),
        );
        require(
            self.out_of_place.is_empty(),
            format!("not left out: {}", self.out_of_place.join(", ")),
        );
        if broken.is_empty() {
            Ok(())
        } else {
            Err(Failure::Data(broken.join("\n")))
        }
    }
}
