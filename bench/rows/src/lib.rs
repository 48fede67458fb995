//! Rows of balls that all touch, as a scene has them once they have settled: what `eval` answers, and designs are studied by.

pub mod design_study;
pub mod settled;

use epas_friction::train::{IMPEDANCE_RANGE, Press};

/// Most balls in a row of a request.
pub const LARGEST_TRAIN: usize = 64;

/// Rooms of a row of `count` balls that all touch, with nothing behind the first and ahead of the last.
pub fn room_of_a_row<const N: usize>(count: usize) -> [f32; N] {
    let mut room = [f32::INFINITY; N];
    for room in room.iter_mut().take(count.saturating_sub(1)) {
        *room = 0.0;
    }
    room
}

/// Lets balls press on each other by what each would do alone; false where one of them runs further from
/// nominal rolling than the crate counts.
pub fn pressed<const N: usize>(
    press: &mut Press<N>,
    free: &[f32; N],
    compliance: &[f32; N],
    room: &[f32; N],
) -> bool {
    let (least, most) = IMPEDANCE_RANGE;
    // A compliance beyond the range counts as the largest one: such a ball carries hardly any force.
    let impedance = compliance.map(|compliance| compliance.recip().clamp(least, most));
    press.solve(free, &impedance, room)
}

/// Between every ball and the next, the last one and the first included.
pub fn contact_forces<const N: usize>(press: &Press<N>) -> [f32; N] {
    let mut forces = [0.0; N];
    for (place, force) in forces.iter_mut().zip(press.forces()) {
        *place = force;
    }
    forces
}
