//! Principal curvatures of gothic-arch grooves after Bertolino, De Martin, Mauro, Sorli 2023.
//!
//! [`Surface::principal`] is the reference: the Weingarten map of eq. (12)-(24) along the arc length of the ball path, in its Frenet frame,
//! regular up to a lead angle of 90 degrees. [`Surface::principal_cartesian`] is the same map as printed; [`Surface::appendix_b`] the
//! closed form of Appendix B with its two misprints corrected. The three are written separately.

use nalgebra::Vector3;

use crate::error::{ReferenceError, within};

/// Which groove.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Groove {
    /// The screw's (`zeta` = +1).
    Screw,
    /// The nut's (`zeta` = -1).
    Nut,
}

impl Groove {
    /// The paper's `zeta_sn`.
    pub const fn sign(self) -> f64 {
        match self {
            Self::Screw => 1.0,
            Self::Nut => -1.0,
        }
    }
}

/// Both principal curvatures, one over the unit of length; normal into the metal, `kappa1 > kappa2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalCurvatures {
    /// About along the ball path.
    pub kappa1: f64,
    /// About across the ball path.
    pub kappa2: f64,
}

/// A groove surface: a circular arc swept along a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Which groove.
    pub groove: Groove,
    /// Pitch radius `r_m`, any unit of length.
    pub pitch_radius: f64,
    /// Lead angle `alpha_e`, rad.
    pub lead_angle: f64,
    /// Radius `r_s` of the arc.
    pub groove_radius: f64,
    /// Offset `H` of the arc's centre along the normal.
    pub offset_h: f64,
    /// Offset `L` of the arc's centre along the binormal.
    pub offset_l: f64,
}

/// Groove radius and offsets from ball radius, conformity and nominal contact angle: eq. (2)-(4).
pub fn profile(ball_radius: f64, conformity: f64, contact_angle: f64) -> (f64, f64, f64) {
    let groove_radius = 2.0 * conformity * ball_radius;
    let excess = groove_radius - ball_radius;
    (
        groove_radius,
        excess * contact_angle.cos(),
        excess * contact_angle.sin(),
    )
}

/// First principal curvature by the formula of catalogues, eq. (27), (28).
pub fn literature(groove: Groove, pitch_radius: f64, ball_radius: f64, contact_angle: f64) -> f64 {
    let cos = contact_angle.cos();
    match groove {
        Groove::Screw => cos / (pitch_radius - ball_radius * cos),
        Groove::Nut => -cos / (pitch_radius + ball_radius * cos),
    }
}

/// First and second fundamental forms of a surface at a point, eq. (18)-(23), in the directions of
/// `S_phi` and of the part of the path's tangent that is orthogonal to it.
///
/// The change of basis makes `F` zero and keeps `E G - F²` a product: as a difference it cancels where the surface is about to fold.
struct Forms {
    first: [f64; 2],
    second: [f64; 3],
}

impl Forms {
    fn new(tangents: [Vector3<f64>; 2], second: [Vector3<f64>; 3], sense: f64) -> Self {
        let [along_phi, along_path] = tangents;
        let [phi_phi, phi_path, path_path] = second;
        let share = along_path.dot(&along_phi) / along_phi.norm_squared();
        let across_phi = along_path - share * along_phi;
        let normal = sense * across_phi.cross(&along_phi).normalize();
        let mixed = phi_path - share * phi_phi;
        let twice = path_path - share * (phi_path + mixed);
        Self {
            first: [along_phi.norm_squared(), across_phi.norm_squared()],
            second: [phi_phi.dot(&normal), mixed.dot(&normal), twice.dot(&normal)],
        }
    }

    /// The roots of eq. (24), `det(II - kappa I) = 0`: the root of larger magnitude by the formula,
    /// the other from their product, so that the small one keeps its digits.
    fn principal(&self) -> PrincipalCurvatures {
        let [e_first, g_first] = self.first;
        let [e, f, g] = self.second;
        let (along_phi, along_path) = (e / e_first, g / g_first);
        let twist = f * f / (e_first * g_first);
        let sum = along_phi + along_path;
        let product = along_phi * along_path - twist;
        let root = ((along_path - along_phi).powi(2) + 4.0 * twist).sqrt();
        if sum <= 0.0 {
            let kappa2 = 0.5 * (sum - root);
            PrincipalCurvatures {
                kappa1: product / kappa2,
                kappa2,
            }
        } else {
            let kappa1 = 0.5 * (sum + root);
            PrincipalCurvatures {
                kappa1,
                kappa2: product / kappa1,
            }
        }
    }
}

impl Surface {
    /// Checks that the numbers describe a surface that is regular at this contact angle.
    pub fn check(&self, contact_angle: f64) -> Result<(), ReferenceError> {
        let right_angle = std::f64::consts::FRAC_PI_2 + 1e-6;
        within("pitch_radius", self.pitch_radius, 1e-9, 1e9)?;
        within("lead_angle", self.lead_angle, 0.0, right_angle)?;
        within("contact_angle", contact_angle, 0.0, right_angle)?;
        within("groove_radius", self.groove_radius, 1e-9, 1e9)?;
        within("offset_h", self.offset_h, 0.0, self.groove_radius)?;
        within("offset_l", self.offset_l, 0.0, self.groove_radius)?;
        if 1.0 - self.path().0 * self.section(contact_angle).0 > 0.0 {
            return Ok(());
        }
        Err(ReferenceError::input(
            match self.groove {
                Groove::Screw => "groove_radius",
                Groove::Nut => "offset_h",
            },
            "the groove surface folds past the axis",
        ))
    }

    fn path(&self) -> (f64, f64) {
        let (sin, cos) = self.lead_angle.sin_cos();
        (cos * cos / self.pitch_radius, sin * cos / self.pitch_radius)
    }

    /// Coordinates of the surface point along normal and binormal, eq. (5) and (9).
    fn section(&self, contact_angle: f64) -> (f64, f64) {
        let (sin, cos) = contact_angle.sin_cos();
        (
            self.groove.sign() * (self.groove_radius * cos - self.offset_h),
            self.offset_l - self.groove_radius * sin,
        )
    }

    /// Both principal curvatures by the Weingarten map, in the Frenet frame and per arc length.
    pub fn principal(&self, contact_angle: f64) -> PrincipalCurvatures {
        let (curvature, torsion) = self.path();
        let (sin, cos) = contact_angle.sin_cos();
        let zeta = self.groove.sign();
        let radius = self.groove_radius;
        let (x, y) = self.section(contact_angle);
        let (x_phi, y_phi) = (-zeta * radius * sin, -radius * cos);

        // Derivative along the path of a vector with constant components in the moving frame
        // (t, n, b): t' = kappa n, n' = -kappa t + tau b, b' = -tau n.
        let transport = |v: Vector3<f64>| {
            Vector3::new(
                -curvature * v.y,
                curvature * v.x - torsion * v.z,
                torsion * v.y,
            )
        };
        let along_phi = Vector3::new(0.0, x_phi, y_phi);
        let along_path = Vector3::x() + transport(Vector3::new(0.0, x, y));
        let phi_phi = Vector3::new(0.0, -zeta * radius * cos, radius * sin);
        let phi_path = transport(along_phi);
        let path_path = transport(along_path);
        // The frame's n points to the axis; S_path x S_phi points into the screw's metal, out of the nut's.
        Forms::new(
            [along_phi, along_path],
            [phi_phi, phi_path, path_path],
            zeta,
        )
        .principal()
    }

    /// Point of the surface, eq. (7) and (10).
    pub fn point(&self, azimuth: f64, contact_angle: f64) -> Vector3<f64> {
        let (sin_alpha, cos_alpha) = self.lead_angle.sin_cos();
        let (sin, cos) = azimuth.sin_cos();
        let (sin_phi, cos_phi) = contact_angle.sin_cos();
        let r = self.groove_radius;
        let lateral = (r * sin_phi - self.offset_l) * sin_alpha;
        let radial = self.pitch_radius + self.groove.sign() * (self.offset_h - r * cos_phi);
        Vector3::new(
            -lateral * sin + radial * cos,
            lateral * cos + radial * sin,
            self.pitch_radius * azimuth * sin_alpha / cos_alpha
                + (self.offset_l - r * sin_phi) * cos_alpha,
        )
    }

    /// Both principal curvatures exactly as printed: derivatives over the azimuth (13)-(16) at
    /// azimuth 0 and eq. (12), (17)-(24). A stray sign in (15) is left out, and the nut's normal is
    /// turned into its metal. The fractions printed in (21)-(23) have the sign of `S_phi x S_theta`, against the normal of (12): their
    /// dot products with that normal are taken. Loses digits near a lead angle of 90 degrees, where `tan(alpha)` grows.
    pub fn principal_cartesian(&self, contact_angle: f64) -> PrincipalCurvatures {
        let (sin_alpha, cos_alpha) = self.lead_angle.sin_cos();
        let (sin_phi, cos_phi) = contact_angle.sin_cos();
        let zeta = self.groove.sign();
        let r = self.groove_radius;
        let lateral = (r * sin_phi - self.offset_l) * sin_alpha;
        let radial = self.pitch_radius + zeta * (self.offset_h - r * cos_phi);
        let along_phi = r * Vector3::new(zeta * sin_phi, cos_phi * sin_alpha, -cos_alpha * cos_phi);
        let along_azimuth =
            Vector3::new(-lateral, radial, self.pitch_radius * sin_alpha / cos_alpha);
        let phi_phi = r * Vector3::new(zeta * cos_phi, -sin_phi * sin_alpha, cos_alpha * sin_phi);
        let phi_azimuth = r * Vector3::new(-cos_phi * sin_alpha, zeta * sin_phi, 0.0);
        let azimuth_azimuth = Vector3::new(-radial, -lateral, 0.0);
        Forms::new(
            [along_phi, along_azimuth],
            [phi_phi, phi_azimuth, azimuth_azimuth],
            zeta,
        )
        .principal()
    }

    /// First principal curvature of a circular groove, eq. (25), (26).
    pub fn circular_groove(&self, contact_angle: f64) -> f64 {
        let squeeze = contact_angle.cos() * self.lead_angle.cos().powi(2);
        match self.groove {
            Groove::Screw => squeeze / (self.pitch_radius - self.groove_radius * squeeze),
            Groove::Nut => -squeeze / (self.pitch_radius + self.groove_radius * squeeze),
        }
    }

    /// First principal curvature by Appendix B, corrected: (A1a) with `-sigma_3`, (A1m) with `-zeta sigma_13`.
    pub fn appendix_b(&self, contact_angle: f64) -> f64 {
        let zeta = self.groove.sign();
        let sigma = Sigma::new(self, contact_angle, zeta);
        -(sigma.one - sigma.three) / sigma.two
    }
}

struct Sigma {
    one: f64,
    two: f64,
    three: f64,
}

impl Sigma {
    /// `last_sign` stands before `sigma_13` in (A1m): 1 as printed, `zeta` as corrected.
    #[allow(clippy::suspicious_operation_groupings)]
    fn new(surface: &Surface, contact_angle: f64, last_sign: f64) -> Self {
        let z = surface.groove.sign();
        let rm = surface.pitch_radius;
        let rs = surface.groove_radius;
        let h = surface.offset_h;
        let l = surface.offset_l;
        let (sa, ca) = surface.lead_angle.sin_cos();
        let (s, c) = contact_angle.sin_cos();
        let (sa2, ca2) = (sa * sa, ca * ca);
        let (ca4, ca6) = (ca2 * ca2, ca2 * ca2 * ca2);
        let (c2, c3) = (c * c, c * c * c);
        let (s2, tan2) = (s * s, sa2 / ca2);
        let (rm2, rm3) = (rm * rm, rm * rm * rm);
        let (rs2, rs3, rs4) = (rs * rs, rs * rs * rs, rs * rs * rs * rs);
        let (h2, h3, l2) = (h * h, h * h * h, l * l);

        // (A1f), (A1g), (A1l), (A1n), (A1m)
        let s5 = rs * ca2 * c * s;
        let s6 = l * ca2 * c;
        let s11 = rm2 * tan2;
        let s13 = rs * ca2 * c;
        let s12 = rm + z * h * ca2 - last_sign * s13;
        // (A1e)
        let s4 = ca2 * (z * h * s - z * l * c + rm * s + z * s6 - z * s5).powi(2)
            + sa2 * (rm * s + z * s6 - z * s5).powi(2)
            + c2 * s12 * s12;
        // (A1i)
        let s8 =
            (l2 * ca2 * c2 - 2.0 * z * rm * rs * ca2 * c + rs2 * ca4 * c2 + 2.0 * z * h * rm * ca2
                - 2.0 * h * rs * ca4 * c
                - l2 * ca4 * c2
                + h2 * ca4 * c2
                - h2 * ca2 * c2
                + h2 * ca2
                + rm2
                + 2.0 * s * h * l * ca4 * c
                - 2.0 * s * h * l * ca2 * c)
                .abs();
        // (A1j)
        let s9 = 2.0 * z * l2 * rs2 * ca6 * c3 - 2.0 * z * l2 * rs2 * ca4 * c3
            + s * l * rm * rs2 * ca4
            - s * l * rm * rs2 * ca2
            - 4.0 * z * rm2 * rs2 * ca2 * c
            + 2.0 * z * s * h * l * rs2 * ca6
            - 7.0 * h * rm * rs2 * ca4 * c
            - h * rm * rs2 * ca2 * c
            + 5.0 * z * h * rs3 * ca6 * c2
            + 2.0 * z * h2 * rs2 * ca4 * c3
            - 4.0 * z * h2 * rs2 * ca4 * c
            - z * h * l2 * rs * ca6
            + z * h3 * rs * ca4
            + 2.0 * h2 * rm * rs * ca4
            + h2 * rm * rs * ca2
            + l2 * rm * rs * ca2
            + z * h * l2 * rs * ca4
            - 4.0 * z * s * h * l * rs2 * ca6 * c2
            - l2 * rm * rs * ca4
            - z * h * rs3 * ca6
            + z * h * rs3 * ca4
            - 2.0 * z * h2 * rs2 * ca6 * c3
            + rm3 * rs
            + 5.0 * rm * rs3 * ca4 * c2
            - 2.0 * z * rs4 * ca6 * c3
            + 3.0 * z * h * rm2 * rs * ca2
            + 4.0 * z * s * h * l * rs2 * ca4 * c2
            - 2.0 * z * s * h * l * rs2 * ca4;
        // (A1k)
        let s10 = z * l * rm * sa2 * s - 2.0 * h * rs * ca2 * c2 + l2 * ca2 * c * sa2 + rm2 * c
            - z * rm * rs * c2
            + rs2 * ca2 * c3
            + h2 * ca2 * c
            + rs2 * ca2 * c * sa2 * s2
            - 2.0 * l * rs * ca2 * c * sa2 * s
            - z * rm * rs * ca2 * c2
            - z * rm * rs * sa2 * s2
            + z * h * rm * c
            + z * h * rm * ca2 * c;
        // (A1h)
        let bracket_1 = rs2 * sa2 * (rm - z * s13 + z * h * ca2 * c2 + z * l * ca2 * c * s).powi(2)
            + z * rs * s12 * s10;
        let bracket_2 = (z * h + rm - z * rs * c).powi(2) - sa2 * (h * c - rs + l * s).powi(2)
            + sa2 * (l - rs * s).powi(2)
            + s11;
        let s7 = s9 * s9 / ca4 + 4.0 * rs2 * s8 / s4 * bracket_1 * bracket_2;
        // (A1d)
        let s3 = s7.sqrt() * s4.sqrt() / s8.sqrt();
        // (A1b) without sigma_3
        let s1 = rm3 * rs - 2.0 * z * rs4 * ca2 * c3 + z * h3 * rs * ca2 - 3.0 * z * rm2 * rs2 * c
            + 2.0 * z * h2 * rs2 * ca2 * c3 * sa2
            - 5.0 * h * rm * rs2 * ca2 * c
            + l2 * rm * rs * sa2
            - 4.0 * z * h2 * rs2 * ca2 * c
            + 5.0 * z * h * rs3 * ca2 * c2
            - z * l2 * rs2 * ca2 * c
            + 2.0 * z * l2 * rs2 * ca2 * c * sa2 * s2
            - 2.0 * z * h * l * rs2 * sa2 * s * ca2
            - 4.0 * z * h * rs3 * ca2 * c2 * sa2
            - l * rm * rs2 * sa2 * s
            - 3.0 * h * rm * rs2 * c
            + 4.0 * z * h * l * rs2 * ca2 * c2 * sa2 * s
            - z * l2 * rs2 * ca2 * c * sa2
            + z * l2 * rs2 * ca4 * c
            - z * rm2 * rs2 * ca2 * c
            + 3.0 * rm * rs3 * ca2 * c2
            + 2.0 * rm * rs3 * c2
            - 2.0 * rm * rs3 * sa2
            + rm3 * rs * tan2
            + 2.0 * z * h * rm2 * rs
            + h2 * rm * rs
            + z * h * rs3 * sa2 * s2 * ca2
            - 2.0 * z * rs4 * ca2 * c * sa2 * s2
            + 2.0 * rm * rs3 * sa2 * s2
            + z * h * rm2 * rs * sa2
            + 2.0 * h * rm * rs2 * c * sa2
            - z * rm2 * rs2 * c * sa2
            + z * h * rm2 * rs * ca2
            + 2.0 * h2 * rm * rs * ca2
            - z * h * l2 * rs * ((4.0 * surface.lead_angle).cos() / 8.0 - 1.0 / 8.0)
            + 2.0 * z * rs4 * ca2 * c * sa2;
        // (A1c)
        let s2_total = 2.0
            * rs2
            * s4.sqrt()
            * (-h2 * c2 * sa2 + h2 - 2.0 * h * l * c * sa2 * s
                + rm2
                + 2.0 * z * h * rm
                + 2.0 * h * rs * c * sa2
                - 2.0 * h * rs * c
                - l2 * sa2 * s2
                + s11
                + l2 * sa2
                - 2.0 * z * rm * rs * c
                + rs2 * c2
                + rs2 * sa2 * s2
                - rs2 * sa2);
        Self {
            one: s1,
            two: s2_total,
            three: s3,
        }
    }
}
