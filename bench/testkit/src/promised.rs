//! Random states of the domain in which the reference promises an answer.

use epas_friction::geometry::{
    CATALOGUE, DISSERTATION_DESIGNS, FINE_LEAD_SIZES, STEERING_SIZES, named,
};
use epas_friction::{BallScrewParameters, GrooveSize};
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall};
use epas_reference::friction::patch::Integration;

use super::given;
use super::random::Random;

/// Designs on which a ball is hardest to balance, drawn as often as all others together: small balls, where a micrometre of clearance
/// counts most, and the designs of steering gears.
const HARDEST: [&str; 6] = [
    "16x5x3.175",
    "25x5x3.175",
    "50x5x3.175",
    "lin-2.1",
    "lin-3.6",
    "lin-4.1",
];

const LARGEST_DEVIATION: f64 = 3.0;

/// A state with its design's name.
pub struct Promised {
    /// Name of the design.
    pub name: &'static str,
    /// The state.
    pub row: ElasticRow,
}

impl Promised {
    /// A line that reproduces the state.
    pub fn line(&self) -> String {
        let row = &self.row;
        let balls = row.balls.iter().map(|ball| {
            format!(
                " [{:e} {:e} rad, {:e} N]",
                ball.screw_deviation, ball.nut_deviation, ball.axial_load
            )
        });
        format!(
            "{} clearance {:e} m, friction {:e}, nut {},{}",
            self.name,
            row.clearance,
            row.friction,
            row.nut_speed,
            balls.collect::<String>()
        )
    }
}

/// A row of `balls` balls: any built-in design, clearance -5 to 20 um, friction 0.05 to 0.15, 5 to 300 N of one sign a ball, either
/// direction of the nut; half the rows with grooves that deviate.
pub fn row(random: &mut Random, balls: usize) -> Promised {
    let (name, parameters) = design(random);
    let side = f64::from(random.sign());
    let deviates = random.one_in(2) || balls > 1;
    let deviation = if deviates {
        LARGEST_DEVIATION.to_radians()
    } else {
        0.0
    };
    Promised {
        name,
        row: ElasticRow {
            design: given::ball_screw(&parameters),
            clearance: random.between(-5e-6, 20e-6),
            friction: random.between(0.05, 0.15),
            ball_friction: 0.0,
            nut_speed: f64::from(random.sign()),
            balls: (0..balls)
                .map(|_| RowBall {
                    screw_deviation: deviation * random.signed(),
                    nut_deviation: deviation * random.signed(),
                    axial_load: side * random.between(5_f64.ln(), 300_f64.ln()).exp(),
                })
                .collect(),
            chord: true,
            integration: Integration::Full,
        },
    }
}

fn design(random: &mut Random) -> (&'static str, BallScrewParameters) {
    let kind = random.below(14);
    if kind < HARDEST.len() {
        let name = HARDEST[kind];
        return (name, named(name).unwrap());
    }
    if kind == HARDEST.len() {
        let groove = GrooveSize::Conformity(0.52);
        let close = BallScrewParameters {
            pitch_radius: 31.5e-3,
            lead: 20e-3,
            ball_radius: 4.7625e-3,
            screw_groove: groove,
            nut_groove: groove,
            ..DISSERTATION_DESIGNS[0].parameters
        };
        return ("63x20x9.525 conformity 0.52", close);
    }
    let sizes: Vec<_> = CATALOGUE
        .iter()
        .chain(&FINE_LEAD_SIZES)
        .chain(&STEERING_SIZES)
        .collect();
    let size = sizes[random.below(sizes.len())];
    (size.name, size.parameters())
}
