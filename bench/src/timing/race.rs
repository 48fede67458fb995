//! Competitors that run in turns, and what they took.

use std::hint::black_box;
use std::time::Instant;

use epas_friction::curvature::PrincipalCurvatures;
use epas_friction::geometry::ContactAngle;
use epas_friction::hertz::{ContactEllipse, HertzContact};
use epas_friction::{Inputs, Outputs};

/// An input that can be made to wait for an output.
pub trait Feed: Copy {
    /// The same number, `by` being zero; the processor does not know.
    fn shifted(self, by: f32) -> Self;
}

impl Feed for f32 {
    fn shifted(self, by: f32) -> Self {
        self + by
    }
}

impl Feed for f64 {
    fn shifted(self, by: f32) -> Self {
        self + Self::from(by)
    }
}

impl Feed for ContactAngle {
    fn shifted(self, by: f32) -> Self {
        Self {
            cos: self.cos + by,
            sin: self.sin + by,
        }
    }
}

impl Feed for Inputs {
    fn shifted(self, by: f32) -> Self {
        Self {
            nut_speed: self.nut_speed + by,
            axial_load: self.axial_load + by,
        }
    }
}

/// An output that the next input can wait for.
pub trait Taken {
    /// One number of it.
    fn value(&self) -> f32;
}

impl Taken for f32 {
    fn value(&self) -> f32 {
        *self
    }
}

impl Taken for f64 {
    fn value(&self) -> f32 {
        *self as f32
    }
}

impl Taken for (f32, f32) {
    fn value(&self) -> f32 {
        self.0
    }
}

impl Taken for PrincipalCurvatures {
    fn value(&self) -> f32 {
        self.kappa1
    }
}

impl Taken for epas_reference::curvature::PrincipalCurvatures {
    fn value(&self) -> f32 {
        self.kappa1 as f32
    }
}

impl Taken for HertzContact {
    fn value(&self) -> f32 {
        self.axis_ratio()
    }
}

impl Taken for ContactEllipse {
    fn value(&self) -> f32 {
        self.semi_major
    }
}

impl Taken for Outputs {
    fn value(&self) -> f32 {
        self.friction_torque
    }
}

/// How calls follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Each waits for the one before.
    Latency,
    /// They are independent.
    Throughput,
}

/// A batch of calls.
type Batch = Box<dyn FnMut()>;

/// A competitor with its two batches and what they took.
struct Entry {
    baseline: usize,
    calls: usize,
    batches: [Batch; 2],
    /// Nanoseconds a call, for each round.
    samples: [Vec<f64>; 2],
}

const MODES: [Mode; 2] = [Mode::Latency, Mode::Throughput];

/// Competitors that run in turns.
#[derive(Default)]
pub struct Race {
    entries: Vec<Entry>,
}

/// A competitor's place in a race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place(usize);

/// What a call takes, ns, less the empty call.
///
/// A time below the resolution is none: whether it comes out positive or negative is chance.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Median over the rounds.
    pub median: f64,
    /// Lower and upper quartile over the rounds.
    pub quartiles: (f64, f64),
    /// Every round.
    pub rounds: Vec<f64>,
    /// What the race cannot tell from an empty call.
    pub resolution: f64,
}

/// One time over another, as far as the resolution lets both be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ratio {
    /// It is this.
    Is(f64),
    /// The upper time is below its resolution: the ratio is less than this.
    Below(f64),
    /// The lower time is below its resolution: the ratio is more than this.
    Above(f64),
    /// Both are below their resolutions.
    Unknown,
}

impl Measure {
    /// The median, or the resolution where the median is below it: for an axis of a figure.
    pub fn at_least_resolved(&self) -> f64 {
        self.median.max(self.resolution)
    }

    /// Whether the median stands out from an empty call.
    pub fn is_resolved(&self) -> bool {
        self.median >= self.resolution
    }

    /// The median over that of another one.
    pub fn over(&self, unit: &Self) -> Ratio {
        self.ratio(unit, self.median / unit.median)
    }

    /// The given ratio of this time to another, as far as both are resolved.
    fn ratio(&self, unit: &Self, ratio: f64) -> Ratio {
        match (self.is_resolved(), unit.is_resolved()) {
            (true, true) => Ratio::Is(ratio),
            (false, true) => Ratio::Below(self.resolution / unit.median),
            (true, false) => Ratio::Above(self.median / unit.resolution),
            (false, false) => Ratio::Unknown,
        }
    }
}

impl Race {
    /// Adds the empty call over some inputs, which others are measured against.
    pub fn baseline<I: Feed + 'static, O: Taken + 'static>(
        &mut self,
        inputs: &[I],
        function: impl FnMut(I) -> O + Clone + 'static,
    ) -> Place {
        let own = Place(self.entries.len());
        self.competitor(own, inputs, function)
    }

    /// Adds a competitor over the same inputs as a baseline.
    pub fn competitor<I: Feed + 'static, O: Taken + 'static>(
        &mut self,
        baseline: Place,
        inputs: &[I],
        function: impl FnMut(I) -> O + Clone + 'static,
    ) -> Place {
        let place = Place(self.entries.len());
        self.entries.push(Entry {
            baseline: baseline.0,
            calls: inputs.len(),
            batches: [
                latency(inputs.to_vec(), function.clone()),
                throughput(inputs.to_vec(), function),
            ],
            samples: [Vec::new(), Vec::new()],
        });
        place
    }

    /// Runs the rounds, after one that only warms up.
    pub fn run(&mut self, rounds: usize) {
        let count = self.entries.len();
        for round in 0..=rounds {
            for turn in 0..count {
                let entry = &mut self.entries[(turn + round) % count];
                for (batch, samples) in entry.batches.iter_mut().zip(&mut entry.samples) {
                    let start = Instant::now();
                    batch();
                    let time = start.elapsed().as_secs_f64() * 1e9 / entry.calls as f64;
                    if round > 0 {
                        samples.push(time);
                    }
                }
            }
        }
    }

    /// Time of a competitor in each round, less that of its baseline in the same round.
    fn net(&self, place: Place, mode: Mode) -> Vec<f64> {
        let index = usize::from(mode == MODES[1]);
        let entry = &self.entries[place.0];
        let baseline = &self.entries[entry.baseline];
        entry.samples[index]
            .iter()
            .zip(&baseline.samples[index])
            .map(|(time, empty)| time - empty)
            .collect()
    }

    /// Median, quartiles and rounds of a competitor.
    pub fn measure(&self, place: Place, mode: Mode) -> Measure {
        let rounds = self.net(place, mode);
        Measure {
            median: quantile(&rounds, 0.5),
            quartiles: (quantile(&rounds, 0.25), quantile(&rounds, 0.75)),
            rounds,
            resolution: self.resolution(place, mode),
        }
    }

    /// What cannot be told from the empty call of a competitor, ns: the largest of a step of the clock over
    /// the calls of a batch, the quartiles' distance of the empty call itself, and the most by which any
    /// competitor with this empty call came out faster than it, which no call is.
    fn resolution(&self, place: Place, mode: Mode) -> f64 {
        const CLOCK_STEP: f64 = 1.0;
        let baseline = self.entries[place.0].baseline;
        let empty = &self.entries[baseline];
        let times = &empty.samples[usize::from(mode == MODES[1])];
        let spread = quantile(times, 0.75) - quantile(times, 0.25);
        let faster = (0..self.entries.len())
            .filter(|&entry| self.entries[entry].baseline == baseline)
            .map(|entry| -quantile(&self.net(Place(entry), mode), 0.5));
        faster.fold(spread.max(CLOCK_STEP / empty.calls as f64), f64::max)
    }

    /// Median over the rounds of the time of one competitor over that of another.
    pub fn ratio(&self, place: Place, to: Place, mode: Mode) -> Ratio {
        let ratios: Vec<_> = self
            .net(place, mode)
            .into_iter()
            .zip(self.net(to, mode))
            .map(|(time, unit)| time / unit)
            .collect();
        let (time, unit) = (self.measure(place, mode), self.measure(to, mode));
        time.ratio(&unit, quantile(&ratios, 0.5))
    }
}

fn latency<I: Feed + 'static, O: Taken + 'static>(
    inputs: Vec<I>,
    mut function: impl FnMut(I) -> O + 'static,
) -> Batch {
    Box::new(move || {
        let zero = black_box(0.0_f32);
        let mut last = 0.0_f32;
        for &input in &inputs {
            last = black_box(function(black_box(input).shifted(zero * last))).value();
        }
        black_box(last);
    })
}

fn throughput<I: Feed + 'static, O: Taken + 'static>(
    inputs: Vec<I>,
    mut function: impl FnMut(I) -> O + 'static,
) -> Batch {
    Box::new(move || {
        for &input in &inputs {
            black_box(function(black_box(input)));
        }
    })
}

/// The value below which the share `share` of all values lies.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = share * (sorted.len().saturating_sub(1)) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(low), Some(high)) => low + place.fract() * (high - low),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_the_values() {
        assert_eq!(quantile(&[3.0, 1.0, 2.0, 4.0], 0.5), 2.5);
        assert_eq!(quantile(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.25), 2.0);
        assert!(quantile(&[], 0.5).is_nan());
    }

    /// Twice the dependent work takes about twice the time; the bounds leave room for a busy machine.
    #[test]
    fn the_empty_call_is_taken_off() {
        let work = |steps: usize| {
            move |input: f32| (0..steps).fold(input, |value, _| black_box(value * 0.5 + 1.0))
        };
        let inputs = [1.0_f32; 512];
        let mut race = Race::default();
        let empty = race.baseline(&inputs, |input: f32| input);
        let single = race.competitor(empty, &inputs, work(20));
        let double = race.competitor(empty, &inputs, work(40));
        race.run(60);
        let ratio = race.ratio(double, single, Mode::Latency);
        assert!(
            matches!(ratio, Ratio::Is(ratio) if (1.4..2.8).contains(&ratio)),
            "{ratio:?}"
        );
        assert_eq!(race.measure(empty, Mode::Latency).median, 0.0);
    }

    /// Samples of a race that was not run: an empty call that takes 2 ns with quartiles 0.2 ns apart, and
    /// others that take so much more.
    fn samples(more: &[f64]) -> (Race, Vec<Place>) {
        let mut race = Race::default();
        let empty = race.baseline(&[0.0_f32; 256], |input: f32| input);
        let places: Vec<_> = more
            .iter()
            .map(|_| race.competitor(empty, &[0.0_f32; 256], |input: f32| input))
            .collect();
        for (entry, more) in race.entries.iter_mut().zip([&0.0].into_iter().chain(more)) {
            let times = [1.9, 1.9, 2.0, 2.1, 2.1].map(|empty| empty + more).to_vec();
            entry.samples = [times.clone(), times];
        }
        (race, places)
    }

    #[test]
    fn a_time_below_the_resolution_is_none() {
        let (race, places) = samples(&[5.0, 0.1, -0.5]);
        let measures: Vec<_> = places
            .iter()
            .map(|&place| race.measure(place, Mode::Throughput))
            .collect();
        let [long, short, negative] = &measures[..] else {
            unreachable!()
        };
        // The third call came out half a nanosecond faster than none: so much is not told.
        assert!((long.resolution - 0.5).abs() < 1e-9, "{}", long.resolution);
        assert!(long.is_resolved() && !short.is_resolved() && !negative.is_resolved());
        assert_eq!(negative.at_least_resolved(), negative.resolution);
        assert!(matches!(long.over(long), Ratio::Is(ratio) if ratio == 1.0));
        assert!(matches!(short.over(long), Ratio::Below(ratio) if (ratio - 0.1).abs() < 1e-9));
        assert!(matches!(long.over(negative), Ratio::Above(ratio) if (ratio - 10.0).abs() < 1e-9));
        assert_eq!(short.over(negative), Ratio::Unknown);
        // Without it the spread of the empty call is what is not told.
        let (race, places) = samples(&[5.0, 0.1]);
        let resolution = race.measure(places[0], Mode::Latency).resolution;
        assert!((resolution - 0.2).abs() < 1e-9, "{resolution}");
    }
}
