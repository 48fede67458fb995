//! Friction split into grooves and balls, and which balls press on each other, as Lin 2019, Figures 3.24
//! and 3.25.

use crate::failure::Failure;
use crate::plot::thin;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// Moments at which contacts are marked, at most.
const MOMENTS: usize = 500;

/// A train at one moment.
#[derive(Clone, Copy, Debug)]
pub struct TrainPoint {
    /// Place along the horizontal axis.
    pub place: f64,
    /// Friction from the grooves.
    pub groove: f32,
    /// Friction from balls that rub against each other.
    pub ball: f32,
    /// The sum of both, within its limit.
    pub friction: f32,
    /// The same by the reference.
    pub reference: Option<f64>,
    /// Pairs of balls that press on each other.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// Balls that press on the one in front, one bit each.
    pub pressing: u64,
}

/// What stands beside the axes.
pub struct Labels {
    /// Above the first panel.
    pub title: String,
    /// Horizontal axes.
    pub place: &'static str,
    /// Vertical axis of the friction.
    pub friction: &'static str,
}

/// Draws the panels: contacts, friction, and the largest force.
pub fn draw(labels: Labels, points: &[TrainPoint]) -> Result<String, Failure> {
    let curve = |value: &dyn Fn(&TrainPoint) -> f64| thin(points, &|point| point.place, value);
    let line =
        |value: &dyn Fn(&TrainPoint) -> f64| vec![Series::new("", 0, Mark::Line, curve(value))];
    let mut friction = vec![
        Series::new(
            "grooves",
            0,
            Mark::Line,
            curve(&|point| point.groove.into()),
        ),
        Series::new(
            "ball to ball",
            1,
            Mark::Line,
            curve(&|point| point.ball.into()),
        ),
        Series::new("sum", 6, Mark::Line, curve(&|point| point.friction.into())),
    ];
    if points
        .first()
        .is_some_and(|point| point.reference.is_some())
    {
        friction.push(Series::new(
            "sum, reference in f64",
            2,
            Mark::Dashed,
            curve(&|point| point.reference.unwrap_or(f64::NAN)),
        ));
    }
    let ends = points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point.place), high.max(point.place))
        });
    let Labels {
        title,
        place,
        friction: friction_label,
    } = labels;
    let panels = [
        (
            title,
            "ball that presses on the next",
            vec![Series::new("", 0, Mark::Circles, marks(points))],
        ),
        (String::new(), friction_label, friction),
        (
            String::new(),
            "ball-to-ball contacts",
            line(&|point| point.contacts.into()),
        ),
        (
            String::new(),
            "largest force between balls (N)",
            line(&|point| point.largest_contact_force.into()),
        ),
    ]
    .map(|(title, y, series)| {
        Panel::Chart(Chart {
            title,
            x: Axis::linear(place).between(ends.0, ends.1),
            y: Axis::linear(y),
            series,
            notes: Vec::new(),
        })
    });
    render(&panels, 1, (1000, 300))
}

/// A mark for each ball that presses, counted from one.
fn marks(points: &[TrainPoint]) -> Vec<(f64, f64)> {
    let stride = points.len().div_ceil(MOMENTS).max(1);
    points
        .iter()
        .step_by(stride)
        .flat_map(|point| {
            (0..u64::BITS)
                .filter(|ball| point.pressing >> ball & 1 == 1)
                .map(|ball| (point.place, f64::from(ball + 1)))
        })
        .collect()
}
