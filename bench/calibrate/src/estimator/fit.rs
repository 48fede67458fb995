//! Linear least squares over rows, with the noise of the motion's sensor taken out of the normal equations, and jackknife intervals.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Probability beyond an interval's upper end.
const BEYOND: f64 = 0.025;

/// Stretches from which on the jackknife over whole stretches counts.
const STRETCHES: f64 = 8.0;

/// Least singular value over the largest that counts.
const RANK: f64 = 1e-12;

#[derive(Clone, Debug, Default)]
pub struct Block {
    pub columns: Vec<Vec<f64>>,
    pub target: Vec<f64>,
    /// Covariance of the sensor's noise in the columns of a row.
    pub noise: DMatrix<f64>,
    pub stretches: Vec<usize>,
    /// Number of each row's piece; neighbours differ by 1.
    pub pieces: Vec<usize>,
}

/// What the values mean: those of the fit from the linear coefficients.
pub type Meaning<'a> = &'a dyn Fn(&[f64]) -> Vec<f64>;

#[derive(Clone, Debug)]
pub struct Fit {
    pub coefficients: Vec<f64>,
    pub values: Vec<f64>,
    pub half_widths: Vec<f64>,
    /// Covariance of the values by the jackknife over pieces.
    pub covariance: DMatrix<f64>,
    /// Effective number of pieces that tell each coefficient.
    pub pieces: Vec<f64>,
    pub freedom: Vec<f64>,
    pub residual: Vec<f64>,
    pub residual_rms: f64,
    /// That over the standard deviation of the target.
    pub relative: f64,
}

struct Piece {
    number: (usize, usize),
    normal: DMatrix<f64>,
    right: DVector<f64>,
}

fn solved(normal: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    if let Some(factor) = normal.clone().cholesky() {
        return factor.solve(right);
    }
    // Numbers that are none have no singular values: the search for them would not end.
    if !normal.iter().all(|x| x.is_finite()) {
        return DVector::from_element(right.len(), f64::NAN);
    }
    let singular = normal.clone().svd(true, true);
    let least = RANK * singular.singular_values.max();
    singular
        .solve(right, least)
        .unwrap_or_else(|_| DVector::zeros(right.len()))
}

pub fn fit(blocks: &[Block], meaning: Meaning<'_>) -> Fit {
    let count = blocks.first().map_or(0, |block| block.columns.len());
    let squares = |column: usize| -> f64 {
        let rows = blocks.iter().flat_map(|block| &block.columns[column]);
        rows.map(|x| x * x).sum()
    };
    let rows = blocks.iter().map(|block| block.target.len()).sum::<usize>();
    let scale: Vec<f64> = (0..count)
        .map(|column| {
            let size = (squares(column) / rows.max(1) as f64).sqrt();
            if size > 0.0 { size } else { 1.0 }
        })
        .collect();
    let stretches = pieces(blocks, &scale, |block| &block.stretches);
    let short = pieces(blocks, &scale, |block| &block.pieces);
    let unscaled = |x: &DVector<f64>| -> Vec<f64> {
        x.iter().zip(&scale).map(|(x, scale)| x / scale).collect()
    };
    let (normal, right) = total(&short, count);
    let coefficients = unscaled(&solved(&normal, &right));
    let values = meaning(&coefficients);
    let without = |piece: &Piece| {
        let left = solved(&(&normal - &piece.normal), &(&right - &piece.right));
        meaning(&unscaled(&left))
    };
    let sound = normal.iter().all(|x| x.is_finite());
    let inverse = sound
        .then(|| normal.clone().pseudo_inverse(0.0).ok())
        .flatten();
    let inverse = inverse.unwrap_or_else(|| normal.clone());
    let whole = jackknife((&stretches, false), &values, &inverse, &without);
    let parts = jackknife((&short, true), &values, &inverse, &without);
    let told = (0..count).map(|k| {
        let by_stretches = whole.pieces[k] >= STRETCHES;
        let by = if by_stretches && whole.half_widths[k] > parts.half_widths[k] {
            &whole
        } else {
            &parts
        };
        (by.half_widths[k], by.pieces[k] - 1.0)
    });
    let (half_widths, freedom) = told.unzip();
    let residual: Vec<f64> = blocks
        .iter()
        .flat_map(|block| {
            let coefficients = &coefficients;
            (0..block.target.len()).map(move |row| {
                let model = block.columns.iter().zip(coefficients);
                block.target[row] - model.map(|(column, x)| column[row] * x).sum::<f64>()
            })
        })
        .collect();
    let targets = || blocks.iter().flat_map(|block| &block.target);
    let mean = targets().sum::<f64>() / rows.max(1) as f64;
    let spread = targets().map(|y| (y - mean).powi(2)).sum::<f64>();
    let left = residual.iter().map(|r| r * r).sum::<f64>();
    Fit {
        coefficients,
        values,
        half_widths,
        covariance: parts.covariance,
        pieces: whole.pieces,
        freedom,
        residual_rms: (left / rows.max(1) as f64).sqrt(),
        relative: (left / spread.max(f64::MIN_POSITIVE)).sqrt(),
        residual,
    }
}

/// Sums of every piece, scaled columns, in the order of their numbers.
fn pieces(blocks: &[Block], scale: &[f64], numbers: impl Fn(&Block) -> &Vec<usize>) -> Vec<Piece> {
    let count = scale.len();
    let mut found: Vec<Piece> = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        let noise = DMatrix::from_fn(count, count, |i, j| {
            block.noise.get((i, j)).copied().unwrap_or(0.0) / (scale[i] * scale[j])
        });
        for (row, number) in numbers(block).iter().enumerate() {
            let number = (index, *number);
            if found.last().is_none_or(|piece| piece.number != number) {
                found.push(Piece {
                    number,
                    normal: DMatrix::zeros(count, count),
                    right: DVector::zeros(count),
                });
            }
            let Some(piece) = found.last_mut() else {
                continue;
            };
            let columns = block.columns.iter().zip(scale);
            let x = DVector::from_iterator(count, columns.map(|(column, size)| column[row] / size));
            piece.normal.ger(1.0, &x, &x, 1.0);
            piece.normal -= &noise;
            piece.right.axpy(block.target[row], &x, 1.0);
        }
    }
    found
}

fn total(pieces: &[Piece], count: usize) -> (DMatrix<f64>, DVector<f64>) {
    let mut sums = (DMatrix::zeros(count, count), DVector::zeros(count));
    for piece in pieces {
        sums.0 += &piece.normal;
        sums.1 += &piece.right;
    }
    sums
}

/// Sizes of columns, and their products over these; a column of zeros has the size 1.
pub fn normal(columns: &[Vec<f64>]) -> (Vec<f64>, DMatrix<f64>) {
    let count = columns.len();
    let mut normal = DMatrix::zeros(count, count);
    for i in 0..count {
        for j in 0..=i {
            normal[(i, j)] = dot(&columns[i], &columns[j]);
            normal[(j, i)] = normal[(i, j)];
        }
    }
    let sizes = normal
        .diagonal()
        .map(|square: f64| if square > 0.0 { square.sqrt() } else { 1.0 });
    let scaled = DMatrix::from_fn(count, count, |i, j| normal[(i, j)] / (sizes[i] * sizes[j]));
    (sizes.iter().copied().collect(), scaled)
}

/// What solves for the coefficients of columns that make some rows.
pub fn solver(columns: &[Vec<f64>]) -> Option<impl Fn(&[f64]) -> DVector<f64> + use<'_>> {
    let (sizes, normal) = normal(columns);
    let count = columns.len();
    let inverse = normal.try_inverse()?;
    Some(move |rows: &[f64]| {
        let right = DVector::from_fn(count, |k, _| dot(&columns[k], rows) / sizes[k]);
        let mut found = &inverse * right;
        for (value, size) in found.iter_mut().zip(&sizes) {
            *value /= size;
        }
        found
    })
}

pub fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

pub fn rms(values: &[f64]) -> f64 {
    (dot(values, values) / values.len().max(1) as f64).sqrt()
}

struct Jackknife {
    half_widths: Vec<f64>,
    pieces: Vec<f64>,
    covariance: DMatrix<f64>,
}

/// Deletes one piece at a time: `(G - 1)/G sum d d'`, and the covariance of neighbours where they are joined and it adds. An effective number of pieces
/// `nu = (sum a)^2 / sum a^2`, with `a` a piece's part in the variance of a coefficient, counts those that tell it: `t` has `nu - 1` degrees
/// of freedom.
fn jackknife(
    (pieces, joined): (&[Piece], bool),
    values: &[f64],
    inverse: &DMatrix<f64>,
    without: &dyn Fn(&Piece) -> Vec<f64>,
) -> Jackknife {
    let (count, groups) = (values.len(), pieces.len());
    let moved: Vec<Vec<f64>> = pieces
        .iter()
        .map(|piece| {
            let left = without(piece);
            left.iter()
                .zip(values)
                .map(|(left, all)| left - all)
                .collect()
        })
        .collect();
    let share = groups.saturating_sub(1) as f64 / groups.max(1) as f64;
    let neighbours = |k: usize| -> f64 {
        let pairs = pieces.windows(2).zip(moved.windows(2));
        pairs
            .filter(|(pair, _)| {
                let [one, other] = [pair[0].number, pair[1].number];
                joined && one.0 == other.0 && other.1 == one.1 + 1
            })
            .map(|(_, moved)| 2.0 * moved[0][k] * moved[1][k])
            .sum()
    };
    let covariance = DMatrix::from_fn(count, count, |i, j| {
        let sum: f64 = moved.iter().map(|moved| moved[i] * moved[j]).sum();
        let own = if i == j { neighbours(i).max(0.0) } else { 0.0 };
        share * (sum + own)
    });
    let mut sums = vec![(0.0, 0.0); count];
    for piece in pieces {
        let part = inverse * &piece.normal * inverse;
        for (k, sums) in sums.iter_mut().enumerate() {
            sums.0 += part[(k, k)];
            sums.1 += part[(k, k)].powi(2);
        }
    }
    let effective: Vec<f64> = sums
        .iter()
        .map(|(sum, square)| sum * sum / square.max(f64::MIN_POSITIVE))
        .collect();
    let half_widths = (0..count)
        .map(|k| quantile(effective[k] - 1.0, 1) * covariance[(k, k)].max(0.0).sqrt())
        .collect();
    Jackknife {
        half_widths,
        pieces: effective,
        covariance,
    }
}

/// Student's quantile of a 95 % interval, for 1 degree of freedom or more; of all of so many intervals together (Bonferroni).
pub fn quantile(freedom: f64, intervals: u32) -> f64 {
    let upper = 1.0 - BEYOND / f64::from(intervals);
    StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(f64::INFINITY, |t| t.inverse_cdf(upper))
}
