//! Across ignition: what was found is there again, and a block that is not its own changes nothing.

use epas_friction::Refusal;
use epas_friction::adaptation::{Adaptation, AdaptationConfiguration, AdaptationFlags};
use epas_friction::stored::VERSION;

use crate::adaptation::trace::{configuration, sound};

const BYTES: usize = Adaptation::<epas_friction::adaptation::AdaptationConstants>::STATE_BYTES;

const ESTIMATES_AT: usize = 16;
const DIAGONAL_AT: usize = ESTIMATES_AT + 20;
const ABOVE_AT: usize = DIAGONAL_AT + 20;
const TICK_AT: usize = ABOVE_AT + 40;
const HEALTH_AT: usize = TICK_AT + 2;

fn run(adaptation: &mut Adaptation, ticks: usize) {
    for tick in 0..ticks {
        let way = if tick % 100 < 50 { 1.0 } else { -1.0 };
        let level = if way > 0.0 { 1.3 } else { 1.1 };
        adaptation.update(&sound(level * 0.04 * way, 0.04 * way, 8.0 * way));
    }
}

fn driven() -> Adaptation {
    let mut adaptation = Adaptation::new(&configuration(5.0)).unwrap();
    run(&mut adaptation, 1000);
    adaptation.commission();
    run(&mut adaptation, 1234);
    adaptation
}

fn export(adaptation: &Adaptation) -> [u8; BYTES] {
    let mut block = [0xA5; BYTES];
    assert_eq!(adaptation.export(&mut block), Ok(BYTES));
    block
}

fn sealed(mut block: [u8; BYTES]) -> [u8; BYTES] {
    let checksum = crc32fast::hash(&block[..BYTES - 4]);
    block[BYTES - 4..].copy_from_slice(&checksum.to_le_bytes());
    block
}

#[test]
fn what_was_found_is_there_again() {
    let was = driven();
    let block = export(&was);
    let mut is = Adaptation::new(&configuration(5.0)).unwrap();
    assert_ne!(is.estimates(), was.estimates());
    assert_eq!(is.import(&block), Ok(()));
    assert_eq!(is.estimates(), was.estimates());
    assert_eq!(is.deviations(), was.deviations());
    assert_eq!(is.health(), was.health());
    assert_eq!(export(&is), block);
    let mut used = driven();
    run(&mut used, 777);
    assert_eq!(used.import(&block), Ok(()));
    for _ in 0..100 {
        run(&mut is, 7);
        run(&mut used, 7);
        assert_eq!(is, used);
    }
    let mut other = Adaptation::new(&AdaptationConfiguration {
        filter_time: 0.05,
        least_speed: 1.0,
        largest_level: 2.0,
        ..configuration(5.0)
    })
    .unwrap();
    assert_eq!(other.import(&block), Ok(()));
    assert_eq!(other.level(), was.level());
}

#[test]
fn a_level_at_its_bound_is_known_again() {
    let mut was = driven();
    let inside = sound(0.052, 0.04, 8.0);
    for _ in 0..9 {
        was.update(&inside);
        let mut is = Adaptation::new(&configuration(5.0)).unwrap();
        assert_eq!(is.import(&export(&was)), Ok(()));
        let adapted = is.update(&inside);
        assert!(!adapted.flags.contains(AdaptationFlags::AT_BOUND));
    }
    let jammed = sound(0.4, 0.04, 8.0);
    for _ in 0..10_000 {
        was.update(&jammed);
    }
    assert_eq!(was.estimates().forward, 2.5);
    for _ in 0..9 {
        was.update(&jammed);
        let mut is = Adaptation::new(&configuration(5.0)).unwrap();
        assert_eq!(is.import(&export(&was)), Ok(()));
        let adapted = is.update(&jammed);
        assert!(adapted.flags.contains(AdaptationFlags::AT_BOUND));
    }
}

fn refused(block: &[u8]) -> Refusal {
    let mut adaptation = driven();
    run(&mut adaptation, 5);
    let before = adaptation;
    let refusal = adaptation.import(block).unwrap_err();
    assert_eq!(adaptation, before);
    refusal
}

#[test]
fn a_block_that_is_not_its_own_is_refused() {
    let block = export(&driven());
    for length in [0, 15, BYTES - 1] {
        assert!(matches!(refused(&block[..length]), Refusal::Length { .. }));
    }
    let mut longer = block.to_vec();
    longer.push(0);
    assert!(matches!(refused(&longer), Refusal::Length { .. }));
    for byte in 0..BYTES {
        for bit in [1, 0x10, 0x80] {
            let mut wrong = block;
            wrong[byte] ^= bit;
            refused(&wrong);
        }
    }
    let with = |at: usize, bytes: &[u8]| {
        let mut wrong = block;
        wrong[at..at + bytes.len()].copy_from_slice(bytes);
        refused(&sealed(wrong))
    };
    let version = VERSION + 1;
    assert_eq!(
        with(4, &version.to_le_bytes()),
        Refusal::Version {
            found: version,
            expected: VERSION
        }
    );
    assert_eq!(with(0, b"EPAG"), Refusal::NotAState);
    assert_eq!(with(6, &1_u16.to_le_bytes()), Refusal::OtherScene);
    assert!(matches!(with(8, &[37, 0]), Refusal::OtherBalls { .. }));
    assert_eq!(with(12, &[1, 2, 3, 4]), Refusal::OtherConstants);
    let mut other = Adaptation::new(&configuration(2.0)).unwrap();
    assert_eq!(other.import(&block), Err(Refusal::OtherConstants));
}

#[test]
fn numbers_that_no_adaptation_leaves_are_refused() {
    let block = export(&driven());
    assert_eq!(BYTES, HEALTH_AT + 14 + 4);
    let with = |at: usize, number: f32| {
        let mut wrong = block;
        wrong[at..at + 4].copy_from_slice(&number.to_le_bytes());
        match refused(&sealed(wrong)) {
            Refusal::OutOfRange { field } => field,
            other => panic!("{other}"),
        }
    };
    for entry in 0..5 {
        for number in [f32::NAN, f32::INFINITY, 2e4] {
            assert_eq!(with(ESTIMATES_AT + 4 * entry, number), "estimates");
        }
        // Within the range of every number, beyond this one's bounds.
        assert_eq!(with(ESTIMATES_AT + 4 * entry, 3.0), "estimates");
        for number in [f32::NAN, 0.0, -1e-3, 1.1] {
            assert_eq!(with(DIAGONAL_AT + 4 * entry, number), "diagonal");
        }
    }
    for entry in 0..10 {
        assert_eq!(with(ABOVE_AT + 4 * entry, f32::NAN), "above");
        assert_eq!(with(ABOVE_AT + 4 * entry, 1e5), "variance");
    }
    for (entry, field) in ["average", "commissioned", "drift"].into_iter().enumerate() {
        assert_eq!(with(HEALTH_AT + 4 * entry, f32::NAN), field);
        assert_eq!(with(HEALTH_AT + 4 * entry, -1.0), field);
    }
    for (at, byte, field) in [
        (TICK_AT, 9, "tick"),
        (TICK_AT + 1, 5, "next"),
        (HEALTH_AT + 12, 2, "fallen"),
        (HEALTH_AT + 13, 9, "risen"),
    ] {
        let mut wrong = block;
        wrong[at] = byte;
        let field =
            |refusal| matches!(refusal, Refusal::OutOfRange { field: found } if found == field);
        assert!(field(refused(&sealed(wrong))), "{byte}");
    }
    let mut short = [0; BYTES - 1];
    assert!(matches!(
        driven().export(&mut short),
        Err(Refusal::Length { .. })
    ));
}
