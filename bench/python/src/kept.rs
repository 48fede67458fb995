//! What was set up for the same numbers just before.

use crate::blocks::Real;
use crate::errors::Refused;

/// Constants that are set up anew only where their numbers change from one value of an array to the next.
pub struct Kept<const N: usize, T> {
    last: Option<([u64; N], T)>,
}

impl<const N: usize, T> Kept<N, T> {
    /// Nothing yet.
    pub const NONE: Self = Self { last: None };

    /// The constants of these numbers.
    #[inline]
    pub fn get<R: Real, E: Into<Refused>>(
        &mut self,
        numbers: [R; N],
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<&T, Refused> {
        let bits = numbers.map(R::bits);
        if self.last.as_ref().is_none_or(|(last, _)| *last != bits) {
            self.last = None;
            let made = make().map_err(Into::into)?;
            return Ok(&self.last.insert((bits, made)).1);
        }
        match &self.last {
            Some((_, made)) => Ok(made),
            None => Err(Refused::message("nothing is kept")),
        }
    }
}
