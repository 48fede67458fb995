//! The kernel `phi(u) = c (1 - u^2)^4`, `u = t/L` in -1 to 1, and its first three derivatives.

/// Sampled kernel with its derivatives, as weights of the samples around a centre.
///
/// The lowest moments are exact at every length: `sum phi = 1`; `sum phi_1 t = 1`; `sum phi_2 = 0`, `sum phi_2 t^2/2 = 1`;
/// `sum phi_3 t = 0`, `sum phi_3 t^3/6 = 1`, where `phi_k` gives the `k`-th derivative of what it weighs. Sampled derivatives alone leave an
/// inertia 60 % low at eight samples.
#[derive(Clone, Debug)]
pub struct Kernel {
    half: usize,
    tick: f64,
    weights: [Vec<f64>; 4],
}

fn scale(weights: &mut [f64], factor: f64) {
    for weight in weights {
        *weight *= factor;
    }
}

impl Kernel {
    /// Of `half` samples to each side, 1 or more, of a tick, s.
    pub fn new(half: usize, tick: f64) -> Self {
        let half = half.max(1);
        let n = half as f64 + 1.0;
        let length = n * tick;
        let at = |k: usize| k as f64 - half as f64;
        let sampled = |of: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            let values = (0..=2 * half).map(|k| {
                let u = at(k) / n;
                of(u, 1.0 - u * u)
            });
            values.collect()
        };
        let moment = |weights: &[f64], power: i32| -> f64 {
            let terms = weights.iter().enumerate();
            terms.map(|(k, w)| w * (at(k) * tick).powi(power)).sum()
        };
        let mut phi = sampled(&|_, v| v.powi(4));
        let sum = moment(&phi, 0);
        scale(&mut phi, 1.0 / sum);
        // A correlation with phi' is minus the derivative, one with phi'' the second one, one with phi''' minus the third.
        let mut first = sampled(&|u, v| 8.0 * u * v.powi(3) / (sum * length));
        let mut second =
            sampled(&|u, v| (48.0 * u * u * v.powi(2) - 8.0 * v.powi(3)) / (sum * length.powi(2)));
        let mut third = sampled(&|u, v| {
            (192.0 * u.powi(3) * v - 144.0 * u * v.powi(2)) / (sum * length.powi(3))
        });
        let slope = moment(&first, 1);
        scale(&mut first, 1.0 / slope);
        let mean = moment(&second, 0);
        for (w, phi) in second.iter_mut().zip(&phi) {
            *w -= mean * phi;
        }
        let curvature = moment(&second, 2) / 2.0;
        scale(&mut second, 1.0 / curvature);
        let slope = moment(&third, 1);
        for (w, first) in third.iter_mut().zip(&first) {
            *w -= slope * first;
        }
        let jerk = moment(&third, 3) / 6.0;
        scale(&mut third, 1.0 / jerk);
        Self {
            half,
            tick,
            weights: [phi, first, second, third],
        }
    }

    pub const fn tick(&self) -> f64 {
        self.tick
    }

    pub const fn half(&self) -> usize {
        self.half
    }

    /// Weights of a derivative, 0 to 3, of `2 half + 1` samples.
    pub fn weights(&self, order: usize) -> &[f64] {
        &self.weights[order]
    }

    /// A derivative, 0 to 3, of a signal at a sample; what is beyond an end of the signal counts as the end.
    pub fn at(&self, order: usize, signal: &[f64], centre: usize) -> f64 {
        let weights = &self.weights[order];
        if let Some(first) = centre.checked_sub(self.half)
            && let Some(window) = signal.get(first..=centre + self.half)
        {
            return weights.iter().zip(window).map(|(w, x)| w * x).sum();
        }
        let last = signal.len().saturating_sub(1);
        let places = weights.iter().enumerate();
        places
            .map(|(k, w)| {
                let place = (centre + k).saturating_sub(self.half).min(last);
                w * signal.get(place).copied().unwrap_or(0.0)
            })
            .sum()
    }

    pub fn along(&self, order: usize, signal: &[f64]) -> Vec<f64> {
        (0..signal.len())
            .map(|centre| self.at(order, signal, centre))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic has exactly its own derivatives at every length; a sine those of a short filter.
    #[test]
    fn derivatives_are_those_of_polynomials() {
        let tick = 2e-3;
        for half in [2, 4, 8, 50] {
            let kernel = Kernel::new(half, tick);
            let time = |k: usize| tick * (k as f64 - 60.0);
            let line: Vec<f64> = (0..121).map(|k| 3.0 + 2.0 * time(k)).collect();
            let square: Vec<f64> = (0..121).map(|k| time(k).powi(2)).collect();
            let cube: Vec<f64> = (0..121).map(|k| time(k).powi(3)).collect();
            let near =
                |found: f64, wanted: f64| (found - wanted).abs() < 1e-6 * wanted.abs().max(1e-3);
            assert!(near(kernel.at(0, &line, 60), 3.0), "{half}");
            assert!(near(kernel.at(1, &line, 60), 2.0), "{half}");
            assert!(near(kernel.at(2, &line, 60), 0.0), "{half}");
            assert!(near(kernel.at(2, &square, 60), 2.0), "{half}");
            assert!(near(kernel.at(3, &cube, 60), 6.0), "{half}");
            assert!(near(kernel.at(3, &square, 60), 0.0), "{half}");
        }
    }
}
