//! Constants of the peers, fitted: the least rms error over first loading and loops at 0.3, 0.7, 1 and 3 breakaway angles, by the simplex of Nelder and
//! Mead from a fixed start.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;
use epas_reference::presliding::Limits;
use epas_reference::presliding::backbone::Backbone;
use epas_reference::presliding::masing::Masing;

use super::paths::Course;
use super::{Law, torques};
use epas_page::failure::Failure;

/// Amplitudes of the loops, over the breakaway angle.
pub const AMPLITUDES: [f64; 4] = [0.3, 0.7, 1.0, 3.0];

/// Exact torques of slip across over a path under constant limits.
pub fn exact(angle: &[f64]) -> Vec<f64> {
    let mut exact = Masing::new(Backbone::Slip, Limits::UNIT);
    angle.iter().map(|angle| exact.follow(*angle)).collect()
}

/// Root mean square of the differences.
pub fn rms(found: &[f64], exact: &[f64]) -> f64 {
    let squares = found
        .iter()
        .zip(exact)
        .map(|(one, other)| (one - other).powi(2));
    (squares.sum::<f64>() / exact.len() as f64).sqrt()
}

struct Problem<'a> {
    make: &'a dyn Fn(&[f64]) -> Box<dyn Law>,
    loops: Vec<(Course, Vec<f64>)>,
}

impl CostFunction for Problem<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    /// Constants are given by their logarithms, which keeps them positive.
    fn cost(&self, logarithms: &Self::Param) -> Result<Self::Output, argmin::core::Error> {
        let constants: Vec<_> = logarithms.iter().map(|value| value.exp()).collect();
        let errors = self.loops.iter().map(|(course, exact)| {
            let found = torques((self.make)(&constants).as_mut(), &course.path());
            rms(&found, exact).powi(2)
        });
        let mean = errors.sum::<f64>() / self.loops.len() as f64;
        // A law that diverges is no candidate.
        Ok(if mean.is_finite() { mean.sqrt() } else { 1e9 })
    }
}

/// The best positive constants, from these on.
pub fn fitted(start: &[f64], make: &dyn Fn(&[f64]) -> Box<dyn Law>) -> Result<Vec<f64>, Failure> {
    let loops = AMPLITUDES
        .iter()
        .map(|amplitude| {
            let course = Course::cycles(*amplitude, 2, 40);
            let exact = exact(&course.angle);
            (course, exact)
        })
        .collect();
    let start: Vec<f64> = start.iter().map(|value| value.ln()).collect();
    let mut simplex = vec![start.clone()];
    for place in 0..start.len() {
        let mut corner = start.clone();
        corner[place] += 0.25;
        simplex.push(corner);
    }
    let failed = |error: argmin::core::Error| Failure::Data(format!("a peer's fit: {error}"));
    let solver = NelderMead::new(simplex)
        .with_sd_tolerance(1e-7)
        .map_err(failed)?;
    let result = Executor::new(Problem { make, loops }, solver)
        .configure(|state| state.max_iters(1500))
        .run()
        .map_err(failed)?;
    let best = result
        .state()
        .get_best_param()
        .ok_or_else(|| Failure::Data("a peer's fit found nothing".into()))?;
    Ok(best.iter().map(|value| value.exp()).collect())
}
