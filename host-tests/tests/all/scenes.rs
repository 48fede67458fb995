//! Whole mechanisms: what a step gives, promises, and survives.

mod borders;
pub mod caged;
mod capacity;
mod closed_form;
mod compensation;
mod extreme;
mod faults;
mod hal;
mod laws;
mod linear_scene;
mod load_proportional;
mod memory;
mod noise;
mod phases;
pub mod preloaded;
mod promises;
mod scene_constants;
mod step_promises;
mod stiff;
mod stored;
mod swapped;
mod two_point_rolling;
pub mod uncaged;
