//! Gears that `epas-design` folded, as it wrote them: `cargo run --release -p epas-design --example gears -- bench/firmware/src/gears`.

mod lin_3_6;
mod lin_3_6_ball;
mod lin_3_6_ball_range;
mod lin_3_6_range;
mod lin_3_6_worn;
mod lin_4_1_range;

pub use lin_3_6::LIN_3_6;
pub use lin_3_6_ball::LIN_3_6_BALL;
pub use lin_3_6_ball_range::LIN_3_6_BALL_RANGE;
pub use lin_3_6_range::LIN_3_6_RANGE;
pub use lin_3_6_worn::LIN_3_6_WORN;
pub use lin_4_1_range::LIN_4_1_RANGE;
