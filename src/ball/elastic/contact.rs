//! One contact of a ball: where it lies, what it carries, its friction, and what it adds to the ball's equations.

use super::equations::{Axial, Motion, Shared};
use super::grooves::ElasticGroove;
use crate::contact::slip_map::looped::{LoopSlip, Slips};
use crate::math;

/// Spin below which a contact sticks, over the nut's speed: friction takes the spin `w` as `sqrt(w² + STICK_SPIN²)`.
/// Contacts of a ball spin with two to four.
///
/// A larger one falsifies friction of contacts that hardly spin; a smaller one leaves more balls in limit cycles. At 0.003,
/// 0.005, 0.007, 0.01, 0.014, 0.02, 0.03
///
/// ```text
/// 427, 245, 189, 148, 110, 94, 77                        of 3000 balls with play never rest
/// 0.6, 1.0, 1.4, 2.0, 2.8, 4.1, 6.3 10^-3 rms            is the torque off from that of the exact ball, three contacts or more
/// 0.27, 0.45, 0.63, 0.91, 1.3, 1.8, 2.7 10^-3 rms        is the speed off in two contacts, of which one sticks
/// ```
///
/// The promise of a renewal ([`SCREW_RENEWAL`](crate::promises::SCREW_RENEWAL)) rests on 0.01. Whole rings are flagged a little
/// less often with more: in 12, 8.6 and 6.5 % of the ticks at 0.003, 0.01 and 0.03, with small play and 0.07 rad a round.
///
/// Scans here and below: 60 renewals of random balls from a start, and 60 more after load, grooves and neighbours have
/// moved; 3000 each as promised (5 to 300 N, gaps within 5 um), with preload, with play of 5 to 20 um, light ones (0.01 to
/// 5 N) and heavy ones (0.3 to 3 kN); and 48 random rings of 16 balls. One constant at a time, the others as they stand. What
/// the chosen ones do is shown by `host-tests/tests/generators/elastic_balls.rs`, which says how others are measured.
pub(super) const STICK_SPIN: f32 = 0.01;

/// Largest change of a contact's spin in one step, over the spin it has and that at which it sticks; and of its slip along the
/// track, over the slip it has and that at which its velocity centre reaches the end of the ellipse.
///
/// A step takes friction as linear in the motion. A longer one turns slip or spin round, and friction with it, so that balls
/// jump between both signs. Of 3000 balls as promised 96 never rest at 1 and 801 at 1.4; 7 at 0.8; none at 0.7; 3 at 0.6; 1
/// at 0.5. Shorter steps take longer: at 0.7 and 0.35 balls settle in 5.3 and 8.2 renewals in the mean, those with play in
/// 19 and 23, and 148 and 733 of these do not within fifty.
const REACH: f32 = 0.7;

/// Load of a contact, and how far a step may change the motion of the ball for its sake.
#[derive(Clone, Copy)]
pub(super) struct Reach {
    /// Normal: radial and axial part.
    nx: f32,
    nz: f32,
    /// Largest change of the spin and of the slip along the track, over the nut's speed.
    spin: f32,
    along: f32,
    /// Load, N; zero without contact.
    pub(super) load: f32,
}

impl Reach {
    /// No contact.
    pub(super) const NONE: Self = Self {
        nx: 0.0,
        nz: 0.0,
        spin: 0.0,
        along: 0.0,
        load: 0.0,
    };

    /// Whether this contact allows a whole step.
    #[inline(always)]
    pub(super) fn allows(&self, step: &Motion) -> bool {
        let (along, spin) = slips(step, (self.nx, self.nz));
        spin.abs() <= self.spin && along.abs() <= self.along
    }

    /// Part of a step that this contact allows, at most `taken`.
    pub(super) fn allowed(&self, step: &Motion, taken: f32) -> f32 {
        let (along, spin) = slips(step, (self.nx, self.nz));
        let taken = within(taken, spin.abs(), self.spin);
        within(taken, along.abs(), self.along)
    }
}

/// The part `taken` of a step of some size, or less, so that it stays within a limit.
#[inline(always)]
pub(super) fn within(taken: f32, size: f32, limit: f32) -> f32 {
    if taken * size > limit {
        limit / size
    } else {
        taken
    }
}

/// Slip along the track and spin of a contact with the normal `(nx, nz)`.
#[inline(always)]
fn slips(motion: &Motion, (nx, nz): (f32, f32)) -> (f32, f32) {
    (
        motion.speed + (motion.z * nx - motion.x * nz),
        motion.x * nx + motion.z * nz,
    )
}

/// Adds a contact that carries to the equations of the ball; returns what it carries and how far a step may go.
#[inline]
pub(super) fn add(
    groove: &ElasticGroove,
    pressed: Pressed,
    motion: &Motion,
    friction: f32,
    own: &mut Axial,
    shared: &mut Shared,
    reach: &mut Reach,
) {
    *reach = Touch::of(groove, pressed).add(groove, motion, friction, own, shared);
}

/// How an arc of a groove lies to a ball.
#[derive(Clone, Copy)]
pub(super) struct Pressed {
    /// From the arc's centre to the ball's, over the ball radius: radial and axial part.
    ex: f32,
    ez: f32,
    /// Square of their distance less that at which the ball touches; the distance at which it touches.
    excess: f32,
    touching: f32,
}

impl Pressed {
    /// A ball whose centre lies at `(x, z)` from the groove's middle and an arc whose centre lies at `(mx, mz)`, both over
    /// the ball radius; none where a gap is left.
    #[inline(always)]
    pub(super) fn at(
        groove: &ElasticGroove,
        (x, z): (f32, f32),
        (mx, mz): (f32, f32),
        clearance: f32,
    ) -> Option<Self> {
        let (ex, ez) = (x - mx, z - mz);
        // Without cancellation: the arc's centre lies `groove.centre` from the middle.
        let excess =
            x * (ex - mx) + z * (ez - mz) - clearance * (groove.centre + groove.centre + clearance);
        // False for NaN.
        if excess > 0.0 {
            Some(Self {
                ex,
                ez,
                excess,
                touching: groove.centre + clearance,
            })
        } else {
            None
        }
    }
}

/// How a contact slides.
struct Slid {
    slip: LoopSlip,
    /// Friction of a contact that slides without spin, N.
    limit: f32,
    /// Second derivatives times the slips, and these times the slips.
    h1: f32,
    h2: f32,
    turned: f32,
}

/// Where a contact lies and what it carries.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    /// Direction from the ball's centre to the contact: radial and axial part.
    pub(super) nx: f32,
    pub(super) nz: f32,
    /// 1 / distance of the ball's centre from the arc's.
    pub(super) per_distance: f32,
    /// Cube root of the load, `N^(1/3)`.
    pub(super) root: f32,
    /// Load, N.
    pub(super) load: f32,
    /// Change of the load with the approach, N.
    pub(super) stiffness: f32,
}

impl Touch {
    /// The contact of a ball that a groove presses.
    #[inline(always)]
    pub(super) fn of(groove: &ElasticGroove, pressed: Pressed) -> Self {
        let Pressed {
            ex,
            ez,
            excess,
            touching,
        } = pressed;
        let distance = math::sqrt(ex * ex + ez * ez);
        let sum = distance + touching;
        // One division for both reciprocals.
        let both = 1.0 / (distance * sum);
        let per_distance = sum * both;
        let power = excess * (distance * both) * groove.stiffness;
        let root = math::sqrt(power);
        Self {
            nx: ex * per_distance,
            nz: ez * per_distance,
            per_distance,
            root,
            load: root * power,
            stiffness: 1.5 * root * groove.stiffness,
        }
    }

    /// Adds the contact's forces and all their derivatives to the equations of the ball: those of its own groove's
    /// axial place, and those that both grooves share. The motion is that of the ball less that of the groove. Returns how
    /// far a step may change the motion.
    ///
    /// In the contact's own directions, with the slips `V1` across and `V2` along and the spin `w`, all over the nut's
    /// speed, and the normal `n`:
    ///
    /// ```text
    /// V1 = y    V2 = speed + z nx - x nz    w = x nx + z nz
    /// ```
    ///
    /// Left out of the derivatives is that the normal turns with the ball's place, which friction hardly feels.
    ///
    /// Sources: Lin 2019, eqs. (3.65)-(3.69); loads by eqs. (2.11)-(2.14).
    #[inline(always)]
    fn add(
        &self,
        groove: &ElasticGroove,
        motion: &Motion,
        friction: f32,
        own: &mut Axial,
        shared: &mut Shared,
    ) -> Reach {
        let Self { nx, nz, load, .. } = *self;
        let (along, spin) = slips(motion, (nx, nz));
        let across = motion.y;
        let semi_major = groove.semi_major * self.root;
        let slip = groove.map.at(&Slips {
            across,
            along,
            spin,
            stick: STICK_SPIN * STICK_SPIN,
            size: semi_major * semi_major,
        });
        let turning = spin.abs() + STICK_SPIN;
        let reach = Reach {
            nx,
            nz,
            spin: REACH * turning,
            along: REACH * (along.abs() + semi_major * turning),
            load,
        };
        // Second derivatives times the slips; the potential is homogeneous in slips and spin.
        let h1 = slip.across_across * across + slip.mixed * along;
        let h2 = slip.mixed * across + slip.along_along * along;
        let turned = slip.tilt * (h1 * across + h2 * along);
        let limit = friction * load;

        // Forces and their growth with the approach: of the load, and of the ellipse with its cube root.
        let (f1, f2, fm) = (limit * slip.across, limit * slip.along, limit * slip.moment);
        let grown = friction * self.stiffness;
        let (u1, u2, um) = (
            grown * (slip.across - (1.0 / 3.0) * h1),
            grown * (slip.along - (1.0 / 3.0) * h2),
            grown * (slip.moment + (1.0 / 3.0) * (slip.moment + turned)),
        );
        self.place(f1, u1, own, shared);
        shared.forces = shared.forces.plus(&self.on_motion(f1, f2, fm), 1.0);
        let growth = self.on_motion(u1, u2, um);
        shared.forces_by_place = shared.forces_by_place.plus(&growth, nx);
        own.forces = own.forces.plus(&growth, nz);

        self.bend(
            &Slid {
                slip,
                limit,
                h1,
                h2,
                turned,
            },
            own,
            shared,
        );
        reach
    }

    /// What forces across and along the track and a moment about the normal are for the motion.
    #[inline(always)]
    fn on_motion(&self, across: f32, along: f32, moment: f32) -> Motion {
        Motion {
            speed: along,
            x: moment * self.nx - along * self.nz,
            y: across,
            z: moment * self.nz + along * self.nx,
        }
    }

    /// Adds the second derivatives of the power by the motion, and those of the friction across the track on the places.
    #[inline(always)]
    fn bend(&self, slid: &Slid, own: &mut Axial, shared: &mut Shared) {
        let Self { nx, nz, .. } = *self;
        let Slid {
            slip,
            limit,
            h1,
            h2,
            turned,
        } = *slid;
        let (s11, s12, s22) = (
            limit * slip.across_across,
            limit * slip.mixed,
            limit * slip.along_along,
        );
        let tilt = -limit * slip.tilt;
        let (s1w, s2w) = (tilt * h1, tilt * h2);
        let sww = limit * (slip.tilt * turned + slip.stick);
        let (ax, az) = (nx * s2w - nz * s22, nx * s22 + nz * s2w);
        let (bx, bz) = (nx * sww - nz * s2w, nx * s2w + nz * sww);
        let by_across = Motion {
            speed: s12,
            x: nx * s1w - nz * s12,
            y: s11,
            z: nx * s12 + nz * s1w,
        };
        let h = &mut shared.hessian;
        h.xx += nx * bx - nz * ax;
        h.xy += by_across.x;
        h.xz += nx * bz - nz * az;
        h.xs += ax;
        h.yy += s11;
        h.yz += by_across.z;
        h.ys += s12;
        h.zz += nx * az + nz * bz;
        h.zs += az;
        h.ss += s22;
        // Friction across the track acts on the ball along (nz, -nx), against the slip.
        shared.by_motion = shared.by_motion.plus(&by_across, -nz);
        own.by_motion = own.by_motion.plus(&by_across, nx);
    }

    /// Adds forces in the cross section and their derivatives by the place, where the friction force across the track is
    /// `f1` and grows with the approach by `u1`.
    #[inline(always)]
    fn place(&self, f1: f32, u1: f32, own: &mut Axial, shared: &mut Shared) {
        let Self {
            nx,
            nz,
            load,
            stiffness,
            per_distance,
            ..
        } = *self;
        let (fx, fz) = (-(load * nx + f1 * nz), f1 * nx - load * nz);
        shared.radial += fx;
        own.force += fz;
        let (kx, kz) = (-(stiffness * nx + u1 * nz), u1 * nx - stiffness * nz);
        // The normal turns about the arc's centre.
        let (gx, gz) = (per_distance * fz, -per_distance * fx);
        shared.by_place += kx * nx + gx * nz;
        own.radial += kx * nz - gx * nx;
        own.by_place += kz * nx + gz * nz;
        own.by_itself += kz * nz - gz * nx;
    }
}
