//! The crate's curvature forms against 65-digit values of the Weingarten map.

use epas_friction::{ContactAngle, GothicArch, Groove, GrooveProfile, HelixPath};
use serde::Deserialize;

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct Case {
    tag: String,
    r_m: f64,
    alpha: f64,
    phi: f64,
    r_s: f64,
    H: f64,
    L: f64,
    screw: Curvatures,
    nut: Curvatures,
}

#[derive(Deserialize)]
struct Curvatures {
    kappa1: f64,
    kappa2: f64,
}

fn golden() -> Vec<Case> {
    let text = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/golden/curvature.json"
    ));
    serde_json::from_str::<Golden>(text).unwrap().cases
}

/// Inputs are exact in f32. The h-form takes about 20 dependent roundings on values of one sign, of
/// which those of `A` and `D` enter to the third power: 10 half-ulps, 6e-7, is the worst expected.
/// Near the nut's zero of kappa1 the bound is absolute, relative to kappa2.
#[test]
fn exact_form_holds_in_f32_over_all_cases() {
    let mut worst = [0.0_f64; 2];
    for case in golden() {
        let path = HelixPath::from_lead_angle(case.r_m as f32, case.alpha as f32);
        let profile = GrooveProfile {
            groove_radius: case.r_s as f32,
            offset_h: case.H as f32,
            offset_l: case.L as f32,
        };
        for (groove, truth) in [(Groove::Screw, &case.screw), (Groove::Nut, &case.nut)] {
            let computed = GothicArch::new(groove, &path, &profile)
                .principal(ContactAngle::new(case.phi as f32));
            let error1 = (f64::from(computed.kappa1) - truth.kappa1).abs();
            let error2 = (f64::from(computed.kappa2) / truth.kappa2 - 1.0).abs();
            let allowed = (1e-6 * truth.kappa1.abs()).max(1e-7 * truth.kappa2.abs());
            let at = format!(
                "{} {groove:?} r_m={} alpha={} phi={} r_s={} H={} L={}: {computed:?} for {} {}",
                case.tag,
                case.r_m,
                case.alpha,
                case.phi,
                case.r_s,
                case.H,
                case.L,
                truth.kappa1,
                truth.kappa2
            );
            if error1 > allowed || error2 > 5e-7 {
                println!("BAD {:e} {:e} {at}", error1 / truth.kappa1, error2);
            }
            worst[0] = worst[0].max(error1 / allowed * 1e-6);
            worst[1] = worst[1].max(error2);
        }
    }
    println!("worst kappa1 {:.2e}, kappa2 {:.2e}", worst[0], worst[1]);
}
