//! What was made last, kept: slopes change one quantity at a time, and most of what a model needs depends on few of them.

use std::sync::{Mutex, PoisonError};

/// The last values that were made, each with what it was made from.
#[derive(Debug)]
pub struct Recent<K, V> {
    most: usize,
    kept: Mutex<Vec<(K, V)>>,
}

impl<K: Copy + PartialEq, V: Clone> Recent<K, V> {
    /// Keeps so many values.
    pub const fn new(most: usize) -> Self {
        Self {
            most,
            kept: Mutex::new(Vec::new()),
        }
    }

    /// The value of a key, made where it is not kept; the oldest gives way to it.
    ///
    /// # Errors
    /// Those of `make`; nothing is kept then.
    pub fn of<E>(&self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        let kept = || self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, value)) = kept().iter().find(|(own, _)| *own == key) {
            return Ok(value.clone());
        }
        // Not locked: others go on meanwhile.
        let value = make()?;
        let mut kept = kept();
        if kept.len() == self.most {
            kept.remove(0);
        }
        kept.push((key, value.clone()));
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values are those of their keys, whatever came between; what fits in is made once, what does not is made again.
    #[test]
    fn values_are_those_of_their_keys() {
        for (most, expected) in [(8, 30), (10, 10)] {
            let recent = Recent::new(most);
            let mut made = 0;
            for _ in 0..3 {
                for key in 0..10 {
                    let value = recent.of(key, || {
                        made += 1;
                        Ok::<_, ()>(vec![10 * key])
                    });
                    assert_eq!(value, Ok(vec![10 * key]));
                    let again = recent.of(key, || -> Result<_, ()> { unreachable!() });
                    assert_eq!(again, Ok(vec![10 * key]));
                }
            }
            assert_eq!(made, expected);
        }
    }

    /// An error is given on, and the next asks anew.
    #[test]
    fn errors_are_not_kept() {
        let recent = Recent::new(2);
        assert_eq!(recent.of(1, || Err::<u8, _>("no")), Err("no"));
        assert_eq!(recent.of(1, || Ok::<_, &str>(5)), Ok(5));
    }
}
