//! placeholder
#![no_std]

pub mod curvature;
pub mod efficiency;
pub mod error;
pub mod geometry;
pub mod hertz;
pub mod material;
pub mod math;
pub mod model;
pub mod scene;

pub use curvature::*;
pub use efficiency::*;
pub use error::{Error, Range};
pub use geometry::*;
pub use hertz::*;
pub use material::*;
pub use model::*;
pub use scene::*;
