//! A whole rotary ball bearing: rigid rings, Hertz balls, axial and radial load and moments on the inner ring, and the friction of
//! all its balls (Lin 2019, section 4.3.1, with the ball of section 3.2).
//!
//! The load distribution is the convex one of [`crate::rotary_ball`]: grooves are circular arcs, a contact lies on the line from
//! the arc's centre through the ball's, and the elastic energy `sum 2/5 C^-3/2 deflection^5/2` less the work of the load is convex
//! in ring displacements and ball centres together. Forces are unique; each ball is relaxed for itself, and five displacements of
//! the ring are left.

use nalgebra::{Matrix2, Matrix2x5, SMatrix, SVector, Vector2};

use crate::rotary_ball::{RotaryBearing, RotaryContacts, SIGNS};
use epas_reference::error::{ReferenceError, within};
use epas_reference::friction::newton::{Local, Minimum, minimise};

/// Which contacts the balls of a row can make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Raceways {
    /// Gothic arcs on both rings: IL, IR, OR, OL.
    FourPoint,
    /// One diagonal, IL and OR: carries axial load on the inner ring towards +x.
    Forward,
    /// The other diagonal, IR and OL: carries axial load towards -x.
    Backward,
}

impl Raceways {
    fn has(self, contact: usize) -> bool {
        match self {
            Self::FourPoint => true,
            Self::Forward => contact.is_multiple_of(2),
            Self::Backward => !contact.is_multiple_of(2),
        }
    }
}

/// A row of equal balls, evenly spaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallRow {
    /// Balls, grooves and pitch circle.
    pub bearing: RotaryBearing,
    /// The contacts there are.
    pub raceways: Raceways,
    /// Number of balls, 1 to 1000.
    pub balls: usize,
    /// Axial position of the row in the bearing, m, -1 to 1.
    pub position: f64,
    /// Azimuth of the first ball, rad, from the y axis to the z axis.
    pub phase: f64,
    /// Excess of the ball radius over the one that fits the grooves without play, m; negative of undersized balls;
    /// within 5 % of the ball radius.
    pub oversize: f64,
}

/// Load on the inner ring; x is the bearing's axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RingLoad {
    /// Force along x, N.
    pub axial: f64,
    /// Force along y and z, N.
    pub radial: [f64; 2],
    /// Moment about y and z, N m.
    pub moment: [f64; 2],
}

/// Whether the inner ring can tilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tilt {
    /// It takes the moment; what it does not carry tilts it.
    Free,
    /// The shaft keeps the rings parallel; the moment is the shaft's.
    Held,
}

/// One ball of a loaded bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedBall {
    /// Index of its row.
    pub row: usize,
    /// Azimuth, rad.
    pub azimuth: f64,
    /// Contact angles and loads of IL, IR, OR, OL.
    pub contacts: RotaryContacts,
}

/// Load distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedBearing {
    /// Displacement of the inner ring along x, y, z, m.
    pub displacement: [f64; 3],
    /// Rotation of the inner ring about y and z, rad.
    pub rotation: [f64; 2],
    /// Every ball, row by row.
    pub balls: Vec<LoadedBall>,
    /// Moment about y and z that a shaft without tilt takes, N m; zero if the ring is free.
    pub shaft_moment: [f64; 2],
    /// Largest unbalanced force of ring and balls (moments over the pitch radius), N.
    pub residual: f64,
    /// Newton steps of the ring.
    pub steps: usize,
}

/// Friction of a loaded bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingFriction {
    /// Friction torque on the inner ring, N m.
    pub torque: f64,
    /// Share of each ball, N m; zero of an unloaded one.
    pub ball_torques: Vec<f64>,
}

type Ring = SVector<f64, 5>;

/// Place of one ball, and stiffness and geometry of its contacts.
struct Place<'a> {
    row: &'a BallRow,
    index: usize,
    azimuth: f64,
    /// Compliances of inner and outer contact, m/N^2/3.
    compliances: [f64; 2],
    /// Distance of an arc's centre from the ball's in the unloaded bearing.
    offset: f64,
}

/// A ball at rest between displaced rings.
struct Relaxed {
    arms: [Vector2<f64>; 4],
    forces: [f64; 4],
    ring: Local<5>,
    residual: f64,
}

impl Place<'_> {
    /// Axial and radial displacement of the centre of an inner arc, per displacement and rotation of the ring.
    fn motion_of(&self, contact: usize) -> Matrix2x5<f64> {
        let (sin, cos) = self.row.bearing.contact_angle.sin_cos();
        let (sign_x, sign_y) = SIGNS[contact];
        if sign_y > 0.0 {
            return Matrix2x5::zeros();
        }
        let radius = self.row.bearing.pitch_radius - self.offset * sign_y * cos;
        let along = self.row.position - self.offset * sign_x * sin;
        let (s, c) = self.azimuth.sin_cos();
        Matrix2x5::new(
            1.0,
            0.0,
            0.0,
            radius * s,
            -radius * c,
            0.0,
            c,
            s,
            -along * s,
            along * c,
        )
    }

    /// Energy of the ball where it lies between displaced rings, which is where its energy is least, with the derivatives by the
    /// ring's displacements. The ball's own position is eliminated, so that the Hessian is a Schur complement.
    fn relax(&self, ring: &Ring, unit: f64, tolerance: f64) -> Relaxed {
        let (sin, cos) = self.row.bearing.contact_angle.sin_cos();
        let moves = [0, 1, 2, 3].map(|contact| self.motion_of(contact));
        let shift = moves.map(|one| one * ring);
        let rest = SIGNS.map(|(sx, sy)| Vector2::new(sx * sin, sy * cos) * self.offset);
        let arms = |y: &Vector2<f64>| [0, 1, 2, 3].map(|i| y * unit - shift[i] + rest[i]);
        let force = |y: &Vector2<f64>, i: usize, arm: &Vector2<f64>| {
            // |rest + moved| - |rest|, as a quotient: the difference would lose the digits of a small load.
            let moved = y * unit - shift[i];
            let longer = moved.dot(&(arm + rest[i])) / (arm.norm() + self.offset);
            let deflection = longer + self.row.oversize;
            if deflection > 0.0 && self.row.raceways.has(i) {
                let compliance = self.compliances[usize::from(SIGNS[i].1 > 0.0)];
                (deflection, (deflection / compliance).powf(1.5))
            } else {
                (0.0, 0.0)
            }
        };
        let stiffness = |arm: &Vector2<f64>, deflection: f64, load: f64| {
            let length = arm.norm();
            let normal = arm / length;
            let along = normal * normal.transpose();
            along * (1.5 * load / deflection) + (Matrix2::identity() - along) * (load / length)
        };
        let energy = |y: &Vector2<f64>| {
            let mut sum = Local {
                value: 0.0,
                gradient: Vector2::zeros(),
                hessian: Matrix2::zeros(),
            };
            for (i, arm) in arms(y).iter().enumerate() {
                let (deflection, load) = force(y, i, arm);
                if load > 0.0 {
                    sum.value += 0.4 * load * deflection;
                    sum.gradient += arm * (load * unit / arm.norm());
                    sum.hessian += stiffness(arm, deflection, load) * (unit * unit);
                }
            }
            sum
        };
        // Midway between the rings: where no contact closes there, the ball is free.
        let start = (shift[0] + shift[1]) * (0.25 / unit);
        let end = minimise(start, tolerance * unit, energy);
        let arms = arms(&end.point);
        let mut forces = [0.0; 4];
        let mut local = Local {
            value: 0.0,
            gradient: Ring::zeros(),
            hessian: SMatrix::zeros(),
        };
        let mut own = Matrix2::zeros();
        let mut mixed = Matrix2x5::zeros();
        for (i, arm) in arms.iter().enumerate() {
            let (deflection, load) = force(&end.point, i, arm);
            forces[i] = load;
            if load > 0.0 {
                let block = stiffness(arm, deflection, load);
                local.value += 0.4 * load * deflection;
                local.gradient -= moves[i].transpose() * arm * (load / arm.norm());
                local.hessian += moves[i].transpose() * block * moves[i];
                own += block;
                mixed -= block * moves[i];
            }
        }
        let shifted = own + Matrix2::identity() * (1e-14 * own.trace());
        if let Some(inverse) = shifted.try_inverse() {
            local.hessian -= mixed.transpose() * inverse * mixed;
        }
        Relaxed {
            arms,
            forces,
            ring: local,
            residual: end.residual / unit,
        }
    }
}

fn check(rows: &[BallRow]) -> Result<(), ReferenceError> {
    if rows.is_empty() {
        return Err(ReferenceError::Unsupported);
    }
    for row in rows {
        within("balls", row.balls as f64, 1.0, 1000.0)?;
        within("position", row.position, -1.0, 1.0)?;
        within("phase", row.phase, -1e3, 1e3)?;
        let limit = 0.05 * row.bearing.ball_radius;
        within("oversize", row.oversize, -limit, limit)?;
        row.bearing.contact_law(false)?;
    }
    Ok(())
}

fn places(rows: &[BallRow]) -> Result<Vec<Place<'_>>, ReferenceError> {
    let mut places = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let compliances = [
            row.bearing.contact_law(false)?.compliance,
            row.bearing.contact_law(true)?.compliance,
        ];
        for ball in 0..row.balls {
            places.push(Place {
                row,
                index,
                azimuth: row.phase + std::f64::consts::TAU * ball as f64 / row.balls as f64,
                compliances,
                offset: (2.0 * row.bearing.conformity - 1.0) * row.bearing.ball_radius,
            });
        }
    }
    Ok(places)
}

/// Load distribution on the balls of one or more rows on common rigid rings.
///
/// Loads up to 1e6 N, moments up to 1e5 N m. Without load and without preload there is nothing to share: forces are zero.
///
/// # Errors
/// [`ReferenceError`]: an input out of range; `Unsupported` if no displacement up to a quarter of the ball radius makes the balls
/// take up the load, or only by contacts beyond the ends of the groove arcs; no convergence to 1e-7 of the largest
/// force and the rounding of a deflection in the play.
pub fn distribute(
    rows: &[BallRow],
    load: &RingLoad,
    tilt: Tilt,
) -> Result<LoadedBearing, ReferenceError> {
    check(rows)?;
    load.check()?;
    let pitch_radius = rows[0].bearing.pitch_radius;
    // Rotations count as displacements at the pitch circle, and moments as forces there.
    let widths = Ring::new(1.0, 1.0, 1.0, 1.0 / pitch_radius, 1.0 / pitch_radius);
    let mut push = load.generalised().component_mul(&widths);
    if tilt == Tilt::Held {
        push[3] = 0.0;
        push[4] = 0.0;
    }
    let problem = Distribution::new(rows, push, widths, tilt)?;
    let end = problem.solve()?;
    problem.loaded(&end, load)
}

impl RingLoad {
    fn check(&self) -> Result<(), ReferenceError> {
        for (field, value) in [
            ("axial", self.axial),
            ("radial", self.radial[0]),
            ("radial", self.radial[1]),
        ] {
            within(field, value, -1e6, 1e6)?;
        }
        for moment in self.moment {
            within("moment", moment, -1e5, 1e5)?;
        }
        Ok(())
    }

    /// Forces along x, y, z and moments about y and z.
    fn generalised(&self) -> Ring {
        let ([y, z], [about_y, about_z]) = (self.radial, self.moment);
        Ring::new(self.axial, y, z, about_y, about_z)
    }
}

/// The search for the displacements of the inner ring; unknowns in units of `unit`, rotations at the pitch circle.
struct Distribution<'a> {
    places: Vec<Place<'a>>,
    tilt: Tilt,
    /// Displacement and rotation per unknown.
    widths: Ring,
    /// Load on the unknowns, N.
    push: Ring,
    /// Magnitude of the load, N.
    total: f64,
    /// The larger of load and preload, N.
    scale: f64,
    /// Approach of a ball under that force, m.
    unit: f64,
    /// Rounding of the balls' forces, N.
    tolerance: f64,
    /// Largest displacement that is tried, in units of `unit`.
    limit: f64,
}

impl<'a> Distribution<'a> {
    fn new(
        rows: &'a [BallRow],
        push: Ring,
        widths: Ring,
        tilt: Tilt,
    ) -> Result<Self, ReferenceError> {
        let places = places(rows)?;
        let total = push.norm();
        let compliance: f64 = places[0].compliances.iter().sum();
        let preload = rows
            .iter()
            .map(|row| (row.oversize.max(0.0) / compliance).powf(1.5))
            .fold(0.0, f64::max);
        let scale = total.max(preload).max(1e-12);
        let unit = compliance * scale.powf(2.0 / 3.0);
        // Rounding of a deflection where it is the small difference of the ring's displacement and the play.
        let play = rows
            .iter()
            .fold(0.0, |most: f64, row| most.max(row.oversize.abs()));
        Ok(Self {
            places,
            tilt,
            widths,
            push,
            total,
            scale,
            unit,
            tolerance: scale * (1e-14 + 1e-15 * play / unit),
            limit: 0.25 * rows[0].bearing.ball_radius / unit,
        })
    }

    /// Displacements and rotations of the ring at the unknowns `y`.
    fn ring(&self, y: &Ring) -> Ring {
        y.component_mul(&self.widths) * self.unit
    }

    /// Elastic energy of all balls less the work of the load `push`.
    fn energy(&self, y: &Ring, push: &Ring) -> Local<5> {
        let (ring, unit, widths) = (self.ring(y), self.unit, &self.widths);
        let mut sum = Local {
            value: -push.dot(y) * unit,
            gradient: -push * unit,
            hessian: SMatrix::<f64, 5, 5>::zeros(),
        };
        for place in &self.places {
            let ball = place.relax(&ring, unit, self.tolerance).ring;
            sum.value += ball.value;
            sum.gradient += ball.gradient.component_mul(widths) * unit;
            let widened =
                SMatrix::<f64, 5, 5>::from_fn(|i, j| ball.hessian[(i, j)] * widths[i] * widths[j]);
            sum.hessian += widened * (unit * unit);
        }
        if self.tilt == Tilt::Held {
            let mean = sum.hessian.trace() / 5.0;
            for i in 3..5 {
                sum.gradient[i] = 0.0;
                sum.hessian.row_mut(i).fill(0.0);
                sum.hessian.column_mut(i).fill(0.0);
                sum.hessian[(i, i)] = mean;
            }
        }
        sum
    }

    /// A displacement along the load at which the balls take it up; none where they never do.
    fn start(&self, push: &Ring) -> Option<Ring> {
        if self.total > 0.0 {
            let along = self.push / self.total.max(f64::MIN_POSITIVE);
            take_up(self.limit, |reach| {
                self.energy(&(along * reach), push).gradient.dot(&along)
            })
            .map(|reach| along * reach)
        } else {
            Some(Ring::zeros())
        }
    }

    fn minimise(&self, start: Ring, push: &Ring) -> Minimum<5> {
        let tolerance = (1e-12 * self.scale + 10.0 * self.tolerance) * self.unit;
        minimise(start, tolerance, |y| self.energy(y, push))
    }

    fn solve(&self) -> Result<Minimum<5>, ReferenceError> {
        let start = self.start(&self.push).ok_or(ReferenceError::Unsupported)?;
        let mut end = self.minimise(start, &self.push);
        if end.residual > (1e-9 * self.scale + 100.0 * self.tolerance) * self.unit {
            // A light load in much play touches few balls, and most directions have no stiffness: come down from a load that closes
            // the play on more of them.
            let mut lift = (1e3 / self.scale).max(1e3);
            let mut descent = self.start(&(self.push * lift));
            while let Some(start) = descent {
                end = self.minimise(start, &(self.push * lift));
                if lift <= 1.0 {
                    break;
                }
                lift = (0.1 * lift).max(1.0);
                descent = Some(end.point);
            }
        }
        Ok(end)
    }

    /// The bearing at the end of the search, where it is in balance and no contact has left its arc.
    fn loaded(&self, end: &Minimum<5>, load: &RingLoad) -> Result<LoadedBearing, ReferenceError> {
        let ring = self.ring(&end.point);
        let mut residual = end.residual / self.unit;
        let mut largest = self.total;
        let mut taken = Ring::zeros();
        let mut balls = Vec::with_capacity(self.places.len());
        for place in &self.places {
            let ball = place.relax(&ring, self.unit, self.tolerance);
            residual = residual.max(ball.residual);
            taken += ball.ring.gradient;
            largest = ball.forces.into_iter().fold(largest, f64::max);
            balls.push(place.loaded(&ball));
        }
        if residual.is_nan() || residual > 1e-7 * largest.max(1e-9) + 10.0 * self.tolerance {
            return Err(ReferenceError::unbalanced(residual));
        }
        if !balls.iter().all(LoadedBall::lies_on_its_arcs) {
            return Err(ReferenceError::Unsupported);
        }
        Ok(LoadedBearing {
            displacement: [ring[0], ring[1], ring[2]],
            rotation: [ring[3], ring[4]],
            balls,
            shaft_moment: match self.tilt {
                Tilt::Free => [0.0; 2],
                Tilt::Held => [taken[3] - load.moment[0], taken[4] - load.moment[1]],
            },
            residual,
            steps: end.iterations,
        })
    }
}

impl Place<'_> {
    /// Contact angles and loads of the ball as it lies.
    fn loaded(&self, ball: &Relaxed) -> LoadedBall {
        let mut angles = [0.0; 4];
        for ((angle, arm), (sx, sy)) in angles.iter_mut().zip(&ball.arms).zip(SIGNS) {
            *angle = (arm.x * sx).atan2(arm.y * sy);
        }
        LoadedBall {
            row: self.index,
            azimuth: self.azimuth,
            contacts: RotaryContacts {
                contact_angles: angles,
                contact_forces: ball.forces,
            },
        }
    }
}

impl LoadedBall {
    /// Whether every loaded contact lies between the groove's bottom and its edge, where the arcs end.
    fn lies_on_its_arcs(&self) -> bool {
        let on_arc = |angle: f64| (0.0..=std::f64::consts::FRAC_PI_2).contains(&angle);
        let RotaryContacts {
            contact_angles,
            contact_forces,
        } = self.contacts;
        let mut contacts = contact_angles.into_iter().zip(contact_forces);
        !contacts.any(|(angle, force)| force > 0.0 && !on_arc(angle))
    }
}

/// The displacement along the load, at most `limit`, at which the balls push back more than the load pushes: Newton's method
/// starts there. With less displacement a bearing with play has no stiffness.
fn take_up(limit: f64, excess: impl Fn(f64) -> f64) -> Option<f64> {
    let mut low = 0.0;
    let mut high = f64::min(1.0, limit);
    while excess(high) < 0.0 {
        if high >= limit {
            return None;
        }
        low = high;
        high = (2.0 * high).min(limit);
    }
    // To a twentieth is close enough.
    while high - low > 0.05 * high {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}

impl LoadedBearing {
    /// Friction of all balls, each moving with least dissipation, at a speed of the inner ring in rad/s.
    ///
    /// `rows` are those of [`distribute`]. Balls do not touch each other (a cage, or room between them); unloaded ones have no
    /// friction.
    ///
    /// # Errors
    /// As [`RotaryBearing::motion`].
    pub fn friction(
        &self,
        rows: &[BallRow],
        friction: f64,
        inner_speed: f64,
    ) -> Result<BearingFriction, ReferenceError> {
        let mut ball_torques = Vec::with_capacity(self.balls.len());
        for ball in &self.balls {
            let row = rows.get(ball.row).ok_or(ReferenceError::Unsupported)?;
            let [il, ir, or, ol] = ball.contacts.contact_forces;
            let torque = if il.max(ir) > 0.0 && or.max(ol) > 0.0 {
                let mut contacts = ball.contacts;
                // A lost contact's direction is without meaning.
                for (angle, force) in contacts
                    .contact_angles
                    .iter_mut()
                    .zip(contacts.contact_forces)
                {
                    if force <= 0.0 {
                        *angle = row.bearing.contact_angle;
                    }
                }
                row.bearing
                    .motion(&contacts, friction, inner_speed)?
                    .friction_torque
            } else {
                0.0
            };
            ball_torques.push(torque);
        }
        Ok(BearingFriction {
            torque: ball_torques.iter().sum(),
            ball_torques,
        })
    }

    /// Balls with all four contacts loaded.
    #[must_use]
    pub fn four_point_balls(&self) -> usize {
        self.count(4)
    }

    /// Balls without load.
    #[must_use]
    pub fn lost_balls(&self) -> usize {
        self.count(0)
    }

    fn count(&self, contacts: usize) -> usize {
        self.balls
            .iter()
            .filter(|ball| {
                let loaded = ball.contacts.contact_forces.iter().filter(|f| **f > 0.0);
                loaded.count() == contacts
            })
            .count()
    }
}
