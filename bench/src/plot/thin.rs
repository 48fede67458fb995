//! Curves over many rows, thinned to what a picture can show.

/// Buckets of rows that a curve is thinned to: about the pixels of its width.
pub const BUCKETS: usize = 900;

/// A curve over rows, thinned to what a picture can show.
pub fn thin<Row>(
    rows: &[Row],
    place: &dyn Fn(&Row) -> f64,
    value: &dyn Fn(&Row) -> f64,
) -> Vec<(f64, f64)> {
    thin_to(BUCKETS, rows, place, value)
}

/// At most four points for each of so many buckets of rows: first, lowest, highest and last, in their order, so that no
/// peak is lost.
pub fn thin_to<Row>(
    buckets: usize,
    rows: &[Row],
    place: &dyn Fn(&Row) -> f64,
    value: &dyn Fn(&Row) -> f64,
) -> Vec<(f64, f64)> {
    let size = rows.len().div_ceil(buckets).max(1);
    let point = |row: &Row| (place(row), value(row));
    if size <= 4 {
        return rows.iter().map(point).collect();
    }
    let mut points = Vec::with_capacity(4 * buckets);
    for bucket in rows.chunks(size) {
        let by_value =
            |one: &(usize, &Row), other: &(usize, &Row)| value(one.1).total_cmp(&value(other.1));
        let numbered = || bucket.iter().enumerate();
        let mut kept: Vec<(usize, &Row)> = [
            numbered().next(),
            numbered().min_by(by_value),
            numbered().max_by(by_value),
            numbered().last(),
        ]
        .into_iter()
        .flatten()
        .collect();
        kept.sort_by_key(|(index, _)| *index);
        points.extend(kept.into_iter().map(|(_, row)| point(row)));
    }
    points
}
