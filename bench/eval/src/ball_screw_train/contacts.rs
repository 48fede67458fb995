//! What given contacts tell of a ball: which of them carry the axial load, and how far the contact angles deviate in
//! either groove.

use epas_friction::ball::GrooveFit;

/// Places of the flanks in a list of contacts.
const SL: usize = 0;
const SR: usize = 1;
const NL: usize = 2;
const NR: usize = 3;

/// Contacts of a ball as they are given: load, N, and contact angle, rad, in the order SL, SR, NL, NR.
pub type Given = [Option<(f32, f32)>; 4];

/// Furthest that loads, over the main ones, may be from those found for a ball. The closed form is within 0.048 of stored balls in
/// elastic grooves without play; twice that is let pass.
pub const LARGEST_LOAD_MISMATCH: f32 = 0.1;

#[derive(Clone, Copy)]
pub struct Ways {
    pub friction: f32,
    /// Speed of the nut, rad/s.
    pub nut_speed: f32,
}

/// A row of balls whose contacts are loaded alike.
pub struct Row {
    /// Loaded contacts alone.
    pub balls: Vec<Given>,
    /// Play where all balls have two contacts, none where all have three.
    pub fit: GrooveFit,
    /// The flanks on screw and nut that carry the axial load.
    pub main: [usize; 2],
    /// Nominal contact angle, rad.
    pub nominal: f32,
}

impl Row {
    /// None where the balls are not of one screw: some ball has four loaded contacts, numbers of contacts differ, or loads
    /// have different directions.
    pub fn of(balls: &[Given]) -> Option<Self> {
        let balls: Vec<Given> = balls
            .iter()
            .map(|ball| ball.map(|contact| contact.filter(|(load, _)| *load > 0.0)))
            .collect();
        let count = |ball: &Given| ball.iter().flatten().count();
        let fit = if balls.iter().all(|ball| count(ball) == 2) {
            GrooveFit::Play
        } else if balls.iter().all(|ball| count(ball) == 3) {
            GrooveFit::Zero
        } else {
            return None;
        };
        Some(Self {
            fit,
            main: main_flanks(&balls)?,
            nominal: nominal_angle(&balls),
            balls,
        })
    }

    /// Whether the axial load is below zero: carried by SR and NL.
    pub fn is_reversed(&self) -> bool {
        self.main == [SR, NL]
    }

    /// How far the screw's and the nut's groove are turned at a ball, rad, by the angles of its main contacts.
    pub fn deviations(&self, ball: &Given) -> Option<(f32, f32)> {
        let [(_, screw), (_, nut)] = self.loaded(ball)?;
        Some(if self.is_reversed() {
            (screw - self.nominal, self.nominal - nut)
        } else {
            (self.nominal - screw, nut - self.nominal)
        })
    }

    pub fn loaded(&self, ball: &Given) -> Option<[(f32, f32); 2]> {
        let [screw, nut] = self.main.map(|place| ball[place]);
        Some([screw?, nut?])
    }
}

/// The flanks on screw and nut that carry the axial load, the same of every ball.
fn main_flanks(balls: &[Given]) -> Option<[usize; 2]> {
    let load = |ball: &Given, place: usize| ball[place].map_or(0.0, |(load, _)| load);
    let carries = |[screw, nut]: [usize; 2]| {
        balls.iter().all(|ball| {
            let other = if [screw, nut] == [SR, NL] {
                [SL, NR]
            } else {
                [SR, NL]
            };
            load(ball, screw).min(load(ball, nut)) > load(ball, other[0]).max(load(ball, other[1]))
        })
    };
    [[SR, NL], [SL, NR]].into_iter().find(|pair| carries(*pair))
}

/// Grooves turn both of their contacts by the same angle, to either side: where a ball has both of one groove,
/// the nominal angle is their mean. Two contacts on different grooves do not tell it: their mean stands in.
fn nominal_angle(balls: &[Given]) -> f32 {
    let mut sum = 0.0;
    let mut count = 0.0_f32;
    for ball in balls {
        let pairs = match *ball {
            [Some((_, left)), Some((_, right)), ..] | [_, _, Some((_, left)), Some((_, right))] => {
                [left, right]
            }
            _ => {
                let mut angles = ball.iter().flatten().map(|(_, angle)| *angle);
                [angles.next(), angles.next()].map(Option::unwrap_or_default)
            }
        };
        sum += pairs.iter().sum::<f32>();
        count += 2.0;
    }
    sum / count
}
