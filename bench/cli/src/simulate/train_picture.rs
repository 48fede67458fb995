//! Which balls press on each other, as Lin 2019, Figures 3.24 and 3.25, below the panels of every run.

use super::picture::{self, Form, Labels, Moment};
use epas_page::failure::Failure;
use epas_page::plot::{Mark, Panel, Series};

/// Moments at which contacts are marked, at most.
const MOMENTS: usize = 500;

/// A train at one moment.
#[derive(Clone, Copy, Debug)]
pub struct TrainPoint {
    /// What every run shows.
    pub moment: Moment,
    /// Pairs of balls that press on each other.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// Balls that press on the one in front, one bit each.
    pub pressing: u64,
}

/// Draws the panels of a run, then those of its balls.
pub fn draw(labels: &Labels, points: &[TrainPoint], form: Form) -> Result<String, Failure> {
    let moments: Vec<_> = points.iter().map(|point| point.moment).collect();
    let mut panels = picture::panels(labels, &moments, form);
    let ends = picture::ends(&moments);
    let curve =
        |value: &dyn Fn(&TrainPoint) -> f64| form.curve(points, &|point| point.moment.place, value);
    let panel = |label: &str, mark, points| -> Panel {
        let series = vec![Series::new("", 0, mark, points)];
        picture::chart("", labels.place, ends, label, series)
    };
    panels.extend([
        panel("ball that presses on the next", Mark::Dots, marks(points)),
        panel(
            "ball-to-ball contacts",
            Mark::Line,
            curve(&|point| point.contacts.into()),
        ),
        panel(
            "largest force between balls (N)",
            Mark::Line,
            curve(&|point| point.largest_contact_force.into()),
        ),
    ]);
    form.draw(&labels.title, &panels)
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
                .map(|ball| (point.moment.place, f64::from(ball + 1)))
        })
        .collect()
}
