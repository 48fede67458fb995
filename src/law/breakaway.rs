//! Initial stiffness and breakaway angle from a design.
