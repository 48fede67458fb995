//! Ball of a ball screw with friction (Lin 2019, section 3.4.1 and appendix F).
//!
//! Frame CS3 of the ball: x radially outward, y along the track, z completing it (nearly the screw's axis). The
//! screw stands, the nut turns at `nut_speed` and travels with its lead.

use nalgebra::{Matrix4, SMatrix, Vector3, Vector4};

use super::linear_ball::EllipseLaw;
use super::newton::{Local, Minimum, minimise, sharpen};
use super::patch::{Integration, Patch, PatchVelocity};
use crate::curvature;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// The four groove flanks, screw or nut, left (towards -z) or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Groove {
    /// SL.
    ScrewLeft,
    /// SR.
    ScrewRight,
    /// NL.
    NutLeft,
    /// NR.
    NutRight,
}

impl Groove {
    /// All four, SL, SR, NL, NR.
    pub const ALL: [Self; 4] = [
        Self::ScrewLeft,
        Self::ScrewRight,
        Self::NutLeft,
        Self::NutRight,
    ];

    /// True for the nut's flanks.
    pub const fn on_nut(self) -> bool {
        matches!(self, Self::NutLeft | Self::NutRight)
    }

    /// The groove that the flank belongs to.
    pub const fn part(self) -> curvature::Groove {
        if self.on_nut() {
            curvature::Groove::Nut
        } else {
            curvature::Groove::Screw
        }
    }

    pub(crate) const fn signs(self) -> (f64, f64) {
        match self {
            Self::ScrewLeft => (-1.0, -1.0),
            Self::ScrewRight => (-1.0, 1.0),
            Self::NutLeft => (1.0, -1.0),
            Self::NutRight => (1.0, 1.0),
        }
    }
}

/// Path of the ball centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewTrack {
    /// Pitch radius, m.
    pub pitch_radius: f64,
    /// Lead, m per turn; right-handed positive.
    pub lead: f64,
    /// Ball radius, m.
    pub ball_radius: f64,
}

impl From<&BallScrewDesign> for ScrewTrack {
    fn from(design: &BallScrewDesign) -> Self {
        Self {
            pitch_radius: design.pitch_radius,
            lead: design.lead,
            ball_radius: design.ball_radius,
        }
    }
}

impl ScrewTrack {
    /// Checks the design.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("ball_radius", self.ball_radius, 1e-6, 1.0)?;
        within(
            "pitch_radius",
            self.pitch_radius,
            1.2 * self.ball_radius,
            100.0,
        )?;
        within("lead", self.lead, 0.0, 20.0 * self.pitch_radius)?;
        Ok(())
    }

    /// Path length per radian of orbit, `L/2 pi`, (3.66), m.
    pub fn path_radius(&self) -> f64 {
        self.pitch_radius.hypot(self.lead / std::f64::consts::TAU)
    }

    /// Sine and cosine of the lead angle, (3.63).
    pub fn lead_angle(&self) -> (f64, f64) {
        let length = self.path_radius();
        (
            self.lead / std::f64::consts::TAU / length,
            self.pitch_radius / length,
        )
    }

    /// Sine and cosine of the ball-to-ball contact angle, (3.72): `sin b = 2 pi R_B/L`.
    pub fn ball_contact_angle(&self) -> (f64, f64) {
        let sin = self.ball_radius / self.path_radius();
        (sin, (1.0 - sin * sin).sqrt())
    }

    /// Slip between two touching balls, components z4 and x4 of (3.73) over `R_B`, by the motions of the rear and of the front ball, with the
    /// angular velocity relative to the orbiting frame. `direction` is 1 where the balls orbit along +y, -1 along -y.
    pub(crate) fn slip_between(&self, direction: f64) -> [SMatrix<f64, 2, 4>; 2] {
        let (sin_a, cos_a) = self.lead_angle();
        let (sin_b, cos_b) = self.ball_contact_angle();
        let of = |direction: f64| {
            SMatrix::<f64, 2, 4>::new(
                -direction * sin_b * sin_a,
                cos_b,
                direction * sin_b,
                0.0, //
                cos_a,
                0.0,
                0.0,
                -1.0,
            )
        };
        [of(direction), of(-direction)]
    }
}

/// A loaded contact of a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewContact {
    /// Flank.
    pub groove: Groove,
    /// Normal load, N; a load at or below zero is a lost contact.
    pub load: f64,
    /// Contact angle from the radial direction, rad.
    pub contact_angle: f64,
    /// Contact ellipse.
    pub ellipse: EllipseLaw,
}

/// Friction of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewContactFriction {
    /// The contact.
    pub contact: ScrewContact,
    /// Slip and spin, ball minus groove; major axis: across the track, about `y x n`; minor axis: along the track; spin about
    /// the normal from the ball into the groove.
    pub velocity: PatchVelocity,
    /// Friction force on the ball across and along the track, N.
    pub force: [f64; 2],
    /// Friction moment on the ball about the normal, N m.
    pub moment: f64,
    /// Power lost, W.
    pub power: f64,
}

/// Motion and friction of one ball.
#[derive(Clone, Debug, PartialEq)]
pub struct ScrewMotion {
    /// Orbital speed, rad/s.
    pub orbital_speed: f64,
    /// Total angular velocity of the ball in CS3, rad/s (the dissertation's `omega` plus the orbit's rotation).
    pub spin: [f64; 3],
    /// Friction of each contact.
    pub contacts: Vec<ScrewContactFriction>,
    /// Power lost, W.
    pub power_loss: f64,
    /// Largest unbalanced force, N.
    pub residual: f64,
    /// Bound of the power above its minimum, W; zero unless a contact sticks.
    pub gap: f64,
}

/// A contact's friction patch and the rows that give its velocity from `(w_B, Om_x, Om_y, Om_z)/w_N`; lengths in ball radii,
/// friction coefficient one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScrewRow {
    pub contact: ScrewContact,
    pub patch: Patch,
    pub rows: SMatrix<f64, 3, 4>,
    pub base: Vector3<f64>,
    /// Velocity by a part of the motion that is smaller than its last digit.
    pub remainder: Vector3<f64>,
    pub integration: Integration,
}

impl ScrewRow {
    /// (3.65) to (3.68) and (F.4) to (F.6) in one form: `V = (w_B - w_k) L/2pi y + (Om - w_k z_g) x q`, spin `(Om - w_k z_g) . n`,
    /// `z_g = (0, sin a, cos a)`, `w_k = 0` on the screw and `w_N` on the nut.
    pub fn new(track: &ScrewTrack, contact: ScrewContact) -> Result<Self, ReferenceError> {
        let angle = within("contact_angle", contact.contact_angle, 1e-3, 1.57)?;
        let load = within("load", contact.load, -1e9, 1e9)?.max(0.0);
        within("axis_ratio", contact.ellipse.axis_ratio, 1e-3, 1.0)?;
        within(
            "semi_major_constant",
            contact.ellipse.semi_major_constant,
            1e-9,
            1.0,
        )?;
        let (sx, sz) = contact.groove.signs();
        let (nx, nz) = (sx * angle.cos(), sz * angle.sin());
        let path = track.path_radius() / track.ball_radius;
        let (sin_a, cos_a) = track.lead_angle();
        let rows = SMatrix::<f64, 3, 4>::new(
            0.0, 0.0, 1.0, 0.0, //
            path, -nz, 0.0, nx, //
            0.0, nx, 0.0, nz,
        );
        let nut = if contact.groove.on_nut() { 1.0 } else { 0.0 };
        let base = Vector3::new(-sin_a, -path - cos_a * nx, -cos_a * nz) * nut;
        let a = contact.ellipse.semi_major_constant * load.max(f64::MIN_POSITIVE).cbrt()
            / track.ball_radius;
        let patch = Patch {
            semi_major: a,
            semi_minor: a * contact.ellipse.axis_ratio,
            friction_limit: load,
        };
        Ok(Self {
            contact,
            patch,
            rows,
            base,
            remainder: Vector3::zeros(),
            integration: Integration::Full,
        })
    }

    pub fn velocity(&self, y: &Vector4<f64>) -> Vector3<f64> {
        self.base + self.rows * y + self.remainder
    }

    /// Power, gradient and Hessian by `(slip_major, slip_minor, spin)` with the spin smoothed at rest.
    pub fn local(&self, y: &Vector4<f64>, rest_spin: f64) -> Local<3> {
        let v = self.velocity(y);
        if self.patch.friction_limit <= 0.0 {
            return Local {
                value: 0.0,
                gradient: Vector3::zeros(),
                hessian: SMatrix::zeros(),
            };
        }
        let smooth = v.z.hypot(rest_spin);
        let share = if smooth > 0.0 { v.z / smooth } else { 0.0 };
        let velocity = PatchVelocity {
            slip_major: v.x,
            slip_minor: v.y,
            spin: smooth,
        };
        let here = self.patch.friction_by(velocity, self.integration);
        let mut gradient = Vector3::from(here.gradient);
        let mut hessian = SMatrix::<f64, 3, 3>::from_fn(|i, j| here.hessian[i][j]);
        let moment = gradient.z;
        gradient.z *= share;
        let scale = Vector3::new(1.0, 1.0, share);
        hessian = SMatrix::<f64, 3, 3>::from_fn(|i, j| hessian[(i, j)] * scale[i] * scale[j]);
        if smooth > 0.0 {
            hessian[(2, 2)] += moment * (rest_spin / smooth).powi(2) / smooth;
        }
        Local {
            value: here.power,
            gradient,
            hessian,
        }
    }

    pub fn accumulate(&self, y: &Vector4<f64>, rest_spin: f64, sum: &mut Local<4>) {
        let local = self.local(y, rest_spin);
        sum.value += local.value;
        sum.gradient += self.rows.transpose() * local.gradient;
        sum.hessian += self.rows.transpose() * local.hessian * self.rows;
    }

    pub fn moves(&self, y: &Vector4<f64>, rest_spin: f64) -> bool {
        let v = self.velocity(y);
        self.patch.friction_limit <= 0.0
            || (v.x.hypot(v.y) / self.patch.semi_major).hypot(v.z) > 30.0 * rest_spin
    }

    fn friction(&self, y: &Vector4<f64>, rest_spin: f64) -> (ScrewContactFriction, f64) {
        let v = self.velocity(y);
        let here = self.local(y, rest_spin);
        let power = here.gradient.dot(&v);
        let exact = if rest_spin > 0.0 {
            self.local(y, 0.0).value
        } else {
            power
        };
        let friction = ScrewContactFriction {
            contact: self.contact,
            velocity: PatchVelocity {
                slip_major: v.x,
                slip_minor: v.y,
                spin: v.z,
            },
            force: [-here.gradient.x, -here.gradient.y],
            moment: -here.gradient.z,
            power,
        };
        (friction, exact - power)
    }
}

/// Power of a ball in units of `R_B w_N`, with friction coefficient one.
pub(crate) fn ball_dissipation(rows: &[ScrewRow], y: &Vector4<f64>, rest_spin: f64) -> Local<4> {
    let mut sum = Local {
        value: 0.0,
        gradient: Vector4::zeros(),
        hessian: Matrix4::zeros(),
    };
    for row in rows {
        row.accumulate(y, rest_spin, &mut sum);
    }
    sum
}

pub(crate) fn ball_rows(
    track: &ScrewTrack,
    contacts: &[ScrewContact],
) -> Result<Vec<ScrewRow>, ReferenceError> {
    track.check()?;
    let rows = contacts
        .iter()
        .map(|c| ScrewRow::new(track, *c))
        .collect::<Result<Vec<_>, _>>()?;
    let loaded = |nut: bool| {
        rows.iter()
            .any(|r| r.contact.groove.on_nut() == nut && r.patch.friction_limit > 0.0)
    };
    if loaded(false) && loaded(true) {
        Ok(rows)
    } else {
        Err(ReferenceError::Undriven)
    }
}

pub(crate) fn rolling(track: &ScrewTrack) -> Vector4<f64> {
    Vector4::new(
        0.55,
        0.0,
        0.1,
        0.5 * track.path_radius() / track.ball_radius / 0.7,
    )
}

/// Motion of least dissipation for given rows, and the spin over which friction is still smoothed (0 where every contact moves).
/// A `warm` start lies near the end and is tried without smoothing first.
pub(crate) fn ball_minimum(
    rows: &[ScrewRow],
    start: Vector4<f64>,
    warm: bool,
) -> (Minimum<4>, f64) {
    let total: f64 = rows.iter().map(|r| r.patch.friction_limit).sum();
    let tolerance = 2e-14 * total;
    if warm {
        let direct = minimise(start, tolerance, |y| ball_dissipation(rows, y, 0.0));
        if direct.residual <= 1e-10 * total && rows.iter().all(|r| r.moves(&direct.point, 1e-6)) {
            return (direct, 0.0);
        }
    }
    sharpen(
        start,
        tolerance,
        1e-10 * total,
        |y, rest_spin| ball_dissipation(rows, y, rest_spin),
        |y, rest_spin| rows.iter().all(|r| r.moves(y, rest_spin)),
    )
}

pub(crate) fn dimensional(
    track: &ScrewTrack,
    rows: &[ScrewRow],
    y: &Vector4<f64>,
    rest_spin: f64,
    friction: f64,
    nut_speed: f64,
    residual: f64,
) -> ScrewMotion {
    let (r, sign, size) = (track.ball_radius, nut_speed.signum(), nut_speed.abs());
    let mut gap = 0.0;
    let contacts: Vec<_> = rows
        .iter()
        .map(|row| {
            let (c, excess) = row.friction(y, rest_spin);
            gap += excess;
            ScrewContactFriction {
                contact: c.contact,
                velocity: PatchVelocity {
                    slip_major: c.velocity.slip_major * r * nut_speed,
                    slip_minor: c.velocity.slip_minor * r * nut_speed,
                    spin: c.velocity.spin * nut_speed,
                },
                force: c.force.map(|f| f * friction * sign),
                moment: c.moment * friction * r * sign,
                power: c.power * friction * r * size,
            }
        })
        .collect();
    ScrewMotion {
        orbital_speed: y[0] * nut_speed,
        spin: [y[1] * nut_speed, y[2] * nut_speed, y[3] * nut_speed],
        power_loss: contacts.iter().map(|c| c.power).sum(),
        contacts,
        residual: friction * residual,
        gap: gap.max(0.0) * friction * r * size,
    }
}

/// Motion of a ball with given contact loads and angles: the force along the track and the three moments balance.
///
/// The four equations are the gradient of the power by orbital speed and total spin; the motion is unique up to a contact that sticks.
/// In-plane forces are not balanced here, see [`super::ball_screw_elastic`]. With `friction = 0` the motion is the limit and all forces vanish.
///
/// Source: Lin 2019, eqs. (3.65) to (3.69), appendix F. Corrected: `Sig` of (3.20) is odd while the force holds the sign
/// of the spin; here friction at rest is bounded by Coulomb's law instead.
pub fn motion_with_contacts(
    track: &ScrewTrack,
    contacts: &[ScrewContact],
    friction: f64,
    nut_speed: f64,
) -> Result<ScrewMotion, ReferenceError> {
    track.check()?;
    let start = rolling(track);
    motion_from(
        track,
        contacts,
        friction,
        nut_speed,
        [start[0], start[1], start[2], start[3]],
    )
}

/// As [`motion_with_contacts`], from a given start of `(w_B, Om_x, Om_y, Om_z)/w_N`.
pub fn motion_from(
    track: &ScrewTrack,
    contacts: &[ScrewContact],
    friction: f64,
    nut_speed: f64,
    start: [f64; 4],
) -> Result<ScrewMotion, ReferenceError> {
    let mu = within("friction", friction, 0.0, 1.0)?;
    within("nut_speed", nut_speed, -1e6, 1e6)?;
    if nut_speed == 0.0 {
        return Err(ReferenceError::Standstill);
    }
    for value in start {
        within("start", value, -1e9, 1e9)?;
    }
    let rows = ball_rows(track, contacts)?;
    let (end, rest_spin) = ball_minimum(&rows, Vector4::from(start), false);
    let largest = rows
        .iter()
        .map(|r| r.patch.friction_limit)
        .fold(0.0, f64::max);
    if end.residual.is_nan()
        || end.residual > 1e-6 * largest * track.path_radius() / track.ball_radius
    {
        return Err(ReferenceError::unbalanced(mu * end.residual));
    }
    Ok(dimensional(
        track,
        &rows,
        &end.point,
        rest_spin,
        mu,
        nut_speed,
        end.residual,
    ))
}
