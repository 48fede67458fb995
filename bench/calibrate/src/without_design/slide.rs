//! A trace without a design with a law of friction that may remember: every row, turns and rests among them, as a separable problem.
//!
//! ```text
//! effort = J a + b_f max(w, 0) + b_b min(w, 0) + offset + k x + tau + wave(x) + (T_C + c x + loss |tau|) T(x, w; law)
//! ```
//!
//! `T` is a law's friction of unit level, `x` counts from the middle of the way; the effort acts with a delay. Every term passes the kernel of the estimator.

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

/// Most samples at which a law of friction is followed, and most rows: models are compared on every so many samples of a longer trace.
const SAMPLES: usize = 25_000;
const ROWS: usize = 6_000;

/// A trace with its smoothed motion, at every so many of its samples, and its rows.
pub struct Prepared<'a> {
    /// The trace.
    pub trace: &'a Trace,
    /// Its motion.
    pub motion: Smoothed,
    /// Its load, smoothed.
    load: Vec<f64>,
    /// Time between these samples, s.
    tick: f64,
    /// Half way between the farthest places, rad or m.
    middle: f64,
    /// Kernel over these samples.
    kernel: Kernel,
    /// Rows, as numbers of these samples.
    centres: Vec<usize>,
    target: Vec<f64>,
    known: Option<Delayed>,
}

/// A column with its rate: `value + delay rate` where it comes later.
#[derive(Clone, Debug)]
struct Delayed {
    value: Vec<f64>,
    rate: Vec<f64>,
}

impl Delayed {
    fn at(&self, delay: f64) -> Vec<f64> {
        let both = self.value.iter().zip(&self.rate);
        both.map(|(value, rate)| value + delay * rate).collect()
    }
}

impl<'a> Prepared<'a> {
    /// With the shortest kernel through which hardly any noise of the sensor passes into the acceleration.
    pub fn new(trace: &'a Trace, record: &Record) -> Self {
        let of = |length: f64| ((length / trace.step).round() as usize).max(FEWEST);
        let sharp = |half: &usize| {
            let kernel = Kernel::new(*half, trace.step);
            let order = record.order(2);
            let at = (0..record.len()).step_by(*half);
            let sizes: Vec<f64> = at.map(|k| kernel.at(order, &record.motion, k)).collect();
            record.noise_in(&kernel, 2) <= NOISE * size(&sizes)
        };
        let half = LENGTHS.map(of).into_iter().find(sharp);
        let half = half.unwrap_or_else(|| of(LENGTHS[LENGTHS.len() - 1]));
        let stride = trace.len().div_ceil(SAMPLES).clamp(1, half);
        // Both kernels are equally long: (half + 1) ticks.
        let short = ((half + 1) / stride).max(2) - 1;
        let half = (short + 1) * stride - 1;
        let whole = Kernel::new(half, trace.step);
        let samples = || (0..trace.len()).step_by(stride);
        let smooth = |order: usize, signal: &[f64]| -> Vec<f64> {
            samples().map(|k| whole.at(order, signal, k)).collect()
        };
        let places = if record.speed_alone {
            &record.path
        } else {
            &record.motion
        };
        let motion = Smoothed {
            position: smooth(0, places),
            speed: smooth(record.order(1), &record.motion),
            acceleration: smooth(record.order(2), &record.motion),
            noise: [1, 2].map(|k| record.noise_in(&whole, k)),
        };
        let tick = stride as f64 * trace.step;
        let count = motion.speed.len();
        let hop = count.div_ceil(ROWS);
        let centres: Vec<usize> = (0..count)
            .step_by(hop)
            .filter(|centre| {
                let middle = centre * stride;
                middle >= half && record.sound(middle - half, middle + half)
            })
            .collect();
        let rows = |order: usize, signal: &[f64]| -> Vec<f64> {
            let at = |centre: &usize| whole.at(order, signal, centre * stride);
            centres.iter().map(at).collect()
        };
        let known = trace.known.as_ref().and_then(KnownEffort::beside);
        let known = known.map(|known| Delayed {
            value: rows(0, known),
            rate: rows(1, known),
        });
        let (low, high) = range(&trace.position);
        Self {
            load: trace
                .load
                .as_deref()
                .map_or_else(Vec::new, |load| smooth(0, load)),
            target: rows(0, &trace.effort),
            known,
            kernel: Kernel::new(short, tick),
            middle: 0.5 * (low + high),
            trace,
            motion,
            tick,
            centres,
        }
    }

    /// Positions of the rows, rad or m.
    pub fn places(&self) -> Vec<f64> {
        self.picked(&self.motion.position)
    }

    fn picked(&self, signal: &[f64]) -> Vec<f64> {
        self.centres.iter().map(|centre| signal[*centre]).collect()
    }

    fn rate(&self, signal: &[f64]) -> Vec<f64> {
        let at = |centre: &usize| self.kernel.at(1, signal, *centre);
        self.centres.iter().map(at).collect()
    }

    /// A signal that is smooth already.
    fn smooth(&self, signal: &[f64]) -> Delayed {
        Delayed {
            value: self.picked(signal),
            rate: self.rate(signal),
        }
    }

    /// A signal with corners, behind the kernel.
    fn filtered(&self, signal: &[f64]) -> Delayed {
        let at = |centre: &usize| self.kernel.at(0, signal, *centre);
        Delayed {
            value: self.centres.iter().map(at).collect(),
            rate: self.rate(signal),
        }
    }

    fn scales(&self) -> Scales {
        let (low, high) = range(&self.motion.position);
        let speed = self.motion.speed.iter();
        let speed = speed.fold(0.0_f64, |most, speed| most.max(speed.abs()));
        Scales {
            speed: speed.max(f64::MIN_POSITIVE),
            travel: (high - low).max(f64::MIN_POSITIVE),
            resolution: self.trace.resolution,
            tick: self.tick,
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
    /// What the law does not change.
    steady: Vec<Delayed>,
    /// A load that is given.
    fixed: Option<Delayed>,
}

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
            steady: steady(prepared, &beside),
            fixed: fixed(prepared, &beside),
            beside,
        }
    }

    /// Rows of the friction and of the load's losses.
    fn frictional(&self, nonlinear: &[f64], delay: f64) -> Vec<Vec<f64>> {
        let motion = &self.prepared.motion;
        let friction = match self.law.friction(&self.scales, nonlinear) {
            Ok(law) => law.along(&motion.position, &motion.speed, self.scales.tick),
            Err(_) => vec![0.0; motion.position.len()],
        };
        let row = |signal: &[f64]| self.prepared.filtered(signal).at(delay);
        let mut columns = vec![row(&friction)];
        if self.beside.position {
            let middle = self.prepared.middle;
            let places = motion.position.iter().zip(&friction);
            let sloped: Vec<f64> = places
                .map(|(x, friction)| (x - middle) * friction)
                .collect();
            columns.push(row(&sloped));
        }
        for term in &self.beside.load {
            let counts: fn(f64) -> bool = match term {
                Term::Driving => |power| power > 0.0,
                Term::BackDriving => |power| power < 0.0,
                Term::Loss => |_| true,
                _ => continue,
            };
            let lost = self.prepared.load.iter().zip(&friction);
            let lost = lost.map(|(load, friction)| {
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

/// Columns that the law does not change, in the order of [`linear`].
fn steady(prepared: &Prepared<'_>, beside: &Beside) -> Vec<Delayed> {
    let Smoothed {
        position,
        speed,
        acceleration,
        ..
    } = &prepared.motion;
    let of = |signal: &[f64], of: &dyn Fn(f64) -> f64| -> Vec<f64> {
        signal.iter().map(|x| of(*x)).collect()
    };
    let mut columns = vec![prepared.smooth(acceleration)];
    if beside.rich {
        columns.push(prepared.filtered(&of(speed, &|w| w.max(0.0))));
        columns.push(prepared.filtered(&of(speed, &|w| w.min(0.0))));
    } else {
        columns.push(prepared.smooth(speed));
    }
    columns.push(prepared.smooth(&vec![1.0; speed.len()]));
    if beside.position {
        columns.push(prepared.smooth(&of(position, &|x| x - prepared.middle)));
    }
    if let Some(wave) = beside.wave {
        columns.push(prepared.filtered(&of(position, &|x| (wave * x).sin())));
        columns.push(prepared.filtered(&of(position, &|x| (wave * x).cos())));
    }
    if beside.load.contains(&Term::Gain) {
        columns.push(prepared.smooth(&prepared.load));
    }
    columns
}

/// The load where its effort has no parameter.
fn fixed(prepared: &Prepared<'_>, beside: &Beside) -> Option<Delayed> {
    let given = prepared.trace.load_is_effort && !prepared.load.is_empty();
    (given && !beside.load.contains(&Term::Gain)).then(|| prepared.smooth(&prepared.load))
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
        &self.prepared.target
    }

    fn row_step(&self) -> f64 {
        let hop = self.prepared.motion.speed.len().div_ceil(ROWS);
        hop as f64 * self.scales.tick
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let delay = self.delay(nonlinear);
        let mut fixed = vec![0.0; self.prepared.target.len()];
        for (known, sign) in [(&self.fixed, 1.0), (&self.prepared.known, -1.0)] {
            if let Some(known) = known {
                for (sum, value) in fixed.iter_mut().zip(known.at(delay)) {
                    *sum += sign * value;
                }
            }
        }
        let mut columns: Vec<Vec<f64>> = self.steady.iter().map(|of| of.at(delay)).collect();
        columns.extend(self.frictional(nonlinear, delay));
        Evaluation { fixed, columns }
    }
}

/// Root mean square of values.
pub fn size(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value.powi(2)).sum();
    (squares / values.len().max(1) as f64).sqrt()
}
