//! How balls share loads of changing size and sign, and how many tables of shares that takes.
//!
//! A friction model that runs in a loop knows one table: each ball's share of whatever the axial load is; the static model has another one
//! for each load. Under small loads errors of grooves and balls decide who carries, under large ones the screw's elasticity, and a screw
//! that bends shares a push and a pull differently.
//!
//! [`ShareTable::error_at`] tells how much a table errs under another load: friction of all grooves, as the sum of `share^(4/3)` where
//! balls spin (less steeply where they slip across the track), and the load of the ball that is most wrong. [`ShareTables::fewest`] finds
//! the smallest number of tables that serve a list of loads, [`Served::best_alone`] the best single one, [`ShareTable::range`] what a given
//! one serves. A preload is no share of the load.

use std::ops::Range;

use rayon::prelude::*;

use super::solution::StaticSolution;
use crate::error::{ReferenceError, within};

/// Smallest share that a friction model takes: a ball that carries nothing, or pushes against the load, stands with it.
pub const LEAST_SHARE: f64 = 0.01;

/// How the balls share one axial load.
#[derive(Clone, Debug, PartialEq)]
pub struct ShareTable {
    /// Axial load on the screw, N.
    pub axial_load: f64,
    /// Axial load of each ball over the mean of all, along the track; below zero where a ball pushes against the load.
    pub shares: Vec<f64>,
}

/// How far a table is off under a load; also how far it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShareError {
    /// Of the grooves' friction torque, over it.
    pub groove_torque: f64,
    /// Of the load of the ball that is most wrong, over the load of the ball that carries most.
    pub ball_load: f64,
}

impl ShareError {
    const NONE: Self = Self {
        groove_torque: 0.0,
        ball_load: 0.0,
    };

    /// What a table may be off where it serves: 1 % of the grooves' friction, 5 % of the largest ball load.
    pub const TOLERANCE: Self = Self {
        groove_torque: 0.01,
        ball_load: 0.05,
    };

    /// The larger one of both parts, over what they may be: up to 1 where the table serves.
    pub fn over(&self, tolerance: &Self) -> f64 {
        let torque = self.groove_torque.abs() / tolerance.groove_torque;
        torque.max(self.ball_load / tolerance.ball_load)
    }

    /// Whether a table that is off by this serves.
    pub fn is_within(&self, tolerance: &Self) -> bool {
        self.over(tolerance) <= 1.0
    }

    fn or(self, other: Self) -> Self {
        let larger = |one: f64, other: f64| if other.abs() > one.abs() { other } else { one };
        Self {
            groove_torque: larger(self.groove_torque, other.groove_torque),
            ball_load: larger(self.ball_load, other.ball_load),
        }
    }
}

impl ShareTable {
    /// The shares of a solution.
    pub fn new(axial_load: f64, solution: &StaticSolution) -> Result<Self, ReferenceError> {
        let parts = solution.axial_shares().ok_or_else(|| {
            ReferenceError::input(
                "axial_load",
                format!("under {axial_load} N no ball carries anything along the axis"),
            )
        })?;
        let balls = parts.len() as f64;
        Ok(Self {
            axial_load,
            shares: parts.iter().map(|part| part * balls).collect(),
        })
    }

    /// The tables of several loads, on all cores, where `solve` finds the balls' forces under an axial load.
    pub fn of_loads(
        loads: &[f64],
        solve: impl Fn(f64) -> Result<StaticSolution, ReferenceError> + Sync,
    ) -> Result<Vec<Self>, ReferenceError> {
        loads
            .par_iter()
            .map(|load| Self::new(*load, &solve(*load)?))
            .collect()
    }

    /// The table as a friction model takes it: nothing below [`LEAST_SHARE`], and the mean 1.
    pub fn positive(&self) -> Vec<f64> {
        let raised: Vec<f64> = self
            .shares
            .iter()
            .map(|share| share.max(LEAST_SHARE))
            .collect();
        let mean = raised.iter().sum::<f64>() / raised.len() as f64;
        raised
            .iter()
            .map(|share| (share / mean).max(LEAST_SHARE))
            .collect()
    }

    /// Balls that carry nothing along the axis, or push against the load.
    pub fn idle(&self) -> usize {
        self.shares
            .iter()
            .filter(|share| **share <= LEAST_SHARE)
            .count()
    }

    /// How far this table, as a friction model takes it, is off under the load of another one.
    pub fn error_at(&self, load: &Self) -> Result<ShareError, ReferenceError> {
        alike(self, load)?;
        Ok(Measured::of(self).error_at(&Measured::of(load)))
    }

    /// The loads around one of `size`, N, that this table serves: from the smallest to the largest size, without a gap.
    /// None where it does not serve that one of `loads`, ordered by size, whose size is nearest.
    pub fn range(
        &self,
        loads: &[Self],
        size: f64,
        tolerance: &ShareError,
    ) -> Result<Option<[f64; 2]>, ReferenceError> {
        let serves = loads
            .iter()
            .map(|load| Ok(self.error_at(load)?.is_within(tolerance)))
            .collect::<Result<Vec<bool>, ReferenceError>>()?;
        let distance = |load: &Self| (load.axial_load.abs() / size).ln().abs();
        let nearest = loads
            .iter()
            .enumerate()
            .min_by(|(_, one), (_, other)| distance(one).total_cmp(&distance(other)));
        let Some((middle, _)) = nearest.filter(|(nearest, _)| serves[*nearest]) else {
            return Ok(None);
        };
        let first = (0..middle)
            .rev()
            .find(|load| !serves[*load])
            .map_or(0, |load| load + 1);
        let last = (middle..loads.len())
            .find(|load| !serves[*load])
            .unwrap_or(loads.len())
            - 1;
        Ok(Some([first, last].map(|load| loads[load].axial_load)))
    }
}

fn alike(one: &ShareTable, other: &ShareTable) -> Result<(), ReferenceError> {
    let [one, other] = [one, other].map(|table| table.shares.len());
    if one == other {
        Ok(())
    } else {
        Err(ReferenceError::input(
            "shares",
            format!("{one} balls in one table, {other} in the other"),
        ))
    }
}

struct Measured<'a> {
    load: &'a ShareTable,
    positive: Vec<f64>,
    /// Friction of the grooves over that of a ball under the mean load: by the shares as a friction model takes them.
    positive_friction: f64,
    friction: f64,
    largest: f64,
}

impl<'a> Measured<'a> {
    fn of(load: &'a ShareTable) -> Self {
        let friction = |shares: &[f64]| -> f64 {
            shares.iter().map(|share| share.abs().powf(4.0 / 3.0)).sum()
        };
        let positive = load.positive();
        Self {
            positive_friction: friction(&positive),
            friction: friction(&load.shares),
            largest: load
                .shares
                .iter()
                .fold(0.0, |most, share| most.max(share.abs())),
            positive,
            load,
        }
    }

    fn error_at(&self, other: &Self) -> ShareError {
        let apart = self
            .positive
            .iter()
            .zip(&other.load.shares)
            .fold(0.0, |most: f64, (table, share)| {
                most.max((table - share).abs())
            });
        ShareError {
            groove_torque: self.positive_friction / other.friction - 1.0,
            ball_load: apart / other.largest,
        }
    }

    fn groove_torque(&self) -> f64 {
        self.load.axial_load.abs().powf(4.0 / 3.0) * self.friction
    }

    fn ball_load(&self) -> f64 {
        self.load.axial_load.abs() * self.largest
    }
}

/// A table and the loads that it is for.
#[derive(Clone, Debug, PartialEq)]
pub struct Served {
    /// The table.
    pub table: ShareTable,
    /// Load of the smallest size, N.
    pub from: f64,
    /// Load of the largest size, N.
    pub to: f64,
    /// The largest error under these loads, each part where it is largest.
    pub worst: ShareError,
    /// The load where the table is furthest off, N.
    pub worst_at: f64,
    /// The largest error in parts of the largest friction and of the largest ball load under any of these loads.
    pub of_largest: ShareError,
}

impl Served {
    /// The one of these tables that does best under all of their loads. Where some serve them all, it is the one with the smallest error;
    /// else the one whose error is smallest in parts of the largest friction and ball load, so that large loads decide. None of none.
    pub fn best_alone(
        loads: &[ShareTable],
        tolerance: &ShareError,
    ) -> Result<Option<Self>, ReferenceError> {
        let errors = Errors::new(loads, tolerance)?;
        let all = 0..loads.len();
        Ok(all
            .clone()
            .map(|table| errors.served(table, all.clone()))
            .min_by(|one, other| {
                let rank = |served: &Self| {
                    let error = served.worst.over(tolerance);
                    if error <= 1.0 {
                        error
                    } else {
                        1.0 + served.of_largest.over(tolerance)
                    }
                };
                rank(one).total_cmp(&rank(other))
            }))
    }

    /// Whether the table serves all of its loads.
    pub fn serves(&self, tolerance: &ShareError) -> bool {
        self.worst.is_within(tolerance)
    }
}

/// The smallest number of tables that serve a list of loads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShareTables {
    /// Tables with the loads that they serve within the tolerance: neighbours in size, one range after the other.
    pub served: Vec<Served>,
    /// Loads that even their own table does not serve: some balls push against them by more than a table can say, N.
    pub unserved: Vec<f64>,
}

impl ShareTables {
    /// The smallest number of the given tables such that each serves loads that are neighbours in size; `loads` are
    /// of one sign, in the order of their size.
    ///
    /// Each range is as long as any table makes it from where it starts: no other choice takes fewer.
    pub fn fewest(loads: &[ShareTable], tolerance: &ShareError) -> Result<Self, ReferenceError> {
        for part in [tolerance.groove_torque, tolerance.ball_load] {
            within("tolerance", part, 1e-9, 1.0)?;
        }
        let ordered = loads.windows(2).all(|pair| {
            let [one, other] = [pair[0].axial_load, pair[1].axial_load];
            one * other > 0.0 && one.abs() < other.abs()
        });
        if !ordered {
            return Err(ReferenceError::input(
                "axial_load",
                "loads are of one sign and each is larger than the one before",
            ));
        }
        let errors = Errors::new(loads, tolerance)?;
        let mut found = Self::default();
        let mut start = 0;
        while start < loads.len() {
            let reach = |table: usize| {
                (start..loads.len())
                    .find(|load| !errors.serves(table, *load))
                    .unwrap_or(loads.len())
            };
            let best = (0..loads.len())
                .map(|table| (table, reach(table)))
                .filter(|(_, end)| *end > start)
                .min_by(|(one, one_end), (other, other_end)| {
                    let size = |table: &usize| {
                        let served = errors.served(*table, start..*one_end);
                        served.worst.over(tolerance)
                    };
                    other_end
                        .cmp(one_end)
                        .then_with(|| size(one).total_cmp(&size(other)))
                });
            if let Some((table, end)) = best {
                found.served.push(errors.served(table, start..end));
                start = end;
            } else {
                found.unserved.push(loads[start].axial_load);
                start += 1;
            }
        }
        Ok(found)
    }
}

struct Errors<'a> {
    loads: Vec<Measured<'a>>,
    tolerance: &'a ShareError,
    rows: Vec<ShareError>,
}

impl<'a> Errors<'a> {
    fn new(loads: &'a [ShareTable], tolerance: &'a ShareError) -> Result<Self, ReferenceError> {
        for pair in loads.windows(2) {
            alike(&pair[0], &pair[1])?;
        }
        let loads: Vec<_> = loads.iter().map(Measured::of).collect();
        Ok(Self {
            rows: loads
                .iter()
                .flat_map(|table| loads.iter().map(|load| table.error_at(load)))
                .collect(),
            loads,
            tolerance,
        })
    }

    fn at(&self, table: usize, load: usize) -> ShareError {
        self.rows[table * self.loads.len() + load]
    }

    fn serves(&self, table: usize, load: usize) -> bool {
        self.at(table, load).is_within(self.tolerance)
    }

    fn served(&self, table: usize, range: Range<usize>) -> Served {
        let loads = &self.loads[range.clone()];
        let most = |of: fn(&Measured<'a>) -> f64| loads.iter().map(of).fold(0.0, f64::max);
        let (groove_torque, ball_load) = (most(Measured::groove_torque), most(Measured::ball_load));
        let axial_load = |measured: &Measured<'a>| measured.load.axial_load;
        let mut served = Served {
            table: self.loads[table].load.clone(),
            from: axial_load(&loads[0]),
            to: axial_load(&loads[loads.len() - 1]),
            worst: ShareError::NONE,
            worst_at: axial_load(&loads[0]),
            of_largest: ShareError::NONE,
        };
        let mut furthest = 0.0;
        for (load, index) in loads.iter().zip(range) {
            let error = self.at(table, index);
            if error.over(self.tolerance) > furthest {
                furthest = error.over(self.tolerance);
                served.worst_at = axial_load(load);
            }
            served.worst = served.worst.or(error);
            served.of_largest = served.of_largest.or(ShareError {
                groove_torque: error.groove_torque * load.groove_torque() / groove_torque,
                ball_load: error.ball_load * load.ball_load() / ball_load,
            });
        }
        served
    }
}

/// Loads from `smallest` to `largest`, N, of the sign of `largest`, each at most a tenth larger than the one before.
pub fn loads_between(smallest: f64, largest: f64) -> Result<Vec<f64>, ReferenceError> {
    let [from, to] = [smallest.abs(), largest.abs()];
    within("axial_load", to, 1e-6, 1e8)?;
    within("axial_load", from, 1e-6, to)?;
    if from == to {
        return Ok(vec![largest]);
    }
    let steps = ((to / from).ln() / 1.1_f64.ln()).ceil().max(1.0);
    let mut loads: Vec<f64> = (0..=steps as usize)
        .map(|step| (from * (to / from).powf(step as f64 / steps)).copysign(largest))
        .collect();
    loads[0] = from.copysign(largest);
    if let Some(last) = loads.last_mut() {
        *last = largest;
    }
    Ok(loads)
}
