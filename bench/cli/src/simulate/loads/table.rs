//! A load table as text: of a design file, or of firmware.

use std::fmt::Write as _;

use epas_friction::LoadShare;
use epas_reference::statics::ShareTable;
use epas_reference::statics::cases::ScrewEnd;
use epas_reference::statics::shares::LEAST_SHARE;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// A table [uncaged] of a design file
    #[default]
    Toml,
    /// Constants to paste into firmware
    Rust,
}

const MOST_ENTRIES: usize = 256;

/// A table with the words for its heading.
pub struct Wording {
    pub table: ShareTable,
    /// Its load, N.
    pub load: String,
    pub loaded_end: ScrewEnd,
}

/// The tables that are written: one for both signs of the load, or one for each.
pub enum Tables {
    One(Wording),
    Two(Wording, Wording),
}

pub fn text(
    format: Format,
    name: &str,
    said: &[String],
    tables: &Tables,
) -> Result<String, String> {
    let mark = match format {
        Format::Toml => "# ",
        Format::Rust => "/// ",
    };
    let mut text = String::new();
    let lines = |text: &mut String, mark: &str, lines: &[String]| {
        for line in lines {
            let _ = writeln!(text, "{mark}{line}");
        }
    };
    let named = match tables {
        Tables::One(table) => vec![(table, "load_shares")],
        Tables::Two(positive, negative) => {
            vec![
                (positive, "load_shares"),
                (negative, "negative_load_shares"),
            ]
        }
    };
    // What is said of one table alone belongs to it; of two, it stands before both.
    let alone = named.len() == 1;
    if !alone {
        lines(
            &mut text,
            if format == Format::Rust { "// " } else { mark },
            said,
        );
    }
    for (index, (wording, field)) in named.into_iter().enumerate() {
        let shares = entries(&wording.table)?;
        lines(&mut text, mark, &heading(name, wording, &shares));
        if alone {
            lines(&mut text, mark, said);
        }
        match format {
            Format::Toml => toml(&mut text, index == 0, field, &shares),
            Format::Rust => rust(&mut text, &field.to_uppercase(), &shares),
        }
    }
    Ok(text)
}

fn entries(table: &ShareTable) -> Result<Vec<f32>, String> {
    let positive = table.positive();
    spread(&positive, positive.len().min(MOST_ENTRIES))
        .into_iter()
        .map(|share| {
            LoadShare::new((share as f32).max(LEAST_SHARE as f32))
                .map(|share| share.share())
                .map_err(|error| error.to_string())
        })
        .collect()
}

/// What stands above a table, without the marks of a comment.
fn heading(name: &str, wording: &Wording, shares: &[f32]) -> Vec<String> {
    let (least, most) = shares
        .iter()
        .fold((f32::INFINITY, 0.0_f32), |(least, most), share| {
            (least.min(*share), most.max(*share))
        });
    let table = &wording.table;
    let way = match wording.loaded_end {
        ScrewEnd::Left => "from",
        ScrewEnd::Right => "towards",
    };
    let mut lines = vec![
        format!(
            "Load of each ball of {name} over the mean, under {} N along the axis,",
            wording.load
        ),
        format!("along the loaded track {way} the end where the load acts: the static model of"),
        format!(
            "Lin 2019, chapter 2. {} balls; the largest share is {:.3} of the smallest.",
            table.shares.len(),
            most / least
        ),
    ];
    let idle = table.idle();
    if idle > 0 {
        lines.push(format!(
            "{idle} balls carry nothing or push against the load; they stand with {LEAST_SHARE}, and the \
             mean is kept.",
        ));
    }
    lines
}

fn toml(text: &mut String, first: bool, field: &str, shares: &[f32]) {
    if first {
        text.push_str("[uncaged]\n");
    }
    let _ = writeln!(text, "{field} = [");
    for share in shares {
        let _ = writeln!(text, "    {share:?},");
    }
    text.push_str("]\n");
}

fn rust(text: &mut String, name: &str, shares: &[f32]) {
    let _ = write!(
        text,
        "#[allow(clippy::unreadable_literal, reason = \"written by a program\")]\n\
         pub static {name}: [epas_friction::LoadShare; {}] = {{\n\
         \x20   const fn share(share: f32) -> epas_friction::LoadShare {{\n\
         \x20       match epas_friction::LoadShare::new(share) {{\n\
         \x20           Ok(share) => share,\n\
         \x20           Err(_) => panic!(\"a share is 0.01 to 100\"),\n\
         \x20       }}\n\
         \x20   }}\n\
         \x20   [\n",
        shares.len()
    );
    for share in shares {
        let _ = writeln!(text, "        share({share:?}),");
    }
    text.push_str("    ]\n};\n");
}

/// The mean of a step function over equal steps in each of `count` equal parts.
fn spread(steps: &[f64], count: usize) -> Vec<f64> {
    let per_part = steps.len() as f64 / count as f64;
    (0..count)
        .map(|part| {
            let (start, end) = (part as f64 * per_part, (part + 1) as f64 * per_part);
            let sum: f64 = steps
                .iter()
                .enumerate()
                .skip(start as usize)
                .take(per_part.ceil() as usize + 1)
                .map(|(step, value)| {
                    let step = step as f64;
                    value * (end.min(step + 1.0) - start.max(step)).max(0.0)
                })
                .sum();
            sum / per_part
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn spreading_keeps_the_sum() {
        let steps: Vec<f64> = (0..1000).map(|step| f64::from(step).sin() + 2.0).collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        for count in [1, 3, 256, 999, 1000] {
            let parts = spread(&steps, count);
            assert_eq!(parts.len(), count);
            assert!((mean(&parts) - mean(&steps)).abs() < 1e-12, "{count}");
        }
        assert_eq!(spread(&steps, 1000), steps);
    }
}
