//! A copy of the tree with all mutants in one build of the crate.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::failure::Failure;
use crate::list::Mutant;
use crate::rewrite::{Placed, rewritten};

/// A program of tests, and where it runs.
#[derive(Clone, Debug)]
pub struct Program {
    /// Its name: `epas-reference scenes`.
    pub name: String,
    /// The file.
    pub file: PathBuf,
    /// Folder of its package.
    pub folder: PathBuf,
}

/// The copy, and what cargo is given to build it.
#[derive(Debug)]
pub struct Tree {
    checkout: PathBuf,
    /// The root of the copy.
    pub folder: PathBuf,
    target: PathBuf,
}

/// Mutants behind the switch, and those that do not compile there; the rest have no place.
#[derive(Debug, Default)]
pub struct Switched {
    /// Those behind the switch.
    pub placed: Vec<Placed>,
    /// Those that do not compile.
    pub uncompiled: BTreeSet<usize>,
}

impl Tree {
    /// Copies what git tracks of a checkout, as it stands there, without the files that are changed.
    pub fn copied(
        checkout: &Path,
        folder: &Path,
        target: &Path,
        changed: &BTreeSet<&str>,
    ) -> Result<Self, Failure> {
        let listed = Command::new("git")
            .current_dir(checkout)
            .args(["ls-files", "-z"])
            .output()?;
        for file in String::from_utf8(listed.stdout)?.split_terminator('\0') {
            let (from, to) = (checkout.join(file), folder.join(file));
            // Those with mutants are written with them.
            if from.is_file() && !changed.contains(file) {
                write(&to, &fs::read(from)?)?;
            }
        }
        Ok(Self {
            checkout: checkout.to_owned(),
            folder: folder.to_owned(),
            target: target.to_owned(),
        })
    }

    /// Puts the mutants behind the switch: those that do not compile are left out, one round of the compiler after the other;
    /// those of an earlier run at once.
    pub fn switched(
        &self,
        mutants: &[Mutant],
        uncompiled: BTreeSet<usize>,
    ) -> Result<Switched, Failure> {
        let mut by_file: BTreeMap<&str, Vec<(usize, &Mutant)>> = BTreeMap::new();
        for (index, mutant) in mutants.iter().enumerate() {
            by_file
                .entry(&mutant.file)
                .or_default()
                .push((index + 1, mutant));
        }
        let mut sources = BTreeMap::new();
        for file in by_file.keys() {
            sources.insert(*file, fs::read_to_string(self.checkout.join(file))?);
        }
        self.add_switch(mutants.len())?;
        let mut switched = Switched {
            placed: Vec::new(),
            uncompiled,
        };
        loop {
            switched.placed.clear();
            for (file, mutants) in &by_file {
                let left: Vec<(usize, &Mutant)> = mutants
                    .iter()
                    .filter(|(number, _)| !switched.uncompiled.contains(number))
                    .copied()
                    .collect();
                let (text, placed) = rewritten(&sources[file], &left)
                    .map_err(|failure| format!("{file}: {failure}"))?;
                switched.placed.extend(placed);
                write(&self.folder.join(file), text.as_bytes())?;
            }
            let refused = self.refused()?;
            if refused.is_empty() {
                return Ok(switched);
            }
            println!("{} mutants do not compile", refused.len());
            switched.uncompiled.extend(refused);
        }
    }

    /// Adds the module of the switch to the crate, once.
    fn add_switch(&self, mutants: usize) -> Result<(), Failure> {
        let source = fs::read_to_string(self.checkout.join("src/lib.rs"))?;
        let (first, rest) = source.split_once('\n').ok_or("an empty crate")?;
        let with_switch = format!(
            "#![feature(core_intrinsics, const_eval_select)]\n{first}\n{rest}\n\
             #[doc(hidden)]\n#[allow(missing_docs, unsafe_code)]\npub mod mutant;\n"
        );
        write(&self.folder.join("src/lib.rs"), with_switch.as_bytes())?;
        let switch = include_str!("switch.rs").replace("NUMBERS", &(mutants + 1).to_string());
        write(&self.folder.join("src/mutant.rs"), switch.as_bytes())
    }

    fn cargo(&self, arguments: &[&str]) -> Result<Vec<Value>, Failure> {
        let output = Command::new("cargo")
            .current_dir(&self.folder)
            .args(arguments)
            .arg("--message-format=json")
            // What is known in the compiler and what runs are told apart by what only nightly compilers offer else.
            .env("RUSTC_BOOTSTRAP", "epas_friction")
            .env("RUSTFLAGS", "--cap-lints=allow")
            .env("CARGO_TARGET_DIR", &self.target)
            .env("CARGO_PROFILE_TEST_DEBUG", "0")
            .output()?;
        let messages: Vec<Value> = String::from_utf8(output.stdout)?
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok())
            .collect();
        if messages.is_empty() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        Ok(messages)
    }

    /// Mutants on lines that the compiler refuses.
    fn refused(&self) -> Result<BTreeSet<usize>, Failure> {
        let mut refused = BTreeSet::new();
        for message in
            self.cargo(&["check", "-p", "epas-friction", "--features", "embedded-hal"])?
        {
            let message = &message["message"];
            if message["level"] != "error" {
                continue;
            }
            let spans = message["spans"].as_array().map_or(&[][..], Vec::as_slice);
            let mut found = BTreeSet::new();
            // Where an error begins, and if nothing is marked there, whatever else it shows.
            for primary in [true, false] {
                if found.is_empty() {
                    for span in spans.iter().filter(|span| span["is_primary"] == primary) {
                        found.extend(self.marked(span)?);
                    }
                }
            }
            if found.is_empty() && !spans.is_empty() {
                return Err(format!("no mutant for {}", message["rendered"]).into());
            }
            refused.extend(found);
        }
        Ok(refused)
    }

    /// Numbers in the marks of a line, or of the last line before it that has some.
    fn marked(&self, span: &Value) -> Result<Vec<usize>, Failure> {
        let file = span["file_name"]
            .as_str()
            .ok_or("an error without a file")?;
        let line = span["line_start"].as_u64();
        let line = usize::try_from(line.ok_or("an error without a line")?)?;
        let text = fs::read_to_string(self.folder.join(file))?;
        let lines: Vec<&str> = text.lines().take(line).collect();
        let numbers = |line: &&str| -> Vec<usize> {
            line.split("/*m")
                .skip(1)
                .filter_map(|rest| rest.split_once("*/")?.0.parse().ok())
                .collect()
        };
        Ok(lines
            .iter()
            .rev()
            .map(numbers)
            .find(|numbers| !numbers.is_empty())
            .unwrap_or_default())
    }

    /// Builds the programs of tests.
    pub fn programs(&self, selection: &[String]) -> Result<Vec<Program>, Failure> {
        let mut arguments = vec!["test", "--no-run"];
        arguments.extend(selection.iter().map(String::as_str));
        let mut programs = Vec::new();
        for message in self.cargo(&arguments)? {
            if message["message"]["level"] == "error" {
                return Err(message["message"]["rendered"].to_string().into());
            }
            let (Some(file), Some(manifest)) = (
                message["executable"].as_str(),
                message["manifest_path"].as_str(),
            ) else {
                continue;
            };
            if message["profile"]["test"] == true {
                let folder = Path::new(manifest).parent().ok_or("no folder")?.to_owned();
                let package = folder
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let name = format!(
                    "{package} {}",
                    message["target"]["name"].as_str().unwrap_or_default()
                );
                programs.push(Program {
                    name,
                    file: file.into(),
                    folder,
                });
            }
        }
        Ok(programs)
    }

    /// The environment that cargo gives the programs it runs.
    pub fn environment(&self) -> Result<Vec<(String, String)>, Failure> {
        let text = fs::read_to_string(self.folder.join(".cargo/config.toml"))?;
        let table: toml::Table = text.parse()?;
        let entries = table
            .get("env")
            .and_then(toml::Value::as_table)
            .into_iter()
            .flatten();
        Ok(entries
            .filter_map(|(name, value)| Some((name.clone(), value.as_str()?.to_owned())))
            .collect())
    }
}

/// Writes a file, unless it is as it should be: what has not changed is not compiled again.
fn write(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if fs::read(file).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    Ok(fs::write(file, bytes)?)
}
