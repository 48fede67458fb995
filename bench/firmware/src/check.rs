//! Every function on the stored cases, bit for bit against the results that a host found.

use crate::cases::{Reader, STORED, same};
use crate::contexts::Contexts;
use crate::subjects::{SUBJECTS, Subject, WIDEST};

/// Where a program on the target writes to, without the formatting of `core`, which may panic.
pub trait Screen {
    /// Writes some bytes.
    fn bytes(&mut self, bytes: &[u8]);

    /// Writes a text.
    fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Writes a number in decimals.
    #[inline(never)]
    fn number(&mut self, number: u32) {
        let mut left = number;
        let mut digits = [0; 10];
        let mut written = 0;
        for digit in digits.iter_mut().rev() {
            *digit = b'0' + (left % 10) as u8;
            left /= 10;
            written += 1;
            if left == 0 {
                break;
            }
        }
        if let Some(digits) = digits.get(digits.len() - written..) {
            self.bytes(digits);
        }
    }
}

/// Compares all stored cases; where the clock runs it also writes how long each function takes. Whether all are the host's.
pub fn stored_cases(screen: &mut impl Screen, clock: fn() -> u32) -> bool {
    let Ok(mut contexts) = Contexts::new(clock) else {
        return false;
    };
    let mut reader = Reader::new(STORED);
    let mut checked = 0;
    let mut passed = true;
    for subject in SUBJECTS {
        let Some((cases, sound)) = run(screen, &mut contexts, &mut reader, subject) else {
            screen.text("the stored cases are not those of ");
            screen.text(subject.name);
            screen.text("\n");
            return false;
        };
        checked += cases;
        passed &= sound;
    }
    screen.number(checked);
    screen.text(" cases compared\n");
    passed && reader.is_empty()
}

/// Cases of one function, and whether all results are the host's.
fn run(
    screen: &mut impl Screen,
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
                screen.text(subject.name);
                screen.text(" case ");
                screen.number(case);
                screen.text(" output ");
                screen.number(place);
                screen.text(": bits ");
                screen.number(found.to_bits());
                screen.text(" instead of ");
                screen.number(expected.to_bits());
                screen.text("\n");
            }
        }
    }
    if most > 0 {
        screen.text(subject.name);
        screen.text(" ");
        screen.number(least);
        screen.text(" to ");
        screen.number(most);
        screen.text(" cycles\n");
    }
    Some((cases, passed))
}
