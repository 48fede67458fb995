//! When, where and with what a report was made.

use std::fs;
use std::process::Command;
use std::time::SystemTime;

/// The lines below the heading.
pub fn lines(program: &str, rounds: usize) -> Vec<String> {
    vec![
        format!(
            "Made on {} by {program} {}, built by {}.",
            today(),
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

/// The date in UTC, as year-month-day. Days since 1970 to a date of the Gregorian calendar, counted from March 1 of year 0 so that the leap day ends
/// a year.
fn today() -> String {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    date(since.map_or(0, |since| since.as_secs() / 86_400))
}

fn date(days: u64) -> String {
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = 400 * era + year + u64::from(month < 3);
    format!("{year}-{month:02}-{day:02}")
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

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (19_782, "2024-02-29"),
            (20_453, "2025-12-31"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(date(days), expected);
        }
    }
}
