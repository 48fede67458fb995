//! Traces of the built-in manoeuvres.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use epas_friction::BallScrew;
use epas_page::failure::Failure;

pub use epas_design::manoeuvre::Manoeuvre;

use super::samples::{LinearSample, ScrewSample};
use super::trace::Trace;

pub fn names() -> impl TypedValueParser<Value = Manoeuvre> {
    let values = Manoeuvre::ALL.map(|(_, name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(values).map(|name| {
        let named = Manoeuvre::ALL.into_iter().find(|(_, own, _)| *own == name);
        named.map_or(Manoeuvre::Parking, |(manoeuvre, ..)| manoeuvre)
    })
}

/// The trace of a linear bearing; refused for a manoeuvre of another mechanism.
pub fn linear_trace(manoeuvre: Manoeuvre) -> Result<Trace<LinearSample>, Failure> {
    if manoeuvre != Manoeuvre::Stroke {
        return Err(Failure::Data(format!(
            "{} is a manoeuvre of a ball screw; the one of a linear bearing is stroke",
            manoeuvre.name()
        )));
    }
    let samples = manoeuvre.moments().into_iter().map(|moment| LinearSample {
        time: moment.time,
        speed: moment.speed,
        normal_load: moment.force,
        side_load: moment.side,
    });
    Ok(Trace {
        name: manoeuvre.name().into(),
        samples: samples.collect(),
    })
}

/// The trace of one design; refused for a manoeuvre of another mechanism.
pub fn trace(manoeuvre: Manoeuvre, design: &BallScrew) -> Result<Trace<ScrewSample>, Failure> {
    let Some(moments) = manoeuvre.of_nut(design) else {
        return Err(Failure::Data(if manoeuvre == Manoeuvre::Stroke {
            "stroke is the manoeuvre of a linear bearing".into()
        } else {
            "a manoeuvre is rack travel, and a design without lead makes none".into()
        }));
    };
    let samples = moments
        .into_iter()
        .map(|moment| ScrewSample::new(moment.time, moment.speed, moment.force));
    Ok(Trace {
        name: manoeuvre.name().into(),
        samples: samples.collect(),
    })
}
