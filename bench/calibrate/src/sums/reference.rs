//! The point about which the sums of a parameter are made.

use serde::{Deserialize, Serialize};

use crate::fit::problem::Scale;

/// A parameter that traces may tell, with the point about which the sums are made. Same in all sums that merge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Name.
    pub name: String,
    /// Whether it is summed by its logarithm.
    pub logarithmic: bool,
    /// Reference value.
    pub value: f64,
}

impl Reference {
    /// Scale of its sums.
    pub(super) fn scale(&self) -> Scale {
        if self.logarithmic {
            Scale::Logarithmic
        } else {
            Scale::Linear
        }
    }
}
