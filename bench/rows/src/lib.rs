//! Designs of ball screws studied side by side: see [`design_study`].

pub mod design_study;
