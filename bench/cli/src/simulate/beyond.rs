//! Why samples are flagged as beyond the model, or their forces as not held, and under which loads.

use std::fmt::Write as _;

use epas_design::{CagedFold, UncagedFold};
use epas_friction::{Faults, Inputs};

use super::summary::Lines;
use epas_design::files::Design;
use epas_design::files::train::UncagedDesign;

/// Loads within this of the largest that a block holds may be flagged: roundings of its logarithm.
const ROUNDED: f32 = 0.999;

/// The same where fewer balls may carry at an angle than in the mean.
const SHARED: f32 = 0.9;

/// Bands of one cause that are listed; more are told from the least to the largest load.
const MOST_BANDS: usize = 3;

/// Why a block does not hold a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    Load,
    Coefficient,
    Forces,
    Grip,
    FourPoints,
}

const CAUSES: [Cause; 5] = [
    Cause::Load,
    Cause::Coefficient,
    Cause::Forces,
    Cause::Grip,
    Cause::FourPoints,
];

/// Where what a block does not hold depends on whether the load opposes the motion.
const fn by_direction(cause: Cause) -> bool {
    matches!(cause, Cause::Forces | Cause::Grip)
}

#[derive(Clone, Copy, Debug)]
struct Moment {
    /// Size of the load, N.
    load: f32,
    opposing: bool,
    cause: Option<Cause>,
}

#[derive(Clone, Copy, Debug)]
enum Held {
    Caged { most: f32 },
    Uncaged { most: f32 },
    Bearing,
}

/// What samples of a run are beyond.
#[derive(Clone, Debug)]
pub struct Beyond {
    held: Held,
    /// Load of the ball that carries most under a newton; none where it is not told.
    of_ball: Option<f32>,
    /// Largest load that a model takes, N.
    limit: f32,
    domain: String,
    moments: Vec<Moment>,
}

impl Beyond {
    pub fn caged(design: &Design, fold: &CagedFold) -> Self {
        let CagedFold {
            axial_load: [from, to],
            friction,
            ..
        } = *fold;
        let mut domain = format!("the block holds {from} to {to} N a ball");
        if let Some([least, most]) = friction {
            let _ = write!(domain, ", friction coefficients {least} to {most}");
        }
        Self {
            held: Held::Caged { most: to },
            of_ball: Some(1.0 / f32::from(design.caged.loaded_balls)),
            limit: design.caged.limits.axial_load,
            domain,
            moments: Vec::new(),
        }
    }

    pub fn uncaged(balls: &UncagedDesign, fold: &UncagedFold) -> Self {
        let [from, to] = fold.axial_load;
        Self {
            held: Held::Uncaged { most: to },
            of_ball: Some(balls.ball_load(1.0)),
            limit: balls.gear.limits.axial_load,
            domain: format!("the block holds {from} to {to} N a ball"),
            moments: Vec::new(),
        }
    }

    pub const fn bearing() -> Self {
        Self {
            held: Held::Bearing,
            of_ball: None,
            limit: f32::MAX,
            domain: String::new(),
            moments: Vec::new(),
        }
    }

    pub fn add(&mut self, speed: f64, load: f64, faults: Faults) {
        let inputs = Inputs {
            nut_speed: speed as f32,
            axial_load: (load as f32).clamp(-self.limit, self.limit),
        };
        let cause = if faults.contains(Faults::BEYOND_MODEL) {
            Some(self.cause(inputs))
        } else {
            faults
                .contains(Faults::FORCES_NOT_HELD)
                .then_some(Cause::Forces)
        };
        self.moments.push(Moment {
            load: inputs.axial_load.abs(),
            opposing: opposing(inputs),
            cause,
        });
    }

    fn cause(&self, inputs: Inputs) -> Cause {
        let load = inputs.axial_load.abs();
        let above = |most: f32| load * self.of_ball.unwrap_or(0.0) > most;
        match self.held {
            Held::Bearing => Cause::FourPoints,
            Held::Caged { most } if above(ROUNDED * most) => Cause::Load,
            Held::Uncaged { most } if above(SHARED * most) => Cause::Load,
            Held::Caged { .. } => Cause::Coefficient,
            Held::Uncaged { .. } => Cause::Grip,
        }
    }

    fn reason(&self, cause: Cause) -> String {
        match cause {
            Cause::Load => format!("{} (axial_load in [fold])", self.domain),
            Cause::Coefficient => {
                format!(
                    "{}; the coefficient leaves them (friction in [fold])",
                    self.domain
                )
            }
            Cause::Forces => {
                "a ball loses a contact, or friction between balls is more than a train takes; the torque is held"
                    .into()
            }
            Cause::Grip => {
                "friction between balls is more than the law holds (ball_friction in [uncaged])"
                    .into()
            }
            Cause::FourPoints => "neighbours press a ball off two of its four contacts".into(),
        }
    }

    pub fn lines(mut self, lines: &mut Lines) {
        self.moments
            .sort_by(|one, other| one.load.total_cmp(&other.load));
        for cause in CAUSES {
            let sides: &[Option<bool>] = if by_direction(cause) {
                &[Some(true), Some(false)]
            } else {
                &[None]
            };
            for side in sides {
                let bands = self.bands(cause, *side);
                if bands.is_empty() {
                    continue;
                }
                let motion = match side {
                    None => "",
                    Some(true) => ", load against the motion",
                    Some(false) => ", load in the direction of travel",
                };
                let bands: Vec<String> = bands.into_iter().map(|band| self.band(band)).collect();
                let text = format!("{}{motion}: {}", bands.join(" and "), self.reason(cause));
                let what = match cause {
                    Cause::Forces => "forces not held",
                    _ => "beyond the model",
                };
                lines.add(what, text);
            }
        }
    }

    /// Runs of samples beyond for a cause, by their loads, N.
    fn bands(&self, cause: Cause, side: Option<bool>) -> Vec<[f32; 2]> {
        let mut bands: Vec<[f32; 2]> = Vec::new();
        let mut open = false;
        let asked = |moment: &&Moment| side.is_none_or(|side| moment.opposing == side);
        for moment in self.moments.iter().filter(asked) {
            let beyond = moment.cause == Some(cause);
            match bands.last_mut() {
                Some([_, to]) if beyond && open => *to = moment.load,
                _ if beyond => bands.push([moment.load; 2]),
                _ => {}
            }
            open = beyond;
        }
        match bands[..] {
            [[from, _], .., [_, to]] if bands.len() > MOST_BANDS => vec![[from, to]],
            _ => bands,
        }
    }

    fn band(&self, band: [f32; 2]) -> String {
        let range = |factor: f32| {
            let [from, to] = band.map(|load| newtons(factor * load));
            if from == to {
                from
            } else {
                format!("{from} to {to}")
            }
        };
        match self.of_ball {
            Some(of_ball) => format!(
                "{} N on the screw ({} N a ball)",
                range(1.0),
                range(of_ball)
            ),
            None => format!("{} N of normal load", range(1.0)),
        }
    }
}

/// Whether the load opposes the motion; of a nut at rest, as the model takes it, the motion forward.
fn opposing(inputs: Inputs) -> bool {
    let direction = if inputs.nut_speed < 0.0 { -1.0 } else { 1.0 };
    direction * inputs.axial_load >= 0.0
}

fn newtons(load: f32) -> String {
    match load {
        100.0.. => format!("{load:.0}"),
        10.0.. => format!("{load:.1}"),
        _ => format!("{load:.2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::caged::fold;
    use epas_design::files::read;

    const GEAR: &str = "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.7853982\n\
                        loaded_balls = 50\n";

    const fn faults(flagged: bool) -> Faults {
        if flagged {
            Faults::BEYOND_MODEL
        } else {
            Faults::NONE
        }
    }

    fn told(mut beyond: Beyond, samples: &[(f64, f64, bool)]) -> Vec<String> {
        for (speed, load, flagged) in samples {
            beyond.add(*speed, *load, faults(*flagged));
        }
        let mut lines = Lines::default();
        beyond.lines(&mut lines);
        let mut text = Vec::new();
        lines.print(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        text.lines().map(String::from).collect()
    }

    /// Loads above the block's, of both signs, are one band; a coefficient is another cause, and nothing flagged is no line.
    #[test]
    fn loads_above_the_block_are_a_band() {
        let design = read(&format!("{GEAR}[fold]\naxial_load = [5, 100]\n"), "gear").unwrap();
        let beyond = || Beyond::caged(&design, &fold(&design, false).unwrap().unwrap());
        let lines = told(
            beyond(),
            &[
                (1.0, 100.0, false),
                (1.0, 5_010.0, true),
                (-1.0, -8e3, true),
                (1.0, 6e3, true),
                (0.0, 4_900.0, false),
            ],
        );
        assert_eq!(lines.len(), 1, "{lines:?}");
        let words = "5010 to 8000 N on the screw (100 to 160 N a ball): the block holds 5 to 100 N a ball (axial_load in [fold])";
        assert!(lines[0].contains(words), "{lines:?}");
        assert!(told(beyond(), &[(1.0, 100.0, false)]).is_empty());
        let lines = told(beyond(), &[(1.0, 100.0, true)]);
        assert!(lines[0].contains("friction in [fold]"), "{lines:?}");
    }

    /// A sample that is held parts two bands; of many bands the ends are told.
    #[test]
    fn bands_are_parted_by_what_is_held() {
        let mut beyond = Beyond::bearing();
        for (place, load) in (1_u8..=9).enumerate() {
            let flagged = place % 2 == 0 && place < 3;
            beyond.add(1.0, load.into(), faults(flagged));
        }
        let lines = told(beyond, &[]);
        assert!(
            lines[0].contains("1.00 N of normal load and 3.00 N of normal load: neighbours"),
            "{lines:?}"
        );
        let many: Vec<(f64, f64, bool)> = (1_u8..=9)
            .map(|load| (1.0, load.into(), load % 2 == 1))
            .collect();
        let lines = told(Beyond::bearing(), &many);
        assert!(
            lines[0].contains("1.00 to 9.00 N of normal load"),
            "{lines:?}"
        );
    }
}
