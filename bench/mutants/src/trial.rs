//! Tests, which mutants they reach, and which they tell from the crate.

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};
use std::{fs, thread};

use serde::{Deserialize, Serialize};
use wait_timeout::ChildExt;

use crate::failure::Failure;
use crate::rewrite::Placed;
use crate::tree::Program;

/// A test longer than this by so many times is one that does not end.
const PATIENCE: u32 = 10;
/// But not before.
const LEAST_PATIENCE: Duration = Duration::from_secs(5);

/// What the system ends a program with that takes more of the processor than it may.
const SIGNAL_TIME: i32 = 24;
/// And one that does not hear.
const SIGNAL_KILL: i32 = 9;

/// One test of a program.
#[derive(Clone, Debug)]
pub struct Test {
    program: Program,
    name: String,
    time: Duration,
    /// By number: whether the place was reached (1), whether the mutant gave another value (2).
    reached: Vec<u8>,
}

/// How many mutants of each file each test has told from the crate so far.
type Falls = Mutex<BTreeMap<(String, usize), u32>>;

/// What became of a mutant.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// A test fails.
    Falls(String),
    /// A test does not end.
    Time(String),
    /// All tests that reach it pass: their number.
    Stands(usize),
    /// Gives the same value wherever a test reaches it.
    Same,
    /// No test reaches it while it runs.
    Unreached,
    /// Does not compile behind the switch.
    Uncompiled,
    /// Has no place behind the switch.
    Unplaced,
}

impl Outcome {
    /// How much it says: what runs is more than what compiles, and a test that fails more than one that passes.
    pub fn rank(&self) -> u8 {
        match self {
            Self::Uncompiled | Self::Unplaced => 0,
            Self::Unreached => 1,
            Self::Same => 2,
            Self::Stands(_) => 3,
            Self::Falls(_) | Self::Time(_) => 4,
        }
    }
}

/// Where tests run, and how many at once.
#[derive(Debug)]
pub struct Trial {
    /// The environment that cargo gives.
    pub environment: Vec<(String, String)>,
    /// Tests at once.
    pub jobs: usize,
    /// Tests that take longer are left out.
    pub longest: Duration,
    /// No more of a mutant's tests are run once they take so long in all.
    pub enough: Duration,
    /// Where it is kept what tests reach.
    pub folder: PathBuf,
}

impl Trial {
    /// The tests of the programs, with what they reach; those that fail with the crate as it is are an error.
    pub fn tests(&self, programs: &[Program]) -> Result<Vec<Test>, Failure> {
        let mut names = Vec::new();
        for program in programs {
            let listed = Command::new(&program.file)
                .args(["--list", "--format=terse"])
                .output()?;
            let ignored = Command::new(&program.file)
                .args(["--list", "--format=terse", "--ignored"])
                .output()?;
            let ignored = String::from_utf8(ignored.stdout)?;
            for line in String::from_utf8(listed.stdout)?.lines() {
                if let Some(name) = line
                    .strip_suffix(": test")
                    .filter(|_| !ignored.lines().any(|other| other == line))
                {
                    names.push((program.clone(), name.to_owned()));
                }
            }
        }
        fs::create_dir_all(&self.folder)?;
        let tests = Mutex::new(Vec::new());
        let failed = Mutex::new(Vec::new());
        self.each(names.len(), |index| {
            let (program, name) = &names[index];
            let build = program
                .file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy();
            let kept = self
                .folder
                .join(format!("{build} {}", name.replace("::", ".")));
            let known = |time, reached| {
                locked(&tests).push(Test {
                    program: program.clone(),
                    name: name.clone(),
                    time,
                    reached,
                });
            };
            if let Some((time, reached)) = read_reached(&kept, &program.file) {
                known(time, reached);
                return;
            }
            let start = Instant::now();
            let said = self.folder.join(format!("{index} said"));
            match self.run(
                program,
                name,
                self.longest,
                &[("MUTANT_REACHED", &said.to_string_lossy())],
            ) {
                Some(true) => {
                    let time = start.elapsed();
                    let reached = fs::read(&said).unwrap_or_default();
                    // What can't be kept is found again by the next run.
                    let _ = fs::write(
                        &kept,
                        [&time.as_secs_f64().to_le_bytes()[..], &reached].concat(),
                    );
                    known(time, reached);
                }
                Some(false) => locked(&failed).push(format!("{} {name}", program.name)),
                None => println!("left out, too long: {} {name}", program.name),
            }
        });
        let failed = failed.into_inner().unwrap_or_default();
        if !failed.is_empty() {
            return Err(format!("these fail with the crate as it is: {failed:#?}").into());
        }
        Ok(tests.into_inner().unwrap_or_default())
    }

    /// Tries mutants, and gives each outcome as it is known; `file` says where a mutant stands.
    pub fn tried(
        &self,
        tests: &[Test],
        mutants: &[Placed],
        file: impl Fn(usize) -> String + Sync,
        known: impl Fn(usize, Outcome) + Sync,
    ) {
        let falls = Falls::default();
        self.each(mutants.len(), |index| {
            let mutant = mutants[index];
            known(
                mutant.number,
                self.outcome(tests, &falls, mutant, &file(mutant.number)),
            );
        });
    }

    /// Runs the tests that can tell a mutant, first those that are quick and have told many of its file.
    fn outcome(&self, tests: &[Test], falls: &Falls, mutant: Placed, file: &str) -> Outcome {
        let reaches = |test: &Test| {
            test.reached
                .get(mutant.place)
                .is_some_and(|reached| reached & 1 != 0)
        };
        let tells = |test: &Test| !mutant.compares || test.reached[mutant.number] & 2 != 0;
        let mut wanted: Vec<usize> = (0..tests.len())
            .filter(|&index| reaches(&tests[index]))
            .collect();
        if wanted.is_empty() {
            return Outcome::Unreached;
        }
        wanted.retain(|&index| tells(&tests[index]));
        let told = locked(falls).clone();
        wanted.sort_by_cached_key(|&index| {
            tests[index].time
                / (1 + told
                    .get(&(file.to_owned(), index))
                    .copied()
                    .unwrap_or_default())
        });
        let (mut passed, mut spent) = (0, Duration::ZERO);
        for index in wanted {
            let test = &tests[index];
            spent += test.time;
            if passed > 0 && spent > self.enough {
                break;
            }
            let name = || format!("{} {}", test.program.name, test.name);
            let patience = LEAST_PATIENCE.max(test.time * PATIENCE);
            let number = mutant.number.to_string();
            match self.run(&test.program, &test.name, patience, &[("MUTANT", &number)]) {
                Some(true) => passed += 1,
                Some(false) => {
                    *locked(falls).entry((file.to_owned(), index)).or_default() += 1;
                    return Outcome::Falls(name());
                }
                None => return Outcome::Time(name()),
            }
        }
        if passed == 0 {
            Outcome::Same
        } else {
            Outcome::Stands(passed)
        }
    }

    /// Whether a test passes; nothing if it takes more of the processor than `patience`, or waits ten times as long.
    fn run(
        &self,
        program: &Program,
        test: &str,
        patience: Duration,
        more: &[(&str, &str)],
    ) -> Option<bool> {
        let mut child: Child = Command::new("sh")
            .args([
                "-c",
                "ulimit -t \"$0\"; exec \"$@\"",
                &patience.as_secs().to_string(),
            ])
            .arg(&program.file)
            .args(["--exact", test, "--test-threads=1"])
            .current_dir(&program.folder)
            .envs(self.environment.iter().map(|(name, value)| (name, value)))
            .env("CARGO_MANIFEST_DIR", &program.folder)
            .envs(more.iter().copied())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let status = child.wait_timeout(10 * patience).ok()?;
        if status.is_none() {
            let _ = child.kill();
            let _ = child.wait();
        }
        // A panic in a destructor aborts: that is a failure. The system ends what takes too long by two signals.
        let ended =
            |status: &ExitStatus| matches!(status.signal(), Some(SIGNAL_KILL | SIGNAL_TIME));
        status
            .filter(|status| !ended(status))
            .map(|status| status.success())
    }

    /// Does something for every index, as many at once as there are jobs.
    fn each(&self, count: usize, one: impl Fn(usize) + Sync) {
        let next = AtomicUsize::new(0);
        thread::scope(|scope| {
            for _ in 0..self.jobs {
                scope.spawn(|| {
                    loop {
                        let index = next.fetch_add(1, Relaxed);
                        if index >= count {
                            break;
                        }
                        one(index);
                    }
                });
            }
        });
    }
}

/// What an earlier run has found that a test reaches, and its time, if its program has not been built since.
fn read_reached(kept: &Path, program: &Path) -> Option<(Duration, Vec<u8>)> {
    let changed = |file: &Path| fs::metadata(file).and_then(|data| data.modified()).ok();
    if changed(kept)? < changed(program)? {
        return None;
    }
    let bytes = fs::read(kept).ok()?;
    let (time, reached) = bytes.split_first_chunk()?;
    Some((
        Duration::try_from_secs_f64(f64::from_le_bytes(*time)).ok()?,
        reached.to_vec(),
    ))
}

/// What another thread's panic has left is as good.
pub fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Reads outcomes by name, if there are some.
pub fn read(file: &Path) -> Result<BTreeMap<String, Outcome>, Failure> {
    if file.exists() {
        Ok(serde_json::from_slice(&fs::read(file)?)?)
    } else {
        Ok(BTreeMap::default())
    }
}

/// Writes outcomes by name.
pub fn write(file: &Path, outcomes: &BTreeMap<String, Outcome>) -> Result<(), Failure> {
    Ok(fs::write(file, serde_json::to_vec_pretty(outcomes)?)?)
}
