//! Profile.
#![no_std]
#![no_main]
use core::hint::black_box;
use cortex_m_rt::entry;
use epas_firmware::board::finish;
use epas_firmware::scenes::{Digest, Linear, Run};

type Model = <Linear as Run>::Model;

#[inline(never)]
#[unsafe(no_mangle)]
fn prof_step(model: &mut Model, nut_speed: f32, axial_load: f32, digest: &mut Digest) {
    Linear::tick(model, nut_speed, axial_load, digest);
}

#[entry]
fn main() -> ! {
    let Ok(mut model) = Linear::set_up() else { finish(false) };
    let mut digest = Digest::default();
    for _ in 0..12 {
        prof_step(black_box(&mut model), 20.0, 4000.0, &mut digest);
    }
    black_box(digest);
    finish(true)
}
