//! Printed numbers against computed ones: what is called reproduced is, and what is not called so is not.

use epas_papers::published::records;
use epas_papers::record::{Paper, Verdict, half_unit};

#[test]
fn verdicts_are_what_the_numbers_say() {
    let records = records().unwrap();
    let mut counts = [[0; 4]; 4];
    let mut wrong = 0;
    for record in &records {
        let (column, reproduced) = match record.verdict {
            Verdict::Reproduces => (0, true),
            Verdict::Convention(_) => (1, true),
            Verdict::Misprint(_) => (2, false),
            Verdict::NotReproducible(_) => (3, false),
        };
        let row = Paper::ALL.iter().position(|paper| *paper == record.paper);
        counts[row.unwrap()][column] += 1;
        assert!(record.printed_value().is_finite(), "{record}");
        assert!(
            record.verdict == Verdict::Reproduces || !record.verdict.reason().is_empty(),
            "{record}"
        );
        if record.agrees() != reproduced {
            println!(
                "{record}, off {}, tolerance {}",
                record.deviation(),
                record.tolerance
            );
            wrong += 1;
        }
    }
    for (paper, counts) in Paper::ALL.iter().zip(counts) {
        println!("{}: {counts:?}", paper.name());
    }
    assert_eq!(wrong, 0);
    let alberdi = records
        .iter()
        .filter(|record| record.paper == Paper::Alberdi);
    assert_eq!(alberdi.count(), 27);
    // The 248 errors of Tables A1 and A2.
    let errors = records.iter().filter(|record| {
        record.place.starts_with("Table A") && record.quantity.ends_with("error") && record.agrees()
    });
    assert_eq!(errors.count(), 248);
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
