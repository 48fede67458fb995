//! Lines of bounded length.

use std::io::{self, BufRead, BufReader, Read};

/// Longest line that is read, in bytes: far above any request, far below what would fill a memory.
const LONGEST: u64 = 1 << 20;

/// Most bytes that are skipped to the end of a line which is too long: a device may never end one.
const MOST_SKIPPED: u64 = 1 << 30;

/// Byte-order mark of a text in UTF-8.
const MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads lines into one buffer.
pub struct Lines<R> {
    input: BufReader<R>,
    buffer: Vec<u8>,
    first: bool,
}

pub enum Line<'a> {
    /// Nothing but white space.
    Blank,
    Text(&'a str),
    /// Too long or no UTF-8; with what to say about it.
    Unreadable(String),
}

impl<R: Read> Lines<R> {
    pub fn new(input: R) -> Self {
        Self {
            input: BufReader::new(input),
            buffer: Vec::new(),
            first: true,
        }
    }

    /// True where the next line has not arrived whole yet, so that reading it may wait.
    pub fn would_wait(&self) -> bool {
        !self.input.buffer().contains(&b'\n')
    }

    /// The next line, `None` at the end. A line that is too long is skipped to its end.
    pub fn next_line(&mut self) -> io::Result<Option<Line<'_>>> {
        self.buffer.clear();
        let read = (&mut self.input)
            .take(LONGEST)
            .read_until(b'\n', &mut self.buffer)?;
        if read == 0 {
            return Ok(None);
        }
        if read as u64 == LONGEST && !self.buffer.ends_with(b"\n") && !self.skip_line()? {
            return Ok(Some(Line::Unreadable(format!(
                "the line is longer than {LONGEST} bytes"
            ))));
        }
        // An editor may put a byte-order mark before the first line.
        let mark = std::mem::take(&mut self.first) && self.buffer.starts_with(MARK);
        let line = &self.buffer[if mark { MARK.len() } else { 0 }..];
        Ok(Some(match std::str::from_utf8(line) {
            Ok(text) if text.trim_ascii().is_empty() => Line::Blank,
            Ok(text) => Line::Text(text),
            Err(error) => Line::Unreadable(format!("the line is no UTF-8: {error}")),
        }))
    }

    /// Skips to the end of the line; true where it was there already.
    fn skip_line(&mut self) -> io::Result<bool> {
        let mut rest = (&mut self.input).take(MOST_SKIPPED);
        let skipped = rest.skip_until(b'\n')?;
        if rest.limit() == 0 {
            return Err(io::Error::new(
                io::ErrorKind::FileTooLarge,
                format!("a line has more than {MOST_SKIPPED} bytes"),
            ));
        }
        Ok(skipped == 0)
    }
}
