//! The closed form with contacts that are given, and the motions between which a ball in light contacts lies.

use super::ball::{STICK_SPIN, ScrewBall};
use super::contacts::{ScrewContact, ScrewContacts};
use super::motion::{ScrewBallMotion, ScrewBallState};

/// Parts of the distance to a corner by which [`ScrewBall::start`] tries to move, one after the other.
///
/// Each about half of the one before, as in a search by halving. From 0.4 to 0.6, 0.2 to 0.3 and 0.05 to 0.15 the errors
/// of the start differ by a fifth; two parts instead of three leave up to a half more.
const SEARCH: [f32; 3] = [0.5, 0.25, 0.1];

/// Rounds in which the closed form divides the slip across the track among the races by their impedances, which depend on
/// it.
///
/// After none, one, two, three and four rounds the closed form's groove torque is off by 3.5, 2.3, 1.7, 1.3 and 1.1 % (rms,
/// four contacts): a third one would take a quarter off that, and nothing off the error of the speed.
const SHARINGS: u8 = 2;

/// Ratio of the other contacts' load to that of the loaded pair from which on they pin a ball for certain: sliding is
/// then not tried.
///
/// From 0.2 to 0.6 all errors are the same: no ball whose third contact slides is missed. At 0.1 and 0.15 some are (largest
/// error of the start 6.3e-3 in place of 3.3e-3), at 0.05 many (2.4e-2, torque 57 %).
const WEAK: f32 = 0.3;

impl ScrewBall {
    /// Speed, compliance and loss of a ball on which no neighbour presses, in closed form.
    ///
    /// Near rolling every contact resists slip along the track with its impedance
    /// `Z = mu F k_y/(a |w|)`, and turns the ball with the moment `M` of its spin; both depend on the slip
    /// across the track, which the lead forces upon the ball and which screw and nut share, near one half each.
    /// Force along the track and moments about x and z are three linear equations:
    ///
    /// ```text
    /// (sum Z j jᵀ + sum M_w m mᵀ) s = sum (Z j c - M m)
    /// j = (1, -n_z, n_x)   m = (0, n_x, n_z)   s = (omega_B q, Omega_x, Omega_z)   c: slip of the groove
    /// ```
    ///
    /// | contacts | orbital speed, `r = r_b r_m/q²` |
    /// |---|---|
    /// | third on the screw | `omega_B/omega_N = (1 + r cos beta_N)/(1 + cos(beta_N - (beta_S - beta_3)/2)/cos((beta_S + beta_3)/2))` |
    /// | third on the nut | `omega_B/omega_N = (C + r cos beta_S)/(1 + C)`, `C = cos(beta_S - (beta_N - beta_3)/2)/cos((beta_N + beta_3)/2)` |
    /// | four | the speeds of the two diagonals, weighed with their impedances |
    /// | two, sticks to the screw | `omega_B/omega_N = (1 + r cos beta_N)/(1 + cos(beta_S - beta_N))` |
    /// | two, sticks to the nut | `omega_B/omega_N = (cos(beta_S - beta_N) + r cos beta_S)/(1 + cos(beta_S - beta_N))` |
    ///
    /// and what moments of spin change of them, of the order of the contact's size over the ball's. With two
    /// contacts one race slides across the track with the whole `r_b omega_N sin alpha`: of two motions, and of the
    /// pinned one where the other contacts carry less than 0.3 of the loaded pair, that with the least loss is taken.
    /// The compliance is the last element of the inverse; with three contacts `(1/Z_S + 1/Z_N)/4`.
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

    /// The closed form of a ball that every loaded contact keeps from slipping along the track: it is pinned.
    fn pinned(&self, contacts: &ScrewContacts) -> ScrewBallState {
        let nominal = self.shared(contacts);
        let state = self.linear(contacts, &nominal);
        ScrewBallState {
            groove_torque: self.groove_torque(contacts, &state.motion),
            ..state
        }
    }

    /// Nominal rolling, with the slip across the track shared by screw and nut as their impedances against it
    /// ask for.
    fn shared(&self, contacts: &ScrewContacts) -> ScrewBallMotion {
        let mut nominal = self.nominal();
        for _ in 0..SHARINGS {
            let (mut all, mut nut) = (1e-9, 0.5e-9);
            for (contact, groove) in contacts.contact.iter().zip(self.grooves()) {
                if contact.friction > 0.0 {
                    let at = contact.motion(&nominal);
                    let slip = at.across.abs() + 1e-6;
                    let end_speed = contact.semi_major * (at.spin.abs() + STICK_SPIN);
                    let impedance =
                        contact.friction * groove.map.share_across(slip, end_speed) / slip;
                    all += impedance;
                    nut += groove.speed * impedance;
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

    /// Two motions of a ball in two contacts: it sticks to the screw, or to the nut, and does not slip along the
    /// track in the other contact.
    fn rolling(&self, screw: &ScrewContact, nut: &ScrewContact) -> [ScrewBallMotion; 2] {
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

    /// The loaded pair, where the other contacts are too light to pin the ball for certain.
    fn weakly_held(&self) -> Option<(&ScrewContact, &ScrewContact)> {
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

    /// With two contacts alone no third one pins the ball: the pinned state gets a loss that any other is below.
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
