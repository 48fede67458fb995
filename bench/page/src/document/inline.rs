//! Paragraphs: lines, and code between back-quotes.

/// The text in lines that a terminal holds; lines of it stay lines, and those that start with two spaces stay as they are.
pub fn wrapped(text: &str) -> String {
    text.lines()
        .map(|line| {
            if line.starts_with("  ") {
                line.into()
            } else {
                wrapped_line(line)
            }
        })
        .collect::<Vec<_>>()
        .join("\n")
}

fn wrapped_line(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines.join("\n")
}

/// The text for Markdown, where a line ends with two spaces and a command stands between back-quotes.
pub fn markdown(text: &str) -> String {
    text.lines()
        .map(|line| match line.strip_prefix("  ") {
            Some(command) => format!("`{}`", command.trim()),
            None => line.into(),
        })
        .collect::<Vec<_>>()
        .join("  \n")
}

pub fn html(text: &str) -> String {
    let lines: Vec<String> = text
        .lines()
        .map(|line| match line.strip_prefix("  ") {
            Some(command) => format!("<code>{}</code>", escaped(command.trim())),
            None => with_code(line),
        })
        .collect();
    lines.join("<br>\n")
}

/// A line whose pieces between back-quotes are code; an odd one out stays as it is.
pub fn with_code(line: &str) -> String {
    let pieces: Vec<&str> = line.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return escaped(line);
    }
    pieces
        .iter()
        .enumerate()
        .map(|(index, piece)| {
            if index % 2 == 1 {
                format!("<code>{}</code>", escaped(piece))
            } else {
                escaped(piece)
            }
        })
        .collect()
}

/// The text with what means something to HTML written out.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stay_lines_and_code_is_code() {
        let text = "It says `a < b`:\n  apt-get install x\nand goes on";
        assert_eq!(
            html(text),
            "It says <code>a &lt; b</code>:<br>\n<code>apt-get install x</code><br>\nand goes on"
        );
        assert_eq!(wrapped(text), text);
        assert_eq!(with_code("one ` alone"), "one ` alone");
    }
}
