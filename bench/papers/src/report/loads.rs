//! Static loads: Figures 2.9 to 2.14 and 4.10 of Lin 2019, the Hertzian constants of Table B.1, and tables of load shares.

mod shares;

use std::sync::Arc;

use crate::published::loads::{case_1, case_2, case_3, with_error};
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::contact::GrooveContact;
use epas_reference::statics::shaft::ShaftModel;
use epas_reference::statics::surface::{HarmonicError, ProfileError};
use epas_reference::statics::{
    Contact, ContactConstants, Elastic, HertzConvention, StaticLoad, StaticSolution, SurfaceError,
};

use super::context::Context;
use epas_page::document::{Block, Cell, Figure, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

fn failed(error: impl std::fmt::Display) -> Failure {
    Failure::Data(error.to_string())
}

fn solve(case: &CaseStudy) -> Result<StaticSolution, Failure> {
    case.load().map_err(failed)?.solve().map_err(failed)
}

/// The section.
pub fn section(_: &Context) -> Result<Section, Failure> {
    let nominal = solve(&case_1())?;
    Ok(Section {
        title: "Static loads",
        blocks: vec![
            Block::Text(
                "The float64 reference of Lin 2019, chapter 2: loads of the balls of a ball screw whose screw bends, twists and \
                 stretches. The outer diameter of the screw is not printed; 32 mm is taken. Curvatures are the right ones; Table \
                 B.1 is printed with others, without effect on the loads that the figures could show."
                    .into(),
            ),
            Block::Table(hertz()?),
            Block::Figure(figures_2_9_and_10(&nominal)?),
            Block::Figure(figures_2_11_and_12(&nominal)?),
            Block::Figure(figure_2_14(&nominal)?),
            Block::Figure(figure_4_10()?),
            Block::Table(shares::table().map_err(failed)?),
        ],
    })
}

/// Table B.1 beside the right values.
fn hertz() -> Result<Table, Failure> {
    let constants = |groove_radius: f64, convention| {
        let mut geometry = case_1().geometry;
        geometry.groove_radius = groove_radius;
        ContactConstants::of_one_material(&geometry, Elastic::STEEL, convention).map_err(failed)
    };
    let conformal = 0.56 * 2.0 * case_1().geometry.ball_radius;
    let mut rows = Vec::new();
    for (name, radius, convention) in [
        ("as printed", conformal, HertzConvention::Dissertation),
        ("right", conformal, HertzConvention::Correct),
        (
            "right",
            case_1().geometry.groove_radius,
            HertzConvention::Correct,
        ),
    ] {
        let both = constants(radius, convention)?;
        for (side, contact) in [("screw", &both.screw), ("nut", &both.nut)] {
            let GrooveContact {
                principal_radii: [across, along],
                deflection,
                semi_major,
                semi_minor,
                ..
            } = *contact;
            rows.push(vec![
                Cell::from(name),
                Cell::fixed(1e3 * radius, 3),
                side.into(),
                Cell::fixed(1e3 * across, 3),
                Cell::fixed(1e3 * along, 3),
                Cell::Number(deflection, format!("{:.3}", 1e7 * deflection)),
                Cell::Number(semi_major, format!("{:.3}", 1e5 * semi_major)),
                Cell::Number(semi_minor, format!("{:.3}", 1e5 * semi_minor)),
            ]);
        }
    }
    Ok(Table {
        name: "hertzian_constants",
        caption: "Hertzian constants: Table B.1, which takes eigenvalues of the second fundamental form for radii, and the right ones"
            .into(),
        columns: [
            "curvatures",
            "groove radius (mm)",
            "side",
            "radius across (mm)",
            "radius along (mm)",
            "deflection (1e-7 m/N^(2/3))",
            "semi-major (1e-5 m/N^(1/3))",
            "semi-minor (1e-5 m/N^(1/3))",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn by_ball(forces: &[f64]) -> Vec<(f64, f64)> {
    forces
        .iter()
        .enumerate()
        .map(|(ball, force)| (ball as f64 + 1.0, *force))
        .collect()
}

fn loads(title: &str, series: Vec<Series>) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x: Axis::linear("ball"),
        y: Axis::linear("contact force (N)"),
        series,
        notes: Vec::new(),
    })
}

fn line(
    name: &str,
    colour: usize,
    mark: Mark,
    solution: &StaticSolution,
    contact: Contact,
) -> Series {
    Series::new(name, colour, mark, by_ball(&solution.of(contact)))
}

fn figures_2_9_and_10(nominal: &StaticSolution) -> Result<Figure, Failure> {
    let mut setup = case_1().setup().map_err(failed)?;
    setup.shaft.model = ShaftModel::Bar;
    let bar = StaticLoad::new(setup)
        .map_err(failed)?
        .solve()
        .map_err(failed)?;
    let centreline = |axis: usize| {
        nominal
            .positions
            .iter()
            .zip(&nominal.displacements)
            .map(|(position, moved)| (1e3 * position, 1e6 * moved[axis]))
            .collect()
    };
    Ok(Figure {
        name: "lin_figures_2_9_2_10",
        caption: "Lin 2019, Figures 2.9 and 2.10: loads of the 32 balls under 5000 N, by the beam and by a screw that only stretches, and the \
                  beam's centreline: an axial load bends the screw."
            .into(),
        panels: vec![
            loads(
                "case study 1",
                vec![
                    line("beam, SL", 0, Mark::Line, nominal, Contact::ScrewLeft),
                    line("beam, NR", 1, Mark::Dashed, nominal, Contact::NutRight),
                    line("bar, SL", 6, Mark::Line, &bar, Contact::ScrewLeft),
                ],
            ),
            Panel::Chart(Chart {
                title: "centreline".into(),
                x: Axis::linear("position (mm)"),
                y: Axis::linear("lateral displacement (µm)"),
                series: vec![
                    Series::new("x", 0, Mark::Line, centreline(0)),
                    Series::new("y", 1, Mark::Line, centreline(1)),
                ],
                notes: Vec::new(),
            }),
        ],
        columns: 2,
        size: (540, 380),
    })
}

fn figures_2_11_and_12(nominal: &StaticSolution) -> Result<Figure, Failure> {
    let large = solve(&case_2())?;
    let (straight, aside) = (solve(&case_3(false))?, solve(&case_3(true))?);
    Ok(Figure {
        name: "lin_figures_2_11_2_12",
        caption: "Lin 2019, Figures 2.11 and 2.12: ball 17 with 1 µm more radius takes a fifth more, its neighbours 2 % less; with 7 µm on every \
                  ball all four contacts carry, and 300 µm aside at the end squeeze the last balls on SR and NL."
            .into(),
        panels: vec![
            loads(
                "case study 2",
                vec![
                    line("with a large ball", 1, Mark::Line, &large, Contact::ScrewLeft),
                    line("without", 0, Mark::Dashed, nominal, Contact::ScrewLeft),
                ],
            ),
            loads(
                "case study 3",
                vec![
                    line("SL, aside", 0, Mark::Line, &aside, Contact::ScrewLeft),
                    line("SL, free", 0, Mark::Dashed, &straight, Contact::ScrewLeft),
                    line("SR, aside", 1, Mark::Line, &aside, Contact::ScrewRight),
                    line("SR, free", 1, Mark::Dashed, &straight, Contact::ScrewRight),
                ],
            ),
        ],
        columns: 2,
        size: (540, 400),
    })
}

/// Errors of the surfaces SL, SR, NL, NR.
type Errors = [Vec<Arc<dyn SurfaceError>>; 4];

fn figure_2_14(nominal: &StaticSolution) -> Result<Figure, Failure> {
    // Section 2.4.2: offsets in micrometres, 3 - gamma and so on.
    let profile = || {
        [(3.0, -1.0), (3.0, -0.5), (2.0, -1.0), (2.0, -0.25)].map(|(constant, slope)| {
            Arc::new(ProfileError {
                constant: 1e-6 * constant,
                slope: 1e-6 * slope,
            }) as Arc<dyn SurfaceError>
        })
    };
    let pitch = || {
        [(3.0, 1.0), (3.0, 1.0), (-2.0, 0.5), (-2.0, 0.5)].map(|(amplitude, cycles)| {
            Arc::new(HarmonicError::across(1e-6 * amplitude, cycles)) as Arc<dyn SurfaceError>
        })
    };
    // Normal numbers of variance 1 by the sum of twelve of a fixed sequence (xorshift).
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let oversize: Vec<f64> = (0..32)
        .map(|_| {
            let sum: f64 = (0..12)
                .map(|_| {
                    state ^= state << 13;
                    state ^= state >> 7;
                    state ^= state << 17;
                    (state >> 11) as f64 / (1_u64 << 53) as f64
                })
                .sum();
            1e-6 * (sum - 6.0)
        })
        .collect();
    let solve_with = |errors: Errors, ball_oversize: Vec<f64>| {
        let mut setup = CaseStudy {
            ball_oversize,
            ..case_1()
        }
        .setup()
        .map_err(failed)?;
        setup.errors = errors;
        StaticLoad::new(setup)
            .map_err(failed)?
            .solve()
            .map_err(failed)
    };
    let none = || std::array::from_fn(|_| Vec::new());
    let profiles = solve_with(profile().map(|error| vec![error]), Vec::new())?;
    let pitches = solve_with(pitch().map(|error| vec![error]), Vec::new())?;
    let balls = solve_with(none(), oversize.clone())?;
    let mut pairs = profile().into_iter().zip(pitch());
    let all = solve_with(
        std::array::from_fn(|_| {
            pairs
                .next()
                .map_or(Vec::new(), |(one, other)| vec![one, other])
        }),
        oversize,
    )?;
    Ok(Figure {
        name: "lin_figure_2_14",
        caption: "Lin 2019, Figure 2.14: errors of groove profile, pitch and ball radius (a normal sequence of its own, 1 µm; the printed one is \
                  not given), each alone and all together, on case study 1. Some balls of the text's touch SR and NL then; here the \
                  elastic approach of 9 to 18 µm keeps these open."
            .into(),
        panels: vec![
            loads(
                "each alone, SL",
                vec![
                    line("none", 6, Mark::Dashed, nominal, Contact::ScrewLeft),
                    line("profile", 0, Mark::Line, &profiles, Contact::ScrewLeft),
                    line("pitch", 1, Mark::Line, &pitches, Contact::ScrewLeft),
                    line("ball radius", 2, Mark::Line, &balls, Contact::ScrewLeft),
                ],
            ),
            loads(
                "all together",
                vec![
                    line("SL", 0, Mark::Line, &all, Contact::ScrewLeft),
                    line("SR", 1, Mark::Line, &all, Contact::ScrewRight),
                    line("NL", 2, Mark::Line, &all, Contact::NutLeft),
                    line("NR", 3, Mark::Line, &all, Contact::NutRight),
                ],
            ),
        ],
        columns: 2,
        size: (540, 400),
    })
}

fn figure_4_10() -> Result<Figure, Failure> {
    let mut panels = Vec::new();
    for (title, case) in [
        ("Table 4.1, 71 balls", CaseStudy::table_4_1()),
        (
            "Table 2.1, 32 balls",
            CaseStudy {
                axial_load: 1000.0,
                ..case_1()
            },
        ),
    ] {
        let pitch = HarmonicError::pitch(&case.geometry, 5e-6);
        let roundness = HarmonicError::roundness(5e-6);
        let mut series = vec![line(
            "no error",
            6,
            Mark::Dashed,
            &solve(&case)?,
            Contact::ScrewLeft,
        )];
        for (colour, (name, error)) in [("pitch", pitch), ("roundness", roundness)]
            .into_iter()
            .enumerate()
        {
            let found = with_error(&case, error).map_err(failed)?;
            series.push(line(
                &format!("{name}, {} lost", found.balls_lost),
                colour,
                Mark::Line,
                &found,
                Contact::ScrewLeft,
            ));
        }
        panels.push(loads(title, series));
    }
    Ok(Figure {
        name: "lin_figure_4_10",
        caption: "Lin 2019, Figure 4.10: pitch against roundness error of 5 µm under 1000 N. Two cycles a revolution unload balls, one cycle is \
                  mostly taken up by the screw's moving aside. Which screw the dissertation took is not printed."
            .into(),
        panels,
        columns: 2,
        size: (540, 400),
    })
}
