//! Place and motion of a ball from nothing.

use super::contact::Touch;
use super::grooves::ElasticGrooves;
use super::renewal::{BallInputs, Settled};
use crate::math;

/// Part of sliding friction that contacts have across the track, to begin with.
const SHARE: f32 = 0.65;

/// Steps in which the ball finds its place.
const STEPS: usize = 6;

/// Balance of a ball in one groove under given friction across the track.
struct Side {
    radial: f32,
    axial: f32,
    xx: f32,
    xz: f32,
    zx: f32,
    zz: f32,
}

impl Side {
    fn of(touches: &[Option<Touch>; 2], across: f32) -> Self {
        let mut side = Self {
            radial: 0.0,
            axial: 0.0,
            xx: 0.0,
            xz: 0.0,
            zx: 0.0,
            zz: 0.0,
        };
        for touch in touches.iter().flatten() {
            let (nx, nz) = (touch.nx, touch.nz);
            let (hx, hz) = (across * nz - nx, -nz - across * nx);
            side.radial += touch.load * hx;
            side.axial += touch.load * hz;
            let turned = touch.load * touch.per_distance;
            let (gx, gz) = (turned * (-nz - across * nx), turned * (nx - across * nz));
            let (kx, kz) = (touch.stiffness * hx, touch.stiffness * hz);
            side.xx += kx * nx + gx * nz;
            side.xz += kx * nz - gx * nx;
            side.zx += kz * nx + gz * nz;
            side.zz += kz * nz - gz * nx;
        }
        side
    }
}

impl ElasticGrooves {
    /// A ball that rolls as a nominal one does, its third contact closed, under the load.
    #[must_use]
    pub fn start(&self, inputs: &BallInputs) -> Settled {
        let load = inputs.axial_load;
        let side = if load < 0.0 { -1.0 } else { 1.0 };
        let third_on_screw = load < 0.0;
        let gap = inputs.clearance / self.ball_radius;
        let normal = load.abs() / (self.sin * self.cos_lead);
        let powers = |normal: f32| {
            let root = math::cbrt(normal);
            root * root
        };
        let power = powers(normal);
        let light = powers(2.0 * SHARE * inputs.friction * normal);
        let squeezed = if gap < 0.0 { -2.0 * gap } else { 0.0 };
        let screw_main = power / self.screw.stiffness + 0.5 * squeezed;
        let nut_main = power / self.nut.stiffness + 0.5 * squeezed;
        let x = if third_on_screw {
            -(screw_main + light / self.screw.stiffness + 2.0 * gap)
        } else {
            nut_main + light / self.nut.stiffness + 2.0 * gap
        } * (0.5 / self.cos);
        let x = if gap < 0.0 { 0.0 } else { x };
        let mut state = Settled {
            place: [
                x,
                -side * (screw_main + gap + self.cos * x) / self.sin,
                side * (nut_main + gap - self.cos * x) / self.sin,
            ],
            ..Settled::default()
        };
        let share = -SHARE * inputs.friction;
        for _ in 0..STEPS {
            self.place(&mut state.place, inputs, [share, -share]);
        }
        state.speed = 0.5 * (self.path + self.cos_lead * self.cos);
        state.turning = [0.0, 0.5 * self.sin_lead, state.speed / self.cos];
        state
    }

    /// One Newton step of the place alone, with friction across the track over the loads given for screw and nut.
    fn place(&self, place: &mut [f32; 3], inputs: &BallInputs, [on_screw, in_nut]: [f32; 2]) {
        let [x, screw_z, nut_z] = *place;
        let gap = inputs.clearance / self.ball_radius;
        let screw = Side::of(
            &self.touches(&self.screw, 1.0, (x, screw_z), inputs.screw_deviation, gap),
            on_screw,
        );
        let nut = Side::of(
            &self.touches(&self.nut, -1.0, (x, nut_z), inputs.nut_deviation, gap),
            in_nut,
        );
        let needed = inputs.axial_load / self.cos_lead;
        let (s, n) = (1.0 / screw.zz, 1.0 / nut.zz);
        let (rs, rn) = (s * (screw.axial - needed), n * (nut.axial + needed));
        let slope = screw.xx + nut.xx - screw.xz * s * screw.zx - nut.xz * n * nut.zx;
        let right = screw.radial + nut.radial - screw.xz * rs - nut.xz * rn;
        let dx = right / slope;
        let ds = rs - s * screw.zx * dx;
        let dn = rn - n * nut.zx * dx;
        let root = math::cbrt(inputs.axial_load.abs() / (self.sin * self.cos_lead));
        let reach = root * root / self.screw.stiffness;
        let size = dx.abs() + ds.abs() + dn.abs();
        let taken = if size > reach { reach / size } else { 1.0 };
        *place = [x - taken * dx, screw_z - taken * ds, nut_z - taken * dn];
    }
}
