//! Files that are written whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::failure::Failure;

/// What happens to a file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It stays, and the run fails.
    Keep,
    /// It is replaced.
    Replace,
}

impl Existing {
    /// With `--force` or without.
    #[must_use]
    pub const fn forced(force: bool) -> Self {
        if force { Self::Replace } else { Self::Keep }
    }

    /// Fails before any work is done where a folder is missing, or something would be in the way: any file, or with
    /// [`Existing::Replace`] what is none, such as a device or a pipe.
    pub fn check(self, path: &Path) -> Result<(), Failure> {
        if standard(path) {
            return Ok(());
        }
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Err(no_folder(path, folder));
        }
        // A link counts as its target, or as itself where the target is missing.
        let there = fs::metadata(path).or_else(|_| fs::symlink_metadata(path));
        match (self, there) {
            (Self::Keep, Ok(_)) => return Err(in_the_way(path)),
            (Self::Replace, Ok(there)) if !there.is_file() && !there.is_symlink() => {
                return Err(Failure::Data(format!(
                    "{} is no ordinary file: it stays",
                    path.display()
                )));
            }
            _ => {}
        }
        // What cannot be written is told before the work and not after it.
        tempfile::tempfile_in(self::folder(path))
            .map_err(|error| Failure::file("write", path, &error))?;
        Ok(())
    }
}

fn no_folder(path: &Path, folder: &Path) -> Failure {
    Failure::Data(format!(
        "cannot write {}: the folder {} is missing; mkdir -p makes it",
        path.display(),
        folder.display()
    ))
}

fn in_the_way(path: &Path) -> Failure {
    Failure::Data(format!("{} exists; --force replaces it", path.display()))
}

/// Prefix of a complete file that waits for its name, and letters behind it.
const PREFIX: &str = ".epas-";
const LETTERS: usize = 6;

/// A file without a name, in the folder of its final place: it gets its name when it is complete, and is gone however the run ends before.
/// What is for standard output waits among the system's temporary files.
pub struct Pending {
    path: PathBuf,
    existing: Existing,
    writer: BufWriter<File>,
}

impl Pending {
    /// A file that will stand at `path`, in a folder that is there.
    pub fn new(path: &Path, existing: Existing) -> Result<Self, Failure> {
        let failure = |error: io::Error| Failure::file("write", path, &error);
        let file = if standard(path) {
            tempfile::tempfile()
        } else {
            let folder = folder(path);
            if !folder.is_dir() {
                return Err(no_folder(path, folder));
            }
            #[cfg(unix)]
            sweep(folder);
            tempfile::tempfile_in(folder)
        };
        Ok(Self {
            path: path.into(),
            existing,
            writer: BufWriter::new(file.map_err(failure)?),
        })
    }

    /// Where to write.
    pub fn writer(&mut self) -> &mut (impl Write + Seek + use<>) {
        &mut self.writer
    }

    /// Puts the file in its place.
    pub fn finish(self) -> Result<(), Failure> {
        let Self {
            path,
            existing,
            writer,
        } = self;
        let mut complete = writer
            .into_inner()
            .map_err(|error| Failure::file("write", &path, error.error()))?;
        if standard(&path) {
            complete.rewind()?;
            io::copy(&mut complete, &mut io::stdout().lock())?;
            return Ok(());
        }
        let file = named(folder(&path), &mut complete)
            .map_err(|error| Failure::file("write", &path, &error))?;
        let placed = match existing {
            Existing::Replace => file.persist(&path),
            Existing::Keep => file.persist_noclobber(&path),
        };
        match placed {
            Ok(_) => Ok(()),
            Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
                Err(in_the_way(&path))
            }
            Err(error) => Err(Failure::file("write", &path, &error.error)),
        }
    }
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A complete file under a temporary name, deleted when dropped: the file itself where the system can link it, else a copy. Its lock says that
/// its run goes on.
fn named(folder: &Path, complete: &mut File) -> io::Result<NamedTempFile<File>> {
    lock(complete);
    Builder::new()
        .prefix(PREFIX)
        .rand_bytes(LETTERS)
        .make_in(folder, |path| match linked(complete, path) {
            Ok(()) => complete.try_clone(),
            Err(_) => copied(complete, path),
        })
}

#[cfg(target_os = "linux")]
fn linked(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let own = format!("/proc/self/fd/{}", file.as_raw_fd());
    Ok(linkat(CWD, own, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn linked(_: &File, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

fn copied(complete: &mut File, path: &Path) -> io::Result<File> {
    let mut copy = File::options().write(true).create_new(true).open(path)?;
    lock(&copy);
    // Another run may have swept it away before it was locked: another name, then.
    if !path.exists() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    let written = complete
        .rewind()
        .and_then(|()| io::copy(complete, &mut copy));
    if let Err(error) = written {
        // Nobody else deletes it while it is locked.
        fs::remove_file(path)?;
        return Err(error);
    }
    Ok(copy)
}

/// Locks a file until it is closed; where a file system has no locks, nothing is swept.
#[cfg(unix)]
fn lock(file: &File) {
    use rustix::fs::{FlockOperation, flock};
    flock(file, FlockOperation::LockExclusive).unwrap_or_default();
}

#[cfg(not(unix))]
fn lock(_: &File) {}

/// Deletes what a run that was killed has left in a folder: files under a temporary name that no run has locked.
#[cfg(unix)]
fn sweep(folder: &Path) {
    use rustix::fs::{FlockOperation, flock};
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let ours = name
            .to_str()
            .and_then(|name| name.strip_prefix(PREFIX))
            .is_some_and(|rest| {
                rest.len() == LETTERS && rest.bytes().all(|byte| byte.is_ascii_alphanumeric())
            });
        // Neither a link nor a pipe is opened.
        if !ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let Ok(file) = File::open(entry.path()) else {
            continue;
        };
        if flock(&file, FlockOperation::NonBlockingLockExclusive).is_ok() {
            // What another run has swept meanwhile is gone as well.
            fs::remove_file(entry.path()).unwrap_or_default();
        }
    }
}

/// Writes the whole text of a file that is pending.
pub fn all(pending: &mut Pending, path: &Path, contents: &str) -> Result<(), Failure> {
    pending
        .writer()
        .write_all(contents.as_bytes())
        .map_err(|error| Failure::file("write", path, &error))
}

/// Writes a whole file.
pub fn write(path: &Path, contents: &str, existing: Existing) -> Result<(), Failure> {
    let mut pending = Pending::new(path, existing)?;
    all(&mut pending, path, contents)?;
    pending.finish()
}

/// Fails where an output is an input, or another output: inputs are never overwritten.
pub fn refuse_same<'a, 'b>(
    inputs: impl IntoIterator<Item = Option<&'b Path>>,
    outputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    // What comes from standard input is not what goes to standard output.
    let inputs = inputs.into_iter().flatten();
    let mut taken: Vec<PathBuf> = inputs.filter(|path| !standard(path)).map(place).collect();
    for output in outputs {
        let place = place(output);
        if taken.contains(&place) {
            return Err(Failure::Data(format!(
                "{} is named twice",
                output.display()
            )));
        }
        taken.push(place);
    }
    Ok(())
}

/// Endings that say what a file holds, without regard to case.
const KNOWN: [&str; 24] = [
    "a2l", "bin", "bmp", "csv", "fmu", "gif", "h", "htm", "html", "jpeg", "jpg", "json", "mat",
    "md", "mf4", "ods", "parquet", "pdf", "png", "rs", "svg", "toml", "xls", "xlsx",
];

/// Whether a file has one of these endings, in whatever case.
pub fn ends(path: &Path, endings: &[&str]) -> bool {
    path.extension()
        .is_some_and(|own| endings.iter().any(|one| own.eq_ignore_ascii_case(one)))
}

/// Fails where an output's ending says that it holds something else than it will.
pub fn refuse_ending(what: &str, path: Option<&Path>, endings: &[&str]) -> Result<(), Failure> {
    match path {
        Some(path) if ends(path, &KNOWN) && !ends(path, endings) => {
            let written: Vec<String> = endings.iter().map(|one| format!(".{one}")).collect();
            Err(Failure::Data(format!(
                "{}: {what} ends in {}",
                path.display(),
                written.join(" or ")
            )))
        }
        _ => Ok(()),
    }
}

/// Where a file is or will be, under one name however it is spelled.
fn place(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
        match (absolute.parent().map(fs::canonicalize), path.file_name()) {
            (Some(Ok(folder)), Some(name)) => folder.join(name),
            _ => absolute,
        }
    })
}

/// Whether a path stands for standard input or output.
pub fn standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Fails where several inputs are standard input, which can be read once.
pub fn refuse_shared<const N: usize>(inputs: [Option<&Path>; N]) -> Result<(), Failure> {
    let asked = inputs.into_iter().flatten().filter(|path| standard(path));
    if asked.count() > 1 {
        return Err(Failure::Data(
            "two inputs are -, but standard input can be read once".into(),
        ));
    }
    Ok(())
}

/// Where a run tells what it found: beside standard output where that is one of the outputs.
pub fn told<'a>(mut outputs: impl Iterator<Item = &'a PathBuf>) -> Box<dyn Write> {
    if outputs.any(|path| standard(path)) {
        Box::new(io::stderr())
    } else {
        Box::new(io::stdout())
    }
}

/// An input that ends with an error where it is longer than it may be.
pub struct Bounded<R> {
    input: R,
    largest: u64,
    left: u64,
}

impl<R> Bounded<R> {
    /// At most `largest` bytes of `input`.
    pub const fn new(input: R, largest: u64) -> Self {
        Self {
            input,
            largest,
            left: largest,
        }
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(buffer)?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(|| {
            let largest = self.largest;
            io::Error::new(
                io::ErrorKind::FileTooLarge,
                format!("it has more than {largest} bytes"),
            )
        })?;
        Ok(read)
    }
}

impl<R: Seek> Seek for Bounded<R> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.left = self.largest;
        self.input.seek(position)
    }
}

/// The text of a file, or of standard input, of at most `largest` bytes.
pub fn read_text(path: &Path, largest: u64) -> Result<String, Failure> {
    let input: Box<dyn Read> = if standard(path) {
        Box::new(io::stdin())
    } else {
        Box::new(File::open(path).map_err(|error| Failure::file("open", path, &error))?)
    };
    let mut text = String::new();
    Bounded::new(input, largest)
        .read_to_string(&mut text)
        .map_err(|error| match error.kind() {
            io::ErrorKind::InvalidData => Failure::Data(format!(
                "{}: this is not UTF-8; save the file as UTF-8 (> in a PowerShell writes UTF-16)",
                path.display()
            )),
            _ => Failure::file("read", path, &error),
        })?;
    Ok(text)
}

/// Line of the record that starts at this byte of an input, where a CSV reader says that it starts at `line`: the reader
/// counts blank lines before a record as part of it.
pub fn line_of(mut input: impl Read + Seek, byte: u64, line: u64) -> u64 {
    let mut blank_lines = || -> io::Result<u64> {
        input.seek(SeekFrom::Start(byte))?;
        let mut input = BufReader::new(&mut input);
        let mut count = 0;
        loop {
            match input.fill_buf()?.first() {
                Some(b'\n') => count += 1,
                Some(b'\r') => {}
                _ => return Ok(count),
            }
            input.consume(1);
        }
    };
    // Where the input cannot be read again, the line is that of the blank lines.
    line + blank_lines().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// However a run ends before its output is complete, nothing of it stays: the file has no name till then.
    #[test]
    fn an_output_that_is_not_complete_has_no_name() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a.csv");
        let mut pending = Pending::new(&path, Existing::Keep).unwrap();
        all(&mut pending, &path, "one").unwrap();
        pending.writer().flush().unwrap();
        #[cfg(unix)]
        assert!(names(place.path()).is_empty());
        pending.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "one");
        // What appears meanwhile stays, and nothing beside it.
        fs::remove_file(&path).unwrap();
        let mut pending = Pending::new(&path, Existing::Keep).unwrap();
        all(&mut pending, &path, "two").unwrap();
        fs::write(&path, "theirs").unwrap();
        assert!(pending.finish().is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "theirs");
        write(&path, "three", Existing::Replace).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "three");
        assert_eq!(names(place.path()), ["a.csv"]);
    }

    /// An output is an ordinary file: whoever may read another one may read it.
    #[cfg(unix)]
    #[test]
    fn an_output_has_the_permissions_of_any_file() {
        use std::os::unix::fs::PermissionsExt;
        let place = tempfile::tempdir().unwrap();
        let [ours, any] = ["a.csv", "b.csv"].map(|name| place.path().join(name));
        write(&ours, "", Existing::Keep).unwrap();
        fs::write(&any, "").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&any));
    }

    /// A folder in which nothing can be written is told before any work is done, without the name of another file.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_takes_no_file_is_told_first() {
        let refused = Existing::Keep.check(Path::new("/proc/a.csv"));
        let message = format!("{:?}", refused.unwrap_err());
        assert!(
            message.contains("/proc/a.csv") && !message.contains(".tmp"),
            "{message}"
        );
    }

    /// Where a file cannot be linked, a whole copy takes its place.
    #[test]
    fn a_copy_is_whole() {
        let place = tempfile::tempdir().unwrap();
        let mut complete = tempfile::tempfile().unwrap();
        complete.write_all(b"whole").unwrap();
        let path = place.path().join(".epas-aaaaaa");
        copied(&mut complete, &path).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "whole");
        let refused = copied(&mut complete, &path).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::AlreadyExists);
    }

    /// What a killed run has left goes; what a run has locked, and what is the user's, stays.
    #[cfg(unix)]
    #[test]
    fn the_next_run_sweeps_what_a_killed_one_left() {
        let place = tempfile::tempdir().unwrap();
        let path = |name: &str| place.path().join(name);
        let stay = [
            ".epas-bbbbbb",
            ".epas-friction",
            ".epas-folder",
            ".epas-a.csv",
        ];
        for name in [
            ".epas-aaaaaa",
            ".epas-bbbbbb",
            ".epas-friction",
            ".epas-a.csv",
        ] {
            fs::write(path(name), "").unwrap();
        }
        fs::create_dir(path(".epas-folder")).unwrap();
        let running = File::open(path(".epas-bbbbbb")).unwrap();
        lock(&running);
        let pending = Pending::new(&path("out.csv"), Existing::Keep).unwrap();
        let mut expected = stay.map(String::from);
        expected.sort();
        assert_eq!(names(place.path()), expected);
        drop(running);
        pending.finish().unwrap();
        write(&path("next.csv"), "", Existing::Keep).unwrap();
        assert!(!path(".epas-bbbbbb").exists());
    }
}
