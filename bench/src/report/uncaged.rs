//! The ball screw without cage: the scene against the exact whole screw, pairs of its balls against exact pairs.

mod pairs;
mod settings;

use std::time::Instant;

use super::Context;
use super::times::time;
use crate::exact_ring::{Case, Comparison, Off, exact, follow};
use crate::report::draw::table;
use crate::timing;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;

/// The screw of Table 3.6 with 37 balls.
pub struct Flagship {
    /// Scene and exact screw; nothing compared where the screw is not folded.
    pub comparison: Comparison,
    pub refused: Option<String>,
    pub turns: f64,
    /// Time of a state of the exact screw, s.
    pub exact_state: f64,
}

impl Flagship {
    pub fn new(quick: bool) -> Self {
        let (turns, states) = if quick { (0.5, 180) } else { (2.0, 720) };
        let case = Case {
            turns,
            states,
            ..Case::LIN
        };
        let mut exact_state = f64::NAN;
        let followed = case.law().and_then(|_| {
            let start = Instant::now();
            let states = exact::<37>(&case)?;
            exact_state = start.elapsed().as_secs_f64() / states.len() as f64;
            follow::<37>(&case, &states)
        });
        let (comparison, refused) = match followed {
            Ok(comparison) => (comparison, None),
            Err(reason) => (Comparison::default(), Some(reason)),
        };
        Self {
            comparison,
            refused,
            turns,
            exact_state,
        }
    }
}

pub fn section(context: &Context) -> Result<Section, Failure> {
    let mut blocks = vec![
        Block::Text(
            "In every tick the scene evaluates, for each ball, the law of one ball at its load and at the deviations of its grooves, and finds the forces with \
             which the balls press and rub on each other. The law is folded from the design before, on the host. The exact screw has every ball in elastic \
             balance with Coulomb friction by contact integrals, pressing and rubbing on its neighbours by complementarity, in float64 and from other \
             sources."
                .into(),
        ),
        Block::Table(flagship(context)?),
    ];
    blocks.extend(settings::blocks(context.quick));
    blocks.extend(pairs::blocks(context.quick)?);
    Ok(Section {
        title: "Ball screw without cage",
        blocks,
    })
}

fn flagship(context: &Context) -> Result<Table, Failure> {
    let Flagship {
        comparison,
        refused,
        turns,
        exact_state,
    } = &context.flagship;
    let step = timing::times(&context.competition, "step_train_37")?;
    let error = |off: &Off| off.relative().map(Cell::power);
    let off = [
        &comparison.force,
        &comparison.groove,
        &comparison.ball,
        &comparison.speed,
    ];
    let mut scene = vec![Cell::from("scene, tick in f32")];
    for [largest, rms, _] in off.map(error) {
        scene.extend([largest, rms]);
    }
    scene.push(time(&step.latency, 0));
    let mut reference = vec![Cell::from("exact whole screw, state in f64")];
    reference.extend(
        off.iter()
            .flat_map(|_| [Cell::power(0.0), Cell::power(0.0)]),
    );
    reference.push(Cell::power(1e9 * exact_state));
    Ok(table(
        "flagship",
        format!(
            "37 balls of Table 3.6's screw, filled but for a tenth of a ball, 50 N a ball, deviations of 1 degree on the screw and 0.5 degrees in the nut, one turn a second: largest \
             and rms error at the same state over {turns} turns, groove torque over its own exact value, the others over the largest exact one. {}",
            refused.as_ref().map_or_else(
                || {
                    format!(
                        "{:.0} pairs press in the mean; {} states are compared, {} of them flagged; {} have no exact solution",
                        comparison.pressing(), comparison.compared, comparison.flagged, comparison.failed
                    )
                },
                |reason| format!("Not folded: {reason}"),
            ),
        ),
        "model | force | rms | groove torque | rms | ball torque | rms | speed | rms | \
         time of a tick or state (ns)",
        vec![scene, reference],
    ))
}
