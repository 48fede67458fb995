//! The figures one by one.

use std::f64::consts::TAU;

use super::cold::{self as over_temperature, STEERING};
use super::figure::{Measured, Size, Source, Standing, Usual};
use super::rules;
use super::studies::FIT_LOAD;
use epas_reference::curvature::Groove;
use epas_reference::design::LinearBearingDesign;
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::LubricatedContact;
use epas_reference::material::Elastic;

type Row = fn(&Usual) -> Result<Measured, ReferenceError>;

/// Every figure.
pub(super) const ROWS: [Row; 21] = [
    drag_new,
    drag_worn,
    drag_over_preload,
    after_reversal,
    efficiency_over_load,
    friction_over_speed,
    steering_friction,
    drag_fluctuation,
    pre_rolling,
    pure_rolling,
    rules::chart,
    rules::driving,
    rules::back_driving,
    rules::drag_of_two_nuts,
    rules::drag_of_oversize,
    rules::drag_range,
    assumed_friction,
    geometry_without_torque,
    rack,
    slide,
    cold,
];

const DATA_SET: Source = Source::Seen("XJTU degradation data set of ball screws");
/// Printed drag torques, N m.
const NEW: [f64; 2] = [0.3985, 0.5156];
const WORN: [f64; 2] = [0.2482, 0.3785];
/// Two screws of one batch differ by 29 %: no band is narrower than this.
const BATCH: f64 = 0.15;
/// Printed preload, N.
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
    values
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
}

/// A coefficient that was sought.
pub(super) fn found(value: Option<f64>) -> String {
    value.map_or("none".into(), |value| format!("{value:.3}"))
}

/// Drag torque of two nuts braced against each other, with balls that just fit: the nuts' distance preloads them, not
/// the balls' size.
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

fn drag_new(usual: &Usual) -> Result<Measured, ReferenceError> {
    let braced = PRELOADED.under(PRELOAD, usual);
    let oversize = braced.braced_by_oversize()?;
    let (two_nuts, one_nut) = (double_nut(&braced)?, torque(&oversize)?);
    let other = |diameter: f64| {
        let size = Size {
            diameter,
            ..PRELOADED
        };
        let screw = size.under(PRELOAD, usual);
        NEW.map(|target| found(screw.friction_for(target, double_nut)))
            .join(" to ")
    };
    Ok(Measured {
        what: "drag torque of two new preloaded screws, after disassembly (N m)",
        figure: "0.3985 and 0.5156; lead 8 mm, preload 1500 N",
        source: DATA_SET,
        computed: format!(
            "{two_nuts:.3} with two nuts, {one_nut:.3} with oversize balls of {:.1} um; assumed: {}",
            -1e6 * oversize.clearance,
            PRELOADED.name
        ),
        standing: Standing::of(range([two_nuts, one_nut]), widened(NEW)),
        needed: format!(
            "friction {} with two nuts (with a diameter of 25 mm {}, of 40 mm {}), {} with oversize balls",
            NEW.map(|target| found(braced.friction_for(target, double_nut)))
                .join(" to "),
            other(25.0),
            other(40.0),
            NEW.map(|target| found(oversize.friction_for(target, torque)))
                .join(" to "),
        ),
    })
}

/// Power of the preload in the drag torque of two nuts and of one nut with oversize balls, between half the preload and
/// the whole.
fn preload_powers(usual: &Usual) -> Result<[f64; 2], ReferenceError> {
    let at = |preload: f64| PRELOADED.under(preload, usual);
    let two = double_nut(&at(PRELOAD))? / double_nut(&at(0.5 * PRELOAD))?;
    let one = torque(&at(PRELOAD).braced_by_oversize()?)?
        / torque(&at(0.5 * PRELOAD).braced_by_oversize()?)?;
    Ok([two.log2(), one.log2()])
}

fn drag_worn(usual: &Usual) -> Result<Measured, ReferenceError> {
    let powers = preload_powers(usual)?;
    let shares = [0, 1].map(|screw| {
        let share = WORN[screw] / NEW[screw];
        range(powers.map(|power| 100.0 * share.powf(1.0 / power)))
    });
    Ok(Measured {
        what: "the same worn, after some 1000 h (N m)",
        figure: "0.2482 and 0.3785: 62 and 73 % of new",
        source: DATA_SET,
        computed: "wear is not computed".into(),
        standing: Standing::NotComputed,
        needed: format!(
            "with the friction coefficient as new, a preload of {:.0} to {:.0} and of {:.0} to {:.0} % of new",
            shares[0][0], shares[0][1], shares[1][0], shares[1][1]
        ),
    })
}

fn drag_over_preload(usual: &Usual) -> Result<Measured, ReferenceError> {
    let [two, one] = preload_powers(usual)?;
    Ok(Measured {
        what: "drag torque over preload and speed, ground screw 40x10",
        figure: "about proportional to preload; falls with speed, then rises",
        source: Source::Seen("Heidenhain's paper on feed drives"),
        computed: format!(
            "preload to the power {two:.2} with two nuts, {one:.2} with oversize balls; no change with speed"
        ),
        standing: Standing::InKind,
        needed: "a friction coefficient that falls with speed, and lubricant drag that rises with its power 0.66"
            .into(),
    })
}

fn after_reversal(usual: &Usual) -> Result<Measured, ReferenceError> {
    let steady = STEERING.under(50.0 * STEERING.balls, usual);
    let open = LoadedScrew {
        clearance: 30e-6,
        ..steady
    };
    Ok(Measured {
        what: "torque just after a reversal, double nut",
        figure: "lower than steady",
        source: Source::Seen("Ninomiya, Kakino, abstract"),
        computed: format!(
            "{:.2} of steady while a ball that changes its third contact has none, 50 N a ball",
            torque(&open)? / torque(&steady)?
        ),
        standing: Standing::InKind,
        needed: "a bound, not a course: the march of the whole screw through a reversal gives that"
            .into(),
    })
}

fn efficiency_over_load(usual: &Usual) -> Result<Measured, ReferenceError> {
    let at = |clearance: f64| -> Result<Vec<String>, ReferenceError> {
        [5.0, 20.0, 80.0]
            .iter()
            .map(|load| {
                let usual = Usual {
                    clearance,
                    ..*usual
                };
                let friction = PRELOADED.under(load * PRELOADED.balls, &usual).solve()?;
                Ok(format!("{:.3}", friction.efficiency()))
            })
            .collect()
    };
    Ok(Measured {
        what: "efficiency over load at 1000 rev/min",
        figure: "rises with load",
        source: Source::Seen("Zhou et al. 2018, abstract"),
        computed: format!(
            "{} at 5, 20, 80 N a ball ({}); without oversize {}",
            at(usual.clearance)?.join(", "),
            PRELOADED.name,
            at(0.0)?.join(", ")
        ),
        standing: Standing::InKind,
        needed:
            "oversize, or a drag that does not depend on load (lubricant, seals); slip and spin alone let efficiency fall with load"
                .into(),
    })
}

fn friction_over_speed(usual: &Usual) -> Result<Measured, ReferenceError> {
    let size = STEERING;
    let contact = LubricatedContact::of(&size.design(), Groove::Screw, 0.1, 2e-8)?;
    let speed = |turns: f64| 0.25e-3 * size.diameter * TAU * turns;
    let normal = 50.0 / usual_sine();
    let share = |turns: f64| 2.0 * contact.drag(normal, speed(turns)) / 50.0;
    let screw = size.under(50.0 * size.balls, usual).solve()?;
    let coulomb =
        screw.torque() / (screw.ideal * TAU / size.design().lead * 0.25e-3 * size.diameter);
    Ok(Measured {
        what: "friction coefficient over speed, double nut",
        figure: "mixed, then elastohydrodynamic, one minimum; speed matters more than preload",
        source: Source::Seen("Zhang, Zhou, Feng 2021, abstract"),
        computed: format!(
            "only the rising part: lubricant drag {:.4} of the load at 1 turn a second, {:.4} at 20 (0.1 Pa s), beside {coulomb:.4} \
             of slip and spin, which do not change with speed",
            share(1.0),
            share(20.0)
        ),
        standing: Standing::NotComputed,
        needed: "a friction coefficient that falls with speed from mixed to full lubrication"
            .into(),
    })
}

/// Sine of the contact angle of every size.
fn usual_sine() -> f64 {
    std::f64::consts::FRAC_PI_4.sin()
}

fn steering_friction(usual: &Usual) -> Result<Measured, ReferenceError> {
    let at = |load: f64| torque(&STEERING.under(load, usual));
    let (none, half, full, back) = (at(1.0)?, at(7e3)?, at(14e3)?, at(-14e3)?);
    Ok(Measured {
        what: "steering friction of an electric power steering",
        figure: "strongly load-dependent, differs by direction of speed, no Stribeck dip, differs from unit to unit",
        source: Source::Seen("Weiskircher et al. 2015, abstract"),
        computed: format!(
            "{none:.2}, {half:.2}, {full:.2} N m at 0, 7, 14 kN; at 14 kN {:+.0} % with the load reversed; no dip, by assumption \
             (assumed: {})",
            100.0 * (back / full - 1.0),
            STEERING.name
        ),
        standing: Standing::InKind,
        needed: "nothing".into(),
    })
}

fn drag_fluctuation(usual: &Usual) -> Result<Measured, ReferenceError> {
    let screw = PRELOADED.under(PRELOAD, usual).braced_by_oversize()?;
    let at = |factor: f64| {
        torque(&LoadedScrew {
            clearance: factor * screw.clearance,
            ..screw
        })
    };
    // Change of the torque with the oversize, of both relative to themselves.
    let power = (at(1.1)? / at(0.9)?).ln() / (1.1_f64 / 0.9).ln();
    let swing = 1e6 * screw.clearance.abs() * 0.5 / power;
    Ok(Measured {
        what: "fluctuation of drag torque that a standard allows",
        figure: "up to 50 % of the preload torque",
        source: Source::Seen("ISO 3408-3 as cited"),
        computed: format!(
            "torque goes with the oversize to the power {power:.1}: {swing:.1} um of {:.1} um are 50 %",
            -1e6 * screw.clearance
        ),
        standing: Standing::InKind,
        needed: format!("grooves that vary by {swing:.1} um along the screw, as ground ones do"),
    })
}

fn pre_rolling(_: &Usual) -> Result<Measured, ReferenceError> {
    let ball = 0.5 * 6.35e-3;
    let guide = LinearBearingDesign {
        ball_radius: ball,
        groove_radius: 1.04 * ball,
        ball: Elastic::STEEL,
        groove: Elastic::STEEL,
    };
    let length = 2e6 * guide.contact()?.at(FIT_LOAD).semi_minor;
    Ok(Measured {
        what: "pre-rolling of a linear guide's balls",
        figure: "linear spring below 100 nm, normal rolling beyond 100 um",
        source: Source::Seen("Futami, Furutani, abstract"),
        computed: format!(
            "contact {length:.0} um long under 100 N (assumed: ball of 6.35 mm, conformity 0.52): rolling is normal once a ball has left \
             its old contact"
        ),
        standing: Standing::InKind,
        needed: "a law of pre-rolling for the spring below 100 nm".into(),
    })
}

#[expect(clippy::unnecessary_wraps, reason = "one type for every row")]
fn pure_rolling(usual: &Usual) -> Result<Measured, ReferenceError> {
    let ball: f64 = 5e-3;
    let modulus = Elastic::STEEL.contact_modulus(&Elastic::STEEL);
    // Two contacts, and the upper plate goes twice as far as the ball.
    let coefficient = |load: f64| {
        let semi_axis = (0.75 * load * ball / modulus).cbrt();
        usual.rolling.hysteresis_force(load, semi_axis, ball) / load
    };
    let (light, heavy) = (coefficient(1.0), coefficient(100.0));
    let loss = usual.rolling.hysteresis_loss;
    Ok(Measured {
        what: "rolling coefficient of a ball between plates",
        figure: "order of 1e-5",
        source: Source::Seen("abstract"),
        computed: format!(
            "{light:.1e} under 1 N to {heavy:.1e} under 100 N (assumed: ball of 10 mm, hysteresis loss {})",
            loss as f32
        ),
        standing: Standing::InKind,
        needed: format!(
            "load and ball are missing; for 1e-5 a hysteresis loss of {:.4} under 1 N, {:.4} under 100 N",
            loss * 1e-5 / light,
            loss * 1e-5 / heavy
        ),
    })
}

#[expect(clippy::unnecessary_wraps, reason = "one type for every row")]
fn assumed_friction(usual: &Usual) -> Result<Measured, ReferenceError> {
    Ok(Measured {
        what: "friction coefficients that models assume",
        figure: "0.02 to 0.2 (Olaru), 0.03 (Xu)",
        source: Source::Seen("introduction of Zhou et al. 2018"),
        computed: format!("{} taken here", usual.friction as f32),
        standing: Standing::of([usual.friction; 2], [0.02, 0.2]),
        needed: "0.06 to 0.14, as the rows above say; 0.02 and 0.03 would need drag of lubricant and seals in place of spin".into(),
    })
}

fn geometry_without_torque(usual: &Usual) -> Result<Measured, ReferenceError> {
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
    let computed = double_nut(&size.under(preload, usual))?;
    Ok(Measured {
        what: "a complete geometry without torque",
        figure: "pitch circle 41.75, lead 10, ball 6.35 mm, 8 circuits of 17 balls, preload +-0.011 mm",
        source: Source::Seen("input of a public solver"),
        computed: format!(
            "{computed:.2} N m of drag, preload {preload:.0} N (assumed: half the balls on either flank)"
        ),
        standing: Standing::NotComputed,
        needed: "no figure to compare with".into(),
    })
}

fn rack(usual: &Usual) -> Result<Measured, ReferenceError> {
    let at = |load: f64| {
        let screw = STEERING.under(load, usual);
        Ok::<f64, ReferenceError>(torque(&screw)? * TAU / screw.design.lead)
    };
    let (idle, driving) = (at(1.0)?, at(1500.0)?);
    Ok(Measured {
        what: "friction of a steering rack (N at the rack)",
        figure: "150 to 400, of all parts; rack 22 to 32 mm, lead 5 to 10 mm, ball 4 to 6 mm",
        source: Source::Recalled("several; the balls seen"),
        computed: format!(
            "{idle:.0} without load, {driving:.0} under 1500 N, of the grooves alone (assumed: {})",
            STEERING.name
        ),
        standing: Standing::of([idle; 2], [0.0, 400.0]),
        needed: "the screw's share of the whole; with clearance 0 it is next to none without load"
            .into(),
    })
}

#[expect(clippy::unnecessary_wraps, reason = "one type for every row")]
fn slide(_: &Usual) -> Result<Measured, ReferenceError> {
    Ok(Measured {
        what: "a slide on a ball screw",
        figure: "20.4 N + 203 N s/m, concave over speed, differs by direction (-36 N s/m), breakaway 1 to 7 um",
        source: Source::Seen("measured trace"),
        computed: String::new(),
        standing: Standing::NotComputed,
        needed: "missing: geometry and preload of the screw, friction of guide and seals; laws of speed and of pre-rolling".into(),
    })
}

fn cold(usual: &Usual) -> Result<Measured, ReferenceError> {
    let growth =
        |state: (f64, f64)| over_temperature::growth(usual, &over_temperature::GREASE, state);
    let mut growths = Vec::new();
    for speed in over_temperature::SPEEDS {
        for load in over_temperature::LOADS {
            growths.push(growth((speed, load))?);
        }
    }
    let least = growth(over_temperature::LEAST)?;
    let [slow_idle, slow, centre_idle, centre, fast_idle, fast] = growths[..] else {
        return Err(ReferenceError::input("speed", "three speeds and two loads"));
    };
    let steering = range([centre_idle, centre]);
    Ok(Measured {
        what: "friction of a steering gear at -40 degrees Celsius over that at 20",
        figure: "2 to 3, of the whole gear with greases made for it",
        source: Source::Recalled("makers of greases and steering gears"),
        computed: format!(
            "{:.1} to {:.1} at 5 rad/s of the nut, {:.1} to {:.1} at 20, {:.1} to {:.1} at 1 (without load to 5 kN), {least:.2} at 0.7 under 14 kN; above 5 rad/s these are upper bounds (assumed: {}, grease with a base oil of 48 mm2/s at 40 degrees)",
            steering[0],
            steering[1],
            range([fast_idle, fast])[0],
            range([fast_idle, fast])[1],
            range([slow_idle, slow])[0],
            range([slow_idle, slow])[1],
            STEERING.name
        ),
        standing: Standing::of(steering, widened([2.0, 3.0])),
        needed: "seals, yoke and the grease's yield stress are in the figure and not in the model; viscosity of the base oil and speed decide".into(),
    })
}
