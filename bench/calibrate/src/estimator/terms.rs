//! Terms of the equation, and their columns.

use nalgebra::DMatrix;

use super::fit::Block;
use super::kernel::Kernel;
use super::record::Record;
use super::rows::Rows;
use crate::trace::Coordinate;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Term {
    /// Inertia or mass: `a`.
    Inertia,
    /// Viscous friction: `w`.
    Viscous,
    /// An effort that is always there: 1.
    Offset,
    /// Coulomb friction: `s`.
    Coulomb,
    /// Coulomb and viscous friction as one number, of a motion at one speed: `s`.
    OneSpeed,
    /// Loss in proportion to the load where it opposes the motion: `s |tau|`.
    Driving,
    BackDriving,
    /// Effort of a unit of load: `F`.
    Gain,
    /// Loss of both directions of power of a unit of load: `s |F|`.
    Loss,
    /// Zero error of the load: 1 where it opposes the motion, -1 where it assists.
    LoadZero,
    /// Lag of a measured speed, s: the rate of the acceleration. Its coefficient is `J D`, that of the acceleration `J + b D`.
    Lag,
    /// Sine of so many rad of the position, 1/rad or 1/m.
    Sine(f64),
    Cosine(f64),
    /// Viscous friction that differs by direction: `|w|`.
    Asymmetry,
    /// Friction that falls away from rest over a speed, rad/s or m/s: `s exp(-|w|/w_s)`.
    Stribeck(f64),
}

impl Term {
    pub const fn name(self, coordinate: Coordinate) -> &'static str {
        match self {
            Self::Inertia => match coordinate {
                Coordinate::Rotation => "inertia",
                Coordinate::Translation => "mass",
            },
            Self::Viscous => "viscous_friction",
            Self::Offset => "offset",
            Self::Coulomb => "coulomb_friction",
            Self::OneSpeed => "friction_at_one_speed",
            Self::Driving => "driving_loss",
            Self::BackDriving => "back_driving_loss",
            Self::Gain => "load_gain",
            Self::Loss => "load_loss",
            Self::LoadZero => "load_zero",
            Self::Lag => "speed_lag",
            Self::Sine(_) => "sine_of_position",
            Self::Cosine(_) => "cosine_of_position",
            Self::Asymmetry => "viscous_asymmetry",
            Self::Stribeck(_) => "stribeck_friction",
        }
    }

    pub const fn unit(self, coordinate: Coordinate) -> &'static str {
        let [rotation, translation] = match self {
            Self::Inertia => ["kg m^2", "kg"],
            Self::Viscous | Self::Asymmetry => ["N m s/rad", "N s/m"],
            Self::Driving | Self::BackDriving => ["", ""],
            Self::Gain | Self::Loss => ["m/rad", ""],
            Self::Lag => ["s", "s"],
            _ => ["N m", "N"],
        };
        match coordinate {
            Coordinate::Rotation => rotation,
            Coordinate::Translation => translation,
        }
    }
}

impl Block {
    pub fn of(record: &Record, rows: &Rows, terms: &[Term]) -> Self {
        let derivative = |k: usize| rows.sums(record.order(k), &record.motion);
        let signed = |values: Vec<f64>| -> Vec<f64> {
            let both = values.iter().zip(&rows.directions);
            both.map(|(value, direction)| value * direction).collect()
        };
        let load = record.load.as_deref();
        let parts = load.map(|load| rows.parts(load));
        // Where the load opposes the motion its positive part counts in one direction, its negative part in the other.
        let loss = |opposing: bool| -> Vec<f64> {
            let Some([positive, negative]) = &parts else {
                return vec![0.0; rows.len()];
            };
            let pick = |row: usize| {
                let direction = rows.directions[row];
                let part = if (direction > 0.0) == opposing {
                    positive
                } else {
                    negative
                };
                direction * part[row]
            };
            (0..rows.len()).map(pick).collect()
        };
        let of_path = |of: &dyn Fn(f64) -> f64| {
            let signal: Vec<f64> = record.path.iter().map(|x| of(*x)).collect();
            rows.sums(0, &signal)
        };
        let of_speed = |of: &dyn Fn(f64) -> f64| {
            let speed = rows.kernel.along(record.order(1), &record.motion);
            let signal: Vec<f64> = speed.iter().map(|w| of(*w)).collect();
            rows.sums(0, &signal)
        };
        let column = |term: &Term| match *term {
            Term::Inertia => derivative(2),
            Term::Viscous => derivative(1),
            Term::Lag => derivative(3),
            Term::Offset => vec![1.0; rows.len()],
            Term::Coulomb | Term::OneSpeed => rows.directions.clone(),
            Term::Driving => loss(true),
            Term::BackDriving => loss(false),
            Term::Gain => load.map_or_else(Vec::new, |load| rows.sums(0, load)),
            Term::Loss => {
                let both = loss(true).into_iter().zip(loss(false));
                both.map(|(one, other)| one + other).collect()
            }
            Term::LoadZero => signed(load.map_or_else(Vec::new, |load| rows.signs(load))),
            Term::Sine(wave) => of_path(&|x| (wave * x).sin()),
            Term::Cosine(wave) => of_path(&|x| (wave * x).cos()),
            Term::Asymmetry => signed(derivative(1)),
            Term::Stribeck(speed) => signed(of_speed(&|w| (-w.abs() / speed).exp())),
        };
        let derivatives = terms.iter().map(|term| match term {
            Term::Viscous => Some(1),
            Term::Inertia => Some(2),
            Term::Lag => Some(3),
            _ => None,
        });
        let mut target = rows.sums(0, &record.effort);
        if record.load_is_effort
            && let Some(load) = load
        {
            for (target, load) in target.iter_mut().zip(rows.sums(0, load)) {
                *target -= load;
            }
        }
        Self {
            columns: terms.iter().map(column).collect(),
            target,
            noise: rows.noise(record, &derivatives.collect::<Vec<_>>()),
            stretches: rows.stretches.clone(),
            pieces: rows.pieces.clone(),
        }
    }

    /// A run at one speed as one row, which counts as `weight` rows: the kernel over the whole run, which passes less of a ripple whose last
    /// period is cut than a mean does.
    pub fn of_run(record: &Record, terms: &[Term], weight: f64) -> Option<Self> {
        let (speed, range) = record.one_speed()?;
        let half = (range.len() - 1) / 2;
        let kernel = Kernel::new(half, record.tick);
        let centre = range.start + half;
        let mean = |signal: &[f64]| kernel.at(0, signal, centre);
        let speed = if record.speed_alone {
            mean(&record.motion)
        } else {
            speed
        };
        let direction = speed.signum();
        let load = record.load.as_deref().map_or(0.0, mean);
        let opposing = (direction * load).max(0.0);
        let assisting = (-direction * load).max(0.0);
        let size = weight.sqrt();
        let column = |term: &Term| {
            let value = match *term {
                Term::Viscous => speed,
                Term::Offset => 1.0,
                Term::Coulomb | Term::OneSpeed => direction,
                Term::Driving => direction * opposing,
                Term::BackDriving => direction * assisting,
                Term::Gain => load,
                Term::Loss => direction * (opposing + assisting),
                Term::LoadZero => (direction * load).signum(),
                Term::Asymmetry => speed.abs(),
                Term::Stribeck(of) => direction * (-speed.abs() / of).exp(),
                Term::Inertia | Term::Lag | Term::Sine(_) | Term::Cosine(_) => 0.0,
            };
            vec![size * value]
        };
        let own = if record.load_is_effort { load } else { 0.0 };
        Some(Self {
            columns: terms.iter().map(column).collect(),
            target: vec![size * (mean(&record.effort) - own)],
            noise: DMatrix::zeros(terms.len(), terms.len()),
            stretches: vec![0],
            pieces: vec![0],
        })
    }
}
