//! A block as Rust, C, TOML and bytes.
