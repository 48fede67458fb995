//! The train of balls: which balls press on each other, how hard, and where they go.
//!
//! | | what it is |
//! |---|---|
//! | [`Press`] | forces between balls from their free speeds, impedances and rooms: one exact pass |
//! | [`Train`] | the balls' positions on a closed track, and a tick that moves them |
//!
//! `N` of the types is the room for balls, 1 to 255; a train has 1 to `N`, from when it is made on. A ball is known by two numbers: the speed
//! at which it would run on its own, and its impedance, the force that changes this speed by one. [`Press`] says what is solved; this page says how.
//!
//! # Words
//!
//! - **Room** of a ball: the speed at which it may run up to the ball in front; their gap over the time of a tick.
//! - **Slack** `s_j = u_(j+1) - u_j + r_j`: by how much a ball stays clear of the one in front if both run at their
//!   free speeds `u`, with the room `r`. Around the ring the slacks add up to the rooms.
//! - **Cluster**: neighbours that move as one, because they touch or close their gaps within the tick. A ball alone
//!   is a cluster of one. No force acts on a cluster from outside.
//! - **Push** of a cluster: the force with which the others would push the front ball, if that kept its free speed.
//! - **Foremost** ball: one that presses on none, where walks around the ring begin.
//!
//! # Phases of a tick
//!
//! | phase | file | work for `N` balls | what holds afterwards |
//! |---|---|---|---|
//! | take in | `tick` | `N` balls | each ball has its free speed, impedance and slack |
//! | join | `pool` | at most `N - 1` joins, fewer than `4 N` comparisons | clusters part the ring; none runs into the one ahead; their end balls hold their sums |
//! | settle | `pool` | `N` balls, a division for each cluster of two or more | each ball has its actual speed and its force, zero or more |
//! | move | `tick`, in the walk of settling | | balls that press stand in contact exactly, no two overlap by more than rounding |
//! | balance | `pool` | `N` balls, where rounding needs it | the net pushes on each cluster add up to zero, to 1e-6 of the largest force |
//!
//! `press` says what a ball holds in each phase. Loops are bounded by `N`; nothing iterates to a tolerance, recurses, allocates or panics.
//!
//! # Why joining is exact
//!
//! **What is stored is enough.** A cluster is known by three sums (push, impedance, inner slack), from which follow
//! its speed and whether it runs into another; those of two as one follow from those of the two (`Cluster`).
//!
//! **No force inside a cluster ever falls.** Counted from the rear and from the front, the force of ball `j` is
//!
//! ```text
//! F_j = sum over the balls up to j of Z_i (u_i - v_i) = sum over the balls beyond j of Z_i (v_i - u_i)
//! ```
//!
//! Two clusters are joined where the one behind is faster than contact allows. As one, the balls behind run slower and those ahead faster: by the
//! first and the second sum their forces grow, and the force between the two is above zero. So no join opens a contact that
//! an earlier one has closed: joins may come in any order, and none is taken back.
//!
//! **It ends.** Each join makes one cluster of two: there are at most `N - 1`. A comparison that finds none is followed by a join or ends a cluster.
//!
//! **It is the solution.** In the end no cluster runs into the one ahead, all forces within are zero or more and
//! those between are zero: the conditions in [`Press`], which one set of speeds alone fulfils. A ring keeps
//! at least one gap, since its slacks add up to the rooms, which are not negative.
//!
//! **Comparisons are strict.** Clusters exactly as fast as each other are not joined: the force between them would be rounding alone, and a ring of
//! equal balls would be found to press all around.
//!
//! # Where balls rub on each other
//!
//! Friction of its neighbours makes a ball need more or less net push, in proportion to their forces (`grip`). Each force then is that of balls
//! that do not rub, times a factor from ball to ball; impedances weighed by the same factors leave all of the above as it is. A first pass joins and
//! settles balls that do not move, from whose forces each is taken in anew for the second one.
//!
//! # Rounding
//!
//! Sums hold differences from free speeds, so that what is small keeps its digits. Forces that rounding makes negative are zero. Adding up a
//! cluster from its front leaves at its rear ball a remainder that is zero but for rounding; above 1e-6 of the largest force it is taken out.
//! Positions are integers and do not drift; balls that overlap by up to 2^10 units of 2^32 on the track count as in contact.

mod pool;
mod press;
mod tick;
mod track;

pub use press::{FreeBall, IMPEDANCE_RANGE, LARGEST_FREE_SPEED, LARGEST_GRIP, Press};
pub use tick::Neighbours;
pub(crate) use track::{BALL_BYTES, Track};
pub use track::{BallContact, LARGEST_TRAVEL, Train};
