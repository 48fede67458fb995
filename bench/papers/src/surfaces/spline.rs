//! Cubic splines: interpolation with two continuous derivatives.

use nalgebra::DMatrix;
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};

use epas_reference::error::ReferenceError;
use epas_reference::statics::surface::Deviation;

/// What happens at the ends of the knots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// No second derivative; beyond the ends the spline goes on as a straight line, which keeps both
    /// derivatives continuous.
    Natural,
    /// Repeats itself with this period, which the knots must not reach.
    Periodic(f64),
}

/// Knots of cubic splines with their factored equations for the second derivatives.
#[derive(Debug)]
pub struct Knots {
    places: Vec<f64>,
    ends: Ends,
    factor: Option<CscCholesky<f64>>,
}

impl Knots {
    /// Knots at rising places.
    ///
    /// # Errors
    /// [`ReferenceError`] naming `field` where the places do not rise, are not finite, or go round
    /// further than the period.
    pub fn new(field: &'static str, places: Vec<f64>, ends: Ends) -> Result<Self, ReferenceError> {
        let rising = places
            .windows(2)
            .all(|pair| pair[1] - pair[0] > 1e-12 * (pair[0].abs() + pair[1].abs()));
        let (Some(first), Some(last)) = (places.first(), places.last()) else {
            return Err(ReferenceError::input(field, "there are none"));
        };
        if !rising || !first.is_finite() || !last.is_finite() {
            return Err(ReferenceError::input(
                field,
                "must rise from one to the next without repetition",
            ));
        }
        if let Ends::Periodic(period) = ends
            && !(period.is_finite() && last - first < period * (1.0 - 1e-9))
        {
            return Err(ReferenceError::input(
                field,
                format!("from {first} to {last} is not within one period of {period}"),
            ));
        }
        let mut knots = Self {
            places,
            ends,
            factor: None,
        };
        knots.factor = knots
            .equations()
            .map(|matrix| {
                CscCholesky::factor(&matrix)
                    .map_err(|error| ReferenceError::input(field, error.to_string()))
            })
            .transpose()?;
        Ok(knots)
    }

    fn count(&self) -> usize {
        self.places.len()
    }

    /// Length of the interval after a knot.
    fn length(&self, knot: usize) -> f64 {
        match (self.places.get(knot + 1), self.ends) {
            (Some(next), _) => next - self.places[knot],
            (None, Ends::Periodic(period)) => self.places[0] + period - self.places[knot],
            (None, Ends::Natural) => 0.0,
        }
    }

    /// Knots whose second derivative is unknown: all on a ring of at least two, all but the ends of a row.
    fn unknown(&self) -> std::ops::Range<usize> {
        match self.ends {
            Ends::Periodic(_) if self.count() > 1 => 0..self.count(),
            Ends::Natural if self.count() > 2 => 1..self.count() - 1,
            _ => 0..0,
        }
    }

    /// `h1 m1 + 2 (h1 + h2) m2 + h2 m3 = 6 (slope after - slope before)`.
    fn equations(&self) -> Option<CscMatrix<f64>> {
        let unknown = self.unknown();
        if unknown.is_empty() {
            return None;
        }
        let first = unknown.start;
        let mut matrix = CooMatrix::new(unknown.len(), unknown.len());
        for knot in unknown.clone() {
            let before = self.length(self.previous(knot));
            let after = self.length(knot);
            matrix.push(knot - first, knot - first, 2.0 * (before + after));
            let next = (knot + 1) % self.count();
            if unknown.contains(&next) {
                matrix.push(knot - first, next - first, after);
                matrix.push(next - first, knot - first, after);
            }
        }
        Some(CscMatrix::from(&matrix))
    }

    fn previous(&self, knot: usize) -> usize {
        (knot + self.count() - 1) % self.count()
    }

    /// Second derivatives at the knots of the spline through these values.
    #[must_use]
    pub fn moments(&self, values: &[f64]) -> Vec<f64> {
        let mut moments = vec![0.0; self.count()];
        let Some(factor) = &self.factor else {
            return moments;
        };
        let unknown = self.unknown();
        let slope =
            |knot: usize| (values[(knot + 1) % self.count()] - values[knot]) / self.length(knot);
        let right = DMatrix::from_iterator(
            unknown.len(),
            1,
            unknown
                .clone()
                .map(|knot| 6.0 * (slope(knot) - slope(self.previous(knot)))),
        );
        for (moment, solved) in moments[unknown].iter_mut().zip(factor.solve(&right).iter()) {
            *moment = *solved;
        }
        moments
    }

    /// Where a place lies between the knots, with the weights of the two around it.
    fn bracket(&self, place: f64) -> Bracket {
        let last = self.count() - 1;
        let (start, end) = (self.places[0], self.places[last]);
        let place = match self.ends {
            Ends::Periodic(period) => start + (place - start).rem_euclid(period),
            Ends::Natural => place,
        };
        if last == 0 && matches!(self.ends, Ends::Natural) {
            return Bracket::single(0);
        }
        if matches!(self.ends, Ends::Natural) && (place < start || place > end) {
            let (knot, from) = if place < start {
                (0, place - start)
            } else {
                (last - 1, place - self.places[last - 1])
            };
            return Bracket::of(knot, knot + 1, from, self.length(knot), true);
        }
        let knot = self
            .places
            .partition_point(|knot| *knot <= place)
            .saturating_sub(1);
        let knot = if matches!(self.ends, Ends::Natural) {
            knot.min(last - 1)
        } else {
            knot
        };
        Bracket::of(
            knot,
            (knot + 1) % self.count(),
            place - self.places[knot],
            self.length(knot),
            false,
        )
    }
}

/// Two neighbouring knots, with the weights of their values and moments in the value, the slope and the
/// second derivative.
#[derive(Clone, Copy, Debug)]
struct Bracket {
    knots: [usize; 2],
    values: [[f64; 2]; 3],
    moments: [[f64; 2]; 3],
}

impl Bracket {
    fn single(knot: usize) -> Self {
        Self {
            knots: [knot, knot],
            values: [[1.0, 0.0], [0.0; 2], [0.0; 2]],
            moments: [[0.0; 2]; 3],
        }
    }

    /// `from` after the first knot of an interval; `outside` continues the end's straight line.
    fn of(first: usize, second: usize, from: f64, length: f64, outside: bool) -> Self {
        let share = from / length;
        let rest = 1.0 - share;
        let values = [[rest, share], [-1.0 / length, 1.0 / length], [0.0; 2]];
        let square = length * length / 6.0;
        let moments = if outside {
            // Straight on from the end: the slope there, no second derivative.
            let (slope, over) = if from < 0.0 {
                ([-length / 3.0, -length / 6.0], from)
            } else {
                ([length / 6.0, length / 3.0], from - length)
            };
            [slope.map(|slope| slope * over), slope, [0.0; 2]]
        } else {
            [
                [
                    (rest * rest * rest - rest) * square,
                    (share * share * share - share) * square,
                ],
                [
                    (1.0 - 3.0 * rest * rest) * length / 6.0,
                    (3.0 * share * share - 1.0) * length / 6.0,
                ],
                [rest, share],
            ]
        };
        Self {
            knots: [first, second],
            values,
            moments,
        }
    }

    fn sum(
        &self,
        order: usize,
        value: impl Fn(usize) -> f64,
        moment: impl Fn(usize) -> f64,
    ) -> f64 {
        self.knots
            .iter()
            .zip(self.values[order].iter().zip(&self.moments[order]))
            .map(|(knot, (of_value, of_moment))| {
                of_value * value(*knot) + of_moment * moment(*knot)
            })
            .sum()
    }
}

/// A cubic spline.
#[derive(Debug)]
pub struct Spline {
    knots: Knots,
    values: Vec<f64>,
    moments: Vec<f64>,
}

impl Spline {
    /// The spline through these values.
    ///
    /// # Errors
    /// [`ReferenceError`] naming `field` where the number of values is not that of knots, or one is not
    /// finite.
    pub fn new(
        field: &'static str,
        knots: Knots,
        values: Vec<f64>,
    ) -> Result<Self, ReferenceError> {
        if values.len() != knots.count() || !values.iter().all(|value| value.is_finite()) {
            return Err(ReferenceError::input(
                field,
                "must be a finite value for each knot",
            ));
        }
        let moments = knots.moments(&values);
        Ok(Self {
            knots,
            values,
            moments,
        })
    }

    /// Value, first and second derivative at any place.
    #[must_use]
    pub fn at(&self, place: f64) -> [f64; 3] {
        let bracket = self.knots.bracket(place);
        [0, 1, 2]
            .map(|order| bracket.sum(order, |knot| self.values[knot], |knot| self.moments[knot]))
    }

    /// Value and derivatives as a surface's offset.
    pub(crate) fn offset(&self, section_angle: f64) -> Deviation {
        let [offset, slope, bend] = self.at(section_angle);
        Deviation {
            offset,
            slope,
            bend,
            ..Deviation::default()
        }
    }
}

/// Weights of the values at given knots in the spline through them, at any place.
#[derive(Debug)]
pub struct CardinalSplines {
    knots: Knots,
    /// Moments of the spline through 1 at one knot and 0 at all others, by that knot.
    moments: Vec<Vec<f64>>,
}

impl CardinalSplines {
    /// For these knots.
    #[must_use]
    pub fn new(knots: Knots) -> Self {
        let mut unit = vec![0.0; knots.count()];
        let moments = (0..knots.count())
            .map(|knot| {
                unit[knot] = 1.0;
                let moments = knots.moments(&unit);
                unit[knot] = 0.0;
                moments
            })
            .collect();
        Self { knots, moments }
    }

    /// One weight for each knot.
    #[must_use]
    pub fn weights(&self, place: f64) -> Vec<f64> {
        let bracket = self.knots.bracket(place);
        self.moments
            .iter()
            .enumerate()
            .map(|(knot, moments)| {
                bracket.sum(0, |at| f64::from(u8::from(at == knot)), |at| moments[at])
            })
            .collect()
    }
}
