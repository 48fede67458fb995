//! Inputs spread over a domain, the same on every machine to the last bit.

/// The place of one case among all of them: each quantity drawn from it is spread evenly over the cases,
/// and the first two cases are the two ends of every range.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    index: u32,
    drawn: u32,
}

impl Spread {
    /// The place of case `index`.
    #[must_use]
    pub const fn new(index: u32) -> Self {
        Self { index, drawn: 0 }
    }

    /// Which case it is.
    #[must_use]
    pub const fn index(&self) -> u32 {
        self.index
    }

    /// A number of 24 bits, 0 to 2^24: multiples of an irrational number, another one for each quantity.
    fn share(&mut self) -> u32 {
        // 2^32 times the golden ratio's fraction and powers of it, made odd.
        let step = 0x9E37_79B9_u32.wrapping_mul(2 * self.drawn + 1) | 1;
        self.drawn += 1;
        match self.index {
            0 => 0,
            1 => 1 << 24,
            index => index.wrapping_mul(step) >> 8,
        }
    }

    /// A number of the range.
    pub fn between(&mut self, start: f32, end: f32) -> f32 {
        const UNIT: f32 = 1.0 / 16_777_216.0;
        start + (end - start) * (self.share() as f32 * UNIT)
    }

    /// A number of a range of positive numbers, spread over its magnitudes.
    pub fn magnitude(&mut self, start: f32, end: f32) -> f32 {
        let (start, end) = (start.to_bits(), end.to_bits());
        let span = u64::from(end - start);
        f32::from_bits(start + ((span * u64::from(self.share())) >> 24) as u32)
    }

    /// The special value of this case, where there is one: values are taken in turn from case `from` on.
    #[must_use]
    pub fn special(&self, numbers: &[f32], from: u32) -> Option<f32> {
        let place = self.index.checked_sub(from)?;
        numbers.get(place as usize).copied()
    }
}
