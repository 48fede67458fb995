//! Folders that a run fills: looked at before anything is computed, and the user's own files are left alone.

use std::fs;
use std::io;
use std::path::Path;

use crate::failure::Failure;

/// A file of this name says that the other files of its folder were written by this program.
const MARK: &str = ".epas-friction";

/// Fails where a folder cannot be written, or holds files that this program has not put there: those stay without `force`. Below
/// `target/` are products alone.
pub fn check(folder: &Path, force: bool) -> Result<(), Failure> {
    let failure = |error: io::Error| Failure::file("write", folder, &error);
    if fs::metadata(folder).is_ok_and(|data| !data.is_dir()) {
        return Err(Failure::Data(format!("{} is no folder", folder.display())));
    }
    let mut there = folder;
    while !there.is_dir() {
        there = match there.parent() {
            Some(above) if !above.as_os_str().is_empty() => above,
            _ => Path::new("."),
        };
        if fs::metadata(there).is_ok_and(|data| !data.is_dir()) {
            return Err(Failure::Data(format!("{} is no folder", there.display())));
        }
    }
    refuse_way(folder)?;
    tempfile::tempfile_in(there).map_err(failure)?;
    let ours = force || folder.starts_with("target") || folder.join(MARK).is_file();
    if ours || !folder.is_dir() {
        return Ok(());
    }
    let mut entries = fs::read_dir(folder).map_err(failure)?;
    match entries.next().transpose().map_err(failure)? {
        Some(entry) => Err(Failure::Data(format!(
            "{} holds files that are not of this program, such as {}: name another folder, or --force replaces what has the same name",
            folder.display(),
            entry.file_name().display()
        ))),
        None => Ok(()),
    }
}

/// Fails where a folder would stand in one that is missing: the folder itself is what is asked for, one above it is a mistyped path. Below
/// `target/` every folder is this program's own.
pub fn refuse_way(folder: &Path) -> Result<(), Failure> {
    let above = folder
        .parent()
        .filter(|above| !above.as_os_str().is_empty() && !above.is_dir());
    match above {
        Some(above) if !folder.starts_with("target") => Err(Failure::Data(format!(
            "cannot write {}: the folder {} is missing; mkdir -p makes it",
            folder.display(),
            above.display()
        ))),
        _ => Ok(()),
    }
}

/// Makes a folder, and marks it as filled by this program.
pub fn mark(folder: &Path) -> Result<(), Failure> {
    let failure = |error: io::Error| Failure::file("write", folder, &error);
    fs::create_dir_all(folder).map_err(failure)?;
    fs::write(
        folder.join(MARK),
        "The files of this folder are replaced by the next run of its program that writes here.\n",
    )
    .map_err(failure)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_users_files_stay_and_ours_are_replaced() {
        let place = tempfile::tempdir().unwrap();
        let own = place.path().join("a/b");
        let message = format!("{:?}", check(&own, false).unwrap_err());
        assert!(message.contains("is missing"), "{message}");
        fs::create_dir(place.path().join("a")).unwrap();
        check(&own, false).unwrap();
        mark(&own).unwrap();
        fs::write(own.join("report.md"), "").unwrap();
        check(&own, false).unwrap();
        let message = format!("{:?}", check(place.path(), false).unwrap_err());
        assert!(
            message.contains("such as a") && message.contains("--force"),
            "{message}"
        );
        check(place.path(), true).unwrap();
        for folder in [own.join("report.md"), own.join("report.md/deeper")] {
            let message = format!("{:?}", check(&folder, true).unwrap_err());
            assert!(message.contains("no folder"), "{message}");
        }
        check(Path::new("target/report"), false).unwrap();
    }
}
