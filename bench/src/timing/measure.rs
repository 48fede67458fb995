//! What a call took, and one time over another, as far as the race can tell.

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
    /// Every round over the unit beside it: a chain of multiplications and additions that wait for each other.
    pub in_units: Vec<f64>,
    /// What the race cannot tell from an empty call.
    pub resolution: f64,
}

/// A quantity over the rounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Its median.
    pub median: f64,
    /// Its quartiles.
    pub quartiles: (f64, f64),
}

impl Spread {
    /// Of such values.
    pub fn of(values: &[f64]) -> Self {
        Self {
            median: quantile(values, 0.5),
            quartiles: (quantile(values, 0.25), quantile(values, 0.75)),
        }
    }
}

/// One time over another, as far as the resolution lets both be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ratio {
    /// It is this.
    Is(Spread),
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

    /// This time in units: how many multiplications with an addition, each waiting for the one before, take as long.
    pub fn over_unit(&self) -> Ratio {
        let spread = Spread::of(&self.in_units);
        if self.is_resolved() {
            return Ratio::Is(spread);
        }
        // As far below in units as in time.
        let unit: Vec<f64> = self
            .rounds
            .iter()
            .zip(&self.in_units)
            .map(|(time, units)| time / units)
            .collect();
        Ratio::Below(self.resolution / quantile(&unit, 0.5))
    }

    /// This time over another one, round by round, each over the unit beside it.
    pub fn over(&self, other: &Self) -> Ratio {
        match (self.is_resolved(), other.is_resolved()) {
            (true, true) => {
                let rounds = self.in_units.iter().zip(&other.in_units);
                let ratios: Vec<_> = rounds.map(|(time, unit)| time / unit).collect();
                Ratio::Is(Spread::of(&ratios))
            }
            (false, true) => Ratio::Below(self.resolution / other.median),
            (true, false) => Ratio::Above(self.median / other.resolution),
            (false, false) => Ratio::Unknown,
        }
    }
}

/// The value below which the share `share` of all values lies.
pub fn quantile(values: &[f64], share: f64) -> f64 {
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

    /// A machine that runs at half its speed in every second round.
    fn measure(time: f64, resolution: f64) -> Measure {
        let rounds: Vec<f64> = [1.0, 2.0, 1.0, 2.0, 1.0].map(|slow| slow * time).into();
        Measure {
            median: quantile(&rounds, 0.5),
            quartiles: (quantile(&rounds, 0.25), quantile(&rounds, 0.75)),
            in_units: vec![time / 2.0; 5],
            rounds,
            resolution,
        }
    }

    #[test]
    fn a_ratio_does_not_follow_the_speed_of_the_machine() {
        let (long, short) = (measure(30.0, 0.5), measure(10.0, 0.5));
        let three = Spread {
            median: 3.0,
            quartiles: (3.0, 3.0),
        };
        assert_eq!(long.over(&short), Ratio::Is(three));
        assert_eq!(long.quartiles, (30.0, 60.0));
        assert!(matches!(long.over_unit(), Ratio::Is(spread) if spread.median == 15.0));
    }

    #[test]
    fn a_time_below_the_resolution_is_none() {
        let (long, short, negative) = (measure(5.0, 0.5), measure(0.1, 0.5), measure(-0.5, 0.5));
        assert!(long.is_resolved() && !short.is_resolved() && !negative.is_resolved());
        assert_eq!(negative.at_least_resolved(), negative.resolution);
        assert_eq!(short.over(&long), Ratio::Below(0.1));
        assert_eq!(long.over(&negative), Ratio::Above(10.0));
        assert_eq!(short.over(&negative), Ratio::Unknown);
        // The unit takes 2 ns.
        assert_eq!(short.over_unit(), Ratio::Below(0.25));
    }
}
