//! The crate's curvature forms against 65-digit values of the Weingarten map.

use epas_friction::Error;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{ContactAngle, Groove, GrooveProfile, HelixPath};
use epas_reference::curvature::{self, Surface};
use epas_testkit::measured;
use epas_testkit::random::Random;
use epas_testkit::random_scenes;
use serde::Deserialize;

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Clone, Deserialize)]
struct Case {
    tag: String,
    r_m: f64,
    alpha: f64,
    phi: f64,
    r_s: f64,
    #[serde(rename = "H")]
    h: f64,
    #[serde(rename = "L")]
    l: f64,
    screw: Curvatures,
    nut: Curvatures,
}

#[derive(Clone, Copy, Deserialize)]
struct Curvatures {
    kappa1: f64,
    kappa2: f64,
}

impl Case {
    fn truth(&self, groove: Groove) -> Curvatures {
        match groove {
            Groove::Screw => self.screw,
            Groove::Nut => self.nut,
        }
    }

    fn arch(&self, groove: Groove) -> GothicArch {
        let path = HelixPath::from_lead_angle(self.r_m as f32, self.alpha as f32);
        GothicArch::checked(groove, &path, &self.profile(), self.contact_angle()).unwrap()
    }

    fn profile(&self) -> GrooveProfile {
        GrooveProfile {
            groove_radius: self.r_s as f32,
            offset_h: self.h as f32,
            offset_l: self.l as f32,
        }
    }

    fn contact_angle(&self) -> ContactAngle {
        ContactAngle::new(self.phi as f32)
    }

    /// `A = 1 + zeta kappa (H - r_s cos(phi))`, by which the surface is conditioned.
    fn area(&self, groove: Groove) -> f64 {
        let curvature = self.alpha.cos().powi(2) / self.r_m;
        1.0 + f64::from(groove.sign()) * curvature * (self.h - self.r_s * self.phi.cos())
    }

    fn line(&self, groove: Groove) -> String {
        format!(
            r#"{} {{"model":"groove_curvature","groove":"{}","pitch_radius":{},"lead_angle":{},"contact_angle":{},"groove_radius":{},"offset_h":{},"offset_l":{}}}"#,
            self.tag,
            if groove == Groove::Screw {
                "screw"
            } else {
                "nut"
            },
            self.r_m,
            self.alpha,
            self.phi,
            self.r_s,
            self.h,
            self.l,
        )
    }
}

fn golden() -> Vec<Case> {
    let text = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/golden/curvature.json"
    ));
    serde_json::from_str::<Golden>(text).unwrap().cases
}

const GROOVES: [Groove; 2] = [Groove::Screw, Groove::Nut];

/// Inputs are exact in f32. About 20 roundings of 2^-24 follow one another, those of `A` and `D` to
/// the third power; measured worst 4e-7, promised 1e-6. Near the nut's zero of kappa1 the bound is
/// absolute, 1e-7 of kappa2. Where the screw's surface is about to fold (`A` small) the cosine of the
/// contact angle, the curvature of the path and their product, each rounded to 2^-24, enter with
/// 2^-24 / A: four such roundings, and the bound grows below A = 0.3.
#[test]
fn exact_form_holds_in_f32_over_all_cases() {
    let mut sum = [0.0_f64; 2];
    let mut count = 0.0;
    for case in golden() {
        for groove in GROOVES {
            let truth = case.truth(groove);
            let computed = case.arch(groove).principal(case.contact_angle());
            let allowed1 = (1e-6 * truth.kappa1.abs() * (0.3 / case.area(groove)).max(1.0))
                .max(1e-7 * truth.kappa2.abs());
            let error1 = f64::from(computed.kappa1) - truth.kappa1;
            let error2 = f64::from(computed.kappa2) / truth.kappa2 - 1.0;
            assert!(
                error1.abs() <= allowed1 && error2.abs() <= 5e-7,
                "{}: {computed:?} for {} {}",
                case.line(groove),
                truth.kappa1,
                truth.kappa2
            );
            if case.area(groove) > 0.3 && error1.abs() > 1e-7 * truth.kappa2.abs() {
                sum[0] += error1 / truth.kappa1;
            }
            sum[1] += error2;
            count += 1.0;
        }
    }
    measured::assert("bias of kappa1", sum[0] / count);
    measured::assert("bias of kappa2", sum[1] / count);
}

/// The paper's approximations are exact where what they leave out is absent: offsets for the circular
/// groove, the lead too for the literature formula (with `r_s` in the place of its `r_b`).
#[test]
fn without_offsets_the_groove_is_a_tube_and_without_lead_a_bearing() {
    for case in golden() {
        if case.h != 0.0 || case.l != 0.0 {
            continue;
        }
        for groove in GROOVES {
            let truth = case.truth(groove).kappa1;
            // Four roundings, the subtraction magnified by 1/A; an absolute bound near the zero.
            let allowed = (2.5e-7 * truth.abs() / case.area(groove).min(1.0))
                .max(1e-7 * case.truth(groove).kappa2.abs());
            let arch = case.arch(groove);
            let circular = CircularGrooveCurvature::from(&arch);
            let first = f64::from(circular.first(case.contact_angle()));
            assert!((first - truth).abs() <= allowed, "{}", case.line(groove));
            // Derived: the radius and its inverse are rounded once each.
            let second = f64::from(circular.second()) / case.truth(groove).kappa2 - 1.0;
            assert!(second.abs() < 1.3e-7, "{second:e} {}", case.line(groove));
            if case.alpha == 0.0 {
                let bearing = LiteratureCurvature::new(groove, case.r_m as f32, case.r_s as f32);
                let first = f64::from(bearing.first(case.contact_angle()));
                assert!((first - truth).abs() <= allowed, "{}", case.line(groove));
            }
        }
    }
}

#[test]
fn a_straight_groove_has_no_curvature_along_it() {
    let path = HelixPath {
        curvature: 0.0,
        torsion: 0.0,
    };
    let profile = GrooveProfile {
        groove_radius: 1.7,
        offset_h: 0.06,
        offset_l: 0.06,
    };
    let angle = ContactAngle::new(0.7);
    for groove in GROOVES {
        let arch = GothicArch::new(groove, &path, &profile);
        let curvatures = arch.principal(angle);
        assert_eq!(curvatures.kappa1, 0.0);
        // Three roundings of 2^-24.
        approx::assert_relative_eq!(curvatures.kappa2, -1.0 / 1.7, max_relative = 2e-7);
        assert_eq!(FittedCurvature::new(&arch, 1.2).first(angle), 0.0);
        assert_eq!(CircularGrooveCurvature::from(&arch).first(angle), 0.0);
    }
}

/// The sum of the curvatures of ball and groove keeps its digits, though it cancels to a twentieth.
#[test]
fn relative_curvature_across_does_not_cancel() {
    for case in golden().iter().filter(|case| case.tag == "catalogue") {
        // The clearance of these cases: H = (r_s - r_b) cos 45.
        let clearance = case.h * std::f64::consts::SQRT_2;
        let ball_curvature = 1.0 / (case.r_s - clearance);
        for groove in GROOVES {
            let truth = case.truth(groove);
            let computed = case
                .arch(groove)
                .relative(case.contact_angle(), clearance as f32);
            let along = f64::from(computed.along) / (ball_curvature + truth.kappa1) - 1.0;
            let across = f64::from(computed.across) / (ball_curvature + truth.kappa2) - 1.0;
            measured::assert_at(
                "relative curvature along",
                along,
                format_args!("{}: {along:e}", case.line(groove)),
            );
            measured::assert_at(
                "relative curvature across",
                across,
                format_args!("{}: {across:e}", case.line(groove)),
            );
        }
    }
}

#[test]
fn a_folded_surface_is_refused_with_the_range_that_is_left() {
    let path = HelixPath::from_lead_angle(2.0, 0.0);
    let profile = GrooveProfile {
        groove_radius: 2.5,
        offset_h: 0.1,
        offset_l: 0.1,
    };
    let flat = ContactAngle::new(0.0);
    let error = GothicArch::checked(Groove::Screw, &path, &profile, flat).unwrap_err();
    assert!(matches!(error, Error::FoldedGroove { .. }));
    assert_eq!(error.field(), "groove_radius");
    // The path's radius less a ten-thousandth, and the offset; three roundings of 2^-24.
    approx::assert_relative_eq!(error.allowed().maximum, 2.0998, max_relative = 2e-7);
    // The nut bends away from the axis, and the flank of the same screw stands upright.
    assert!(GothicArch::checked(Groove::Nut, &path, &profile, flat).is_ok());
    let steep = ContactAngle::new(1.2);
    assert!(GothicArch::checked(Groove::Screw, &path, &profile, steep).is_ok());
}

/// A groove as large as it may be beside its path, more often than not close to one of the edges of what is accepted:
/// the fold, the axis, the largest radius; in any unit of length. Its section has the digits of the crate.
fn edge(random: &mut Random, groove: Groove) -> (Surface, ContactAngle) {
    let size = |random: &mut Random, low: f64, high: f64| -> f64 {
        low * (high / low).powf(random.between(0.0, 1.0))
    };
    let curvature = size(random, 1e-9, 1e9);
    let ratio = match random.below(4) {
        0 | 1 => 0.0,
        2 => size(random, 1e-6, 1e6),
        _ => size(random, 1e-30, 1e9) / curvature,
    };
    let lead_angle = ratio.atan();
    let largest = (10.0 / (curvature * ratio.max(1.0))).min(1e9);
    let radius = largest
        * if random.one_in(3) {
            1.0
        } else {
            size(random, 1e-6, 1.0)
        };
    let angle = match random.below(5) {
        0 => 0.0,
        1 => std::f64::consts::FRAC_PI_2,
        _ => random.between(0.0, std::f64::consts::FRAC_PI_2),
    };
    let edge = size(random, 1e-8, 1.0);
    let offset_h = match groove {
        _ if random.one_in(3) => radius * random.between(0.0, 1.0),
        Groove::Nut => (1.0 - edge) / curvature,
        Groove::Screw => radius * angle.cos() - (1.0 - edge) / curvature,
    };
    let single = |value: f64| f64::from(value as f32);
    let surface = Surface {
        groove: match groove {
            Groove::Screw => curvature::Groove::Screw,
            Groove::Nut => curvature::Groove::Nut,
        },
        pitch_radius: lead_angle.cos().powi(2) / curvature,
        lead_angle,
        groove_radius: single(radius),
        offset_h: single(offset_h.clamp(0.0, radius)),
        offset_l: single(radius * size(random, 1e-6, 1.0)),
    };
    (surface, ContactAngle::new(angle as f32))
}

/// Whatever groove is accepted has finite curvatures that are right to the digits that its `A` leaves: eight roundings
/// of 2^-24, magnified by the largest term of `A` over `A`. And every refusal leaves a range without the value.
#[test]
fn an_accepted_groove_has_curvatures_up_to_the_edges() {
    let mut random = Random(20);
    let (mut accepted, mut folded) = (0, 0);
    for _ in 0..400_000 {
        let groove = random.of(&GROOVES);
        let (surface, angle) = edge(&mut random, groove);
        let (sin, cos) = surface.lead_angle.sin_cos();
        let (curvature, torsion) = (
            cos * cos / surface.pitch_radius,
            sin * cos / surface.pitch_radius,
        );
        let path = HelixPath {
            curvature: curvature as f32,
            torsion: torsion as f32,
        };
        let profile = GrooveProfile {
            groove_radius: surface.groove_radius as f32,
            offset_h: surface.offset_h as f32,
            offset_l: surface.offset_l as f32,
        };
        let arch = match GothicArch::checked(groove, &path, &profile, angle) {
            Ok(arch) => arch,
            Err(error) => {
                assert!(
                    !error.allowed().contains(error.value()),
                    "{error}: {path:?} {profile:?} {angle:?}"
                );
                folded += i32::from(matches!(error, Error::FoldedGroove { .. }));
                continue;
            }
        };
        accepted += 1;
        let found = arch.principal(angle);
        let truth = surface.principal(f64::from(angle.sin).atan2(f64::from(angle.cos)));
        let truth = [truth.kappa1, truth.kappa2];
        let scale = truth[0].abs().max(truth[1].abs());
        let radius = surface.groove_radius;
        let offset = curvature * surface.offset_h;
        let bent = curvature * radius * f64::from(angle.cos);
        let area = 1.0 + surface.groove.sign() * (offset - bent);
        let magnified = (1.0 + offset + bent + torsion * radius) / area;
        let allowed = 8.0 * 2f64.powi(-24) * magnified;
        for (found, truth) in [found.kappa1, found.kappa2].into_iter().zip(truth) {
            let error = (f64::from(found) - truth).abs() / scale;
            assert!(
                error <= allowed,
                "{surface:?} {angle:?}: {found} for {truth}, {error:e} of {allowed:e}"
            );
        }
    }
    assert!(accepted > 150_000 && folded > 50_000);
}

#[test]
fn every_design_has_curvatures_at_every_contact_angle() {
    let mut random = Random(21);
    for _ in 0..20_000 {
        let design = random_scenes::design(&mut random);
        for groove in GROOVES {
            let angle = ContactAngle::new(random.unit() * std::f32::consts::FRAC_PI_2);
            for angle in [ContactAngle::new(0.0), angle, ContactAngle::new(1.5533)] {
                let (path, profile) = (design.path(), design.profile(groove));
                let arch = GothicArch::checked(groove, path, profile, angle);
                assert!(arch.is_ok(), "{design:?} {groove:?} {angle:?}: {arch:?}");
            }
        }
    }
}
