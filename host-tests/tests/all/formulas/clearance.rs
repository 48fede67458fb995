//! One clearance for play and preload: conversions there and back, forces against elastic grooves, travel against the
//! geometry of helical grooves, and what scenes refuse.

use std::f64::consts::TAU;

use epas_friction::FrictionBranch;
use epas_friction::scene::CagedConstants;
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, Clearance, ClosedFormScrewConfiguration,
    ClosedFormScrewConstants, DISSERTATION_DESIGNS, Error, GrooveSize, Range,
};
use epas_reference::curvature;
use epas_reference::friction::ball_screw_grooves::ElasticGrooves;
use epas_testkit::errors::Errors;
use epas_testkit::gears;
use epas_testkit::given::ball_screw;

/// The catalogue, the designs of the dissertation, and one whose grooves differ.
fn designs() -> Vec<BallScrew> {
    let sizes = CATALOGUE
        .iter()
        .map(epas_friction::CatalogueSize::parameters);
    let named = DISSERTATION_DESIGNS.iter().map(|design| design.parameters);
    let unequal = BallScrewParameters {
        nut_groove: GrooveSize::Conformity(0.56),
        contact_angle: 0.87,
        ..CATALOGUE[15].parameters()
    };
    sizes
        .chain(named)
        .chain([unequal])
        .map(|parameters| BallScrew::new(parameters).unwrap())
        .collect()
}

/// Gaps as shares of the ball radius, of either sign.
const SHARES: [f32; 6] = [1e-5, 1e-4, 5e-4, 1e-3, 5e-3, 0.02];

fn gap(share: f32, design: &BallScrew) -> Clearance {
    Clearance::new(share * design.ball_radius())
        .and_then(|clearance| clearance.checked(design))
        .unwrap()
}

#[test]
fn conversions_there_and_back() {
    for design in designs() {
        for share in SHARES {
            let oversize = gap(-share, &design);
            let again = Clearance::of_preload(&design, oversize.preload(&design)).unwrap();
            assert!((again.gap() / oversize.gap() - 1.0).abs() < 12.0 * 6e-8);
            assert_eq!(oversize.axial_play(&design), 0.0);

            let play = gap(share, &design);
            let again = Clearance::of_axial_play(&design, play.axial_play(&design)).unwrap();
            assert!((again.gap() / play.gap() - 1.0).abs() < 12.0 * 6e-8);
            assert_eq!(play.preload(&design), 0.0);
            assert_eq!(play.axial_preload(&design, 100), 0.0);
        }
        for force in [1e-3, 1.0, 100.0] {
            let preload = Clearance::of_preload(&design, force)
                .unwrap()
                .preload(&design);
            assert!((preload / force - 1.0).abs() < 18.0 * 6e-8, "{preload}");
        }
        assert_eq!(Clearance::of_axial_play(&design, 0.0), Ok(Clearance::ZERO));
        assert_eq!(Clearance::ZERO.preload(&design), 0.0);
        for tiny in [-f32::MIN_POSITIVE, -1e-40, -1e-12] {
            assert_eq!(Clearance::new(tiny).unwrap().preload(&design), 0.0);
        }
    }
    assert_eq!(Clearance::default(), Clearance::ZERO);
}

/// Forces of the contacts, N, in the order SL, SR, NL, NR, of a ball without a load in elastic grooves: by symmetry it
/// only moves towards the softer one.
fn pressed(design: &BallScrew, gap: f64) -> [f64; 4] {
    let drawing = ball_screw(design.parameters());
    let contact = |groove| drawing.contact(groove).unwrap().into();
    let grooves = ElasticGrooves {
        track: (&drawing).into(),
        screw_groove_radius: drawing.screw_groove_radius,
        nut_groove_radius: drawing.nut_groove_radius,
        arc_angles: [drawing.contact_angle; 4],
        screw: contact(curvature::Groove::Screw),
        nut: contact(curvature::Groove::Nut),
        oversize: -gap,
    };
    let outward = |place: f64| {
        grooves
            .contacts_at([place, 0.0], 0.0)
            .map(|contact| {
                let [inward, outward] = [-1.0, 1.0];
                let side = if contact.groove.on_nut() {
                    inward
                } else {
                    outward
                };
                side * contact.load * contact.contact_angle.cos()
            })
            .iter()
            .sum::<f64>()
    };
    let middle = |low: f64, high: f64| 0.5 * (low + high);
    let (mut low, mut high) = (-gap.abs(), gap.abs());
    let rising = outward(high) > outward(low);
    for _ in 0..100 {
        if (outward(middle(low, high)) > 0.0) == rising {
            high = middle(low, high);
        } else {
            low = middle(low, high);
        }
    }
    grooves
        .contacts_at([middle(low, high), 0.0], 0.0)
        .map(|contact| contact.load)
}

#[test]
fn preload_is_the_force_in_elastic_grooves() {
    let mut errors = SHARES.map(|share| Errors::of(format!("preload at {share} ball radii")));
    for design in designs() {
        if design.parameters().screw_groove != design.parameters().nut_groove {
            continue;
        }
        for (share, errors) in SHARES.iter().zip(&mut errors) {
            let oversize = gap(-share, &design);
            let force = f64::from(oversize.preload(&design));
            for load in pressed(&design, oversize.gap().into()) {
                errors.add_at(
                    force / load - 1.0,
                    format_args!("{:?}", design.parameters()),
                );
            }
            let slope = design.parameters().contact_angle.sin() * design.cos_lead_angle();
            let flank = oversize.axial_preload(&design, 37) / (37.0 * oversize.preload(&design));
            assert!((flank / slope - 1.0).abs() < 3.6e-7);
        }
    }
    // The ball moves towards the groove in which it is softer, and its contact angles turn: both grow with the gap.
    // Measured: 4.0e-3 at 0.02, 2.4e-4 at 1e-3, and 6.4e-6 of the ellipse at 1e-5.
    for (share, errors) in SHARES.iter().zip(&errors) {
        assert!(
            errors.largest < 0.3 * f64::from(*share) + 1e-5,
            "{}",
            errors.worst
        );
    }
}

/// Arc centre of a groove beside a point of the ball centres' helix, which stands at `angle` around the axis: outward and
/// along the binormal by so much, moved along the axis.
fn arc_centre(
    design: &BallScrewParameters,
    angle: f64,
    [outward, along]: [f64; 2],
    moved: f64,
) -> [f64; 3] {
    let radius = f64::from(design.pitch_radius);
    let rise = f64::from(design.lead) / TAU;
    let (sin_lead, cos_lead) = rise.atan2(radius).sin_cos();
    let (sin, cos) = angle.sin_cos();
    [
        (radius + outward) * cos + along * sin_lead * sin,
        (radius + outward) * sin - along * sin_lead * cos,
        rise * angle + along * cos_lead + moved,
    ]
}

fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.iter()
        .zip(other)
        .map(|(one, other)| (one - other).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// Travel of the nut along the axis until the ball of `gap` is held by one diagonal, m: until the curves of arc centres of
/// its two grooves, which are helices, are as far apart as their radii less the ball's.
fn travel_to_a_flank(design: &BallScrew, gap: f64) -> f64 {
    let parameters = design.parameters();
    let drawing = ball_screw(parameters);
    let (sin, cos) = drawing.contact_angle.sin_cos();
    let screw = drawing.screw_groove_radius - drawing.ball_radius;
    let nut = drawing.nut_groove_radius - drawing.ball_radius;
    let start = arc_centre(parameters, 0.0, [screw * cos, screw * sin], 0.0);
    let apart = |travel: f64| {
        let at = |angle: f64| {
            distance(
                start,
                arc_centre(parameters, angle, [-nut * cos, -nut * sin], -travel),
            )
        };
        // Next to the ball the distance has one minimum.
        let reach = 0.5 * drawing.ball_radius / drawing.pitch_radius;
        let (mut low, mut high) = (-reach, reach);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if at(low + third) < at(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        at(0.5 * (low + high))
    };
    let (mut low, mut high) = (0.0, drawing.ball_radius);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if apart(middle) < screw + nut + 2.0 * gap {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// From flank to flank the nut travels twice what closes one diagonal; for little play that is `4 gap/(sin cos)`.
#[test]
fn axial_play_is_the_travel_between_helical_grooves() {
    let mut errors = SHARES.map(|share| Errors::of(format!("axial play at {share} ball radii")));
    for design in designs() {
        for (share, errors) in SHARES.iter().zip(&mut errors) {
            let clearance = gap(*share, &design);
            let play = f64::from(clearance.axial_play(&design));
            let wanted = 2.0 * travel_to_a_flank(&design, clearance.gap().into());
            errors.add_at(
                play / wanted - 1.0,
                format_args!("{:?}", design.parameters()),
            );
        }
        let clearance = gap(1e-5, &design);
        let slope = design.contact_angle().sin * design.cos_lead_angle();
        let thin = 4.0 * clearance.gap() / slope;
        // The next term is `gap / (2 D tan^2)` of it, with 0.053 ball radii or more for `D`, and tan beta of 1 or more.
        assert!((clearance.axial_play(&design) / thin - 1.0).abs() < 1.1e-4);
    }
    // The grooves bend around the axis, which the plane section leaves out. Measured: 4.3e-5 at 0.02, 3.1e-6 at 1e-3,
    // 2.3e-7 of roundings at 1e-5.
    for (share, errors) in SHARES.iter().zip(&errors) {
        assert!(
            errors.largest < 5e-3 * f64::from(*share) + 5e-7,
            "{}",
            errors.worst
        );
    }
}

fn refused<T: std::fmt::Debug>(result: Result<T, Error>, field: &str, allowed: Range) {
    let error = result.unwrap_err();
    assert_eq!(
        (error.field(), error.allowed()),
        (field, allowed),
        "{error}"
    );
    assert!(!allowed.contains(error.value()));
}

const NO_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

#[test]
fn what_is_refused_is_named() {
    let metres = Range::new(-1e-3, 2.5e-3);
    for bad in NO_NUMBERS.into_iter().chain([-1.1e-3, 2.6e-3, 5.0, -3.0]) {
        refused(Clearance::new(bad), "clearance", metres);
    }
    for end in [metres.minimum, metres.maximum] {
        assert_eq!(Clearance::new(end).unwrap().gap(), end);
    }
    for design in designs() {
        let radius = design.ball_radius();
        let balls = Range::new(-0.02 * radius, 0.05 * radius);
        for end in [balls.minimum, balls.maximum] {
            assert!(Clearance::new(end).unwrap().checked(&design).is_ok());
        }
        for beyond in [balls.minimum.next_down(), balls.maximum.next_up()] {
            refused(
                Clearance::new(beyond).unwrap().checked(&design),
                "clearance",
                balls,
            );
        }

        let hardest = Clearance::new(balls.minimum).unwrap().preload(&design);
        let forces = Range::new(1e-3, hardest.min(1e6));
        for end in [forces.minimum, forces.maximum] {
            let clearance = Clearance::of_preload(&design, end).unwrap();
            assert!(clearance.gap() < 0.0 && clearance.checked(&design).is_ok());
        }
        let beyond = [
            forces.minimum.next_down(),
            forces.maximum.next_up(),
            -1.0,
            0.0,
        ];
        for bad in NO_NUMBERS.into_iter().chain(beyond) {
            refused(Clearance::of_preload(&design, bad), "contact_force", forces);
        }

        let longest = Clearance::new(balls.maximum).unwrap().axial_play(&design);
        let plays = Range::new(0.0, longest);
        assert!(
            Clearance::of_axial_play(&design, longest)
                .unwrap()
                .checked(&design)
                .is_ok()
        );
        for bad in NO_NUMBERS
            .into_iter()
            .chain([-1e-9, longest.next_up(), 1.0])
        {
            refused(Clearance::of_axial_play(&design, bad), "axial_play", plays);
        }
    }
}

#[test]
fn scenes_refuse_a_clearance_beyond_their_balls() {
    let own = gears::closed_form(FrictionBranch::Rolling);
    let closed = Range::new(
        -0.02 * own.design.ball_radius(),
        0.05 * own.design.ball_radius(),
    );
    for end in [-1.0, 1.0] {
        let clearance = Clearance::new(end * 0.9e-3).unwrap();
        let configuration = ClosedFormScrewConfiguration { clearance, ..own };
        refused(
            ClosedFormScrewConstants::new(&configuration),
            "clearance",
            closed,
        );
    }
    for loaded_balls in [0, 1001, u16::MAX] {
        let balls = Range::new(1.0, 1000.0);
        let configuration = ClosedFormScrewConfiguration {
            loaded_balls,
            ..own
        };
        let closed = ClosedFormScrewConstants::new(&configuration);
        refused(closed, "loaded_balls", balls);
        let configuration = gears::CagedConfiguration {
            loaded_balls,
            ..gears::caged()
        };
        let caged = CagedConstants::new(&configuration);
        refused(caged, "loaded_balls", balls);
    }
}

/// Play changes nothing in the papers' closed forms; the number of loaded balls only counts with oversize.
#[test]
fn play_changes_nothing_in_closed_forms() {
    let folded = |gap: f32, loaded_balls| {
        ClosedFormScrewConstants::new(&ClosedFormScrewConfiguration {
            clearance: Clearance::new(gap).unwrap(),
            loaded_balls,
            ..gears::closed_form(FrictionBranch::Rolling)
        })
        .unwrap()
    };
    let zero = folded(0.0, 40);
    for gap in [1e-9, 5e-6, 1e-4] {
        assert_eq!(folded(gap, 7), zero);
    }
    assert_ne!(folded(-5e-6, 40), zero);
    assert_ne!(folded(-5e-6, 40), folded(-5e-6, 41));
}
