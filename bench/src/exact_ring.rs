//! The scene of a ball screw without cage against the exact whole screw, over the same turns of the nut.
//!
//! Both follow the same balls, which start at the same places. Every value of the scene is compared with the exact one of the same state, also
//! where balls meet or part in the one and not yet in the other, and where the scene flags it
//! ([`Faults`](epas_friction::Faults)). Rolling resistance, which is added to a ball's loss and moves nothing, is left out of both.

use std::f64::consts::TAU;

use epas_design::uncaged::Folded;
use epas_design::{CagedDesign, UncagedDesign, UncagedFold};
use epas_friction::scene::FoldedBall;
use epas_friction::{
    Clearance, DeviationMap, FrictionModel, Inputs, Limits, LoadShares, RollingResistance,
    UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ring::{
    ElasticRing, GrooveDeviation, RingSample, RingState,
};
use epas_reference::friction::patch::Integration;

use crate::report::statistics::Errors;
use crate::study::screw_of;
use epas_design::uncaged_scene::{LEAST_DEVIATION, MARGIN, folded, loads_holding};

/// Slack of the track, where a case does not say its length, over the distance of two balls that touch: as such screws are filled, half of all pairs
/// press.
const SLACK: f64 = 0.1;

/// How the contact angles of a groove deviate: waves of orders 1 to 8 over a period of some turns.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// Largest deviation, rad.
    pub largest: f64,
    /// Turns of the period.
    pub turns: u16,
    /// Amplitudes of sine and cosine of each order, over the largest deviation.
    pub orders: [[f64; 2]; 8],
}

impl Deviation {
    /// So many waves in a turn, 1 to 8.
    #[must_use]
    pub const fn wave(amplitude: f64, order: usize) -> Self {
        let mut orders = [[0.0; 2]; 8];
        orders[order - 1][0] = 1.0;
        Self {
            largest: amplitude,
            turns: 1,
            orders,
        }
    }

    /// Samples of a map, rad: between them it is linear.
    fn samples(&self) -> [f64; 64] {
        std::array::from_fn(|sample| {
            let phase = TAU * sample as f64 / 64.0;
            let waves = (1..)
                .map(|order| f64::from(order) * phase)
                .zip(&self.orders);
            self.largest
                * waves
                    .map(|(at, [sine, cosine])| sine * at.sin() + cosine * at.cos())
                    .sum::<f64>()
        })
    }

    /// The map of the scene, which lives as long as the program: in firmware it lies in flash.
    fn map(&self) -> Result<&'static DeviationMap, String> {
        let samples = self.samples().map(|deviation| deviation as f32);
        let map =
            DeviationMap::from_samples(self.turns, &samples).map_err(|error| error.to_string())?;
        Ok(Box::leak(Box::new(map)))
    }

    fn exact(&self) -> GrooveDeviation {
        GrooveDeviation::Samples {
            turns: self.turns.into(),
            values: self.samples().into(),
        }
    }
}

/// What is asked of one screw. Lengths in m, angles in rad, forces in N.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Design.
    pub design: BallScrewDesign,
    /// Friction coefficient of balls and grooves.
    pub friction: f64,
    /// Friction coefficient between balls.
    pub ball_friction: f64,
    /// Radial gap of every contact at the centred ball.
    pub clearance: f64,
    /// Axial load of a ball, N.
    pub load_per_ball: f64,
    /// Length of the whole track in turns; without it as long as the row of its balls with a slack of a tenth of a ball.
    pub track: Option<f64>,
    /// Part of the track that carries load.
    pub loaded: f64,
    /// Deviation of the screw's groove.
    pub screw: Deviation,
    /// The same of the nut.
    pub nut: Deviation,
    /// Turns of the nut a second, negative backward.
    pub speed: f64,
    /// Turns of the nut that are followed.
    pub turns: f64,
    /// States that are compared.
    pub states: usize,
    /// Longest time between two ticks, s: as many of one length lead from each state to the next.
    pub tick: f64,
}

impl Case {
    /// Lin 2019, Table 3.6, under 50 N a ball, with deviations of 1 degree on the screw and 0.5 degrees in the nut.
    pub const LIN: Self = Self {
        design: BallScrewDesign::LIN,
        friction: 0.1,
        ball_friction: 0.1,
        clearance: 0.0,
        load_per_ball: 50.0,
        track: None,
        loaded: 0.95,
        screw: Deviation::wave(TAU / 360.0, 2),
        nut: Deviation::wave(0.5 * TAU / 360.0, 3),
        speed: 1.0,
        turns: 2.0,
        states: 720,
        tick: 1e-3,
    };
}

/// Largest, rms and mean error, each at the same state as the exact value.
#[derive(Clone, Copy, Debug, Default)]
pub struct Off {
    errors: Errors,
    scale: f64,
}

impl Off {
    /// A value that may be zero, such as a force between balls: its error counts over the largest exact one of all states.
    fn add_of_largest(&mut self, found: f64, exact: f64) {
        self.errors.add(found - exact);
        self.scale = self.scale.max(exact.abs());
    }

    /// A value that never is: its error counts over the exact one of its own state.
    fn add_of_own(&mut self, found: f64, exact: f64) {
        self.errors.add(found / exact - 1.0);
        self.scale = 1.0;
    }

    /// Largest, rms and mean; NaN where nothing was compared or every exact value is zero.
    pub fn relative(&self) -> [f64; 3] {
        [self.errors.largest, self.errors.rms(), self.errors.mean()].map(|off| off / self.scale)
    }
}

/// The scene at one state.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Angle of the nut since the start, rad.
    pub nut_angle: f64,
    /// Torque of the grooves and between balls, N m.
    pub torques: [f64; 2],
    /// Error of their sum, over the exact one; NaN without an exact solution.
    pub error: f64,
    /// Whether the scene flags this state.
    pub flagged: bool,
    /// Pairs that press in the exact screw and in the scene.
    pub pressing: [usize; 2],
}

/// What both found.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// Forces of all pairs, over the largest.
    pub force: Off,
    /// Friction torque and its part of the grooves, over the exact torque of the same state.
    pub torque: Off,
    /// Torque of the grooves.
    pub groove: Off,
    /// Its part of the balls, over the largest.
    pub ball: Off,
    /// Speeds of all balls against the nut, over the largest.
    pub speed: Off,
    /// Difference of the number of pairs that press, over the largest.
    pub pairs: Off,
    /// States compared.
    pub compared: usize,
    /// States that the scene flags.
    pub flagged: usize,
    /// States without an exact solution.
    pub failed: usize,
    /// Largest exact force, N.
    pub largest_force: f64,
    /// Every state.
    pub course: Vec<Moment>,
}

impl Comparison {
    /// Mean number of pairs that press in the exact screw.
    #[must_use]
    pub fn pressing(&self) -> f64 {
        let pairs = self.course.iter().map(|moment| moment.pressing[0]);
        pairs.sum::<usize>() as f64 / self.course.len() as f64
    }
}

fn ring(case: &Case, balls: usize) -> ElasticRing {
    let (path, turns) = case.track(balls);
    ElasticRing {
        design: case.design,
        clearance: case.clearance,
        friction: case.friction,
        ball_friction: case.ball_friction,
        balls,
        turns: case.loaded * turns,
        return_length: (1.0 - case.loaded) * turns * TAU * path,
        screw_deviation: case.screw.exact(),
        nut_deviation: case.nut.exact(),
        load_shares: vec![],
        chord: true,
        places: vec![],
        // With fewer nodes power and forces disagree on narrow ellipses, and a search for the least power ends off balance.
        integration: Integration::Full,
    }
}

struct Followed<const N: usize> {
    model: FrictionModel<UncagedBallScrew<N>>,
    /// Path radius of the balls; speed of a nominal ball and its speed against the nut, m per unit of nut speed.
    path: f64,
    nominal: f64,
    against: f64,
}

impl<const N: usize> Followed<N> {
    fn new(case: &Case) -> Result<Self, String> {
        let law = case.law()?;
        // A law is shared by cases of other speeds.
        let folded = Box::leak(Box::new(FoldedBall {
            limits: Limits {
                nut_speed: (1.01 * TAU * case.speed.abs()) as f32,
                ..law.limits
            },
            ..*law
        }));
        let (path, turns) = case.track(N);
        let return_length = (1.0 - case.loaded) * turns * TAU * path;
        let model = FrictionModel::new(&UncagedBallScrewConfiguration {
            folded,
            ball_friction: case.ball_friction as f32,
            balls: N as u16,
            turns: (case.loaded * turns) as f32,
            return_length: return_length as f32,
            screw_deviation: case.screw.map()?,
            nut_deviation: case.nut.map()?,
            load_shares: LoadShares::EVEN,
            tick: case.ticks().1 as f32,
        })
        .map_err(|error| error.to_string())?;
        let design = case.design;
        let cos_lead_angle = design.pitch_radius / path;
        let rolling = design.ball_radius * cos_lead_angle * design.contact_angle.cos();
        let nominal = 0.5 * (path + rolling);
        Ok(Self {
            model,
            path,
            nominal,
            against: path - nominal,
        })
    }

    fn add(
        &self,
        comparison: &mut Comparison,
        outputs: &UncagedOutputs,
        exact: &RingState,
        nut_speed: f64,
    ) {
        let train = &self.model.state().circuit.train;
        for (force, ball) in train.forces().zip(&exact.balls) {
            comparison.force.add_of_largest(force.into(), ball.force);
        }
        for (speed, ball) in train.speeds().zip(&exact.balls) {
            comparison.speed.add_of_largest(
                self.against * f64::from(speed) * nut_speed.signum(),
                ball.speed / nut_speed * self.path - self.nominal,
            );
        }
        comparison
            .torque
            .add_of_own(outputs.friction_torque.into(), exact.torque());
        comparison
            .groove
            .add_of_own(outputs.groove_torque.into(), exact.groove_torque);
        comparison
            .ball
            .add_of_largest(outputs.ball_torque.into(), exact.ball_torque);
        comparison
            .pairs
            .add_of_largest(outputs.contacts.into(), exact.pressing() as f64);
        comparison.compared += 1;
    }
}

impl Case {
    /// The law that firmware would have, folded once for all cases that share it: for 5 to 300 N a ball, or up to the power of two above
    /// [`MARGIN`] times the case's load where that is more, and for its deviations.
    pub fn law(&self) -> Result<&'static FoldedBall, String> {
        let named = |error: epas_friction::Error| error.to_string();
        let design = screw_of(&self.design).map_err(named)?;
        let mut fold = UncagedFold::of(UncagedDesign {
            gear: CagedDesign {
                design,
                friction: self.friction as f32,
                rolling_resistance: RollingResistance::NONE,
                clearance: Clearance::new(self.clearance as f32).map_err(named)?,
                loaded_balls: 1,
                reversal_speed: 1e-6,
                limits: Limits {
                    nut_speed: 1e3,
                    axial_load: 1e6,
                    friction_torque: 1e4,
                },
            },
            deviations: [self.screw.largest, self.nut.largest]
                .map(|largest| (1.0001 * largest.abs() as f32).max(LEAST_DEVIATION)),
        });
        let [least, _] = fold.axial_load;
        let largest = MARGIN * self.load_per_ball.abs() as f32;
        fold.axial_load = loads_holding(fold.axial_load, [least, largest]);
        match folded(&fold) {
            Ok(Folded::One(folded)) => Ok(folded),
            Ok(Folded::Range(_)) => Err("one friction coefficient is one node".into()),
            Err(failure) => Err(failure.to_string()),
        }
    }

    /// Ticks from each state to the next, and the time between two ticks, s.
    fn ticks(&self) -> (usize, f64) {
        let between = self.turns / self.speed.abs() / self.states.max(1) as f64;
        // A time that is a whole number of ticks to the rounding is so.
        let ticks = (between / self.tick - 1e-9).ceil().max(1.0);
        (ticks as usize, between / ticks)
    }

    /// Angular velocity of the nut, rad/s, and axial load of a screw with so many balls, N.
    fn drive(&self, balls: usize) -> (f64, f64) {
        (
            self.speed * TAU,
            self.load_per_ball * balls as f64 * self.loaded,
        )
    }

    /// Path radius of the balls, m, and turns of the whole track of so many.
    fn track(&self, balls: usize) -> (f64, f64) {
        let path = self.design.pitch_radius.hypot(self.design.lead / TAU);
        let pitch = 2.0 * (self.design.ball_radius / path).asin();
        let turns = self.track;
        (path, turns.unwrap_or((balls as f64 + SLACK) * pitch / TAU))
    }
}

/// The exact screw over the turns of a case.
pub fn exact<const N: usize>(case: &Case) -> Result<Vec<RingState>, String> {
    let (nut_speed, axial_load) = case.drive(N);
    let (ticks, tick) = case.ticks();
    let asked: Vec<RingSample> = (0..=case.states)
        .map(|state| RingSample {
            time: (state * ticks) as f64 * tick,
            nut_speed,
            axial_load,
        })
        .collect();
    ring(case, N)
        .simulate(&asked, |_, _| ())
        .map_err(|error| error.to_string())
}

/// Follows both over the turns of a case.
pub fn compare<const N: usize>(case: &Case) -> Result<Comparison, String> {
    // Told before the exact screw is followed.
    let _ = case.law()?;
    follow::<N>(case, &exact::<N>(case)?)
}

/// Follows the scene beside the states of the exact screw.
pub fn follow<const N: usize>(case: &Case, states: &[RingState]) -> Result<Comparison, String> {
    let mut scene = Followed::<N>::new(case)?;
    let (nut_speed, load) = case.drive(N);
    let (ticks, _) = case.ticks();
    let mut comparison = Comparison::default();
    for (at, state) in states.iter().enumerate() {
        let mut step = || {
            scene.model.step(Inputs {
                nut_speed: nut_speed as f32,
                axial_load: load as f32,
            })
        };
        // The last tick of those that lead to a state outputs what holds there; a flag of any of them counts.
        let mut flagged = false;
        let mut outputs = step();
        for _ in 1..if at == 0 { 1 } else { ticks } {
            flagged |= outputs.faults.any();
            outputs = step();
        }
        flagged |= outputs.faults.any();
        let solved = state.solved();
        comparison.course.push(Moment {
            nut_angle: state.nut_angle,
            torques: [outputs.groove_torque, outputs.ball_torque].map(f64::from),
            error: f64::from(outputs.friction_torque) / state.torque() - 1.0,
            flagged,
            pressing: [state.pressing(), outputs.contacts.into()],
        });
        comparison.flagged += usize::from(flagged);
        comparison.failed += usize::from(!solved);
        if solved {
            comparison.largest_force = comparison.largest_force.max(state.largest_force());
            scene.add(&mut comparison, &outputs, state, nut_speed);
        }
    }
    Ok(comparison)
}

#[cfg(test)]
mod tests;
