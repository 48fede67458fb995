//! Gears that `epas-design` folded, as it wrote them: `cargo run --release -p epas-design --example gears -- bench/firmware/src/gears`.

pub mod balls;
mod gear_29x7_range;
mod gear_33x20;
mod gear_33x20_range;
mod gear_33x20_worn;

pub use balls::{GEAR_33X20_BALL, GEAR_33X20_BALL_RANGE};
pub use gear_29x7_range::GEAR_29X7_RANGE;
pub use gear_33x20::GEAR_33X20;
pub use gear_33x20_range::GEAR_33X20_RANGE;
pub use gear_33x20_worn::GEAR_33X20_WORN;
