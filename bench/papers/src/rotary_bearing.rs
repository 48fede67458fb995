//! A whole rotary ball bearing: rigid rings, Hertz balls, axial and radial load and moments on the inner ring, and the friction of
//! all its balls (Lin 2019, section 4.3.1, with the ball of section 3.2).
//!
//! The load distribution is the convex one of [`crate::rotary_ball`]: grooves are circular arcs, a contact lies on the line from
//! the arc's centre through the ball's, and the elastic energy `sum 2/5 C^-3/2 deflection^5/2` less the work of the load is convex
//! in ring displacements and ball centres together. Forces are unique; each ball is relaxed for itself, and five displacements of
//! the ring are left.

use nalgebra::{Matrix2, Matrix2x5, SMatrix, SVector, Vector2};

use crate::published::bearings::{INNER_SPEED, table_3_1};
use crate::rotary_ball::{RotaryBearing, RotaryContacts, RotaryConvention, SIGNS};
use epas_bench::report::statistics::evenly;
use epas_reference::error::ReferenceError;
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

/// A row of equal balls, evenly spaced from azimuth 0, the y axis, on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallRow {
    /// Balls, grooves and pitch circle.
    pub bearing: RotaryBearing,
    /// The contacts there are.
    pub raceways: Raceways,
    /// Number of balls.
    pub balls: usize,
    /// Axial position of the row in the bearing, m, -1 to 1.
    pub position: f64,
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
                azimuth: std::f64::consts::TAU * ball as f64 / row.balls as f64,
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
pub fn distribute(
    rows: &[BallRow],
    load: &RingLoad,
    tilt: Tilt,
) -> Result<LoadedBearing, ReferenceError> {
    let Some(first) = rows.first() else {
        return Err(ReferenceError::Unsupported);
    };
    let pitch_radius = first.bearing.pitch_radius;
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
    /// Friction torque of all balls, N m, each moving with least dissipation, at a speed of the inner ring in rad/s.
    ///
    /// `rows` are those of [`distribute`]. Balls do not touch each other (a cage, or room between them); unloaded ones have no friction.
    pub fn friction(
        &self,
        rows: &[BallRow],
        friction: f64,
        inner_speed: f64,
    ) -> Result<f64, ReferenceError> {
        let mut torque = 0.0;
        for LoadedBall { row, contacts, .. } in &self.balls {
            let bearing = &rows.get(*row).ok_or(ReferenceError::Unsupported)?.bearing;
            let [il, ir, or, ol] = contacts.contact_forces;
            if il.max(ir) > 0.0 && or.max(ol) > 0.0 {
                let mut contacts = *contacts;
                let angles = contacts.contact_angles.iter_mut();
                // A lost contact's direction is without meaning.
                for (angle, force) in angles.zip(contacts.contact_forces) {
                    if force <= 0.0 {
                        *angle = bearing.contact_angle;
                    }
                }
                let motion = bearing.motion(&contacts, friction, inner_speed)?;
                torque += motion.friction_torque;
            }
        }
        Ok(torque)
    }

    /// Balls with all four contacts loaded.
    pub fn four_point_balls(&self) -> usize {
        self.count(4)
    }

    /// Balls without load.
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

/// Friction of a four-point and of a double-row angular contact ball bearing under a load that turns from axial to radial (Table 4.2 and
/// Figure 4.7), in kind. Not printed: friction coefficient (0.1 as in Table 3.1), azimuth of the balls (0 from the plane of the load) and
/// distance of the rows (half the printed thickness, back to back; of no effect without tilt); curvatures are the right ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningLoad {
    /// Force on the inner ring, N; printed, 3000.
    pub force: f64,
    /// Ball radius less than fits the grooves, m, of both bearings; not printed, 0.
    pub undersize: f64,
    /// Whether the inner ring can tilt; not printed, the rack holds it.
    pub tilt: Tilt,
}

/// Friction coefficient, and distance of the two rows, m.
const FRICTION: f64 = 0.1;
const ROW_DISTANCE: f64 = 12e-3;

impl Default for TurningLoad {
    fn default() -> Self {
        Self {
            force: 3000.0,
            undersize: 0.0,
            tilt: Tilt::Held,
        }
    }
}

/// Both bearings under one direction of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningPoint {
    /// Angle of the force from the axis, rad.
    pub angle: f64,
    /// Friction torque of the four-point bearing, N m.
    pub four_point: f64,
    /// Friction torque of the double-row bearing, N m.
    pub double_row: f64,
    /// Balls of the four-point bearing with all four contacts loaded.
    pub four_point_balls: usize,
}

impl TurningLoad {
    fn row(&self, ball_radius: f64, raceways: Raceways, position: f64) -> BallRow {
        BallRow {
            bearing: RotaryBearing {
                ball_radius,
                ..table_3_1(RotaryConvention::Physical)
            },
            raceways,
            balls: 9,
            position,
            oversize: -self.undersize,
        }
    }

    /// The four-point bearing: nine balls of 6.25 mm radius in grooves of 6.75 mm.
    pub fn four_point(&self) -> [BallRow; 1] {
        [self.row(6.25e-3, Raceways::FourPoint, 0.0)]
    }

    /// The double-row bearing: twice nine balls of 4 mm radius in grooves of 4.32 mm, back to back.
    pub fn double_row(&self) -> [BallRow; 2] {
        let half = 0.5 * ROW_DISTANCE;
        [
            self.row(4e-3, Raceways::Forward, -half),
            self.row(4e-3, Raceways::Backward, half),
        ]
    }

    /// Load distribution under a force at `angle` from the axis, in the plane of axis and first ball.
    pub fn loaded(&self, rows: &[BallRow], angle: f64) -> Result<LoadedBearing, ReferenceError> {
        let (sin, cos) = angle.sin_cos();
        let load = RingLoad {
            axial: self.force * cos,
            radial: [self.force * sin, 0.0],
            moment: [0.0; 2],
        };
        distribute(rows, &load, self.tilt)
    }

    /// Both bearings under a force at `angle` (rad) from the axis.
    pub fn at(&self, angle: f64) -> Result<TurningPoint, ReferenceError> {
        let (four, double) = (self.four_point(), self.double_row());
        let loaded = self.loaded(&four, angle)?;
        let other = self.loaded(&double, angle)?;
        Ok(TurningPoint {
            angle,
            four_point: loaded.friction(&four, FRICTION, INNER_SPEED)?,
            double_row: other.friction(&double, FRICTION, INNER_SPEED)?,
            four_point_balls: loaded.four_point_balls(),
        })
    }

    /// `steps + 1` directions from axial to radial.
    pub fn sweep(&self, steps: usize) -> Result<Vec<TurningPoint>, ReferenceError> {
        evenly(0.0, std::f64::consts::FRAC_PI_2, steps)
            .map(|angle| self.at(angle))
            .collect()
    }
}

/// Largest over least of the values of a sweep: of the four-point and of the double-row bearing.
pub fn variation(points: &[TurningPoint]) -> [f64; 2] {
    let ratio = |value: fn(&TurningPoint) -> f64| {
        let values = points.iter().map(value);
        values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
    };
    [
        ratio(|point| point.four_point),
        ratio(|point| point.double_row),
    ]
}
