use epas_reference::rig::course::{Course, Manoeuvre};
use epas_reference::rig::parameters::Parameters;
use epas_reference::rig::{Rig, Sensors};
use std::time::Instant;

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (mut n, mut s) = (0.0, 0.0);
    for v in values {
        n += 1.0;
        s += v * v;
    }
    (s / n as f64).sqrt()
}

#[test]
fn probe() {
    for (name, parameters) in [
        ("same", Parameters::default()),
        ("other", Parameters::other_physics()),
    ] {
        let start = Instant::now();
        let rig = Rig::new(parameters, Sensors::default()).unwrap();
        println!("{name} set-up {:?}", start.elapsed());
        for course in [Course::vehicle(), Course::rig(), Course::whole()] {
            let start = Instant::now();
            let trace = rig.run(&course, 5).unwrap();
            println!("run {:?} {}", start.elapsed(), trace.len());
            println!(
                "load max {}",
                trace.truth.load.iter().fold(0.0_f64, |m, l| m.max(l.abs()))
            );
            println!("torque rms {}", rms(trace.truth.torque.iter().copied()));
            for (m, r) in &trace.parts {
                let of = |v: &[f64]| rms(v[r.clone()].iter().copied());
                println!(
                    "{:12} T_f {:.5} w {:.2} acc {:.1} F {:.0} tau {:.3}",
                    m.name(),
                    of(&trace.truth.friction),
                    of(&trace.truth.speed),
                    of(&trace.truth.acceleration),
                    of(&trace.truth.load),
                    of(&trace.truth.torque)
                );
            }
        }
        let s = rig.sliding();
        for load in [
            -5000.0, -2000., -1000., -100., 0., 100., 1000., 2000., 5000.,
        ] {
            let state = epas_reference::rig::friction::State {
                turn: 0.0,
                speed: 0.0,
                load,
                temperature: 300.0,
            };
            println!("{load} {:?}", s.limits(&state));
        }
    }
}
