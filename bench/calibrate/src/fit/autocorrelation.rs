//! How far the rows of a residual repeat each other.

/// The window of a summed correlation: so many correlation times (Sokal 1997).
const WINDOW: f64 = 5.0;

/// Rows that count as one: 1 + 2 x the sum of the correlations, over the shortest window that holds five of them; at least 1.
pub fn correlation_time(rows: &[f64]) -> f64 {
    let power: f64 = rows.iter().map(|x| x * x).sum();
    if !(power > 0.0) {
        return 1.0;
    }
    let mut time = 1.0;
    for lag in 1..rows.len() / 2 {
        let product: f64 = rows.iter().skip(lag).zip(rows).map(|(a, b)| a * b).sum();
        time += 2.0 * product / power;
        if lag as f64 >= WINDOW * time {
            break;
        }
    }
    time.clamp(1.0, rows.len() as f64 / 2.0)
}

pub fn effective_rows(rows: &[f64]) -> f64 {
    rows.len() as f64 / correlation_time(rows)
}
