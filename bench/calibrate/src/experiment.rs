//! Which manoeuvre tells a parameter of a screw best: `calibrate --wanted`.
//!
//! Each manoeuvre is a trace without a torque, and a problem of the estimator at its start values. The Fisher information of its rows
//! and the noise give the interval that a fit would find. Bounds count as a little information, that of an even distribution between them,
//! so that what a manoeuvre does not tell keeps the width of its bounds.

pub(crate) mod manoeuvre;

use std::io::{self, Write};

use nalgebra::DMatrix;

use crate::estimator::fit::dot;
use crate::estimator::record::Smoothed;
use crate::experiment::manoeuvre::{MANOEUVRES, Manoeuvre, Reach};
use crate::fit::problem::{Scale, Separable, inner, outer};
use crate::fit::search::{projected, slopes};
use crate::fit::uncertainty::QUANTILE;
use crate::screw::choice::{Start, Wanted};
use crate::screw::evidence::Evidence;
use crate::screw::exact::Spacing;
use crate::screw::problem::Known;
use crate::screw::stages::{Prepared, Window};
use epas_design::files::Design;
use epas_page::failure::Failure;

const BESIDE: &str =
    "friction full_film_ratio half_share_speed preload breakaway_angle inertia drag offset gain";

/// Noise of a row, N m: a hundredth of the torque of a steering gear at its rack force.
const NOISE: f64 = 5e-3;

/// Half-width of the kernel of a row, ticks: about as long as that of a fit.
const WINDOW: Window = Window { half: 17, way: 0.0 };

/// Tick of the manoeuvres, s.
const STEP: f64 = 1e-3;

struct Said {
    manoeuvre: Manoeuvre,
    /// Parameters: name, scale, bounds, value.
    all: Vec<(&'static str, Scale, [f64; 2], f64)>,
    place: usize,
    /// Information of its rows, and with that of the bounds.
    rows: DMatrix<f64>,
    own: DMatrix<f64>,
}

impl Said {
    /// What a manoeuvre's problem says of the wanted parameter; all manoeuvres have the same parameters.
    fn of(wanted: &str, manoeuvre: Manoeuvre, problem: &dyn Separable) -> Result<Self, Failure> {
        let start: Vec<f64> = problem.nonlinear().iter().map(|of| of.start).collect();
        let (linear, _) = projected(problem, &start);
        let slopes = slopes(problem, &start, &linear);
        let parameters = problem.nonlinear().iter().chain(problem.linear());
        let values = start.into_iter().chain(linear);
        let all: Vec<_> = parameters
            .zip(values)
            .map(|(own, value)| (own.name, own.scale, [own.low, own.high], value))
            .collect();
        let place = all.iter().position(|(name, ..)| *name == wanted);
        let place = place.ok_or_else(|| Failure::Data(format!("{wanted}: no such parameter")))?;
        let information = |i: usize, j: usize| dot(&slopes[i], &slopes[j]) / (NOISE * NOISE);
        let rows = DMatrix::from_fn(all.len(), all.len(), information);
        let mut own = rows.clone();
        for (k, (_, scale, [low, high], _)) in all.iter().enumerate() {
            let range = inner(*scale, *high) - inner(*scale, *low);
            // Variance of an even distribution: the range's square over 12; without bounds, a trifle of the rows' own.
            let even = 12.0 / (range * range);
            own[(k, k)] += if even > 0.0 {
                even
            } else {
                1e-12 * rows[(k, k)]
            };
        }
        Ok(Self {
            manoeuvre,
            all,
            place,
            rows,
            own,
        })
    }

    fn half_width(&self, information: &DMatrix<f64>) -> f64 {
        let told = information[(self.place, self.place)] > 0.0;
        let covariance = covariance(information).filter(|_| told);
        covariance.map_or(f64::INFINITY, |covariance| {
            QUANTILE * covariance[(self.place, self.place)].sqrt()
        })
    }

    fn interval(&self) -> [f64; 2] {
        let half = self.half_width(&self.own);
        let (_, scale, [low, high], value) = self.all[self.place];
        [-half, half].map(|away| outer(scale, inner(scale, value) + away).clamp(low, high))
    }

    fn hidden_by(&self) -> Option<(&'static str, f64)> {
        let covariance = covariance(&self.own)?;
        let k = self.place;
        let correlation =
            |j: usize| covariance[(j, k)] / (covariance[(j, j)] * covariance[(k, k)]).sqrt();
        let others = (0..self.all.len()).filter(|j| *j != k);
        let others = others.map(|j| (self.all[j].0, correlation(j)));
        others.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// The other manoeuvre that helps most, and the half width with both.
    fn companion(&self, all: &[Self]) -> Option<(Manoeuvre, f64)> {
        let own = self.manoeuvre.name;
        let others = all.iter().filter(|other| other.manoeuvre.name != own);
        let both =
            others.map(|other| (other.manoeuvre, self.half_width(&(&self.own + &other.rows))));
        both.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Covariance; a parameter without any information stands beside the others as if known.
fn covariance(information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let mut whole = information.clone();
    for k in 0..whole.nrows() {
        if whole[(k, k)] == 0.0 {
            whole[(k, k)] = 1.0;
        }
    }
    Some(whole.cholesky()?.inverse())
}

fn said(
    design: &Design,
    (name, wanted): (&str, &Wanted),
    manoeuvre: Manoeuvre,
    reach: &Reach,
) -> Result<Said, Failure> {
    let trace = &manoeuvre.trace(STEP, reach);
    let mut evidence = Evidence::of(trace, &Smoothed::of(trace));
    // All problems have the same parameters and starts.
    evidence.load = Some([-reach.load, reach.load]);
    evidence.temperature = Some(reach.temperature);
    evidence.speeds = [1e-2 * reach.speed, reach.speed];
    let Start {
        screw,
        values,
        choice,
    } = Start::of(design, &evidence, wanted)?;
    let grid = screw.grid(&values, Spacing::FINE)?;
    let prepared = Prepared::new(trace, &[], screw);
    let rows = prepared.rows_over_turns(WINDOW, true);
    let problem = prepared.remembered(rows, Known::of(&values, &choice, &grid));
    Said::of(name, manoeuvre, &problem)
}

pub fn tell(design: &Design, name: &str) -> Result<(), Failure> {
    let reach = Reach::of(design);
    print(
        &mut io::stdout().lock(),
        name,
        &reach,
        &ranked(design, name, &reach)?,
    )
}

/// Manoeuvres by how well they tell the wanted parameter, the best first.
fn ranked(design: &Design, name: &str, reach: &Reach) -> Result<Vec<Said>, Failure> {
    let others = BESIDE.split(' ').filter(|other| *other != name);
    let wanted = Wanted {
        estimate: Some(others.chain([name]).map(String::from).collect()),
        ..Wanted::default()
    };
    let all = MANOEUVRES.into_iter();
    let said = all.map(|manoeuvre| said(design, (name, &wanted), manoeuvre, reach));
    let mut said = said.collect::<Result<Vec<_>, _>>()?;
    said.sort_by(|a, b| a.half_width(&a.own).total_cmp(&b.half_width(&b.own)));
    Ok(said)
}

fn print(out: &mut impl Write, name: &str, reach: &Reach, all: &[Said]) -> Result<(), Failure> {
    let noise = 1e3 * NOISE;
    writeln!(
        out,
        "Manoeuvres that tell {name}, the best first; intervals (95 %) with a noise of {noise:.1} mN m. They reach {reach}."
    )?;
    for one in all {
        let (manoeuvre, value, [low, high]) = (one.manoeuvre, one.all[one.place].3, one.interval());
        let Manoeuvre {
            name,
            how,
            duration,
            ..
        } = manoeuvre;
        writeln!(out, "\n{name} ({duration:.0} s): {how}")?;
        writeln!(
            out,
            "  {value:.4e} would be told as {low:.4e} to {high:.4e}"
        )?;
        if let Some((other, correlation)) = one.hidden_by() {
            writeln!(
                out,
                "  hidden most by {other} (correlation {correlation:.3})"
            )?;
        }
        if let Some((other, width)) = one.companion(all) {
            let other = other.name;
            writeln!(
                out,
                "  with {other} as well: half-width of the interval {width:.3}"
            )?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::problem::{Evaluation, Model};
    use crate::fit::toys::{free, positive};
    use epas_design::files::DesignSource;

    /// 400 rows of `level temperature^warmth + gain load`, under a temperature and a load.
    fn said_of(wanted: &str, manoeuvre: Manoeuvre, signals: fn(f64) -> [f64; 2]) -> Said {
        let signals = move || (0..400).map(move |row| signals(0.1 * f64::from(row)));
        let problem = Model {
            nonlinear: vec![positive("warmth", 0.5, 0.01, 5.0)],
            linear: ["level", "gain"].map(free).into(),
            target: signals().map(|[warm, load]| warm.sqrt() + load).collect(),
            evaluate: Box::new(move |q| Evaluation {
                fixed: vec![0.0; 400],
                columns: vec![
                    signals().map(|[warm, _]| warm.powf(q[0])).collect(),
                    signals().map(|[_, load]| load).collect(),
                ],
            }),
        };
        Said::of(wanted, manoeuvre, &problem).unwrap()
    }

    /// What does not warm does not tell the effect of temperature: the interval stays that of even bounds, 1.96 ranges over root 12, and
    /// with the warm-up beside it becomes narrow. A load that hardly varies hides the level behind the gain.
    #[test]
    fn what_is_not_told_and_what_helps() {
        let of = |wanted: &str| {
            [
                said_of(wanted, MANOEUVRES[1], |at| [1.0, at.sin()]),
                said_of(wanted, MANOEUVRES[6], |at| [1.0, 1.0 + 0.01 * at.sin()]),
                said_of(wanted, MANOEUVRES[4], |at| [1.0 + at, at.sin()]),
            ]
        };
        let warmth = of("warmth");
        let even = QUANTILE * 500f64.ln() / 12f64.sqrt();
        for cold in &warmth[..2] {
            assert!((cold.half_width(&cold.own) - even).abs() < 1e-6 * even);
            let (companion, both) = cold.companion(&warmth).unwrap();
            assert!(companion.name == "warm-up" && both < 0.05 * even);
        }
        assert!(warmth[2].half_width(&warmth[2].own) < 0.05 * even);
        let (name, correlation) = of("level")[1].hidden_by().unwrap();
        assert!(name == "gain" && correlation < -0.99);
    }

    #[test]
    fn a_breakaway_angle_is_told_by_reversals_and_not_by_a_spin_down() {
        let design = "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap();
        let reach = Reach::of(&design);
        let found = ranked(&design, "breakaway_angle", &reach).unwrap();
        let names = [&found[0], &found[6]].map(|entry| entry.manoeuvre.name);
        assert_eq!(names, ["micro reversals", "spin-down"]);
        let mut text = Vec::new();
        print(&mut text, "breakaway_angle", &reach, &found).unwrap();
        let text = String::from_utf8(text).unwrap();
        for word in ["would be told as", "hidden most by", "as well: half"] {
            assert_eq!(text.matches(word).count(), 7, "{text}");
        }
        assert!(ranked(&design, "no_such_parameter", &reach).is_err());
    }
}
