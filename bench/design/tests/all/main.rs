//! Folding: what a block holds, how exact it is, and what is refused.
//!
//! A test whose name ends in `_whole` is the whole sweep of a test that by default runs a sample; all of them run with
//! `cargo test -p epas-design --test all -- --ignored _whole`.

mod built_in;
mod closed_form;
mod folded;
mod gears;
mod uncaged;
