//! Flags of steps: each is told when it begins and when it ends, and not in every step between.

use crate::outcome::{Outcome, Told};

/// Flags of the last step, and the time since which they are the same, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flags {
    faults: u32,
    since: f64,
}

impl Flags {
    /// Flags of a step at a time, of which everything is told already.
    pub const fn new(faults: u32, since: f64) -> Self {
        Self { faults, since }
    }

    /// Takes the flags of a step over; `words` of flags are asked for where they are told.
    pub fn take(&mut self, time: f64, faults: u32, words: impl Fn(u32) -> String) -> Option<Told> {
        let before = *self;
        let outcome = if faults == 0 {
            Outcome::Fine
        } else {
            Outcome::Warning
        };
        if faults == before.faults {
            return (faults != 0).then_some(Told {
                outcome,
                text: None,
            });
        }
        *self = Self::new(faults, time);
        let text = if faults == 0 {
            let Self { faults, since } = before;
            format!(
                "at {time} s the model flags no step any more (faults = {faults} since {since} s)"
            )
        } else {
            format!(
                "at {time} s the model has flagged the step (faults = {faults}): {}; told again when that changes",
                words(faults)
            )
        };
        Some(Told {
            outcome,
            text: Some(text),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of four flagged steps the first is told, the third, whose flags are others, and the end; each of them is a warning.
    #[test]
    fn a_flag_is_told_once_and_when_it_ends() {
        let mut flags = Flags::default();
        let mut take = |time, faults| {
            flags
                .take(time, faults, |faults| format!("words of {faults}"))
                .map(|told| (told.outcome, told.text.unwrap_or_default()))
        };
        assert_eq!(take(0.0, 0), None);
        let (outcome, text) = take(1.0, 2).unwrap();
        assert_eq!(outcome, Outcome::Warning);
        assert!(
            text.contains("at 1 s") && text.contains("words of 2"),
            "{text}"
        );
        assert_eq!(take(2.0, 2), Some((Outcome::Warning, String::new())));
        let (_, text) = take(3.0, 3).unwrap();
        assert!(text.contains("words of 3"), "{text}");
        assert_eq!(take(4.0, 3), Some((Outcome::Warning, String::new())));
        let (outcome, text) = take(5.0, 0).unwrap();
        assert_eq!(outcome, Outcome::Fine);
        assert!(text.contains("faults = 3 since 3 s"), "{text}");
        assert_eq!(take(6.0, 0), None);
    }
}
