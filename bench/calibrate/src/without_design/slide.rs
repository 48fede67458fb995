//! A trace without a design with a law of friction that may remember: every row, turns and rests among them, as a separable problem.
//!
//! ```text
//! effort = J a + b_f max(w, 0) + b_b min(w, 0) + offset + k x + tau + wave(x) + (T_C + c x + loss |tau|) T(x, w; law)
//! ```
//!
//! `T` is a law's friction of unit level, `x` counts from the middle of the way; the effort acts with a delay. Every term passes the kernel of the
//! estimator. [`SlideResistance`] is the same sum at an instant, as what opposes a motion.

use std::ops::Range;

use crate::estimator::kernel::Kernel;
use crate::estimator::record::{Record, Smoothed};
use crate::estimator::terms::Term;
use crate::fit::problem::{Evaluation, Parameter, Scale, Separable};
use crate::laws::{Friction, Law, Scales};
use crate::mechanism::{Resistance, Step};
use crate::trace::KnownEffort;
use crate::trace::channels::range;
use crate::trace::{Coordinate, Trace};

const FEWEST: usize = 4;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beside {
    /// Whether the viscous friction differs by direction, and the effort has a delay.
    pub rich: bool,
    /// Whether effort and friction change with the position, as by a cable chain or a nut that pinches.
    pub position: bool,
    /// Wave number of a wave over the position, 1/rad or 1/m.
    pub wave: Option<f64>,
    pub load: Vec<Term>,
}

/// Most samples at which a law of friction is followed, and most rows: models are compared on every so many samples of a longer trace.
const SAMPLES: usize = 25_000;
const ROWS: usize = 6_000;

/// A trace with its smoothed motion, at every so many of its samples, and its rows.
pub struct Prepared<'a> {
    pub trace: &'a Trace,
    pub motion: Smoothed,
    load: Vec<f64>,
    /// Time between these samples, s.
    tick: f64,
    /// Half way between the farthest places, rad or m.
    middle: f64,
    kernel: Kernel,
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
    /// With a kernel of a half-width, s.
    pub fn new(trace: &'a Trace, record: &Record, length: f64) -> Self {
        let half = ((length / trace.step).round() as usize).max(FEWEST);
        let stride = trace.len().div_ceil(SAMPLES).clamp(1, half);
        // Both kernels are equally long: (half + 1) ticks.
        let short = ((half + 1) / stride).max(2) - 1;
        let half = (short + 1) * stride - 1;
        let whole = Kernel::new(half, trace.step);
        let motion = Smoothed::by(record, &whole, stride);
        let tick = stride as f64 * trace.step;
        let count = motion.speed.len();
        let centres: Vec<usize> = (0..count)
            .step_by(count.div_ceil(ROWS))
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
        let load = trace.load.as_deref();
        let samples = (0..trace.len()).step_by(stride);
        Self {
            load: samples
                .map(|k| load.map_or(0.0, |load| whole.at(0, load, k)))
                .collect(),
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

    pub fn places(&self) -> Vec<f64> {
        let at = |centre: &usize| self.motion.position[*centre];
        self.centres.iter().map(at).collect()
    }

    /// A signal in every row: as it is where it is smooth already, else behind the kernel.
    fn column(&self, signal: &[f64], smooth: bool) -> Delayed {
        let rows = |of: &dyn Fn(usize) -> f64| self.centres.iter().map(|k| of(*k)).collect();
        Delayed {
            value: rows(&|centre| {
                if smooth {
                    signal[centre]
                } else {
                    self.kernel.at(0, signal, centre)
                }
            }),
            rate: rows(&|centre| self.kernel.at(1, signal, centre)),
        }
    }
}

struct Instant {
    position: f64,
    place: f64,
    speed: f64,
    acceleration: f64,
    load: f64,
    friction: f64,
    /// Wave number of a wave over the position.
    wave: f64,
}

struct Addend {
    parameter: Parameter,
    of: fn(&Instant) -> f64,
    /// Whether that is smooth where motion and load are.
    smooth: bool,
    rubs: bool,
}

pub struct Slide<'a> {
    prepared: &'a Prepared<'a>,
    law: Law,
    scales: Scales,
    wave: f64,
    /// Effort of a unit of load that has no parameter.
    own_load: f64,
    nonlinear: Vec<Parameter>,
    linear: Vec<Parameter>,
    addends: Vec<Addend>,
    /// Which of them make the level of the friction without a load.
    level: Range<usize>,
    /// Columns that the law does not change, the first ones.
    steady: Vec<Delayed>,
    fixed: Delayed,
}

const DELAY: &str = "effort_delay";
const FORWARD: &str = "viscous_friction_forward";
const BACKWARD: &str = "viscous_friction_backward";
const STIFFNESS: &str = "position_stiffness";
const SLOPE: &str = "friction_slope";

impl Addend {
    fn new([name, unit]: [&'static str; 2], of: fn(&Instant) -> f64) -> Self {
        Self {
            parameter: Parameter::linear(name, unit, f64::NEG_INFINITY),
            of,
            smooth: false,
            rubs: false,
        }
    }

    const fn smooth(mut self) -> Self {
        self.smooth = true;
        self
    }

    const fn rubs(mut self) -> Self {
        self.rubs = true;
        self
    }

    const fn not_negative(mut self) -> Self {
        self.parameter.low = 0.0;
        self
    }
}

/// Terms of the sum, those that follow the law last.
fn addends(coordinate: Coordinate, beside: &Beside) -> Vec<Addend> {
    let named = |term: Term| [term.name(coordinate), term.unit(coordinate)];
    let of = |term: Term, of: fn(&Instant) -> f64| Addend::new(named(term), of);
    let over_position = match coordinate {
        Coordinate::Rotation => "N m/rad",
        Coordinate::Translation => "N/m",
    };
    let inertia = of(Term::Inertia, |at| at.acceleration);
    let mut all = vec![inertia.smooth().not_negative()];
    if beside.rich {
        let [_, unit] = named(Term::Viscous);
        all.push(Addend::new([FORWARD, unit], |at| at.speed.max(0.0)));
        all.push(Addend::new([BACKWARD, unit], |at| at.speed.min(0.0)));
    } else {
        all.push(of(Term::Viscous, |at| at.speed).smooth());
    }
    all.push(of(Term::Offset, |_| 1.0).smooth());
    if beside.position {
        all.push(Addend::new([STIFFNESS, over_position], |at| at.place).smooth());
    }
    if let Some(wave) = beside.wave {
        all.push(of(Term::Sine(wave), |at| (at.wave * at.position).sin()));
        all.push(of(Term::Cosine(wave), |at| (at.wave * at.position).cos()));
    }
    if beside.load.contains(&Term::Gain) {
        all.push(of(Term::Gain, |at| at.load).smooth());
    }
    all.push(of(Term::Coulomb, |at| at.friction).rubs().not_negative());
    if beside.position {
        let slope = Addend::new([SLOPE, over_position], |at| at.place * at.friction);
        all.push(slope.rubs());
    }
    for term in &beside.load {
        let lost: fn(&Instant) -> f64 = match term {
            Term::Driving => |at| (at.load * at.friction).max(0.0) * at.friction.signum(),
            Term::BackDriving => |at| (-at.load * at.friction).max(0.0) * at.friction.signum(),
            Term::Loss => |at| at.load.abs() * at.friction,
            _ => continue,
        };
        all.push(of(*term, lost).rubs().not_negative());
    }
    all
}

impl<'a> Slide<'a> {
    pub fn new(prepared: &'a Prepared<'a>, law: Law, beside: &Beside) -> Self {
        let (motion, trace) = (&prepared.motion, prepared.trace);
        let scales = Scales::of(
            (&motion.position, &motion.speed),
            trace.resolution,
            prepared.tick,
        );
        let units = match trace.coordinate {
            Coordinate::Rotation => ["rad", "rad/s"],
            Coordinate::Translation => ["m", "m/s"],
        };
        let mut nonlinear = law.parameters(&scales, units);
        if beside.rich {
            nonlinear.push(Parameter {
                name: DELAY,
                unit: "s",
                start: 0.5 * trace.step,
                low: -5.0 * trace.step,
                high: 5.0 * trace.step,
                scale: Scale::Linear,
            });
        }
        let addends = addends(trace.coordinate, beside);
        let first = addends.iter().filter(|of| !of.rubs).count();
        let given = trace.load_is_effort && !beside.load.contains(&Term::Gain);
        let fixed = prepared.column(&prepared.load, true);
        let mut slide = Self {
            prepared,
            law,
            scales,
            wave: beside.wave.unwrap_or(0.0),
            own_load: f64::from(u8::from(given)),
            nonlinear,
            linear: addends.iter().map(|of| of.parameter.clone()).collect(),
            level: first..first + 1 + usize::from(beside.position),
            addends,
            steady: Vec::new(),
            fixed,
        };
        let still = vec![0.0; motion.position.len()];
        slide.steady = slide.columns(0..first, &still);
        slide
    }

    /// Columns of some terms with a friction of unit level at every sample.
    fn columns(&self, which: Range<usize>, friction: &[f64]) -> Vec<Delayed> {
        let Prepared { motion, load, .. } = self.prepared;
        let instant = |k: usize| Instant {
            position: motion.position[k],
            place: motion.position[k] - self.prepared.middle,
            speed: motion.speed[k],
            acceleration: motion.acceleration[k],
            load: load[k],
            friction: friction[k],
            wave: self.wave,
        };
        let column = |addend: &Addend| {
            let signal = (0..friction.len()).map(|k| (addend.of)(&instant(k)));
            self.prepared
                .column(&signal.collect::<Vec<_>>(), addend.smooth)
        };
        self.addends[which].iter().map(column).collect()
    }

    pub fn resistance(
        &self,
        nonlinear: &[f64],
        linear: &[f64],
    ) -> Result<SlideResistance<'_>, epas_friction::Error> {
        // A drag that pushes would have no end.
        let value = |(parameter, value): (&Parameter, &f64)| {
            let drags = parameter.name.starts_with("viscous_friction");
            if drags { value.max(0.0) } else { *value }
        };
        Ok(SlideResistance {
            slide: self,
            friction: self.law.friction(&self.scales, nonlinear)?,
            linear: self.linear.iter().zip(linear).map(value).collect(),
            load: 0.0,
        })
    }

    pub fn delay(&self, nonlinear: &[f64]) -> f64 {
        let delays = self.nonlinear.iter().zip(nonlinear);
        delays
            .filter(|(parameter, _)| parameter.name == DELAY)
            .map(|(_, value)| *value)
            .sum()
    }
}

impl Separable for Slide<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[Parameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.prepared.target
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let delay = self.delay(nonlinear);
        let motion = &self.prepared.motion;
        let mut fixed: Vec<f64> = self.fixed.at(delay);
        for value in &mut fixed {
            *value *= self.own_load;
        }
        if let Some(known) = &self.prepared.known {
            for (sum, value) in fixed.iter_mut().zip(known.at(delay)) {
                *sum -= value;
            }
        }
        let friction = match self.law.friction(&self.scales, nonlinear) {
            Ok(law) => law.along(&motion.position, &motion.speed, self.scales.tick),
            Err(_) => vec![0.0; motion.position.len()],
        };
        let rubbing = self.columns(self.level.start..self.addends.len(), &friction);
        let columns = self.steady.iter().chain(&rubbing);
        Evaluation {
            fixed,
            columns: columns.map(|of| of.at(delay)).collect(),
        }
    }
}

#[derive(Clone)]
pub struct SlideResistance<'a> {
    slide: &'a Slide<'a>,
    friction: Friction,
    linear: Vec<f64>,
    /// Load, N or N m.
    pub load: f64,
}

impl SlideResistance<'_> {
    fn with(&self, friction: f64, step: &Step) -> f64 {
        let slide = self.slide;
        let at = Instant {
            position: step.position,
            place: step.position - slide.prepared.middle,
            speed: step.end_speed,
            acceleration: 0.0,
            load: self.load,
            friction,
            wave: slide.wave,
        };
        let (mut sum, mut level) = (slide.own_load * self.load, 0.0);
        let terms = slide.addends.iter().zip(&self.linear);
        for (k, (addend, value)) in terms.enumerate() {
            let part = value * (addend.of)(&at);
            if slide.level.contains(&k) {
                level += part;
            } else {
                sum += part;
            }
        }
        // Where its slope takes the level below zero, there is none.
        if level * friction > 0.0 {
            sum + level
        } else {
            sum
        }
    }
}

impl Resistance for SlideResistance<'_> {
    fn against(&self, step: &Step) -> f64 {
        let mut friction = self.friction;
        self.with(friction.follow(step), step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        let friction = self.friction.follow(step);
        self.with(friction, step)
    }
}
