//! Balls of a ball screw in closed form, for comparison: a third contact, slip across the track, and what follows from them.

mod tick;

use crate::ball::loads::loaded;
use crate::ball::preload::Preload;
use crate::contact::{Across, AcrossTable};
use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::{constant, inverse_cube_roots};
use crate::ranges;
pub(crate) use tick::largest_deviation;
use tick::{Mean, Speeds, limited};
pub use tick::{ScrewTick, ScrewTickBall};

/// Smallest load per ball, N: compliance goes with 1/load and has no bound at zero.
const SMALLEST_LOAD: f32 = 1e-3;

/// Balls of one ball screw: constants of the closed form.
///
/// All balls carry shares of one axial load, and contact angles deviate with the grooves: [`ScrewRow::at`] solves a load once, and a ball
/// then costs two polynomials ([`ScrewTick::ball`]). Spin moments are left out:
///
/// ```text
/// orbital speed, third contact on the screw
///     omega_B/omega_N = (1 + r cos beta_N)/(1 + cos(beta_N - (beta_S - beta_3)/2)/cos((beta_S + beta_3)/2))
/// orbital speed, third contact on the nut
///     omega_B/omega_N = (C + r cos beta_S)/(1 + C)     C = cos(beta_S - (beta_N - beta_3)/2)/cos((beta_N + beta_3)/2)
/// orbital speed, two contacts
///     omega_B/omega_N = (1 + r cos((beta_S + beta_N)/2))/2
/// loads                     F = F_a/(sin beta cos alpha)/(1 - s_mu mu)     F_3 = 2 s_mu mu F
/// compliance                Y = (1/Z_S + 1/Z_N)/4;  1/(Z_U + Z_D) of two loaded diagonals
/// force between two balls   F_BB = (v_1 - v_2)/(Y_1 + Y_2)
/// ```
///
/// with `r = r_b r_m/q²` and the path radius `q`, the mean share `s_mu` of sliding friction across the track, and the contacts' impedances `Z`.
///
/// Input: a validated design, friction 1e-6 to 0.5, axial loads per ball 1e-3 to 1e7 N, deviations up to 0.2 rad.
///
/// Errors against the formulas above with exact contact integrals: orbital speed 2e-7 of the nut's, compliance and torque 0.6 % at the mean load; 6 %
/// and 12 % at shares of 0.1 to 3 of it. Against balls in elastic grooves (Lin 2019, Table 3.6, groove radius 3.254 mm, friction 0.1): contact loads
/// 2.5 %; force between two balls 3.2 % up to 50 N per ball and 7 % at 100 N where the third contact gains load; where it slides, too large by up to 11 % at
/// 10 N and a factor two at 100 N. With two contacts and unequal contact angles the speed is off by up to 4.5e-3 of the nut's for deviations of 3 degrees.
///
/// Source: not in Lin 2019; from its equations (3.65)-(3.76).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewRow {
    contacts: Contacts,
    speeds: Speeds,
    /// `1/(4 mu)`.
    quarter_per_friction: f32,
    contact_angle: f32,
    /// Normal force of a contact over the axial load, `1/(sin beta cos alpha)`.
    normal: f32,
    play: bool,
    /// Whether a ball in two contacts sticks to the screw, or else to the nut.
    sticks_to_screw: bool,
}

/// Contacts of one ball of a row, in the order SL, SR, NL, NR (screw or nut, left or right).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RowContacts {
    /// Contact angles, rad.
    pub angles: [f32; 4],
    /// Contact forces, N; 0 where a contact is lost.
    pub forces: [f32; 4],
}

impl ScrewRow {
    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    pub const fn nominal_speed(&self) -> f32 {
        self.speeds.nominal
    }

    /// Largest deviation of a contact angle that counts, rad; a larger one is taken at it: 0.2 for contact angles from 23 to 68 degrees,
    /// less beyond.
    pub const fn largest_deviation(&self) -> f32 {
        self.speeds.largest_deviation
    }

    /// Folds the constants of a design.
    ///
    /// # Errors
    /// [`Error`] naming `friction` (1e-6 to 0.5), `contact_angle` (0.05 to 1.5), `contact_force` or `axis_ratio`.
    pub const fn new(design: &BallScrew, friction: f32, fit: GrooveFit) -> Result<Self, Error> {
        let friction = attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", friction));
        let contact_angle = design.parameters().contact_angle;
        attempt!(ranges::ROLLING_CONTACT_ANGLE.checked("contact_angle", contact_angle));
        let preload = match fit {
            GrooveFit::Preload { contact_force } => {
                attempt!(in_range("contact_force", contact_force, 1e-3, 1e6))
            }
            GrooveFit::Zero | GrooveFit::Play => 0.0,
        };
        let play = matches!(fit, GrooveFit::Play);
        // Of two contacts one sticks, and the ball slips on the other one alone.
        let slip = if play { 1.0 } else { 0.5 }
            * design.ball_radius()
            * (design.cos_lead_angle() * design.tan_lead_angle());
        let spins = spins(design, play);
        let contacts = attempt!(Contacts::new(design, friction, spins, slip, preload));
        // The ball sticks to the groove on which it would lose more: that with the longer ellipse.
        let sticks_to_screw = contacts.screw.end_speed > contacts.nut.end_speed;
        Ok(Self {
            contacts,
            speeds: Speeds::new(design, sticks_to_screw),
            quarter_per_friction: 0.25 / friction,
            contact_angle,
            normal: 1.0 / design.axial_per_normal(),
            play,
            sticks_to_screw,
        })
    }

    /// The row under an axial load of the screw on each ball, N, in size 1e-3 to 1e7: one below, one beyond, and NaN count
    /// as 1e-3 N. Signs of the nut's speed, rad/s, and the load say which groove has the third contact. Cost: 892 modelled cycles on a Cortex-M4F.
    #[inline]
    pub const fn at(&self, nut_speed: f32, axial_load_per_ball: f32) -> ScrewTick {
        let normal = self.normal * counted(axial_load_per_ball);
        let side = if axial_load_per_ball < 0.0 { 1.0 } else { -1.0 };
        if self.play {
            self.in_two_points(normal, side)
        } else {
            let on_screw = (axial_load_per_ball < 0.0) != (nut_speed < 0.0);
            self.in_more_points(normal, side, on_screw)
        }
    }

    /// Contact angles and contact forces of one ball under an axial load, N.
    ///
    /// A positive axial load of the screw on the ball is carried by SL and NR, a negative one by SR and NL. Friction across the track of
    /// that pair pushes the ball along the other diagonal and, in grooves without play, closes a third contact of `F_3 = 2 s_mu mu F`, `s_mu`
    /// being the mean share of sliding friction: SL under SR-NL and NL under SL-NR for a nut that turns forward, NR and SR for one that turns
    /// backward. With a preload the third contact gains and the fourth one loses half of that each.
    ///
    /// Angles deviate as in [`ScrewTick::ball`]: `SL = beta - screw_deviation`, `SR = beta + screw_deviation`, `NL = beta - nut_deviation`,
    /// `NR = beta + nut_deviation`. Loads and deviations as in [`ScrewRow::at`]; a deviation that is NaN counts as 0.
    pub const fn contacts(
        &self,
        nut_speed: f32,
        axial_load: f32,
        screw_deviation: f32,
        nut_deviation: f32,
    ) -> RowContacts {
        let normal = self.normal * counted(axial_load);
        let (main, third, fourth) = if self.play {
            (normal, 0.0, 0.0)
        } else {
            let loads = self.contacts.loads(normal);
            (loads.main, loads.third, loads.fourth)
        };
        let reversed = axial_load < 0.0;
        let forces = match (reversed, reversed != (nut_speed < 0.0)) {
            (true, true) => [third, main, main, fourth],
            (true, false) => [fourth, main, main, third],
            (false, true) => [main, third, fourth, main],
            (false, false) => [main, fourth, third, main],
        };
        let largest = self.speeds.largest_deviation;
        let screw = limited(screw_deviation, largest);
        let nut = limited(nut_deviation, largest);
        let angle = self.contact_angle;
        RowContacts {
            angles: [angle - screw, angle + screw, angle - nut, angle + nut],
            forces,
        }
    }

    const fn in_two_points(&self, normal: f32, side: f32) -> ScrewTick {
        let Contacts {
            friction,
            screw,
            nut,
            ..
        } = &self.contacts;
        let slides = if self.sticks_to_screw { nut } else { screw };
        let contact = slides.under(cube_root(normal));
        let limit = *friction * normal;
        let per_limit = 1.0 / (4.0 * limit);
        ScrewTick::new(
            &self.speeds,
            self.speeds.in_two_points(side),
            &Mean {
                gain: 1.0,
                compliance: contact.compliance * per_limit,
                compliance_rolling: contact.compliance_growth * per_limit,
                torque: limit * contact.drag,
                torque_rolling: limit * contact.drag_growth,
                main_load: normal,
                third_load: 0.0,
            },
        )
    }

    const fn in_more_points(&self, normal: f32, side: f32, on_screw: bool) -> ScrewTick {
        let Loads {
            main,
            third,
            fourth,
            screw,
            nut,
        } = self.contacts.loads(normal);
        let (third_groove, fourth_groove) = if on_screw {
            (&self.contacts.screw, &self.contacts.nut)
        } else {
            (&self.contacts.nut, &self.contacts.screw)
        };
        let third_contact = third_groove.under(cube_root(third));

        let mut torque = main * (screw.drag + nut.drag) + third * third_contact.drag;
        let mut growth =
            main * (screw.drag_growth + nut.drag_growth) + third * third_contact.drag_growth;

        // Impedances: 4 mu main/pair of the loaded diagonal; 4 mu third fourth/other of one whose two contacts carry load.
        let pair = screw.compliance + nut.compliance;
        let mut gain = 1.0;
        let compliance = if fourth > 0.0 {
            let contact = fourth_groove.under(cube_root(fourth));
            torque += fourth * contact.drag;
            growth += fourth * contact.drag_growth;
            let other = third_contact.compliance * fourth + contact.compliance * third;
            let (loaded, unloaded) = (main * other, third * fourth * pair);
            let inverse = 1.0 / (loaded + unloaded);
            gain = (loaded - unloaded) * inverse;
            other * inverse
        } else {
            1.0 / main
        };
        let compliance = self.quarter_per_friction * compliance;
        ScrewTick::new(
            &self.speeds,
            self.speeds.in_more_points(side, on_screw),
            &Mean {
                gain,
                compliance: pair * compliance,
                compliance_rolling: (screw.compliance_growth + nut.compliance_growth) * compliance,
                torque: self.contacts.friction * torque,
                torque_rolling: self.contacts.friction * growth,
                main_load: main,
                third_load: third,
            },
        )
    }
}

/// Spin of a nominal ball in the contacts with the screw and with the nut, over the nut's speed.
const fn spins(design: &BallScrew, play: bool) -> [f32; 2] {
    let angle = design.contact_angle();
    let cos_lead = design.cos_lead_angle();
    if play {
        [cos_lead * angle.sin; 2]
    } else {
        let rolling = design.path_radius() / (design.ball_radius() * angle.cos);
        let half = 0.5 * angle.sin;
        [half * (rolling + cos_lead), half * (rolling - cos_lead)]
    }
}

#[inline]
const fn counted(axial_load: f32) -> f32 {
    let size = loaded(axial_load.abs());
    if size > SMALLEST_LOAD {
        size
    } else {
        SMALLEST_LOAD
    }
}

/// Fit of the balls between the grooves for [`ScrewRow`]: limits of a [`Clearance`](crate::Clearance).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum GrooveFit {
    /// No play and no preload: friction across the track closes a light third contact.
    Zero,
    /// So much play that only two contacts carry a ball (from about 20 micrometres on).
    Play,
    /// Oversized balls in four-point contact.
    Preload {
        /// Force of each of the four contacts without an external load, N; 1e-3 to 1e6.
        contact_force: f32,
    },
}

/// Load of a light contact below which it does not count, over that of the main contacts: its ellipse has not vanished there.
const LEAST_LOAD: f32 = 1e-6;

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Contacts {
    friction: f32,
    screw: Raceway,
    nut: Raceway,
    /// Contact forces of the two diagonals without a load.
    preload: Preload,
    /// Slip across the track in the contact with the screw, times the slope of its share of sliding friction, m.
    sliding: f32,
}

/// Loads of a ball's contacts, N, and friction of the loaded pair.
#[derive(Clone, Copy)]
struct Loads {
    main: f32,
    /// The contact of the other diagonal towards which friction across the track pushes the ball.
    third: f32,
    /// The contact opposite to it; 0 where it is lost.
    fourth: f32,
    /// The main contact with the screw, over `mu` times its load.
    screw: Across,
    nut: Across,
}

impl Contacts {
    /// The contacts of a ball that spins by `spins` (screw, nut) and slips by `slip`, m, per unit of nut speed, with a preload, N.
    const fn new(
        design: &BallScrew,
        friction: f32,
        [screw_spin, nut_spin]: [f32; 2],
        slip: f32,
        preload: f32,
    ) -> Result<Self, Error> {
        let screw = attempt!(Raceway::new(design, Groove::Screw, screw_spin, slip));
        let nut = attempt!(Raceway::new(design, Groove::Nut, nut_spin, slip));
        Ok(Self {
            friction,
            preload: Preload::new(preload),
            sliding: screw.table.share_slope() * slip,
            screw,
            nut,
        })
    }

    /// Loads of the contacts under a given difference of the two diagonals.
    #[inline]
    const fn loads(&self, normal: f32) -> Loads {
        // Share of sliding friction across the track, to some per cent.
        let sliding = self.sliding;
        let spinning = self.screw.end_speed * cube_root(normal);
        let size = constant::sqrt(spinning * spinning + sliding * sliding + 1e-30);
        let main = self
            .preload
            .larger(normal * size / (size - self.friction * sliding));
        let root = cube_root(main);
        let screw = self.screw.under(root);
        let nut = self.nut.under(root);
        let loss = 0.5 * self.friction * (screw.share + nut.share);
        let (main, other) = self.preload.both(normal / (1.0 - loss));

        // Friction across the track of the loaded diagonal pushes the ball along the other one.
        let push = loss * main;
        // Without lead there is no such friction: the floor keeps the ellipse of a lost diagonal from vanishing.
        let least = LEAST_LOAD * main;
        let third = larger(if other > push { other } else { push } + push, least);
        let fourth = if other - push > least {
            other - push
        } else {
            0.0
        };
        Loads {
            main,
            third,
            fourth,
            screw,
            nut,
        }
    }
}

#[inline]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Raceway {
    table: AcrossTable,
    /// Speed that the spin gives the end of the major axis under one newton, `a w`, `m/N^(1/3)` per unit of nut speed.
    end_speed: f32,
}

impl Raceway {
    /// The contact of a design's groove with a spin and a slip across the track, m, per unit of nut speed.
    const fn new(design: &BallScrew, groove: Groove, spin: f32, slip: f32) -> Result<Self, Error> {
        let contact = HertzContact::of(design, groove);
        Ok(Self {
            table: attempt!(AcrossTable::new(contact.axis_ratio(), slip)),
            end_speed: contact.semi_major_coefficient() * spin,
        })
    }

    #[inline]
    const fn under(&self, root: f32) -> Across {
        self.table.at(self.end_speed * root)
    }
}

/// `x^(1/3)` of a positive normal number within 6e-5.
#[inline]
const fn cube_root(x: f32) -> f32 {
    let [inverse, _] = inverse_cube_roots([x, 1.0]);
    x * inverse * inverse
}
