//! Closed form for a row of balls in a ball screw, at the price of a control loop.

use crate::ball::loads::{LoadShare, loaded};
use crate::ball::preload::Preload;
use crate::contact::{Across, AcrossTable};
use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math::{self, constant, inverse_cube_roots};

/// Largest deviation of a contact angle from the nominal one, rad.
const LARGEST_DEVIATION: f32 = 0.2;

/// Smallest load per ball, N: below it a ball keeps the motion and the compliance that it has there.
const SMALLEST_LOAD: f32 = 1e-3;

/// Load of a light contact below which it does not count, over that of the main contacts.
const LEAST_LOAD: f32 = 1e-6;

/// How balls fit between the grooves.
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

/// Balls of one ball screw: constants of the closed form.
///
/// The closed form of [`ScrewBall`](crate::refined::ScrewBall) where all balls carry shares of one axial load and contact angles
/// deviate with the grooves: what depends on the load is found once a tick ([`ScrewRow::at`]), and a ball costs two
/// polynomials ([`ScrewTick::ball`]). Spin moments are left out:
///
/// ```text
/// third contact on the screw   w_B/w_N = (1 + r cos b_N)/(1 + cos(b_N - (b_S - b_3)/2)/cos((b_S + b_3)/2))
/// third contact on the nut     w_B/w_N = (C + r cos b_S)/(1 + C),  C = cos(b_S - (b_N - b_3)/2)/cos((b_N + b_3)/2)
/// two contacts                 w_B/w_N = (1 + r cos((b_S + b_N)/2))/2
/// loads                        N = F/(sin b cos alpha)/(1 - phi mu),  N_3 = 2 phi mu N
/// compliance                   Y = (1/kappa_S + 1/kappa_N)/4;  1/(kappa_U + kappa_D) of two loaded diagonals
/// force between two balls      F = (v_1 - v_2)/(Y_1 + Y_2)
/// ```
///
/// with `r = R_B R_P/(L/2 pi)²`, the mean share `phi` of sliding friction across the track, and the contacts'
/// impedances `kappa`. A third contact closes where friction across the track pushes the ball, see
/// [`ScrewRow::contacts`].
///
/// Input: a validated design, friction 1e-6 to 0.5, axial loads per ball 1e-3 to 1e7 N, deviations up to 0.2 rad.
///
/// Errors against the formulas above with exact contact integrals: orbital speed 2e-7 of the nut's, compliance and
/// torque 0.6 % at the mean load; 6 % and 12 % at shares of 0.1 to 3 of it. Against equilibrium of balls in elastic
/// grooves (Lin 2019, Table 3.6, groove radius 3.254 mm, friction 0.1): contact loads 2.5 %, force between two balls
/// whose screw grooves differ by 0.5 to 3 degrees so that the third contact gains load: 3.2 % up to 50 N per ball, 7 %
/// at 100 N. Of the opposite sign the third contact slides, and the force is too large, by up to 11 % at 10 N,
/// 21 % at 25 N, 44 % at 50 N and a factor two at 100 N. Table 3.7, read as 50 N on each ball: -1.3 % and -2.9 %.
/// With two contacts and unequal contact angles the speed is that between a ball which sticks to the screw and one which
/// sticks to the nut: off by up to 4.5e-3 of the nut's speed for deviations of 3 degrees in both grooves of Table 3.6;
/// [`ScrewBall::closed_form`](crate::refined::ScrewBall::closed_form) tells them apart.
///
/// Source: not in Lin 2019; from its equations (3.65)-(3.76).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewRow {
    friction: f32,
    quarter_per_friction: f32,
    contact_angle: f32,
    /// Normal force of a contact over the axial load, `1/(sin beta cos alpha)`.
    normal: f32,
    /// Contact forces of the two diagonals without a load.
    preload: Preload,
    play: bool,
    nominal_speed: f32,
    largest_deviation: f32,
    /// Slip across the track in the contact with the screw, times the slope of its share of sliding friction, m.
    sliding: f32,
    screw: Race,
    nut: Race,
    /// Coefficients of `2 cos b/(cos b + cos(b - u)) - 1` from `u` on.
    turn: [f32; 5],
    on_screw: Branch,
    on_nut: Branch,
    two_point: Branch,
}

/// One groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Race {
    table: AcrossTable,
    /// Semi-major axis times spin at one newton, `m/N^(1/3)`.
    rim: f32,
}

impl Race {
    const fn new(design: &BallScrew, groove: Groove, spin: f32, slip: f32) -> Result<Self, Error> {
        let contact = HertzContact::of(design, groove);
        Ok(Self {
            table: attempt!(AcrossTable::new(contact.axis_ratio(), slip)),
            rim: contact.semi_major_coefficient() * spin,
        })
    }

    /// The contact under a load of which this is the cube root.
    #[inline]
    fn at(&self, root: f32) -> Across {
        self.table.at(self.rim * root)
    }
}

/// How a ball's speed follows its contact angles, and how it rubs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Branch {
    /// Speed, m, that the relative deviation multiplies; negative where it is that of the nut against the ball.
    scale: f32,
    /// `r sin b` and `r cos b` over `1 ± r cos b`, signed.
    sine: f32,
    versine: f32,
    /// Rubbing speed at the nominal speed, and its change with the ball's speed.
    rubbing: f32,
    rubbing_slope: f32,
    /// Relative change of the contacts' spin with the ball's speed, 1/m.
    spin: f32,
}

/// Loads of a ball's contacts, and friction of the loaded pair.
#[derive(Clone, Copy)]
struct Loads {
    main: f32,
    third: f32,
    fourth: f32,
    screw: Across,
    nut: Across,
}

/// A ball under the mean load.
#[derive(Clone, Copy)]
struct Mean {
    gain: f32,
    compliance: f32,
    /// Its part that follows the size of the ellipses.
    compliance_rolling: f32,
    torque: f32,
    torque_rolling: f32,
    main_load: f32,
    third_load: f32,
}

/// A row of balls at one tick; all values per unit of nut speed.
///
/// The true speeds along the track are `nut_speed * (nominal_speed + speed_deviation)`, compliances
/// `|nut_speed| * compliance`, and a touching pair loses the torque
/// `ball_friction * contact_force * (rear.rubbing + front.rubbing)` on the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewTick {
    largest_deviation: f32,
    turn: [f32; 5],
    own: [f32; 3],
    turn_sign: f32,
    screw_weight: f32,
    nut_weight: f32,
    scale: f32,
    spin: f32,
    rubbing: f32,
    rubbing_slope: f32,
    compliance_rolling: f32,
    compliance_sliding: f32,
    torque_rolling: f32,
    torque_sliding: f32,
    nominal_speed: f32,
    main_load: f32,
    third_load: f32,
}

/// One ball at one tick, per unit of nut speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewBallLoop {
    /// Speed along the track when no neighbour presses, less [`ScrewTick::nominal_speed`], m.
    pub speed_deviation: f32,
    /// Speed along the track lost per newton of force along it, m/N.
    pub compliance: f32,
    /// Power loss in the grooves, N m: the ball's friction torque on the nut.
    pub groove_torque: f32,
    /// Half the speed with which balls alike rub against each other, m.
    pub rubbing: f32,
}

impl ScrewRow {
    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    #[must_use]
    pub const fn nominal_speed(&self) -> f32 {
        self.nominal_speed
    }

    /// Largest deviation of a contact angle that counts, rad; a larger one is taken at it: 0.2 for
    /// contact angles from 23 to 68 degrees, less beyond.
    #[must_use]
    pub const fn largest_deviation(&self) -> f32 {
        self.largest_deviation
    }

    /// Folds the constants of a design.
    ///
    /// # Errors
    /// [`Error`] naming `friction` (1e-6 to 0.5), `contact_angle` (0.05 to 1.5), `contact_force` or `axis_ratio`.
    pub const fn new(design: &BallScrew, friction: f32, fit: GrooveFit) -> Result<Self, Error> {
        let friction = attempt!(in_range("friction", friction, 1e-6, 0.5));
        attempt!(in_range(
            "contact_angle",
            design.parameters().contact_angle,
            0.05,
            1.5,
        ));
        let preload = match fit {
            GrooveFit::Preload { contact_force } => {
                attempt!(in_range("contact_force", contact_force, 1e-3, 1e6))
            }
            GrooveFit::Zero | GrooveFit::Play => 0.0,
        };
        let play = matches!(fit, GrooveFit::Play);
        let angle = design.contact_angle();
        let (sin, cos) = (angle.sin, angle.cos);
        let radius = design.ball_radius();
        let cos_lead = design.cos_lead_angle();
        let sin_lead = cos_lead * design.tan_lead_angle();
        let path = design.pitch_radius() / cos_lead;
        // R_B R_P/(L/2 pi)², and the ball's rotation that the path's curvature makes.
        let ratio = radius * cos_lead / path;

        // Spin of a ball in rolling, and of its contacts against screw and nut.
        let rolling = path / (radius * cos);
        let half = 0.5 * sin;
        let spins = if play {
            [cos_lead * sin; 2]
        } else {
            [half * (rolling + cos_lead), half * (rolling - cos_lead)]
        };
        let [screw_spin, nut_spin] = spins;
        // Of two contacts one race sticks, and the ball slips on the other one alone.
        let slip = if play { 1.0 } else { 0.5 } * radius * sin_lead;
        let screw = attempt!(Race::new(design, Groove::Screw, screw_spin, slip));
        let nut = attempt!(Race::new(design, Groove::Nut, nut_spin, slip));

        let (plus, minus) = (1.0 + ratio * cos, 1.0 - ratio * cos);
        let speed = 0.5 * path * plus;
        let rest = 0.5 * path * minus;
        let on_screw = Branch {
            scale: speed,
            sine: ratio * sin / plus,
            versine: -ratio * cos / plus,
            rubbing: speed * (1.0 / cos - ratio),
            rubbing_slope: 1.0 / cos - ratio,
            spin: 2.0 / path,
        };
        let on_nut = Branch {
            scale: -rest,
            sine: ratio * sin / minus,
            versine: ratio * cos / minus,
            rubbing: rest * (1.0 / cos + ratio),
            rubbing_slope: -(1.0 / cos + ratio),
            spin: -2.0 / path,
        };
        // The ball sticks to the race on which it would lose more: that with the longer ellipse.
        let sticks_to_screw = screw.rim > nut.rim;
        let chord = 1.0 - (radius / path) * (radius / path);
        let cosine = if sticks_to_screw {
            cos - ratio
        } else {
            cos + ratio
        };
        let tumbling = constant::sqrt(sin * sin * chord + cosine * cosine);
        let (rubbing, rubbing_slope) = if sticks_to_screw {
            (speed * tumbling, tumbling)
        } else {
            (rest * tumbling, -tumbling)
        };
        let two_point = Branch {
            rubbing,
            rubbing_slope,
            spin: 0.0,
            ..on_screw
        };
        Ok(Self {
            friction,
            quarter_per_friction: 0.25 / friction,
            contact_angle: design.parameters().contact_angle,
            normal: 1.0 / (sin * cos_lead),
            preload: Preload::new(preload),
            play,
            nominal_speed: speed,
            largest_deviation: largest_deviation(design.parameters().contact_angle, sin / cos),
            sliding: screw.table.share_slope() * slip,
            screw,
            nut,
            turn: turn_series(sin / cos),
            on_screw,
            on_nut,
            two_point,
        })
    }

    /// The row under a load: once a tick.
    #[inline]
    #[must_use]
    pub fn at(&self, nut_speed: f32, axial_load_per_ball: f32) -> ScrewTick {
        let size = loaded(axial_load_per_ball.abs());
        let normal = self.normal
            * if size > SMALLEST_LOAD {
                size
            } else {
                SMALLEST_LOAD
            };
        let side = if axial_load_per_ball < 0.0 { 1.0 } else { -1.0 };
        if self.play {
            self.in_two_points(normal, side)
        } else {
            let on_screw = (axial_load_per_ball < 0.0) != (nut_speed < 0.0);
            self.in_more_points(normal, side, on_screw)
        }
    }

    /// Contact angles, rad, and contact forces, N, of one ball, in the order SL, SR, NL, NR: what
    /// [`ScrewBall::contacts`](crate::refined::ScrewBall::contacts) takes.
    ///
    /// A positive axial load of the screw on the ball, N, is carried by SL and NR, a negative one by SR and NL.
    /// Friction across the track of that pair pushes the ball along the other diagonal and, in grooves
    /// without play, closes a third contact of `N_3 = 2 phi mu N`, `phi` being the mean share of sliding friction: SL
    /// under SR-NL and NL under SL-NR for a nut that turns forward, NR and SR for one that turns backward. With a
    /// preload the third contact gains and the fourth one loses half of that each.
    ///
    /// Angles deviate with the grooves, as in [`ScrewTick::ball`]: `SL = beta - screw_deviation`,
    /// `SR = beta + screw_deviation`, `NL = beta - nut_deviation`, `NR = beta + nut_deviation`.
    ///
    /// Loads up to 1e7 N; those under 1e-3 N count as 1e-3 N. Deviations up to
    /// [`ScrewRow::largest_deviation`]; NaN is none.
    #[must_use]
    pub fn contacts(
        &self,
        nut_speed: f32,
        axial_load: f32,
        screw_deviation: f32,
        nut_deviation: f32,
    ) -> ([f32; 4], [f32; 4]) {
        let size = loaded(axial_load.abs());
        let size = if size > SMALLEST_LOAD {
            size
        } else {
            SMALLEST_LOAD
        };
        let normal = self.normal * size;
        let (main, third, fourth) = if self.play {
            (normal, 0.0, 0.0)
        } else {
            let loads = self.loads(normal);
            (loads.main, loads.third, loads.fourth)
        };
        let reversed = axial_load < 0.0;
        let forces = match (reversed, reversed != (nut_speed < 0.0)) {
            (true, true) => [third, main, main, fourth],
            (true, false) => [fourth, main, main, third],
            (false, true) => [main, third, fourth, main],
            (false, false) => [main, fourth, third, main],
        };
        let largest = self.largest_deviation;
        let screw = limited(screw_deviation, largest);
        let nut = limited(nut_deviation, largest);
        let angle = self.contact_angle;
        (
            [angle - screw, angle + screw, angle - nut, angle + nut],
            forces,
        )
    }

    fn in_two_points(&self, normal: f32, side: f32) -> ScrewTick {
        let slides = if self.screw.rim > self.nut.rim {
            &self.nut
        } else {
            &self.screw
        };
        let root = cube_root(normal);
        let contact = slides.at(root);
        let limit = self.friction * normal;
        let per_limit = 1.0 / (4.0 * limit);
        let (branch, weights) = self.turned_in_two_points(side);
        self.tick(
            branch,
            weights,
            &Mean {
                gain: 1.0,
                compliance: contact.give * per_limit,
                compliance_rolling: contact.give_growth * per_limit,
                torque: limit * contact.drag,
                torque_rolling: limit * contact.drag_growth,
                main_load: normal,
                third_load: 0.0,
            },
        )
    }

    fn in_more_points(&self, normal: f32, side: f32, on_screw: bool) -> ScrewTick {
        let Loads {
            main,
            third,
            fourth,
            screw,
            nut,
        } = self.loads(normal);
        let (third_race, fourth_race) = if on_screw {
            (&self.screw, &self.nut)
        } else {
            (&self.nut, &self.screw)
        };
        let third_contact = third_race.at(cube_root(third));

        let mut torque = main * (screw.drag + nut.drag) + third * third_contact.drag;
        let mut growth =
            main * (screw.drag_growth + nut.drag_growth) + third * third_contact.drag_growth;

        // Force along the track per speed: 4 mu main/give of the loaded diagonal, and 4 mu both/other of the
        // other one where both of its contacts carry load.
        let give = screw.give + nut.give;
        let mut gain = 1.0;
        let compliance = if fourth > 0.0 {
            let contact = fourth_race.at(cube_root(fourth));
            torque += fourth * contact.drag;
            growth += fourth * contact.drag_growth;
            let other = third_contact.give * fourth + contact.give * third;
            let (loaded, unloaded) = (main * other, third * fourth * give);
            let inverse = 1.0 / (loaded + unloaded);
            gain = (loaded - unloaded) * inverse;
            other * inverse
        } else {
            1.0 / main
        };
        let compliance = self.quarter_per_friction * compliance;
        let (branch, weights) = self.turned_in_more_points(side, on_screw);
        self.tick(
            branch,
            weights,
            &Mean {
                gain,
                compliance: give * compliance,
                compliance_rolling: (screw.give_growth + nut.give_growth) * compliance,
                torque: self.friction * torque,
                torque_rolling: self.friction * growth,
                main_load: main,
                third_load: third,
            },
        )
    }

    /// How speeds follow deviations, and the signs and weights with which these count: for both together,
    /// at the screw, at the nut.
    #[inline]
    const fn turned_in_two_points(&self, side: f32) -> (&Branch, [f32; 3]) {
        (&self.two_point, [0.0, -0.5 * side, 0.5 * side])
    }

    /// The same with the third contact on the screw or on the nut.
    #[inline]
    const fn turned_in_more_points(&self, side: f32, on_screw: bool) -> (&Branch, [f32; 3]) {
        if on_screw {
            (&self.on_screw, [side, 0.0, side])
        } else {
            (&self.on_nut, [-side, side, 0.0])
        }
    }

    /// Largest deviation of a ball's speed, m per unit of nut speed, that contact angles make which deviate by up
    /// to this much: at the corners of the deviations, where it is largest, in both directions of load and motion,
    /// and with a load beyond a preload, which would even it out. For set-up.
    pub(crate) const fn fastest_deviation(&self, on_screw: f32, in_nut: f32) -> f32 {
        const ONE_DIAGONAL: Mean = Mean {
            gain: 1.0,
            compliance: 0.0,
            compliance_rolling: 0.0,
            torque: 0.0,
            torque_rolling: 0.0,
            main_load: 0.0,
            third_load: 0.0,
        };
        let mut fastest = 0.0;
        // Each bit stands for one sign.
        let mut signs = 0;
        while signs < 16 {
            let side = signed(1.0, signs & 1);
            let (branch, weights) = if self.play {
                self.turned_in_two_points(side)
            } else {
                self.turned_in_more_points(side, signs & 2 == 0)
            };
            let ball = self.tick(branch, weights, &ONE_DIAGONAL).ball(
                signed(on_screw, signs & 4),
                signed(in_nut, signs & 8),
                &LoadShare::MEAN,
            );
            fastest = larger(ball.speed_deviation.abs(), fastest);
            signs += 1;
        }
        fastest
    }

    /// Loads of the contacts under a given difference of the two diagonals.
    #[inline]
    fn loads(&self, normal: f32) -> Loads {
        // Share of sliding friction across the track, to some per cent.
        let sliding = self.sliding;
        let rim = self.screw.rim * cube_root(normal);
        let size = math::sqrt(rim * rim + sliding * sliding + 1e-30);
        let main = self
            .preload
            .larger(normal * size / (size - self.friction * sliding));
        let root = cube_root(main);
        let screw = self.screw.at(root);
        let nut = self.nut.at(root);
        let loss = 0.5 * self.friction * (screw.share + nut.share);
        let (main, other) = self.preload.both(normal / (1.0 - loss));

        // Friction across the track of the loaded diagonal pushes the ball along the other one.
        let push = loss * main;
        // Without lead there is no such friction, and a lost diagonal carries nothing at all: the floor
        // keeps its ellipse from vanishing.
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

    #[inline]
    const fn tick(&self, branch: &Branch, weights: [f32; 3], mean: &Mean) -> ScrewTick {
        let [turn_sign, screw_weight, nut_weight] = weights;
        ScrewTick {
            largest_deviation: self.largest_deviation,
            turn: self.turn,
            own: [
                branch.sine,
                0.5 * branch.versine,
                -branch.sine * (1.0 / 6.0),
            ],
            turn_sign,
            screw_weight,
            nut_weight,
            scale: mean.gain * branch.scale,
            spin: branch.spin,
            rubbing: branch.rubbing,
            rubbing_slope: branch.rubbing_slope,
            compliance_rolling: mean.compliance_rolling,
            compliance_sliding: mean.compliance - mean.compliance_rolling,
            torque_rolling: mean.torque_rolling,
            torque_sliding: mean.torque - mean.torque_rolling,
            nominal_speed: self.nominal_speed,
            main_load: mean.main_load,
            third_load: mean.third_load,
        }
    }
}

impl ScrewTick {
    /// Speed along the track of a ball with nominal contact angles, m per unit of nut speed.
    #[must_use]
    pub const fn nominal_speed(&self) -> f32 {
        self.nominal_speed
    }

    /// Load of each main contact of a ball under the mean load, N.
    #[must_use]
    pub const fn main_load(&self) -> f32 {
        self.main_load
    }

    /// Load of the third contact of a ball under the mean load, N.
    #[must_use]
    pub const fn third_load(&self) -> f32 {
        self.third_load
    }

    /// Half the speed with which two nominal balls rub, m per unit of nut speed.
    #[must_use]
    pub const fn rubbing(&self) -> f32 {
        self.rubbing
    }

    /// Change of that with the speed along the track.
    #[must_use]
    pub const fn rubbing_slope(&self) -> f32 {
        self.rubbing_slope
    }

    /// One ball.
    #[inline]
    #[must_use]
    pub const fn ball(
        &self,
        screw_deviation: f32,
        nut_deviation: f32,
        share: &LoadShare,
    ) -> ScrewBallLoop {
        let screw = limited(screw_deviation, self.largest_deviation);
        let nut = limited(nut_deviation, self.largest_deviation);
        let [t1, t2, t3, t4, t5] = self.turn;
        let u = self.turn_sign * (screw + nut);
        let turn = u * (t1 + u * (t2 + u * (t3 + u * (t4 + u * t5))));
        let [o1, o2, o3] = self.own;
        let v = self.screw_weight * screw + self.nut_weight * nut;
        let own = v * (o1 + v * (o2 + v * o3));
        let speed_deviation = self.scale * (turn + own * (1.0 + turn));
        let spin = 1.0 + self.spin * speed_deviation;
        ScrewBallLoop {
            speed_deviation,
            compliance: (self.compliance_sliding + self.compliance_rolling * (share.root * spin))
                / share.share,
            groove_torque: self.torque_sliding * share.share
                + self.torque_rolling * (share.four_thirds() * spin),
            rubbing: self.rubbing + self.rubbing_slope * speed_deviation,
        }
    }
}

/// [`ScrewTick`] for a loop over balls whose deviations are within their limits: constants folded, speeds
/// over a speed of reference.
pub(crate) struct ScrewLoop {
    turn: [f32; 5],
    own: [f32; 3],
    /// Weights of the deviations' units at screw and nut in what turns the ball and in what tilts it.
    turn_weights: (f32, f32),
    own_weights: (f32, f32),
    scale: f32,
    compliance_rolling: f32,
    compliance_sliding: f32,
    /// Change of the rolling part with the speed.
    compliance_spin: f32,
    torque_rolling: f32,
    torque_sliding: f32,
    torque_spin: f32,
}

/// One ball in that loop.
pub(crate) struct LoopBall {
    /// Speed along the track when no neighbour presses, less the nominal one, over the speed of reference.
    pub(crate) speed: f32,
    /// Force along the track, N, that takes the speed of reference from the ball.
    pub(crate) impedance: f32,
}

/// Sums over the balls of that loop, from which the power loss in the grooves follows.
#[derive(Default)]
pub(crate) struct LoopSums {
    share: f32,
    four_thirds: f32,
    four_thirds_speed: f32,
}

impl ScrewTick {
    /// For speeds over a speed of reference, m per unit of nut speed, given with its inverse, and
    /// deviations at screw and nut in these `units`, rad.
    #[inline(always)]
    pub(crate) fn per_speed(&self, speed: f32, per_speed: f32, units: (f32, f32)) -> ScrewLoop {
        let (screw, nut) = units;
        let size = per_speed.abs();
        let scale = self.scale * per_speed;
        let spin = self.spin * speed;
        let compliance_rolling = self.compliance_rolling * size;
        ScrewLoop {
            turn: self.turn.map(|coefficient| coefficient * scale),
            own: self.own,
            turn_weights: (self.turn_sign * screw, self.turn_sign * nut),
            own_weights: (self.screw_weight * screw, self.nut_weight * nut),
            scale,
            compliance_rolling,
            compliance_sliding: self.compliance_sliding * size,
            compliance_spin: compliance_rolling * spin,
            torque_rolling: self.torque_rolling,
            torque_sliding: self.torque_sliding,
            torque_spin: self.torque_rolling * spin,
        }
    }
}

impl ScrewLoop {
    /// One ball: [`ScrewTick::ball`].
    ///
    /// Independent lines stand side by side: a core that keeps their order waits a cycle for an operand
    /// that the line before has made.
    #[inline(always)]
    pub(crate) fn ball(
        &self,
        screw: f32,
        nut: f32,
        share: &LoadShare,
        sums: &mut LoopSums,
    ) -> LoopBall {
        let LoadShare { share, root } = *share;
        let [t1, t2, t3, t4, t5] = self.turn;
        let [o1, o2, o3] = self.own;
        let (u, v) = (self.turn_weights.0 * screw, self.own_weights.0 * screw);
        let (x, y) = (self.turn_weights.1 * nut, self.own_weights.1 * nut);
        let (u, v) = (u + x, v + y);
        let (square, other) = (u * u, v * v);
        let (low, own) = (t2 * u, o2 * v);
        let (high, compliance) = (t4 * u, self.compliance_rolling * root);
        let (low, own) = (t1 + low, o1 + own);
        let (high, top) = (t3 + high, t5 * square);
        let (rest, spin) = (o3 * other, self.compliance_spin * root);
        let (high, power) = (high + top, share * root);
        let (own, compliance) = (own + rest, compliance + self.compliance_sliding);
        let high = high * square;
        let own = own * v;
        let turn = (low + high) * u;
        // Of what turns the ball the coefficients have the scale in them.
        let (all, shares) = (self.scale + turn, sums.share + share);
        let (tilt, powers) = (own * all, sums.four_thirds + power);
        let speed = turn + tilt;
        *sums = LoopSums {
            share: shares,
            four_thirds: powers,
            four_thirds_speed: sums.four_thirds_speed + power * speed,
        };
        LoopBall {
            speed,
            impedance: share / (compliance + spin * speed),
        }
    }

    /// Power loss of these balls in the grooves, N m.
    #[inline(always)]
    pub(crate) fn groove_torque(&self, sums: &LoopSums) -> f32 {
        self.torque_sliding * sums.share
            + self.torque_rolling * sums.four_thirds
            + self.torque_spin * sums.four_thirds_speed
    }
}

/// Series of `1/(1 + x) - 1` with `x = (tan b sin u - (1 - cos u))/2`, from the power of one on.
const fn turn_series(tangent: f32) -> [f32; 5] {
    let x1 = 0.5 * tangent;
    let x2 = -0.25;
    let x3 = -tangent / 12.0;
    let x4 = 1.0 / 48.0;
    let x5 = tangent / 240.0;
    let c1 = -x1;
    let c2 = -(x1 * c1 + x2);
    let c3 = -(x1 * c2 + x2 * c1 + x3);
    let c4 = -(x1 * c3 + x2 * c2 + x3 * c1 + x4);
    let c5 = -(x1 * c4 + x2 * c3 + x3 * c2 + x4 * c1 + x5);
    [c1, c2, c3, c4, c5]
}

#[inline]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}

/// `x^(1/3)` of a positive normal number within 6e-5.
#[inline]
fn cube_root(x: f32) -> f32 {
    let [inverse, _] = inverse_cube_roots([x, 1.0]);
    x * inverse * inverse
}

/// Largest deviation of a contact angle: 0.2 rad, less where the deviations of both grooves together
/// would turn a contact through the plane across the axis, or where the series in them, which converges
/// like the powers of `tan(b) u/2`, would need more terms.
pub(crate) const fn largest_deviation(contact_angle: f32, tangent: f32) -> f32 {
    let both = if contact_angle * tangent < 1.0 {
        contact_angle
    } else {
        1.0 / tangent
    };
    if 0.5 * both < LARGEST_DEVIATION {
        0.5 * both
    } else {
        LARGEST_DEVIATION
    }
}

/// `value` with the sign that a bit stands for.
const fn signed(value: f32, bit: u8) -> f32 {
    if bit == 0 { value } else { -value }
}

/// A deviation within the limits of the series; NaN gives zero.
#[inline]
const fn limited(deviation: f32, largest: f32) -> f32 {
    if deviation.abs() <= largest {
        deviation
    } else if deviation.is_nan() {
        0.0
    } else {
        largest.copysign(deviation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Set-up looks at deviations alone, without the loads that a tick finds them from.
    #[test]
    fn the_fastest_ball_is_that_of_the_heaviest_loads() {
        let fits = [
            GrooveFit::Zero,
            GrooveFit::Play,
            GrooveFit::Preload {
                contact_force: 1e-3,
            },
            GrooveFit::Preload { contact_force: 1e6 },
        ];
        for size in &crate::CATALOGUE {
            for fit in fits {
                let row = ScrewRow::new(&size.design().unwrap(), 0.1, fit).unwrap();
                let mut fastest = 0.0_f32;
                for (nut_speed, load) in [(1.0, 1e7), (1.0, -1e7), (-1.0, 1e7), (-1.0, -1e7)] {
                    let tick = row.at(nut_speed, load);
                    for (screw, nut) in [(0.1, 0.07), (0.1, -0.07), (-0.1, 0.07), (-0.1, -0.07)] {
                        let ball = tick.ball(screw, nut, &LoadShare::MEAN);
                        fastest = fastest.max(ball.speed_deviation.abs());
                    }
                }
                assert_eq!(row.fastest_deviation(0.1, 0.07), fastest, "{fit:?}");
            }
        }
    }
}
