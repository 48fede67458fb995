//! Initial stiffness and breakaway angle of a ball screw.

use super::pair::{Rolling, ScrewContacts};
use super::parts::Resistance;
use super::parts::{BreakawayPart, Mechanism};
use super::seat::Seat;
use epas_friction::ball::Clearance;
use epas_friction::contact::RollingResistance;
use epas_friction::error::{Error, Range};
use epas_friction::geometry::{BallScrew, Groove};
use epas_friction::ranges;

/// Load of a contact, N, for which a breakaway angle is found.
const CONTACT_LOAD: Range = Range::new(1e-3, 1e6);

/// Halvings with which a spin is found: one for each digit of an f32. The ends of the interval are apart by a factor of some ten.
const HALVINGS: u8 = 24;

const LOADED_BALLS: Range = Range::new(1.0, 65_535.0);

/// What the breakaway of a screw follows from, beside its design; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BreakawayConfiguration {
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// How the balls fit between the grooves; -0.02 to 0.05 ball radii.
    pub clearance: Clearance,
    /// Rolling resistance of the contacts.
    pub rolling_resistance: RollingResistance,
    /// Balls that carry load, 1 to 65535.
    pub loaded_balls: u16,
    /// Load of each of the two contacts of a ball on its loaded diagonal, N, 1e-3 to 1e6, preload included: that of the
    /// operating point where reversals matter. [`ScrewContacts::preloaded`] finds it from an axial load.
    pub contact_load: f32,
}

/// How a ball rolls in gross sliding.
///
/// A side contact that carries `F_3 + F_4` holds the ball's roll, and with it makes the two loaded contacts spin with up to
/// `s_3 = r_m tan(beta)/(2 r_b cos(alpha))`. Where it cannot, it slides, and the spin `s` is between those of two-point and of
/// three-point rolling:
///
/// ```text
/// mu (F_3 + F_4) r_m/(2 cos(alpha)) = M(s) s_3        F_3, F_4 by the drift under the friction across the path that s leaves
/// torque = slip(s) + M(s) s + mu (F_3 + F_4) r_m/(2 cos(alpha)) (1 - s/s_3)
/// ```
///
/// with the moment `M` of both contacts, which slip across takes off as the limit surface says.
struct Gross {
    rolling: Rolling,
    slip: Resistance,
    spin: Resistance,
}

impl Gross {
    fn of(contacts: &ScrewContacts, seat: &Seat, friction: f32, load: f32) -> Self {
        let full = contacts.spin_per_angle(Rolling::ThreePoint);
        let held = Held::at(contacts, seat, friction, load, full);
        if held.sliding >= held.spin.limit {
            let [third, fourth] = held.side;
            let screw = contacts.contact(Groove::Screw);
            let side = screw
                .spin(friction, third, full)
                .beside(screw.spin(friction, fourth, full));
            return Self {
                rolling: Rolling::ThreePoint,
                slip: held.slip,
                spin: held.spin.beside(side),
            };
        }
        let mut low = contacts.spin_per_angle(Rolling::TwoPoint);
        let mut high = if low < full { full } else { low };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let at = Held::at(contacts, seat, friction, load, middle);
            if at.sliding * middle > at.spin.limit * full {
                low = middle;
            } else {
                high = middle;
            }
        }
        let at = Held::at(contacts, seat, friction, load, low);
        let left = 1.0 - low / full;
        let sliding = if left > 0.0 { at.sliding * left } else { 0.0 };
        // Until it slides, a side contact holds the roll: that share has the angle of three-point spin.
        let sliding = Resistance {
            limit: sliding,
            stiffness: held.spin.stiffness * (sliding / held.spin.limit),
        };
        Self {
            rolling: Rolling::TwoPoint,
            slip: at.slip,
            spin: at.spin.beside(sliding),
        }
    }
}

struct Held {
    slip: Resistance,
    spin: Resistance,
    /// Loads of the side contacts, N.
    side: [f32; 2],
    /// What they would lose by sliding without any roll, N m.
    sliding: f32,
}

impl Held {
    fn at(contacts: &ScrewContacts, seat: &Seat, friction: f32, load: f32, spin: f32) -> Self {
        let (slip, spin) = contacts.spinning(friction, load, spin);
        let side = seat.side_contacts(slip.limit / contacts.slip(friction, load).limit);
        Self {
            slip,
            spin,
            side,
            sliding: friction * (side[0] + side[1]) * contacts.path_per_angle(),
        }
    }
}

/// How the friction of a ball screw begins after a reversal, by its design: parts for the elements of a memory.
///
/// | part | share from | stiffness |
/// |---|---|---|
/// | slip across the path | balance of slip, spin and side contacts | `N l_1^2/(C_S + C_N)` of `N` balls; with the seat, that of its breakaway angle |
/// | spin | the same; with what side contacts lose that slide | `N (k_S + k_N) s^2` |
/// | rolling resistance | [`RollingResistance`] | its torque over a path of two semi-axes |
///
/// ```text
/// breakaway angle = 1.5 torque / stiffness
/// ```
///
/// What holds the ball matters more than the contacts: its drift to the [`Seat`] makes the angle of slip three to four times
/// as large where it just fits, and some hundred times with play. So it should be identified where it matters
/// ([`Breakaway::with_slip_angle`]), and this be its default.
///
/// Torque in gross sliding, against exact balls, five screws, 10 to 200 N a ball, clearances -5 to 20 um: rms
/// 8 %, largest 33 % (where the third contact just closes). Up to gross sliding slip and spin are scaled each from its own
/// mechanism, not solved jointly (derived; no published screw to check with). Wipers, the nut's return and the belt add stiffness
/// and friction of their own.
///
/// ```
/// use epas_design::breakaway::{Breakaway, BreakawayConfiguration, Mechanism, ScrewContacts};
/// use epas_friction::{CATALOGUE, defaults};
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let loaded_balls = 37;
/// let breakaway = Breakaway::of(&design, &BreakawayConfiguration {
///     friction: defaults::FRICTION,
///     clearance: defaults::CLEARANCE,
///     rolling_resistance: defaults::ROLLING_RESISTANCE,
///     loaded_balls,
///     contact_load: ScrewContacts::of(&design).preloaded(1000.0, loaded_balls, defaults::CLEARANCE),
/// })?;
/// for part in breakaway.parts() {
///     println!("{:?}: {} of the friction, within {} rad", part.mechanism, part.share, part.breakaway_angle);
/// }
/// let spin = breakaway.part(Mechanism::Spin);
/// assert!(spin.share > 0.5 && spin.breakaway_angle < 1e-3);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breakaway {
    /// Friction of gross sliding of the whole screw at this load, half the sum of both directions, N m.
    pub torque: f32,
    /// On how many points the balls roll.
    pub rolling: Rolling,
    /// What holds a ball across the path.
    pub seat: Seat,
    /// Breakaway angle of slip in the contacts alone, rad: Mindlin's, with a ball that does not drift.
    pub contact_angle: f32,
    slip: BreakawayPart,
    spin: BreakawayPart,
    resistance: BreakawayPart,
}

impl BreakawayConfiguration {
    /// Checks every field against a design.
    pub fn checked(&self, design: &BallScrew) -> Result<Self, Error> {
        ranges::FRICTION_OF_A_ROW.checked("friction", self.friction)?;
        self.clearance.checked(design)?;
        self.rolling_resistance.checked()?;
        LOADED_BALLS.checked("loaded_balls", f32::from(self.loaded_balls))?;
        CONTACT_LOAD.checked("contact_load", self.contact_load)?;
        Ok(*self)
    }
}

impl Breakaway {
    /// The breakaway of a screw. At set-up, or in a constant.
    pub fn of(design: &BallScrew, configuration: &BreakawayConfiguration) -> Result<Self, Error> {
        let BreakawayConfiguration {
            friction,
            clearance,
            rolling_resistance,
            loaded_balls,
            contact_load: load,
        } = configuration.checked(design)?;
        let contacts = ScrewContacts::of(design);
        let seat = Seat::of(design, &contacts, clearance, friction, load);
        let balls = f32::from(loaded_balls);
        let Gross {
            rolling,
            slip,
            spin,
        } = Gross::of(&contacts, &seat, friction, load);
        let resistance = contacts.rolling(design, rolling_resistance, load)?;
        let (slip, spin) = (slip.times(balls), spin.times(balls));
        let resistance = resistance.times(balls);
        let torque = slip.limit + spin.limit + resistance.limit;
        let breakaway = Self {
            torque,
            rolling,
            seat,
            contact_angle: slip.breakaway(),
            slip: BreakawayPart::of(Mechanism::Slip, slip, torque),
            spin: BreakawayPart::of(Mechanism::Spin, spin, torque),
            resistance: BreakawayPart::of(Mechanism::RollingResistance, resistance, torque),
        };
        // The ball drifts while slip builds up, as far as the force across the path pushes it.
        let force = slip.limit / contacts.slip(friction, load).times(balls).limit;
        let drifting = breakaway.contact_angle + seat.drift_angle(force);
        Ok(breakaway.slipping_within(drifting))
    }

    /// Slip, spin and rolling resistance, for elements alone: slip reaches its limit with the ball on its seat.
    #[must_use]
    pub fn parts(&self) -> [BreakawayPart; 3] {
        [self.slip, self.spin, self.resistance]
    }

    /// The parts with slip in the contacts alone, by Mindlin: for a memory that has an element for the seat.
    #[must_use]
    pub fn contact_parts(&self) -> [BreakawayPart; 3] {
        self.slipping_within(self.contact_angle).parts()
    }

    /// One of [`Self::parts`].
    #[must_use]
    pub fn part(&self, mechanism: Mechanism) -> BreakawayPart {
        match mechanism {
            Mechanism::Slip => self.slip,
            Mechanism::Spin => self.spin,
            Mechanism::RollingResistance => self.resistance,
        }
    }

    /// Initial stiffness of the parts together, N m/rad.
    #[must_use]
    pub fn stiffness(&self) -> f32 {
        self.slip.stiffness + self.spin.stiffness + self.resistance.stiffness
    }

    /// This breakaway with an identified angle of slip, rad, 1e-6 to 10.
    pub fn with_slip_angle(self, breakaway_angle: f32) -> Result<Self, Error> {
        const ANGLE: Range = Range::new(1e-6, 10.0);
        Ok(self.slipping_within(ANGLE.checked("breakaway_angle", breakaway_angle)?))
    }

    fn slipping_within(self, breakaway_angle: f32) -> Self {
        Self {
            slip: self.slip.within(breakaway_angle, self.torque),
            ..self
        }
    }
}
