//! Writes or checks what is generated, runs the C tests on the host and in QEMU, and proves of the images what
//! the README promises.
//!
//! ```text
//! cargo run -p epas-c-check               # check everything
//! cargo run -p epas-c-check -- --host     # without cross compiler and QEMU
//! cargo run -p epas-c-check -- --c99     # only the C99 file of `epas design`
//! cargo run -p epas-c-check -- --write    # write sizes, header and stored cases first
//! ```

mod c99;
mod cases;
mod gears;
mod host;
mod places;
mod setups;
mod target;
mod tools;

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use tools::Outcome;

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut write = false;
    let mut host_only = false;
    let mut c99_only = false;
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--write" => write = true,
            "--host" => host_only = true,
            "--c99" => c99_only = true,
            _ => {
                eprintln!("usage: epas-c-check [--write] [--host] [--c99]");
                return ExitCode::from(2);
            }
        }
    }
    let ran = if c99_only {
        c99::check(&root, host_only)
    } else {
        run(&root, write, host_only)
    };
    match ran {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(root: &Path, write: bool, host_only: bool) -> Outcome<()> {
    places::check(root, write)?;
    let header = tools::header(root)?;
    up_to_date(root, "include/epas_friction.h", &header, write)?;
    up_to_date(root, "test/gears.h", &gears::of_tests()?, write)?;
    for (name, text) in gears::of_examples()? {
        up_to_date(root, name, &text, write)?;
    }
    let stored = cases::generated()?;
    up_to_date(root, "test/stored.h", &stored, write)?;
    cases::told(root, &stored)?;
    host::check(root)?;
    c99::check(root, host_only)?;
    if !host_only {
        target::check(root)?;
    }
    println!("everything holds");
    Ok(())
}

fn up_to_date(root: &Path, name: &str, text: &str, write: bool) -> Outcome<()> {
    let file = root.join(name);
    if fs::read_to_string(&file).is_ok_and(|stored| stored == text) {
        println!("{name} is up to date");
        Ok(())
    } else if write {
        fs::write(&file, text)?;
        println!("wrote {name}");
        Ok(())
    } else {
        Err(format!(
            "{name} is not what the sources give: run `cargo run -p epas-c-check -- --write`"
        )
        .into())
    }
}
