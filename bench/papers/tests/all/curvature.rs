//! The printed tables and statistics of Bertolino et al. 2023.

use epas_papers::published::{TABLE_A1, TABLE_A2, computed_errors, radius_errors};
use epas_reference::curvature::{Groove, Surface, literature};

/// All 2 x 31 x 4 printed errors, each to its last digit: half of it, and the rounding of the
/// rounding (the largest deviation is 0.00499).
#[test]
fn tables_a1_and_a2_reproduce_to_the_last_digit() {
    let mut count = 0;
    for (table, groove) in [(&TABLE_A1, Groove::Screw), (&TABLE_A2, Groove::Nut)] {
        for row in table {
            let computed = computed_errors(row, groove).unwrap();
            for (computed, printed) in computed.iter().zip(row.errors()) {
                assert!((computed - printed).abs() < 0.005001, "{row:?}: {computed}");
                count += 1;
            }
            let degrees = row.surface(groove).lead_angle.to_degrees();
            assert!(
                (degrees - row.lead_angle).abs() < 0.00501,
                "{row:?}: {degrees}"
            );
        }
    }
    assert_eq!(count, 248);
}

/// The tables' conventions are no free choice: without them the values do not come out.
#[test]
fn tables_need_their_conventions() {
    // The first row of Table A1 with r_b in the literature formula, as eq. (27) prints it.
    let surface = TABLE_A1[0].surface(Groove::Screw);
    let (mean, _) = radius_errors(&surface, |angle| {
        literature(Groove::Screw, surface.pitch_radius, 0.5 * 7.144, angle)
    });
    assert!((mean - TABLE_A1[0].literature_mean).abs() > 0.1, "{mean}");
    // The row printed with a lead of 65 mm.
    let row = TABLE_A1.iter().find(|row| row.lead == 65.0).unwrap();
    assert!((row.true_lead() - 60.0).abs() < f64::EPSILON);
    let printed = (65.0 / (std::f64::consts::PI * row.nominal_diameter)).atan();
    assert!((printed.to_degrees() - row.lead_angle).abs() > 2.0);
}

/// Figures 8 and 9 over 0 to 80 x 0 to 80 degrees: the means reproduce with L = 0.0629 (0.0505 is a
/// misprint), the stated largest error does not.
#[test]
fn figure_9_means_reproduce_and_its_maximum_does_not() {
    for (groove, mean_printed, max_computed) in
        [(Groove::Screw, 0.84, 5.04), (Groove::Nut, 0.77, 5.08)]
    {
        let (mut sum, mut count, mut largest, mut largest_65) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for lead_degrees in 0..=80 {
            for contact_degrees in 0..=80 {
                let surface = Surface {
                    groove,
                    pitch_radius: 8.0,
                    lead_angle: f64::from(lead_degrees).to_radians(),
                    groove_radius: 2.0 * 0.528 * 1.5875,
                    offset_h: 0.0629,
                    offset_l: 0.0629,
                };
                let angle = f64::from(contact_degrees).to_radians();
                let exact = surface.principal(angle).kappa1;
                let error = (exact / surface.circular_groove(angle) - 1.0).abs() * 100.0;
                sum += error;
                count += 1.0;
                largest = largest.max(error);
                if contact_degrees <= 65 {
                    largest_65 = largest_65.max(error);
                }
            }
        }
        // Printed to two decimals: half a unit, here and below.
        assert!(
            (sum / count - mean_printed).abs() < 0.005,
            "{}",
            sum / count
        );
        assert!((largest - max_computed).abs() < 0.005, "{largest}");
        assert!((largest_65 - 2.374).abs() < 0.0005, "{largest_65}");
    }
}
