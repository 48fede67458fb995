//! A ball in up to four contacts on a straight or circular track, moving with the least loss.

use super::symmetric::{System, Vector};
use crate::ball::loaded;
use crate::contact::FrictionMap;
use crate::error::{Error, attempt};
use crate::math::{self, constant, inverse_cube_roots};

/// Newton steps from the four-force start that [`FourPointBall::solve`] takes: three are enough for
/// loads under which contact angle deviations move the contacts by less than their own size.
pub const DEFAULT_NEWTON_STEPS: u8 = 5;

/// Contact angles are taken at most this far from the nominal one, rad.
pub const LARGEST_ANGLE_DEVIATION: f32 = 0.3;

/// Longest Newton step, in units of the track speed, as the sum of its parts: contact spins are about
/// one half.
const STEP_LIMIT: f32 = 0.5;

/// Longest change of a contact's slip in one Newton step, over the slip it has and the slip at which its
/// velocity centre reaches the rim. Friction saturates at the rim: a step that reaches far beyond it,
/// or far through zero from beyond it, relies on a stiffness that is not there.
const REACH: f32 = 0.6;

/// The reach of a lost contact.
const ANY: f32 = 1e9;

/// Below this ratio of the weaker to the stronger diagonal's load, the start also tries two-point
/// rolling. The switch itself lies below 0.06 for contact angle deviations up to 3 degrees.
const WEAK_DIAGONAL: f32 = 0.1;

/// Largest deviation from nominal rolling, in units of the track speed, as the sum of its parts; nominal
/// rolling itself is 7 at the steepest contact angle. A ball comes back from it in some 30 steps.
const LARGEST_MOTION: f32 = 16.0;

/// Largest net force of the neighbours, N.
const LARGEST_AXIAL_FORCE: f32 = 1e7;

/// Position of the contacts BL, BR, TR, TL about the ball's centre: signs of cosine and sine.
const QUADRANTS: [(f32, f32); 4] = [(-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];

/// A ball in a four-point contact bearing, linear or rotary, with constants folded at set-up.
///
/// Velocities are in units of the track speed `v`: the speed of the top groove of a linear bearing, or
/// inner speed times pitch radius of a rotary one. With ball speed `v_B` and rotation `omega_x`,
/// `omega_y` about the axes across the track, contact `i` at `(n_x, n_y) = (∓cos beta_i, ±sin beta_i)`
/// has
///
/// ```text
/// slip V_i = v_B + R_B (n_x omega_x + n_y omega_y) - groove speed
/// spin w_i = n_y omega_x - n_x omega_y - groove spin
/// ```
///
/// (Lin 2019, eqs. (3.11), (3.13), (3.23), (F.1)-(F.3); the printed `omega_IR`, `omega_OR` have the
/// wrong sign). Equilibrium (3.19), (3.25) says that the ball moves with the least dissipation
/// `sum D_i(V_i, w_i)`, a convex function of three unknowns. Rotary and linear bearings differ in the
/// speeds of the grooves only.
///
/// Made by [`FourPointBall::linear`] or inside [`RotaryBall`](crate::refined::RotaryBall).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FourPointBall {
    friction: f32,
    contact_angle: f32,
    cos: f32,
    sin: f32,
    speed: f32,
    inverse_speed: f32,
    stick_spin: f32,
    lower: Track,
    upper: Track,
}

/// One groove, in units of ball radius and track speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Track {
    pub(super) map: FrictionMap,
    /// Semi-major axis over ball radius at one newton, `N^(-1/3)`.
    pub(super) semi_major: f32,
    /// Rotation of the ball relative to the groove, about the axis across, in nominal rolling.
    pub(super) roll: f32,
}

/// Angles and loads of a ball's contacts, as the equations of motion take them.
///
/// Made by [`FourPointBall::contacts`]; one per ball and tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FourPointContacts {
    contact: [Contact; 4],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Contact {
    /// `(n_x, n_y)`: gradient of the slip in roll and yaw.
    arm: (f32, f32),
    /// Slip and spin in nominal rolling.
    slip: f32,
    spin: f32,
    /// Friction force `mu F` at full slip, N; 0 where the contact is lost.
    friction: f32,
    /// Semi-major axis over ball radius.
    semi_major: f32,
}

/// Motion of a ball relative to nominal rolling, in units of the track speed.
///
/// Nominal rolling is that of a ball with four equal contact angles; deviations from it are small, and
/// so they keep their digits in f32.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallMotion {
    /// Deviation of the ball's speed along the track.
    pub speed: f32,
    /// Deviation of `R_B omega_x`, the rotation about the axis from left to right.
    pub roll: f32,
    /// `R_B omega_y`, the rotation about the axis from bottom to top.
    pub yaw: f32,
}

/// What is kept of a ball from tick to tick, and what is known of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallState {
    /// Motion of the ball: where the next Newton step starts.
    pub motion: BallMotion,
    /// Relative deviation `epsilon` of the ball's speed from nominal rolling.
    pub speed_deviation: f32,
    /// Change of the speed deviation with a force along the track, 1/N.
    pub compliance: f32,
    /// Power loss in the grooves over the track speed, N: the drag on the moving groove.
    pub friction_force: f32,
}

impl BallState {
    /// A ball in nominal rolling.
    pub const NOMINAL: Self = Self {
        motion: BallMotion {
            speed: 0.0,
            roll: 0.0,
            yaw: 0.0,
        },
        speed_deviation: 0.0,
        compliance: 0.0,
        friction_force: 0.0,
    };
}

/// Slip and spin of one contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactMotion {
    /// Slip of the ball on the groove at the contact's centre, in units of the track speed.
    pub slip: f32,
    /// Spin of the ball on the groove, in units of track speed over ball radius.
    pub spin: f32,
}

/// One Newton step before the neighbours' force is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Proposal {
    /// Power loss at the motion before the step.
    power: f32,
    /// `(moments - g)` times the free step: twice what it takes from the dissipation.
    decrement: f32,
    /// Step without a force along the track.
    pub(super) free: Vector,
    /// Step per unit force along the track.
    pub(super) column: Vector,
    /// Longest changes of the contacts' slips.
    reach: [f32; 4],
}

impl Proposal {
    pub(super) const EMPTY: Self = Self {
        power: 0.0,
        decrement: 0.0,
        free: Vector::ZERO,
        column: Vector::ZERO,
        reach: [ANY; 4],
    };
}

impl FourPointBall {
    pub(super) const fn folded(
        friction: f32,
        contact_angle: f32,
        speed: f32,
        stick_spin: f32,
        lower: Track,
        upper: Track,
    ) -> Self {
        let (sin, cos) = constant::sin_cos(contact_angle);
        Self {
            friction,
            contact_angle,
            cos,
            sin,
            speed,
            inverse_speed: 1.0 / speed,
            stick_spin,
            lower,
            upper,
        }
    }

    /// Speed of the ball in nominal rolling, in units of the track speed.
    #[must_use]
    pub const fn nominal_speed(&self) -> f32 {
        self.speed
    }

    /// `R_B omega_x` of the ball in nominal rolling, in units of the track speed.
    #[must_use]
    pub const fn nominal_roll(&self) -> f32 {
        // The upper groove never turns about the axis across: relative rotation is the ball's own.
        self.upper.roll
    }

    /// Contacts from their angles, rad, and forces, N, in the order BL, BR, TR, TL.
    ///
    /// An angle further than [`LARGEST_ANGLE_DEVIATION`] from the nominal one is taken at that limit, NaN
    /// as the nominal one; a force up to zero, above 1e7 N, or NaN is a lost contact. Sine and cosine come from their series about the nominal angle, within 1e-6 at the limit and
    /// exact in f32 up to 0.15 rad. Cost: 425 modelled cycles.
    #[inline(always)]
    #[must_use]
    pub fn contacts(
        &self,
        contact_angles: &[f32; 4],
        contact_forces: &[f32; 4],
    ) -> FourPointContacts {
        let [bottom_left, bottom_right, top_right, top_left] = contact_forces.map(loaded);
        let [left, right] = inverse_cube_roots([bottom_left, bottom_right]);
        let [far_right, far_left] = inverse_cube_roots([top_right, top_left]);
        let loads = [
            (bottom_left, left),
            (bottom_right, right),
            (top_right, far_right),
            (top_left, far_left),
        ];
        let mut contact = [Contact::default(); 4];
        let given = contact_angles.iter().zip(loads);
        for (((contact, given), quadrant), track) in contact
            .iter_mut()
            .zip(given)
            .zip(&QUADRANTS)
            .zip(self.tracks())
        {
            let (&angle, (force, root)) = given;
            let deviation = limited_angle(angle - self.contact_angle);
            let square = deviation * deviation;
            let sin = deviation - deviation * square * (1.0 / 6.0 - square * (1.0 / 120.0));
            let versine = square * (0.5 - square * (1.0 / 24.0));
            let cos_change = self.cos * versine + self.sin * sin;
            let sin_now = self.sin + (self.cos * sin - self.sin * versine);

            let (right, left) = *quadrant;
            let yaw_arm = left * sin_now;
            contact.arm = (right * (self.cos - cos_change), yaw_arm);
            contact.slip = -right * cos_change * track.roll;
            contact.spin = yaw_arm * track.roll;
            contact.friction = self.friction * force;
            contact.semi_major = track.semi_major * (force * root * root);
        }
        FourPointContacts { contact }
    }

    /// Motion from a linear problem: the four-force start.
    ///
    /// The least `sum a_i² V_i²`: friction forces linear in the slip, each contact with its exact angle
    /// and its own load (Lin 2019, eqs. (3.37) and (3.41), without the approximations that follow them;
    /// `a²` stands for `F^(2/3)`). Where one diagonal carries less than a tenth of the other, the two
    /// states in which the stronger diagonal rolls without slip and one of its contacts without spin are
    /// tried as well, and the least dissipation wins.
    ///
    /// Largest error of the speed deviation for side-force ratios up to 0.8 and contact angle deviations
    /// up to 3 degrees: 5.6e-3 of `v/2`. Cost: 1070 modelled cycles, 3700 with a weak diagonal.
    #[must_use]
    pub fn start(&self, contacts: &FourPointContacts) -> BallState {
        let slip_weights = contacts.contact.map(|contact| {
            if contact.friction > 0.0 {
                contact.semi_major * contact.semi_major
            } else {
                0.0
            }
        });
        let mut best = least_squares(contacts, &slip_weights, &[0.0; 4]);
        let [bottom_left, bottom_right, top_right, top_left] =
            contacts.contact.map(|contact| contact.friction);
        let up = bottom_left + top_right;
        let down = bottom_right + top_left;
        let (weak, strong, rolling) = if up < down {
            (up, down, [0.0, 1.0, 0.0, 1.0])
        } else {
            (down, up, [1.0, 0.0, 1.0, 0.0])
        };
        if weak < WEAK_DIAGONAL * strong {
            let [left, right, _, _] = rolling;
            let (mut least, _) = self.dissipation(contacts, best);
            for spinless in [[left, right, 0.0, 0.0], [0.0, 0.0, left, right]] {
                let candidate = least_squares(contacts, &rolling, &spinless);
                let (dissipation, _) = self.dissipation(contacts, candidate);
                if dissipation < least {
                    least = dissipation;
                    best = candidate;
                }
            }
        }
        let (_, power) = self.dissipation(contacts, best);
        BallState {
            motion: best,
            speed_deviation: best.speed * self.inverse_speed,
            compliance: 0.0,
            friction_force: power,
        }
    }

    /// Motion after the four-force start and [`DEFAULT_NEWTON_STEPS`] Newton steps, with no force from
    /// neighbours: what to set a ball to before the first tick.
    ///
    /// Near two-point rolling the exact speed jumps (see [`AnalyticLinearBall`](crate::ball::AnalyticLinearBall)).
    /// Angle deviations of the bottom groove up to 3 degrees: within 5e-6 of `v/2` up to 0.01 of the
    /// side-force ratio before the jump, within 8e-4 from 0.01 after it on, and in between off by up to the
    /// jump itself, 8e-3 per degree.
    ///
    /// Cost: 7300 modelled cycles, 10000 with a
    /// weak diagonal.
    #[must_use]
    pub fn solve(&self, contacts: &FourPointContacts) -> BallState {
        self.refine(contacts, &self.start(contacts), 0.0, DEFAULT_NEWTON_STEPS)
    }

    /// Motion after `steps` damped Newton steps from a known state; see [`FourPointBall::step`]. No more
    /// than ten are taken.
    #[must_use]
    pub fn refine(
        &self,
        contacts: &FourPointContacts,
        state: &BallState,
        axial_force: f32,
        steps: u8,
    ) -> BallState {
        let mut state = *state;
        for _ in 0..steps.min(10) {
            state = self.step(contacts, &state, axial_force);
        }
        state
    }

    /// Motion after one damped Newton step from a known state: what to do once a tick, from the last
    /// tick's state.
    ///
    /// The step solves the damped equations `(H + 1e-6 tr H) dy = axial_force - g` for gradient `g` and
    /// Hessian `H` of the dissipation, and is shortened so that no contact's slip changes by more than
    /// 0.6 of the slip it has and of the slip at which its friction saturates. That takes the place of a
    /// line search: the dissipation is not evaluated again, and the cost does not depend on the data.
    /// `axial_force`, N, is the net force of the neighbours in the direction of the track speed; NaN, or
    /// more than 1e7 N, counts as zero. A ball that no contact holds, or whose state was spoilt, starts
    /// again from nominal rolling as soon as it is faster than any ball can be.
    ///
    /// The state's compliance belongs to the start of the step, its drag to the end, to second order in
    /// the step. Cost with [`FourPointBall::contacts`]: 1450 modelled cycles, 26 more for every contact
    /// whose velocity centre lies outside its ellipse.
    #[inline]
    #[must_use]
    pub fn step(
        &self,
        contacts: &FourPointContacts,
        state: &BallState,
        axial_force: f32,
    ) -> BallState {
        let axial_force = counted(axial_force);
        let proposal = self.propose(contacts, state.motion, None);
        self.advance(contacts, state.motion, &proposal, axial_force, None)
    }

    /// Slip and spin of the four contacts at a motion.
    #[must_use]
    pub fn contact_motion(
        &self,
        contacts: &FourPointContacts,
        motion: &BallMotion,
    ) -> [ContactMotion; 4] {
        contacts.contact.map(|contact| contact.at(*motion))
    }

    /// Speed with which two touching balls rub, in units of the track speed (Lin 2019, eq. (3.26)).
    ///
    /// Balls that roll alike rub with `1/cos(contact angle)`, eq. (3.52).
    #[must_use]
    pub fn rubbing_speed(&self, rear: &BallMotion, front: &BallMotion) -> f32 {
        let (roll, yaw) = self.rubbing(rear, front);
        math::sqrt(roll * roll + yaw * yaw)
    }

    /// Sum of two balls' rotations: the velocity of their surfaces against each other.
    #[inline]
    pub(super) fn rubbing(&self, rear: &BallMotion, front: &BallMotion) -> (f32, f32) {
        (
            2.0 * self.nominal_roll() + rear.roll + front.roll,
            rear.yaw + front.yaw,
        )
    }

    /// Relative speed deviation of a motion.
    #[inline]
    pub(super) fn speed_deviation(&self, speed: f32) -> f32 {
        speed * self.inverse_speed
    }

    #[inline]
    fn tracks(&self) -> [&Track; 4] {
        [&self.lower, &self.lower, &self.upper, &self.upper]
    }

    /// Potential and power loss at a motion, N.
    #[inline]
    fn dissipation(&self, contacts: &FourPointContacts, motion: BallMotion) -> (f32, f32) {
        let mut potential = 0.0;
        let mut power = 0.0;
        for (contact, track) in contacts.contact.iter().zip(self.tracks()) {
            if contact.friction > 0.0 {
                let ContactMotion { slip, spin } = contact.at(motion);
                let at = track
                    .map
                    .dissipation(slip, spin, contact.semi_major, self.stick_spin);
                potential += contact.friction * at.potential;
                power += contact.friction * at.power;
            }
        }
        (potential, power)
    }

    /// The Newton step at a motion, with moments `(roll, yaw)` of the neighbours' friction over the ball
    /// radius, N.
    #[inline(always)]
    pub(super) fn propose(
        &self,
        contacts: &FourPointContacts,
        motion: BallMotion,
        moments: Option<(f32, f32)>,
    ) -> Proposal {
        let mut power = 0.0;
        let mut reach = [ANY; 4];
        let mut system = System::EMPTY;
        let grooves = contacts.contact.iter().zip(self.tracks());
        for ((contact, track), reach) in grooves.zip(&mut reach) {
            // A lost contact has no ellipse.
            if contact.friction > 0.0 {
                let ContactMotion { slip, spin } = contact.at(motion);
                let (arm_roll, arm_yaw) = contact.arm;
                let weight = contact.friction;
                let at = track
                    .map
                    .dissipation(slip, spin, contact.semi_major, self.stick_spin);
                power += weight * at.power;
                *reach = REACH * (at.rim + slip.abs());

                let (force, moment) = (weight * at.force, weight * at.moment);
                system.right.roll -= force * arm_roll + moment * arm_yaw;
                system.right.yaw -= force * arm_yaw - moment * arm_roll;
                system.right.speed -= force;
                system.add_slip(
                    weight * at.stiffness,
                    arm_roll - at.tilt * arm_yaw,
                    arm_yaw + at.tilt * arm_roll,
                );
                system.add_spin(weight * at.stick, arm_yaw, -arm_roll);
            }
        }
        if let Some((roll, yaw)) = moments {
            system.right.roll += roll;
            system.right.yaw += yaw;
        }
        let factors = system.factors();
        let free = factors.solve(system.right);
        Proposal {
            power,
            decrement: system.right.dot(free),
            free,
            column: factors.speed_column(),
            reach,
        }
    }

    /// Takes a Newton step under the net force of the neighbours.
    #[inline(always)]
    pub(super) fn advance(
        &self,
        contacts: &FourPointContacts,
        motion: BallMotion,
        proposal: &Proposal,
        axial_force: f32,
        moments: Option<(f32, f32)>,
    ) -> BallState {
        let Proposal {
            power,
            decrement,
            free,
            column,
            reach,
        } = proposal;
        let roll = free.roll + axial_force * column.roll;
        let yaw = free.yaw + axial_force * column.yaw;
        let speed = free.speed + axial_force * column.speed;

        let length = roll.abs() + yaw.abs() + speed.abs();
        // The least of one and all ratios of allowed and wanted change, with one division.
        let (mut allowed, mut wanted) = if length > STEP_LIMIT {
            (STEP_LIMIT, length)
        } else {
            (1.0, 1.0)
        };
        for (contact, &reach) in contacts.contact.iter().zip(reach) {
            let (arm_roll, arm_yaw) = contact.arm;
            let change = (speed + arm_roll * roll + arm_yaw * yaw).abs();
            if allowed * change > wanted * reach {
                (allowed, wanted) = (reach, change);
            }
        }
        let scale = allowed / wanted;
        let motion = BallMotion {
            speed: motion.speed + scale * speed,
            roll: motion.roll + scale * roll,
            yaw: motion.yaw + scale * yaw,
        };

        // What cannot be is not carried into the next tick.
        let size = motion.speed.abs() + motion.roll.abs() + motion.yaw.abs();
        // True for NaN, too.
        if !(size <= LARGEST_MOTION) {
            return BallState::NOMINAL;
        }

        // With the whole step dy and all outer forces L: H dy = L - g, so that the loss changes by
        // scale g dy + scale²/2 (L - g) dy.
        let pull = decrement + axial_force * (2.0 * free.speed + axial_force * column.speed);
        let mut work = axial_force * speed;
        if let Some((moment_roll, moment_yaw)) = moments {
            work += moment_roll * roll + moment_yaw * yaw;
        }
        let friction_force = power + scale * (work - (1.0 - 0.5 * scale) * pull);
        BallState {
            motion,
            speed_deviation: motion.speed * self.inverse_speed,
            compliance: column.speed * self.inverse_speed,
            friction_force: larger(friction_force, 0.0),
        }
    }
}

impl FourPointContacts {
    /// Semi-major axis of each contact over the ball radius, in the order BL, BR, TR, TL; 0 where a
    /// contact is lost. Within 5.4e-5.
    #[must_use]
    pub fn semi_major(&self) -> [f32; 4] {
        self.contact.map(|contact| contact.semi_major)
    }
}

impl Contact {
    #[inline]
    fn at(&self, motion: BallMotion) -> ContactMotion {
        let (roll, yaw) = self.arm;
        ContactMotion {
            slip: self.slip + motion.speed + roll * motion.roll + yaw * motion.yaw,
            spin: self.spin + yaw * motion.roll - roll * motion.yaw,
        }
    }
}

impl Track {
    pub(super) const fn new(
        axis_ratio: f32,
        semi_major: f32,
        ball_radius: f32,
        roll: f32,
    ) -> Result<Self, Error> {
        Ok(Self {
            map: attempt!(FrictionMap::new(axis_ratio)),
            semi_major: semi_major / ball_radius,
            roll,
        })
    }
}

/// The motion with the least sum of weighted squares of slip and spin.
fn least_squares(
    contacts: &FourPointContacts,
    slip_weights: &[f32; 4],
    spin_weights: &[f32; 4],
) -> BallMotion {
    let mut system = System::EMPTY;
    let weights = slip_weights.iter().zip(spin_weights);
    for (contact, (&slip_weight, &spin_weight)) in contacts.contact.iter().zip(weights) {
        let (roll, yaw) = contact.arm;
        let (slip, spin) = (slip_weight * contact.slip, spin_weight * contact.spin);
        system.right.roll -= slip * roll + spin * yaw;
        system.right.yaw -= slip * yaw - spin * roll;
        system.right.speed -= slip;
        system.add_slip(slip_weight, roll, yaw);
        system.add_spin(spin_weight, yaw, -roll);
    }
    let Vector { roll, yaw, speed } = system.factors().solve(system.right);
    BallMotion { speed, roll, yaw }
}

#[inline]
fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}

/// A force within what a contact can carry; what is no number, or beyond, is none.
#[inline]
fn counted(force: f32) -> f32 {
    if force.abs() <= LARGEST_AXIAL_FORCE {
        force
    } else {
        0.0
    }
}

/// An angle's deviation within the limits of the series; NaN gives zero.
#[inline]
fn limited_angle(deviation: f32) -> f32 {
    if deviation.abs() <= LARGEST_ANGLE_DEVIATION {
        deviation
    } else if deviation.is_nan() {
        0.0
    } else {
        LARGEST_ANGLE_DEVIATION.copysign(deviation)
    }
}
