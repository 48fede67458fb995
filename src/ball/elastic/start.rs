//! Place and motion of a ball from nothing.

use super::contact::{Pressed, Touch};
use super::grooves::{ElasticGroove, ElasticGrooves};
use super::renewal::{BallInputs, Settled};

/// Part of sliding friction that contacts have across the track, to begin with.
const SHARE: f32 = 0.65;

/// Steps in which the ball finds its place.
const STEPS: usize = 4;

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
    #[inline(always)]
    fn of(
        groove: &ElasticGroove,
        place: (f32, f32),
        arcs: &[(f32, f32); 2],
        clearance: f32,
        across: f32,
    ) -> Self {
        let mut side = Self {
            radial: 0.0,
            axial: 0.0,
            xx: 0.0,
            xz: 0.0,
            zx: 0.0,
            zz: 0.0,
        };
        for arc in arcs {
            if let Some(pressed) = Pressed::at(groove, place, *arc, clearance) {
                side.add(&Touch::of(groove, pressed), across);
            }
        }
        side
    }

    #[inline(always)]
    fn add(&mut self, touch: &Touch, across: f32) {
        let (nx, nz) = (touch.nx, touch.nz);
        // Forces on the ball: load along -n, friction across the track along (nz, -nx).
        let (hx, hz) = (across * nz - nx, -nz - across * nx);
        self.radial += touch.load * hx;
        self.axial += touch.load * hz;
        let turned = touch.load * touch.per_distance;
        let (gx, gz) = (turned * hz, -turned * hx);
        let (kx, kz) = (touch.stiffness * hx, touch.stiffness * hz);
        self.xx += kx * nx + gx * nz;
        self.xz += kx * nz - gx * nx;
        self.zx += kz * nx + gz * nz;
        self.zz += kz * nz - gz * nx;
    }
}

impl ElasticGrooves {
    /// A ball that rolls as a nominal one does, its third contact closed, under the load.
    #[must_use]
    #[inline]
    pub fn start(&self, inputs: &BallInputs) -> Settled {
        let mut place = self.first(inputs);
        let arcs = [
            self.arcs(&self.screw, 1.0, inputs.screw_deviation),
            self.arcs(&self.nut, -1.0, inputs.nut_deviation),
        ];
        let reach = self.deflection(inputs.axial_load) + inputs.clearance.abs() * self.per_radius;
        for _ in 0..STEPS {
            self.place(&mut place, inputs, &arcs, reach);
        }
        let speed = 0.5 * (self.path + self.cos_lead * self.cos);
        Settled {
            place,
            turning: [0.0, 0.5 * self.sin_lead, speed / self.cos],
            speed,
        }
    }

    /// Place by hand: main contacts under the load, the third one under what friction presses on it.
    #[inline(always)]
    fn first(&self, inputs: &BallInputs) -> [f32; 3] {
        let load = inputs.axial_load;
        let side = if load < 0.0 { -1.0 } else { 1.0 };
        let gap = inputs.clearance * self.per_radius;
        let screw_power = self.deflection(load);
        let light = self.deflection(2.0 * SHARE * inputs.friction * load) + 2.0 * gap;
        // Contacts of nut and screw differ little.
        let nut_power = screw_power * self.screw.stiffness * self.nut.per_stiffness;
        let (squeezed, x) = if gap < 0.0 {
            (-gap, 0.0)
        } else if load < 0.0 {
            (0.0, -0.5 * (screw_power + light) / self.cos)
        } else {
            (0.0, 0.5 * (nut_power + light) / self.cos)
        };
        let out = self.cos * x;
        [
            x,
            -side * (screw_power + squeezed + gap + out) / self.sin,
            side * (nut_power + squeezed + gap - out) / self.sin,
        ]
    }

    /// One Newton step of the place alone, with a fixed share of friction across the track.
    #[inline(always)]
    fn place(
        &self,
        place: &mut [f32; 3],
        inputs: &BallInputs,
        arcs: &[[(f32, f32); 2]; 2],
        reach: f32,
    ) {
        let [x, screw_z, nut_z] = *place;
        let [on_screw, in_nut] = arcs;
        let gap = inputs.clearance * self.per_radius;
        let share = SHARE * inputs.friction;
        let screw = Side::of(&self.screw, (x, screw_z), on_screw, gap, -share);
        let nut = Side::of(&self.nut, (x, nut_z), in_nut, gap, share);
        let needed = inputs.axial_load * self.per_cos_lead;
        let both = 1.0 / (screw.zz * nut.zz);
        let (s, n) = (both * nut.zz, both * screw.zz);
        let (rs, rn) = (s * (screw.axial - needed), n * (nut.axial + needed));
        let (ss, sn) = (s * screw.zx, n * nut.zx);
        let slope = screw.xx + nut.xx - screw.xz * ss - nut.xz * sn;
        let right = screw.radial + nut.radial - screw.xz * rs - nut.xz * rn;
        let dx = right / slope;
        let (ds, dn) = (rs - ss * dx, rn - sn * dx);
        let size = dx.abs() + ds.abs() + dn.abs();
        // A ball that has lost its contacts stays: false for NaN.
        if size < f32::MAX {
            let taken = if size > reach { reach / size } else { 1.0 };
            *place = [x - taken * dx, screw_z - taken * ds, nut_z - taken * dn];
        }
    }
}
