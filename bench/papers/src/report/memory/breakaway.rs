//! Stiffness and breakaway of built-in designs.

use epas_design::breakaway::{Breakaway, BreakawayConfiguration, Mechanism, ScrewContacts};
use epas_friction::{BallScrew, Clearance, DISSERTATION_DESIGNS, defaults};

use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

/// Axial loads, N.
const LOADS: [f32; 3] = [300.0, 1000.0, 5000.0];

/// Radial gaps of every contact, m.
const GAPS: [f32; 3] = [-1e-6, 0.0, 20e-6];

/// The table.
pub fn blocks() -> Result<Vec<Block>, Failure> {
    let mut rows = Vec::new();
    for design in &DISSERTATION_DESIGNS[1..] {
        let screw = BallScrew::new(design.parameters)?;
        for load in LOADS {
            for gap in GAPS {
                let contact_load =
                    ScrewContacts::of(&screw).contact_load(load, design.loaded_balls);
                let breakaway = Breakaway::of(
                    &screw,
                    &BreakawayConfiguration {
                        friction: defaults::FRICTION,
                        clearance: Clearance::new(gap)?,
                        rolling_resistance: defaults::ROLLING_RESISTANCE,
                        loaded_balls: design.loaded_balls,
                        contact_load,
                    },
                )?;
                rows.push(row(design.name, load, gap, &breakaway));
            }
        }
    }
    let columns = [
        "design",
        "axial load (N)",
        "clearance (um)",
        "torque (mN m)",
        "stiffness (N m/rad)",
        "slip in the contacts alone (mrad)",
        "slip: share",
        "angle (mrad)",
        "spin: share",
        "angle (mrad)",
        "rolling resistance: share",
        "angle (mrad)",
    ];
    Ok(vec![Block::Table(table(
        "memory_breakaway",
        "Stiffness and breakaway of designs, friction coefficient 0.1: torque of sliding, stiffness at rest, and for each mechanism its share of the torque and the angle over which it comes. \
         Clearance decides: where a ball does not lie against a third point of its grooves it first drifts to its seat. So the angle of slip should be identified on \
         the screw where it matters",
        &columns,
        rows,
    ))])
}

fn row(name: &str, load: f32, gap: f32, breakaway: &Breakaway) -> Vec<Cell> {
    let mut cells = vec![
        Cell::from(name),
        Cell::fixed(load.into(), 0),
        Cell::fixed(1e6 * f64::from(gap), 0),
        Cell::fixed(1e3 * f64::from(breakaway.torque), 1),
        Cell::fixed(breakaway.stiffness().into(), 1),
        Cell::fixed(1e3 * f64::from(breakaway.contact_angle), 2),
    ];
    for mechanism in [
        Mechanism::Slip,
        Mechanism::Spin,
        Mechanism::RollingResistance,
    ] {
        let part = breakaway.part(mechanism);
        cells.push(Cell::fixed(part.share.into(), 3));
        cells.push(if part.share > 0.0 {
            Cell::fixed(1e3 * f64::from(part.breakaway_angle), 2)
        } else {
            "".into()
        });
    }
    cells
}
