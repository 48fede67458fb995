//! The turn between two readings of a nut angle, exactly.
