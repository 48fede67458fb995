//! Printed numbers of the four papers, and their values computed again: [`records`]; with the tables of Bertolino et al. 2023 as
//! printed.

pub mod balls;
pub mod bearings;
mod curvature;
pub mod efficiency;
pub mod kinematics;
pub mod loads;
mod radius_tables;

pub use radius_tables::{CONFORMITY, Row, TABLE_A1, TABLE_A2, computed_errors, radius_errors};

use std::error::Error;

use crate::record::{Page, Paper, Record};

/// The printed numbers of the four papers, in the order of the papers: all that can be computed, and those that cannot because the
/// text leaves out what the computation needs.
///
/// # Errors
/// None for the printed cases; the types of the models' own errors.
pub fn records() -> Result<Vec<Record>, Box<dyn Error>> {
    let mut records = Vec::new();
    curvature::append(&mut Page::new(&mut records, Paper::Bertolino2023))?;
    efficiency::append(&mut Page::new(&mut records, Paper::LinVelinskyRavani1994));
    kinematics::append(&mut Page::new(&mut records, Paper::Alberdi))?;
    loads::append(&mut Page::new(&mut records, Paper::Lin2019))?;
    bearings::append(&mut Page::new(&mut records, Paper::Lin2019))?;
    balls::append(&mut Page::new(&mut records, Paper::Lin2019))?;
    Ok(records)
}
