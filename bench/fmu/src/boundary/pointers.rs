//! Pointers that come in.

use std::ffi::{CStr, c_char, c_void};
use std::path::PathBuf;
use std::ptr;
use std::slice;

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

/// Folder of a location: a URI, or a path.
pub fn folder(location: &str) -> Result<PathBuf, String> {
    if !location.starts_with("file:") {
        return Ok(PathBuf::from(location));
    }
    let bad = || format!("the location of the resources is no file: {location}");
    // The standard allows `file:/path` beside `file:///path`.
    let url = url::Url::parse(location).map_err(|_| bad())?;
    url.to_file_path().map_err(|()| bad())
}
