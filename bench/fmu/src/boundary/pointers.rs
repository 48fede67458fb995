//! Pointers that come in.

use std::ffi::{CStr, c_char, c_void};
use std::path::PathBuf;
use std::ptr;
use std::slice;

use percent_encoding::percent_decode_str;

/// A text, where there is one; what is no UTF-8 is replaced.
pub unsafe fn text(pointer: *const c_char, name: &str) -> Result<String, String> {
    if pointer.is_null() {
        return Err(format!("{name} is NULL"));
    }
    // SAFETY: not NULL; that it ends is the caller's.
    let text = unsafe { CStr::from_ptr(pointer) };
    Ok(text.to_string_lossy().into_owned())
}

/// An array to read, empty where its length is 0.
pub unsafe fn array<'a, T>(
    pointer: *const T,
    length: usize,
    name: &str,
) -> Result<&'a [T], String> {
    if length == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(format!("{name} is NULL"));
    }
    if !pointer.is_aligned() {
        return Err(format!("{name} is not aligned"));
    }
    // SAFETY: not NULL and aligned; its length is the caller's.
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// An array to write, empty where its length is 0.
pub unsafe fn array_mut<'a, T>(
    pointer: *mut T,
    length: usize,
    name: &str,
) -> Result<&'a mut [T], String> {
    if length == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() {
        return Err(format!("{name} is NULL"));
    }
    if !pointer.is_aligned() {
        return Err(format!("{name} is not aligned"));
    }
    // SAFETY: not NULL and aligned; its length, and that nobody else uses it, is the caller's.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, length) })
}

/// One object to write.
pub unsafe fn place<'a, T>(pointer: *mut T, name: &str) -> Result<&'a mut T, String> {
    // SAFETY: as of an array of one.
    let places = unsafe { array_mut(pointer, 1, name) }?;
    places.first_mut().ok_or_else(|| format!("{name} is NULL"))
}

/// A handle as the pointer that a caller keeps.
pub fn pointer(handle: usize) -> *mut c_void {
    ptr::without_provenance_mut(handle)
}

/// Folder of a location: a URI of a file (`file:///path`, `file://localhost/path`, and `file:/path`, which the standard allows beside
/// them), or a path.
pub fn folder(location: &str) -> Result<PathBuf, String> {
    let Some(rest) = location.strip_prefix("file:") else {
        return Ok(PathBuf::from(location));
    };
    let bad = || format!("the location of the resources is no file: {location}");
    let path = rest.strip_prefix("//").map_or(rest, |after| {
        after.strip_prefix("localhost").unwrap_or(after)
    });
    // What does not begin here is another machine's, or relative to nothing.
    if !path.starts_with('/') {
        return Err(bad());
    }
    // `/C:/path` is `C:/path`.
    let path = if cfg!(windows) { &path[1..] } else { path };
    let path = percent_decode_str(path).decode_utf8().map_err(|_| bad())?;
    Ok(PathBuf::from(path.as_ref()))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::folder;

    #[test]
    fn every_form_of_a_location_is_one_folder() {
        for location in [
            "file:///unit/my%20resources",
            "file://localhost/unit/my%20resources",
            "file:/unit/my%20resources",
            // As importers write it that do not encode.
            "file:///unit/my resources",
        ] {
            let expected = Path::new(if cfg!(windows) { "unit" } else { "/unit" });
            assert_eq!(
                folder(location).unwrap(),
                expected.join("my resources"),
                "{location}"
            );
        }
        assert_eq!(
            folder("unit/resources").unwrap(),
            Path::new("unit/resources")
        );
        assert_eq!(folder("").unwrap(), Path::new(""));
    }

    #[test]
    fn a_location_that_is_no_file_of_this_machine_is_refused() {
        for location in [
            "file://elsewhere/unit",
            "file://localhostile/unit",
            "file:unit",
            "file://",
            "file:",
            "file:///unit%FF",
        ] {
            let refused = folder(location).unwrap_err();
            assert!(refused.contains(location), "{refused}");
        }
    }
}
