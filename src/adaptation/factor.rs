//! A covariance as `U D U'`: unit upper triangular times diagonal.

use crate::error::Range;
use crate::stored::{Port, Refusal, Stored};

/// Covariance of `N` numbers, in units of their deviations: `P = U D U'` with `U` upper triangular, ones on its diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Factor<const N: usize> {
    /// Column `j` has `U_ij` for `i < j`, and zeros below.
    pub(super) columns: [[f32; N]; N],
    /// `D`, above 0.
    pub(super) diagonal: [f32; N],
}

/// Least of `D`: three millionths of a deviation of the set-up, squared; one reading leaves at least ten times as much.
pub(super) const LEAST: f32 = 1e-11;

/// Projection of the covariance on a reading `h' x`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Projection<const N: usize> {
    /// `f = U' h` and `g = D f`.
    along: [[f32; 2]; N],
    /// Variance of the reading before it is taken in: `h' P h = f' g`, a sum of squares.
    pub(super) variance: f32,
}

impl<const N: usize> Projection<N> {
    pub(super) const NONE: Self = Self {
        along: [[0.0; 2]; N],
        variance: 0.0,
    };
}

impl<const N: usize> Factor<N> {
    pub(super) const fn independent(variance: f32) -> Self {
        Self {
            columns: [[0.0; N]; N],
            diagonal: [variance; N],
        }
    }

    #[inline(always)]
    pub(super) fn project(&self, h: &[f32; N]) -> Projection<N> {
        let mut along = [[0.0; 2]; N];
        let mut variance = 0.0;
        let columns = self.columns.iter().zip(&self.diagonal).zip(h);
        for (j, (((column, diagonal), &own), along)) in columns.zip(&mut along).enumerate() {
            let mut f = own;
            for (above, h) in column.iter().zip(h).take(j) {
                f += above * h;
            }
            let g = diagonal * f;
            variance += f * g;
            *along = [f, g];
        }
        Projection { along, variance }
    }

    #[inline(always)]
    pub(super) fn project_one(&self, number: usize, h: f32) -> Projection<N> {
        let mut along = [[0.0; 2]; N];
        let mut variance = 0.0;
        let columns = self.columns.iter().zip(&self.diagonal);
        for (j, ((column, diagonal), along)) in columns.zip(&mut along).enumerate() {
            let above = column.get(number).copied().unwrap_or(0.0);
            let f = if j == number { h } else { h * above };
            let g = diagonal * f;
            variance += f * g;
            *along = [f, g];
        }
        Projection { along, variance }
    }

    /// Takes in a reading with a noise of this variance, above 0 (Bierman 1977); gives `P h` over the variance of its error.
    ///
    /// `a_0` the noise, `a_j = a_(j-1) + f_j g_j`, `D_j <- D_j a_(j-1)/a_j`: all terms of `a` are squares, so that `D` stays above 0.
    #[inline(always)]
    pub(super) fn read(&mut self, projection: &Projection<N>, noise: f32) -> [f32; N] {
        let mut gain = [0.0; N];
        let mut variance = noise;
        let mut inverse = 1.0 / noise;
        let columns = self.columns.iter_mut().zip(&mut self.diagonal);
        for (j, ((column, diagonal), &[f, g])) in columns.zip(&projection.along).enumerate() {
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
        for gain in &mut gain {
            *gain *= inverse;
        }
        gain
    }

    #[inline(always)]
    pub(super) fn forget(&mut self, growth: f32) {
        for entry in &mut self.diagonal {
            *entry *= growth;
        }
    }

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

impl<const N: usize> Stored for Factor<N> {
    const BYTES: usize = 4 * (N + N * (N - 1) / 2);

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        // No variance exceeds that of the set-up, but for rounding.
        let variance = Range::new(LEAST, 1.01);
        port.numbers("diagonal", &mut self.diagonal, variance)?;
        for (index, column) in self.columns.iter_mut().enumerate() {
            for above in column.iter_mut().take(index) {
                port.number("above", above, Range::new(-1e6, 1e6))?;
            }
        }
        if self.variances().iter().all(|&entry| entry <= 1.01) {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "variance" })
        }
    }
}
