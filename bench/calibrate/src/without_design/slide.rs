//! A trace without a design with a law of friction that may remember: every row, turns and rests among them, as a separable problem.
//!
//! ```text
//! effort = J a + b_f max(w, 0) + b_b min(w, 0) + offset + k x + tau + wave(x) + (T_C + c x + loss |tau|) T(x, w; law)
//! ```
//!
//! `T` is a law's friction of unit level, `x` counts from the middle of the way; the effort acts with a delay. Every term passes the kernel of the estimator.

use std::sync::{Arc, Mutex, PoisonError};

use crate::estimator::kernel::Kernel;
use crate::estimator::record::{Record, Smoothed};
use crate::estimator::terms::Term;
use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Scale, Separable};
use crate::laws::{Law, Scales};
use crate::trace::channels::range;
use crate::trace::known::KnownEffort;
use crate::trace::{Coordinate, Trace};
use crate::without_design::resistance::{Numbers, SlideResistance};

/// Noise of the acceleration over its own root mean square that is let pass.
const NOISE: f64 = 0.05;

/// Kernel's half-widths that are tried, s, and its fewest samples.
const LENGTHS: [f64; 6] = [6e-3, 8.5e-3, 12e-3, 17e-3, 24e-3, 34e-3];
const FEWEST: usize = 4;

/// What stands beside the law.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beside {
    /// Whether the viscous friction differs by direction, and the effort has a delay.
    pub rich: bool,
    /// Whether effort and friction change with the position, as by a cable chain or a nut that pinches.
    pub position: bool,
    /// Wave number of a wave over the position, 1/rad or 1/m.
    pub wave: Option<f64>,
    /// Terms of the load: those of the estimate.
    pub load: Vec<Term>,
}

/// A trace with its smoothed motion and its rows.
pub struct Prepared<'a> {
    /// The trace.
    pub trace: &'a Trace,
    /// Its motion.
    pub motion: Smoothed,
    kernel: Kernel,
    /// Half way between the farthest places, rad or m.
    middle: f64,
    /// Sample at the middle of each row.
    pub centres: Vec<usize>,
}

impl<'a> Prepared<'a> {
    /// With the shortest kernel through which hardly any noise of the sensor passes into the acceleration.
    pub fn new(trace: &'a Trace, record: &Record) -> Self {
        let of = |length: f64| ((length / trace.step).round() as usize).max(FEWEST);
        let sharp = |half: &usize| {
            let kernel = Kernel::new(*half, trace.step);
            let order = record.order(2);
            let weights = kernel.weights(order).iter();
            let noise = record.noise * weights.map(|w| w * w).sum::<f64>().sqrt();
            let at = (0..record.len()).step_by(*half);
            let sizes: Vec<f64> = at.map(|k| kernel.at(order, &record.motion, k)).collect();
            noise <= NOISE * size(&sizes)
        };
        let half = LENGTHS.map(of).into_iter().find(sharp);
        let half = half.unwrap_or_else(|| of(LENGTHS[LENGTHS.len() - 1]));
        let kernel = Kernel::new(half, trace.step);
        let centres = (half..trace.len().saturating_sub(half))
            .step_by((half / 3).max(1))
            .filter(|centre| record.sound(centre - half, centre + half))
            .collect();
        let (low, high) = range(&trace.position);
        Self {
            trace,
            motion: record.smoothed(&kernel),
            middle: 0.5 * (low + high),
            kernel,
            centres,
        }
    }

    fn rows(&self, signal: &[f64]) -> Vec<f64> {
        let at = |centre: &usize| self.kernel.at(0, signal, *centre);
        self.centres.iter().map(at).collect()
    }

    fn scales(&self) -> Scales {
        let (low, high) = range(&self.motion.position);
        let speed = self.motion.speed.iter();
        let speed = speed.fold(0.0_f64, |most, speed| most.max(speed.abs()));
        Scales {
            speed: speed.max(f64::MIN_POSITIVE),
            travel: (high - low).max(f64::MIN_POSITIVE),
            resolution: self.trace.resolution,
            tick: self.trace.step,
        }
    }
}

/// A model of a trace by a law.
pub struct Slide<'a> {
    prepared: &'a Prepared<'a>,
    law: Law,
    beside: Beside,
    scales: Scales,
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
    target: Vec<f64>,
    /// Rows that the law does not change, by the delay: those of a point and of its slope.
    kept: Mutex<Vec<(f64, Arc<Evaluation>)>>,
}

const KEPT: usize = 3;
const DELAY: &str = "effort_delay";
const FORWARD: &str = "viscous_friction_forward";
const STIFFNESS: &str = "position_stiffness";
const SLOPE: &str = "friction_slope";
const BACKWARD: &str = "viscous_friction_backward";

impl<'a> Slide<'a> {
    /// The model of a trace by a law.
    pub fn new(prepared: &'a Prepared<'a>, law: Law, beside: Beside) -> Self {
        let scales = prepared.scales();
        let coordinate = prepared.trace.coordinate;
        let units = match coordinate {
            Coordinate::Rotation => ["rad", "rad/s"],
            Coordinate::Translation => ["m", "m/s"],
        };
        let mut nonlinear = law.parameters(&scales, units);
        if beside.rich {
            let tick = prepared.trace.step;
            nonlinear.push(Parameter {
                name: DELAY,
                unit: "s",
                start: 0.5 * tick,
                low: -5.0 * tick,
                high: 5.0 * tick,
                scale: Scale::Linear,
            });
        }
        Self {
            prepared,
            law,
            scales,
            nonlinear,
            linear: linear(coordinate, &beside),
            beside,
            target: prepared.rows(&prepared.trace.effort),
            kept: Mutex::default(),
        }
    }

    /// What the law does not change, so many ticks later.
    fn steady(&self, ticks: f64) -> Arc<Evaluation> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, steady)) = kept.iter().find(|(at, _)| *at == ticks) {
            return Arc::clone(steady);
        }
        let trace = self.prepared.trace;
        let Smoothed {
            position,
            speed,
            acceleration,
        } = &self.prepared.motion;
        let row = |signal: &[f64]| self.prepared.rows(&advanced(signal, ticks));
        let mut columns = vec![row(acceleration)];
        let part = |of: fn(f64) -> f64| -> Vec<f64> { speed.iter().map(|w| of(*w)).collect() };
        if self.beside.rich {
            columns.push(row(&part(|w| w.max(0.0))));
            columns.push(row(&part(|w| w.min(0.0))));
        } else {
            columns.push(row(speed));
        }
        columns.push(vec![1.0; self.target.len()]);
        if self.beside.position {
            let middle = self.prepared.middle;
            columns.push(row(&position
                .iter()
                .map(|x| x - middle)
                .collect::<Vec<_>>()));
        }
        if let Some(wave) = self.beside.wave {
            for of in [f64::sin, f64::cos] {
                let signal: Vec<f64> = position.iter().map(|x| of(wave * x)).collect();
                columns.push(row(&signal));
            }
        }
        let mut fixed = vec![0.0; self.target.len()];
        let mut add = |signal: &[f64], sign: f64| {
            for (sum, value) in fixed.iter_mut().zip(row(signal)) {
                *sum += sign * value;
            }
        };
        if let Some(load) = &trace.load {
            if self.beside.load.contains(&Term::Gain) {
                columns.push(row(load));
            } else if trace.load_is_effort {
                add(load, 1.0);
            }
        }
        if let Some(known) = trace.known.as_ref().and_then(KnownEffort::beside) {
            add(known, -1.0);
        }
        let steady = Arc::new(Evaluation { fixed, columns });
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((ticks, Arc::clone(&steady)));
        steady
    }

    /// Rows of the friction and of the load's losses.
    fn frictional(&self, nonlinear: &[f64], ticks: f64) -> Vec<Vec<f64>> {
        let motion = &self.prepared.motion;
        let friction = match self.law.friction(&self.scales, nonlinear) {
            Ok(law) => law.along(&motion.position, &motion.speed, self.scales.tick),
            Err(_) => vec![0.0; motion.position.len()],
        };
        let row = |signal: &[f64]| self.prepared.rows(&advanced(signal, ticks));
        let mut columns = vec![row(&friction)];
        if self.beside.position {
            let middle = self.prepared.middle;
            let places = motion.position.iter().zip(&friction);
            let sloped: Vec<f64> = places
                .map(|(x, friction)| (x - middle) * friction)
                .collect();
            columns.push(row(&sloped));
        }
        let load = self.prepared.trace.load.as_deref().unwrap_or(&[]);
        for term in &self.beside.load {
            let counts: fn(f64) -> bool = match term {
                Term::Driving => |power| power > 0.0,
                Term::BackDriving => |power| power < 0.0,
                Term::Loss => |_| true,
                _ => continue,
            };
            let lost = load.iter().zip(&friction).map(|(load, friction)| {
                if counts(load * friction) {
                    load.abs() * friction
                } else {
                    0.0
                }
            });
            columns.push(row(&lost.collect::<Vec<_>>()));
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
        let coordinate = self.prepared.trace.coordinate;
        let value = |name: &str| -> f64 {
            let named = self.linear.iter().zip(linear);
            named
                .filter(|(parameter, _)| parameter.name == name)
                .map(|(_, value)| *value)
                .sum()
        };
        let of = |term: Term| value(term.name(coordinate));
        let (both, alike) = (of(Term::Viscous), of(Term::Loss));
        let own = self.prepared.trace.load_is_effort && !self.beside.load.contains(&Term::Gain);
        Ok(SlideResistance::new(
            self.law.friction(&self.scales, nonlinear)?,
            Numbers {
                level: of(Term::Coulomb),
                drag: [value(FORWARD) + both, value(BACKWARD) + both],
                offset: of(Term::Offset),
                middle: self.prepared.middle,
                stiffness: value(STIFFNESS),
                slope: value(SLOPE),
                wave: [of(Term::Sine(0.0)), of(Term::Cosine(0.0))],
                wavenumber: self.beside.wave.unwrap_or(0.0),
                gain: if own { 1.0 } else { of(Term::Gain) },
                losses: [of(Term::Driving) + alike, of(Term::BackDriving) + alike],
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

fn linear(coordinate: Coordinate, beside: &Beside) -> Vec<LinearParameter> {
    let of = |term: Term, low: f64| LinearParameter {
        name: term.name(coordinate),
        unit: term.unit(coordinate),
        low,
        high: f64::INFINITY,
    };
    let free = |term: Term| of(term, f64::NEG_INFINITY);
    let mut linear = vec![of(Term::Inertia, 0.0)];
    if beside.rich {
        linear.extend([FORWARD, BACKWARD].map(|name| LinearParameter {
            name,
            ..free(Term::Viscous)
        }));
    } else {
        linear.push(free(Term::Viscous));
    }
    linear.push(free(Term::Offset));
    let over_position = |name| LinearParameter {
        name,
        unit: match coordinate {
            Coordinate::Rotation => "N m/rad",
            Coordinate::Translation => "N/m",
        },
        ..free(Term::Offset)
    };
    if beside.position {
        linear.push(over_position(STIFFNESS));
    }
    if let Some(wave) = beside.wave {
        linear.extend([Term::Sine(wave), Term::Cosine(wave)].map(free));
    }
    if beside.load.contains(&Term::Gain) {
        linear.push(free(Term::Gain));
    }
    linear.push(of(Term::Coulomb, 0.0));
    if beside.position {
        linear.push(over_position(SLOPE));
    }
    let losses = beside.load.iter().filter(|term| **term != Term::Gain);
    linear.extend(losses.map(|term| of(*term, 0.0)));
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
        let hop = (self.prepared.kernel.half() / 3).max(1);
        hop as f64 * self.scales.tick
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let ticks = self.delay(nonlinear) / self.scales.tick;
        let mut found = Evaluation::clone(&self.steady(ticks));
        found.columns.extend(self.frictional(nonlinear, ticks));
        found
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

/// Root mean square of values.
pub fn size(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value.powi(2)).sum();
    (squares / values.len().max(1) as f64).sqrt()
}
