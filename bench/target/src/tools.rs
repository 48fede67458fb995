//! Cargo for the target, and QEMU.

use std::io::{BufReader, Error, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use super::debugger::Debugger;
use super::trace::{Counter, Counts};
use super::watch::Watch;
use epas_page::failure::Failure;

/// The target's name.
pub const TARGET: &str = "thumbv7em-none-eabihf";

const QEMU: &str = "qemu-system-arm";

const PATIENCE: Duration = Duration::from_secs(300);

pub fn firmware() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../firmware")
}

/// Checks that everything is there; else says which command adds it.
pub fn check() -> Result<(), Failure> {
    let mut missing = Vec::new();
    if let Some(command) = target_missing()? {
        missing.push(format!(
            "the Rust target {TARGET} is not installed; this adds it:\n  {command}"
        ));
    }
    match Command::new(QEMU).arg("--version").output() {
        Ok(output) if output.status.success() => {}
        _ => missing.push(format!(
            "{QEMU} is not installed; this adds it:\n  apt-get install qemu-system-arm   (Debian, Ubuntu)\n  brew install qemu                 (macOS)"
        )),
    }
    if missing.is_empty() {
        Ok(())
    } else {
        Err(Failure::Data(missing.join("\n")))
    }
}

/// The command that adds the target where it is missing.
fn target_missing() -> Result<Option<String>, Failure> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc)
        .args(["--print", "target-libdir", "--target", TARGET])
        .current_dir(firmware())
        .output()
        .map_err(|error| Failure::Data(format!("cannot run rustc: {error}")))?;
    let folder = String::from_utf8_lossy(&output.stdout);
    if output.status.success() && Path::new(folder.trim()).is_dir() {
        return Ok(None);
    }
    let toolchain = std::env::var("RUSTUP_TOOLCHAIN")
        .map(|name| format!(" --toolchain {name}"))
        .unwrap_or_default();
    Ok(Some(format!("rustup target add {TARGET}{toolchain}")))
}

pub enum Built {
    In(PathBuf),
    /// The linker found a way to the panic handler; what it said.
    Panics(String),
}

/// Builds images with some features into their own folder of `bench/firmware/target`.
pub fn build(images: &[&str], core: Core, profile: &str, features: &str) -> Result<Built, Failure> {
    let folder = firmware().join("target").join(core.name());
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command
        .args(["build", "--locked", "--quiet", "--profile", profile])
        .args(["--features", features])
        .arg("--target-dir")
        .arg(&folder)
        .current_dir(firmware())
        // The firmware's own flags count, not those of whoever runs this program.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    if core != Core::M4 {
        // After the flags of the firmware's own configuration, of which the last one counts.
        command.arg("--config").arg(format!(
            "target.{TARGET}.rustflags=[\"-C\",\"target-cpu={}\"]",
            core.name()
        ));
    }
    for image in images {
        command.args(["--bin", image]);
    }
    let output = output(&mut command, "cargo")?;
    if output.status.success() {
        let profile = if profile == "dev" { "debug" } else { profile };
        return Ok(Built::In(folder.join(TARGET).join(profile)));
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if said.contains("a_panic_path_is_left") {
        Ok(Built::Panics(said))
    } else {
        Err(Failure::Data(format!(
            "the firmware does not build:\n{said}"
        )))
    }
}

fn output(command: &mut Command, name: &str) -> Result<Output, Failure> {
    command
        .stdin(Stdio::null())
        .output()
        .map_err(|error| Failure::Data(format!("cannot run {name}: {error}")))
}

/// What a program printed, and whether it passed.
pub struct Run {
    pub output: Vec<u8>,
    pub passed: bool,
}

impl Run {
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.output).into_owned()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Core {
    /// Cortex-M4F of Arm's MPS2 with AN386.
    M4,
    /// Cortex-M7 of Arm's MPS2 with AN500.
    M7,
}

impl Core {
    pub const fn name(self) -> &'static str {
        match self {
            Self::M4 => "cortex-m4",
            Self::M7 => "cortex-m7",
        }
    }

    const fn machine(self) -> &'static str {
        match self {
            Self::M4 => "mps2-an386",
            Self::M7 => "mps2-an500",
        }
    }

    fn emulator(self, image: &Path) -> Command {
        let mut command = Command::new(QEMU);
        command
            .args(["-machine", self.machine(), "-nographic", "-monitor", "none"])
            .args(["-serial", "none", "-icount", "shift=0"])
            .args(["-semihosting-config", "enable=on,target=native"])
            .arg("-kernel")
            .arg(image)
            .stdin(Stdio::null());
        command
    }

    pub fn run(self, image: &Path) -> Result<Run, Failure> {
        let mut command = self.emulator(image);
        command.stdout(Stdio::piped()).stderr(Stdio::inherit());
        let (passed, output) = watched(command, |child| {
            let mut bytes = Vec::new();
            if let Some(mut stream) = child.stdout.take() {
                stream.read_to_end(&mut bytes)?;
            }
            Ok(bytes)
        })?;
        Ok(Run { output, passed })
    }

    /// Runs an image with every instruction logged from the address `from` on, and counts calls of the functions at some addresses.
    pub fn count(
        self,
        image: &Path,
        from: u32,
        addresses: &[u32],
        watches: Vec<Watch>,
    ) -> Result<Counts, Failure> {
        let mut command = self.emulator(image);
        if version()? < (8, 1) {
            command.arg("-singlestep");
        } else {
            command.args(["-accel", "tcg,one-insn-per-tb=on"]);
        }
        command
            .args(["-d", "nochain,in_asm", "-gdb", "stdio", "-S"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let counter = Counter::new(addresses, watches);
        let (passed, counts) = watched(command, |child| {
            let (Some(to), Some(answers), Some(log)) =
                (child.stdin.take(), child.stdout.take(), child.stderr.take())
            else {
                return Ok(Counts::default());
            };
            thread::scope(|scope| {
                let debugging = scope.spawn(|| log_from(Debugger::new(to, answers), from));
                let counts = counter.read(BufReader::with_capacity(1 << 20, log));
                debugging
                    .join()
                    .map_err(|_| Error::other("a debugger ended"))??;
                counts
            })
        })?;
        if passed {
            Ok(counts)
        } else {
            Err(Failure::Data(format!(
                "{} failed under the trace",
                image.display()
            )))
        }
    }
}

/// Lets an emulator run to an address, and from there on log what it executes: start-up takes twenty times as many instructions as
/// what is counted.
fn log_from(mut debugger: Debugger<impl Write, impl Read>, from: u32) -> std::io::Result<()> {
    debugger.run_to(from)?;
    debugger.monitor("log exec,nochain,in_asm")?;
    debugger.detach()
}

/// QEMU's version.
fn version() -> Result<(u32, u32), Failure> {
    let output = output(Command::new(QEMU).arg("--version"), QEMU)?;
    let text = String::from_utf8_lossy(&output.stdout);
    text.split_whitespace()
        .find_map(|word| {
            let mut numbers = word.split('.').map(str::parse::<u32>);
            Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
        })
        .ok_or_else(|| Failure::Data(format!("{QEMU} does not tell its version")))
}

/// Runs a program while `read` reads its output; ends it when it hangs.
fn watched<T: Send>(
    mut command: Command,
    read: impl FnOnce(&mut Child) -> std::io::Result<T> + Send,
) -> Result<(bool, T), Failure> {
    let failure = |error: std::io::Error| Failure::Data(format!("cannot run {QEMU}: {error}"));
    let mut child = command.spawn().map_err(failure)?;
    let id = child.id();
    let (done, wait) = channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if wait.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                // The child is waited for by the other thread, so the number is still its own.
                let _ = Command::new("kill").arg(id.to_string()).status();
            }
        });
        let result = read(&mut child);
        let status = child.wait().map_err(failure);
        drop(done);
        let status = status?;
        Ok((status.success(), result.map_err(failure)?))
    })
}
