//! An effort that is known and that the controller did not command: a pulse, a weight on a cord, another drive.
//!
//! It acts in the direction of positive motion. Some recorders add it to the motor's effort, because it is made at the controller's output;
//! others do not: whichever explains the motion better.

use std::borrow::Cow;

use crate::checks::relation::relation;
use crate::signals::Motion;
use crate::trace::Trace;

/// An effort that is known and that the controller did not command.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownEffort {
    /// At every sample, N m or N, in the direction of positive motion.
    pub values: Vec<f64>,
    /// Whether the motor's effort holds it already.
    pub in_effort: bool,
}

impl KnownEffort {
    /// What acts beside the motor's effort.
    pub fn beside(&self) -> Option<&[f64]> {
        (!self.in_effort).then_some(self.values.as_slice())
    }

    /// What the motor's effort holds beside the controller's.
    pub fn within(&self) -> Option<&[f64]> {
        self.in_effort.then_some(self.values.as_slice())
    }
}

/// The trace with what is found of its known effort: whether the motor's effort holds it already. A trace that does not move enough for
/// it keeps what it is.
pub fn placed<'a>(trace: &'a Trace, motion: &Motion) -> Cow<'a, Trace> {
    let Some(known) = &trace.known else {
        return Cow::Borrowed(trace);
    };
    let with = |in_effort: bool| {
        let mut other = trace.clone();
        other.known = Some(KnownEffort {
            in_effort,
            ..known.clone()
        });
        let left = relation(&other, motion).map(|relation| relation.left_size);
        (other, left)
    };
    let (mut beside, left_beside) = with(false);
    let (mut within, left_within) = with(true);
    match (left_beside, left_within) {
        (Some(one), Some(other)) if other < one => {
            within.repairs.notes.push(
                "the known effort stands in the motor's effort already: with it added once more, the motion is explained worse".into(),
            );
            Cow::Owned(within)
        }
        (Some(_), Some(_)) => {
            beside
                .repairs
                .notes
                .push("the known effort acts beside the motor's effort".into());
            Cow::Owned(beside)
        }
        _ => Cow::Borrowed(trace),
    }
}
