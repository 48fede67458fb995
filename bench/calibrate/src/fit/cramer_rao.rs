//! The least covariance that any unbiased estimator can have (Cramer and Rao).

use nalgebra::DMatrix;
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};

/// Fisher information `J' S^-1 J` of normal noise whose covariance between rows depends on their distance only. `autocovariance` holds
/// it at lags 0, 1, ...; beyond its end it is zero. `None` where that is the autocovariance of no process.
pub fn information(jacobian: &DMatrix<f64>, autocovariance: &[f64]) -> Option<DMatrix<f64>> {
    let rows = jacobian.nrows();
    let mut covariance = CooMatrix::new(rows, rows);
    for (lag, value) in autocovariance.iter().enumerate().take(rows) {
        for row in 0..rows - lag {
            covariance.push(row, row + lag, *value);
            if lag > 0 {
                covariance.push(row + lag, row, *value);
            }
        }
    }
    let factor = CscCholesky::factor(&CscMatrix::from(&covariance)).ok()?;
    let information = jacobian.tr_mul(&factor.solve(jacobian));
    information
        .iter()
        .all(|value| value.is_finite())
        .then_some(information)
}

/// Cramer-Rao bound: the inverse of the [`information`]. `None` where the rows do not see some direction at all, too.
pub fn cramer_rao(jacobian: &DMatrix<f64>, autocovariance: &[f64]) -> Option<DMatrix<f64>> {
    inverse(&information(jacobian, autocovariance)?)
}

/// Inverse of an information, its parameters scaled to information 1 first.
pub(crate) fn inverse(information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scales: Vec<f64> = information
        .diagonal()
        .iter()
        .map(|value| value.sqrt())
        .collect();
    let scaled = DMatrix::from_fn(scales.len(), scales.len(), |i, j| {
        information[(i, j)] / (scales[i] * scales[j])
    });
    let inverse = scaled.cholesky()?.inverse();
    Some(DMatrix::from_fn(scales.len(), scales.len(), |i, j| {
        inverse[(i, j)] / (scales[i] * scales[j])
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slopes() -> DMatrix<f64> {
        DMatrix::from_fn(400, 2, |row, k| {
            if k == 0 {
                1.0
            } else {
                (0.05 * row as f64).sin()
            }
        })
    }

    /// White noise: variance times the inverse of `J' J`.
    #[test]
    fn white_noise() {
        let jacobian = slopes();
        let wanted = jacobian.tr_mul(&jacobian).try_inverse().unwrap() * 0.09;
        let found = cramer_rao(&jacobian, &[0.09]).unwrap();
        assert!((found - &wanted).amax() < 1e-12 * wanted.amax());
    }

    /// Noise with memory `r`: differences `x_t - r x_(t-1)` are white with variance `1 - r^2`, the first row has variance 1. Lags
    /// beyond 80 carry 0.7^80 = 4e-13 of the variance.
    #[test]
    fn noise_with_a_memory() {
        let (jacobian, memory) = (slopes(), 0.7f64);
        let fresh = (1.0 - memory * memory).sqrt();
        let white = DMatrix::from_fn(400, 2, |row, k| {
            if row == 0 {
                jacobian[(0, k)]
            } else {
                (jacobian[(row, k)] - memory * jacobian[(row - 1, k)]) / fresh
            }
        });
        let wanted = white.tr_mul(&white).try_inverse().unwrap();
        let autocovariance: Vec<f64> = (0..80).map(|lag| memory.powi(lag)).collect();
        let found = cramer_rao(&jacobian, &autocovariance).unwrap();
        assert!((found - &wanted).amax() < 1e-9 * wanted.amax());
    }

    /// A column of zeros is never told; 1, 1, 0, ... is the autocovariance of no process.
    #[test]
    fn no_bound() {
        let jacobian = DMatrix::from_fn(10, 2, |row, k| (k * row) as f64);
        assert!(cramer_rao(&jacobian, &[1.0]).is_none());
        assert!(cramer_rao(&slopes(), &[1.0, 1.0]).is_none());
    }
}
