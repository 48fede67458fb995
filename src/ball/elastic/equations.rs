//! The seven equations of a ball: sums over its contacts, and their solution.

/// A number for each part of a ball's motion: angular velocity about the radial axis, the track and the axis across both,
/// and speed along the track over the ball radius; all over the nut's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Motion {
    /// Of the speed along the track.
    pub(super) speed: f32,
    /// Of the angular velocity about the radial axis.
    pub(super) x: f32,
    /// Of that about the track.
    pub(super) y: f32,
    /// Of that about the axis across both.
    pub(super) z: f32,
}

impl Motion {
    const NONE: Self = Self {
        speed: 0.0,
        x: 0.0,
        y: 0.0,
        z: 0.0,
    };

    /// `self + factor other`.
    #[inline(always)]
    pub(super) fn plus(&self, other: &Self, factor: f32) -> Self {
        Self {
            speed: self.speed + factor * other.speed,
            x: self.x + factor * other.x,
            y: self.y + factor * other.y,
            z: self.z + factor * other.z,
        }
    }

    /// `factor self`.
    #[inline(always)]
    pub(super) fn times(&self, factor: f32) -> Self {
        Self {
            speed: factor * self.speed,
            x: factor * self.x,
            y: factor * self.y,
            z: factor * self.z,
        }
    }

    #[inline(always)]
    pub(super) fn dot(&self, other: &Self) -> f32 {
        self.x * other.x + self.y * other.y + self.z * other.z + self.speed * other.speed
    }
}

/// Second derivatives of the power loss by the motion, N: by the parts that the two letters name as [`Motion`] does, `s` the
/// speed along the track. Symmetric, so each pair stands once.
#[derive(Clone, Copy)]
pub(super) struct Hessian {
    /// By the angular velocity about the radial axis, twice.
    pub(super) xx: f32,
    /// By those about the radial axis and the track.
    pub(super) xy: f32,
    /// By those about the radial axis and the axis across.
    pub(super) xz: f32,
    /// By that about the radial axis and the speed.
    pub(super) xs: f32,
    /// By that about the track, twice.
    pub(super) yy: f32,
    /// By those about the track and the axis across.
    pub(super) yz: f32,
    /// By that about the track and the speed.
    pub(super) ys: f32,
    /// By that about the axis across, twice.
    pub(super) zz: f32,
    /// By that about the axis across and the speed.
    pub(super) zs: f32,
    /// By the speed, twice.
    pub(super) ss: f32,
}

/// Equations that both grooves share: the radial place and the motion.
pub(super) struct Shared {
    /// Unbalanced radial force on the ball, N.
    pub(super) radial: f32,
    /// Its change with the radial place, N per ball radius.
    pub(super) by_place: f32,
    /// Its change with the motion, N.
    pub(super) by_motion: Motion,
    /// Derivatives of the power loss by the motion, N: moments over the ball radius, and the force along the track.
    pub(super) forces: Motion,
    /// Their change with the radial place, N per ball radius.
    pub(super) forces_by_place: Motion,
    /// Their change with the motion.
    pub(super) hessian: Hessian,
}

impl Shared {
    pub(super) const NONE: Self = Self {
        radial: 0.0,
        by_place: 0.0,
        by_motion: Motion::NONE,
        forces: Motion::NONE,
        forces_by_place: Motion::NONE,
        hessian: Hessian {
            xx: 0.0,
            xy: 0.0,
            xz: 0.0,
            xs: 0.0,
            yy: 0.0,
            yz: 0.0,
            ys: 0.0,
            zz: 0.0,
            zs: 0.0,
            ss: 0.0,
        },
    };

    /// Leaves the place out of the equations of the motion.
    pub(super) const fn uncouple(&mut self, screw: &mut Axial, nut: &mut Axial) {
        self.forces_by_place = Motion::NONE;
        screw.forces = Motion::NONE;
        nut.forces = Motion::NONE;
    }
}

/// Axial balance in one groove.
#[derive(Clone, Copy)]
pub(super) struct Axial {
    /// Axial force of the groove on the ball, N.
    pub(super) force: f32,
    /// Its change with the axial place in this groove, N per ball radius.
    pub(super) by_itself: f32,
    /// Its change with the radial place, N per ball radius.
    pub(super) by_place: f32,
    /// Its change with the motion, N.
    pub(super) by_motion: Motion,
    /// Change of the radial force with the axial place, N per ball radius.
    pub(super) radial: f32,
    /// Change of the power's derivatives by the motion with the axial place, N per ball radius.
    pub(super) forces: Motion,
}

impl Axial {
    pub(super) const NONE: Self = Self {
        force: 0.0,
        by_itself: 0.0,
        by_place: 0.0,
        by_motion: Motion::NONE,
        radial: 0.0,
        forces: Motion::NONE,
    };
}

/// Steps that bring all unbalanced forces to zero, to first order; they are taken off place and motion.
pub(super) struct Step {
    /// Of the radial place, over the ball radius.
    pub(super) radial: f32,
    /// Of the axial place in the screw's groove, over the ball radius.
    pub(super) screw: f32,
    /// Of that in the nut's groove.
    pub(super) nut: f32,
    /// Of the motion, over the nut's speed.
    pub(super) motion: Motion,
    /// Change of the speed with a force along the track, 1/N.
    pub(super) compliance: f32,
}

/// The step of a place in terms of what is eliminated after it: `step = right - place dx - motion dy`, with the step `dx` of
/// the radial place and `dy` of the motion.
struct Follows {
    /// The step where nothing else moves.
    right: f32,
    /// What the radial place takes off it.
    place: f32,
    /// What the motion takes off it.
    motion: Motion,
}

impl Follows {
    #[inline(always)]
    fn of(axial: &Axial, unbalanced: f32, inverse: f32) -> Self {
        Self {
            right: inverse * unbalanced,
            place: inverse * axial.by_place,
            motion: axial.by_motion.times(inverse),
        }
    }

    #[inline(always)]
    fn step(&self, radial: f32, motion: &Motion) -> f32 {
        self.right - self.place * radial - self.motion.dot(motion)
    }
}

/// One row of the equations of the motion, places eliminated.
#[derive(Clone, Copy)]
struct Line {
    /// Unbalanced force, N.
    right: f32,
    /// Its change with each part of the motion, N.
    by: Motion,
}

impl Line {
    /// The row with the axial places and then the radial one eliminated.
    #[inline(always)]
    fn of(
        force: f32,
        hessian: Motion,
        (radial, screw, nut): (f32, f32, f32),
        (x, s, n): (&Follows, &Follows, &Follows),
    ) -> Self {
        let radial = radial - screw * s.place - nut * n.place;
        let by = hessian
            .plus(&s.motion, -screw)
            .plus(&n.motion, -nut)
            .plus(&x.motion, -radial);
        Self {
            right: force - screw * s.right - nut * n.right - radial * x.right,
            by,
        }
    }
}

/// Places in terms of what is eliminated after them.
struct Places {
    /// The radial place, after which only the motion is left: its `place` is 0.
    radial: Follows,
    /// The axial place in the screw's groove.
    screw: Follows,
    /// That in the nut's groove.
    nut: Follows,
}

/// Eliminates the axial places, then the radial one.
#[inline(always)]
fn places(shared: &Shared, screw: &Axial, nut: &Axial, unbalanced: [f32; 2]) -> Places {
    // One division for both reciprocals.
    let both = 1.0 / (screw.by_itself * nut.by_itself);
    let s = Follows::of(screw, unbalanced[0], both * nut.by_itself);
    let n = Follows::of(nut, unbalanced[1], both * screw.by_itself);
    let by_place = shared.by_place - screw.radial * s.place - nut.radial * n.place;
    let inverse = 1.0 / by_place;
    let radial = Follows {
        right: inverse * (shared.radial - screw.radial * s.right - nut.radial * n.right),
        place: 0.0,
        motion: shared
            .by_motion
            .plus(&s.motion, -screw.radial)
            .plus(&n.motion, -nut.radial)
            .times(inverse),
    };
    Places {
        radial,
        screw: s,
        nut: n,
    }
}

/// Eliminates the motion, row after row: its step, and the change of the speed with a force along the track.
#[inline(always)]
fn motion(
    shared: &Shared,
    screw: &Axial,
    nut: &Axial,
    places: &Places,
    push: f32,
) -> (Motion, f32) {
    let h = &shared.hessian;
    let (p, u, v, f) = (
        &shared.forces_by_place,
        &screw.forces,
        &nut.forces,
        &shared.forces,
    );
    let all = (&places.radial, &places.screw, &places.nut);
    let row = |x, y, z, speed| Motion { speed, x, y, z };
    let a = Line::of(f.x, row(h.xx, h.xy, h.xz, h.xs), (p.x, u.x, v.x), all);
    let inverse = 1.0 / a.by.x;
    let (a1, a2, a3, a4) = (
        inverse * a.by.y,
        inverse * a.by.z,
        inverse * a.by.speed,
        inverse * a.right,
    );
    let b = Line::of(f.y, row(h.xy, h.yy, h.yz, h.ys), (p.y, u.y, v.y), all);
    let first = b.by.x;
    let inverse = 1.0 / (b.by.y - first * a1);
    let (b2, b3, b4) = (
        inverse * (b.by.z - first * a2),
        inverse * (b.by.speed - first * a3),
        inverse * (b.right - first * a4),
    );
    let c = Line::of(f.z, row(h.xz, h.yz, h.zz, h.zs), (p.z, u.z, v.z), all);
    let first = c.by.x;
    let second = c.by.y - first * a1;
    let inverse = 1.0 / (c.by.z - first * a2 - second * b2);
    let (c3, c4) = (
        inverse * (c.by.speed - first * a3 - second * b3),
        inverse * (c.right - first * a4 - second * b4),
    );
    let d = Line::of(
        f.speed - push,
        row(h.xs, h.ys, h.zs, h.ss),
        (p.speed, u.speed, v.speed),
        all,
    );
    let first = d.by.x;
    let second = d.by.y - first * a1;
    let third = d.by.z - first * a2 - second * b2;
    let compliance = 1.0 / (d.by.speed - first * a3 - second * b3 - third * c3);
    let speed = compliance * (d.right - first * a4 - second * b4 - third * c4);
    let z = c4 - c3 * speed;
    let y = b4 - b2 * z - b3 * speed;
    let x = a4 - a1 * y - a2 * z - a3 * speed;
    (row(x, y, z, speed), compliance)
}

/// Solves the equations, where the axial forces on the ball are unbalanced by those given.
///
/// Elimination without exchange of rows: axial places, radial place, motion.
#[inline]
pub(super) fn solved(
    shared: &Shared,
    screw: &Axial,
    nut: &Axial,
    unbalanced: [f32; 2],
    push: f32,
) -> Step {
    let places = places(shared, screw, nut, unbalanced);
    let (motion, compliance) = motion(shared, screw, nut, &places, push);
    let x = &places.radial;
    let radial = x.right - x.motion.dot(&motion);
    Step {
        radial,
        screw: places.screw.step(radial, &motion),
        nut: places.nut.step(radial, &motion),
        motion,
        compliance,
    }
}
