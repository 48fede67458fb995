//! Initial stiffness and breakaway angle from a design.
//!
//! Before a contact slides it yields: across the ball path by Mindlin's theory, about its normal by the torsion of an
//! ellipse.
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
mod pair;
mod parts;
mod screw;
mod seat;

pub use bearing::{BearingBreakaway, BearingContacts};
pub use contact::ContactStiffness;
pub use elements::Tables;
pub use pair::{Rolling, ScrewContacts};
pub use parts::{BreakawayPart, Mechanism, Resistance};
pub use screw::{Breakaway, BreakawayConfiguration};
pub use seat::Seat;
