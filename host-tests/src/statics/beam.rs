//! Timoshenko beam element and the screw's section reduced by its groove: Lin 2019, appendices C and D.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::SMatrix;

use super::geometry::Geometry;
use crate::error::ReferenceError;
use crate::material::Elastic;

/// Stiffnesses of a circular cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// `EA`, N.
    pub axial: f64,
    /// `EI`, N m².
    pub bending: f64,
    /// `GJ`, N m².
    pub torsion: f64,
    /// `kappa G A`, N, with `kappa = 6 (1 + nu) / (7 + 6 nu)`, eq. (C.3).
    pub shear: f64,
}

/// Factor `k_r` on the outer diameter that takes the groove's volume off, eq. (C.4)-(C.8).
///
/// The printed (C.4) needs `D_2 = (r_G - r_B) cos(beta) + R_P - D_out/2 <= r_G`, which holds where the nominal contact lies on the screw.
pub fn groove_reduction(geometry: &Geometry, outer_diameter: f64) -> Result<f64, ReferenceError> {
    let (sin, cos) = geometry.contact_angle.sin_cos();
    let radius = geometry.groove_radius;
    let across = geometry.excess() * sin;
    let depth = geometry.excess() * cos + geometry.pitch_radius - 0.5 * outer_diameter;
    if depth < 0.0 {
        return Err(ReferenceError::input(
            "screw_diameter",
            "the screw encloses the ball path",
        ));
    }
    let contact = geometry.pitch_radius - geometry.ball_radius * cos;
    if 0.5 * outer_diameter < contact || depth >= radius {
        return Err(ReferenceError::input(
            "screw_diameter",
            format!("{outer_diameter}: the balls touch the screw at a radius of {contact}"),
        ));
    }
    let first = (across / radius).asin();
    let second = FRAC_PI_2 - (depth / radius).asin();
    let half_area = 0.5 * radius * radius * (second - first)
        - 0.5 * (radius * second.sin() - across) * depth
        - 0.5 * (radius * first.cos() - depth) * across;
    if half_area <= 0.0 || geometry.lead <= 0.0 {
        return Ok(1.0);
    }
    let removed = 2.0 * half_area * (TAU * geometry.pitch_radius).hypot(geometry.lead);
    let whole = PI * (0.5 * outer_diameter).powi(2) * geometry.lead;
    let square = 1.0 - removed / whole;
    if square < 0.25 {
        return Err(ReferenceError::input(
            "screw_diameter",
            "the groove takes half of the diameter or more",
        ));
    }
    Ok(square.sqrt())
}

impl Section {
    /// A circular section of this diameter, m.
    pub fn circular(diameter: f64, elastic: Elastic) -> Self {
        let area = PI * (0.5 * diameter).powi(2);
        let second_moment = 0.25 * PI * (0.5 * diameter).powi(4);
        let nu = elastic.poisson_ratio;
        let kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
        Self {
            axial: elastic.youngs_modulus * area,
            bending: elastic.youngs_modulus * second_moment,
            torsion: elastic.shear_modulus() * 2.0 * second_moment,
            shear: kappa * elastic.shear_modulus() * area,
        }
    }

    /// `Phi = 12 EI / (kappa G A L²)`, the share of shear in bending.
    fn shear_share(&self, length: f64) -> f64 {
        12.0 * self.bending / (self.shear * length * length)
    }

    /// Stiffness of an element, for the displacements and rotations `(x, y, z)` of its two nodes.
    ///
    /// (D.1) as printed, four times the same block, has no equilibrium of moments: the off-diagonal
    /// block holds `EI (2 - Phi) / (L (1 + Phi))` and the couplings `6 EI / L²` with their own signs. In (D.2) the fifth number of
    /// the diagonal is `EI (4 + Phi) / (L (1 + Phi))` as the fourth one, for the printed `6 EI / (L² (1 + Phi))`.
    pub fn stiffness(&self, length: f64) -> SMatrix<f64, 12, 12> {
        let mut k = SMatrix::<f64, 12, 12>::zeros();
        let mut pair = |first: usize, second: usize, value: f64| {
            k[(first, first)] = value;
            k[(second, second)] = value;
            k[(first, second)] = -value;
            k[(second, first)] = -value;
        };
        pair(2, 8, self.axial / length);
        pair(5, 11, self.torsion / length);
        let phi = self.shear_share(length);
        let unit = self.bending / (1.0 + phi);
        let lateral = 12.0 * unit / length.powi(3);
        let coupling = 6.0 * unit / (length * length);
        let near = (4.0 + phi) * unit / length;
        let far = (2.0 - phi) * unit / length;
        // A lateral displacement and the rotation that tilts the axis towards it:
        // u_x' = theta_y, u_y' = -theta_x.
        for (shift, turn, sign) in [(0, 4, 1.0), (1, 3, -1.0)] {
            pair_bending(&mut k, [shift, turn], lateral, sign * coupling, near, far);
        }
        k
    }

    /// Displacement and rotation at the fraction `xi` of an element from those of its nodes, (C.1), (C.2).
    pub fn shape(&self, xi: f64, length: f64) -> SMatrix<f64, 6, 12> {
        let phi = self.shear_share(length);
        let scale = 1.0 / (1.0 + phi);
        let (xi2, xi3) = (xi * xi, xi * xi * xi);
        let shift_far = -scale * (2.0 * xi3 - 3.0 * xi2 - phi * xi);
        let shift_near = scale * (2.0 * xi3 - 3.0 * xi2 - phi * xi + 1.0 + phi);
        let turn_near = length * scale * (xi3 - (2.0 + 0.5 * phi) * xi2 + (1.0 + 0.5 * phi) * xi);
        let turn_far = length * scale * (xi3 - (1.0 - 0.5 * phi) * xi2 - 0.5 * phi * xi);
        let tilt = -6.0 * scale / length * (xi2 - xi);
        let tilt_near = scale * (3.0 * xi2 - (4.0 + phi) * xi + 1.0 + phi);
        let tilt_far = scale * (3.0 * xi2 - (2.0 - phi) * xi);

        let mut n = SMatrix::<f64, 6, 12>::zeros();
        for (shift, turn, sign) in [(0, 4, 1.0), (1, 3, -1.0)] {
            n[(shift, shift)] = shift_near;
            n[(shift, turn)] = sign * turn_near;
            n[(shift, 6 + shift)] = shift_far;
            n[(shift, 6 + turn)] = sign * turn_far;
            n[(turn, shift)] = -sign * tilt;
            n[(turn, turn)] = tilt_near;
            n[(turn, 6 + shift)] = sign * tilt;
            n[(turn, 6 + turn)] = tilt_far;
        }
        for line in [2, 5] {
            n[(line, line)] = 1.0 - xi;
            n[(line, 6 + line)] = xi;
        }
        n
    }
}

fn pair_bending(
    k: &mut SMatrix<f64, 12, 12>,
    [shift, turn]: [usize; 2],
    lateral: f64,
    coupling: f64,
    near: f64,
    far: f64,
) {
    let dofs = [shift, turn, 6 + shift, 6 + turn];
    let block = [
        [lateral, coupling, -lateral, coupling],
        [coupling, near, -coupling, far],
        [-lateral, -coupling, lateral, -coupling],
        [coupling, far, -coupling, near],
    ];
    for (row, values) in dofs.iter().zip(block) {
        for (column, value) in dofs.iter().zip(values) {
            k[(*row, *column)] = value;
        }
    }
}
