//! What is wrong with the first line of a table, in words that say what to do.

use csv::StringRecord;

use crate::units::{cut, heading};

/// Refuses columns that are not separated by what separates them in tables that are read.
pub fn separated(header: &StringRecord) -> Result<(), String> {
    let joined: Vec<&str> = header.iter().collect();
    let separator = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars")]
        .into_iter()
        .find(|(letter, _)| joined.iter().any(|name| name.contains(*letter)));
    let known = |name: &&str| matches!(heading(name), Ok(Some(_)));
    let spaces = joined.len() == 1 && joined[0].split_whitespace().filter(known).count() > 1;
    let separator = separator.or(spaces.then_some((' ', "spaces")));
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

pub fn no_number(text: &[u8]) -> &'static str {
    let only = |letters: &[u8]| {
        text.iter()
            .all(|letter| letter.is_ascii_digit() || letters.contains(letter))
    };
    if text.contains(&b',') && only(b",-+eE") {
        "is not a number: a decimal point is needed in place of the comma"
    } else if text.contains(&b',') && only(b",.-+eE") {
        "is not a number: no commas between thousands"
    } else if String::from_utf8_lossy(text).contains(char::is_whitespace)
        && only(b" ,.-+eE\xc2\xa0\xe2\x80\xaf")
    {
        "is not a number: no spaces between thousands"
    } else if text.starts_with("\u{2212}".as_bytes()) {
        "is not a number: a hyphen is needed in place of the minus sign"
    } else if text.first().is_some_and(u8::is_ascii_digit)
        && text.iter().any(|letter| b":-".contains(letter))
        && only(b"-:.TZ +")
    {
        "is not a number: a date or a clock's time; seconds are needed"
    } else {
        "is not a number"
    }
}

#[cfg(test)]
mod tests {
    use super::no_number;

    /// What a spreadsheet writes is named; what is not a number at all is not guessed at.
    #[test]
    fn what_is_no_number_says_what_is_needed() {
        for (text, words) in [
            ("1,5", "decimal point"),
            ("1,000.0", "no commas between thousands"),
            ("-1 000.5", "no spaces between thousands"),
            ("1\u{202f}000,5", "no spaces between thousands"),
            ("\u{2212}50", "in place of the minus sign"),
            ("2026-01-01T00:00:00", "seconds are needed"),
            ("12:30:01.5", "seconds are needed"),
        ] {
            let said = no_number(text.as_bytes());
            assert!(said.contains(words), "{text}: {said}");
        }
        for text in ["-", "", "abc", "1e5x", "--5"] {
            assert_eq!(no_number(text.as_bytes()), "is not a number");
        }
    }
}
