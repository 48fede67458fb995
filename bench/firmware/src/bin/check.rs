//! Runs every function on the stored cases and compares the results bit for bit with those that a host
//! found. On a board whose cycle counter runs it also prints what each function takes.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use epas_firmware::board::{Console, clock, finish, start_clock};
use epas_firmware::cases::{Reader, STORED, same};
use epas_firmware::contexts::Contexts;
use epas_firmware::subjects::{SUBJECTS, Subject, WIDEST};

#[entry]
fn main() -> ! {
    start_clock();
    let mut console = Console::open();
    let Ok(mut contexts) = Contexts::new(clock) else {
        finish(false)
    };
    let mut reader = Reader::new(STORED);
    let mut checked = 0;
    let mut passed = true;
    for subject in SUBJECTS {
        match run(&mut console, &mut contexts, &mut reader, subject) {
            Some((cases, sound)) => {
                checked += cases;
                passed &= sound;
            }
            None => {
                console.text("the stored cases are not those of ");
                console.text(subject.name);
                console.text("\n");
                finish(false);
            }
        }
    }
    console.number(checked);
    console.text(" cases compared\n");
    finish(passed && reader.is_empty())
}

/// Cases of one function, and whether all results are the host's.
fn run(
    console: &mut Console,
    contexts: &mut Contexts,
    reader: &mut Reader,
    subject: &Subject,
) -> Option<(u32, bool)> {
    let cases = reader.header(subject)?;
    let mut passed = true;
    let (mut least, mut most) = (u32::MAX, 0);
    for case in 0..cases {
        let mut inputs = [0.0; WIDEST];
        let mut stored = [0.0; WIDEST];
        let mut outputs = [0.0; WIDEST];
        let inputs = inputs.get_mut(..subject.inputs)?;
        let stored = stored.get_mut(..subject.outputs)?;
        let outputs = outputs.get_mut(..subject.outputs)?;
        reader.numbers(inputs)?;
        reader.numbers(stored)?;
        (subject.run)(contexts, inputs, outputs);
        least = least.min(contexts.elapsed);
        most = most.max(contexts.elapsed);
        for (place, (&found, &expected)) in (0..).zip(outputs.iter().zip(&*stored)) {
            if !same(found, expected) {
                passed = false;
                console.text(subject.name);
                console.text(" case ");
                console.number(case);
                console.text(" output ");
                console.number(place);
                console.text(": bits ");
                console.number(found.to_bits());
                console.text(" instead of ");
                console.number(expected.to_bits());
                console.text("\n");
            }
        }
    }
    if most > 0 {
        console.text(subject.name);
        console.text(" ");
        console.number(least);
        console.text(" to ");
        console.number(most);
        console.text(" cycles\n");
    }
    Some((cases, passed))
}
