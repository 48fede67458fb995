//! Models of friction on one trace without a design: each fitted as well as it can be, and scored on what was not fitted.

use crate::answer::ModelScore;
use crate::estimator::words::strongest_wave;
use crate::fit::problem::Separable;
use crate::fit::search::{Found, at_bound, fit};
use crate::laws::{Cost, Law, Level, Passage};
use crate::models::{self, FITTED, LITERATURE, OWN};
use crate::without_design::closed_loop::{Course, Loop};
use crate::without_design::controller::SeenController;
use crate::without_design::slide::{Beside, Prepared, Slide};
use epas_page::failure::Failure;

/// The friction of the crate's scene for a drive without a drawing: constant, in proportion to the load, passing with the speed.
pub const LOAD_PROPORTIONAL: Law = Law {
    name: "this crate, load-proportional losses",
    level: Level::Constant,
    passage: Passage::Speed,
    cost: Cost::Counted(&["step_load_proportional"]),
};

const OURS: Law = OWN[1];

pub type Compared<'a> = (&'a Prepared<'a>, Option<&'a SeenController>);

pub fn scores(
    fitted: Compared<'_>,
    unseen: Option<Compared<'_>>,
    beside: &Beside,
) -> Vec<(String, Result<ModelScore, Failure>)> {
    let plain = beside.plain();
    let shown = Beside {
        wave: beside.wave.or_else(|| wave(fitted.0, beside)),
        ..beside.clone()
    };
    let still = Beside {
        position: false,
        ..beside.clone()
    };
    let first = LITERATURE[0];
    let mut models = vec![(first, &plain, first.name.to_string())];
    if !beside.load.is_empty() {
        models.push((LOAD_PROPORTIONAL, &plain, LOAD_PROPORTIONAL.name.into()));
    }
    for law in LITERATURE.into_iter().chain(OWN) {
        let others = if law == first {
            ", with the drive's other terms"
        } else {
            ""
        };
        models.push((law, &shown, format!("{}{others}", law.name)));
    }
    let name = format!("{}, without terms of the position", OURS.name);
    models.push((OURS, &still, name));
    let score = |(law, beside, name): (Law, &Beside, String)| {
        let scored = score(fitted, unseen, law, beside, &name);
        (name, scored)
    };
    models.into_iter().map(score).collect()
}

impl Beside {
    fn plain(&self) -> Self {
        Self {
            wave: self.wave,
            load: self.load.clone(),
            ..Self::default()
        }
    }
}

/// Share of the residual of the crate's law with memory that a wave of the position takes to be in the models.
const SHARE: f64 = 0.05;

/// The wave number of a wave over the position that the crate's law with memory leaves, 1/rad or 1/m.
fn wave(prepared: &Prepared<'_>, beside: &Beside) -> Option<f64> {
    let slide = Slide::new(prepared, OURS, beside);
    let left = fit(&slide).ok()?.residual;
    let places = prepared.places();
    let (wave, share) = strongest_wave(&places, &left)?;
    (share > SHARE).then_some(wave)
}

fn course(
    (prepared, controller): Compared<'_>,
    slide: &Slide<'_>,
    found: &Found,
) -> Result<Option<Course>, Failure> {
    let Some(controller) = controller else {
        return Ok(None);
    };
    let resistance = slide
        .resistance(&found.nonlinear, &found.linear)
        .map_err(|error| Failure::Data(error.to_string()))?;
    let inertia = found.linear.first().copied().unwrap_or(0.0);
    let closed = Loop {
        trace: prepared.trace,
        speed: prepared.motion.speed.first().copied().unwrap_or(0.0),
        controller,
    };
    Ok((inertia > 0.0).then(|| closed.run(inertia, resistance, slide.delay(&found.nonlinear))))
}

/// Fits a model to a trace, and scores it on another trace, or on the last third of this one; by the closed loop where the controller is
/// known.
fn score(
    fitted: Compared<'_>,
    unseen: Option<Compared<'_>>,
    law: Law,
    beside: &Beside,
    name: &str,
) -> Result<ModelScore, Failure> {
    let slide = Slide::new(fitted.0, law, beside);
    let other = unseen.map(|other| (other, Slide::new(other.0, law, beside)));
    let unseen = other.as_ref().map(|(_, slide)| slide as &dyn Separable);
    let (mut score, found) = models::score((name, law.cost), &slide, unseen)?;
    if let Some(closed) = course(fitted, &slide, &found)? {
        score.relative_error = closed.relative_error;
        score.position_error = Some(closed.position_error);
        let unseen = match &other {
            Some((other, slide)) => {
                course(*other, slide, &found)?.map(|course| course.relative_error)
            }
            None => Some(closed.error_after(fitted.0.trace, FITTED)),
        };
        score.relative_error_unseen = unseen.or(score.relative_error_unseen);
    }
    Ok(score)
}

/// The speed over which friction reverses, rad/s or m/s, by the whole trace; `None` where it is sharper than the trace shows.
pub fn reversal_speed(prepared: &Prepared<'_>, beside: &Beside) -> Result<Option<f64>, Failure> {
    let slide = Slide::new(prepared, LOAD_PROPORTIONAL, &beside.plain());
    let found = fit(&slide)?;
    let speed = slide.nonlinear().iter().zip(&found.nonlinear).next();
    Ok(speed
        .filter(|(of, speed)| !at_bound(of, **speed))
        .map(|(_, speed)| *speed))
}
