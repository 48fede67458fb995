//! What a full report finds.

use std::f64::consts::FRAC_PI_4;

use epas_friction::law::memory::{BackboneElement, Part, ProportionalElements, SLIP_8, SPIN_8};
use epas_friction::law::{Elements as _, SlidingLimits};
use epas_friction::{
    DeviationMap, FrictionModel, GrooveSize, LinearBearing, LinearBearingConfiguration,
    LinearBearingParameters, LinearBearingTrain, LinearInputs, LinearLimits, LoadShare, Material,
};
use epas_reference::friction::linear_ball::{LinearBall, contact_forces};
use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::{Form, Path, answers};
use epas_reference::presliding::tables::Table;
use rand::RngExt as _;
use rand_pcg::Pcg64;

use super::{Accuracy, caged};
use crate::exact_ring::Off;
use crate::report::stability::recorded_errors;
use crate::report::statistics::Errors;
use crate::report::uncaged::Flagship;
use crate::report::{curvature, efficiency, hertz, trains};
use crate::study::{self, turned_ball};
use epas_page::failure::Failure;

/// Balls of the linear bearing, and their groove's conformity: Lin 2019, Table 3.3.
const BALLS: usize = 24;
const CONFORMITY: f32 = 0.56;

pub fn measured(flagship: &Flagship, quick: bool) -> Result<Vec<Accuracy>, Failure> {
    const CURVATURES: &str =
        "curvature, relative: 31 catalogue sizes, both grooves, contact angles 0 to 70 degrees";
    const EFFICIENCIES: &str =
        "efficiency, absolute: friction to 0.3, lead to 60, contact 10 to 80 degrees";
    let [literature, circular, fitted, exact] = curvature::catalogue_errors(quick)?;
    let [rolling, sliding, _] = efficiency::form_errors(quick)?;
    let mut found = vec![
        Accuracy::of("curvature_literature", CURVATURES, &literature),
        Accuracy::of("curvature_circular_groove", CURVATURES, &circular),
        Accuracy::of("curvature_fitted", CURVATURES, &fitted),
        Accuracy::of("curvature_exact", CURVATURES, &exact),
        Accuracy::of(
            "contact_ellipse",
            "ratio, axes, deflection and pressure, relative: ratios of relative radii 1 to 1e5",
            &hertz::largest_error(quick)?,
        ),
        Accuracy::of("efficiency_rolling", EFFICIENCIES, &rolling),
        Accuracy::of("efficiency_sliding", EFFICIENCIES, &sliding),
        caged::step(quick)?,
        Accuracy::of(
            "memory",
            "friction below breakaway over the limit, eight elements against the same in float64: random turns",
            &memory(if quick { 5_000 } else { 50_000 })?[0],
        ),
    ];
    found.extend(pressing(flagship));
    found.push(Accuracy::of(
        "linear_ball",
        "speed deviation of the published formula, of v/2: side-force ratio to 0.8, deviations to 3 degrees",
        &trains::closed_form_errors(0.8)?,
    ));
    found.push(linear_step()?);
    found.extend(recorded_errors()?);
    Ok(found)
}

fn pressing(flagship: &Flagship) -> [Accuracy; 2] {
    let found = &flagship.comparison;
    let (turns, pairs) = (flagship.turns, found.pressing());
    let of = |name: &str, error: &str, off: &Off| {
        let [largest, rms, _] = off.relative();
        Accuracy {
            name: name.into(),
            error: format!(
                "{error}: {turns} turns against the exact whole screw, filled but for a tenth of a ball ({pairs:.0} of 37 pairs press), 50 N a ball, deviations of 1 and 0.5 degrees, friction 0.1, between balls too"
            ),
            largest,
            rms,
            flagged: found.flagged as f64 / found.compared as f64,
            states: found.compared as u64,
        }
    };
    [
        of("uncaged_torque", "friction torque, relative", &found.torque),
        of(
            "uncaged_forces",
            "forces between balls, of the largest",
            &found.force,
        ),
    ]
}

/// Errors of eight elements over random turns: against the same ones in double precision, and against the hysteresis that they stand for.
pub fn memory(ticks: usize) -> Result<[Errors; 2], Failure> {
    let mut errors = [Errors::default(); 2];
    for (name, elements) in [("slip8", &SLIP_8.elements), ("spin8", &SPIN_8.elements)] {
        follow(name, elements, ticks, &mut errors)?;
    }
    Ok(errors)
}

fn follow(
    name: &str,
    backbone: &[BackboneElement],
    ticks: usize,
    errors: &mut [Errors; 2],
) -> Result<(), Failure> {
    const STREAM: u128 = 8;
    let table = Table::named(name)
        .ok_or_else(|| Failure::Data(format!("the reference has no table {name}")))?;
    let part = Part {
        backbone,
        share: 1.0,
        breakaway_angle: 1.0,
    };
    let elements = ProportionalElements::<8>::new(1.0, &[part])?;
    let mut random = Pcg64::new(1, STREAM);
    let mut angle = vec![0.0_f64];
    for _ in 0..ticks {
        let size = 10_f64.powf(random.random_range(-6.0..=1.0));
        let place: f64 = angle.last().copied().unwrap_or(0.0);
        // Towards the start, so that the difference of two places is the turn.
        let turn = if random.random_bool(0.5 + 0.4 * place.signum()) {
            -size
        } else {
            size
        };
        angle.push(place + f64::from(turn as f32));
    }
    let path = Path {
        angle: &angle,
        load: None,
        ratio: Limits {
            forward: 1.0,
            backward: 1.0,
        },
    };
    let answers = answers(&path, &Form::Proportional(table));
    let same = answers.torque.iter();
    let exact = answers.exact.iter().flatten();
    let limits = SlidingLimits {
        forward: 1.0,
        backward: 1.0,
        load: 1.0,
    };
    let mut state = ProportionalElements::<8>::VIRGIN;
    for (tick, (same, exact)) in path.ticks().zip(same.zip(exact).skip(1)) {
        let friction = f64::from(elements.follow(&mut state, tick.turn as f32, &limits));
        errors[0].add(friction - same);
        errors[1].add(friction - exact);
    }
    Ok(())
}

fn linear_step() -> Result<Accuracy, Failure> {
    let configuration = LinearBearingConfiguration {
        bearing: LinearBearing::new(LinearBearingParameters {
            ball_radius: study::linear_ball().ball_radius,
            groove: GrooveSize::Conformity(CONFORMITY),
            contact_angle: FRAC_PI_4 as f32,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })?,
        friction: study::FRICTION as f32,
        ball_friction: study::FRICTION as f32,
        balls: BALLS as u16,
        loaded_length: 0.26,
        return_length: 0.0,
        wavelength: 0.1,
        rail_deviation: &DeviationMap::NONE,
        carriage_deviation: &DeviationMap::NONE,
        load_shares: &[LoadShare::MEAN],
        reversal_speed: 1e-3,
        tick: 1e-3,
        limits: LinearLimits {
            speed: 2.0,
            load: 1e5,
            friction_force: 1e3,
        },
    };
    let mut model = FrictionModel::<LinearBearingTrain<BALLS>>::new(&configuration)?;
    let (mut errors, mut flagged) = (Errors::default(), 0);
    for load in [1.0, 10.0, 100.0, 300.0] {
        for side in [-0.5, -0.3, -0.1, 0.0, 0.2, 0.4, 0.5] {
            let ball = LinearBall {
                contact_forces: contact_forces([FRAC_PI_4; 4], load * side, load),
                ..turned_ball(0.0, 0.0)
            };
            let exact = BALLS as f64 * ball.solve(1.0)?.power_loss;
            for speed in [-1.0, 1.0] {
                let found = model.step(LinearInputs {
                    speed: speed as f32,
                    normal_load: (BALLS as f64 * load) as f32,
                    side_load: (BALLS as f64 * load * side) as f32,
                });
                errors.add(speed * f64::from(found.groove_force) / exact - 1.0);
                flagged += usize::from(found.faults.any());
            }
        }
    }
    Ok(Accuracy {
        flagged: flagged as f64 / errors.count(),
        ..Accuracy::of(
            "linear_step",
            "friction of the grooves, relative: 24 balls, side loads to 0.5 of the normal load, 1 to 300 N a ball, straight grooves",
            &errors,
        )
    })
}
