//! The two contacts of one groove in a ball's equations, and the elimination of the ball's axial place in it.

use super::contact::{Motion, Row, Slipping, Touch};
use super::grooves::ElasticGroove;

/// What a ball meets in one tick.
#[derive(Clone, Copy)]
pub(super) struct Conditions {
    pub(super) friction: f32,
    /// Radial gap of every contact at the centred ball, over the ball radius.
    pub(super) clearance: f32,
}

/// Radial place and motion: equations that both grooves share.
pub(super) struct Shared {
    /// Unbalanced radial force, N; its change with the radial place and with the parts of the motion.
    pub(super) radial: f32,
    pub(super) by_place: f32,
    pub(super) by_motion: [f32; 4],
    /// Unbalanced generalized forces of the motion (x, y, z, speed), N; their change with the radial place and the motion.
    pub(super) forces: [f32; 4],
    pub(super) forces_by_place: [f32; 4],
    pub(super) forces_by_motion: [[f32; 4]; 4],
    /// Power lost over ball radius and nut speed, N.
    pub(super) power: f32,
}

impl Shared {
    pub(super) const NONE: Self = Self {
        radial: 0.0,
        by_place: 0.0,
        by_motion: [0.0; 4],
        forces: [0.0; 4],
        forces_by_place: [0.0; 4],
        forces_by_motion: [[0.0; 4]; 4],
        power: 0.0,
    };
}

/// Axial balance in one groove: how the axial place follows the radial place and the motion.
#[derive(Clone, Copy)]
pub(super) struct Axial {
    /// Axial force on the ball, N.
    pub(super) force: f32,
    /// Friction along the track on the ball, N.
    pub(super) along: f32,
    by_axial: f32,
    by_place: f32,
    by_motion: [f32; 4],
    radial: f32,
    forces: [f32; 4],
    /// Loads of the left and the right contact, N.
    pub(super) loads: [f32; 2],
}

/// The axial place in terms of the others: `step = right - place dx - motion dy`.
#[derive(Clone, Copy)]
pub(super) struct Follows {
    pub(super) right: f32,
    pub(super) place: f32,
    pub(super) motion: [f32; 4],
}

impl Axial {
    /// Adds both contacts of a groove to the shared equations; keeps the axial ones.
    #[inline(always)]
    pub(super) fn of(
        groove: &ElasticGroove,
        touches: &[Option<Touch>; 2],
        motion: &Motion,
        conditions: &Conditions,
        shared: &mut Shared,
    ) -> Self {
        let mut axial = Self {
            force: 0.0,
            along: 0.0,
            by_axial: 0.0,
            by_place: 0.0,
            by_motion: [0.0; 4],
            radial: 0.0,
            forces: [0.0; 4],
            loads: [0.0; 2],
        };
        for (touch, load) in touches.iter().zip(&mut axial.loads) {
            if let Some(touch) = touch {
                *load = touch.load;
            }
        }
        for touch in touches.iter().flatten() {
            axial.add(groove, touch, motion, conditions, shared);
        }
        axial
    }

    #[inline(never)]
    fn add(
        &mut self,
        groove: &ElasticGroove,
        touch: &Touch,
        motion: &Motion,
        conditions: &Conditions,
        shared: &mut Shared,
    ) {
        let slip = Slipping::of(groove, touch, motion);
        let Touch {
            nx,
            nz,
            per_distance,
            load,
            stiffness,
            ..
        } = *touch;
        let friction = conditions.friction;
        let limit = friction * load;
        // Forces on the ball: load along -n, friction across the track along (nz, -nx).
        let across = -friction * slip.across;
        let (hx, hz) = (across * nz - nx, -nz - across * nx);
        shared.radial += load * hx;
        self.force += load * hz;
        self.along -= limit * slip.along;

        let growth = (-1.0 / 3.0) * friction * slip.across_growth;
        let (kx, kz) = (
            stiffness * (hx + growth * nz),
            stiffness * (hz - growth * nx),
        );
        let turned = load * per_distance;
        let (gx, gz) = (turned * (-nz - across * nx), turned * (nx - across * nz));
        shared.by_place += kx * nx + gx * nz;
        self.radial += kx * nz - gx * nx;
        self.by_place += kz * nx + gz * nz;
        self.by_axial += kz * nz - gz * nx;

        let Row { speed, x, y, z } = slip.by_across;
        let (to_x, to_z) = (-limit * nz, limit * nx);
        let row = [x, y, z, speed];
        for ((radial, axial), by) in shared
            .by_motion
            .iter_mut()
            .zip(&mut self.by_motion)
            .zip(row)
        {
            *radial += to_x * by;
            *axial += to_z * by;
        }

        let grown = friction * stiffness;
        let turned = limit * per_distance;
        let of = |gradient: f32, growth: f32, turn: f32| {
            (grown * (gradient + (1.0 / 3.0) * growth), turned * turn)
        };
        let (gradient, growth, turn) = (&slip.gradient, &slip.growth, &slip.turn);
        let parts = [
            (gradient.x, of(gradient.x, growth.x, turn.x)),
            (gradient.y, of(gradient.y, growth.y, turn.y)),
            (gradient.z, of(gradient.z, growth.z, turn.z)),
            (gradient.speed, of(gradient.speed, growth.speed, turn.speed)),
        ];
        for (((force, by_place), by_axial), (gradient, (u, w))) in shared
            .forces
            .iter_mut()
            .zip(&mut shared.forces_by_place)
            .zip(&mut self.forces)
            .zip(parts)
        {
            *force += limit * gradient;
            *by_place += u * nx + w * nz;
            *by_axial += u * nz - w * nx;
        }
        hessian(&mut shared.forces_by_motion, &slip, limit, (nx, nz));
        shared.power += limit * slip.power;
    }

    /// Eliminates the axial place, where `right` is the axial force that the ball needs from this groove, N.
    #[inline(always)]
    pub(super) fn eliminated(&self, needed: f32, shared: &mut Shared) -> Follows {
        let inverse = 1.0 / self.by_axial;
        let right = inverse * (self.force - needed);
        let place = inverse * self.by_place;
        let motion = self.by_motion.map(|by| inverse * by);
        shared.radial -= self.radial * right;
        shared.by_place -= self.radial * place;
        for (by, follows) in shared.by_motion.iter_mut().zip(motion) {
            *by -= self.radial * follows;
        }
        for (((force, by_place), row), by_axial) in shared
            .forces
            .iter_mut()
            .zip(&mut shared.forces_by_place)
            .zip(&mut shared.forces_by_motion)
            .zip(self.forces)
        {
            *force -= by_axial * right;
            *by_place -= by_axial * place;
            for (entry, follows) in row.iter_mut().zip(motion) {
                *entry -= by_axial * follows;
            }
        }
        Follows {
            right,
            place,
            motion,
        }
    }
}

/// Adds the second derivatives of a contact's power by the motion.
#[inline(always)]
fn hessian(rows: &mut [[f32; 4]; 4], slip: &Slipping, limit: f32, (nx, nz): (f32, f32)) {
    let (a, b) = (&slip.by_across, &slip.by_along);
    let (q1x, q1z) = slip.tilt_across;
    let (q2x, q2z) = slip.tilt_along;
    let stick = slip.stick;
    let xx = limit * (a.x * q1x + b.x * q2x + stick * nx * nx);
    let xz = limit * (a.x * q1z + b.x * q2z + stick * nx * nz);
    let zz = limit * (a.z * q1z + b.z * q2z + stick * nz * nz);
    let (xy, yy, yz) = (limit * a.x, limit * a.y, limit * a.z);
    let (sx, sy, sz, ss) = (limit * b.x, limit * b.y, limit * b.z, limit * b.speed);
    let [x, y, z, speed] = rows;
    let add = |row: &mut [f32; 4], values: [f32; 4]| {
        for (entry, value) in row.iter_mut().zip(values) {
            *entry += value;
        }
    };
    add(x, [xx, xy, xz, sx]);
    add(y, [xy, yy, yz, sy]);
    add(z, [xz, yz, zz, sz]);
    add(speed, [sx, sy, sz, ss]);
}
