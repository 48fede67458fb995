//! When, where and with what a report was made.

use std::fs;
use std::process::Command;
use std::time::SystemTime;

/// The lines below the heading.
pub fn lines(rounds: usize) -> Vec<String> {
    vec![
        format!(
            "Made on {} by epas-bench {}, built by {}.",
            humantime::format_rfc3339_seconds(SystemTime::now()),
            env!("CARGO_PKG_VERSION"),
            env!("COMPILER"),
        ),
        format!(
            "Times are of {}, {} threads, {}; {rounds} rounds. Cycles are of a Cortex-M4F.",
            processor(),
            std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            std::env::consts::OS,
        ),
    ]
}

/// Name of this machine's processor, as its system says it.
fn processor() -> String {
    let of_linux = || {
        let text = fs::read_to_string("/proc/cpuinfo").ok()?;
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let of_macos = || {
        let output = Command::new("sysctl")
            .args(["-n", "machdep.cpu.brand_string"])
            .output()
            .ok()?;
        let name = String::from_utf8(output.stdout).ok()?.trim().to_owned();
        (!name.is_empty()).then_some(name)
    };
    of_linux()
        .or_else(of_macos)
        .unwrap_or_else(|| format!("an unnamed {} processor", std::env::consts::ARCH))
}
