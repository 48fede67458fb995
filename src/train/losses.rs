//! What balls of a row that rub on each other lose by their speeds and forces.

/// Friction of both neighbours over `mu W` at which a law has numbers, between which they are linear; zero without friction, and beyond the last
/// one in proportion to it.
pub const RUBBINGS: [f32; 3] = [0.08, 0.25, 0.7];

/// Where a friction over `mu W` lies among [`RUBBINGS`].
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Node above.
    above: usize,
    /// Whether a number rises from the node before, or from zero.
    from_node: bool,
    /// Fraction of the distance from there; above 1 beyond the last node.
    pub(crate) fraction: f32,
    /// 1 / that distance.
    pub(crate) per_width: f32,
}

impl Place {
    #[inline(always)]
    pub(crate) fn of(rubbing: f32) -> Self {
        const FIRST: f32 = RUBBINGS[0];
        const SECOND: f32 = RUBBINGS[1];
        const THIRD: f32 = RUBBINGS[2];
        let (above, from, per_width) = if rubbing < FIRST {
            (0, 0.0, 1.0 / FIRST)
        } else if rubbing < SECOND {
            (1, FIRST, 1.0 / (SECOND - FIRST))
        } else if rubbing < THIRD {
            (2, SECOND, 1.0 / (THIRD - SECOND))
        } else {
            (2, 0.0, 1.0 / THIRD)
        };
        Self {
            above,
            from_node: from > 0.0,
            fraction: (rubbing - from) * per_width,
            per_width,
        }
    }

    /// Numbers at the node below, `none` where they rise from zero, and at the one above.
    #[inline(always)]
    pub(crate) fn ends<'nodes, T>(
        &self,
        nodes: &'nodes [T; 3],
        none: &'nodes T,
    ) -> (&'nodes T, &'nodes T) {
        let [first, second, third] = nodes;
        match (self.above, self.from_node) {
            (0, _) => (none, first),
            (1, _) => (first, second),
            (_, true) => (second, third),
            (_, false) => (none, third),
        }
    }
}

/// A ball that its neighbours rub on, as a train takes it in.
///
/// ```text
/// F_behind - F_ahead = Z (v - u) + r (F_behind + F_ahead)
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RubbedBall {
    /// Free speed `u`, as [`Press::solve`](super::Press::solve) counts it.
    pub speed: f32,
    /// Impedance `Z`, the force that changes the speed by one.
    pub impedance: f32,
    /// `r`: net push in proportion to the neighbours' forces, over these; at most 0.3 in size.
    pub grip: f32,
    /// Change of the friction torque with the speed at [`Losses::held_speed`], N m.
    pub torque_slope: f32,
    /// Whether [`Losses`] hold for it.
    pub counts: bool,
}

/// How the friction torque of a row follows from its balls' speeds `v` and their neighbours' forces:
///
/// ```text
/// T = sum T_j(v_h) + sum [T'_j (v_j - v_h) + c (v_j - v_h)^2 + L(m_j)],      m_j = (F_behind + F_ahead) per_force
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// `v_h`: a speed near that of balls that press.
    pub held_speed: f32,
    /// `c`, N m.
    pub curvature: f32,
    /// Change of a ball's torque with its speed at its free speed, N m: `T'_j` there.
    pub slope: f32,
    /// Friction over `mu W` by the forces of both neighbours, 1/N.
    pub per_force: f32,
    /// `L` at [`RUBBINGS`], N m.
    pub rubbing: [f32; 3],
}

/// What the contacts between balls that rub add up to in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RubbedRow {
    /// Pairs that press on each other.
    pub contacts: u8,
    /// Largest force between two balls.
    pub largest: f32,
    /// Largest sum of the forces of both neighbours of a ball that rubs.
    pub largest_of_both: f32,
    /// Sum over all balls that rub of the forces of both neighbours.
    pub forces: f32,
    /// Sum of `T'_j (v_j - v_h) + c (v_j - v_h)^2`, N m.
    pub by_speed: f32,
    /// Sum of `L(m_j)`, N m.
    pub by_rubbing: f32,
}

impl Losses {
    /// Takes a ball that presses on none, and on which none presses, back to what it loses at its free speed `u`: `T'_j` there and at `v_h` tell its own
    /// curvature, so that nothing is left of it but roundings.
    #[inline(always)]
    pub(super) fn add_alone(&self, row: &mut RubbedRow, speed: f32, slope: f32) {
        row.by_speed += 0.5 * (slope + self.slope) * (speed - self.held_speed);
    }

    /// Adds what a ball that rubs loses, of a speed, a slope of the torque and forces of both neighbours.
    #[inline(always)]
    pub(super) fn add(&self, row: &mut RubbedRow, speed: f32, slope: f32, forces: f32) {
        let change = speed - self.held_speed;
        row.by_speed += (slope + self.curvature * change) * change;
        let place = Place::of(self.per_force * forces);
        let (low, high) = place.ends(&self.rubbing, &0.0);
        row.by_rubbing += low + place.fraction * (high - low);
        row.forces += forces;
        if forces > row.largest_of_both {
            row.largest_of_both = forces;
        }
    }
}
