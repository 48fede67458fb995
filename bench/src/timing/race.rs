//! Competitors that run in turns, and what they took.

use std::hint::black_box;
use std::time::Instant;

use super::feed::{Feed, Taken};
use super::measure::{Measure, quantile};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Latency,
    Throughput,
}

const MODES: [Mode; 2] = [Mode::Latency, Mode::Throughput];

/// Least time of a batch, ns: reading the clock takes some tens of nanoseconds, and so less than a hundredth of it.
const BATCH: f64 = 10_000.0;

const MOST: usize = 1000;

const CHAIN: usize = 64;

/// Places of the stack, and bytes between two of them at least: together a page, after which places repeat.
const DEPTHS: usize = 20;
const STEP: usize = 208;

struct Batch {
    run: Box<dyn FnMut(usize)>,
    calls: usize,
    repeats: usize,
}

impl Batch {
    fn new(calls: usize, run: Box<dyn FnMut(usize)>) -> Self {
        Self {
            run,
            calls,
            repeats: 1,
        }
    }

    fn time(&mut self) -> f64 {
        let start = Instant::now();
        (self.run)(self.repeats);
        start.elapsed().as_secs_f64() * 1e9 / (self.calls * self.repeats) as f64
    }

    fn lengthen(&mut self) {
        // The first call is slow: the machine has not seen it yet.
        self.time();
        let whole = self.time() * self.calls as f64;
        self.repeats = ((BATCH / whole).ceil() as usize).clamp(1, MOST);
    }
}

/// What a batch took in a round, with the empty call and the unit right beside it, ns a call.
#[derive(Clone, Copy, Debug)]
struct Sample {
    time: f64,
    empty: f64,
    unit: f64,
}

struct Entry {
    baseline: usize,
    batches: [Batch; 2],
    samples: [Vec<Sample>; 2],
}

#[derive(Default)]
pub struct Race {
    entries: Vec<Entry>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place(usize);

impl Race {
    pub fn baseline<I: Feed + 'static, O: Taken + 'static>(
        &mut self,
        inputs: &[I],
        function: impl FnMut(I) -> O + Clone + 'static,
    ) -> Place {
        let own = Place(self.entries.len());
        self.competitor(own, inputs, function)
    }

    pub fn competitor<I: Feed + 'static, O: Taken + 'static>(
        &mut self,
        baseline: Place,
        inputs: &[I],
        function: impl FnMut(I) -> O + Clone + 'static,
    ) -> Place {
        let place = Place(self.entries.len());
        let calls = inputs.len();
        self.entries.push(Entry {
            baseline: baseline.0,
            batches: [
                Batch::new(calls, latency(inputs.to_vec(), function.clone())),
                Batch::new(calls, throughput(inputs.to_vec(), function)),
            ],
            samples: [Vec::new(), Vec::new()],
        });
        place
    }

    pub fn run(&mut self, rounds: usize, done: &dyn Fn()) {
        let mut unit = unit();
        unit.lengthen();
        for entry in &mut self.entries {
            entry.batches.iter_mut().for_each(Batch::lengthen);
        }
        let count = self.entries.len();
        for round in 0..rounds {
            for turn in 0..count {
                let place = (turn + round) % count;
                deeper(round % DEPTHS, &mut || self.turn(place, &mut unit));
            }
            done();
        }
    }

    fn turn(&mut self, place: usize, unit: &mut Batch) {
        for mode in 0..MODES.len() {
            let baseline = self.entries[place].baseline;
            let empty = self.entries[baseline].batches[mode].time();
            let time = self.entries[place].batches[mode].time();
            let unit = unit.time() / CHAIN as f64;
            self.entries[place].samples[mode].push(Sample { time, empty, unit });
        }
    }

    fn samples(&self, place: Place, mode: Mode) -> &[Sample] {
        &self.entries[place.0].samples[usize::from(mode == MODES[1])]
    }

    fn net(&self, place: Place, mode: Mode) -> Vec<f64> {
        let samples = self.samples(place, mode).iter();
        samples.map(|sample| sample.time - sample.empty).collect()
    }

    pub fn measure(&self, place: Place, mode: Mode) -> Measure {
        let rounds = self.net(place, mode);
        let samples = self.samples(place, mode).iter();
        Measure {
            median: quantile(&rounds, 0.5),
            quartiles: (quantile(&rounds, 0.25), quantile(&rounds, 0.75)),
            in_units: samples
                .map(|sample| (sample.time - sample.empty) / sample.unit)
                .collect(),
            rounds,
            resolution: self.resolution(place, mode),
        }
    }

    /// What cannot be told from the empty call of a competitor, ns: the larger of the quartiles' distance of the empty call
    /// less itself, and the most by which any competitor with this empty call came out faster than it, which no call is.
    fn resolution(&self, place: Place, mode: Mode) -> f64 {
        let baseline = self.entries[place.0].baseline;
        let itself = self.net(Place(baseline), mode);
        let spread = quantile(&itself, 0.75) - quantile(&itself, 0.25);
        let faster = (0..self.entries.len())
            .filter(|&entry| self.entries[entry].baseline == baseline)
            .map(|entry| -quantile(&self.net(Place(entry), mode), 0.5));
        faster.fold(spread, f64::max)
    }
}

/// Calls something with the stack so many steps further down. The system puts the stack somewhere else in every run, and where it
/// lies to the data may make a call slower: a run goes through all places, so that it comes out as the next one.
#[inline(never)]
fn deeper(steps: usize, call: &mut dyn FnMut()) {
    let room = black_box([0_u8; STEP]);
    match steps.checked_sub(1) {
        Some(steps) => deeper(steps, call),
        None => call(),
    }
    black_box(room);
}

fn unit() -> Batch {
    const CALLS: usize = 64;
    let run = |repeats: usize| {
        let (factor, term) = (black_box(0.5_f32), black_box(1.0_f32));
        let mut value = black_box(1.0_f32);
        for _ in 0..repeats * CALLS {
            for _ in 0..CHAIN {
                value = value * factor + term;
            }
            value = black_box(value);
        }
    };
    Batch::new(CALLS, Box::new(run))
}

fn latency<I: Feed + 'static, O: Taken + 'static>(
    inputs: Vec<I>,
    mut function: impl FnMut(I) -> O + 'static,
) -> Box<dyn FnMut(usize)> {
    Box::new(move |repeats| {
        let zero = black_box(0.0_f32);
        let mut last = 0.0_f32;
        for _ in 0..repeats {
            for &input in &inputs {
                last = black_box(function(black_box(input).shifted(zero * last))).value();
            }
        }
        black_box(last);
    })
}

fn throughput<I: Feed + 'static, O: Taken + 'static>(
    inputs: Vec<I>,
    mut function: impl FnMut(I) -> O + 'static,
) -> Box<dyn FnMut(usize)> {
    Box::new(move |repeats| {
        for _ in 0..repeats {
            for &input in &inputs {
                black_box(function(black_box(input)));
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::measure::Ratio;
    use super::*;

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
        race.run(60, &|| ());
        let [single, double] = [single, double].map(|place| race.measure(place, Mode::Latency));
        let ratio = double.over(&single);
        assert!(
            matches!(ratio, Ratio::Is(ratio) if (1.4..2.8).contains(&ratio.median)),
            "{ratio:?}"
        );
    }

    /// Samples of a race that was not run: an empty call that differs from itself by 0.2 ns between the quartiles, and
    /// others that take so much more.
    fn samples(more: &[f64]) -> (Race, Vec<Place>) {
        let mut race = Race::default();
        let empty = race.baseline(&[0.0_f32; 256], |input: f32| input);
        let places: Vec<_> = more
            .iter()
            .map(|_| race.competitor(empty, &[0.0_f32; 256], |input: f32| input))
            .collect();
        for (entry, more) in race.entries.iter_mut().zip([&0.0].into_iter().chain(more)) {
            let times: Vec<_> = [1.9, 1.9, 2.0, 2.1, 2.1]
                .map(|time| Sample {
                    time: time + more,
                    empty: 2.0,
                    unit: 2.0,
                })
                .into();
            entry.samples = [times.clone(), times];
        }
        (race, places)
    }

    #[test]
    fn a_call_faster_than_none_tells_the_resolution() {
        let (race, places) = samples(&[5.0, 0.1, -0.5]);
        let long = race.measure(places[0], Mode::Throughput);
        assert!((long.resolution - 0.5).abs() < 1e-9, "{}", long.resolution);
        assert!((long.median - 5.0).abs() < 1e-9);
        // Without it the spread of the empty call is what is not told.
        let (race, places) = samples(&[5.0, 0.1]);
        let resolution = race.measure(places[0], Mode::Latency).resolution;
        assert!((resolution - 0.2).abs() < 1e-9, "{resolution}");
    }
}
