//! One ball on a straight track in f64: the least exact dissipation, by damped Newton iteration.

use crate::exact_friction::quadrature;

#[derive(Clone, Copy)]
pub struct ExactMap {
    axis_ratio: f64,
    quartic: [f64; 3],
}

impl ExactMap {
    pub fn new(axis_ratio: f64) -> Self {
        let [_, _, centre] = quadrature(axis_ratio, 0.0, 2000);
        let [slope, _, rim] = quadrature(axis_ratio, 1.0, 2000);
        let fourth = 0.5 * slope - (rim - centre);
        let map = Self {
            axis_ratio,
            quartic: [centre, rim - centre - fourth, fourth],
        };
        // That three numbers describe the whole inside is what the quadrature itself must say.
        for x in [0.2, 0.55, 0.83] {
            let exact = quadrature(axis_ratio, x, 2000);
            for (value, exact) in map.at(x).into_iter().zip(exact) {
                assert!((value - exact).abs() < 1e-9, "{x}: {value} {exact}");
            }
        }
        map
    }

    /// Force, moment, power.
    pub fn at(&self, x: f64) -> [f64; 3] {
        if x.abs() > 1.0 {
            return quadrature(self.axis_ratio, x.clamp(-1e6, 1e6), 120);
        }
        let [p0, p2, p4] = self.quartic;
        let square = x * x;
        let force = x * (2.0 * p2 + 4.0 * p4 * square);
        let power = p0 + square * (p2 + p4 * square);
        [force, power - x * force, power]
    }
}

pub struct ExactBall {
    pub map: ExactMap,
    pub friction: f64,
    /// Semi-major axis over ball radius at one newton.
    pub semi_major: f64,
    pub angles: [f64; 4],
    pub forces: [f64; 4],
}

impl ExactBall {
    /// Slip and spin of a contact as rows of `(1, v_B/v, R_B omega_x/v, R_B omega_y/v)`: Lin 2019, eqs.
    /// (3.23), (F.1)-(F.3).
    fn rows(&self, contact: usize) -> [[f64; 4]; 2] {
        let (sin, cos) = self.angles[contact].sin_cos();
        match contact {
            0 => [[0.0, 1.0, -cos, sin], [0.0, 0.0, sin, cos]],
            1 => [[0.0, 1.0, -cos, -sin], [0.0, 0.0, -sin, cos]],
            2 => [[-1.0, 1.0, cos, -sin], [0.0, 0.0, -sin, -cos]],
            _ => [[-1.0, 1.0, cos, sin], [0.0, 0.0, sin, -cos]],
        }
    }

    /// Dissipation over the track speed, its gradient and Hessian with `w` as `sqrt(w² + stick²)`.
    fn dissipation(&self, y: [f64; 3], stick: f64) -> (f64, [f64; 3], [[f64; 3]; 3]) {
        let (mut sum, mut gradient, mut hessian) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
        for contact in 0..4 {
            let load = self.friction * self.forces[contact];
            if load <= 0.0 {
                continue;
            }
            let semi_major = self.semi_major * self.forces[contact].cbrt();
            let rows = self.rows(contact);
            let [slip, spin] =
                rows.map(|row| row[0] + row[1] * y[0] + row[2] * y[1] + row[3] * y[2]);
            let full = spin.hypot(stick);
            let x = slip / (semi_major * full);
            let [force, moment, power] = self.map.at(x);
            let step = 1e-4 * x.abs().max(1.0);
            let slope = (self.map.at(x + step)[0] - self.map.at(x - step)[0]) / (2.0 * step);
            let stiffness = slope / (semi_major * full);
            let tilt = slip * spin / (full * full);
            let sticking = semi_major * moment * stick * stick / full.powi(3);
            sum += load * semi_major * full * power;
            for i in 0..3 {
                let slip_i = rows[0][i + 1];
                let spin_i = rows[1][i + 1];
                gradient[i] += load * (force * slip_i + semi_major * moment * spin / full * spin_i);
                for (j, entry) in hessian[i].iter_mut().enumerate() {
                    let (slip_j, spin_j) = (rows[0][j + 1], rows[1][j + 1]);
                    *entry += load
                        * (stiffness * (slip_i - tilt * spin_i) * (slip_j - tilt * spin_j)
                            + sticking * spin_i * spin_j);
                }
            }
        }
        (sum, gradient, hessian)
    }

    /// The motion of least dissipation under a force along the track, and that dissipation.
    pub fn solve(&self, axial_force: f64) -> ([f64; 3], f64) {
        // The dissipation is convex: one start, nominal rolling, is enough, while the stick spin goes down
        // in stages to where it no longer counts.
        let cos = self.angles.iter().map(|angle| angle.cos()).sum::<f64>() / 4.0;
        let mut y = [0.5, 0.5 / cos, 0.0];
        for stick in [1e-1, 1e-2, 1e-3, 1e-4, 1e-6] {
            y = self.descend(y, axial_force, stick);
        }
        (y, self.dissipation(y, 0.0).0)
    }

    fn descend(&self, mut y: [f64; 3], axial_force: f64, stick: f64) -> [f64; 3] {
        for _ in 0..60 {
            let (sum, mut gradient, mut hessian) = self.dissipation(y, stick);
            gradient[0] -= axial_force;
            let trace: f64 = (0..3).map(|i| hessian[i][i]).sum();
            for (i, row) in hessian.iter_mut().enumerate() {
                row[i] += 1e-9 * trace;
            }
            let step = solve3(hessian, gradient);
            let norm = step.iter().fold(0.0_f64, |max, s| max.max(s.abs()));
            if norm < 1e-13 {
                break;
            }
            let mut scale = (0.3 / norm).min(1.0);
            let merit = sum - axial_force * y[0];
            for _ in 0..40 {
                let trial = [0, 1, 2].map(|i| y[i] - scale * step[i]);
                let now = self.dissipation(trial, stick).0 - axial_force * trial[0];
                if now <= merit + 1e-15 * sum {
                    y = trial;
                    break;
                }
                scale *= 0.5;
            }
        }
        y
    }
}

fn solve3(m: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let det = |c: [[f64; 3]; 3]| {
        c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1])
            - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0])
            + c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0])
    };
    let whole = det(m);
    [0, 1, 2].map(|column| {
        let mut replaced = m;
        for (row, value) in replaced.iter_mut().zip(b) {
            row[column] = value;
        }
        det(replaced) / whole
    })
}
