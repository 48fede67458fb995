//! Traces of the rig: consistent in themselves, and with the crate's scene.

#[path = "../kit/mod.rs"]
mod kit;

mod same_scene;
mod traces;
