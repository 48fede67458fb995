//! What is wrong with the first line of a table, in words that say what to do.

use csv::StringRecord;

use crate::units::cut;

/// Refuses columns that are not separated by what separates them in tables that are read.
///
/// # Errors
/// What separates them, and what to do.
pub fn separated(header: &StringRecord) -> Result<(), String> {
    let joined: Vec<&str> = header.iter().collect();
    let separator = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars")]
        .into_iter()
        .find(|(letter, _)| joined.iter().any(|name| name.contains(*letter)));
    let Some((_, name)) = separator else {
        return Ok(());
    };
    let line = cut(&joined.join(","));
    let shown = line.escape_debug();
    Err(format!(
        "here stands \"{shown}\": the columns are separated by {name}, and no line has the names of a time and of another column that is known; columns are separated by commas, semicolons or tabs"
    ))
}

/// A column that is missing, and those that there are.
pub fn missing(column: &str, header: &StringRecord) -> String {
    const SHOWN: usize = 12;
    let mut names: Vec<String> = header
        .iter()
        .map(|name| cut(name.trim_start_matches('\u{feff}')))
        .collect();
    let more = if names.len() > SHOWN { ", ..." } else { "" };
    names.truncate(SHOWN);
    format!(
        "column {column} is missing; the first line has {}{more}",
        names.join(", ")
    )
}

/// Why a text is no number.
pub fn no_number(text: &[u8]) -> &'static str {
    let decimal = |letter: &u8| letter.is_ascii_digit() || b",-+eE".contains(letter);
    if text.contains(&b',') && text.iter().all(decimal) {
        "is no number: a decimal point is needed in place of the comma"
    } else {
        "is no number"
    }
}
