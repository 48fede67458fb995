//! The ball and its grooves, with constants folded at set-up; its contacts from angles and forces.

use super::contacts::{ScrewContact, ScrewContacts};
use super::motion::{ScrewBallMotion, ScrewBallState, ScrewContactMotion};
use crate::ball::loaded;
use crate::contact::SlipMap;
use crate::error::{Error, Range, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::{self, constant, inverse_cube_roots};
use crate::ranges;

/// Spin below which a contact sticks, over the nut's speed; contacts of a ball spin with about three.
///
/// The orbital speed of a ball in two contacts, of which one does stick, is off in proportion: by 5e-5, 1.8e-4 and 5e-4 of
/// the nut's speed after five steps at 0.003, 0.01 and 0.03. A third contact that slides converges the better the larger
/// it is. Scans here and below: 150 to 300 random balls of each kind against equilibrium of Coulomb friction (the designs
/// and loads of `host-tests/tests/balls/screw_ball.rs`), one constant at a time. That the chosen ones settle is shown by
/// `host-tests/tests/generators/refined_balls.rs` for 100 000 balls.
pub(super) const STICK_SPIN: f32 = 0.01;

/// Sum of the sizes of a motion's parts, in ball radii and radians per radian of the nut, beyond which it is no
/// ball's.
const LARGEST_MOTION: f32 = 1e6;

/// Smallest contact force, N: below it a contact is lost.
const LEAST_FORCE: f32 = 1e-9;

/// Signs of the radial and the axial component of the direction from the ball's centre to the contact:
/// SL, SR, NL, NR.
const QUADRANTS: [(f32, f32); 4] = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];

/// A ball in the grooves of a ball screw with contacts that are given: angles and forces of two, three or
/// four of SL, SR, NL, NR (screw or nut; left towards the screw's negative axis, or right).
///
/// Frame of the ball: x radially outward, y along the track, z nearly along the axis. The screw stands and
/// the nut turns with `omega_N`; all lengths are in ball radii and all velocities per unit of `omega_N`. With the
/// ball's total angular velocity `Omega` and the path radius `q = r_m/cos alpha`, the length of a turn over `2 pi`, contact `k` at
/// `n = (∓cos beta, 0, ∓sin beta)` on a groove that turns with `omega_k` (0 screw, 1 nut) has
///
/// ```text
/// along the track    V_2 = (omega_B - omega_k) q + n_x Omega_z - n_z Omega_x - omega_k n_x cos alpha
/// across the track   V_1 = Omega_y - omega_k sin alpha
/// spin               w   = n_x Omega_x + n_z (Omega_z - omega_k cos alpha)
/// ```
///
/// (Lin 2019, eqs. (3.65)-(3.68), (F.4)-(F.6), in one form). A ball moves so that the power it loses in its
/// contacts is least, which is the balance (3.69) along the track and about all three axes.
///
/// | | what it is |
/// |---|---|
/// | [`ScrewBall::closed_form`] | contact impedances of rolling, then one linear system |
/// | [`ScrewBall::refine`] | impedances at the motion found, a fixed number of times |
/// | [`ScrewBall::refine_chain`] | the same for balls that press on each other |
///
/// It does not find the loads of the contacts: [`ScrewRow::contacts`](crate::ball::ScrewRow::contacts) finds them from the axial load.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::refined::{ScrewBall, ScrewChain};
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let ball = ScrewBall::new(&design, 0.1)?;
/// // SL, SR, NL, NR: two balls under SR-NL load with a light third contact, the front one slower.
/// let forces = [9.0, 75.0, 75.0, 0.0];
/// let rear = ball.contacts(&[0.785, 0.785, 0.785, 0.785], &forces);
/// let front = ball.contacts(&[0.750, 0.820, 0.785, 0.785], &forces);
/// let mut chain = ScrewChain::new([ball.start(&rear), ball.start(&front)]);
/// let room = [0.0, f32::INFINITY]; // they touch; in front of the last one is no ball
/// for _ in 0..3 {
///     ball.refine_chain(&[rear, front], &mut chain, &room, 1.0, 0.1);
/// }
/// assert!(chain.forces[0] > 1.0 && chain.forces[1] == 0.0);
/// let torque: f32 = chain.balls.iter().map(|state| state.groove_torque).sum();
/// assert!(torque > ball.ball_torque(&chain, 0.1));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBall {
    friction: f32,
    /// m; lengths below are over it.
    ball_radius: f32,
    /// Path radius `q`.
    pub(super) path: f32,
    /// 1 / nominal speed.
    pub(super) inverse_speed: f32,
    pub(super) sin_lead: f32,
    pub(super) cos_lead: f32,
    /// Speed along the track in nominal rolling, per radian of the nut.
    pub(super) nominal_speed: f32,
    /// `Omega_z` in nominal rolling with three or four contacts.
    roll: f32,
    /// Cosine and sine of the angle between the track and the force between two balls.
    pub(super) cos_between: f32,
    pub(super) sin_between: f32,
    screw: HelixGroove,
    nut: HelixGroove,
}

/// One groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct HelixGroove {
    pub(super) map: SlipMap,
    /// Semi-major axis over ball radius at one newton, `N^(-1/3)`.
    semi_major: f32,
    /// Angular velocity over the nut's.
    pub(super) speed: f32,
}

impl HelixGroove {
    const fn new(design: &BallScrew, groove: Groove, speed: f32) -> Result<Self, Error> {
        let contact = HertzContact::of(design, groove);
        Ok(Self {
            map: attempt!(SlipMap::new(contact.axis_ratio())),
            semi_major: contact.semi_major_coefficient() / design.ball_radius(),
            speed,
        })
    }
}

impl ScrewBall {
    /// Folds the constants of a validated design with the Coulomb friction coefficient of ball and groove, 1e-6 to 1: the path, the
    /// contact ellipses at the nominal contact angle, and a [`SlipMap`] for each groove. Set-up only.
    ///
    /// # Errors
    /// [`Error`] naming `friction` (1e-6 to 1), `contact_angle` (0.05 to 1.5) or `axis_ratio`.
    pub const fn new(design: &BallScrew, friction: f32) -> Result<Self, Error> {
        let friction = attempt!(ranges::FRICTION.checked("friction", friction));
        attempt!(
            ranges::ROLLING_CONTACT_ANGLE
                .checked("contact_angle", design.parameters().contact_angle)
        );
        let radius = design.ball_radius();
        let cos_lead = design.cos_lead_angle();
        let path = design.path_in_ball_radii();
        let cos = design.contact_angle().cos;
        let nominal_speed = 0.5 * (path + cos_lead * cos);
        let sin_between = 1.0 / path;
        Ok(Self {
            friction,
            ball_radius: radius,
            path,
            inverse_speed: 1.0 / nominal_speed,
            sin_lead: cos_lead * design.tan_lead_angle(),
            cos_lead,
            nominal_speed,
            roll: nominal_speed / cos,
            cos_between: constant::sqrt((1.0 - sin_between) * (1.0 + sin_between)),
            sin_between,
            screw: attempt!(HelixGroove::new(design, Groove::Screw, 0.0)),
            nut: attempt!(HelixGroove::new(design, Groove::Nut, 1.0)),
        })
    }

    /// Orbital speed over the nut's speed, 1, in nominal rolling: `(1 + r cos beta)/2` with
    /// `r = r_b r_m/q²`.
    #[must_use]
    pub fn nominal_orbital_speed(&self) -> f32 {
        self.nominal_speed * self.sin_between
    }

    /// Orbital speed over the nut's speed, 1, of a ball with this motion.
    #[must_use]
    pub fn orbital_speed(&self, motion: &ScrewBallMotion) -> f32 {
        (self.nominal_speed + motion.speed) * self.sin_between
    }

    /// Contacts from their angles, rad, and forces, N, in the order SL, SR, NL, NR.
    ///
    /// Angles outside [`ROLLING_CONTACT_ANGLE`](ranges::ROLLING_CONTACT_ANGLE) are taken at its ends, NaN at the lower one; a force below
    /// 1e-9 N, above 1e7 N, or NaN is a lost contact. Ellipses are those of the nominal contact angle.
    #[must_use]
    pub fn contacts(&self, contact_angles: &[f32; 4], contact_forces: &[f32; 4]) -> ScrewContacts {
        let Range {
            minimum: least,
            maximum: most,
        } = ranges::ROLLING_CONTACT_ANGLE;
        let [a, b, c, d] = contact_forces.map(loaded);
        let [left, right] = inverse_cube_roots([a, b]);
        let [far_left, far_right] = inverse_cube_roots([c, d]);
        let loads = [(a, left), (b, right), (c, far_left), (d, far_right)];
        let mut contact = [ScrewContact::default(); 4];
        let given = contact_angles.iter().zip(loads);
        for (((contact, given), quadrant), groove) in contact
            .iter_mut()
            .zip(given)
            .zip(&QUADRANTS)
            .zip(self.grooves())
        {
            let (&angle, (force, root)) = given;
            let angle = if angle > least { angle } else { least };
            let angle = if angle < most { angle } else { most };
            let (sin, cos) = math::sin_cos(angle);
            let (outward, right) = *quadrant;
            let (nx, nz) = (outward * cos, right * sin);
            contact.arm = (nx, nz);
            contact.along = self.nominal_speed - groove.speed * (self.path + self.cos_lead * nx);
            contact.across = -groove.speed * self.sin_lead;
            contact.spin = -groove.speed * self.cos_lead * nz;
            if force >= LEAST_FORCE {
                contact.friction = self.friction * force;
                contact.semi_major = groove.semi_major * (force * root * root);
            }
        }
        ScrewContacts { contact }
    }

    /// A motion as it is; one that is no number, or of a ball that nothing holds, becomes nominal rolling.
    #[inline]
    pub(super) fn sound(&self, motion: ScrewBallMotion) -> ScrewBallMotion {
        let [x, y, z] = motion.turn;
        // False for NaN.
        if motion.speed.abs() + x.abs() + y.abs() + z.abs() < LARGEST_MOTION {
            motion
        } else {
            self.nominal()
        }
    }

    /// Nominal rolling, with the slip across the track shared evenly by screw and nut.
    #[inline]
    pub(super) const fn nominal(&self) -> ScrewBallMotion {
        ScrewBallMotion {
            speed: 0.0,
            turn: [0.0, 0.5 * self.sin_lead, self.roll],
        }
    }

    /// Slip and spin of the four contacts at a motion, by the equations of [`ScrewBall`].
    #[must_use]
    pub fn contact_motion(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
    ) -> [ScrewContactMotion; 4] {
        contacts.contact.map(|contact| contact.motion(motion))
    }

    /// Torque on the nut that the grooves take at a motion, N m: the sum of the contacts' power losses over
    /// the nut's speed.
    #[must_use]
    pub fn groove_torque(&self, contacts: &ScrewContacts, motion: &ScrewBallMotion) -> f32 {
        let mut torque = 0.0;
        for (contact, groove) in contacts.contact.iter().zip(self.grooves()) {
            if contact.friction > 0.0 {
                let at = contact.motion(motion);
                let friction = groove.map.dissipation(
                    at.across,
                    at.along,
                    at.spin,
                    contact.semi_major,
                    STICK_SPIN,
                );
                torque += contact.friction * friction.power;
            }
        }
        torque * self.ball_radius
    }

    #[inline]
    pub(super) const fn radius(&self) -> f32 {
        self.ball_radius
    }

    #[inline]
    pub(super) fn grooves(&self) -> [&HelixGroove; 4] {
        [&self.screw, &self.screw, &self.nut, &self.nut]
    }

    /// State from a motion, the compliance of its speed, and its power loss over the ball radius.
    #[inline]
    pub(super) fn state(
        &self,
        motion: ScrewBallMotion,
        compliance: f32,
        torque: f32,
    ) -> ScrewBallState {
        ScrewBallState {
            motion,
            speed_deviation: motion.speed * self.inverse_speed,
            compliance: compliance * self.inverse_speed,
            groove_torque: torque * self.ball_radius,
        }
    }
}
