//! A trace without a design: a mass or an inertia with friction that knows no load, in the trace's own coordinate.
//!
//! `effort(t - delay) = I a + viscous drag of each direction + level T(motion) + offset + stiffness x + slope x T + deviation(x)`,
//! with a law of friction `T` of unit level ([`crate::calibrate::laws`]).

use std::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

use crate::calibrate::fit::problem::{Evaluation, LinearParameter, Parameter, Scale, Separable};
use crate::calibrate::laws::{Friction, Law, Scales};
use crate::calibrate::signals::{Motion, Rows};
use crate::calibrate::trace::{Coordinate, Trace};
use crate::mechanism::{Resistance, Step};

/// What stands beside the law of friction.
// Each is a term that may be left out.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// Drag that differs between the directions.
    pub drag_of_each_direction: bool,
    /// Effort that grows with the position, as of a cable chain, and friction that does.
    pub position: bool,
    /// Period of a deviation along the way, rad or m.
    pub period: Option<f64>,
    /// Axial load, as an effort with a gain.
    pub load: bool,
    /// Delay between the effort as it is written down and as it acts.
    pub delay: bool,
    /// Whether the trace moves at one speed: drag and level are one number.
    pub one_speed: bool,
}

/// A model of a trace without a design.
pub struct Slide<'a> {
    motion: &'a Motion,
    load: Option<&'a [f64]>,
    rows: &'a Rows,
    law: Law,
    terms: Terms,
    scales: Scales,
    middle: f64,
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
    target: Vec<f64>,
    /// Columns that the law does not change, by the delay.
    kept: Mutex<Vec<(f64, Columns)>>,
}

/// Columns of rows, shared.
type Columns = Arc<Vec<Vec<f64>>>;

/// Delays whose columns are kept: that of a point, and those of its slope.
const KEPT: usize = 3;

/// Names of the linear parameters, in the order of their columns.
const INERTIA: [&str; 2] = ["inertia", "mass"];
const DRAG: &str = "viscous_friction";
const FORWARD: &str = "viscous_friction_forward";
const BACKWARD: &str = "viscous_friction_backward";
const LEVEL: &str = "coulomb_friction";
/// Name of the level and the drag together.
pub const AT_ONE_SPEED: &str = "friction_at_one_speed";
const OFFSET: &str = "offset";
const STIFFNESS: &str = "position_stiffness";
const SLOPE: &str = "friction_slope";
const COSINE: &str = "deviation_cosine";
const SINE: &str = "deviation_sine";
const GAIN: &str = "load_gain";
const DELAY: &str = "effort_delay";

/// Units by coordinate: rotation, translation.
struct Units {
    inertia: &'static str,
    drag: &'static str,
    effort: &'static str,
    way: &'static str,
    speed: &'static str,
    stiffness: &'static str,
    gain: &'static str,
}

const fn units(coordinate: Coordinate) -> Units {
    match coordinate {
        Coordinate::Rotation => Units {
            inertia: "kg m^2",
            drag: "N m s/rad",
            effort: "N m",
            way: "rad",
            speed: "rad/s",
            stiffness: "N m/rad",
            gain: "m/rad",
        },
        Coordinate::Translation => Units {
            inertia: "kg",
            drag: "N s/m",
            effort: "N",
            way: "m",
            speed: "m/s",
            stiffness: "N/m",
            gain: "",
        },
    }
}

const fn free(name: &'static str, unit: &'static str) -> LinearParameter {
    LinearParameter {
        name,
        unit,
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    }
}

const fn positive(name: &'static str, unit: &'static str) -> LinearParameter {
    LinearParameter {
        low: 0.0,
        ..free(name, unit)
    }
}

impl<'a> Slide<'a> {
    /// The model of a trace by a law.
    pub fn new(
        trace: &'a Trace,
        motion: &'a Motion,
        rows: &'a Rows,
        law: Law,
        terms: Terms,
    ) -> Self {
        let scales = scales(trace, motion);
        let units = units(trace.coordinate);
        let mut nonlinear = law.parameters(&scales, [units.way, units.speed]);
        if terms.delay {
            nonlinear.push(Parameter {
                name: DELAY,
                unit: "s",
                start: 0.5 * trace.step,
                low: -5.0 * trace.step,
                high: 5.0 * trace.step,
                scale: Scale::Linear,
            });
        }
        let load = trace.load.as_deref().filter(|_| terms.load);
        Self {
            motion,
            load,
            rows,
            law,
            terms,
            scales,
            middle: middle(&motion.position),
            nonlinear,
            linear: linear(trace.coordinate, terms, load.is_some()),
            target: rows.of(&trace.effort),
            kept: Mutex::default(),
        }
    }

    /// The law's friction at these nonlinear parameters, at every sample; nothing where the crate refuses them.
    fn friction(&self, nonlinear: &[f64]) -> Vec<f64> {
        let Ok(friction) = self.law.friction(&self.scales, nonlinear) else {
            return vec![0.0; self.motion.position.len()];
        };
        friction.along(&self.motion.position, &self.motion.speed, self.scales.tick)
    }

    /// Columns that do not depend on the law, in the order of [`Separable::linear`] without those of the friction, as rows so many ticks
    /// later. Most evaluations differ by the law alone: the last ones are kept.
    fn steady(&self, ticks: f64) -> Columns {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, columns)) = kept.iter().find(|(at, _)| *at == ticks) {
            return Arc::clone(columns);
        }
        let signals = self.signals();
        let rows = signals.iter().map(|signal| self.row(signal, ticks));
        let columns = Arc::new(rows.collect::<Vec<_>>());
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((ticks, Arc::clone(&columns)));
        columns
    }

    /// A signal as rows, so many ticks later.
    fn row(&self, signal: &[f64], ticks: f64) -> Vec<f64> {
        self.rows.of(&advanced(signal, ticks))
    }

    /// The signals of [`Self::steady`].
    fn signals(&self) -> Vec<Vec<f64>> {
        let Motion {
            position,
            speed,
            acceleration,
            ..
        } = self.motion;
        let mut columns = vec![acceleration.clone()];
        if self.terms.one_speed {
            // Nothing beside the level.
        } else if self.terms.drag_of_each_direction {
            columns.push(speed.iter().map(|speed| speed.max(0.0)).collect());
            columns.push(speed.iter().map(|speed| speed.min(0.0)).collect());
        } else {
            columns.push(speed.clone());
        }
        columns.push(vec![1.0; position.len()]);
        if self.terms.position {
            columns.push(position.iter().map(|place| place - self.middle).collect());
        }
        if let Some(period) = self.terms.period {
            let angle = |position: &f64| TAU * position / period;
            columns.push(position.iter().map(|place| angle(place).cos()).collect());
            columns.push(position.iter().map(|place| angle(place).sin()).collect());
        }
        if let Some(load) = self.load {
            columns.push(load.to_vec());
        }
        columns
    }

    /// Columns of the friction: of its level, and of its slope over the position where it is wanted.
    fn frictional(&self, friction: &[f64], ticks: f64) -> Vec<Vec<f64>> {
        let mut columns = vec![self.row(friction, ticks)];
        if self.terms.position {
            let sloped: Vec<f64> = self
                .motion
                .position
                .iter()
                .zip(friction)
                .map(|(position, friction)| (position - self.middle) * friction)
                .collect();
            columns.push(self.row(&sloped, ticks));
        }
        columns
    }

    /// What opposes the motion at a fit's parameters.
    ///
    /// # Errors
    /// [`epas_friction::Error`] naming a parameter that the crate refuses.
    pub fn resistance(
        &self,
        nonlinear: &[f64],
        linear: &[f64],
    ) -> Result<SlideResistance, epas_friction::Error> {
        let value = |name: &str| {
            let named = self.linear.iter().zip(linear);
            named
                .filter(|(parameter, _)| parameter.name == name)
                .map(|(_, value)| *value)
                .sum::<f64>()
        };
        let both = value(DRAG);
        Ok(SlideResistance {
            friction: self.law.friction(&self.scales, nonlinear)?,
            level: value(LEVEL) + value(AT_ONE_SPEED),
            drag: [value(FORWARD) + both, value(BACKWARD) + both],
            offset: value(OFFSET),
            middle: self.middle,
            stiffness: value(STIFFNESS),
            slope: value(SLOPE),
            deviation: [value(COSINE), value(SINE)],
            wavenumber: self.terms.period.map_or(0.0, |period| TAU / period),
            gain: value(GAIN),
            load: 0.0,
        })
    }

    /// Delay of the effort at a fit's parameters, s.
    pub fn delay(&self, nonlinear: &[f64]) -> f64 {
        let delays = self.nonlinear.iter().zip(nonlinear);
        delays
            .filter(|(parameter, _)| parameter.name == DELAY)
            .map(|(_, value)| *value)
            .sum()
    }
}

/// What a motion is like.
fn scales(trace: &Trace, motion: &Motion) -> Scales {
    let extreme = |values: &[f64], pick: fn(f64, f64) -> f64| {
        values.iter().copied().reduce(pick).unwrap_or(0.0)
    };
    let (low, high) = (
        extreme(&motion.position, f64::min),
        extreme(&motion.position, f64::max),
    );
    let speed = motion
        .speed
        .iter()
        .map(|speed| speed.abs())
        .fold(0.0, f64::max);
    Scales {
        speed: speed.max(f64::MIN_POSITIVE),
        way: (high - low).max(f64::MIN_POSITIVE),
        resolution: trace.resolution,
        tick: trace.step,
    }
}

/// Half way between the farthest places.
fn middle(position: &[f64]) -> f64 {
    let low = position.iter().copied().fold(f64::INFINITY, f64::min);
    let high = position.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (low + high)
}

fn linear(coordinate: Coordinate, terms: Terms, load: bool) -> Vec<LinearParameter> {
    let units = units(coordinate);
    let inertia = match coordinate {
        Coordinate::Rotation => INERTIA[0],
        Coordinate::Translation => INERTIA[1],
    };
    let mut linear = vec![positive(inertia, units.inertia)];
    if terms.one_speed {
        // Nothing beside the level.
    } else if terms.drag_of_each_direction {
        linear.extend([FORWARD, BACKWARD].map(|name| free(name, units.drag)));
    } else {
        linear.push(free(DRAG, units.drag));
    }
    linear.push(free(OFFSET, units.effort));
    if terms.position {
        linear.push(free(STIFFNESS, units.stiffness));
    }
    if terms.period.is_some() {
        linear.extend([COSINE, SINE].map(|name| free(name, units.effort)));
    }
    if load {
        linear.push(free(GAIN, units.gain));
    }
    let level = if terms.one_speed { AT_ONE_SPEED } else { LEVEL };
    linear.push(positive(level, units.effort));
    if terms.position {
        linear.push(free(SLOPE, units.stiffness));
    }
    linear
}

impl Separable for Slide<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.target
    }

    fn row_step(&self) -> f64 {
        self.rows.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let ticks = self.delay(nonlinear) / self.scales.tick;
        let mut columns = self.steady(ticks).to_vec();
        columns.extend(self.frictional(&self.friction(nonlinear), ticks));
        Evaluation {
            fixed: vec![0.0; self.target.len()],
            columns,
        }
    }
}

/// A signal as it will be so many ticks later, between samples by a line; its ends stay.
fn advanced(signal: &[f64], ticks: f64) -> Vec<f64> {
    if ticks == 0.0 || signal.is_empty() {
        return signal.to_vec();
    }
    let last = signal.len() - 1;
    (0..signal.len())
        .map(|sample| {
            let place = (sample as f64 + ticks).clamp(0.0, last as f64);
            let before = place.floor() as usize;
            let part = place - before as f64;
            let after = (before + 1).min(last);
            signal[before] + part * (signal[after] - signal[before])
        })
        .collect()
}

/// What opposes the motion of a slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlideResistance {
    friction: Friction,
    level: f64,
    drag: [f64; 2],
    offset: f64,
    middle: f64,
    stiffness: f64,
    slope: f64,
    deviation: [f64; 2],
    wavenumber: f64,
    gain: f64,
    /// Axial load, N.
    pub load: f64,
}

impl SlideResistance {
    fn with(&self, friction: f64, step: &Step) -> f64 {
        let place = step.position - self.middle;
        let (sine, cosine) = (self.wavenumber * step.position).sin_cos();
        let [forward, backward] = self.drag;
        let speed = step.end_speed;
        let drag = if speed > 0.0 { forward } else { backward };
        // Friction never drives, however steep its slope.
        let level = (self.level + self.slope * place).max(0.0);
        level * friction
            + drag.max(0.0) * speed
            + self.offset
            + self.stiffness * place
            + self.deviation[0] * cosine
            + self.deviation[1] * sine
            + self.gain * self.load
    }
}

impl Resistance for SlideResistance {
    fn against(&self, step: &Step) -> f64 {
        let mut friction = self.friction;
        self.with(friction.follow(step), step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        let friction = self.friction.follow(step);
        self.with(friction, step)
    }
}
