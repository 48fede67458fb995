//! Profile.
#![no_std]
#![no_main]
use cortex_m_rt::entry;
use epas_firmware::board::finish;
use epas_firmware::scenes::{BALLS, UNCAGED, course};
use epas_friction::scene::{UncagedBallScrew, UncagedConstants};
use epas_friction::{FrictionModel, Inputs};
use core::hint::black_box;

type Model = FrictionModel<UncagedBallScrew<BALLS>, &'static UncagedConstants<BALLS>>;

#[inline(never)]
#[unsafe(no_mangle)]
fn prof_step(model: &mut Model, nut_speed: f32, axial_load: f32) -> f32 {
    model.step(Inputs { nut_speed, axial_load }).friction_torque
}

#[entry]
fn main() -> ! {
    let mut model: Model = FrictionModel::of(&UNCAGED);
    for tick in 0..12 {
        let (_, _) = course(tick);
        black_box(prof_step(black_box(&mut model), 20.0, 4000.0));
    }
    finish(true)
}
