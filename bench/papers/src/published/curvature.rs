//! Every computable number of Bertolino et al. 2023.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI, TAU};
use std::ops::RangeInclusive;

use super::{Computed, Printed, Record, Verdict};
use epas_page::failure::Failure;
use epas_reference::curvature::{Groove, Surface, literature, profile};
use epas_reference::error::ReferenceError;
use serde::Deserialize;

/// Conformity of the printed tables; they determine it within 0.0005.
pub const CONFORMITY: f64 = 0.528;

/// One row of Table A1 or A2 as printed: nominal diameter, lead, ball diameter (mm), lead angle (degrees), and mean and largest error
/// of the literature's and of the proposed formula (percent).
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(from = "[f64; 8]")]
pub struct Row {
    /// Nominal diameter, mm.
    pub nominal_diameter: f64,
    /// Lead as printed, mm.
    pub lead: f64,
    /// Ball diameter, mm.
    pub ball_diameter: f64,
    /// Lead angle as printed, degrees.
    pub lead_angle: f64,
    /// Literature mean and largest, proposed mean and largest error, percent.
    pub errors: [f64; 4],
}

impl From<[f64; 8]> for Row {
    fn from(row: [f64; 8]) -> Self {
        let [
            nominal_diameter,
            lead,
            ball_diameter,
            lead_angle,
            errors @ ..,
        ] = row;
        Self {
            nominal_diameter,
            lead,
            ball_diameter,
            lead_angle,
            errors,
        }
    }
}

impl Row {
    /// The lead that the row was computed with, mm: 60 where 65 is printed, as its lead angle shows.
    pub fn true_lead(&self) -> f64 {
        if self.lead == 65.0 { 60.0 } else { self.lead }
    }

    /// The groove surface of this size: nominal contact angle 45 degrees, pitch radius half the nominal diameter.
    pub fn surface(&self, groove: Groove) -> Surface {
        let pitch_radius = 0.5 * self.nominal_diameter;
        let (groove_radius, offset_h, offset_l) =
            profile(0.5 * self.ball_diameter, CONFORMITY, FRAC_PI_4);
        Surface {
            groove,
            pitch_radius,
            lead_angle: (self.true_lead() / (TAU * pitch_radius)).atan(),
            groove_radius,
            offset_h,
            offset_l,
        }
    }

    /// The four errors computed again.
    ///
    /// The errors are those of the radius. The screw's table takes the groove radius in the literature formula, not the ball radius
    /// that eq. (27) prints; the nut's table the ball radius, as eq. (28).
    pub fn computed_errors(&self, groove: Groove) -> Result<[f64; 4], ReferenceError> {
        let surface = self.surface(groove);
        surface.check(0.0)?;
        let radius = match groove {
            Groove::Screw => surface.groove_radius,
            Groove::Nut => 0.5 * self.ball_diameter,
        };
        let (literature_mean, literature_max) = radius_errors(&surface, |angle| {
            literature(groove, surface.pitch_radius, radius, angle)
        });
        let (mean, max) = radius_errors(&surface, |angle| surface.circular_groove(angle));
        Ok([literature_mean, literature_max, mean, max])
    }
}

/// Mean and largest error, percent, of a formula for the first radius of curvature over the contact angles 1, 2, ... 70 degrees.
pub fn radius_errors(surface: &Surface, formula: impl Fn(f64) -> f64) -> (f64, f64) {
    let errors = (1..=70).map(|degrees| {
        let angle = f64::from(degrees).to_radians();
        (surface.principal(angle).kappa1 / formula(angle) - 1.0).abs() * 100.0
    });
    let largest = errors.clone().fold(0.0, f64::max);
    (errors.sum::<f64>() / 70.0, largest)
}

/// Tables A1 (screw) and A2 (nut) as printed.
pub fn radius_tables() -> Result<[Vec<Row>; 2], Failure> {
    Ok(super::file()?.radius_tables)
}

pub(super) fn records(tables: &[Vec<Row>; 2]) -> Result<Vec<Record>, ReferenceError> {
    let mut records = Vec::new();
    for (place, rows, groove) in [
        ("Table A1", &tables[0], Groove::Screw),
        ("Table A2", &tables[1], Groove::Nut),
    ] {
        for row in rows {
            size(&mut records, place, row, groove)?;
        }
    }
    Ok(records)
}

fn size(
    records: &mut Vec<Record>,
    place: &str,
    row: &Row,
    groove: Groove,
) -> Result<(), ReferenceError> {
    let size = [row.nominal_diameter, row.lead, row.ball_diameter].map(|size| size.to_string());
    let size = size.join(" x ");
    let mut add = |quantity: &str, unit: &str, printed, computed, (verdict, reason): (_, &str)| {
        records.push(Record {
            paper: "Bertolino et al. 2023".into(),
            place: place.into(),
            printed: Printed {
                quantity: format!("{size}: {quantity}"),
                unit: unit.into(),
                digits: printed,
                tolerance: None,
                verdict,
                reason: reason.into(),
            },
            computed,
        });
    };
    let wrong_lead = row.lead != row.true_lead();
    if wrong_lead {
        let computed = row.lead_angle.to_radians().tan() * PI * row.nominal_diameter;
        let why = (Verdict::Misprint, "printed_lead");
        add(
            "lead, from the printed lead angle",
            "mm",
            row.lead.to_string(),
            computed,
            why,
        );
    }
    let why = if wrong_lead {
        (Verdict::Convention, "true_lead")
    } else {
        (Verdict::Reproduces, "")
    };
    let printed = format!("{:.2}", row.lead_angle);
    let computed = row.surface(groove).lead_angle.to_degrees();
    add("lead angle", "deg", printed, computed, why);
    let names = [
        "literature, mean error",
        "literature, largest error",
        "proposed, mean error",
        "proposed, largest error",
    ];
    let errors = row.errors.into_iter().zip(row.computed_errors(groove)?);
    for (index, (name, (printed, computed))) in names.into_iter().zip(errors).enumerate() {
        let reason = match (wrong_lead, groove, index) {
            (true, ..) => "true_lead",
            (_, Groove::Screw, 0 | 1) => "with_groove_radius",
            _ => "fitted",
        };
        let why = (Verdict::Convention, reason);
        add(name, "%", format!("{printed:.2}"), computed, why);
    }
    Ok(())
}

/// Ball radius of Figures 8 and 9, mm.
const BALL_RADIUS: f64 = 1.5875;

/// `H` and `L` over the ball radius.
const EXCESS: f64 = (2.0 * CONFORMITY - 1.0) * FRAC_1_SQRT_2;

/// Errors of eq. (25), (26) in percent for the screw or nut of Figures 8 and 9: mean and largest over 0 to 80 degrees, largest to
/// contact angles of 65, at 45, and at 45 with lead angles to 40.
fn figure_9(groove: Groove) -> Vec<f64> {
    let error = |lead: i32, contact: i32| {
        let surface = Surface {
            groove,
            pitch_radius: 8.0,
            lead_angle: f64::from(lead).to_radians(),
            groove_radius: 2.0 * CONFORMITY * BALL_RADIUS,
            offset_h: EXCESS * BALL_RADIUS,
            offset_l: EXCESS * BALL_RADIUS,
        };
        let angle = f64::from(contact).to_radians();
        (surface.principal(angle).kappa1 / surface.circular_groove(angle) - 1.0).abs() * 100.0
    };
    let over = |leads: i32, contacts: RangeInclusive<i32>| {
        let leads = 0..=leads;
        leads.flat_map(move |lead| contacts.clone().map(move |contact| error(lead, contact)))
    };
    let largest = |leads, contacts| over(leads, contacts).fold(0.0, f64::max);
    vec![
        over(80, 0..=80).sum::<f64>() / (81.0 * 81.0),
        largest(80, 0..=80),
        largest(80, 0..=65),
        largest(80, 45..=45),
        largest(40, 45..=45),
    ]
}

pub(super) fn computed(tables: &[Vec<Row>; 2]) -> Result<Computed, ReferenceError> {
    let mut catalogue = Vec::new();
    for (rows, groove) in tables.iter().zip([Groove::Screw, Groove::Nut]) {
        let mut sum = 0.0;
        for row in rows {
            sum += row.computed_errors(groove)?[2];
        }
        catalogue.push(sum / rows.len() as f64);
    }
    let saved = (17.81 - 0.328) * 1e-6;
    Ok(vec![
        (
            "Figure 9 and section 4",
            [Groove::Screw, Groove::Nut].map(figure_9).concat(),
        ),
        ("abstract and section 4", catalogue),
        ("Figures 8 and 9", vec![EXCESS * BALL_RADIUS; 2]),
        ("Figure 7", vec![0.0693 / EXCESS]),
        (
            "Figure 11 and section 4",
            vec![
                100.0 * (1.0 - 0.328 / 17.81),
                2.0 * 30.0 * 4.0 * 1e7 * saved / 3600.0,
            ],
        ),
    ])
}
