//! The contact ellipse against exact elliptic integrals.

use epas_friction::hertz::HertzContact;
use epas_reference::hertz::Hertz;

use super::Context;
use super::statistics::{Errors, evenly};
use crate::report::draw::{chart, figure, table};
use epas_page::document::{Block, Cell, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

const PARTS: [&str; 5] = [
    "axis ratio",
    "semi-major axis",
    "semi-minor axis",
    "deflection",
    "largest pressure",
];

/// Errors of the five parts over radius ratios 1 to 1e5, with the ratio of each.
fn sweep(quick: bool) -> Result<Vec<(f64, [f64; 5])>, Failure> {
    const MODULUS: f32 = 113.9e9;
    const SMALL: f32 = 2.5e-3;
    evenly(0.0, 4.999, if quick { 200 } else { 2000 })
        .map(|exponent| {
            let large = (f64::from(SMALL) * 10f64.powf(exponent)) as f32;
            let fast = HertzContact::checked(SMALL, large, MODULUS)?;
            let exact = Hertz::new(f64::from(SMALL), f64::from(large), f64::from(MODULUS))?;
            let error = |computed: f32, exact: f64| f64::from(computed) / exact - 1.0;
            Ok((
                f64::from(large) / f64::from(SMALL),
                [
                    error(fast.axis_ratio(), exact.axis_ratio),
                    error(fast.semi_major_coefficient(), exact.semi_major),
                    error(fast.semi_minor_coefficient(), exact.semi_minor),
                    error(fast.deflection_coefficient(), exact.deflection),
                    error(fast.max_pressure_coefficient(), exact.max_pressure),
                ],
            ))
        })
        .collect()
}

pub fn largest_error(quick: bool) -> Result<Errors, Failure> {
    Ok(sweep(quick)?
        .into_iter()
        .flat_map(|(_, errors)| errors)
        .collect())
}

pub fn section(context: &Context) -> Result<Section, Failure> {
    let sweep = sweep(context.quick)?;
    let mut rows = Vec::new();
    let mut series = Vec::new();
    for (index, part) in PARTS.into_iter().enumerate() {
        let errors: Errors = sweep.iter().map(|(_, errors)| errors[index]).collect();
        rows.push(vec![
            Cell::from(part),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
        ]);
        let points = sweep
            .iter()
            .map(|(ratio, errors)| (*ratio, errors[index].abs().max(1e-9)))
            .collect();
        series.push(Series::new(part, index, Mark::Line, points));
    }
    // Hamrock and Brewe's power of the ratio, which most programs use.
    let customary = sweep
        .iter()
        .filter_map(|(ratio, _)| {
            let exact = epas_reference::hertz::axis_ratio(*ratio).ok()?;
            let brewe = 1.0 / (1.0339 * ratio.powf(0.636));
            Some((*ratio, (brewe / exact - 1.0).abs()))
        })
        .collect();
    series.push(Series::new(
        "axis ratio after Brewe and Hamrock 1977",
        6,
        Mark::Dashed,
        customary,
    ));
    Ok(Section {
        title: "Contact ellipse",
        blocks: vec![
            Block::Table(table(
                "hertz_errors",
                "Errors of the crate's contact ellipse in f32 against exact elliptic integrals, \
                          ratios of the relative radii 1 to 1e5",
                "quantity | largest | rms | mean",
                rows,
            )),
            figure(
                "hertz",
                "Errors of the contact ellipse over the ratio of the relative radii; a groove of \
                          conformity 0.528 has a ratio of about 20.",
                (1, 1080, 420),
                vec![chart(
                    "",
                    Axis::log("larger over smaller relative radius"),
                    Axis::log("relative error").between(1e-8, 0.1),
                    series,
                )],
            ),
        ],
    })
}
