//! Measured groove surfaces: splines, point clouds, and the loads they give.

use epas_testkit::measured;
use std::fmt::Write as _;
use std::sync::Arc;

use epas_papers::surfaces::spline::{Ends, Knots, Spline};
use epas_papers::surfaces::{Along, FittedSurface, MeasuredPoint};
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::surface::{HarmonicError, ProfileError};
use epas_reference::statics::{Contact, Geometry, StaticLoad, SurfaceError};

fn geometry() -> Geometry {
    CaseStudy::table_2_1().geometry
}

fn spline(places: Vec<f64>, values: Vec<f64>, ends: Ends) -> Spline {
    Spline::new("values", Knots::new("knots", places, ends).unwrap(), values).unwrap()
}

/// Value and both derivatives are the same from both sides of every knot, beyond the ends too.
#[test]
fn spline_has_two_continuous_derivatives() {
    let places = vec![-0.3, 0.1, 0.25, 0.9, 1.7, 2.0, 2.6];
    let values = vec![1.0, -2.0, 0.5, 0.7, 3.0, -1.0, 0.4];
    for ends in [Ends::Natural, Ends::Periodic(4.0)] {
        let spline = spline(places.clone(), values.clone(), ends);
        for (place, value) in places.iter().zip(&values) {
            let (before, after) = (spline.at(place - 1e-9), spline.at(place + 1e-9));
            measured::assert("splines, values", spline.at(*place)[0] - value);
            for order in 0..3 {
                // Measured: 1.5e-6, the next derivative times the gap of 2e-9.
                let gap = (before[order] - after[order]).abs();
                assert!(gap < 3e-6, "{ends:?} at {place}, order {order}: {gap}");
            }
        }
        // The derivatives are those of the value, beyond the knots as well.
        for index in -20..60 {
            let (place, h) = (0.07 * f64::from(index) + 0.013, 1e-5);
            let [low, here, high] = [place - h, place, place + h].map(|place| spline.at(place));
            measured::assert_at(
                "splines, slope by differences",
                (high[0] - low[0]) / (2.0 * h) - here[1],
                format_args!("{ends:?} {place}"),
            );
            measured::assert_at(
                "splines, bend by differences",
                (high[1] - low[1]) / (2.0 * h) - here[2],
                format_args!("{ends:?} {place}"),
            );
        }
    }
    let ring = spline(places, values, Ends::Periodic(4.0));
    for (place, turns) in [(0.2, 1.0), (3.3, -2.0), (-0.29, 7.0)] {
        for (a, b) in ring.at(place).into_iter().zip(ring.at(place + 4.0 * turns)) {
            measured::assert("splines, periodic", (a - b) / (1.0 + a.abs()));
        }
    }
}

/// A cubic spline's error falls with the fourth power of the spacing: at most `5 h⁴ / 384` for a sine.
#[test]
fn spline_converges_to_a_sine() {
    for count in [12, 24, 48] {
        let step = std::f64::consts::TAU / f64::from(count);
        let places: Vec<_> = (0..count).map(|knot| f64::from(knot) * step).collect();
        let values = places.iter().map(|place| place.sin()).collect();
        let spline = spline(places, values, Ends::Periodic(std::f64::consts::TAU));
        let worst = (0..1000)
            .map(|index| 0.01 * f64::from(index))
            .map(|place| (spline.at(place)[0] - place.sin()).abs())
            .fold(0.0, f64::max);
        assert!(worst <= 5.0 / 384.0 * step.powi(4), "{count}: {worst}");
    }
}

#[test]
fn few_knots_give_constants_and_lines() {
    for ends in [Ends::Natural, Ends::Periodic(7.0)] {
        let one = spline(vec![2.0], vec![3.0], ends);
        assert_eq!(one.at(-5.0), [3.0, 0.0, 0.0]);
    }
    let line = spline(vec![1.0, 3.0], vec![2.0, 6.0], Ends::Natural);
    for place in [-4.0, 1.0, 2.2, 3.0, 9.0] {
        // Roundings of 1.1e-16 of up to 18.
        let [value, slope, bend] = line.at(place);
        assert!((value - 2.0 * place).abs() < 1e-14 && (slope - 2.0).abs() < 1e-14 && bend == 0.0);
    }
    let pair = spline(vec![0.0, 1.0], vec![0.0, 1.0], Ends::Periodic(2.0));
    assert!((pair.at(0.5)[0] - 0.5).abs() < 1e-14 && pair.at(0.0)[1].abs() < 1e-14);
}

/// Sections of their own azimuths and section angles, none of them like another.
fn cloud(error: &dyn SurfaceError, sections: u32, turns: f64) -> Vec<MeasuredPoint> {
    let mut points = Vec::new();
    for section in 0..sections {
        let azimuth = f64::from(section) / f64::from(sections) * turns * std::f64::consts::TAU;
        for point in 0..25 {
            let section_angle = 0.2 + 0.05 * f64::from(point) + 0.01 * f64::from(section % 3);
            let offset = error.deviation(azimuth, section_angle).offset;
            points.push(MeasuredPoint {
                azimuth,
                section_angle,
                offset,
            });
        }
    }
    points
}

fn loads_with(errors: [Vec<Arc<dyn SurfaceError>>; 4]) -> Vec<[f64; 4]> {
    let mut setup = CaseStudy::table_2_1().setup().unwrap();
    setup.errors = errors;
    StaticLoad::new(setup).unwrap().solve().unwrap().forces
}

fn worst(first: &[[f64; 4]], second: &[[f64; 4]]) -> f64 {
    first
        .iter()
        .flatten()
        .zip(second.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// A straight profile error is reproduced by splines to rounding, and so are the loads.
#[test]
fn a_measured_straight_profile_is_the_profile() {
    let exact = ProfileError {
        constant: 3e-6,
        slope: -5e-6,
    };
    let points = cloud(&exact, 40, 3.0);
    let fitted = FittedSurface::new(&geometry(), points, Along::Open).unwrap();
    for azimuth in [-1.0, 0.3, 7.7, 15.0, 30.0] {
        for angle in [0.0, 0.5, std::f64::consts::FRAC_PI_4, 1.4, 1.6] {
            let (a, b) = (
                fitted.deviation(azimuth, angle),
                exact.deviation(azimuth, angle),
            );
            measured::assert("straight profile, offset in m", a.offset - b.offset);
            measured::assert("straight profile, slope", a.slope - b.slope);
            measured::assert("straight profile, bend", a.bend);
        }
    }
    let exact: Arc<dyn SurfaceError> = Arc::new(exact);
    let fitted: Arc<dyn SurfaceError> = Arc::new(fitted);
    let on_left = |error| [vec![error], Vec::new(), Vec::new(), Vec::new()];
    let difference = worst(&loads_with(on_left(exact)), &loads_with(on_left(fitted)));
    measured::assert_at(
        "straight profile, forces in N",
        difference,
        format_args!("{difference}"),
    );
}

/// A screw with roundness error, measured as points of its sections and read from a table, gives the loads
/// of the error itself. 50 sections a turn, between which most balls stand, resolve two cycles to
/// `5 um (2 x 7.2 deg)^4 5 / 384` = 0.26 nm of some 8 um of deflection: 0.02 N of 230 N at `F ~ delta^(3/2)`.
#[test]
fn a_measured_roundness_error_gives_its_loads() {
    let (geometry, error) = (geometry(), HarmonicError::roundness(5e-6));
    let measured = |contact: Contact| -> Arc<dyn SurfaceError> {
        let [outward, along] = contact.signs();
        let centre = geometry.arc_centre(contact);
        let mut table = String::from("# measured\nazimuth, x, z\n");
        for section in 0..50 {
            let azimuth = f64::from(section) / 50.0 * std::f64::consts::TAU;
            let shift = error.deviation(azimuth, 0.0).shift;
            for point in 0..25 {
                let (sin, cos) = (0.2 + 0.05 * f64::from(point)).sin_cos();
                let x = centre.x + shift[0] - outward * geometry.groove_radius * cos;
                let z = centre.y + shift[1] - along * geometry.groove_radius * sin;
                writeln!(table, "{azimuth},{x},{z}").unwrap();
            }
        }
        let fitted =
            FittedSurface::from_csv(&geometry, contact, table.as_bytes(), Along::EveryTurn);
        Arc::new(fitted.unwrap())
    };
    let [left, right] = [Contact::ScrewLeft, Contact::ScrewRight].map(measured);
    let fitted = loads_with([vec![left], vec![right], Vec::new(), Vec::new()]);
    let exact: Arc<dyn SurfaceError> = Arc::new(error);
    let exact = loads_with([vec![exact.clone()], vec![exact], Vec::new(), Vec::new()]);
    let difference = worst(&fitted, &exact);
    println!("loads of the measured surface: {difference:.1e} N off");
    // Measured: 6.1e-4 N.
    assert!(difference < 2e-3, "{difference}");
}

#[test]
fn bad_tables_are_refused() {
    let geometry = geometry();
    for table in [
        "",
        "azimuth,section_angle,deviation\n",
        "azimuth,section_angle\n0,0\n",
        "azimuth,section_angle,deviation\n0,0.5,NaN\n",
        "azimuth,section_angle,deviation\n0,inf,0\n",
        "azimuth,section_angle,deviation\n0,0.5,word\n",
        "azimuth,section_angle,deviation\n0,0.5\n",
        "azimuth,section_angle,deviation\n0,0.5,0.01\n",
        "azimuth,section_angle,deviation\n0,0.5,0\n0,0.5,1e-6\n",
        "azimuth,section_angle,deviation,more\n0,0.5,0,1\n",
        "azimuth,x,z\n0,1,1\n",
        "azimuth,section_angle,deviation\n0,0.5,0\n7,0.5,0\n",
    ] {
        let error = FittedSurface::from_csv(
            &geometry,
            Contact::ScrewLeft,
            table.as_bytes(),
            Along::EveryTurn,
        )
        .unwrap_err();
        assert_eq!(error.field(), Some("profile"), "{table}: {error}");
        assert!(error.to_string().len() > "profile: ".len());
    }
}
