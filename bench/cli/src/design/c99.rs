//! A caged screw as two files of C99, with a memory by its design, or by its calibration where that has one.

use std::path::{Path, PathBuf};

use epas_calibrate::outputs::firmware::{self, Numbers};
use epas_design::Folded;
use epas_design::c99::{Elements, Files, Memory};
use epas_design::files::Design;
use epas_friction::law::coefficient::CoefficientParameters;
use epas_friction::{Error, defaults};

use crate::simulate::remembering::by_design;
use epas_page::failure::Failure;

/// What C99 has, for who asks for more.
pub const HAS: &str = "C99 has the caged screw by a folded block, with and without memory; a screw whose balls press on each other and closed \
                       forms run from C by the static library (bench/c-abi)";

/// The header beside a source.
pub fn header(source: &Path) -> PathBuf {
    source.with_extension("h")
}

/// The files of a folded design, for functions with a name and a file of another one.
pub fn files(folded: &Folded, design: &Design, names: [&str; 2]) -> Result<Files, Failure> {
    Ok(folded.c99(names, &memory(folded, design)?)?)
}

/// Refuses, before anything is folded, what C99 does not have: of a design whose balls press on each other, or not.
pub fn check(design: &Design, presses: bool) -> Result<(), Failure> {
    if presses || design.branch.is_some() {
        Err(Failure::Data(format!("{}: {HAS}", design.name)))
    } else {
        Ok(())
    }
}

/// The memory of a design.
fn memory(folded: &Folded, design: &Design) -> Result<Memory, Failure> {
    let refused = |error: Error| Failure::Data(format!("{}: {error}", design.name));
    let constant =
        || CoefficientParameters::constant(design.caged.friction, defaults::COEFFICIENT.viscosity);
    let law = firmware::law(design)?.unwrap_or_else(constant);
    let numbers = Numbers::of(design)?;
    let (elements, reference_load) = if let Some(reference) = &numbers.reference {
        (numbers.elements(reference), reference.load)
    } else {
        // In the middle of the domain, by ratios.
        let [least, largest] = folded.fold.axial_load;
        let load = f32::from(design.caged.loaded_balls) * (least * largest).sqrt();
        let made = by_design(&design.caged, load);
        (made.map(|made| Elements::Proportional(made.elements)), load)
    };
    Ok(Memory {
        elements: elements.map_err(refused)?,
        reference_load,
        law,
    })
}
