//! Every computable number of Bertolino et al. 2023.

use super::radius_tables::{CONFORMITY, Row, TABLE_A1, TABLE_A2, computed_errors};
use crate::record::{Page, Verdict};
use epas_reference::curvature::{Groove, Surface};
use epas_reference::error::ReferenceError;

const FITTED: Verdict = Verdict::Convention(
    "conformity 0.528, nominal contact angle 45 degrees, pitch radius half the nominal diameter, contact angles 1, 2, ... 70 \
     degrees, error of the radius",
);
const WITH_GROOVE_RADIUS: Verdict = Verdict::Convention(
    "as the other columns, and the groove radius in the place of the ball radius that eq. (27) prints",
);
const TRUE_LEAD: Verdict = Verdict::Convention(
    "as the other rows, with the lead of 60 mm that the printed lead angle says",
);

/// Appends the records.
pub(super) fn append(page: &mut Page<'_>) -> Result<(), ReferenceError> {
    for (place, rows, groove) in [
        ("Table A1", &TABLE_A1, Groove::Screw),
        ("Table A2", &TABLE_A2, Groove::Nut),
    ] {
        for row in rows {
            size(&mut page.turn(place), row, groove)?;
        }
    }
    text(page)?;
    Ok(())
}

fn size(page: &mut Page<'_>, row: &Row, groove: Groove) -> Result<(), ReferenceError> {
    let name = format!(
        "{} x {} x {}",
        row.nominal_diameter, row.lead, row.ball_diameter
    );
    let wrong_lead = row.lead != row.true_lead();
    let angle = row.surface(groove).lead_angle;
    if wrong_lead {
        page.add(
            format!("{name}: lead, from the printed lead angle"),
            "mm",
            row.lead.to_string(),
            row.lead_angle.to_radians().tan() * std::f64::consts::PI * row.nominal_diameter,
            Verdict::Misprint("60 mm: the row's lead angle and errors are those of 60 mm"),
        );
    }
    page.add(
        format!("{name}: lead angle"),
        "deg",
        format!("{:.2}", row.lead_angle),
        angle.to_degrees(),
        if wrong_lead {
            TRUE_LEAD
        } else {
            Verdict::Reproduces
        },
    );
    let names = [
        "literature, mean error",
        "literature, largest error",
        "proposed, mean error",
        "proposed, largest error",
    ];
    let computed = computed_errors(row, groove)?;
    for (index, ((quantity, printed), computed)) in names
        .into_iter()
        .zip(row.errors())
        .zip(computed)
        .enumerate()
    {
        let verdict = match (wrong_lead, groove, index) {
            (true, ..) => TRUE_LEAD,
            (_, Groove::Screw, 0 | 1) => WITH_GROOVE_RADIUS,
            _ => FITTED,
        };
        page.add(
            format!("{name}: {quantity}"),
            "%",
            format!("{printed:.2}"),
            computed,
            verdict,
        );
    }
    Ok(())
}

/// Error of eq. (25), (26) in percent for the screw or nut of Figures 8 and 9.
fn figure_9_error(groove: Groove, lead_degrees: i32, contact_degrees: i32) -> f64 {
    let offset = (2.0 * CONFORMITY - 1.0) * 1.5875 * std::f64::consts::FRAC_1_SQRT_2;
    let surface = Surface {
        groove,
        pitch_radius: 8.0,
        lead_angle: f64::from(lead_degrees).to_radians(),
        groove_radius: 2.0 * CONFORMITY * 1.5875,
        offset_h: offset,
        offset_l: offset,
    };
    let angle = f64::from(contact_degrees).to_radians();
    (surface.principal(angle).kappa1 / surface.circular_groove(angle) - 1.0).abs() * 100.0
}

fn text(page: &mut Page<'_>) -> Result<(), ReferenceError> {
    let sides = [
        (Groove::Screw, "screw", ["0.84", "0.91", "0.51"], &TABLE_A1),
        (Groove::Nut, "nut", ["0.77", "0.69", "0.40"], &TABLE_A2),
    ];
    for (groove, side, [mean, below_40, catalogue], table) in sides {
        let error = |lead, contact| figure_9_error(groove, lead, contact);
        let over = |leads: i32, contacts: std::ops::RangeInclusive<i32>| {
            (0..=leads)
                .flat_map(|lead| contacts.clone().map(move |contact| error(lead, contact)))
                .fold(0.0, f64::max)
        };
        let all: Vec<_> = (0..=80)
            .flat_map(|lead| (0..=80).map(move |contact| error(lead, contact)))
            .collect();
        let mut figure = page.turn("Figure 9 and section 4");
        figure.add(
            format!("mean error, helix and contact angle 0-80 degrees, {side}"),
            "%",
            mean,
            all.iter().sum::<f64>() / all.len() as f64,
            Verdict::Convention("H = L = 0.0629 mm: the printed L is a misprint"),
        );
        figure.add(
            format!("largest error, helix and contact angle 0-80 degrees, {side}"),
            "%",
            "2.38",
            over(80, 0..=80),
            Verdict::NotReproducible("holds for contact angles up to 65 degrees"),
        );
        figure.roughly(
            format!("largest error, contact angles up to 65 degrees, {side}"),
            "%",
            ("2.38", 0.01),
            over(80, 0..=65),
            Verdict::Convention("contact angles up to 65 degrees, not 80; \"below 2.38\""),
        );
        figure.add(
            format!("largest error at contact angle 45 degrees, {side}"),
            "%",
            "1.3",
            over(80, 45..=45),
            Verdict::NotReproducible("1.5 % at a helix angle of 80 degrees, for screw and nut"),
        );
        figure.roughly(
            format!("largest error, \"contact angles below 40\", {side}"),
            "%",
            (below_40, 0.006),
            over(40, 45..=45),
            Verdict::Convention(
                "contact angle 45 and helix angles up to 40 degrees; with contact angles below 40 it is 1.4 %",
            ),
        );
        let mut sum = 0.0;
        for row in table {
            sum += computed_errors(row, groove)?[2];
        }
        page.turn("abstract and section 4").add(
            format!("mean error over the catalogue, {side}"),
            "%",
            catalogue,
            sum / table.len() as f64,
            Verdict::NotReproducible(
                "over 63 sizes of which 31 are printed: computed over these; section 4 exchanges screw and nut",
            ),
        );
    }
    let excess = (2.0 * CONFORMITY - 1.0) * std::f64::consts::FRAC_1_SQRT_2;
    page.turn("Figures 8 and 9").add(
        "L",
        "mm",
        "0.0505",
        excess * 1.5875,
        Verdict::Misprint("L = H = 0.0629 mm at a nominal contact angle of 45 degrees"),
    );
    page.turn("Figures 8 and 9")
        .add("H", "mm", "0.0629", excess * 1.5875, FITTED);
    page.turn("Figure 7").add(
        "ball radius, from H = L = 0.0693 mm",
        "mm",
        "3.5",
        0.0693 / excess,
        Verdict::Misprint("3.5 mm is the ball's diameter"),
    );
    let mut times = page.turn("Figure 11 and section 4");
    times.add(
        "time saved by the proposed formula, from the printed times",
        "%",
        "98",
        100.0 * (1.0 - 0.328 / 17.81),
        Verdict::Reproduces,
    );
    times.roughly(
        "time saved in a simulation of 10 s, from the printed times",
        "h",
        ("11.6", 0.1),
        2.0 * 30.0 * 4.0 * 1e7 * (17.81 - 0.328) * 1e-6 / 3600.0,
        Verdict::Convention("two nuts of 30 balls; cut off, not rounded"),
    );
    Ok(())
}
