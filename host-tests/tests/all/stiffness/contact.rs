//! One contact: compliance against slip, stiffness against spin, moment of gross spin.

use epas_design::breakaway::ContactStiffness;
use epas_friction::Material;
use epas_friction::curvature::RelativeCurvatures;
use epas_friction::hertz::HertzContact;
use epas_friction::material::contact_modulus;
use epas_reference::hertz::{Hertz, complete_integrals};
use epas_reference::material::Elastic;
use epas_reference::presliding::physics::{
    StickingContact, tangential_compliance, torsion_stiffness,
};

use epas_testkit::errors::Errors;

/// Curvatures of a contact with about this axis ratio: `R2/R1 = (E/k^2 - K)/(K - E)`.
fn curvatures(k: f64) -> RelativeCurvatures {
    let ratio = if k < 1.0 {
        let (first, second) = complete_integrals(k).unwrap();
        (second / (k * k) - first) / (first - second)
    } else {
        1.0
    };
    RelativeCurvatures {
        along: 400.0,
        across: (400.0 / ratio) as f32,
    }
}

fn contact(k: f64, modulus: f32) -> HertzContact {
    HertzContact::new(curvatures(k), modulus)
}

fn elastic(material: &Material) -> Elastic {
    Elastic {
        youngs_modulus: material.youngs_modulus.into(),
        poisson_ratio: material.poisson_ratio.into(),
    }
}

/// `C_a G a`, `C_b G a` and `k_tor/(G a^3)` of the crate under 100 N, `G` being that of both bodies.
fn normalised(contact: &HertzContact, first: &Material, second: &Material) -> [f64; 3] {
    let shear =
        |m: &Material| f64::from(m.youngs_modulus) / (2.0 * (1.0 + f64::from(m.poisson_ratio)));
    let shear = 2.0 / (1.0 / shear(first) + 1.0 / shear(second));
    let stiffness = ContactStiffness::new(contact, first, second);
    let a = f64::from(contact.semi_major_coefficient()) * 100_f64.cbrt();
    [
        f64::from(stiffness.compliance_across(100.0)) * shear * a,
        f64::from(stiffness.compliance_along(100.0)) * shear * a,
        f64::from(stiffness.torsion_stiffness(100.0)) / (shear * a.powi(3)),
    ]
}

fn exact(k: f64, bodies: [(f64, f64); 2]) -> [f64; 3] {
    let [(one, nu_one), (other, nu_other)] = bodies;
    let shear = 2.0 / (1.0 / one + 1.0 / other);
    let [a_one, b_one] = tangential_compliance(k, nu_one);
    let [a_other, b_other] = tangential_compliance(k, nu_other);
    [
        shear * (a_one / one + a_other / other),
        shear * (b_one / one + b_other / other),
        torsion_stiffness(k, bodies) / shear,
    ]
}

fn bodies(first: &Material, second: &Material) -> [(f64, f64); 2] {
    [first, second].map(|m| {
        let (e, nu) = (f64::from(m.youngs_modulus), f64::from(m.poisson_ratio));
        (e / (2.0 * (1.0 + nu)), nu)
    })
}

/// Half a unit of the tables' last digit, 5e-4, and of the crate three times its axis ratio's 1.1e-5.
#[test]
fn tabulated_stiffnesses_of_steel() {
    let steel = bodies(&Material::STEEL, &Material::STEEL);
    let modulus = contact_modulus(&Material::STEEL, &Material::STEEL);
    let slip = [(0.15, 0.962), (0.2, 0.874), (0.3, 0.752), (1.0, 0.430)];
    let spin = [
        (0.1, 0.478),
        (0.15, 0.557),
        (0.2, 0.634),
        (0.3, 0.792),
        (0.5, 1.167),
        (1.0, 2.667),
    ];
    for (place, rows) in [(0, &slip[..]), (2, &spin[..])] {
        for &(k, printed) in rows {
            let reference = exact(k, steel)[place];
            assert!((reference - printed).abs() < 5.0e-4, "{k}: {reference}");
            let found = normalised(&contact(k, modulus), &Material::STEEL, &Material::STEEL);
            let found = found[place];
            assert!((found - printed).abs() < 6e-4, "{k}: {found}");
        }
    }
}

/// Circle: Mindlin's `(2 - nu)/(4 G a)` in every direction, and Reissner and Sagoci's torsion `16/3 G a^3` of a disc, half of it for
/// two bodies in series. The reference to its roundings; the crate to those of some ten operations (1e-6).
#[test]
fn the_circle_is_that_of_the_textbooks() {
    for nu in [0.0, 0.28, 0.5_f32] {
        let material = Material {
            poisson_ratio: nu,
            ..Material::STEEL
        };
        let modulus = contact_modulus(&material, &material);
        let nu = f64::from(nu);
        let limits = [(2.0 - nu) / 4.0, (2.0 - nu) / 4.0, 8.0 / 3.0];
        let reference = exact(1.0, bodies(&material, &material));
        let found = normalised(&contact(1.0, modulus), &material, &material);
        for ((limit, reference), found) in limits.iter().zip(reference).zip(found) {
            // Measured: 1.1e-15.
            assert!((reference / limit - 1.0).abs() < 3.5e-15, "{reference}");
            // The fitted axis ratio of equal radii is within 1.1e-5 of 1, of which the stiffness has up to the third power.
            assert!((found / limit - 1.0).abs() < 4e-5, "{found} {limit}");
        }
    }
}

/// Under 100 N, from the numbers that both are given, each with its own ellipse: steel against steel, ceramic, rubber and a body
/// without contraction. The crate's axis ratio is promised to 1.1e-5, of which a stiffness has up to the third power.
#[test]
fn stiffnesses_are_those_of_the_rays() {
    let soft = Material {
        youngs_modulus: 5e6,
        poisson_ratio: 0.5,
        density: 1000.0,
    };
    let cork = Material {
        poisson_ratio: 0.0,
        ..Material::STEEL
    };
    let mut errors = ["across", "along", "torsion"]
        .map(|name| Errors::of(format!("stiffness of a contact, {name}")));
    for second in [Material::STEEL, Material::SILICON_NITRIDE, soft, cork] {
        let first = Material::STEEL;
        let modulus = contact_modulus(&first, &second);
        let [one, other] = [&first, &second].map(elastic);
        for step in 0..=40 {
            let k = 0.02_f64.powf(1.0 - f64::from(step) / 40.0);
            let relative = curvatures(k);
            let [along, across] = [relative.along, relative.across].map(f64::from);
            let hertz = Hertz::new(1.0 / along, 1.0 / across, one.contact_modulus(&other)).unwrap();
            let exact = StickingContact::new(hertz, &one, &other);
            let [across, along] = exact.compliance(100.0);
            let contact = HertzContact::new(relative, modulus);
            let found = ContactStiffness::new(&contact, &first, &second);
            for (errors, (found, truth)) in errors.iter_mut().zip([
                (found.compliance_across(100.0), across),
                (found.compliance_along(100.0), along),
                (found.torsion_stiffness(100.0), exact.torsion(100.0)),
            ]) {
                errors.add_at(
                    f64::from(found) / truth - 1.0,
                    format_args!("axis ratio {k}, {second:?}"),
                );
            }
        }
    }
    for errors in errors {
        errors.assert_measured();
    }
}

/// The moment of gross spin is that of the friction map of a contact, `3/8 E`: the reference integrates the distance from the
/// centre; the crate within its ellipse's 1e-5 and four roundings.
#[test]
fn gross_spin_is_the_mean_distance() {
    for ratio in [1.0, 3.0, 20.0, 200.0] {
        let hertz = Hertz::new(1.0 / 400.0, ratio / 400.0, 113.932e9).unwrap();
        let exact = StickingContact::new(hertz, &Elastic::STEEL, &Elastic::STEEL);
        let relative = RelativeCurvatures {
            along: 400.0,
            across: 400.0 / ratio as f32,
        };
        let contact = HertzContact::new(relative, 113.932e9);
        let found = ContactStiffness::new(&contact, &Material::STEEL, &Material::STEEL);
        for load in [1.0_f32, 300.0] {
            let truth = exact.spin_moment(0.1, f64::from(load));
            let error = f64::from(found.spin_moment(0.1, load)) / truth - 1.0;
            assert!(error.abs() < 1.5e-5, "{ratio}: {error}");
        }
    }
}
