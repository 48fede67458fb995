//! Functions that are timed over the same inputs.

use super::feed::{Feed, Taken};
use super::race::{Place, Race};

const INPUTS: usize = 256;

pub struct Group<'a, I> {
    race: &'a mut Race,
    list: &'a mut List,
    inputs: Vec<I>,
    baseline: Place,
    unit: Option<Place>,
}

pub type List = Vec<(&'static str, Place, Place)>;

impl<'a, I: Feed + 'static> Group<'a, I> {
    pub fn new<O: Taken + 'static>(
        race: &'a mut Race,
        list: &'a mut List,
        input: impl Fn(f64) -> I,
        empty: impl FnMut(I) -> O + Clone + 'static,
    ) -> Self {
        let inputs: Vec<I> = shares().map(input).collect();
        let baseline = race.baseline(&inputs, empty);
        Self {
            race,
            list,
            inputs,
            baseline,
            unit: None,
        }
    }

    pub fn time<O: Taken + 'static>(
        mut self,
        key: &'static str,
        function: impl FnMut(I) -> O + Clone + 'static,
    ) -> Self {
        let place = self.race.competitor(self.baseline, &self.inputs, function);
        let unit = *self.unit.get_or_insert(place);
        self.list.push((key, place, unit));
        self
    }
}

/// Numbers spread evenly over 0 to 1, in an order that no branch predictor learns: multiples of the
/// golden ratio.
pub fn shares() -> impl Iterator<Item = f64> {
    (0..INPUTS).map(|index| (index as f64 * 0.618_033_988_749_894_9).fract())
}
