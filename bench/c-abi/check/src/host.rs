//! The C tests on the host.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::tools::{Outcome, PANIC, WARNINGS, library, run, symbols};

/// Builds and runs the C tests, and sees that the header stands on its own.
pub fn check(root: &Path) -> Outcome<()> {
    let archive = library(root, None, true)?;
    let out = root.join("target/c");
    fs::create_dir_all(&out)?;
    let include = root.join("include");
    let compile = |standard: &str| {
        let mut command = Command::new("cc");
        command
            .arg(format!("-std={standard}"))
            .args(WARNINGS)
            .arg("-I")
            .arg(&include)
            // The README's gear.
            .arg("-I")
            .arg(root.join("test"));
        command
    };

    let alone = out.join("alone.c");
    fs::write(
        &alone,
        "#include \"epas_friction.h\"\n#include \"epas_friction.h\"\ntypedef epas_caged_t used;\n",
    )?;
    for standard in ["c90", "c99", "c11"] {
        // C90 has no type of 64 bits; stdint.h has one nevertheless.
        run(compile(standard)
            .args(["-Wno-long-long", "-fsyntax-only"])
            .arg(&alone))?;
    }

    let example = out.join("example.c");
    fs::write(
        &example,
        examples(&fs::read_to_string(root.join("README.md"))?),
    )?;

    let program = out.join("host");
    let test = root.join("test");
    run(compile("c99")
        .args(["-O2", "-Wl,--gc-sections", "-o"])
        .arg(&program)
        .args(
            [
                "host.c",
                "cases.c",
                "setups.c",
                "refusals.c",
                "changes.c",
                "reaction.c",
            ]
            .map(|file| test.join(file)),
        )
        .arg(&example)
        .arg(&archive)
        .arg("-lm"))?;
    print!("on the host\n{}", run(&mut Command::new(&program))?);

    // With the checks of a debug build there are panic paths. They have to show, or the proof proves nothing.
    let checked = library(root, None, false)?;
    let shows = symbols("nm", &checked)?
        .iter()
        .any(|(name, kind)| name == PANIC && *kind == 'U');
    if !shows {
        return Err(format!("{PANIC} does not show in a library with panic paths").into());
    }
    Ok(())
}

fn examples(readme: &str) -> String {
    let mut inside = false;
    let mut code = String::new();
    for line in readme.lines() {
        match line.trim() {
            "```c" => inside = true,
            "```" => inside = false,
            _ if inside => {
                code.push_str(line);
                code.push('\n');
            }
            _ => {}
        }
    }
    code
}
