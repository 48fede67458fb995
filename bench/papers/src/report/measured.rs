//! Measured and catalogue figures beside computed ones: what real screws do, and what decides it.

mod cold;
mod deciding;
mod efficiency;

use crate::measured::cold::Lubricant;
use crate::measured::{COUNT, Measured, Standing, Usual, records, studies};
use epas_friction::defaults;
use epas_reference::friction::rolling_resistance::RollingResistance;

use super::Context;
use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::progress::Progress;

/// The crate's defaults, widened for the reference.
pub fn usual() -> Usual {
    // 0.1 and not the f32 next to it.
    let decimal = |value: f32| value.to_string().parse().unwrap_or(f64::from(value));
    Usual {
        friction: decimal(defaults::FRICTION),
        clearance: decimal(defaults::CLEARANCE.gap()),
        rolling: RollingResistance {
            hysteresis_loss: decimal(defaults::ROLLING_RESISTANCE.hysteresis_loss),
            lubricant_drag: decimal(defaults::ROLLING_RESISTANCE.lubricant_drag),
        },
    }
}

fn lubricant() -> Lubricant {
    let law = defaults::COEFFICIENT;
    let at = |celsius: f32| {
        let viscosity = law.viscosity.at(celsius + 273.15);
        (f64::from(celsius), f64::from(viscosity))
    };
    Lubricant {
        viscosities: [at(-40.0), at(40.0)],
        density: 850.0,
        flooding: defaults::FLOODING.into(),
        coefficients: [law.boundary.into(), law.full_film.into()],
        half_share_speed: law.half_share_speed.into(),
    }
}

pub fn section(_: &Context) -> Result<Section, Failure> {
    let usual = usual();
    let progress = Progress::new(
        "measured figures",
        COUNT
            + studies::SCREWS.len() * studies::BALL_LOADS.len()
            + studies::LOADS.len() * studies::FRICTIONS.len() * studies::CLEARANCES.len()
            + studies::CHOICE_COUNT,
    );
    let step = || progress.step();
    let records = records(&usual, &step)?;
    let rows = studies::efficiency_over_lead(&usual, &step);
    let deciding = studies::what_decides(&step);
    let choices = studies::choices(&usual, &step);
    let count = |standing: Standing| {
        records
            .iter()
            .filter(|record| record.standing == standing)
            .count()
    };
    let mut blocks = vec![
        Block::Text(format!(
            "{COUNT} figures of real screws beside the exact float64 model of a ball between its grooves (elastic balance, Coulomb friction \
             of every contact that carries, rolling resistance), with the crate's defaults: friction coefficient {}, {} um of oversize, \
             {} % of the elastic energy lost, no lubricant drag but for the figure in the cold. {} lie within their bands, {} outside, {} agree in kind, {} are not \
             computed. No figure comes with geometry, lubricant and seals complete; what was assumed stands beside it. A band is never \
             narrower than 15 %: two screws of one batch differ by 29 %. Left out by the model: wipers and seals, the balls' return, balls that \
             rub on each other, unequal shares of the load.",
            usual.friction,
            -1e6 * usual.clearance,
            100.0 * usual.rolling.hysteresis_loss,
            count(Standing::Within),
            count(Standing::Apart),
            count(Standing::InKind),
            count(Standing::NotComputed),
        )),
        Block::Table(verdicts(&records)),
        Block::Annex(sources(&records)),
    ];
    blocks.extend(efficiency::blocks(&rows));
    blocks.extend(deciding::blocks(&deciding, &choices));
    blocks.extend(cold::blocks(&usual, &lubricant())?);
    Ok(Section {
        title: "Against measured and catalogue figures",
        blocks,
    })
}

fn verdicts(records: &[Measured]) -> Table {
    let row = |record: &Measured| {
        vec![
            Cell::from(record.what.as_str()),
            record.figure.as_str().into(),
            record.computed.clone().into(),
            record.standing.name().into(),
        ]
    };
    table(
        "measured_verdicts",
        "Against measured and catalogue figures: makers' rules by friction torque; the table \"measured\" has sources and what would have to be what",
        "what | figure | computed | verdict",
        records.iter().map(row).collect(),
    )
}

fn sources(records: &[Measured]) -> Table {
    let row = |record: &Measured| {
        vec![
            Cell::from(record.what.as_str()),
            record.source.as_str().into(),
            record.needed.clone().into(),
        ]
    };
    table(
        "measured",
        "Sources of these figures, and what the model would need to meet them",
        "what | source | what would have to be what, or is missing",
        records.iter().map(row).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../measured.md");

    #[test]
    fn the_page_has_every_figure() {
        let rows: Vec<String> = records(&usual(), &|| ())
            .unwrap()
            .iter()
            .map(|record| {
                let cells = [
                    &record.what,
                    &record.figure,
                    &record.computed,
                    record.standing.name(),
                    &record.source,
                    &record.needed,
                ];
                format!("| {} |", cells.join(" | "))
            })
            .collect();
        let page = std::fs::read_to_string(PAGE).unwrap();
        let printed: Vec<&str> = page
            .lines()
            .filter(|line| line.starts_with("| "))
            .skip(1)
            .collect();
        assert!(
            printed == rows,
            "bench/measured.md should have the rows\n{}",
            rows.join("\n")
        );
    }
}
