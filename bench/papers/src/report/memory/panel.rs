//! Size of the figures on friction with a memory.

/// Width and height of a panel, pixels.
pub const PANEL: (u32, u32) = (540, 440);
