//! Forces between the balls of a chain, from what each would do on its own.

use crate::train::{IMPEDANCE_RANGE, Press};

/// Impedance of a ball with a compliance, 1/N, within the range that counts: a ball that hardly anything holds is as
/// good as free.
#[inline]
pub(super) fn impedance_of(compliance: f32) -> f32 {
    const LEAST: f32 = IMPEDANCE_RANGE.0;
    const MOST: f32 = IMPEDANCE_RANGE.1;
    (1.0 / compliance).clamp(LEAST, MOST)
}

/// Fills in the forces; whether every speed and impedance counts.
#[inline]
pub(super) fn pressed<const N: usize>(
    press: &mut Press<N>,
    free: &[f32; N],
    impedances: &[f32; N],
    room: &[f32; N],
    forces: &mut [f32; N],
) -> bool {
    let sound = press.solve(free, impedances, room);
    for (force, found) in forces.iter_mut().zip(press.forces()) {
        *force = found;
    }
    sound
}
