//! A caged screw as two files of C99, with a memory by its design, or by its calibration where that has one.

use std::path::{Path, PathBuf};

use epas_calibrate::outputs::firmware::{self, Numbers};
use epas_design::Folded;
use epas_design::c99::{Files, Memory};
use epas_design::files::Design;
use epas_design::files::calibration::ElementsName;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters};
use epas_friction::law::memory::Hysteresis as _;
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
    let (memory, load) = memory(folded, design)?;
    let refused = |error: Error| Failure::Data(format!("{}: {error}", design.name));
    let (least, largest) = CoefficientLaw::new(&memory.law)
        .map_err(refused)?
        .extremes();
    let more = [format!(
        "memory: full sliding after {:.4} mrad of the nut, elements for an axial load of {load:.0} N; friction coefficient {least} to {largest} by \
         speed, temperature and direction",
        1e3 * memory.elements.breakaway(),
    )];
    Ok(folded.c99(names, &memory, &more)?)
}

/// Refuses, before anything is folded, what C99 does not have: of a design whose balls press on each other, or not.
pub fn check(design: &Design, presses: bool) -> Result<(), Failure> {
    let refused = |what: &str| Err(Failure::Data(format!("{}: {what}", design.name)));
    let elements = design.calibrated.as_ref().and_then(|told| told.elements);
    if presses || design.branch.is_some() {
        refused(HAS)
    } else if elements.is_some_and(|elements| elements != ElementsName::Proportional) {
        refused(
            "calibration: elements that follow the load; C99 has those in proportion to friction alone (elements = \"proportional\")",
        )
    } else {
        Ok(())
    }
}

/// The memory of a design, and the axial load, N, for which its elements are.
fn memory(folded: &Folded, design: &Design) -> Result<(Memory, f32), Failure> {
    let refused = |error: Error| Failure::Data(format!("{}: {error}", design.name));
    let constant =
        || CoefficientParameters::constant(design.caged.friction, defaults::COEFFICIENT.viscosity);
    let law = firmware::law(design)?.unwrap_or_else(constant);
    let Numbers {
        screw,
        values,
        reference,
        ..
    } = Numbers::of(design)?;
    let (elements, load) = if let Some(reference) = reference {
        (screw.proportional(&values, &reference), reference.load)
    } else {
        // In the middle of the domain, by ratios.
        let [least, largest] = folded.fold.axial_load;
        let load = f32::from(design.caged.loaded_balls) * (least * largest).sqrt();
        let made = by_design(&design.caged, load);
        (made.map(|made| made.elements), load)
    };
    let elements = elements.map_err(refused)?;
    Ok((Memory { elements, law }, load))
}
