//! Printed numbers against computed ones: what is called reproduced is, and what is not called so is not.

use crate::published::curvature::{radius_errors, radius_tables};
use crate::published::{Verdict, half_unit, records};
use epas_reference::curvature::{Groove, literature};

#[test]
fn verdicts_are_what_the_numbers_say() {
    let records = records().unwrap();
    for record in &records {
        let verdict = record.printed.verdict;
        assert!(record.value().is_finite(), "{record:?}");
        let explained = verdict == Verdict::Reproduces || record.printed.reason.contains(' ');
        assert!(explained, "{record:?}");
    }
    let counts = [
        ("Bertolino et al. 2023", 329),
        ("Lin, Velinsky, Ravani 1994", 4),
        ("Alberdi et al.", 27),
        ("Lin 2019", 103),
    ];
    for (paper, count) in counts {
        let of_paper = records.iter().filter(|record| record.paper == paper);
        assert_eq!(of_paper.count(), count, "{paper}");
    }
    // The 248 errors of Tables A1 and A2.
    let errors = records.iter().filter(|record| {
        let quantity = &record.printed.quantity;
        record.place.starts_with("Table A") && quantity.ends_with("error") && record.agrees()
    });
    assert_eq!(errors.count(), 248);
}

/// The conventions of Tables A1 and A2 are no free choice: without them the values do not come out.
#[test]
fn tables_need_their_conventions() {
    let [screw, _] = radius_tables().unwrap();
    // The first row with r_b in the literature formula, as eq. (27) prints it.
    let surface = screw[0].surface(Groove::Screw);
    let (mean, _) = radius_errors(&surface, |angle| {
        literature(Groove::Screw, surface.pitch_radius, 0.5 * 7.144, angle)
    });
    assert!((mean - screw[0].errors[0]).abs() > 0.1, "{mean}");
    // The row printed with a lead of 65 mm.
    let row = screw.iter().find(|row| row.lead == 65.0).unwrap();
    assert_eq!(row.true_lead(), 60.0);
    let printed = (65.0 / (std::f64::consts::PI * row.nominal_diameter)).atan();
    assert!((printed.to_degrees() - row.lead_angle).abs() > 2.0);
}

#[test]
fn half_a_unit_of_the_last_printed_digit() {
    for (printed, half) in [
        ("5.69", 0.005),
        ("86", 0.5),
        ("1.812e-7", 0.5e-10),
        ("-0.79", 0.005),
    ] {
        // Derived: it is given 0.500_000_1 of a unit, 2e-7 more than half.
        assert!(
            (half_unit(printed) / half - 1.0).abs() < 2.01e-7,
            "{printed}"
        );
    }
}
