use crate::kit::gears;
use epas_friction::{Clearance, DeviationMap, FrictionModel, Inputs, UncagedBallScrew};
#[test]
fn two_point_scan() {
    for gap in [0.0f32, 2e-6, 5e-6, 10e-6, 15e-6, 20e-6, 25e-6, 40e-6, 60e-6] {
        for load in [10.0f32, 60.0, 200.0, 2000.0] {
            for speed in [10.0f32, -10.0] {
                let mut c = gears::uncaged();
                c.clearance = Clearance::new(gap).unwrap();
                c.screw_deviation = &DeviationMap::NONE;
                c.nut_deviation = &DeviationMap::NONE;
                let Ok(mut m) = FrictionModel::<UncagedBallScrew<1>>::new(&c) else {
                    continue;
                };
                let mut last = vec![];
                for t in 0..1000 {
                    let o = m.step(Inputs {
                        nut_speed: speed,
                        axial_load: load,
                    });
                    if t > 900 {
                        last.push(o.friction_torque / load);
                    }
                    if t == 999 {
                        let lo = last.iter().copied().fold(f32::INFINITY, f32::min);
                        let hi = last.iter().copied().fold(f32::NEG_INFINITY, f32::max);
                        println!(
                            "gap {gap:.1e} load {load} speed {speed}: {lo:.3e} .. {hi:.3e} faults {:?}",
                            o.faults
                        );
                    }
                }
            }
        }
    }
}
