//! Three scenes over the same weave of the same screw, the caged one beside the exact ball.

use epas_design::caged::Block;
use epas_design::caged_scene::{block, fold_for};
use epas_design::drawing::drawing;
use epas_design::files::train::UncagedDesign;
use epas_design::files::{Design, DesignSource};
use epas_design::manoeuvre::{Manoeuvre, Moment};
use epas_design::uncaged_scene::{Folded, ScrewConfiguration, configuration};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{FrictionModel, Inputs, UncagedBallScrew, UncagedBallScrewConfiguration};
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::RollingResistance;

use super::statistics::Errors;
use crate::study::{fresh, remembering};
use epas_page::failure::Failure;

const DESIGN: &str = "lin-3.6";

/// Moments, s apart, and their number.
const TICK: f64 = 1e-3;
const TICKS: usize = 5000;

/// Steps of the 37 balls from one moment to the next: at the largest speed of the nut a ball may not travel further than its room in one.
const STEPS: usize = 4;

const STRIDE: usize = 50;

pub struct Row {
    pub time: f64,
    pub speed: f64,
    pub load: f64,
    pub load_torque: f64,
    pub caged: f64,
    pub memory: f64,
    /// Friction of 37 balls with memory: all of it, of the grooves, between balls.
    pub balls: [f64; 3],
}

pub struct Weave {
    pub rows: Vec<Row>,
    pub errors: Errors,
}

impl Weave {
    pub fn new() -> Result<Self, Failure> {
        let source: DesignSource = DESIGN.parse().map_err(Failure::Data)?;
        let design = source.load()?;
        let Some(balls) = design.uncaged else {
            return Err(Failure::Data(format!("{DESIGN} says nothing of its balls")));
        };
        let moments = Manoeuvre::Weave
            .of_nut(design.screw())
            .ok_or_else(|| Failure::Data(format!("{DESIGN} has no lead")))?;
        let moments = &moments[..TICKS];
        let mean = moments.iter().map(|moment| moment.force.abs()).sum::<f64>() / TICKS as f64;
        let mut weave = Self {
            rows: Vec::new(),
            errors: Errors::default(),
        };
        weave.run(&design, &balls, moments, mean as f32)?;
        weave.compare(&design, moments);
        Ok(weave)
    }

    fn run(
        &mut self,
        design: &Design,
        balls: &UncagedDesign,
        moments: &[Moment],
        mean_load: f32,
    ) -> Result<(), Failure> {
        let own = (design.caged.friction, design.caged.friction);
        let Block::One(folded) = block(&fold_for(design, own).map_err(Failure::Data)?)? else {
            return Err(Failure::Data("one friction coefficient is one node".into()));
        };
        let mut caged = FrictionModel::<CagedBallScrew>::new(&folded)?;
        let mut memory = remembering::<CagedBallScrew>(&design.caged, folded, mean_load)?;
        let row = row_of_37(design, balls)?;
        let mut balls = remembering::<UncagedBallScrew<37>>(&balls.gear, row, mean_load)?;
        let (mut angle, mut last) = (0.0_f64, moments[0].speed);
        for moment in moments {
            // With the speed's mean over each step.
            let share = |step: usize| (step as f64 + 0.5) / STEPS as f64;
            let speeds = (0..STEPS).map(|step| last + share(step) * (moment.speed - last));
            let mut row = None;
            for speed in speeds {
                angle += TICK / STEPS as f64 * speed;
                let inputs = Inputs {
                    nut_speed: moment.speed as f32,
                    axial_load: moment.force as f32,
                };
                let reading = (angle % std::f64::consts::TAU) as f32;
                row = Some((inputs, reading, balls.step(fresh(inputs, reading))));
            }
            last = moment.speed;
            let Some((inputs, reading, balls)) = row else {
                continue;
            };
            let caged = caged.step(inputs);
            let memory = memory.step(fresh(inputs, reading));
            self.rows.push(Row {
                time: moment.time,
                speed: moment.speed,
                load: moment.force,
                load_torque: caged.load_torque.into(),
                caged: caged.friction_torque.into(),
                memory: memory.friction_torque.into(),
                balls: [
                    balls.friction_torque,
                    balls.groove_torque,
                    balls.ball_torque,
                ]
                .map(f64::from),
            });
        }
        Ok(())
    }

    /// The caged torque against the exact ball; near a reversal both pass with the speed by the same factor, which is no error of the law.
    fn compare(&mut self, design: &Design, moments: &[Moment]) {
        let caged = &design.caged;
        let screws: Vec<LoadedScrew> = moments
            .iter()
            .step_by(STRIDE)
            .map(|moment| LoadedScrew {
                design: drawing(caged.design.parameters()),
                clearance: caged.clearance.gap().into(),
                friction: caged.friction.into(),
                rolling: RollingResistance {
                    hysteresis_loss: caged.rolling_resistance.hysteresis_loss.into(),
                    lubricant_drag: caged.rolling_resistance.lubricant_drag.into(),
                },
                balls: caged.loaded_balls.into(),
                axial_load: moment.force * moment.speed.signum(),
            })
            .collect();
        let exact = LoadedScrew::solve_all(&screws, &|| ());
        let reversal_speed = f64::from(caged.reversal_speed);
        for (row, exact) in self.rows.iter().step_by(STRIDE).zip(exact) {
            if let Ok(exact) = exact {
                let factor = row.speed / row.speed.hypot(reversal_speed);
                self.errors.add(row.caged / (factor * exact.torque()) - 1.0);
            }
        }
    }
}

fn row_of_37(
    design: &Design,
    balls: &UncagedDesign,
) -> Result<UncagedBallScrewConfiguration, Failure> {
    let friction = (balls.gear.friction, balls.gear.friction);
    let row = configuration(design, balls, friction, 0.0)?;
    let Folded::One(folded) = row.folded else {
        return Err(Failure::Data("one friction coefficient is one node".into()));
    };
    let row = ScrewConfiguration {
        tick: (TICK / STEPS as f64) as f32,
        ..row
    };
    Ok(row.with(folded))
}

#[cfg(test)]
mod tests {
    use super::Weave;
    use crate::report::friction::reversal;

    /// Balls that press part within 40 ms of the pictured reversal. From where friction has no sign on, the torque of the row rises no faster
    /// than half as fast again as that of the cage.
    #[test]
    fn the_reversal_of_the_picture_has_no_step() {
        let rows = Weave::new().unwrap().rows;
        let start = reversal(&rows);
        let close: Vec<_> = rows
            .iter()
            .filter(|row| row.time > start)
            .take(60)
            .collect();
        let pressed = close[0].balls[2] / close[0].balls[0];
        assert!(pressed > 0.1, "{pressed}");
        let turned = close
            .iter()
            .position(|row| row.balls[0] * close[0].balls[0] < 0.0);
        let close = &close[turned.unwrap()..];
        let largest = |torque: &dyn Fn(&super::Row) -> f64| {
            let changes = close
                .windows(2)
                .map(|pair| torque(pair[1]) - torque(pair[0]));
            changes.fold(0.0, |largest: f64, change| largest.max(change.abs()))
        };
        let [row, cage] = [largest(&|row| row.balls[0]), largest(&|row| row.memory)];
        // Measured: 4.6e-3 N m in a tick, both; what pressed was 0.026.
        assert!(row < 1.5 * cage, "{row} {cage}");
    }
}
