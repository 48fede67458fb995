//! Given balls as the scene of a ball screw without cage has them once they have settled ([`epas_rows::settled`]): in elastic
//! grooves without play, under the axial loads and the deviations that the contacts tell.
//!
//! Contact angles are those of balls that give way: where the arcs of the grooves stand follows from angles and deflections. The
//! centre of an arc is `R - r_b + deflection` away from that of the ball. The two contacts of one groove tell the nominal contact
//! angle, how far the groove is turned, and the ball's way in radial direction; with this the single contact of the other groove
//! tells how far that one is turned.

use epas_friction::ball::GrooveFit;
use epas_friction::ball::elastic::{BallInputs, ElasticGrooves, Renewal};
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{BallScrew, Error};
use epas_rows::LARGEST_TRAIN;
use epas_rows::settled::{SettledRow, settled};
use serde::Serialize;

use super::contacts::{Given, LARGEST_LOAD_MISMATCH, NL, NR, Row, SL, SR, Ways};

/// What the scene computes.
#[derive(Serialize)]
pub struct ElasticRow {
    /// Free.
    orbital_speed: Vec<f64>,
    /// None where a ball loses its grooves under the others' forces, or runs further from nominal rolling than the scene takes.
    contact_force: Option<Vec<f64>>,
    /// Power lost in the grooves, W, pressing; none as the forces.
    groove_power_loss: Option<f64>,
    /// How far the given loads are from those that the scene finds, free, over the largest of a ball.
    load_mismatch: f64,
}

/// What the scene computes for balls of a screw; none for two contacts, of which play takes an amount that they do not tell,
/// where a ball loses its grooves, and where loads are further from the scene's than its own errors.
pub fn row(
    given: &Row,
    design: impl Fn(f32) -> Result<BallScrew, Error>,
    Ways {
        friction,
        nut_speed,
    }: Ways,
) -> Option<ElasticRow> {
    if given.fit != GrooveFit::Zero {
        return None;
    }
    let arcs = Arcs::new(&design(given.nominal).ok()?);
    let places = given
        .balls
        .iter()
        .map(|ball| arcs.place(ball))
        .collect::<Option<Vec<_>>>()?;
    let nominal = places.iter().map(|place| place.nominal).sum::<f64>() / places.len() as f64;
    let design = design(nominal as f32).ok()?;
    let grooves = ElasticGrooves::new(&design).ok()?;
    // In the frame in which the nut turns forward.
    let backward = nut_speed < 0.0;
    let way = if backward { -1.0 } else { 1.0 };
    let inputs = given.balls.iter().zip(&places).map(|(ball, place)| {
        let [screw, nut] = place.deviations(nominal);
        BallInputs {
            axial_load: way * axial_load(&design, ball),
            force: 0.0,
            rubbing: [0.0; 2],
            screw_deviation: way * screw,
            nut_deviation: way * nut,
            friction,
            clearance: 0.0,
        }
    });
    // The request has one coefficient: balls rub on each other as they do in the grooves.
    let found = settled::<LARGEST_TRAIN>(&design, &grooves, inputs, friction)?;
    let load_mismatch = mismatch(given, &found, backward);
    // False for NaN too.
    (load_mismatch <= f64::from(LARGEST_LOAD_MISMATCH))
        .then(|| answer(&found, &design, nut_speed, load_mismatch))
}

/// Distances of arc centres, m.
struct Arcs {
    /// From an unloaded ball: `R - r_b`.
    offset: f64,
    /// Deflection over the power 2/3 of the load, of the screw's contacts and of the nut's.
    compliance: [f64; 2],
}

/// Where a ball and the arcs of its grooves stand.
struct Place {
    /// Contact angle without load and deviation, rad.
    nominal: f64,
    /// Whether the nut has both of its contacts, and how far the groove with both is turned.
    on_nut: bool,
    turned: f64,
    /// Angle of the other groove's arc with its side: -1 left, 1 right.
    single: (f64, f64),
}

impl Arcs {
    fn new(design: &BallScrew) -> Self {
        let compliance = [Groove::Screw, Groove::Nut]
            .map(|groove| f64::from(HertzContact::of(design, groove).deflection_coefficient()));
        Self {
            // Both grooves are alike.
            offset: design.clearance(Groove::Screw).into(),
            compliance,
        }
    }

    /// None where a ball has not three contacts, or its arcs are nowhere.
    fn place(&self, ball: &Given) -> Option<Place> {
        // Radial and axial distance of an arc's centre from the ball's.
        let arc = |place: usize| {
            ball[place].map(|(load, angle)| {
                let (load, (sin, cos)) = (f64::from(load), f64::from(angle).sin_cos());
                let compliance = self.compliance[usize::from(place >= NL)];
                let distance = self.offset + compliance * load.cbrt().powi(2);
                (distance * cos, distance * sin)
            })
        };
        let (on_nut, [left, right], single) = match [SL, SR, NL, NR].map(arc) {
            [Some(left), Some(right), Some(single), None] => (false, [left, right], (single, -1.0)),
            [Some(left), Some(right), None, Some(single)] => (false, [left, right], (single, 1.0)),
            [Some(single), None, Some(left), Some(right)] => (true, [left, right], (single, -1.0)),
            [None, Some(single), Some(left), Some(right)] => (true, [left, right], (single, 1.0)),
            _ => return None,
        };
        let (radial, axial) = (left.0 - right.0, left.1 + right.1);
        let turned = radial.atan2(axial);
        let nominal = (radial.hypot(axial) / (2.0 * self.offset)).asin();
        // What the ball has moved towards this groove, both on one line with the other groove.
        let moved = left.0 - self.offset * (nominal - turned).cos();
        let ((radial, _), side) = single;
        let single = ((radial + moved) / self.offset).acos();
        (nominal.is_finite() && single.is_finite()).then_some(Place {
            nominal,
            on_nut,
            turned,
            single: (single, side),
        })
    }
}

impl Place {
    /// How far the screw's and the nut's groove are turned, rad, with the nominal contact angle of all balls.
    fn deviations(&self, nominal: f64) -> [f32; 2] {
        let (angle, side) = self.single;
        let (both, single) = (self.turned as f32, (side * (angle - nominal)) as f32);
        if self.on_nut {
            [single, both]
        } else {
            [both, single]
        }
    }
}

/// Axial load of the screw on a ball, N: the mean of what the contacts of both grooves carry. Friction across the track adds to one
/// and takes from the other.
fn axial_load(design: &BallScrew, ball: &Given) -> f32 {
    let across = |place: usize| ball[place].map_or(0.0, |(load, angle)| load * angle.sin());
    let (screw, nut) = (across(SL) - across(SR), across(NR) - across(NL));
    design.cos_lead_angle() * (0.5 * (screw + nut))
}

/// Largest difference of loads, given and found, over the ball's largest one.
fn mismatch(given: &Row, found: &SettledRow, backward: bool) -> f64 {
    let mut worst = 0.0_f64;
    for (ball, found) in given.balls.iter().zip(&found.alone) {
        let [a, b, c, d] = found.loads.map(f64::from);
        // Left and right of the screw are changed where the nut turns backward.
        let loads = if backward { [b, a, d, c] } else { [a, b, c, d] };
        let largest = loads.into_iter().fold(0.0, f64::max);
        for (contact, load) in ball.iter().zip(loads) {
            let given = contact.map_or(0.0, |(load, _)| f64::from(load));
            worst = worst.max((given - load).abs() / largest);
        }
    }
    worst
}

fn answer(
    found: &SettledRow,
    design: &BallScrew,
    nut_speed: f32,
    load_mismatch: f64,
) -> ElasticRow {
    let path = design.pitch_radius() / design.cos_lead_angle();
    let speed = |ball: &Renewal| f64::from(nut_speed) * f64::from(ball.speed / path);
    let torque =
        |balls: &[Renewal]| -> f64 { balls.iter().map(|ball| f64::from(ball.torque)).sum() };
    let pressing = found.pressing.as_ref();
    ElasticRow {
        orbital_speed: found.alone.iter().map(speed).collect(),
        contact_force: pressing
            .map(|pressing| pressing.forces.iter().map(|&force| force.into()).collect()),
        groove_power_loss: pressing
            .map(|pressing| f64::from(nut_speed.abs()) * torque(&pressing.balls)),
        load_mismatch,
    }
}
