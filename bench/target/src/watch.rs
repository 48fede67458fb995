//! Limits of counted calls: those on which a longest path rests.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

/// A sum over steps from one address to another, each times a factor, that no call of a function exceeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bounded {
    /// Addresses of an instruction and of the next one of the same function, with the factor.
    pub terms: Vec<((u32, u32), f64)>,
    pub most: f64,
    pub what: String,
}

struct Function {
    end: u32,
    limits: Range<usize>,
    /// The instruction of it that was executed last.
    last: u32,
}

/// Watches a function and all that it calls.
#[derive(Default)]
pub struct Watch {
    functions: BTreeMap<u32, Function>,
    steps: HashMap<(u32, u32), Vec<(usize, f64)>>,
    limits: Vec<(f64, String)>,
    sums: Vec<f64>,
    broken: Vec<usize>,
}

impl Watch {
    /// Adds the limits of a function in this range of addresses.
    pub fn add(&mut self, addresses: Range<u32>, limits: &[Bounded]) {
        let first = self.limits.len();
        for limit in limits {
            let place = self.limits.len();
            self.limits.push((limit.most, limit.what.clone()));
            for &(step, factor) in &limit.terms {
                self.steps.entry(step).or_default().push((place, factor));
            }
        }
        self.sums.resize(self.limits.len(), 0.0);
        let function = Function {
            end: addresses.end,
            limits: first..self.limits.len(),
            last: 0,
        };
        if !limits.is_empty() {
            self.functions.insert(addresses.start, function);
        }
    }

    /// An instruction is executed after the one at `before`.
    pub fn step(&mut self, before: u32, address: u32) {
        let Some((&start, function)) = self.functions.range_mut(..=address).next_back() else {
            return;
        };
        if address >= function.end {
            return;
        }
        if address == start && !(start..function.end).contains(&before) {
            self.sums[function.limits.clone()].fill(0.0);
        }
        let last = std::mem::replace(&mut function.last, address);
        for &(limit, factor) in self.steps.get(&(last, address)).into_iter().flatten() {
            self.sums[limit] += factor;
            // Sums of binary fractions and small whole numbers: exact but for a few units in the last place.
            let exceeded = self.sums[limit] > self.limits[limit].0 + 1e-6;
            if exceeded && !self.broken.contains(&limit) {
                self.broken.push(limit);
            }
        }
    }

    pub fn broken(&self) -> impl Iterator<Item = &str> {
        let broken = self.broken.iter();
        broken.map(|&limit| self.limits[limit].1.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A loop of two instructions at 4 and 6, entered from 2, that may go back three times for each entry.
    fn watch() -> Watch {
        let mut watch = Watch::default();
        let limit = Bounded {
            terms: vec![((6, 4), 1.0), ((2, 4), -3.0)],
            most: 0.0,
            what: "turns".into(),
        };
        watch.add(2..10, &[limit]);
        watch
    }

    fn run(watch: &mut Watch, turns: usize) {
        let around = [4, 6].repeat(turns);
        let mut before = 100;
        for address in [2].into_iter().chain(around).chain([8]) {
            watch.step(before, address);
            before = address;
        }
    }

    #[test]
    fn a_loop_that_turns_once_more_is_found() {
        let mut watch = watch();
        run(&mut watch, 4);
        run(&mut watch, 4);
        assert_eq!(watch.broken().count(), 0);
        run(&mut watch, 5);
        assert_eq!(watch.broken().collect::<Vec<_>>(), ["turns"]);
    }

    #[test]
    fn calls_in_between_do_not_hide_a_step() {
        let mut watch = watch();
        for (before, address) in [(100, 2), (2, 50), (50, 4)] {
            watch.step(before, address);
        }
        for _ in 0..4 {
            watch.step(4, 6);
            watch.step(6, 4);
        }
        assert_eq!(watch.broken().count(), 1);
    }
}
