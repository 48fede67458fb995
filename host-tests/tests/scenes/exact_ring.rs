//! The scene of a ball screw without cage against the exact whole screw.

use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, DeviationMap, FrictionModel, GrooveSize, Harmonic,
    Inputs, Limits, LoadShares, Material, RollingResistance, UncagedBallScrew,
    UncagedBallScrewConfiguration,
};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ring::{
    DeviationWave, ElasticRing, GrooveDeviation, RingSample,
};
use epas_reference::friction::patch::Integration;
use epas_reference::material::Elastic;
use std::f64::consts::TAU;

/// States before and after a time that count as about the same time.
const NEAR: usize = 3;

/// What is asked of one screw.
#[derive(Clone, Debug)]
pub struct Case {
    pub pitch_radius: f64,
    pub lead: f64,
    pub ball_radius: f64,
    pub groove_radius: f64,
    pub contact_angle: f64,
    pub friction: f64,
    pub ball_friction: f64,
    pub clearance: f64,
    pub load_per_ball: f64,
    /// Amplitude, rad, and waves in a turn, of screw and nut.
    pub screw: (f64, u8),
    pub nut: (f64, u8),
    /// Turns of the nut a second.
    pub speed: f64,
    pub turns_of_nut: f64,
    pub states: usize,
    pub tick: f64,
}

/// Largest, rms and mean difference over the largest exact value.
#[derive(Clone, Copy, Debug, Default)]
pub struct Off {
    pub largest: f64,
    squares: f64,
    sum: f64,
    count: f64,
    scale: f64,
}

impl Off {
    /// A value against the exact ones of about the same time: balls meet and part in an instant.
    fn add(&mut self, found: f64, about: &[f64]) {
        let least = about.iter().copied().fold(f64::INFINITY, f64::min);
        let most = about.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let off = (found - most).max(0.0) + (found - least).min(0.0);
        let exact = about[about.len() / 2];
        self.largest = self.largest.max(off.abs());
        self.squares += off * off;
        self.sum += off;
        self.count += 1.0;
        self.scale = self.scale.max(exact.abs());
    }
    pub fn relative(&self) -> [f64; 3] {
        [
            self.largest / self.scale,
            (self.squares / self.count).sqrt() / self.scale,
            self.sum / self.count / self.scale,
        ]
    }
}

#[derive(Clone, Debug, Default)]
pub struct Result {
    pub force: Off,
    pub groove: Off,
    pub ball: Off,
    pub speed: Off,
    pub contacts: (usize, usize),
    pub flagged: usize,
    pub failed: usize,
    pub largest_force: f64,
}

fn leak(amplitude: f64, order: u8) -> &'static DeviationMap {
    let wave = Harmonic {
        order,
        cosine: 0.0,
        sine: amplitude as f32,
    };
    Box::leak(Box::new(DeviationMap::from_harmonics(1, &[wave]).unwrap()))
}

pub fn compare<const N: usize>(case: &Case) -> Result {
    let steel = Elastic {
        youngs_modulus: 210e9,
        poisson_ratio: 0.28,
    };
    let design = BallScrewDesign {
        pitch_radius: case.pitch_radius,
        lead: case.lead,
        ball_radius: case.ball_radius,
        screw_groove_radius: case.groove_radius,
        nut_groove_radius: case.groove_radius,
        contact_angle: case.contact_angle,
        ball: steel,
        groove: steel,
    };
    let material = Material {
        youngs_modulus: 210e9,
        poisson_ratio: 0.28,
        ..Material::STEEL
    };
    let own = BallScrew::new(BallScrewParameters {
        pitch_radius: case.pitch_radius as f32,
        lead: case.lead as f32,
        ball_radius: case.ball_radius as f32,
        screw_groove: GrooveSize::Radius(case.groove_radius as f32),
        nut_groove: GrooveSize::Radius(case.groove_radius as f32),
        contact_angle: case.contact_angle as f32,
        ball_material: material,
        groove_material: material,
    })
    .unwrap();
    let path = own.pitch_radius() / own.cos_lead_angle();
    let pitch = f64::from(2.0 * (own.ball_radius() / path).asin());
    // Balls fill 97.8 % of the loaded track.
    let turns = N as f64 * pitch / 0.978 / TAU;
    let load = case.load_per_ball * N as f64 * 0.95;
    let nut_speed = case.speed * TAU;
    let limits = Limits {
        nut_speed: 500.0,
        axial_load: 1e6,
        friction_torque: 1e4,
    };
    let mut model: FrictionModel<UncagedBallScrew<N>> =
        FrictionModel::new(&UncagedBallScrewConfiguration {
            design: own,
            friction: case.friction as f32,
            ball_friction: case.ball_friction as f32,
            rolling_resistance: RollingResistance::NONE,
            clearance: Clearance::new(case.clearance as f32).unwrap(),
            turns: (turns * 0.95) as f32,
            return_length: (0.05 * turns * TAU * f64::from(path)) as f32,
            screw_deviation: leak(case.screw.0, case.screw.1),
            nut_deviation: leak(case.nut.0, case.nut.1),
            load_shares: LoadShares::EVEN,
            reversal_speed: 1e-6,
            tick: case.tick as f32,
            limits,
        })
        .unwrap();
    let samples_of = |amplitude: f64, order: u8| GrooveDeviation::Samples {
        turns: 1.0,
        values: (0..64)
            .map(|i| amplitude * (TAU * f64::from(i) * f64::from(order) / 64.0).sin())
            .collect(),
    };
    let _ = DeviationWave {
        order: 0.0,
        cosine: 0.0,
        sine: 0.0,
    };
    let ring = ElasticRing {
        design,
        clearance: case.clearance,
        friction: case.friction,
        ball_friction: case.ball_friction,
        balls: N,
        turns: turns * 0.95,
        return_length: 0.05 * turns * TAU * f64::from(path),
        screw_deviation: samples_of(case.screw.0, case.screw.1),
        nut_deviation: samples_of(case.nut.0, case.nut.1),
        load_shares: vec![],
        chord: false,
        places: vec![],
        integration: Integration::Coarse,
    };
    let ticks = (case.turns_of_nut / case.speed.abs() / case.tick).round() as usize;
    let per_state = ticks / case.states;
    let samples: Vec<RingSample> = (0..=case.states)
        .map(|i| RingSample {
            time: (i * per_state) as f64 * case.tick,
            nut_speed,
            axial_load: load,
        })
        .collect();
    let states = ring.simulate(&samples, |_, _| ()).unwrap();
    let mut found = Result::default();
    let nominal = 0.5
        * (f64::from(path)
            + case.ball_radius * f64::from(own.cos_lead_angle()) * case.contact_angle.cos());
    let against = f64::from(path) - nominal;
    let mut next = 0;
    for tick in 0..=case.states * per_state {
        let out = model.step(Inputs {
            nut_speed: nut_speed as f32,
            axial_load: load as f32,
        });
        if tick % per_state != 0 {
            continue;
        }
        let state = &states[next];
        next += 1;
        // What settles is flagged; compare from the first state after that.
        if tick < 200 {
            continue;
        }
        if std::env::var("SHOW").is_ok() && next % 10 == 0 {
            println!(
                "tick {tick} groove {:.5} {:.5}",
                out.groove_torque, state.groove_torque
            );
            for (i, ((force, ball), (speed, position))) in model
                .state()
                .circuit
                .train
                .forces()
                .zip(&state.balls)
                .zip(
                    model
                        .state()
                        .circuit
                        .train
                        .speeds()
                        .zip(model.state().circuit.train.positions()),
                )
                .enumerate()
            {
                let place = f64::from(position) / 4294967296.0 * turns * TAU;
                println!(
                    "  {i} place {:.4} {:.4} F {force:.3} {:.3} v {:.5} {:.5}",
                    place,
                    ball.place,
                    ball.force,
                    speed,
                    (ball.speed / nut_speed * f64::from(path) - nominal) / against
                );
            }
        }
        found.flagged += usize::from(out.faults.any());
        let at = next - 1;
        let near = &states[at.saturating_sub(NEAR)..(at + NEAR + 1).min(states.len())];
        if near.iter().any(|state| !state.solved()) {
            found.failed += 1;
            continue;
        }
        for (index, (force, ball)) in model
            .state()
            .circuit
            .train
            .forces()
            .zip(&state.balls)
            .enumerate()
        {
            let about: Vec<f64> = near.iter().map(|state| state.balls[index].force).collect();
            let before = found.force.largest;
            found.force.add(f64::from(force), &about);
            if found.force.largest > before && std::env::var("WORST").is_ok() {
                println!(
                    "   tick {tick} ball {index} place {:.3} F {force:.4} {:.4} of {:.3}",
                    ball.place,
                    ball.force,
                    state.largest_force()
                );
            }
        }
        for (index, speed) in model.state().circuit.train.speeds().enumerate() {
            let about: Vec<f64> = near
                .iter()
                .map(|state| state.balls[index].speed / nut_speed * f64::from(path) - nominal)
                .collect();
            found
                .speed
                .add(f64::from(speed) * against * nut_speed.signum(), &about);
        }
        let about: Vec<f64> = near.iter().map(|state| state.groove_torque).collect();
        found.groove.add(f64::from(out.groove_torque), &about);
        let about: Vec<f64> = near.iter().map(|state| state.ball_torque).collect();
        found.ball.add(f64::from(out.ball_torque), &about);
        found.contacts.0 += usize::from(out.contacts);
        found.contacts.1 += state.pressing();
        found.largest_force = found.largest_force.max(state.largest_force());
    }
    found
}

/// Lin 2019, Table 3.6.
pub const LIN: Case = Case {
    pitch_radius: 16.5e-3,
    lead: 20e-3,
    ball_radius: 2.778e-3,
    groove_radius: 3.254e-3,
    contact_angle: std::f64::consts::FRAC_PI_4,
    friction: 0.1,
    ball_friction: 0.1,
    clearance: 0.0,
    load_per_ball: 50.0,
    screw: (2.3 * TAU / 360.0, 2),
    nut: (0.7 * TAU / 360.0, 3),
    speed: 1.0,
    turns_of_nut: 1.0,
    states: 400,
    tick: 50e-6,
};

/// Pitch radius, lead, ball radius, groove radius, m, and contact angle, degrees: catalogue sizes, and screws of steering gears.
const DESIGNS: [[f64; 5]; 6] = [
    [8e-3, 5e-3, 1.5875e-3, 1.6828e-3, 45.0],
    [13e-3, 10e-3, 1.984375e-3, 2.143125e-3, 48.0],
    [16e-3, 20e-3, 3.175e-3, 3.429e-3, 45.0],
    [31.5e-3, 20e-3, 4.7625e-3, 5.048e-3, 45.0],
    [14.5e-3, 7e-3, 2e-3, 2.16e-3, 45.0],
    [16.5e-3, 20e-3, 2.778e-3, 3.254e-3, 45.0],
];

/// Friction, clearance (um), load of a ball (N), deviations of screw and nut (degrees, waves), turns a second.
const SETTINGS: [[f64; 8]; 8] = [
    [0.10, 0.0, 50.0, 2.3, 2.0, 0.7, 3.0, 1.0],
    [0.10, 0.0, -100.0, 2.0, 2.0, 1.0, 1.0, 5.0],
    [0.07, -2.0, 50.0, 3.0, 1.0, 0.0, 2.0, -5.0],
    [0.15, 3.0, 30.0, 1.5, 3.0, 1.5, 2.0, 5.0],
    [0.05, 0.0, 20.0, 2.5, 2.0, 0.5, 1.0, 2.0],
    [0.10, -5.0, 150.0, 3.0, 2.0, 1.0, 3.0, 5.0],
    [0.12, 1.0, 300.0, 2.0, 2.0, 2.0, 3.0, -5.0],
    [0.10, 5.0, 10.0, 1.0, 4.0, 1.0, 2.0, 5.0],
];

fn case(
    [pitch_radius, lead, ball_radius, groove_radius, angle]: [f64; 5],
    [
        friction,
        clearance,
        load_per_ball,
        screw,
        screw_waves,
        nut,
        nut_waves,
        speed,
    ]: [f64; 8],
) -> Case {
    Case {
        pitch_radius,
        lead,
        ball_radius,
        groove_radius,
        contact_angle: angle.to_radians(),
        friction,
        ball_friction: 0.1,
        clearance: 1e-6 * clearance,
        load_per_ball,
        screw: (screw.to_radians(), screw_waves as u8),
        nut: (nut.to_radians(), nut_waves as u8),
        speed,
        turns_of_nut: 2.0,
        states: 800,
        tick: 50e-6,
    }
}

#[test]
fn scratch() {
    for (d, design) in DESIGNS.iter().enumerate() {
        for (s, setting) in SETTINGS.iter().enumerate() {
            let case = case(*design, *setting);
            let start = std::time::Instant::now();
            let off = compare::<37>(&case);
            println!(
                "{d} {s}: F {:.2e} {:.2e} {:.1e} groove {:.2e} {:.2e} ball {:.2e} {:.2e} speed {:.2e} {:.2e} contacts {:?} flagged {} failed {} Fmax {:.3} {:.1} s",
                off.force.relative()[0],
                off.force.relative()[1],
                off.force.relative()[2],
                off.groove.relative()[0],
                off.groove.relative()[1],
                off.ball.relative()[0],
                off.ball.relative()[1],
                off.speed.relative()[0],
                off.speed.relative()[1],
                off.contacts,
                off.flagged,
                off.failed,
                off.largest_force,
                start.elapsed().as_secs_f64()
            );
        }
    }
}
