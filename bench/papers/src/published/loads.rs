//! The computable numbers of Lin 2019 on static loads: chapter 2, appendix B, section 4.2.

use super::Computed;
use crate::load_studies::lash::{LashTest, Pattern, spread};
use crate::load_studies::tie_rod;
use epas_reference::error::ReferenceError;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::contact::GrooveContact;
use epas_reference::statics::{Contact, ContactConstants, Elastic, HertzConvention};

/// Case study 2: the 17th ball 1 um too large in radius.
pub fn case_2() -> CaseStudy {
    let mut ball_oversize = vec![0.0; 32];
    ball_oversize[16] = 1e-6;
    CaseStudy {
        ball_oversize,
        ..CaseStudy::table_2_1()
    }
}

/// Case study 3: all balls 7 um too large, and the right end 300 um aside or free.
pub fn case_3(offset: bool) -> CaseStudy {
    CaseStudy {
        ball_oversize: vec![7e-6],
        end_offset: offset.then_some(300e-6),
        ..CaseStudy::table_2_1()
    }
}

/// Hertzian constants of Table 2.1's screw and nut as printed: with a conformity of 0.56.
fn table_b_1() -> Result<Vec<f64>, ReferenceError> {
    let row = |contact: GrooveContact| {
        let [small, large] = contact.relative_radii;
        let [across, along] = contact.principal_radii;
        let radii = [across, along, small, large, (small * large).sqrt()];
        let ellipse = [
            contact.eccentricity,
            contact.deflection,
            contact.semi_major,
            contact.semi_minor,
        ];
        ellipse.into_iter().chain(radii.map(|radius| 1e3 * radius))
    };
    let mut geometry = CaseStudy::table_2_1().geometry;
    geometry.groove_radius = 0.56 * 2.0 * geometry.ball_radius;
    let convention = HertzConvention::Dissertation;
    let both = ContactConstants::of_one_material(&geometry, Elastic::STEEL, convention)?;
    Ok(row(both.screw).chain(row(both.nut)).collect())
}

fn ratio(forces: &[f64]) -> f64 {
    let largest = forces.iter().copied().fold(0.0, f64::max);
    largest / forces.iter().copied().fold(f64::INFINITY, f64::min)
}

pub(super) fn computed() -> Result<Computed, ReferenceError> {
    let nominal = CaseStudy::table_2_1().load()?.solve()?;
    let fine = CaseStudy {
        screw_diameter: 30.8e-3,
        refinement: 4,
        ..CaseStudy::table_2_1()
    };
    let fine = fine.load()?.solve()?;
    let test = LashTest {
        oversize: 2e-6,
        steps: 21,
    };
    let mut lash = [[0.0; 4]; 2];
    for (index, pattern) in Pattern::ALL.into_iter().enumerate() {
        let range = test.axial(pattern, 200.0)? - test.axial(pattern, -200.0)?;
        lash[0][index] = 0.5 * range;
        lash[1][index] = test.conical(pattern, 10.0)?;
    }
    let [straight, turned] =
        [tie_rod::at(0.0)?, tie_rod::at(18_f64.to_radians())?].map(|at| at.largest());
    Ok(vec![
        (
            "Figure 2.9 and section 2.4.1.1",
            vec![
                ratio(&nominal.of(Contact::ScrewLeft)),
                ratio(&fine.of(Contact::ScrewLeft)),
            ],
        ),
        (
            "Table 2.2",
            vec![nominal.positions.len() as f64 - 1.0, 7.35 * 3600.0 / 3.87],
        ),
        ("Table 3.6", vec![3.254 / (2.0 * 2.778)]),
        ("Table B.1", table_b_1()?),
        (
            "Figure 4.3 and section 4.2.1",
            lash.map(|values| 100.0 * spread(&values)).into(),
        ),
        (
            "section 4.2.2 and Figure 4.5",
            [0, 1].map(|body| turned[body] / straight[body]).into(),
        ),
    ])
}
