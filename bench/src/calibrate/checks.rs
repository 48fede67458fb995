//! Whether a trace may be believed, and what it cannot tell.

use crate::failure::Failure;

use super::finding::Finding;
use super::signals::Motion;
use super::trace::Trace;

/// What limits what the trace can tell.
///
/// # Errors
/// A trace from which any number would be wrong.
pub fn examine(_trace: &Trace, _motion: &Motion) -> Result<Vec<Finding>, Failure> {
    Ok(Vec::new())
}
