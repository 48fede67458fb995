//! One ball with given contacts: speed, impedance, spin and losses in closed form.

use crate::ball::loaded;
use crate::contact::SlipMap;
use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::{self, constant, inverse_cube_roots};

/// Contact angles are taken within these limits, rad.
pub const CONTACT_ANGLE_RANGE: (f32, f32) = (0.05, 1.5);

/// Spin below which a contact sticks, over the nut's speed.
pub(super) const STICK_SPIN: f32 = 0.01;

/// Sum of speeds that no ball reaches: ball radii and radians per radian of the nut.
const LARGEST_MOTION: f32 = 1e6;

/// Smallest contact force, N: below it a contact is lost.
const LEAST_FORCE: f32 = 1e-9;

/// Parts of the way towards a corner that [`ScrewBall::start`] tries.
const SEARCH: [f32; 3] = [0.5, 0.25, 0.1];

/// Times that the closed form shares the slip across the track between the races.
const SHARINGS: u8 = 2;

/// Ratio of the other contacts' load to that of the loaded pair from which on they hold a ball for certain.
const WEAK: f32 = 0.3;

/// Signs of the radial and the axial component of the direction from the ball's centre to the contact:
/// SL, SR, NL, NR.
const QUADRANTS: [(f32, f32); 4] = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];

/// A ball in the grooves of a ball screw with contacts that are given: angles and forces of two, three or
/// four of SL, SR, NL, NR (screw or nut; left towards the screw's negative axis, or right).
///
/// Frame of the ball: x radially outward, y along the track, z nearly along the axis. The screw stands and
/// the nut turns with `w_N`; all lengths are in ball radii and all velocities per unit of `w_N`. With the
/// ball's total angular velocity `Omega` and `L_p = sqrt(R_P² + (p/2 pi)²)/R_B`, contact `k` at
/// `n = (∓cos beta, 0, ∓sin beta)` on a groove that turns with `w_k` (0 screw, 1 nut) has
///
/// ```text
/// along the track    V_2 = (w_B - w_k) L_p + n_x Omega_z - n_z Omega_x - w_k n_x cos alpha
/// across the track   V_1 = Omega_y - w_k sin alpha
/// spin               w   = n_x Omega_x + n_z (Omega_z - w_k cos alpha)
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
/// Loads of the contacts come from elsewhere: [`ScrewRow::contacts`](crate::ball::ScrewRow::contacts) finds them from the axial load.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::refined::{ScrewBall, ScrewChain};
/// use epas_friction::train::Press;
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let ball = ScrewBall::new(&design, 0.1)?;
/// // SL, SR, NL, NR: two balls under SR-NL load with a light third contact, the front one slower.
/// let forces = [9.0, 75.0, 75.0, 0.0];
/// let rear = ball.contacts(&[0.785, 0.785, 0.785, 0.785], &forces);
/// let front = ball.contacts(&[0.750, 0.820, 0.785, 0.785], &forces);
/// let mut chain = ScrewChain::new([ball.start(&rear), ball.start(&front)]);
/// let mut press = Press::<2>::new();
/// for _ in 0..3 {
///     ball.refine_chain(&[rear, front], &mut chain, 1.0, 0.1, |free, compliance, forces| {
///         press.solve(free, &compliance.map(|y| 1.0 / y), &[0.0, f32::INFINITY]);
///         forces.iter_mut().zip(press.forces()).for_each(|(force, found)| *force = found);
///     });
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
    ball_radius: f32,
    pub(super) path: f32,
    pub(super) inverse_speed: f32,
    pub(super) sin_lead: f32,
    pub(super) cos_lead: f32,
    nominal_speed: f32,
    /// `Omega_z` in nominal rolling with three or four contacts.
    roll: f32,
    pub(super) cos_between: f32,
    pub(super) sin_between: f32,
    screw: Race,
    nut: Race,
}

/// One groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Race {
    pub(super) map: SlipMap,
    /// Semi-major axis over ball radius at one newton, `N^(-1/3)`.
    semi_major: f32,
    /// Angular velocity over the nut's.
    speed: f32,
}

/// Angles and forces of a ball's contacts, as the equations take them: made by [`ScrewBall::contacts`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewContacts {
    pub(super) contact: [Contact; 4],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Contact {
    /// `(n_x, n_z)`.
    pub(super) arm: (f32, f32),
    /// Slip along and across the track and spin of a ball at its nominal speed that does not turn.
    along: f32,
    across: f32,
    spin: f32,
    /// Friction force `mu F` at full slip, N; 0 where the contact is lost.
    pub(super) friction: f32,
    /// Semi-major axis over ball radius.
    pub(super) semi_major: f32,
}

/// Motion of a ball per unit of nut speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBallMotion {
    /// Speed along the track less the nominal one, ball radii.
    pub speed: f32,
    /// Total angular velocity about x (radial), y (along the track) and z.
    pub turn: [f32; 3],
}

/// Slip and spin of one contact per unit of nut speed; ball minus groove.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewContactMotion {
    /// Slip across the track, along the major axis of the contact, ball radii.
    pub across: f32,
    /// Slip along the track, ball radii.
    pub along: f32,
    /// Spin about the normal that points into the groove.
    pub spin: f32,
}

/// What is known of a ball, and kept of it from tick to tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBallState {
    /// Motion of the ball: where the next step starts.
    pub motion: ScrewBallMotion,
    /// Relative deviation of the orbital speed from [`ScrewBall::nominal_orbital_speed`].
    pub speed_deviation: f32,
    /// Change of that with a force along the track, 1/N.
    pub compliance: f32,
    /// Power loss in the grooves over the nut's speed, N m.
    pub groove_torque: f32,
}

impl Race {
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
    /// Folds the constants of a design: set-up only.
    ///
    /// # Errors
    /// [`Error`] naming `friction` (1e-6 to 0.5), `contact_angle` (0.05 to 1.5) or `axis_ratio`.
    pub const fn new(design: &BallScrew, friction: f32) -> Result<Self, Error> {
        let friction = attempt!(in_range("friction", friction, 1e-6, 0.5));
        let (least, most) = CONTACT_ANGLE_RANGE;
        attempt!(in_range(
            "contact_angle",
            design.parameters().contact_angle,
            least,
            most,
        ));
        let radius = design.ball_radius();
        let cos_lead = design.cos_lead_angle();
        let path = design.pitch_radius() / (cos_lead * radius);
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
            screw: attempt!(Race::new(design, Groove::Screw, 0.0)),
            nut: attempt!(Race::new(design, Groove::Nut, 1.0)),
        })
    }

    /// Orbital speed over the nut's speed in nominal rolling, `(1 + r cos beta)/2` with
    /// `r = R_B R_P/(L/2 pi)²`.
    #[must_use]
    pub fn nominal_orbital_speed(&self) -> f32 {
        self.nominal_speed * self.sin_between
    }

    /// Orbital speed over the nut's speed.
    #[must_use]
    pub fn orbital_speed(&self, motion: &ScrewBallMotion) -> f32 {
        (self.nominal_speed + motion.speed) * self.sin_between
    }

    /// Contacts from their angles, rad, and forces, N, in the order SL, SR, NL, NR.
    ///
    /// Angles outside [`CONTACT_ANGLE_RANGE`] are taken at its ends, NaN at the lower one; a force below
    /// 1e-9 N, above 1e7 N, or NaN is a lost contact. Ellipses are those of the nominal contact angle.
    #[must_use]
    pub fn contacts(&self, contact_angles: &[f32; 4], contact_forces: &[f32; 4]) -> ScrewContacts {
        let (least, most) = CONTACT_ANGLE_RANGE;
        let [a, b, c, d] = contact_forces.map(loaded);
        let [left, right] = inverse_cube_roots([a, b]);
        let [far_left, far_right] = inverse_cube_roots([c, d]);
        let loads = [(a, left), (b, right), (c, far_left), (d, far_right)];
        let mut contact = [Contact::default(); 4];
        let given = contact_angles.iter().zip(loads);
        for (((contact, given), quadrant), race) in contact
            .iter_mut()
            .zip(given)
            .zip(&QUADRANTS)
            .zip(self.races())
        {
            let (&angle, (force, root)) = given;
            let angle = if angle > least { angle } else { least };
            let angle = if angle < most { angle } else { most };
            let (sin, cos) = math::sin_cos(angle);
            let (outward, right) = *quadrant;
            let (nx, nz) = (outward * cos, right * sin);
            contact.arm = (nx, nz);
            contact.along = self.nominal_speed - race.speed * (self.path + self.cos_lead * nx);
            contact.across = -race.speed * self.sin_lead;
            contact.spin = -race.speed * self.cos_lead * nz;
            if force >= LEAST_FORCE {
                contact.friction = self.friction * force;
                contact.semi_major = race.semi_major * (force * root * root);
            }
        }
        ScrewContacts { contact }
    }

    /// Speed, compliance and loss of a ball on which no neighbour presses, in closed form.
    ///
    /// Near rolling every contact resists slip along the track with its impedance
    /// `kappa = mu N k_y/(a |w|)`, and turns the ball with the moment `M` of its spin; both depend on the slip
    /// across the track, which the lead forces upon the ball and which screw and nut share, near one half each.
    /// Force along the track and moments about x and z are three linear equations:
    ///
    /// ```text
    /// (sum kappa j jᵀ + sum M_w m mᵀ) s = sum (kappa j c - M m)
    /// j = (1, -n_z, n_x)   m = (0, n_x, n_z)   s = (w_B L_p, Omega_x, Omega_z)   c: slip of the groove
    /// ```
    ///
    /// | contacts | what they say for the orbital speed, `r = R_B R_P/(L/2 pi)²` |
    /// |---|---|
    /// | third on the screw | `w_B/w_N = (1 + r cos b_N)/(1 + cos(b_N - (b_S - b_3)/2)/cos((b_S + b_3)/2))` |
    /// | third on the nut | `w_B/w_N = (C + r cos b_S)/(1 + C)`, `C = cos(b_S - (b_N - b_3)/2)/cos((b_N + b_3)/2)` |
    /// | four | the speeds of the two diagonals, weighed with their impedances |
    /// | two, sticks to the screw | `w_B/w_N = (1 + r cos b_N)/(1 + cos(b_S - b_N))` |
    /// | two, sticks to the nut | `w_B/w_N = (cos(b_S - b_N) + r cos b_S)/(1 + cos(b_S - b_N))` |
    ///
    /// and what moments of spin change of them, of the order of the contact's size over the ball's. With two
    /// contacts one race slides across the track with the whole `R_B w_N sin alpha`: of two motions, and of the
    /// pinned one where the other contacts carry less than 0.3 of the loaded pair, that with the least loss is taken.
    /// The compliance is the last element of the inverse; with three contacts `(1/kappa_S + 1/kappa_N)/4`.
    ///
    /// Largest errors against equilibrium of Coulomb friction in the same contacts (rms in brackets), random
    /// designs of contact angle 35 to 55 degrees, conformity 0.515 to 0.58, friction 0.03 to 0.2, 2 to 200 N, every
    /// contact angle off by up to 3 degrees on its own. Orbital speed over the nut's: 5e-5 (9e-6) two contacts,
    /// 4.5e-4 (6e-5) three of which the third is pinned, 9e-3 (2.4e-3) where it slides, 6e-3 (1.3e-3) four, 7.5e-4
    /// (1.2e-4) four that are off by 1 degree. Groove torque: 1e-4, 4 % (0.7 %), 6 % (1.6 %), 9 % (1.9 %).
    ///
    /// Near two-point contact, Lin 2019, Table 3.6, 75 N on the pair: a third contact slides below 6 % of that
    /// load, which is smooth in the exact model; at 2e-4 of it the race changes on which the ball sticks, and
    /// the orbital speed jumps by 2e-3 of the nut's for a deviation of 2 degrees. The closed form, which takes
    /// the motion with the least loss, jumps with it; [`ScrewBall::refine`] smooths the jump over half a decade
    /// of the load, with errors up to 1.3e-3.
    ///
    /// Source: not in Lin 2019; from its equations (3.65)-(3.76). Cost: eight evaluations of the friction across the
    /// track and eight of [`SlipMap`](crate::contact::SlipMap); up to twelve more with two contacts or a light third one.
    #[must_use]
    pub fn closed_form(&self, contacts: &ScrewContacts) -> ScrewBallState {
        let pinned = self.pinned(contacts);
        match contacts.weakly_held() {
            None => pinned,
            Some((screw, nut)) => {
                let rolling = self.rolling(screw, nut);
                self.least(contacts, &contacts.unheld(pinned), rolling)
            }
        }
    }

    /// Where the impedance iteration starts: the closed form, and where the third contact is light, motions in
    /// between.
    ///
    /// Between a ball that is pinned and one that rolls on two contacts lie those whose third contact slides. They
    /// fill a triangle between the three motions of the closed form, in which the loss is convex: three times the
    /// best one found moves towards a corner by a half, a quarter, a tenth of the way, where that is less.
    ///
    /// Largest error of the orbital speed where a third contact slides: 1.5e-3 of the nut's speed (rms 5e-4), of the
    /// groove torque 1.1 % (0.25 %). Cost: up to nine more evaluations of the loss, four
    /// [`SlipMap`](crate::contact::SlipMap) each.
    #[must_use]
    pub fn start(&self, contacts: &ScrewContacts) -> ScrewBallState {
        let pinned = self.pinned(contacts);
        let Some((screw, nut)) = contacts.weakly_held() else {
            return pinned;
        };
        let [on_screw, on_nut] = self.rolling(screw, nut);
        let mut best = self.least(contacts, &contacts.unheld(pinned), [on_screw, on_nut]);
        if contacts.loaded() > 2 {
            for part in SEARCH {
                let towards = |corner| best.motion.towards(corner, part);
                let candidates = [&pinned.motion, &on_screw, &on_nut].map(towards);
                best = self.least(contacts, &best, candidates);
            }
        }
        best
    }

    /// The closed form where every contact that is loaded holds the ball.
    fn pinned(&self, contacts: &ScrewContacts) -> ScrewBallState {
        let nominal = self.shared(contacts);
        let state = self.linear(contacts, &nominal);
        ScrewBallState {
            groove_torque: self.groove_torque(contacts, &state.motion),
            ..state
        }
    }

    /// A motion as it is; one that is no number, or of a ball that nothing holds, becomes nominal rolling.
    #[inline]
    pub(super) fn sound(&self, motion: ScrewBallMotion) -> ScrewBallMotion {
        let [x, y, z] = motion.turn;
        // False for NaN.
        if motion.speed.abs() + x.abs() + y.abs() + z.abs() < LARGEST_MOTION {
            motion
        } else {
            ScrewBallMotion {
                speed: 0.0,
                turn: [0.0, 0.5 * self.sin_lead, self.roll],
            }
        }
    }

    /// Nominal rolling, with the slip across the track shared by screw and nut as their impedances against it
    /// ask for.
    fn shared(&self, contacts: &ScrewContacts) -> ScrewBallMotion {
        let mut nominal = ScrewBallMotion {
            speed: 0.0,
            turn: [0.0, 0.5 * self.sin_lead, self.roll],
        };
        for _ in 0..SHARINGS {
            let (mut all, mut nut) = (1e-9, 0.5e-9);
            for (contact, race) in contacts.contact.iter().zip(self.races()) {
                if contact.friction > 0.0 {
                    let at = contact.at(&nominal);
                    let slip = at.across.abs() + 1e-6;
                    let rim = contact.semi_major * (at.spin.abs() + STICK_SPIN);
                    let impedance = contact.friction * race.map.share_across(slip, rim) / slip;
                    all += impedance;
                    nut += race.speed * impedance;
                }
            }
            let [_, y, _] = &mut nominal.turn;
            *y = self.sin_lead * (nut / all);
        }
        nominal
    }

    /// The state, or the motion with the least loss if that is less.
    fn least<const N: usize>(
        &self,
        contacts: &ScrewContacts,
        state: &ScrewBallState,
        candidates: [ScrewBallMotion; N],
    ) -> ScrewBallState {
        let mut motion = state.motion;
        let mut least = state.groove_torque;
        for candidate in candidates {
            let torque = self.groove_torque(contacts, &candidate);
            if torque < least {
                least = torque;
                motion = candidate;
            }
        }
        if least < state.groove_torque {
            let compliance = self.compliance(contacts, &motion);
            ScrewBallState {
                groove_torque: least,
                ..self.state(motion, compliance, 0.0)
            }
        } else {
            *state
        }
    }

    /// Slip and spin of the four contacts at a motion.
    #[must_use]
    pub fn contact_motion(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
    ) -> [ScrewContactMotion; 4] {
        contacts.contact.map(|contact| contact.at(motion))
    }

    /// Torque on the nut that the grooves take at a motion, N m: the sum of the contacts' power losses over
    /// the nut's speed.
    #[must_use]
    pub fn groove_torque(&self, contacts: &ScrewContacts, motion: &ScrewBallMotion) -> f32 {
        let mut torque = 0.0;
        for (contact, race) in contacts.contact.iter().zip(self.races()) {
            if contact.friction > 0.0 {
                let at = contact.at(motion);
                let friction = race.map.dissipation(
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
    pub(super) fn races(&self) -> [&Race; 4] {
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

    /// Motions in which a ball in two contacts sticks to the screw, and to the nut, and does not slip along
    /// the other's track.
    fn rolling(&self, screw: &Contact, nut: &Contact) -> [ScrewBallMotion; 2] {
        let ((screw_x, screw_z), (nut_x, nut_z)) = (screw.arm, nut.arm);
        let opposed = screw_x * nut_x + screw_z * nut_z;
        let inverse = 1.0 / (1.0 - opposed);
        let on_screw = (self.path + self.cos_lead * nut_x) * inverse;
        let on_nut = -(self.path * opposed + self.cos_lead * screw_x) * inverse;
        let back = on_nut - self.path;
        [
            ScrewBallMotion {
                speed: on_screw - self.nominal_speed,
                turn: [on_screw * screw_z, 0.0, -on_screw * screw_x],
            },
            ScrewBallMotion {
                speed: on_nut - self.nominal_speed,
                turn: [back * nut_z, self.sin_lead, self.cos_lead - back * nut_x],
            },
        ]
    }
}

impl ScrewBallMotion {
    fn towards(&self, other: &Self, part: f32) -> Self {
        let [x, y, z] = self.turn;
        let [to_x, to_y, to_z] = other.turn;
        Self {
            speed: self.speed + part * (other.speed - self.speed),
            turn: [
                x + part * (to_x - x),
                y + part * (to_y - y),
                z + part * (to_z - z),
            ],
        }
    }
}

impl ScrewContacts {
    fn loaded(&self) -> usize {
        self.contact.iter().filter(|c| c.friction > 0.0).count()
    }

    /// The loaded pair, where the other contacts are too light to hold the ball for certain.
    fn weakly_held(&self) -> Option<(&Contact, &Contact)> {
        let [screw_left, screw_right, nut_left, nut_right] = &self.contact;
        let up = screw_left.friction + nut_right.friction;
        let down = screw_right.friction + nut_left.friction;
        let (weak, strong, pair) = if up > down {
            (down, up, (screw_left, nut_right))
        } else {
            (up, down, (screw_right, nut_left))
        };
        let both = pair.0.friction > 0.0 && pair.1.friction > 0.0;
        (both && weak < WEAK * strong).then_some(pair)
    }

    /// Two contacts leave open how the ball turns: the state in which they would hold it counts for nothing.
    fn unheld(&self, pinned: ScrewBallState) -> ScrewBallState {
        if self.loaded() > 2 {
            pinned
        } else {
            ScrewBallState {
                groove_torque: f32::MAX,
                ..pinned
            }
        }
    }
}

impl Contact {
    #[inline]
    pub(super) fn at(&self, motion: &ScrewBallMotion) -> ScrewContactMotion {
        let (nx, nz) = self.arm;
        let [x, y, z] = motion.turn;
        ScrewContactMotion {
            across: self.across + y,
            along: self.along + motion.speed + nx * z - nz * x,
            spin: self.spin + nx * x + nz * z,
        }
    }
}
