//! The fits that the closed form tells apart.

/// How balls fit between the grooves, as the closed form [`ScrewRow`](super::ScrewRow) takes it: three cases, where
/// scenes take a [`Clearance`](crate::Clearance), of which these are limits.
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
