//! The C firmware: links, holds nothing that it must not hold, and passes in QEMU.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::tools::{Outcome, PANIC, WARNINGS, library, run, run_to_end, symbols};

/// A Cortex-M4 with its floating-point unit, as rustc's thumbv7em-none-eabihf.
const CORE: [&str; 4] = [
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
];

/// QEMU's machines, and where the memory of each is described.
const MACHINES: [(&str, &str); 2] = [
    ("mps2-an386", "../.."),
    ("netduinoplus2", "firmware/stm32f427"),
];

/// What a user links of the library, by its functions.
const PARTS: [(&str, &[&str]); 11] = [
    ("epas_clearance", &["epas_clearance"]),
    ("epas_efficiency", &["epas_efficiency"]),
    ("epas_curvature", &["epas_curvature"]),
    ("epas_caged", &["epas_caged_init", "epas_caged_step"]),
    (
        "epas_caged_range",
        &[
            "epas_caged_range_init",
            "epas_caged_range_step",
            "epas_caged_range_set_friction",
        ],
    ),
    (
        "epas_closed_form",
        &["epas_closed_form_init", "epas_closed_form_step"],
    ),
    (
        "epas_memory",
        &[
            "epas_memory_init",
            "epas_memory_step",
            "epas_memory_between",
        ],
    ),
    ("epas_linear", &["epas_linear_init", "epas_linear_step"]),
    (
        "epas_screw",
        &[
            "epas_folded_ball_init",
            "epas_screw_init",
            "epas_screw_step",
        ],
    ),
    (
        "epas_screw_range",
        &[
            "epas_folded_ball_range_init",
            "epas_screw_range_init",
            "epas_screw_range_step",
            "epas_screw_range_set_friction",
        ],
    ),
    (
        "everything",
        &[
            "epas_abi_version",
            "epas_field_name",
            "epas_status_name",
            "epas_deviation_from_harmonics",
            "epas_deviation_from_samples",
            "epas_load_shares_init",
            "epas_folded_ball_init",
            "epas_folded_ball_range_init",
            "epas_caged_init",
            "epas_caged_step",
            "epas_caged_reset",
            "epas_caged_faulted_ticks",
            "epas_caged_swap",
            "epas_caged_export",
            "epas_caged_import",
            "epas_caged_range_init",
            "epas_caged_range_step",
            "epas_caged_range_reset",
            "epas_caged_range_faulted_ticks",
            "epas_caged_range_swap",
            "epas_caged_range_set_friction",
            "epas_caged_range_export",
            "epas_caged_range_import",
            "epas_closed_form_init",
            "epas_closed_form_step",
            "epas_closed_form_reset",
            "epas_closed_form_faulted_ticks",
            "epas_closed_form_swap",
            "epas_closed_form_export",
            "epas_closed_form_import",
            "epas_memory_init",
            "epas_memory_step",
            "epas_memory_between",
            "epas_memory_set_coefficient",
            "epas_memory_set_level",
            "epas_memory_drag_torque",
            "epas_memory_swap",
            "epas_memory_reset",
            "epas_memory_faulted_ticks",
            "epas_memory_export",
            "epas_memory_import",
            "epas_memory_import_with_count",
            "epas_screw_init",
            "epas_screw_step",
            "epas_screw_set_nut_angle",
            "epas_screw_reset",
            "epas_screw_faulted_ticks",
            "epas_screw_swap",
            "epas_screw_export",
            "epas_screw_import",
            "epas_screw_range_init",
            "epas_screw_range_step",
            "epas_screw_range_set_nut_angle",
            "epas_screw_range_reset",
            "epas_screw_range_faulted_ticks",
            "epas_screw_range_swap",
            "epas_screw_range_set_friction",
            "epas_screw_range_export",
            "epas_screw_range_import",
            "epas_linear_init",
            "epas_linear_step",
            "epas_linear_set_carriage_position",
            "epas_linear_reset",
            "epas_linear_faulted_ticks",
            "epas_linear_set_friction",
            "epas_linear_export",
            "epas_linear_import",
            "epas_adaptation_init",
            "epas_adaptation_update",
            "epas_adaptation_commission",
            "epas_adaptation_reset",
            "epas_adaptation_export",
            "epas_adaptation_import",
            "epas_clearance",
            "epas_efficiency",
            "epas_curvature",
        ],
    ),
];

/// Soft double precision, an allocator, the formatting machinery, panics.
const UNWANTED: [&str; 12] = [
    "__aeabi_d",
    "__aeabi_i2d",
    "__aeabi_ui2d",
    "__aeabi_f2d",
    "__adddf3",
    "__muldf3",
    "__rust_alloc",
    "malloc",
    "core::fmt",
    "core3fmt",
    "panic",
    "rust_eh_personality",
];

/// Builds, checks and runs the firmware on each machine.
pub fn check(root: &Path) -> Outcome<()> {
    let archive = library(root, Some("thumbv7em-none-eabihf"), true)?;
    no_panic_path(&archive)?;
    let out = root.join("target/c");
    fs::create_dir_all(&out)?;
    println!("flash of the library's parts, bytes");
    for (part, functions) in PARTS {
        let image = link_part(&archive, &out, part, functions)?;
        println!("  {part}: {}", flash_alone(&image)?);
    }
    for (machine, memory) in MACHINES {
        let image = firmware(root, &archive, &out, machine, memory)?;
        nothing_unwanted(&image)?;
        println!("on {machine}");
        print!("{}", run_in_qemu(machine, &image)?);
    }
    Ok(())
}

fn no_panic_path(archive: &Path) -> Outcome<()> {
    if symbols("arm-none-eabi-nm", archive)?
        .iter()
        .any(|(name, _)| name == PANIC)
    {
        return Err(format!("{} has a panic path", archive.display()).into());
    }
    Ok(())
}

fn compiler() -> Command {
    let mut command = Command::new("arm-none-eabi-gcc");
    command.args(CORE);
    command
}

/// An image of a few of the library's functions, with what they need and nothing else: no C library, no
/// compiler library.
fn link_part(archive: &Path, out: &Path, part: &str, functions: &[&str]) -> Outcome<PathBuf> {
    let image = out.join(format!("{part}.elf"));
    let mut command = compiler();
    command.args(["-nostdlib", "-Wl,--gc-sections", "-Wl,--entry=0"]);
    for function in functions {
        command.arg(format!("-Wl,--undefined={function}"));
    }
    run(command.arg("-o").arg(&image).arg(archive))?;
    nothing_unwanted(&image)?;
    Ok(image)
}

/// Code and constants, bytes. The library has no data of its own, initialised or not.
pub fn flash_alone(image: &Path) -> Outcome<u32> {
    let listed = run(Command::new("arm-none-eabi-size").arg("-A").arg(image))?;
    let mut flash = 0;
    for line in listed.lines() {
        let mut words = line.split_whitespace();
        let (Some(section), Some(Ok(size))) = (words.next(), words.next().map(str::parse::<u32>))
        else {
            continue;
        };
        match section {
            ".text" | ".rodata" => flash += size,
            ".data" | ".bss" if size > 0 => {
                return Err(format!("{}: {size} bytes of {section}", image.display()).into());
            }
            _ => {}
        }
    }
    Ok(flash)
}

fn firmware(
    root: &Path,
    archive: &Path,
    out: &Path,
    machine: &str,
    memory: &str,
) -> Outcome<PathBuf> {
    let image = out.join(format!("{machine}.elf"));
    let sources = [
        "firmware/startup.c",
        "firmware/semihosting.c",
        "firmware/sys_tick.c",
        "firmware/main.c",
        "test/cases.c",
        "test/setups.c",
        "test/refusals.c",
        "test/changes.c",
        "test/reaction.c",
        // The README's, as the check on the host has written it.
        "target/c/example.c",
    ];
    run(compiler()
        .args(["-std=c99", "-O2", "-ffreestanding", "-nostdlib"])
        .args(["-ffunction-sections", "-fdata-sections"])
        .args(WARNINGS)
        .args(["include", "test", "firmware"].map(|folder| {
            let mut option = std::ffi::OsString::from("-I");
            option.push(root.join(folder));
            option
        }))
        .args(sources.map(|source| root.join(source)))
        .arg(archive)
        .args(["-Wl,--gc-sections", "-Wl,-z,noexecstack", "-L"])
        .arg(root.join(memory))
        .arg("-T")
        .arg(root.join("firmware/link.ld"))
        .arg("-o")
        .arg(&image))?;
    Ok(image)
}

fn nothing_unwanted(image: &Path) -> Outcome<()> {
    for (name, _) in symbols("arm-none-eabi-nm", image)? {
        if UNWANTED.iter().any(|unwanted| name.contains(unwanted)) {
            return Err(format!("{} holds {name}", image.display()).into());
        }
    }
    Ok(())
}

/// What the program says; it ends the machine with its result. Semihosting speaks where errors are printed.
pub fn run_in_qemu(machine: &str, image: &Path) -> Outcome<String> {
    if Command::new("qemu-system-arm")
        .arg("--version")
        .output()
        .is_err()
    {
        return Err(
            "qemu-system-arm is not there. On Debian or Ubuntu: apt-get install \
                    qemu-system-arm. Without it: --host"
                .into(),
        );
    }
    let (_, said) = run_to_end(
        Command::new("timeout")
            .args(["120", "qemu-system-arm", "-machine", machine, "-nographic"])
            .args(["-icount", "shift=0"])
            .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
            .arg(image),
    )?;
    if said.ends_with("passed\n") {
        Ok(said)
    } else {
        Err(format!("{machine} did not come to its end\n{said}").into())
    }
}
