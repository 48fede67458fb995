//! Traces of the rig: consistent in themselves, and with the crate's scene.

mod same_scene;
mod traces;
