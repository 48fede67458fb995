//! Ordinary mechanisms, one of every scene.

use core::f32::consts::TAU;

use super::designs::LINEAR_BEARING;
use epas_friction::ball::pressed::{BallLaw, NEIGHBOUR_KNOTS, RUBBINGS};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, CatalogueBall, FoldedBall,
};
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, ClosedFormScrewConfiguration, DISSERTATION_DESIGNS,
    DeviationMap, Error, FrictionBranch, Harmonic, Inputs, Limits, LinearBearing,
    LinearBearingConfiguration, LinearBearingParameters, LinearInputs, LinearLimits, LoadShare,
    LoadShares, UncagedBallScrew, UncagedBallScrewConfiguration,
};

/// Balls of [`uncaged`], and of [`full`].
pub const SCREW_BALLS: usize = 37;

/// Balls of [`linear`].
pub const LINEAR_BALLS: usize = 16;

/// What a set-up gives, for constants.
pub const fn folded<T: Copy>(set_up: Result<T, Error>) -> T {
    match set_up {
        Ok(folded) => folded,
        Err(_) => panic!("a field is out of range"),
    }
}

const fn one_wave(order: u8, cosine: f32, sine: f32) -> DeviationMap {
    let harmonic = Harmonic {
        order,
        cosine,
        sine,
    };
    folded(DeviationMap::from_harmonics(1, &[harmonic]))
}

/// Two waves of 2.3 degrees a turn, Lin 2019, Fig. 3.23.
static SCREW_MAP: DeviationMap = one_wave(2, 0.0, 0.04014);
static NUT_MAP: DeviationMap = one_wave(3, 0.01, 0.02);

/// A wave of so many periods in so many turns, rad, for as long as the program runs.
pub fn wave(turns: u16, order: u8, cosine: f32, sine: f32) -> &'static DeviationMap {
    let harmonic = Harmonic {
        order,
        cosine,
        sine,
    };
    Box::leak(Box::new(
        DeviationMap::from_harmonics(turns, &[harmonic]).unwrap(),
    ))
}

/// Bounds of ordinary screws.
pub const LIMITS: Limits = Limits {
    nut_speed: 500.0,
    axial_load: 20_000.0,
    friction_torque: 5.0,
};

/// Oversize with which so many loaded balls press each flank of the nut with an axial force, N.
pub const fn oversize(design: &BallScrew, axial_preload: f32, loaded_balls: u16) -> Clearance {
    let slope = design.contact_angle().sin * design.cos_lead_angle();
    let contact_force = axial_preload / (loaded_balls as f32 * slope);
    folded(Clearance::of_preload(design, contact_force))
}

/// Nodes of [`CagedScrew`].
pub const NODES: usize = 5;

/// A caged screw for a range of friction coefficients.
pub type CagedScrew = CagedBallScrew<NODES>;

/// Its configuration.
pub type CagedConfiguration = CagedBallScrewConfiguration<NODES>;

/// Axial preload of each flank of [`caged`], N.
pub const CAGED_PRELOAD: f32 = 350.0;

/// Blocks that the firmware has: the same bits on every machine.
#[allow(dead_code, reason = "their words alone are read")]
mod blocks {
    include!("../../firmware/src/gears/gear_33x20_range.rs");
    include!("../../firmware/src/gears/gear_33x20.rs");
    include!("../../firmware/src/gears/gear_33x20_worn.rs");
    pub(super) const RANGE: &[u32] = &GEAR_33X20_RANGE_BLOCK;
    pub(super) const ONE: &[u32] = &GEAR_33X20_BLOCK;
    pub(super) const WORN: &[u32] = &GEAR_33X20_WORN_BLOCK;
}

/// The screw of Lin 2019, chapter 3.6, caged, with 126 balls in the place of 36, and so [`CAGED_PRELOAD`]: friction coefficients of 0.05 to 0.15, 0.075
/// at first.
pub fn caged() -> CagedConfiguration {
    CagedConfiguration {
        loaded_balls: 126,
        limits: LIMITS,
        ..CagedBallScrewConfiguration::read(blocks::RANGE).unwrap()
    }
}

/// The same screw for a friction coefficient of 0.075 alone.
pub fn preloaded() -> CagedBallScrewConfiguration {
    CagedBallScrewConfiguration {
        limits: LIMITS,
        ..CagedBallScrewConfiguration::read(blocks::ONE).unwrap()
    }
}

/// The same screw with 2 um of play, for a friction coefficient of 0.075 alone.
pub fn worn() -> CagedBallScrewConfiguration {
    CagedBallScrewConfiguration {
        limits: LIMITS,
        ..CagedBallScrewConfiguration::read(blocks::WORN).unwrap()
    }
}

/// 32 x 20 x 6.35 with 300 N of preload on each flank, by a closed form.
pub const fn closed_form(branch: FrictionBranch) -> ClosedFormScrewConfiguration {
    let design = folded(CATALOGUE[15].design());
    ClosedFormScrewConfiguration {
        design,
        friction: 0.075,
        rolling_tangent: 0.0,
        branch,
        clearance: oversize(&design, 300.0, 41),
        loaded_balls: 41,
        reversal_speed: 0.5,
        limits: LIMITS,
    }
}

/// Nodes of [`UncagedScrew`].
pub const BALL_NODES: usize = 3;

/// A screw without cage for a range of friction coefficients.
pub type UncagedScrew<const N: usize> = UncagedBallScrew<N, BALL_NODES>;

/// Its configuration.
pub type UncagedConfiguration = UncagedBallScrewConfiguration<BALL_NODES>;

/// Bounds of a screw without cage.
const BALL_LIMITS: Limits = Limits {
    friction_torque: 50.0,
    ..LIMITS
};

/// The ball of the screw of Lin 2019, Table 3.6, that its neighbours press on, by the closed form: its bits do not change with what a host
/// folds. The closed form knows nothing of what friction between balls does to their speeds; here it is that of a folded ball in its order.
const fn ball_of(friction: f32) -> FoldedBall {
    let mut ball = folded(FoldedBall::of_catalogue(&CatalogueBall {
        design: folded(BallScrew::new(DISSERTATION_DESIGNS[1].parameters)),
        friction,
        clearance: Clearance::ZERO,
        deviations: [0.0402, 0.0225],
        axial_load: 300.0,
        reversal_speed: 0.5,
        limits: BALL_LIMITS,
    }));
    let mut knot = 0;
    while knot < 2 * NEIGHBOUR_KNOTS {
        let numbers = &mut ball.law.nodes[0].neighbours[knot / NEIGHBOUR_KNOTS]
            [knot % NEIGHBOUR_KNOTS]
            .numbers;
        let mut node = 0;
        while node < RUBBINGS.len() {
            let rubbing = RUBBINGS[node];
            numbers.nodes[node].push = [-0.9 * rubbing, 0.2 * rubbing, -0.1 * rubbing];
            numbers.nodes[node].impedance = [8.0 * rubbing, -rubbing, 0.5 * rubbing];
            node += 1;
        }
        numbers.outward = [-0.3, 0.1, 0.05];
        numbers.outward_torque = 2e-4;
        knot += 1;
    }
    ball
}

/// That ball for one friction coefficient.
pub static BALL: FoldedBall = ball_of(0.1);
/// [`BALL`] for a range of friction coefficients.
pub static BALL_RANGE: FoldedBall<BALL_NODES> = FoldedBall {
    law: BallLaw {
        nodes: [
            ball_of(0.0667).law.nodes[0],
            BALL.law.nodes[0],
            ball_of(0.15).law.nodes[0],
        ],
        deviations: BALL.law.deviations,
        lift_off: BALL.law.lift_off,
    },
    friction: BALL.friction,
    lead: BALL.lead,
    ball_radius: BALL.ball_radius,
    path_radius: BALL.path_radius,
    speed: BALL.speed,
    reversal_speed: BALL.reversal_speed,
    limits: BALL.limits,
};

/// A folded ball with other numbers, for as long as the program runs.
pub fn changed<const NODES: usize>(
    folded: &FoldedBall<NODES>,
    change: impl FnOnce(&mut FoldedBall<NODES>),
) -> &'static FoldedBall<NODES> {
    let mut folded = *folded;
    change(&mut folded);
    Box::leak(Box::new(folded))
}

/// Two waves a turn as large as the folded ball takes, Lin 2019, Fig. 3.23.
pub static BALL_SCREW_MAP: DeviationMap = one_wave(2, 0.0, BALL_RANGE.law.deviations[0]);
/// Three waves a turn.
pub static BALL_NUT_MAP: DeviationMap = one_wave(
    3,
    0.4 * BALL_RANGE.law.deviations[1],
    0.8 * BALL_RANGE.law.deviations[1],
);

/// Two waves a turn on the screw, as a share of the largest deviation that the folded ball of one friction coefficient takes.
pub fn screw_wave(share: f32) -> &'static DeviationMap {
    wave(1, 2, 0.0, share * BALL.law.deviations[0])
}

/// That ball with two and a half turns of 37 balls and a return.
pub fn uncaged() -> UncagedConfiguration {
    UncagedBallScrewConfiguration {
        folded: &BALL_RANGE,
        ball_friction: 0.1,
        balls: SCREW_BALLS as u16,
        turns: 2.5,
        return_length: 0.01,
        screw_deviation: &BALL_SCREW_MAP,
        nut_deviation: &BALL_NUT_MAP,
        load_shares: LoadShares::EVEN,
        tick: 1e-4,
    }
}

/// [`uncaged`] with grooves that do not deviate.
pub fn even() -> UncagedConfiguration {
    UncagedBallScrewConfiguration {
        screw_deviation: &DeviationMap::NONE,
        nut_deviation: &DeviationMap::NONE,
        ..uncaged()
    }
}

/// Balls that nearly fill the track of [`uncaged`].
pub const CROWD: usize = 48;

/// [`uncaged`] with ticks long enough for a [`CROWD`] to close up.
pub fn crowded() -> UncagedConfiguration {
    UncagedBallScrewConfiguration {
        folded: changed(&BALL_RANGE, |folded| folded.limits.nut_speed = 100.0),
        balls: CROWD as u16,
        tick: 5e-4,
        ..uncaged()
    }
}

/// The screw of Lin 2019, Table 3.6, whose two turns 37 balls fill, with a wave on its screw.
pub fn full(screw_deviation: &'static DeviationMap, tick: f32) -> UncagedBallScrewConfiguration {
    UncagedBallScrewConfiguration {
        folded: changed(&BALL, |folded| {
            folded.reversal_speed = 1e-3;
            folded.limits = Limits {
                nut_speed: 300.0,
                axial_load: 20_000.0,
                friction_torque: 50.0,
            };
        }),
        ball_friction: 0.1,
        balls: SCREW_BALLS as u16,
        turns: 2.0,
        return_length: 0.0,
        screw_deviation,
        nut_deviation: &DeviationMap::NONE,
        load_shares: LoadShares::EVEN,
        tick,
    }
}

/// Length of the loaded track of a screw without cage, m.
pub fn loaded_length<const NODES: usize>(
    configuration: &UncagedBallScrewConfiguration<NODES>,
) -> f32 {
    configuration.turns * TAU * configuration.folded.path_radius
}

/// Balls of 10 mm, Lin 2019, Table 3.3.
pub const fn linear() -> LinearBearingConfiguration {
    LinearBearingConfiguration {
        bearing: folded(LinearBearing::new(LINEAR_BEARING)),
        friction: 0.1,
        ball_friction: 0.1,
        balls: LINEAR_BALLS as u16,
        loaded_length: 0.12,
        return_length: 0.05,
        wavelength: 0.06,
        rail_deviation: &SCREW_MAP,
        carriage_deviation: &NUT_MAP,
        load_shares: &[LoadShare::MEAN],
        reversal_speed: 1e-3,
        tick: 1e-4,
        limits: LinearLimits {
            speed: 3.0,
            load: 20_000.0,
            friction_force: 500.0,
        },
    }
}

/// [`linear`] with other balls on the same track.
pub fn linear_of_smaller_balls() -> LinearBearingConfiguration {
    LinearBearingConfiguration {
        bearing: LinearBearing::new(LinearBearingParameters {
            ball_radius: 0.0049,
            ..*linear().bearing.parameters()
        })
        .unwrap(),
        ..linear()
    }
}

/// Phase of the groove that passes by, in units of 2^-32 of its period, and what is left of a unit: as a state prints them.
pub fn printed_phase(state: &impl std::fmt::Debug) -> String {
    let state = format!("{state:?}");
    let (_, phase) = state.split_once("phase: ").unwrap();
    phase.split_once('}').unwrap().0.to_owned()
}

/// Inputs of a ball screw: rad/s, N.
pub const fn screw_inputs(nut_speed: f32, axial_load: f32) -> Inputs {
    Inputs {
        nut_speed,
        axial_load,
    }
}

/// Inputs of a linear bearing: m/s, N.
pub const fn linear_inputs(speed: f32, normal_load: f32, side_load: f32) -> LinearInputs {
    LinearInputs {
        speed,
        normal_load,
        side_load,
    }
}
