//! Builds the firmware, runs it, and counts everything.

use std::path::{Path, PathBuf};

use epas_firmware::inputs::COUNTED;
use epas_firmware::subjects::{PEERS, SUBJECTS};
use rayon::prelude::*;

use super::image::{Image, code};
use super::longest::{Longest, longest};
use super::scenes::SCENES;
use super::stored;
use super::tools::{Built, Core, build, check};
use super::trace::Calls;
use super::watch::Watch;
use epas_bench::counts::{Figures, FunctionFigures, SceneFigures};
use epas_page::aside::say;
use epas_page::failure::Failure;

/// What an image of a scene prints: for each of its scenes the digest of its results and the stack.
struct Line {
    name: String,
    digest: u32,
    stack: u64,
    set_up: u64,
}

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

    // An emulator has one thread: as many run at once as there are cores.
    let folders = [folder.as_path(), small.as_path()];
    let empty = scene(folders, "empty", 0)?.0;
    let ((functions, runs), scenes) = rayon::join(
        || rayon::join(|| functions(folders), || whole_programs(&folder)),
        || {
            let scenes = SCENES.par_iter();
            let scenes = scenes.map(|(name, _, _)| scene(folders, name, empty.flash));
            scenes.collect::<Result<Vec<_>, Failure>>()
        },
    );

    let (functions, broken_limits) = functions?;
    let mut figures = Figures {
        functions,
        scenes: Vec::new(),
        empty,
        panic_free,
        soft_double: false,
        equal_to_host: runs?,
        scenes_equal: true,
        unwanted: Vec::new(),
        recursive: Vec::new(),
        out_of_place: Vec::new(),
        broken_limits,
    };
    let mut alone = Vec::new();
    let mut together = Vec::new();
    for ((name, has, left_out), (scene, lines)) in SCENES.iter().zip(scenes?) {
        figures
            .out_of_place
            .extend(out_of_place(&folder, name, has, left_out)?);
        figures.scenes.push(scene);
        let digests = lines.into_iter().map(|line| (line.name, line.digest));
        if *name == "everything" {
            together.extend(digests);
        } else {
            alone.extend(digests);
        }
    }
    // Scenes with memory are not among the others.
    alone.retain(|(name, _)| together.iter().any(|(other, _)| other == name));
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
            say(said);
            match build(images, Core::M4, profile, "halt")? {
                Built::In(folder) => Ok((folder, false)),
                Built::Panics(said) => Err(Failure::Data(said)),
            }
        }
    }
}

/// Whether the check and the control loop have the host's results; what they say where they have not.
fn whole_programs(folder: &Path) -> Result<bool, Failure> {
    let programs = ["check", "control_loop"].par_iter();
    let runs = programs.map(|name| Core::M4.run(&folder.join(name)));
    let runs = runs.collect::<Result<Vec<_>, Failure>>()?;
    for run in runs.iter().filter(|run| !run.passed) {
        say(run.text().trim_end());
    }
    Ok(runs.iter().all(|run| run.passed))
}

/// Counts every function on both cores, on the first one built for size as well; what counts have exceeded of the limits of
/// longest paths.
fn functions([folder, small]: [&Path; 2]) -> Result<(Vec<FunctionFigures>, Vec<String>), Failure> {
    let of = |core, path: &Path| Counted::of(path)?.count(core, path, Vec::new());
    let (on_m7, (on_m4, small)) = rayon::join(
        || match build(&["count"], Core::M7, "release", "halt")? {
            Built::In(folder) => of(Core::M7, &folder.join("count")),
            Built::Panics(said) => Err(Failure::Data(said)),
        },
        || {
            rayon::join(
                || bounded(&folder.join("count")),
                || of(Core::M4, &small.join("count")),
            )
        },
    );
    let (paths, counts) = on_m4?;
    let figures = counts
        .calls
        .iter()
        .zip(paths)
        .zip(&small?.calls)
        .zip(&on_m7?.calls)
        .map(|((((name, calls), longest), (_, small)), (_, other))| {
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
                longest: longest.as_ref().ok().copied(),
                no_longest: longest.err(),
                cycles_max_small: small.1,
                instructions_max_cortex_m7: other.1,
                inputs: calls.calls.len() as u32,
            })
        })
        .collect::<Result<_, Failure>>()?;
    Ok((figures, counts.broken))
}

/// Longest paths of an image's functions, then counts, checked against the limits on which they rest.
fn bounded(path: &Path) -> Result<(Vec<Result<u32, String>>, Counts), Failure> {
    let counted = Counted::of(path)?;
    let longest = longest(path, &counted.addresses)?;
    let (paths, watches): (Vec<_>, Vec<_>) = longest
        .into_iter()
        .map(|Longest { cycles, watch }| (cycles, watch))
        .unzip();
    let of_each = counted.places.iter();
    let paths = of_each.map(|(_, place, _)| paths[*place].clone()).collect();
    Ok((paths, counted.count(Core::M4, path, watches)?))
}

/// Longest paths of all counted functions beside what is counted in the same image, and what counts have exceeded.
pub fn longest_paths() -> Result<(Vec<Beside>, Vec<String>), Failure> {
    let path = built(&["count"], "release")?.0.join("count");
    let (paths, counts) = bounded(&path)?;
    let calls = counts.calls.into_iter().zip(paths);
    let beside = calls.map(|((name, calls), longest)| Beside {
        name,
        counted: calls.ranges().map_or(0, |[_, (_, most)]| most),
        longest,
    });
    Ok((beside.collect(), counts.broken))
}

/// Most cycles of a function over the inputs, and on its longest path.
pub struct Beside {
    pub name: &'static str,
    /// Most cycles over the inputs.
    pub counted: u32,
    /// Cycles on the longest path, or why there is none.
    pub longest: Result<u32, String>,
}

/// Functions of an image that are counted.
struct Counted {
    addresses: Vec<u32>,
    /// For each function the place of its address, and how many with the same address come before it:
    /// functions with the same instructions share one.
    places: Vec<(&'static str, usize, usize)>,
    from: u32,
}

/// Calls of each function by its name, and what they have exceeded.
struct Counts {
    calls: Vec<(&'static str, Calls)>,
    broken: Vec<String>,
}

impl Counted {
    fn of(path: &Path) -> Result<Self, Failure> {
        let image = Image::read(path)?;
        let mut addresses = Vec::new();
        let mut places: Vec<(&'static str, usize, usize)> = Vec::new();
        for subject in SUBJECTS.iter().chain(PEERS) {
            let address = image
                .address(&format!("count_{}", subject.name))
                .ok_or_else(|| Failure::Data(format!("no function count_{}", subject.name)))?;
            let known = addresses.iter().position(|&known| known == address);
            let place = known.unwrap_or(addresses.len());
            if known.is_none() {
                addresses.push(address);
            }
            let before = places.iter().filter(|(_, other, _)| *other == place);
            places.push((subject.name, place, before.count()));
        }
        let from = image.address("counting");
        Ok(Self {
            addresses,
            places,
            from: from.ok_or_else(|| Failure::Data("no function counting".into()))?,
        })
    }

    fn count(&self, core: Core, path: &Path, watches: Vec<Watch>) -> Result<Counts, Failure> {
        let counts = core.count(path, self.from, &self.addresses, watches)?;
        let inputs = COUNTED as usize;
        let calls = self.places.iter().map(|&(name, place, before)| {
            let calls = counts
                .calls
                .get(place)
                .and_then(|function| function.calls.get(before * inputs..(before + 1) * inputs))
                .ok_or_else(|| Failure::Data(format!("{name}: calls are missing")))?;
            let calls = calls.to_vec();
            Ok((name, Calls { calls }))
        });
        let broken = self.places.iter().flat_map(|&(name, place, _)| {
            let broken = counts.broken.get(place).into_iter().flatten();
            broken.map(move |what| format!("{name}: {what}"))
        });
        Ok(Counts {
            calls: calls.collect::<Result<_, Failure>>()?,
            broken: broken.collect(),
        })
    }
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
