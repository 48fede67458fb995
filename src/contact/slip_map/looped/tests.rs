extern crate std;
use super::super::SlipMap;
use super::{LoopSlipMap, Slips};

/// Against the map with more terms, itself within 3e-4, over axis ratios, directions and distances of the velocity centre.
#[test]
fn as_the_map_with_more_terms() {
    // Measured: 8.6e-4, 5.7e-4; 2.5e-4, 3.6e-4.
    for (ratios, force, stiffness) in [
        ([0.1, 0.11, 0.12, 0.13, 0.14], 1.3e-3, 9e-4),
        ([0.15, 0.2, 0.3, 0.5, 0.9], 4e-4, 6e-4),
    ] {
        let (mut forces, mut stiffnesses) = (0.0_f32, 0.0_f32);
        for ratio in ratios {
            let map = SlipMap::new(ratio).unwrap();
            let looped = LoopSlipMap::new(ratio).unwrap();
            let (semi_major, spin, stick) = (0.02_f32, 0.7_f32, 0.05_f32);
            let end = semi_major * (spin * spin + stick * stick).sqrt();
            for place in 0..400 {
                let distance = end * 1e-3 * (1e5_f32).powf(place as f32 / 399.0);
                for direction in 0..13 {
                    let (sin, cos) = (0.5 * direction as f32).sin_cos();
                    let (across, along) = (distance * sin, distance * cos);
                    let exact = map.dissipation(across, along, spin, semi_major, stick);
                    let found = looped.at(&Slips {
                        across,
                        along,
                        spin,
                        stick: stick * stick,
                        size: semi_major * semi_major,
                    });
                    for (found, exact, unit) in [
                        (found.across, exact.across, 1.0),
                        (found.along, exact.along, 1.0),
                        (found.moment, exact.moment, semi_major),
                    ] {
                        forces = forces.max((found - exact).abs() / unit);
                    }
                    let unit = exact.stiffness_across + exact.stiffness_along;
                    for (found, exact) in [
                        (found.across_across, exact.stiffness_across),
                        (found.mixed, exact.stiffness_mixed),
                        (found.along_along, exact.stiffness_along),
                        (found.tilt * across * unit, exact.tilt_across * unit),
                        (
                            found.stick / found.moment * unit,
                            exact.stick / exact.moment * unit,
                        ),
                    ] {
                        stiffnesses = stiffnesses.max((found - exact).abs() / unit);
                    }
                }
            }
        }
        std::println!("forces {forces:.1e}, second derivatives {stiffnesses:.1e}");
        assert!(forces < force && stiffnesses < stiffness);
    }
}
