//! The folder of a report: whether it can be written to, and what stands there.

use std::fs;
use std::path::Path;

use tempfile::tempfile_in;

use epas_page::failure::Failure;
use epas_page::folder::refuse_way;

/// First letters of a report as Markdown.
const OURS: &str = "# epas-friction: ";

/// Fails where the folder cannot be made or written to, or where another's `report.md` stands. Leaves nothing.
pub fn check(folder: &Path, force: bool) -> Result<(), Failure> {
    refuse_way(folder)?;
    let refused = |error: std::io::Error| Failure::file("write", folder, &error);
    // What is there of the way to the folder has to take a file.
    let there = folder
        .ancestors()
        .find(|part| part.as_os_str().is_empty() || part.exists())
        .filter(|part| !part.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    tempfile_in(there).map_err(refused)?;
    let markdown = folder.join("report.md");
    let ours = match fs::read(&markdown) {
        Ok(bytes) => bytes.starts_with(OURS.as_bytes()),
        // Without the Markdown a page that stands there is no report of this program.
        Err(_) => !markdown.exists() && !folder.join("report.html").exists(),
    };
    if ours || force {
        return Ok(());
    }
    Err(Failure::Data(format!(
        "{} holds a report.md or report.html that this program did not write; --force replaces it",
        folder.display()
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_of_another_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        assert!(check(&path.join("new"), false).is_ok());
        assert!(check(&path.join("new/one"), false).is_err());
        fs::write(path.join("report.md"), "# Minutes of Monday\n").unwrap();
        assert!(check(path, false).is_err());
        assert!(check(path, true).is_ok());
        fs::write(path.join("report.md"), format!("{OURS}x\n")).unwrap();
        assert!(check(path, false).is_ok());
        fs::remove_file(path.join("report.md")).unwrap();
        fs::write(path.join("report.html"), "mine").unwrap();
        assert!(check(path, false).is_err());
    }
}
