//! Initial stiffness and breakaway angle from a design.
//!
//! Runs on a host, in f32: firmware takes shares and breakaway angles as numbers, in
//! [`ProportionalElements::new`](epas_friction::law::memory::ProportionalElements::new).
//!
//! Before a contact slides it yields: across the ball path by Mindlin's theory, about its normal by the torsion of an
//! ellipse. [`ContactStiffness`] has both for one contact, [`ScrewContacts`] and [`BearingContacts`] what they come to
//! for an angle of the nut or a travel of the carriage, [`Seat`] what the ball's own drift between its grooves adds, and
//! [`Breakaway`] all of it as parts for the elements of a memory: mechanism, share of the friction, breakaway angle,
//! stiffness.
//!
//! | what | known from |
//! |---|---|
//! | compliance and torsion of a contact | theory of elasticity (Mindlin 1949; Galin's theorem), checked by quadrature and a boundary-element grid |
//! | slip and spin share a contact's friction | limit surface of Coulomb friction: exact for gross sliding, its path before that within 5 % |
//! | friction of all mechanisms together | derived here; half of 120 cases within 5 % of that of exact balls, which find their loads and motion, the worst 33 % |
//! | angle of slip across, with two contacts in series | derived here from rolling kinematics; no published screw to check with |
//! | drift of the ball to its seat ([`Seat`]) | derived here; no published screw to check with |
//! | spin of a ball with a third contact ([`Rolling`]) | derived here from the balance of its moments in gross sliding; before that each mechanism is scaled by itself |
//! | curve of rolling resistance | by analogy: a path of two semi-axes is derived, the shape of slip is assumed |

mod bearing;
mod contact;
mod elements;
mod halving;
mod pair;
mod parts;
mod resistance;
mod screw;
mod seat;

pub use bearing::{BearingBreakaway, BearingContacts};
pub use contact::ContactStiffness;
pub use elements::Tables;
pub use pair::{Rolling, ScrewContacts};
pub use parts::{BreakawayPart, Mechanism};
pub use resistance::Resistance;
pub use screw::{Breakaway, BreakawayConfiguration};
pub use seat::Seat;
