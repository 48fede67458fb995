//! An uncaged ball screw in float64, exactly: every ball in elastic grooves with contact integrals, and the forces
//! between them, over a trace of changing speed and load.

use std::f64::consts::TAU;

use epas_design::drawing::drawing;
use epas_friction::{DeviationMap, LoadShare};
use epas_reference::ReferenceError;
use epas_reference::curvature::Groove;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ring::{
    ElasticRing, GrooveDeviation, RingSample, RingState,
};
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::{RollingResistance, relative_radii};

use super::reference::{Friction, Moving};
use super::samples::ScrewSample;
use super::summary::Lines;
use super::trace::Trace;
use epas_design::files::train::UncagedDesign;
use epas_page::failure::Failure;
use epas_page::progress::Progress;

/// Most states of 37 balls, which take a minute at most; of more balls fewer.
const MOST_STATES: usize = 10_000;
const BALLS: usize = 37;

const SAMPLES: u32 = 64;

/// Friction at every sample, from states at no more than [`MOST_STATES`] of them, with lines that say so.
pub fn exact_screw(
    design: &UncagedDesign,
    trace: &Trace<ScrewSample>,
) -> Result<(Vec<Friction>, Lines), Failure> {
    let failure = |error: &dyn std::fmt::Display| Failure::Data(format!("--reference: {error}"));
    let samples = &within_limits(design, trace);
    let screw = ring(design, samples)?;
    let most = MOST_STATES * BALLS / BALLS.max(design.balls.into());
    let chosen = chosen(samples, most);
    let asked = asked(samples, &chosen);
    let progress = Progress::new("exact screw", asked.len());
    let states = screw
        .simulate(&asked, |_, _| progress.step())
        .map_err(|error| failure(&error))?;
    drop(progress);

    let unsolved: Vec<f64> = states
        .iter()
        .zip(&asked)
        .filter(|(state, asked)| !state.solved() && asked.nut_speed != 0.0)
        .map(|(_, asked)| asked.time)
        .collect();
    let first = unsolved.first();
    let first = first.map_or_else(String::new, |time| format!(", the first at {time} s"));
    let mut lines = Lines::default();
    let between = if chosen.len() < samples.len() {
        ", linear in between"
    } else {
        ""
    };
    lines.add(
        "reference",
        format!(
            "exact whole screw at {} of {} samples{between}; {} states without a solution{first}",
            chosen.len(),
            samples.len(),
            unsolved.len()
        ),
    );
    let rolling = Rolling::new(design).map_err(|error| failure(&error))?;
    let sizes: Vec<f64> = states
        .iter()
        .map(|state| state.torque().abs() + rolling.torque(state))
        .collect();
    Ok((friction(design, samples, &chosen, &sizes), lines))
}

fn within_limits(design: &UncagedDesign, trace: &Trace<ScrewSample>) -> Vec<ScrewSample> {
    let limits = design.gear.limits;
    let within = |value: f64, limit: f32| value.clamp(-f64::from(limit), limit.into());
    trace
        .samples
        .iter()
        .map(|sample| ScrewSample {
            nut_speed: within(sample.nut_speed, limits.nut_speed),
            axial_load: within(sample.axial_load, limits.axial_load),
            ..*sample
        })
        .collect()
}

/// The screw of a design, with the table of load shares that the samples need.
fn ring(design: &UncagedDesign, samples: &[ScrewSample]) -> Result<ElasticRing, Failure> {
    let gear = &design.gear;
    let pushes = samples.iter().any(|sample| sample.axial_load > 0.0);
    let pulls = samples.iter().any(|sample| sample.axial_load < 0.0);
    let shares = design.load_shares;
    if pushes && pulls && shares.positive != shares.negative {
        return Err(Failure::Data(
            "--reference has one table of load shares, and this trace needs those of both signs of the load".into(),
        ));
    }
    let shares = if pulls {
        shares.negative
    } else {
        shares.positive
    };
    Ok(ElasticRing {
        design: drawing(gear.design.parameters()),
        clearance: gear.clearance.gap().into(),
        friction: gear.friction.into(),
        ball_friction: design.ball_friction.into(),
        balls: design.balls.into(),
        turns: design.turns.into(),
        return_length: design.return_length.into(),
        screw_deviation: deviation(design.screw_deviation),
        nut_deviation: deviation(design.nut_deviation),
        load_shares: shares
            .iter()
            .map(|share: &LoadShare| share.share().into())
            .collect(),
        chord: true,
        places: Vec::new(),
        integration: Integration::Full,
    })
}

fn deviation(map: &DeviationMap) -> GrooveDeviation {
    GrooveDeviation::Samples {
        turns: map.turns().into(),
        values: (0..SAMPLES)
            .map(|sample| map.at(sample << (32 - SAMPLES.ilog2())).into())
            .collect(),
    }
}

/// Way of a speed: 1, -1, or 0 at rest.
fn way(speed: f64) -> f64 {
    if speed == 0.0 { 0.0 } else { speed.signum() }
}

/// Places of the samples at which the screw is solved: evenly from the first to the last, and the last before and the
/// first after the motion turns, stops or sets in.
fn chosen(samples: &[ScrewSample], most: usize) -> Vec<usize> {
    let last = samples.len() - 1;
    let turns: Vec<usize> = samples
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| way(pair[0].nut_speed) != way(pair[1].nut_speed))
        .flat_map(|(place, _)| [place, place + 1])
        .collect();
    // A trace that turns all the time is followed evenly.
    let (turns, even) = if turns.len() <= most / 2 {
        let even = most - turns.len();
        (turns, even)
    } else {
        (Vec::new(), most)
    };
    let parts = (even - 1).min(last.max(1));
    let mut chosen: Vec<usize> = (0..=parts).map(|part| part * last / parts).collect();
    chosen.extend(turns);
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// The same for the reference: from each chosen sample to the next the speed is the mean one, so that the nut's angle is
/// that of the trace.
fn asked(samples: &[ScrewSample], chosen: &[usize]) -> Vec<RingSample> {
    chosen
        .iter()
        .enumerate()
        .map(|(index, &place)| {
            let first = samples[place];
            let speed = chosen.get(index + 1).map(|&next| {
                let angle: f64 = samples[place..=next]
                    .windows(2)
                    .map(|pair| pair[0].nut_speed * (pair[1].time - pair[0].time))
                    .sum();
                angle / (samples[next].time - first.time)
            });
            RingSample {
                time: first.time,
                nut_speed: speed
                    .filter(|speed| speed.is_finite())
                    .unwrap_or(first.nut_speed),
                axial_load: first.axial_load,
            }
        })
        .collect()
}

/// Rolling resistance of all contacts, for screw and nut; the grooves run past the contacts as past those of a nominal
/// ball.
struct Rolling {
    resistance: RollingResistance,
    radii: [f64; 2],
    /// Semi-minor axes under 1 N, m.
    semi_minor: [f64; 2],
    /// Way of a groove past a contact over the angle of the nut, m.
    travel: f64,
}

impl Rolling {
    fn new(design: &UncagedDesign) -> Result<Self, ReferenceError> {
        let drawing = drawing(design.gear.design.parameters());
        let resistance = &design.gear.rolling_resistance;
        let (path, cos) = (
            drawing.pitch_radius.hypot(drawing.lead / TAU),
            drawing.lead_angle().cos(),
        );
        let arm = drawing.ball_radius * cos * drawing.contact_angle.cos();
        let both = |of: fn(&BallScrewDesign, Groove) -> Result<f64, ReferenceError>| {
            Ok::<_, ReferenceError>([of(&drawing, Groove::Screw)?, of(&drawing, Groove::Nut)?])
        };
        Ok(Self {
            resistance: RollingResistance {
                hysteresis_loss: resistance.hysteresis_loss.into(),
                lubricant_drag: resistance.lubricant_drag.into(),
            },
            radii: both(|drawing, groove| Ok(relative_radii(drawing, groove)?[0]))?,
            semi_minor: both(|drawing, groove| Ok(drawing.contact(groove)?.semi_minor))?,
            // A nominal ball passes both grooves equally fast: w_B (L_p - c) = (w_N - w_B) (L_p + c).
            travel: 0.5 * (path * path - arm * arm) / path,
        })
    }

    /// Torque on the nut, N m.
    fn torque(&self, state: &RingState) -> f64 {
        let of = |load: f64, groove: usize| {
            let semi_minor = self.semi_minor[groove] * load.cbrt();
            let hysteresis = self
                .resistance
                .hysteresis_force(load, semi_minor, self.radii[groove]);
            hysteresis + self.resistance.lubricant_force(load)
        };
        let forces = state.balls.iter().map(|ball| {
            let [sl, sr, nl, nr] = ball.loads;
            of(sl, 0) + of(sr, 0) + of(nl, 1) + of(nr, 1)
        });
        self.travel * forces.sum::<f64>()
    }
}

/// Friction at every sample from its size at the chosen ones, linear in between; no number where a state beside it was not found.
fn friction(
    design: &UncagedDesign,
    samples: &[ScrewSample],
    chosen: &[usize],
    sizes: &[f64],
) -> Vec<Friction> {
    let gear = &design.gear;
    let reduced_lead = f64::from(gear.design.parameters().lead) / TAU;
    let reversal_speed = f64::from(gear.reversal_speed);
    let largest = f64::from(gear.limits.friction_torque);
    let mut index = 0;
    samples
        .iter()
        .enumerate()
        .map(|(place, sample)| {
            while chosen.get(index + 1).is_some_and(|next| *next <= place) {
                index += 1;
            }
            let speed = sample.nut_speed;
            let at = match chosen.get(index + 1) {
                _ if speed == 0.0 => 0.0,
                Some(&next) if place > chosen[index] => {
                    let from = samples[chosen[index]].time;
                    let part = (sample.time - from) / (samples[next].time - from);
                    (1.0 - part) * sizes[index] + part * sizes[index + 1]
                }
                _ => sizes[index],
            };
            let direction = speed / speed.hypot(reversal_speed);
            let torque = direction * at;
            let moving = Moving {
                load_torque: sample.axial_load * reduced_lead,
                stands: speed.abs() < reversal_speed,
            };
            moving.friction(if torque.is_nan() {
                torque
            } else {
                torque.clamp(-largest, largest)
            })
        })
        .collect()
}
