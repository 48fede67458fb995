//! The numbers of the figures one by one, in the order of the words in `measured.toml`.

use std::f64::consts::{FRAC_PI_4, TAU};

use super::cold::{self, STEERING};
use super::figure::{Found, Size, Standing, Usual, fixed};
use super::rules;
use super::studies::FIT_LOAD;
use epas_reference::curvature::Groove;
use epas_reference::design::LinearBearingDesign;
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::LubricatedContact;
use epas_reference::material::Elastic;

type Row = fn(&Usual) -> Result<Found, ReferenceError>;

pub(super) const ROWS: [(&str, Row); 21] = [
    ("drag_new", drag_new),
    ("drag_worn", drag_worn),
    ("drag_over_preload", drag_over_preload),
    ("after_reversal", after_reversal),
    ("efficiency_over_load", efficiency_over_load),
    ("friction_over_speed", friction_over_speed),
    ("steering_friction", steering_friction),
    ("drag_fluctuation", drag_fluctuation),
    ("pre_rolling", pre_rolling),
    ("pure_rolling", pure_rolling),
    ("chart", rules::chart),
    ("driving", |usual| rules::efficiency(usual, 1.0)),
    ("back_driving", |usual| rules::efficiency(usual, -1.0)),
    ("drag_of_two_nuts", rules::drag_of_two_nuts),
    ("drag_of_oversize", rules::drag_of_oversize),
    ("drag_range", rules::drag_range),
    ("assumed_friction", assumed_friction),
    ("geometry_without_torque", geometry_without_torque),
    ("rack", rack),
    ("slide", |_| Ok(Found::new(Standing::NotComputed, []))),
    ("cold", in_the_cold),
];

/// Printed drag torques, N m.
const NEW: [f64; 2] = [0.3985, 0.5156];
const WORN: [f64; 2] = [0.2482, 0.3785];
/// Two screws of one batch differ by 29 %: no band is narrower than this.
const BATCH: f64 = 0.15;
const PRELOAD: f64 = 1500.0;
/// The data set prints lead, preload and dynamic load rating (16.4 kN); diameter, balls and grooves are assumed.
pub(super) const PRELOADED: Size = Size {
    name: "32x8, balls of 4.762 mm, 60 of them",
    diameter: 32.0,
    lead: 8.0,
    ball: 4.762,
    conformity: 0.528,
    balls: 60.0,
};

pub(super) fn widened(band: [f64; 2]) -> [f64; 2] {
    [band[0] * (1.0 - BATCH), band[1] * (1.0 + BATCH)]
}

pub(super) fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    values
        .into_iter()
        .fold(none, |[low, high], value| [low.min(value), high.max(value)])
}

/// Drag torque of two nuts braced against each other, with balls that just fit: the nuts' distance preloads them, not the balls' size.
fn double_nut(screw: &LoadedScrew) -> Result<f64, ReferenceError> {
    LoadedScrew {
        clearance: 0.0,
        ..*screw
    }
    .double_nut_torque()
}

pub(super) fn torque(screw: &LoadedScrew) -> Result<f64, ReferenceError> {
    Ok(screw.solve()?.torque())
}

/// Friction coefficients with which a screw has the printed torques of new ones.
fn frictions(
    screw: &LoadedScrew,
    torque: fn(&LoadedScrew) -> Result<f64, ReferenceError>,
) -> String {
    NEW.map(|target| {
        let friction = screw.friction_for(target, torque);
        friction.map_or("none".into(), |friction| fixed(friction, 3))
    })
    .join(" to ")
}

fn drag_new(usual: &Usual) -> Result<Found, ReferenceError> {
    let braced = PRELOADED.under(PRELOAD, usual);
    let oversize = braced.braced_by_oversize()?;
    let (two_nuts, one_nut) = (double_nut(&braced)?, torque(&oversize)?);
    let other = |diameter: f64| {
        let size = Size {
            diameter,
            ..PRELOADED
        };
        frictions(&size.under(PRELOAD, usual), double_nut)
    };
    let standing = Standing::of(range([two_nuts, one_nut]), widened(NEW));
    let computed = [
        fixed(two_nuts, 3),
        fixed(one_nut, 3),
        fixed(-1e6 * oversize.clearance, 1),
        PRELOADED.name.into(),
    ];
    Ok(Found::new(standing, computed).needs([
        frictions(&braced, double_nut),
        other(25.0),
        other(40.0),
        frictions(&oversize, torque),
    ]))
}

/// Power of the preload in the drag torque of two nuts and of one nut with oversize balls, between half the preload and the whole.
fn preload_powers(usual: &Usual) -> Result<[f64; 2], ReferenceError> {
    let [whole, half] = [PRELOAD, 0.5 * PRELOAD].map(|preload| PRELOADED.under(preload, usual));
    let two = double_nut(&whole)? / double_nut(&half)?;
    let one = torque(&whole.braced_by_oversize()?)? / torque(&half.braced_by_oversize()?)?;
    Ok([two.log2(), one.log2()])
}

fn drag_worn(usual: &Usual) -> Result<Found, ReferenceError> {
    let powers = preload_powers(usual)?;
    let shares = [0, 1].map(|screw| {
        let share = WORN[screw] / NEW[screw];
        range(powers.map(|power| 100.0 * share.powf(1.0 / power)))
    });
    let shares = shares.concat().into_iter().map(|share| fixed(share, 0));
    Ok(Found::new(Standing::NotComputed, []).needs(shares))
}

fn drag_over_preload(usual: &Usual) -> Result<Found, ReferenceError> {
    let powers = preload_powers(usual)?.map(|power| fixed(power, 2));
    Ok(Found::new(Standing::InKind, powers))
}

fn after_reversal(usual: &Usual) -> Result<Found, ReferenceError> {
    let steady = STEERING.under(50.0 * STEERING.balls, usual);
    let open = LoadedScrew {
        clearance: 30e-6,
        ..steady
    };
    let share = torque(&open)? / torque(&steady)?;
    Ok(Found::new(Standing::InKind, [fixed(share, 2)]))
}

fn efficiency_over_load(usual: &Usual) -> Result<Found, ReferenceError> {
    let at = |clearance: f64| -> Result<String, ReferenceError> {
        let usual = Usual {
            clearance,
            ..*usual
        };
        let efficiencies: Vec<String> = [5.0, 20.0, 80.0]
            .iter()
            .map(|load| {
                let friction = PRELOADED.under(load * PRELOADED.balls, &usual).solve()?;
                Ok(fixed(friction.efficiency(), 3))
            })
            .collect::<Result<_, ReferenceError>>()?;
        Ok(efficiencies.join(", "))
    };
    let computed = [at(usual.clearance)?, PRELOADED.name.into(), at(0.0)?];
    Ok(Found::new(Standing::InKind, computed))
}

fn friction_over_speed(usual: &Usual) -> Result<Found, ReferenceError> {
    let size = STEERING;
    let contact = LubricatedContact::of(&size.design(), Groove::Screw, 0.1, 2e-8)?;
    let speed = |turns: f64| 0.25e-3 * size.diameter * TAU * turns;
    let normal = 50.0 / FRAC_PI_4.sin();
    let share = |turns: f64| 2.0 * contact.drag(normal, speed(turns)) / 50.0;
    let screw = size.under(50.0 * size.balls, usual).solve()?;
    let coulomb =
        screw.torque() / (screw.ideal * TAU / size.design().lead * 0.25e-3 * size.diameter);
    let computed = [share(1.0), share(20.0), coulomb].map(|share| fixed(share, 4));
    Ok(Found::new(Standing::NotComputed, computed))
}

fn steering_friction(usual: &Usual) -> Result<Found, ReferenceError> {
    let at = |load: f64| torque(&STEERING.under(load, usual));
    let (none, half, full, back) = (at(1.0)?, at(7e3)?, at(14e3)?, at(-14e3)?);
    let [none, half, shown] = [none, half, full].map(|torque| fixed(torque, 2));
    let reversed = format!("{:+.0}", 100.0 * (back / full - 1.0));
    let computed = [none, half, shown, reversed, STEERING.name.into()];
    Ok(Found::new(Standing::InKind, computed))
}

fn drag_fluctuation(usual: &Usual) -> Result<Found, ReferenceError> {
    let screw = PRELOADED.under(PRELOAD, usual).braced_by_oversize()?;
    let at = |factor: f64| {
        torque(&LoadedScrew {
            clearance: factor * screw.clearance,
            ..screw
        })
    };
    // Change of the torque with the oversize, of both relative to themselves.
    let power = (at(1.1)? / at(0.9)?).ln() / (1.1_f64 / 0.9).ln();
    let oversize = 1e6 * screw.clearance.abs();
    let swing = oversize * 0.5 / power;
    let computed = [power, swing, oversize].map(|value| fixed(value, 1));
    Ok(Found::new(Standing::InKind, computed).needs([fixed(swing, 1)]))
}

fn pre_rolling(_: &Usual) -> Result<Found, ReferenceError> {
    let ball = 0.5 * 6.35e-3;
    let guide = LinearBearingDesign {
        ball_radius: ball,
        groove_radius: 1.04 * ball,
        ball: Elastic::STEEL,
        groove: Elastic::STEEL,
    };
    let length = 2e6 * guide.contact()?.at(FIT_LOAD).semi_minor;
    Ok(Found::new(Standing::InKind, [fixed(length, 0)]))
}

#[expect(clippy::unnecessary_wraps, reason = "one type for every row")]
fn pure_rolling(usual: &Usual) -> Result<Found, ReferenceError> {
    let ball: f64 = 5e-3;
    let modulus = Elastic::STEEL.contact_modulus(&Elastic::STEEL);
    // Two contacts, and the upper plate goes twice as far as the ball.
    let coefficient = |load: f64| {
        let semi_axis = (0.75 * load * ball / modulus).cbrt();
        usual.rolling.hysteresis_force(load, semi_axis, ball) / load
    };
    let (light, heavy) = (coefficient(1.0), coefficient(100.0));
    let loss = usual.rolling.hysteresis_loss;
    let computed = [
        format!("{light:.1e}"),
        format!("{heavy:.1e}"),
        (loss as f32).to_string(),
    ];
    let needed = [light, heavy].map(|share| fixed(loss * 1e-5 / share, 4));
    Ok(Found::new(Standing::InKind, computed).needs(needed))
}

#[expect(clippy::unnecessary_wraps, reason = "one type for every row")]
fn assumed_friction(usual: &Usual) -> Result<Found, ReferenceError> {
    let standing = Standing::of([usual.friction; 2], [0.02, 0.2]);
    Ok(Found::new(standing, [(usual.friction as f32).to_string()]))
}

fn geometry_without_torque(usual: &Usual) -> Result<Found, ReferenceError> {
    let size = Size {
        name: "",
        diameter: 41.75,
        lead: 10.0,
        ball: 6.35,
        conformity: 3.429 / 6.35,
        balls: 4.0 * 17.0,
    };
    let design = size.design();
    // Screw and nut approach each other by the axial offset, along the normal.
    let sine = design.contact_angle.sin() * design.lead_angle().cos();
    let compliance =
        design.contact(Groove::Screw)?.deflection + design.contact(Groove::Nut)?.deflection;
    let normal = (0.011e-3 * sine / compliance).powf(1.5);
    let preload = size.balls * normal * sine;
    let drag = double_nut(&size.under(preload, usual))?;
    let computed = [fixed(drag, 2), fixed(preload, 0)];
    Ok(Found::new(Standing::NotComputed, computed))
}

fn rack(usual: &Usual) -> Result<Found, ReferenceError> {
    let at = |load: f64| {
        let screw = STEERING.under(load, usual);
        Ok::<f64, ReferenceError>(torque(&screw)? * TAU / screw.design.lead)
    };
    let (idle, driving) = (at(1.0)?, at(1500.0)?);
    let computed = [fixed(idle, 0), fixed(driving, 0), STEERING.name.into()];
    Ok(Found::new(Standing::of([idle; 2], [0.0, 400.0]), computed))
}

fn in_the_cold(usual: &Usual) -> Result<Found, ReferenceError> {
    let growth = |state: (f64, f64)| cold::growth(usual, &cold::GREASE, state);
    let at = |speed: f64| {
        let [idle, loaded] = cold::LOADS;
        Ok::<_, ReferenceError>(range([growth((speed, idle))?, growth((speed, loaded))?]))
    };
    let [slow, centre, fast] = cold::SPEEDS;
    let steering = at(centre)?;
    let ranges = [steering, at(fast)?, at(slow)?].concat();
    let mut computed: Vec<String> = ranges.into_iter().map(|growth| fixed(growth, 1)).collect();
    computed.push(fixed(growth(cold::LEAST)?, 2));
    computed.push(STEERING.name.into());
    let standing = Standing::of(steering, widened([2.0, 3.0]));
    Ok(Found::new(standing, computed))
}
