//! Slow drift of the level.

use epas_friction::adaptation::{
    Adaptation, AdaptationConfiguration, Adapted, HealthConfiguration,
};

use crate::adaptation::trace::{configuration, sound};

fn slow() -> AdaptationConfiguration {
    AdaptationConfiguration {
        health: HealthConfiguration {
            average_time: 100.0,
            fall: 0.3,
            rise: 0.5,
            hysteresis: 0.1,
        },
        ..configuration(5.0)
    }
}

fn run(adaptation: &mut Adaptation, level: f32, seconds: usize) -> Adapted {
    let mut last = None;
    for tick in 0..100 * seconds {
        let way = if tick % 100 < 50 { 1.0 } else { -1.0 };
        let friction = 0.04 * way;
        last = Some(adaptation.update(&sound(level * friction, friction, 8.0 * way)));
    }
    last.unwrap()
}

/// The average falls as an exponential of its time: 1 to 0.5 comes to 0.7 after `100 ln(0.5/0.2) = 92` s.
#[test]
fn a_level_that_falls_is_flagged_and_its_flag_goes_late() {
    let mut adaptation = Adaptation::new(&slow()).unwrap();
    let health = run(&mut adaptation, 1.0, 300).health;
    assert!(health.drift.abs() < 8e-8 && !health.fallen && !health.risen);
    let health = run(&mut adaptation, 0.5, 85).health;
    assert!(!health.fallen && health.drift > -0.3, "{health:?}");
    let health = run(&mut adaptation, 0.5, 20).health;
    assert!(health.fallen && !health.risen, "{health:?}");
    // A level of 0.75 takes the drift to -0.25: within the hysteresis. One of 0.9 takes it to -0.1. Derived: after 500 s
    // exp(-5) of the way is left, 5e-4 of 0.07 and 1.0e-3 of 0.15. Measured: 5.1e-4 and 1.08e-3.
    let health = run(&mut adaptation, 0.75, 500).health;
    assert!(
        health.fallen && (health.drift + 0.25).abs() < 1.5e-3,
        "{health:?}"
    );
    let health = run(&mut adaptation, 0.9, 500).health;
    assert!(
        !health.fallen && (health.drift + 0.1).abs() < 2e-3,
        "{health:?}"
    );
}

#[test]
fn drift_counts_from_commissioning() {
    let mut adaptation = Adaptation::new(&slow()).unwrap();
    run(&mut adaptation, 1.4, 60);
    adaptation.commission();
    assert_eq!(adaptation.health().drift, 0.0);
    let health = run(&mut adaptation, 1.4, 1).health;
    assert!(health.drift.abs() < 1e-4, "{health:?}");
    // 1.4 times 1.4 is a rise of 0.4, not of 0.96. Derived: after 700 s exp(-7) of it is left, 3.6e-4. Measured: 4.0e-4.
    let health = run(&mut adaptation, 1.96, 700).health;
    assert!(
        !health.risen && (health.drift - 0.4).abs() < 1e-3,
        "{health:?}"
    );
    let health = run(&mut adaptation, 2.2, 700).health;
    assert!(health.risen && !health.fallen, "{health:?}");
    adaptation.reset();
    assert_eq!(adaptation, Adaptation::new(&slow()).unwrap());
}

#[test]
fn a_slow_average_does_not_stand_still() {
    let configuration = AdaptationConfiguration {
        health: HealthConfiguration {
            average_time: 1e5,
            ..HealthConfiguration::DEFAULT
        },
        ..configuration(5.0)
    };
    let mut adaptation = Adaptation::new(&configuration).unwrap();
    let health = run(&mut adaptation, 1.2, 30_000).health;
    // 0.2 (1 - exp(-0.3)), less the seconds until the level is found. Measured: 4.9e-5.
    let exact = 0.2 * (1.0 - (-0.3_f32).exp());
    assert!(
        (health.drift / exact - 1.0).abs() < 1.5e-4,
        "{health:?} {exact}"
    );
}
