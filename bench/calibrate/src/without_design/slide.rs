//! A trace without a design: a mass or an inertia with friction and a load, in the trace's own coordinate.
//!
//! `effort(t - delay) + known = I a + viscous drag of each direction + level T(motion) + offset + stiffness x + slope x T + deviation(x)
//! + load + loss |load| T(motion)`, with a law of friction `T` of unit level ([`crate::laws`]) and a loss of its own for
//! driving (`load T > 0`: motor power flows to the load) and back-driving (`load T < 0`: the load drives the motor).

use std::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Scale, Separable};
use crate::laws::{Law, Scales};
use crate::signals::{Motion, Rows};
use crate::trace::known::KnownEffort;
use crate::trace::{Coordinate, Trace};
use crate::without_design::resistance::{Numbers, SlideResistance};
use crate::without_design::terms::{LoadTerm, Terms};

/// A model of a trace without a design.
pub struct Slide<'a> {
    motion: &'a Motion,
    load: Option<&'a [f64]>,
    known: Option<&'a [f64]>,
    rows: &'a Rows,
    law: Law,
    terms: Terms,
    scales: Scales,
    middle: f64,
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
    target: Vec<f64>,
    /// What the law does not change, by the delay.
    kept: Mutex<Vec<(f64, Arc<Steady>)>>,
}

/// Rows that the law does not change.
struct Steady {
    /// What has no parameter: a load that is given, less what is known beside the effort.
    fixed: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

/// Delays whose columns are kept: that of a point, and those of its slope.
const KEPT: usize = 3;

/// Names of what is accelerated.
pub const INERTIA: [&str; 2] = ["inertia", "mass"];
/// Name of the drag over the speed.
pub const DRAG: &str = "viscous_friction";
const FORWARD: &str = "viscous_friction_forward";
const BACKWARD: &str = "viscous_friction_backward";
/// Name of the friction without a load.
pub const LEVEL: &str = "coulomb_friction";
/// Name of the level and the drag together.
pub const AT_ONE_SPEED: &str = "friction_at_one_speed";
/// Name of the effort that is always there.
pub const OFFSET: &str = "offset";
const STIFFNESS: &str = "position_stiffness";
const SLOPE: &str = "friction_slope";
const COSINE: &str = "deviation_cosine";
const SINE: &str = "deviation_sine";
/// Name of the effort of a unit of load.
pub const GAIN: &str = "load_gain";
/// Name of the loss of both directions of power, of a unit of load.
pub const LOSS: &str = "load_loss";
/// Names of the losses of driving and back-driving, over the load's effort.
pub const LOSSES: [&str; 2] = ["driving_loss", "back_driving_loss"];
const DELAY: &str = "effort_delay";

/// Units by coordinate: rotation, translation.
struct Units {
    inertia: &'static str,
    drag: &'static str,
    effort: &'static str,
    length: &'static str,
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
            length: "rad",
            speed: "rad/s",
            stiffness: "N m/rad",
            gain: "m/rad",
        },
        Coordinate::Translation => Units {
            inertia: "kg",
            drag: "N s/m",
            effort: "N",
            length: "m",
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
        let mut nonlinear = law.parameters(&scales, [units.length, units.speed]);
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
        let load = trace
            .load
            .as_deref()
            .filter(|_| terms.load != LoadTerm::None);
        Self {
            motion,
            load,
            known: trace.known.as_ref().and_then(KnownEffort::beside),
            rows,
            law,
            terms,
            scales,
            middle: middle(&motion.position),
            nonlinear,
            linear: linear(trace.coordinate, terms),
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

    /// What does not depend on the law, as rows so many ticks later: columns in the order of [`Separable::linear`] without those of the
    /// friction. Most evaluations differ by the law alone: the last ones are kept.
    fn steady(&self, ticks: f64) -> Arc<Steady> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, steady)) = kept.iter().find(|(at, _)| *at == ticks) {
            return Arc::clone(steady);
        }
        let signals = self.signals();
        let steady = Arc::new(Steady {
            fixed: self.fixed(ticks),
            columns: signals
                .iter()
                .map(|signal| self.row(signal, ticks))
                .collect(),
        });
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((ticks, Arc::clone(&steady)));
        steady
    }

    /// Rows of what has no parameter.
    fn fixed(&self, ticks: f64) -> Vec<f64> {
        let mut fixed = vec![0.0; self.target.len()];
        let given = self.load.filter(|_| !self.terms.load.has_gain());
        for (signal, sign) in given
            .map(|load| (load, 1.0))
            .into_iter()
            .chain(self.known.map(|known| (known, -1.0)))
        {
            for (sum, row) in fixed.iter_mut().zip(self.row(signal, ticks)) {
                *sum += sign * row;
            }
        }
        fixed
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
        if let Some(load) = self.load.filter(|_| self.terms.load.has_gain()) {
            columns.push(load.to_vec());
        }
        columns
    }

    /// Columns of the friction: of its level, of its slope over the position where it is wanted, and of the load's losses.
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
        let losses = self.losses(friction);
        columns.extend(losses.iter().map(|loss| self.row(loss, ticks)));
        columns
    }

    /// Unit losses of the load: `|load| T` where the motor drives the load, where the load drives the motor, or throughout.
    fn losses(&self, friction: &[f64]) -> Vec<Vec<f64>> {
        let Some(load) = self.load else {
            return Vec::new();
        };
        let of = |counts: fn(f64) -> bool| -> Vec<f64> {
            let both = load.iter().zip(friction);
            both.map(|(load, friction)| {
                if counts(load * friction) {
                    load.abs() * friction
                } else {
                    0.0
                }
            })
            .collect()
        };
        if self.terms.load == LoadTerm::LossAlike {
            return vec![of(|_| true)];
        }
        let [driving, back_driving] = self.terms.load.losses();
        let mut losses = Vec::new();
        if driving {
            losses.push(of(|power| power > 0.0));
        }
        if back_driving {
            losses.push(of(|power| power < 0.0));
        }
        losses
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
        let alike = value(LOSS);
        Ok(SlideResistance::new(
            self.law.friction(&self.scales, nonlinear)?,
            Numbers {
                level: value(LEVEL) + value(AT_ONE_SPEED),
                drag: [value(FORWARD) + both, value(BACKWARD) + both],
                offset: value(OFFSET),
                middle: self.middle,
                stiffness: value(STIFFNESS),
                slope: value(SLOPE),
                deviation: [value(COSINE), value(SINE)],
                wavenumber: self.terms.period.map_or(0.0, |period| TAU / period),
                gain: match self.terms.load {
                    LoadTerm::Losses { .. } if self.load.is_some() => 1.0,
                    _ => value(GAIN),
                },
                losses: LOSSES.map(|name| value(name) + alike),
            },
        ))
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
        travel: (high - low).max(f64::MIN_POSITIVE),
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

fn linear(coordinate: Coordinate, terms: Terms) -> Vec<LinearParameter> {
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
    if terms.load.has_gain() {
        linear.push(free(GAIN, units.gain));
    }
    let level = if terms.one_speed { AT_ONE_SPEED } else { LEVEL };
    linear.push(positive(level, units.effort));
    if terms.position {
        linear.push(free(SLOPE, units.stiffness));
    }
    if terms.load == LoadTerm::LossAlike {
        linear.push(positive(LOSS, units.gain));
    }
    for (name, told) in LOSSES.into_iter().zip(terms.load.losses()) {
        if told {
            linear.push(positive(name, ""));
        }
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
        let steady = self.steady(ticks);
        let mut columns = steady.columns.clone();
        columns.extend(self.frictional(&self.friction(nonlinear), ticks));
        Evaluation {
            fixed: steady.fixed.clone(),
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
