//! Scenes beside each other over one manoeuvre of one screw, for the report.

use super::caged::Caged;
use super::encoder::EncoderStep;
use super::manoeuvre::Manoeuvre;
use super::picture::Moment;
use super::reference::ReferenceModel;
use super::scene::Scene;
use super::uncaged::Uncaged;
use epas_design::files::DesignSource;
use epas_page::failure::Failure;

/// What three scenes say to the same manoeuvre.
pub struct Courses {
    /// Balls in a cage, with the exact ball as its reference.
    pub caged: Vec<Moment>,
    /// The same with memory.
    pub memory: Vec<Moment>,
    /// Balls that press on each other, with memory.
    pub balls: Vec<Moment>,
}

/// A built-in design that says how many balls it has, over a manoeuvre.
pub fn courses(design: &str, manoeuvre: Manoeuvre) -> Result<Courses, Failure> {
    let design = design
        .parse::<DesignSource>()
        .map_err(Failure::Data)?
        .load()?;
    let Some(balls) = design.uncaged else {
        return Err(Failure::Data(format!(
            "{} says nothing of its balls",
            design.name
        )));
    };
    let caged = |memory, reference| {
        let scene = Caged {
            design: design.clone(),
            memory,
            encoder: EncoderStep::default(),
            temperature: false,
        };
        let trace = scene.manoeuvre(manoeuvre)?;
        let (rows, _) = scene.rows(&trace, reference, &|| ())?;
        scene.moments(&trace, &rows)
    };
    let row = Uncaged {
        design: design.clone(),
        balls,
        memory: true,
        encoder: EncoderStep::default(),
    };
    let trace = row.manoeuvre(manoeuvre)?;
    let (rows, _) = row.rows(&trace, None, &|| ())?;
    let points = row.points(&trace, &rows);
    Ok(Courses {
        caged: caged(false, Some(ReferenceModel::Exact))?,
        memory: caged(true, None)?,
        balls: points.into_iter().map(|point| point.moment).collect(),
    })
}
