//! Ranges that all kinds of elements share.

use crate::error::Range;

/// Friction of gross sliding at the reference load: 1e-9 to 1e9 N m (N).
pub const REFERENCE_LIMIT: Range = Range::new(1e-9, 1e9);

/// Turn from no friction to full sliding: 1e-9 to 1e3 rad (m).
pub const BREAKAWAY: Range = Range::new(1e-9, 1e3);
