//! Calls every function once for each counted case, for whoever traces the program.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use epas_firmware::board::{clock, finish};
use epas_firmware::contexts::Contexts;
use epas_firmware::counted::counting;
use epas_firmware::inputs::COUNTED;
use epas_firmware::spread::Spread;
use epas_firmware::subjects::{PEERS, SUBJECTS, WIDEST};

#[entry]
fn main() -> ! {
    let Ok(mut contexts) = Contexts::new(clock) else {
        finish(false)
    };
    counting();
    let mut inputs = [0.0; WIDEST];
    let mut outputs = [0.0; WIDEST];
    for subject in SUBJECTS.iter().chain(PEERS) {
        for case in 0..COUNTED {
            let Some(inputs) = inputs.get_mut(..subject.inputs) else {
                finish(false)
            };
            (subject.fill)(&mut Spread::new(case), inputs);
            (subject.run)(&mut contexts, inputs, &mut outputs);
        }
    }
    finish(true)
}
