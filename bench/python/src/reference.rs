//! The float64 reference beside the functions of the control interrupt.

use epas_reference::curvature::{Groove, Surface};
use epas_reference::efficiency::Screw;
use epas_reference::friction::maps::FrictionMap;
use epas_reference::hertz::Hertz;
use pyo3::prelude::*;

use crate::efficiency::{efficiencies, geometries};
use crate::errors::Refused;
use crate::kept::Kept;
use crate::numbers::{arguments, within};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// A groove by its name.
fn groove(py: Python<'_>, name: &str) -> PyResult<Groove> {
    crate::numbers::groove(py, name).map(|groove| match groove {
        epas_friction::geometry::Groove::Screw => Groove::Screw,
        epas_friction::geometry::Groove::Nut => Groove::Nut,
    })
}

/// Principal curvatures of a groove, exactly, in float64.
///
/// Args:
///     groove: "screw" or "nut".
///     pitch_radius: radius of the cylinder on which the ball centres run, m.
///     lead_angle: rad.
///     contact_angle: from the plane normal to the axis, rad, 0 to pi/2.
///     groove_radius: radius of the arch, m.
///     offset_h: centre of the arch beyond that of the ball, in the direction of the radius, m.
///     offset_l: the same along the axis, m.
///
/// Returns:
///     PrincipalCurvature: kappa1 and kappa2, 1/m, float64, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn reference_groove_curvature<'py>(
    py: Python<'py>,
    groove: &str,
    pitch_radius: Any<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    groove_radius: Any<'py>,
    offset_h: Any<'py>,
    offset_l: Any<'py>,
) -> PyResult<Any<'py>> {
    let groove = self::groove(py, groove)?;
    let names = [
        "pitch_radius",
        "lead_angle",
        "contact_angle",
        "groove_radius",
        "offset_h",
        "offset_l",
    ];
    let values = [
        &pitch_radius,
        &lead_angle,
        &contact_angle,
        &groove_radius,
        &offset_h,
        &offset_l,
    ];
    let curvature = arguments(py, names, values)?.map(
        py,
        |[
            pitch_radius,
            lead_angle,
            contact_angle,
            groove_radius,
            offset_h,
            offset_l,
        ]| {
            let surface = Surface {
                groove,
                pitch_radius,
                lead_angle,
                groove_radius,
                offset_h,
                offset_l,
            };
            surface.check(contact_angle)?;
            let exact = surface.principal(contact_angle);
            Ok::<_, Refused>([exact.kappa1, exact.kappa2])
        },
    )?;
    let [kappa1, kappa2] = curvature.arrays(py)?;
    result(py, "PrincipalCurvature", (kappa1, kappa2))
}

/// Contact ellipse of two elastic bodies under a load (Hertz), by Carlson's elliptic integrals in float64.
///
/// Args:
///     relative_radius_1: relative radius in one principal direction, m.
///     relative_radius_2: the same in the other one, m.
///     load: N, 1e-12 to 1e9.
///     contact_modulus: of both bodies together, Pa.
///
/// Returns:
///     Ellipse: float64 arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn reference_ellipse<'py>(
    py: Python<'py>,
    relative_radius_1: Any<'py>,
    relative_radius_2: Any<'py>,
    load: Any<'py>,
    contact_modulus: Any<'py>,
) -> PyResult<Any<'py>> {
    let names = [
        "relative_radius_1",
        "relative_radius_2",
        "load",
        "contact_modulus",
    ];
    let values = [
        &relative_radius_1,
        &relative_radius_2,
        &load,
        &contact_modulus,
    ];
    let mut kept = Kept::NONE;
    let ellipse =
        arguments(py, names, values)?.map(py, move |[one, two, load, modulus]: [f64; 4]| {
            within("load", load, 1e-12, 1e9)?;
            let contact = kept.get([one, two, modulus], || Hertz::new(one, two, modulus))?;
            let ellipse = contact.at(load);
            Ok::<_, Refused>([
                contact.axis_ratio,
                ellipse.semi_major,
                ellipse.semi_minor,
                ellipse.deflection,
                ellipse.max_pressure,
            ])
        })?;
    let [ratio, major, minor, deflection, pressure] = ellipse.arrays(py)?;
    result(py, "Ellipse", (ratio, major, minor, deflection, pressure))
}

/// All closed forms in the order of `results.Efficiency`.
fn efficiency_of(screw: &Screw) -> [f64; 6] {
    let truth = |locked: bool| f64::from(u8::from(locked));
    [
        screw.rolling_screw(),
        screw.sliding_drive(),
        screw.sliding_backdrive(),
        screw.loss_drive(),
        truth(screw.locked_drive()),
        truth(screw.locked_backdrive()),
    ]
}

/// Efficiency of a ball screw by the closed forms of Lin, Velinsky and Ravani 1994, in float64.
///
/// Args:
///     lead_angle: rad.
///     contact_angle: rad.
///     friction: coefficient, 0 to 1.
///     ball_ratio: ball radius over pitch radius.
///     rolling_tangent: lever arm of rolling friction over ``ball_radius sin(contact_angle)``, 0 to 1.
///
/// Returns:
///     Efficiency: float64 and boolean arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
#[pyo3(signature = (lead_angle, contact_angle, friction, ball_ratio, rolling_tangent=None))]
pub fn reference_efficiency<'py>(
    py: Python<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    friction: Any<'py>,
    ball_ratio: Any<'py>,
    rolling_tangent: Option<Any<'py>>,
) -> PyResult<Any<'py>> {
    let values = [&lead_angle, &contact_angle, &friction, &ball_ratio];
    let mut kept = Kept::NONE;
    let efficiency = geometries(py, values, rolling_tangent)?.map(
        py,
        move |[
            lead_angle,
            contact_angle,
            friction,
            ball_ratio,
            rolling_tangent,
        ]: [f64; 5]| {
            within("friction", friction, 0.0, 1.0)?;
            within("rolling_tangent", rolling_tangent, 0.0, 1.0)?;
            // One set of ranges, that of the control interrupt.
            let angles = [lead_angle, contact_angle, ball_ratio].map(|value| value as f32);
            kept.get(angles, || {
                let [lead, contact, ratio] = angles;
                epas_friction::efficiency::EfficiencyGeometry::new(lead, contact, ratio)
            })?;
            let screw = Screw {
                lead_angle,
                contact_angle,
                friction,
                ball_ratio,
                rolling_tangent,
            };
            Ok::<_, Refused>(efficiency_of(&screw))
        },
    )?;
    efficiencies(py, efficiency)
}

/// Friction of one contact that slips along the track and spins, normalised, by integrals in float64.
///
/// Args:
///     axis_ratio: semi-minor over semi-major axis, 0.005 to 1.
///     offset: distance of the centre of rotation from that of the contact, over the semi-major axis, -1e9 to 1e9.
///
/// Returns:
///     FrictionMap: float64 arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn reference_friction_map<'py>(
    py: Python<'py>,
    axis_ratio: Any<'py>,
    offset: Any<'py>,
) -> PyResult<Any<'py>> {
    let mut kept = Kept::NONE;
    let values = [&axis_ratio, &offset];
    let map = arguments(py, ["axis_ratio", "offset"], values)?.map(
        py,
        move |[ratio, offset]: [f64; 2]| {
            within(
                "axis_ratio",
                ratio,
                epas_friction::contact::SMALLEST_AXIS_RATIO.into(),
                1.0,
            )?;
            within("offset", offset, -1e9, 1e9)?;
            let map = kept.get([ratio], || FrictionMap::new(ratio))?;
            let friction = map.at(offset);
            Ok::<_, Refused>([friction.force, friction.moment, friction.power])
        },
    )?;
    let [force, moment, power] = map.arrays(py)?;
    result(py, "FrictionMap", (force, moment, power))
}
