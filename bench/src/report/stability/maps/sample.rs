//! What crate and reference say at a point of a map.

use epas_eval::{BadField, Both, Model};

use crate::report::statistics::Errors;

/// The numbers that are compared; none where a quantity does not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Of the crate.
    pub found: Option<f64>,
    /// Of the reference.
    pub exact: Option<f64>,
    /// Of the reference, by which the error is divided; 1 for an absolute error.
    pub scale: Option<f64>,
}

impl Numbers {
    /// An absolute error.
    pub fn of(found: impl Into<Option<f64>>, exact: impl Into<Option<f64>>) -> Self {
        Self {
            found: found.into().filter(|number| number.is_finite()),
            exact: exact.into().filter(|number| number.is_finite()),
            scale: Some(1.0),
        }
    }

    /// The error over this number.
    pub fn over(self, scale: impl Into<Option<f64>>) -> Self {
        let divides = |number: &f64| number.is_finite() && *number != 0.0;
        Self {
            scale: scale.into().filter(divides),
            ..self
        }
    }

    /// Where this holds, the quantity does not count.
    pub fn unless(self, excluded: bool) -> Self {
        Self {
            exact: self.exact.filter(|_| !excluded),
            ..self
        }
    }
}

/// A point of a map.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The line that asks `eval` the same.
    pub line: String,
    pub numbers: Numbers,
}

/// Asks crate and reference; what they refuse is an error.
pub fn ask<M: Model>(
    request: &M,
    numbers: impl Fn(&M::InLoop, &M::Reference) -> Numbers,
) -> Result<Sample, BadField> {
    let Both { in_loop, reference } = request.evaluate()?;
    Ok(Sample {
        line: request.line()?,
        numbers: numbers(&in_loop, &reference),
    })
}

/// What became of the points of a map: each is counted once.
#[derive(Default)]
pub struct Tally {
    /// Of the points where both have a number.
    pub errors: Errors,
    pub compared: u32,
    /// Points that the crate or the reference refuses.
    pub refused: u32,
    /// Points where the reference has no number, or none that counts.
    pub not_exact: u32,
    /// Points where the reference has a number and the crate none.
    pub not_found: u32,
    /// The point of the largest error.
    pub worst: Option<(f64, Sample)>,
}

impl Tally {
    /// Counts a point, and gives the size of its error.
    pub fn add(&mut self, point: Result<Sample, BadField>) -> Option<f64> {
        let Ok(sample) = point else {
            self.refused += 1;
            return None;
        };
        let Numbers {
            found,
            exact,
            scale,
        } = sample.numbers;
        let (Some(exact), Some(scale)) = (exact, scale) else {
            self.not_exact += 1;
            return None;
        };
        let Some(found) = found else {
            self.not_found += 1;
            return None;
        };
        let error = (found - exact) / scale;
        self.compared += 1;
        self.errors.add(error);
        if self
            .worst
            .as_ref()
            .is_none_or(|(worst, _)| error.abs() >= *worst)
        {
            self.worst = Some((error.abs(), sample));
        }
        Some(error.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A refusal, a number that only one side has, and one that does not count are four things, and none is an error.
    #[test]
    fn every_point_is_counted_once() {
        let mut tally = Tally::default();
        let mut add = |numbers: Numbers| {
            tally.add(Ok(Sample {
                line: String::new(),
                numbers,
            }))
        };
        assert_eq!(add(Numbers::of(3.0, 2.0).over(-4.0)), Some(0.25));
        assert_eq!(add(Numbers::of(2.0, 2.0)), Some(0.0));
        assert_eq!(add(Numbers::of(f64::NAN, 2.0)), None);
        assert_eq!(add(Numbers::of(2.0, None)), None);
        assert_eq!(add(Numbers::of(2.0, f64::INFINITY)), None);
        assert_eq!(add(Numbers::of(2.0, 2.0).over(0.0)), None);
        assert_eq!(add(Numbers::of(2.0, 2.0).unless(true)), None);
        let friction = epas_eval::friction_map::Request {
            axis_ratio: 2.0,
            offset: 0.0,
        };
        let refused = ask(&friction, |f, r| Numbers::of(f.force, r.force));
        assert_eq!(tally.add(refused), None);
        let counts = [
            tally.compared,
            tally.refused,
            tally.not_exact,
            tally.not_found,
        ];
        assert_eq!(counts, [2, 1, 4, 1]);
        assert_eq!(tally.worst.map(|(error, _)| error), Some(0.25));
    }
}
