//! What constructors refuse: a table of wrong values for each, and one loop.

use std::fmt::Debug;

use epas_friction::Error;
use epas_reference::ReferenceError;

pub trait Number: Copy + Debug + 'static {
    const NOT_FINITE: &'static [Self];
}

impl Number for f32 {
    const NOT_FINITE: &'static [Self] = &[Self::NAN, Self::INFINITY, Self::NEG_INFINITY];
}

impl Number for f64 {
    const NOT_FINITE: &'static [Self] = &[Self::NAN, Self::INFINITY, Self::NEG_INFINITY];
}

pub trait Refusal: Debug {
    fn names(&self) -> &str;

    /// Whether the range that the error gives contains the value that it refuses.
    fn contradicts_itself(&self) -> bool {
        false
    }
}

impl Refusal for Error {
    fn names(&self) -> &str {
        self.field()
    }

    fn contradicts_itself(&self) -> bool {
        self.allowed().contains(self.value())
    }
}

impl Refusal for ReferenceError {
    fn names(&self) -> &str {
        self.field().unwrap_or("no input")
    }
}

/// The field that the error names, a change of the sound parameters, and values that are refused.
pub type Wrong<P, V> = (&'static str, fn(&mut P, V), &'static [V]);

/// The sound parameters are taken; with each of these values, with NaN and with infinities they are refused by the name of the field.
pub fn assert_refused<P: Clone, V: Number, T, E: Refusal>(
    sound: &P,
    make: impl Fn(&P) -> Result<T, E>,
    table: &[Wrong<P, V>],
) {
    for &(field, change, values) in table {
        assert_refused_at(
            sound,
            &make,
            &[(field, change, values), (field, change, V::NOT_FINITE)],
        );
    }
}

pub fn assert_refused_at<P: Clone, V: Number, T, E: Refusal>(
    sound: &P,
    make: impl Fn(&P) -> Result<T, E>,
    table: &[Wrong<P, V>],
) {
    if let Err(error) = make(sound) {
        panic!("sound parameters are refused: {error:?}");
    }
    for (field, change, values) in table {
        for value in *values {
            let mut wrong = sound.clone();
            change(&mut wrong, *value);
            let Err(error) = make(&wrong) else {
                panic!("{field} = {value:?} is taken");
            };
            assert_eq!(error.names(), *field, "{value:?}: {error:?}");
            assert!(!error.contradicts_itself(), "{value:?}: {error:?}");
        }
    }
}
