//! Place and motion of a ball that has none yet: where Newton's method begins.

use super::contact::{Pressed, Touch};
use super::grooves::{ElasticGroove, ElasticGrooves};
use super::renewal::{BallInputs, Settled};
use crate::math;

/// Part of sliding friction that contacts have across the track, to begin with.
///
/// Renewals find the true one: from 0.5 to 1 balls settle alike, in 5.2 to 5.5 renewals in the mean, 99 % within 24. Of 3000
/// balls as promised 14 never rest from 0, 3 from 0.3, at most one from 0.5 on; of heavy ones 21, 7 and 6.
const SHARE: f32 = 0.65;

/// Newton steps in which the ball finds its place.
///
/// From 0, 1, 2, 3, 4 steps on preloaded balls settle in 2.7, 1.7, 1.6, 1.6, 1.6 renewals in the mean, balls with play in 20.3,
/// 20.0, 19.5, 19.2, 18.8, and of 3000 heavy balls 18, 6, 7, 6, 6 never rest. More steps help balls with play alone: eight of
/// them save two renewals of 19, and 89 balls instead of 148 never rest; but a start counts in the tick of a reversal.
const STEPS: usize = 4;

/// Balance of a ball in one groove under given friction across the track.
struct Side {
    /// Radial force on the ball, N.
    radial: f32,
    /// Axial force on the ball, N.
    axial: f32,
    /// Change of the radial force with the radial place, N per ball radius.
    xx: f32,
    /// Change of the radial force with the axial place.
    xz: f32,
    /// Change of the axial force with the radial place.
    zx: f32,
    /// Change of the axial force with the axial place.
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
    /// Place and motion from which [`ElasticGrooves::renew`] begins: a ball that rolls as a nominal one does, with its main
    /// contacts and the third one under the load.
    ///
    /// ```text
    /// v/(omega_N r_b) = (q/r_b + cos(alpha) cos(beta))/2       omega_2/omega_N = sin(alpha)/2
    /// omega_3 = v/(r_b cos(beta))                              omega_1 = 0
    /// F = F_a/(sin(beta) cos(alpha))                           F_3 = 2 s_mu mu F
    /// ```
    ///
    /// with the speed `v` along the track, the angular velocities about the radius (1), the track (2) and the axis across both
    /// (3), the path radius `q`, the load `F` of a main contact, and `F_3` of the third one, on which friction across the
    /// track presses with the share `s_mu` of sliding friction. The place follows from these loads, then from Newton steps of
    /// the place alone. An oversized ball starts from the middle of its four contacts.
    ///
    /// Takes what `renew` takes, loads of both signs; always gives a finite place, which is not in balance yet: deviations turn
    /// the arcs, but not the motion. Cost: [`SCREW_START`](crate::promises::SCREW_START).
    ///
    /// Source: not in Lin 2019, which leaves the start open; motion as a nominal ball's, loads by its equations (2.14) and
    /// (3.69).
    #[must_use]
    #[inline(never)]
    pub fn start(&self, inputs: &BallInputs) -> Settled {
        let arcs = [
            self.arcs(&self.screw, 1.0, inputs.screw_deviation),
            self.arcs(&self.nut, -1.0, inputs.nut_deviation),
        ];
        let mut place = self.first(inputs, &arcs);
        // An oversized ball lies by what its contacts give way without a load too.
        let gap = inputs.clearance * self.per_radius;
        let squeezed = if gap < 0.0 { -gap } else { 0.0 };
        let reach = self.deflection(inputs.axial_load) + squeezed;
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

    /// Place by hand: main contacts under the load, the third one under what friction presses on it. Exact in the gap, which
    /// under a light load is far larger than what the contacts give way.
    #[inline(always)]
    fn first(&self, inputs: &BallInputs, [[sl, sr], [nl, nr]]: &[[(f32, f32); 2]; 2]) -> [f32; 3] {
        let load = inputs.axial_load;
        let gap = inputs.clearance * self.per_radius;
        let screw_power = self.deflection(load);
        // Contacts of nut and screw differ little.
        let nut_power = screw_power * self.screw.stiffness * self.nut.per_stiffness;
        if gap < 0.0 {
            let side = if load < 0.0 { -1.0 } else { 1.0 };
            return [
                0.0,
                -side * screw_power / self.sin,
                side * nut_power / self.sin,
            ];
        }
        let third = gap + self.deflection(2.0 * SHARE * inputs.friction * load);
        let (screw, nut) = (self.screw.centre + gap, self.nut.centre + gap);
        if load < 0.0 {
            let (x, z) = touching((*sr, screw + screw_power), (*sl, self.screw.centre + third));
            [x, z, beside(*nl, nut + nut_power, x)]
        } else {
            let (x, z) = touching((*nr, nut + nut_power), (*nl, self.nut.centre + third));
            [x, beside(*sl, screw + screw_power, x), z]
        }
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

/// The place at two distances from the centres of a groove's arcs, on the side of the groove's middle.
#[inline(always)]
fn touching(
    ((x, z), distance): ((f32, f32), f32),
    ((ax, az), other): ((f32, f32), f32),
) -> (f32, f32) {
    let (dx, dz) = (ax - x, az - z);
    let square = dx * dx + dz * dz;
    let inverse = 1.0 / square;
    let along = 0.5 * (1.0 + (distance - other) * (distance + other) * inverse);
    let off = root(distance * distance * inverse - along * along);
    // Arcs' centres lie on the ball's side of the middle, and the ball between them and the middle.
    let off = if (x < 0.0) == (dz > 0.0) { off } else { -off };
    (x + along * dx + off * dz, z + along * dz - off * dx)
}

/// Square root; none of what is below zero, where contacts give way so far that circles about their arcs do not meet.
#[inline(always)]
fn root(square: f32) -> f32 {
    if square > 0.0 {
        math::sqrt(square)
    } else {
        0.0
    }
}

/// The axial place, on the side of the groove's middle, at a distance from the centre of an arc.
#[inline(always)]
fn beside((ax, az): (f32, f32), distance: f32, x: f32) -> f32 {
    let off = root(distance * distance - (x - ax) * (x - ax));
    if az > 0.0 { az - off } else { az + off }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{BallScrew, CATALOGUE};
    use crate::material::Material;

    /// A ball beside an arc is as far from its centre as it is told, towards the groove's middle on either side.
    #[test]
    fn a_ball_lies_between_an_arc_and_the_middle() {
        let (x, distance) = (0.1_f32, 0.9_f32);
        for centre in [(0.3_f32, 0.5_f32), (0.3, -0.5)] {
            let (ax, az) = centre;
            let z = beside(centre, distance, x);
            assert!((z < az) == (az > 0.0), "{z}");
            // Derived: a root of rounded squares.
            assert!(((x - ax).hypot(z - az) - distance).abs() < 2e-7);
        }
    }

    /// Loads that no screw bears, to 1e7 N a ball, leave a ball somewhere: no place that is no number gets into a state.
    #[test]
    fn crushed_balls_have_a_place() {
        let soft = Material {
            youngs_modulus: 1e6,
            ..Material::STEEL
        };
        let designs = CATALOGUE.iter().flat_map(|size| {
            let mut parameters = size.parameters();
            let steel = parameters;
            (parameters.ball_material, parameters.groove_material) = (soft, soft);
            [steel, parameters]
        });
        for parameters in designs {
            let grooves = ElasticGrooves::new(&BallScrew::new(parameters).unwrap()).unwrap();
            let mut load = 1.0;
            while load < 1e7 {
                for clearance in [-2e-5, 0.0, 2e-5] {
                    for axial_load in [load, -load] {
                        let mut inputs = BallInputs::alone(axial_load, 0.1, clearance);
                        (inputs.screw_deviation, inputs.nut_deviation) = (0.03, -0.03);
                        let place = grooves.start(&inputs).place;
                        assert!(
                            place.iter().all(|length| length.is_finite()),
                            "{parameters:?} {axial_load} {clearance}: {place:?}"
                        );
                    }
                }
                load *= 1.3;
            }
        }
    }
}
