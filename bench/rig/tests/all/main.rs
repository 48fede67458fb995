//! Traces of the rig: consistent in themselves, and with the crate's scene.

#[path = "../../../../host-tests/tests/kit"]
#[allow(dead_code, reason = "shared with other programs of tests")]
mod kit {
    pub mod errors;
    pub mod measured;
}

mod same_scene;
mod traces;
