//! Where a trace comes from: a table or a measurement file, or either on standard input.

use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

use crate::mdf4;
use epas_page::failure::Failure;
use epas_page::files::{Bounded, standard};

/// Where a trace comes from: a file, or standard input where the path is `-`.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a>(pub &'a Path);

/// An input that can be read from its start again.
pub struct Input {
    bytes: Box<dyn ReadSeek>,
    /// Whether it is a measurement file, by its ending or its first bytes.
    pub measurement: bool,
}

trait ReadSeek: Read + Seek {}
impl<T: Read + Seek> ReadSeek for T {}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.bytes.read(buffer)
    }
}

impl Seek for Input {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.bytes.seek(position)
    }
}

impl Source<'_> {
    /// Opens it; of standard input, everything is read.
    pub fn open(&self, largest: u64) -> Result<Input, Failure> {
        if standard(self.0) {
            let mut bytes = Vec::new();
            let mut input = Bounded::new(io::stdin().lock(), largest);
            input
                .read_to_end(&mut bytes)
                .map_err(|error| Failure::file("read", self.0, &error).of("standard input"))?;
            return Ok(Input {
                measurement: mdf4::starts(&bytes),
                bytes: Box::new(Cursor::new(bytes)),
            });
        }
        let file = File::open(self.0).map_err(|error| Failure::file("open", self.0, &error))?;
        // What is no file, a pipe or a device, does not say its size and may never end; it cannot be read again either.
        let ordinary = file.metadata().is_ok_and(|data| data.is_file());
        let mut measurement = mdf4::named(self.0);
        let mut file = Bounded::new(file, largest);
        if ordinary && !measurement {
            let mut start = Vec::new();
            let failure = |error: io::Error| Failure::file("read", self.0, &error);
            file.by_ref()
                .take(8)
                .read_to_end(&mut start)
                .map_err(failure)?;
            measurement = mdf4::starts(&start);
            file.seek(SeekFrom::Start(0)).map_err(failure)?;
        }
        Ok(Input {
            bytes: Box::new(file),
            measurement,
        })
    }

    /// Name of what it holds: the file's without its ending.
    pub fn name(&self) -> String {
        if standard(self.0) {
            return "standard-input".into();
        }
        self.0
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    }

    /// How messages name it.
    pub fn shown(&self) -> String {
        if standard(self.0) {
            "standard input".into()
        } else {
            self.0.display().to_string()
        }
    }

    /// A table has columns, which no mapping names.
    pub fn without_channels(&self, channels: Option<&mdf4::Mapping>) -> Result<(), Failure> {
        match channels {
            Some(_) => Err(Failure::Data(format!(
                "{} is a table: --channels is for measurement files (.mf4)",
                self.shown()
            ))),
            None => Ok(()),
        }
    }
}
