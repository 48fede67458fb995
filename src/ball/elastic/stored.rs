//! States of balls as bytes.

use super::constants::BallConstants;
use super::law::{RingBall, RingConstants};
use super::renewal::Settled;
use crate::ball::Clearance;
use crate::error::Range;
use crate::stored::{Fingerprint, Port, Refusal, Stored};
use crate::train::LARGEST_FREE_SPEED;

/// Places over the ball radius. They are hundredths; thousands where a ball under the largest load has not settled between the
/// softest grooves, of which this is far away.
const PLACE: Range = Range::new(-1e6, 1e6);

/// Speeds without forces, which a train takes as they are.
const FREE: Range = Range::new(-LARGEST_FREE_SPEED, LARGEST_FREE_SPEED);

/// Angular velocities of a ball, and its speed over the ball radius, all over the nut's speed: about the path's radius over the
/// ball's. That is 5000 in the most extreme design, of which this is a factor of 20 away.
pub(super) const MOTION: Range = Range::new(-1e5, 1e5);

/// Friction torques and impedances over powers of the load, which are far smaller in every design: a bound that keeps off
/// infinity and what its products would become.
pub(super) const NOT_NEGATIVE: Range = Range::new(0.0, 1e12);

/// Gaps, m: beyond those of every design, -1e-3 to 2.5e-3, which the scene checks against its own ball.
pub(super) const CLEARANCE: Range = Range::new(-0.01, 0.01);

impl Stored for Settled {
    const BYTES: usize = 28;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("place", &mut self.place, PLACE)?;
        port.numbers("turning", &mut self.turning, MOTION)?;
        port.number("speed", &mut self.speed, MOTION)
    }
}

impl Stored for RingBall {
    const BYTES: usize = 36;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("place", &mut self.place, PLACE)?;
        port.numbers("turning", &mut self.turning, MOTION)?;
        port.number("free", &mut self.free, FREE)?;
        port.number("impedance", &mut self.impedance, NOT_NEGATIVE)?;
        port.number("torque", &mut self.torque, NOT_NEGATIVE)
    }
}

impl BallConstants {
    /// Geometry and elasticity of both grooves, over the ball radius, and that.
    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        let grooves = &self.grooves;
        fingerprint.numbers(&[
            grooves.ball_radius,
            grooves.path,
            grooves.sin,
            grooves.sin_lead,
        ]);
        for groove in [&grooves.screw, &grooves.nut] {
            fingerprint.numbers(&[groove.centre, groove.stiffness, groove.semi_major]);
        }
    }

    /// Whether balls of this size take a clearance, m.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming `clearance`.
    pub(super) fn takes(&self, clearance: f32) -> Result<(), Refusal> {
        Clearance::new(clearance)
            .and_then(|clearance| self.checked(clearance))
            .map(|_| ())
            .map_err(|_| Refusal::OutOfRange { field: "clearance" })
    }
}

impl RingConstants {
    /// As [`BallConstants::fingerprint`].
    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        self.ball.fingerprint(fingerprint);
    }
}
