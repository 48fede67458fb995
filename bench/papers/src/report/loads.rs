//! Static loads: Figures 2.9 to 2.14 and 4.10 of Lin 2019, and tables of load shares.

mod shares;

use std::sync::Arc;

use crate::load_studies::Waviness;
use crate::published::loads::{case_2, case_3};
use epas_reference::error::ReferenceError;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::shaft::ShaftModel;
use epas_reference::statics::surface::{HarmonicError, ProfileError};
use epas_reference::statics::{Contact, StaticLoad, StaticSolution, SurfaceError};

use super::Context;
use epas_bench::report::draw::{chart, figure};
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Panel, Series};

fn solve(case: &CaseStudy) -> Result<StaticSolution, ReferenceError> {
    case.load()?.solve()
}

pub fn section(_: &Context) -> Result<Section, Failure> {
    let nominal = solve(&CaseStudy::table_2_1())?;
    Ok(Section {
        title: "Static loads",
        blocks: vec![
            Block::Text(
                "The float64 reference of Lin 2019, chapter 2: loads of the balls of a ball screw whose screw bends, twists and \
                 stretches. The outer diameter of the screw is not printed; 32 mm is taken. Curvatures are the right ones; Table \
                 B.1 is printed with others, without effect on the loads that the figures could show."
                    .into(),
            ),
            figures_2_9_and_10(&nominal)?,
            figures_2_11_and_12(&nominal)?,
            figure_2_14(&nominal)?,
            figure_4_10()?,
            Block::Table(shares::table()?),
        ],
    })
}

pub fn largest(forces: &[f64]) -> f64 {
    forces.iter().copied().fold(0.0, f64::max)
}

pub fn by_ball(forces: impl IntoIterator<Item = f64>) -> Vec<(f64, f64)> {
    let numbered = forces.into_iter().enumerate();
    numbered
        .map(|(ball, force)| (ball as f64 + 1.0, force))
        .collect()
}

type Line<'a> = (&'a str, usize, Mark, &'a StaticSolution, Contact);

fn loads(title: &str, lines: &[Line]) -> Panel {
    let line = |&(name, colour, mark, solution, contact): &Line| {
        Series::new(name, colour, mark, by_ball(solution.of(contact)))
    };
    let (x, y) = (Axis::linear("ball"), Axis::linear("contact force (N)"));
    chart(title, x, y, lines.iter().map(line).collect())
}

fn figures_2_9_and_10(nominal: &StaticSolution) -> Result<Block, Failure> {
    let mut setup = CaseStudy::table_2_1().setup()?;
    setup.shaft.model = ShaftModel::Bar;
    let bar = StaticLoad::new(setup)?.solve()?;
    let centreline = |(axis, name): (usize, &str)| {
        let places = nominal.positions.iter().zip(&nominal.displacements);
        let points = places.map(|(position, moved)| (1e3 * position, 1e6 * moved[axis]));
        Series::new(name, axis, Mark::Line, points.collect())
    };
    let centreline = ["x", "y"].into_iter().enumerate().map(centreline);
    let beams = [
        ("beam, SL", 0, Mark::Line, nominal, Contact::ScrewLeft),
        ("beam, NR", 1, Mark::Dashed, nominal, Contact::NutRight),
        ("bar, SL", 6, Mark::Line, &bar, Contact::ScrewLeft),
    ];
    let x = Axis::linear("position (mm)");
    let y = Axis::linear("lateral displacement (µm)");
    Ok(figure(
        "lin_figures_2_9_2_10",
        "Lin 2019, Figures 2.9 and 2.10: loads of the 32 balls under 5000 N, by the beam and by a screw that only stretches, and the \
         beam's centreline: an axial load bends the screw.",
        (2, 540, 380),
        vec![
            loads("case study 1", &beams),
            chart("centreline", x, y, centreline.collect()),
        ],
    ))
}

fn figures_2_11_and_12(nominal: &StaticSolution) -> Result<Block, Failure> {
    let large = solve(&case_2())?;
    let (free, aside) = (solve(&case_3(false))?, solve(&case_3(true))?);
    let (left, right) = (Contact::ScrewLeft, Contact::ScrewRight);
    let case_2 = [
        ("with a large ball", 1, Mark::Line, &large, left),
        ("without", 0, Mark::Dashed, nominal, left),
    ];
    let case_3 = [
        ("SL, aside", 0, Mark::Line, &aside, left),
        ("SL, free", 0, Mark::Dashed, &free, left),
        ("SR, aside", 1, Mark::Line, &aside, right),
        ("SR, free", 1, Mark::Dashed, &free, right),
    ];
    Ok(figure(
        "lin_figures_2_11_2_12",
        "Lin 2019, Figures 2.11 and 2.12: ball 17 with 1 µm more radius takes a fifth more, its neighbours 2 % less; with 7 µm on every \
         ball all four contacts carry, and 300 µm aside at the end squeeze the last balls on SR and NL.",
        (2, 540, 400),
        vec![
            loads("case study 2", &case_2),
            loads("case study 3", &case_3),
        ],
    ))
}

/// 32 normal numbers of variance 1 by the sum of twelve of a fixed sequence (xorshift).
fn normal() -> Vec<f64> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..32)
        .map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0)
        .collect()
}

fn figure_2_14(nominal: &StaticSolution) -> Result<Block, Failure> {
    // Section 2.4.2: offsets of SL, SR, NL, NR in micrometres, 3 - gamma and so on.
    let profiles = [(3.0, -1.0), (3.0, -0.5), (2.0, -1.0), (2.0, -0.25)];
    let pitches = [(3.0, 1.0), (3.0, 1.0), (-2.0, 0.5), (-2.0, 0.5)];
    let solve = |profile: bool, pitch: bool, radius: bool| {
        let case = CaseStudy {
            ball_oversize: if radius {
                normal().iter().map(|size| 1e-6 * size).collect()
            } else {
                Vec::new()
            },
            ..CaseStudy::table_2_1()
        };
        let mut setup = case.setup()?;
        setup.errors = std::array::from_fn(|surface| {
            let (constant, slope) = profiles[surface];
            let (amplitude, cycles) = pitches[surface];
            let line = ProfileError {
                constant: 1e-6 * constant,
                slope: 1e-6 * slope,
            };
            let wave = HarmonicError::across(1e-6 * amplitude, cycles);
            let line = profile.then(|| Arc::new(line) as Arc<dyn SurfaceError>);
            let wave = pitch.then(|| Arc::new(wave) as Arc<dyn SurfaceError>);
            line.into_iter().chain(wave).collect()
        });
        StaticLoad::new(setup)?.solve()
    };
    let profile = solve(true, false, false)?;
    let pitch = solve(false, true, false)?;
    let radius = solve(false, false, true)?;
    let all = solve(true, true, true)?;
    let left = Contact::ScrewLeft;
    let alone = [
        ("none", 6, Mark::Dashed, nominal, left),
        ("profile", 0, Mark::Line, &profile, left),
        ("pitch", 1, Mark::Line, &pitch, left),
        ("ball radius", 2, Mark::Line, &radius, left),
    ];
    let together = [
        ("SL", 0, Mark::Line, &all, left),
        ("SR", 1, Mark::Line, &all, Contact::ScrewRight),
        ("NL", 2, Mark::Line, &all, Contact::NutLeft),
        ("NR", 3, Mark::Line, &all, Contact::NutRight),
    ];
    Ok(figure(
        "lin_figure_2_14",
        "Lin 2019, Figure 2.14: errors of groove profile, pitch and ball radius (a normal sequence of its own, 1 µm; the printed one is \
         not given), each alone and all together, on case study 1. Some balls of the text's touch SR and NL then; here the \
         elastic approach of 9 to 18 µm keeps these open.",
        (2, 540, 400),
        vec![
            loads("each alone, SL", &alone),
            loads("all together", &together),
        ],
    ))
}

fn figure_4_10() -> Result<Block, Failure> {
    let short = CaseStudy {
        axial_load: 1000.0,
        ..CaseStudy::table_2_1()
    };
    let mut panels = Vec::new();
    for (title, case) in [
        ("Table 4.1, 71 balls", CaseStudy::table_4_1()),
        ("Table 2.1, 32 balls", short),
    ] {
        let left = Contact::ScrewLeft;
        let pitch = Waviness::Pitch.loads(&case, 5e-6)?;
        let round = Waviness::Roundness.loads(&case, 5e-6)?;
        let [pitch_name, round_name] = [("pitch", &pitch), ("roundness", &round)]
            .map(|(name, found)| format!("{name}, {} lost", found.balls_lost));
        let lines = [
            ("no error", 6, Mark::Dashed, &solve(&case)?, left),
            (pitch_name.as_str(), 0, Mark::Line, &pitch, left),
            (round_name.as_str(), 1, Mark::Line, &round, left),
        ];
        panels.push(loads(title, &lines));
    }
    Ok(figure(
        "lin_figure_4_10",
        "Lin 2019, Figure 4.10: pitch against roundness error of 5 µm under 1000 N. Two cycles a revolution unload balls, one cycle is \
         mostly taken up by the screw's moving aside. Which screw the dissertation took is not printed.",
        (2, 540, 400),
        panels,
    ))
}
