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

/// The points of a line without those that a straight line between two that stay passes within `tolerance` above or below:
/// fewer points that look the same. Where the line does not go on to the right, every point stays.
pub fn straightened(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let Some(&first) = points.first() else {
        return Vec::new();
    };
    const ANY: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut kept = vec![first];
    let (mut anchor, mut last) = (first, first);
    // Slopes from the anchor that pass all points since then.
    let mut slopes = ANY;
    for &point in &points[1..] {
        let slope = |to: f64, from: (f64, f64)| (to - from.1) / (point.0 - from.0);
        let ahead = point.0 > anchor.0;
        let passes = ahead && (slopes.0..=slopes.1).contains(&slope(point.1, anchor));
        if !passes && last != anchor {
            kept.push(last);
            anchor = last;
            slopes = ANY;
        }
        if point.0 > anchor.0 {
            slopes.0 = slopes.0.max(slope(point.1 - tolerance, anchor));
            slopes.1 = slopes.1.min(slope(point.1 + tolerance, anchor));
        } else {
            kept.push(point);
            anchor = point;
            slopes = ANY;
        }
        last = point;
    }
    if last != anchor {
        kept.push(last);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_points_pass_all_the_others() {
        const TOLERANCE: f64 = 1e-3;
        let points: Vec<_> = (0..2000)
            .map(|index| f64::from(index) / 300.0)
            .map(|x| (x, x.sin()))
            .collect();
        let kept = straightened(&points, TOLERANCE);
        assert!(kept.len() < 200, "{}", kept.len());
        assert_eq!((kept.first(), kept.last()), (points.first(), points.last()));
        for point in &points {
            let above = kept.partition_point(|other| other.0 < point.0).max(1);
            let (from, to) = (kept[above - 1], kept[above]);
            let between = from.1 + (to.1 - from.1) * (point.0 - from.0) / (to.0 - from.0);
            // Rounding of the slopes comes to it.
            assert!((between - point.1).abs() < TOLERANCE + 1e-12, "{point:?}");
        }
    }

    #[test]
    fn steps_and_loops_stay() {
        let steps = [(0.0, 0.0), (1.0, 0.0), (1.0, 5.0), (2.0, 5.0), (0.5, 5.0)];
        assert_eq!(straightened(&steps, 0.1), steps);
        let straight = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)];
        assert_eq!(straightened(&straight, 0.1), [(0.0, 0.0), (2.0, 2.0)]);
        assert!(straightened(&[], 0.1).is_empty());
    }
}
