//! The control interrupt of a screw that `build.rs` has folded.

use epas_friction::scene::CagedBallScrew;
use epas_friction::{FrictionModel, Inputs};

include!(concat!(env!("OUT_DIR"), "/gear.rs"));

fn main() {
    let mut model = FrictionModel::<CagedBallScrew, _>::of(&GEAR);
    let outputs = model.step(Inputs {
        nut_speed: 10.0,
        axial_load: 4_000.0,
    });
    println!("{outputs:?}");
    assert!(outputs.friction_torque > 0.0 && !outputs.faults.any());
}
