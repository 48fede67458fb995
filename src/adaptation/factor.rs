//! A covariance as `U D U'`: unit upper triangular times diagonal.

/// Covariance of `N` numbers, in units of their deviations: `P = U D U'` with `U` upper triangular, ones on its diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Factor<const N: usize> {
    /// Column `j` has `U_ij` for `i < j`, and zeros below.
    pub(super) columns: [[f32; N]; N],
    /// `D`, above 0.
    pub(super) diagonal: [f32; N],
}

/// Least of `D`: three millionths of a deviation of the set-up, squared.
pub(super) const LEAST: f32 = 1e-11;

/// What a reading tells: the numbers move by `gain / variance` for an error of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading<const N: usize> {
    /// `P h`.
    pub(super) gain: [f32; N],
    /// `1/(h' P h + 1)`.
    pub(super) per_variance: f32,
}

impl<const N: usize> Factor<N> {
    /// Independent numbers with this variance.
    pub(super) const fn independent(variance: f32) -> Self {
        Self {
            columns: [[0.0; N]; N],
            diagonal: [variance; N],
        }
    }

    /// Takes in a reading `h' x` with a noise of one (Bierman 1977).
    ///
    /// With `f = U' h`, `g = D f`: `a_j = a_(j-1) + f_j g_j`, `D_j <- D_j a_(j-1)/a_j`. All terms of `a` are squares, so that
    /// `D` stays above 0 in any arithmetic that keeps signs.
    #[inline(always)]
    pub(super) fn read(&mut self, h: &[f32; N]) -> Reading<N> {
        let mut gain = [0.0; N];
        let mut variance = 1.0;
        let mut inverse = 1.0;
        let columns = self.columns.iter_mut().zip(&mut self.diagonal);
        for (j, ((column, diagonal), &own)) in columns.zip(h).enumerate() {
            let mut f = own;
            for (above, h) in column.iter().zip(h).take(j) {
                f += above * h;
            }
            let g = *diagonal * f;
            let before = variance;
            variance += f * g;
            let step = -f * inverse;
            inverse = 1.0 / variance;
            let left = *diagonal * (before * inverse);
            *diagonal = if left > LEAST { left } else { LEAST };
            for (above, gain) in column.iter_mut().zip(&mut gain).take(j) {
                let was = *above;
                *above = was + *gain * step;
                *gain += was * g;
            }
            if let Some(gain) = gain.get_mut(j) {
                *gain = g;
            }
        }
        Reading {
            gain,
            per_variance: inverse,
        }
    }

    /// All readings so far count by `1/growth`.
    #[inline(always)]
    pub(super) fn forget(&mut self, growth: f32) {
        for entry in &mut self.diagonal {
            *entry *= growth;
        }
    }

    /// Variances: the diagonal of `P`.
    pub(super) fn variances(&self) -> [f32; N] {
        let mut variances = self.diagonal;
        for (column, entry) in self.columns.iter().zip(&self.diagonal) {
            for (variance, above) in variances.iter_mut().zip(column) {
                *variance += above * above * entry;
            }
        }
        variances
    }
}
