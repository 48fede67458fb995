//! The header, as cbindgen makes it.

use std::path::Path;

use crate::outcome::Outcome;

/// The header that belongs to the library's sources.
pub fn generated(root: &Path) -> Outcome<String> {
    let configuration = cbindgen::Config::from_file(root.join("cbindgen.toml"))?;
    let bindings = cbindgen::generate_with_config(root, configuration)
        .map_err(|error| format!("cbindgen: {error}"))?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    Ok(String::from_utf8(text)?)
}
