//! Places of texts beside points: none over another, over a point, or outside the axes.

use super::style::{TICK_SIZE, px, text_width};

/// A rectangle, pixels as drawn: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    pub left: i32,
    /// Upper edge.
    pub top: i32,
    pub right: i32,
    /// Lower edge.
    pub bottom: i32,
}

impl Rect {
    /// A square around a point.
    pub const fn around((x, y): (i32, i32), half: i32) -> Self {
        Self {
            left: x - half,
            top: y - half,
            right: x + half,
            bottom: y + half,
        }
    }

    const fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    const fn holds(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }

    const fn contains(&self, (x, y): (i32, i32)) -> bool {
        self.left <= x && x <= self.right && self.top <= y && y <= self.bottom
    }

    /// Whether a segment passes through: between its ends it comes into all four half planes (Liang and Barsky 1984).
    fn is_crossed(&self, from: (i32, i32), to: (i32, i32)) -> bool {
        let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
        let edges = [
            (-dx, f64::from(from.0 - self.left)),
            (dx, f64::from(self.right - from.0)),
            (-dy, f64::from(from.1 - self.top)),
            (dy, f64::from(self.bottom - from.1)),
        ];
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (slope, distance) in edges {
            if slope == 0.0 {
                if distance < 0.0 {
                    return false;
                }
            } else if slope < 0.0 {
                enters = enters.max(distance / slope);
            } else {
                leaves = leaves.min(distance / slope);
            }
        }
        enters <= leaves
    }
}

/// What texts keep clear of.
pub struct Ground<'a> {
    /// The area between the axes.
    pub area: Rect,
    pub points: &'a [(i32, i32)],
    /// Lines; a text crosses them only where there is no other place.
    pub lines: &'a [Vec<(i32, i32)>],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Where it stands.
    pub place: Rect,
    /// Whether a line leads to its point, which is not right beside it.
    pub leads: bool,
}

/// Half the side of a mark, with some room.
const MARK: i32 = px(8);

/// Distances from a text to its point, the nearest first.
const DISTANCES: [i32; 6] = [px(10), px(22), px(38), px(58), px(84), px(120)];

/// Places for texts at points, in their order; none where there is no room.
pub fn place(notes: &[((i32, i32), &str)], ground: &Ground<'_>) -> Vec<Option<Placed>> {
    let marks: Vec<Rect> = ground
        .points
        .iter()
        .map(|point| Rect::around(*point, MARK))
        .collect();
    let mut taken: Vec<Rect> = Vec::new();
    notes
        .iter()
        .map(|(point, text)| {
            let free = |candidate: &Placed| {
                ground.area.holds(&candidate.place)
                    && !taken
                        .iter()
                        .chain(&marks)
                        .any(|other| other.meets(&candidate.place))
            };
            let clear = |candidate: &Placed| {
                !ground.lines.iter().any(|line| {
                    line.windows(2).any(|pair| match pair {
                        [from, to] => candidate.place.is_crossed(*from, *to),
                        _ => false,
                    })
                })
            };
            // A line to its point goes past other marks and texts.
            let leads_past = |candidate: &Placed| {
                let near = (
                    point.0.clamp(candidate.place.left, candidate.place.right),
                    point.1.clamp(candidate.place.top, candidate.place.bottom),
                );
                !candidate.leads
                    || !marks
                        .iter()
                        .any(|mark| !mark.contains(*point) && mark.is_crossed(*point, near))
            };
            let all = || candidates(*point, text).filter(free);
            let found = all()
                .find(|candidate| clear(candidate) && leads_past(candidate))
                .or_else(|| all().find(leads_past))
                .or_else(|| all().next());
            taken.extend(found.map(|found| found.place));
            found
        })
        .collect()
}

/// Places around a point: right, left, above and below in the middle, the corners, and above and below with an end at the point, in
/// growing distances.
fn candidates((x, y): (i32, i32), text: &str) -> impl Iterator<Item = Placed> {
    let (width, height) = (text_width(text, TICK_SIZE), TICK_SIZE * 11 / 10);
    DISTANCES
        .into_iter()
        .enumerate()
        .flat_map(move |(ring, far)| {
            let middle = (x - width / 2, y - height / 2);
            [
                (x + far, middle.1),
                (x - far - width, middle.1),
                (middle.0, y - far - height),
                (middle.0, y + far),
                (x + far, y - far - height),
                (x + far, y + far),
                (x - far - width, y - far - height),
                (x - far - width, y + far),
            ]
            .map(|(left, top)| Placed {
                place: Rect {
                    left,
                    top,
                    right: left + width,
                    bottom: top + height,
                },
                leads: ring > 1,
            })
            .into_iter()
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Rect = Rect {
        left: 0,
        top: 0,
        right: px(800),
        bottom: px(400),
    };

    #[test]
    fn texts_of_points_in_a_heap_keep_apart() {
        let points: Vec<_> = (0..12)
            .map(|index| (px(400 + 3 * index), px(200 + index % 3)))
            .collect();
        let notes: Vec<_> = points
            .iter()
            .map(|point| (*point, "warm impedance"))
            .collect();
        let ground = Ground {
            area: AREA,
            points: &points,
            lines: &[],
        };
        let placed: Vec<_> = place(&notes, &ground).into_iter().flatten().collect();
        assert_eq!(placed.len(), notes.len());
        for (index, one) in placed.iter().enumerate() {
            assert!(AREA.holds(&one.place), "{one:?}");
            for other in &placed[..index] {
                assert!(!one.place.meets(&other.place), "{one:?} over {other:?}");
            }
            for point in &points {
                assert!(!one.place.meets(&Rect::around(*point, px(5))), "{one:?}");
            }
        }
    }

    #[test]
    fn a_text_goes_round_a_line_and_stays_off_where_nothing_is_free() {
        let point = (px(400), px(200));
        let line = vec![point, (px(700), px(200))];
        let ground = Ground {
            area: AREA,
            points: &[point],
            lines: &[line],
        };
        let found = place(&[(point, "exact")], &ground)[0].unwrap();
        assert!(found.place.right < px(400), "{found:?}");

        let small = Ground {
            area: Rect::around(point, px(12)),
            ..ground
        };
        assert_eq!(place(&[(point, "exact")], &small), [None]);
    }

    #[test]
    fn a_segment_crosses_or_passes_by() {
        let square = Rect::around((0, 0), 10);
        assert!(square.is_crossed((-20, -20), (20, 20)));
        assert!(!square.is_crossed((-20, 0), (0, 25)));
        assert!(!square.is_crossed((11, -20), (11, 20)));
    }
}
