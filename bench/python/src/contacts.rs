//! Contacts in single precision, as the control interrupt computes them: groove curvature, ellipse, efficiency, friction map.

use epas_friction::contact::FrictionMap;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::{ContactAngle, Groove, GrooveProfile, HelixPath};
use epas_friction::hertz::HertzContact;
use epas_friction::ranges::FRICTION_OR_NONE;
use pyo3::prelude::*;

use crate::arrays::{Argument, Arguments};
use crate::errors::{Refused, refused};
use crate::kept::Kept;
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// A groove by its name.
///
/// # Errors
/// Any other name.
pub fn groove(py: Python<'_>, name: &str) -> PyResult<Groove> {
    match name {
        "screw" => Ok(Groove::Screw),
        "nut" => Ok(Groove::Nut),
        _ => {
            let message = format!("groove = {name:?} is none of: screw, nut");
            Err(refused(py, Refused::value("groove", message)))
        }
    }
}

/// A value within a range that `eval` sets, not the crate.
///
/// # Errors
/// A value outside.
pub fn within(field: &str, value: f64, minimum: f64, maximum: f64) -> Result<(), Refused> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(Refused::range(field, value, minimum, maximum))
    }
}

/// Numbers of a groove with the contact angle, in the order of the functions' arguments.
const GROOVE: [&str; 6] = [
    "pitch_radius",
    "lead_angle",
    "contact_angle",
    "groove_radius",
    "offset_h",
    "offset_l",
];

/// Names and values of arguments, in order.
///
/// # Errors
/// What is no number.
pub fn arguments<'py, const I: usize>(
    py: Python<'py>,
    names: [&'static str; I],
    values: [&Bound<'py, PyAny>; I],
) -> PyResult<Arguments<'py, I>> {
    let mut arguments = Vec::with_capacity(I);
    for (name, value) in names.into_iter().zip(values) {
        arguments.push(Argument::new(name, value)?);
    }
    let arguments = arguments
        .try_into()
        .map_err(|_| pyo3::exceptions::PyRuntimeError::new_err("arguments"))?;
    Arguments::new(py, arguments)
}

/// Surfaces of a groove, each at its contact angle; what does not change from one to the next is kept.
struct Arches {
    groove: Groove,
    path: Kept<2, HelixPath>,
    angle: Kept<1, ContactAngle>,
}

impl Arches {
    const fn new(groove: Groove) -> Self {
        Self {
            groove,
            path: Kept::NONE,
            angle: Kept::NONE,
        }
    }

    #[inline]
    fn at(
        &mut self,
        [
            pitch_radius,
            lead_angle,
            contact_angle,
            groove_radius,
            offset_h,
            offset_l,
        ]: [f32; 6],
    ) -> Result<(GothicArch, ContactAngle), Refused> {
        let path = self.path.get([pitch_radius, lead_angle], || {
            HelixPath::checked_from_lead_angle(pitch_radius, lead_angle)
        })?;
        let angle = self
            .angle
            .get([contact_angle], || ContactAngle::checked(contact_angle))?;
        let profile = GrooveProfile {
            groove_radius,
            offset_h,
            offset_l,
        };
        let arch = GothicArch::checked(self.groove, path, &profile, *angle).map_err(|error| {
            // The path follows from the pitch radius and an angle that is within its range.
            Refused::from(error)
                .renamed("curvature", "pitch_radius")
                .renamed("torsion", "pitch_radius")
        })?;
        Ok((arch, *angle))
    }
}

/// Principal curvatures of a groove, exactly: the Gothic arch swept along the helix.
///
/// Arrays broadcast against each other.
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
///     PrincipalCurvature: kappa1 and kappa2, 1/m, float32, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn groove_curvature<'py>(
    py: Python<'py>,
    groove: &str,
    pitch_radius: Any<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    groove_radius: Any<'py>,
    offset_h: Any<'py>,
    offset_l: Any<'py>,
) -> PyResult<Any<'py>> {
    let mut arches = Arches::new(self::groove(py, groove)?);
    let values = [
        &pitch_radius,
        &lead_angle,
        &contact_angle,
        &groove_radius,
        &offset_h,
        &offset_l,
    ];
    let curvature = arguments(py, GROOVE, values)?.map(py, move |numbers| {
        let (arch, angle) = arches.at(numbers)?;
        let exact = arch.principal(angle);
        Ok([exact.kappa1, exact.kappa2])
    })?;
    let [kappa1, kappa2] = curvature.arrays(py)?;
    result(py, "PrincipalCurvature", (kappa1, kappa2))
}

/// First principal curvature by the fit that a control interrupt evaluates: five constants a groove, set up once.
///
/// Arguments as of :func:`groove_curvature`. The fit covers contact angles up to 72 degrees, or up to two degrees beyond the
/// contact angle where that is more.
///
/// Returns:
///     ndarray: kappa1, 1/m, float32, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn fitted_curvature<'py>(
    py: Python<'py>,
    groove: &str,
    pitch_radius: Any<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    groove_radius: Any<'py>,
    offset_h: Any<'py>,
    offset_l: Any<'py>,
) -> PyResult<Any<'py>> {
    let mut arches = Arches::new(self::groove(py, groove)?);
    let mut fit = Kept::NONE;
    let values = [
        &pitch_radius,
        &lead_angle,
        &contact_angle,
        &groove_radius,
        &offset_h,
        &offset_l,
    ];
    let curvature = arguments(py, GROOVE, values)?.map(py, move |numbers| {
        let (arch, angle) = arches.at(numbers)?;
        let [
            pitch_radius,
            lead_angle,
            contact_angle,
            groove_radius,
            offset_h,
            offset_l,
        ] = numbers;
        let range = fit_range(contact_angle);
        let constants = [
            pitch_radius,
            lead_angle,
            groove_radius,
            offset_h,
            offset_l,
            range,
        ];
        let fit = fit.get(constants, || {
            Ok::<_, Refused>(FittedCurvature::new(&arch, range))
        })?;
        Ok([fit.first(angle)])
    })?;
    let [kappa1] = curvature.arrays(py)?;
    Ok(kappa1)
}

/// The default range of the fit, or as much more as puts this contact angle well inside.
fn fit_range(contact_angle: f32) -> f32 {
    epas_bench::bindings::fit_range(contact_angle)
}

/// First principal curvature of a groove with a circular section, a closed form.
///
/// Args:
///     groove: "screw" or "nut".
///     pitch_radius: m.
///     lead_angle: rad.
///     contact_angle: rad, 0 to pi/2.
///     groove_radius: m.
///
/// Returns:
///     ndarray: kappa1, 1/m, float32, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn circular_groove_curvature<'py>(
    py: Python<'py>,
    groove: &str,
    pitch_radius: Any<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    groove_radius: Any<'py>,
) -> PyResult<Any<'py>> {
    let mut arches = Arches::new(self::groove(py, groove)?);
    let names = [
        "pitch_radius",
        "lead_angle",
        "contact_angle",
        "groove_radius",
    ];
    let values = [&pitch_radius, &lead_angle, &contact_angle, &groove_radius];
    let curvature =
        arguments(py, names, values)?.map(py, move |[pitch, lead, contact, radius]| {
            let (_, angle) = arches.at([pitch, lead, contact, radius, 0.0, 0.0])?;
            let path = arches.path.get([pitch, lead], || {
                HelixPath::checked_from_lead_angle(pitch, lead)
            })?;
            let form = CircularGrooveCurvature::new(arches.groove, path, radius);
            Ok::<_, Refused>([form.first(angle)])
        })?;
    let [kappa1] = curvature.arrays(py)?;
    Ok(kappa1)
}

/// First principal curvature as most of the literature has it: that of a ball bearing, without the lead.
///
/// Args:
///     groove: "screw" or "nut".
///     pitch_radius: m.
///     contact_angle: rad, 0 to pi/2.
///     ball_radius: m.
///
/// Returns:
///     ndarray: kappa1, 1/m, float32, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn literature_curvature<'py>(
    py: Python<'py>,
    groove: &str,
    pitch_radius: Any<'py>,
    contact_angle: Any<'py>,
    ball_radius: Any<'py>,
) -> PyResult<Any<'py>> {
    let groove = self::groove(py, groove)?;
    let names = ["pitch_radius", "contact_angle", "ball_radius"];
    let values = [&pitch_radius, &contact_angle, &ball_radius];
    let curvature =
        arguments(py, names, values)?.map(py, move |[pitch, contact, ball]: [f32; 3]| {
            within("pitch_radius", pitch.into(), 1e-9, 1e9)?;
            within("ball_radius", ball.into(), 1e-9, 1e9)?;
            let angle = ContactAngle::checked(contact)?;
            Ok::<_, Refused>([LiteratureCurvature::new(groove, pitch, ball).first(angle)])
        })?;
    let [kappa1] = curvature.arrays(py)?;
    Ok(kappa1)
}

/// Contact ellipse of two elastic bodies under a load (Hertz).
///
/// Args:
///     relative_radius_1: relative radius in one principal direction, m.
///     relative_radius_2: the same in the other one, m.
///     load: N, 1e-12 to 1e9.
///     contact_modulus: of both bodies together, Pa.
///
/// Returns:
///     Ellipse: float32 arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn ellipse<'py>(
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
        arguments(py, names, values)?.map(py, move |[one, two, load, modulus]: [f32; 4]| {
            within("load", load.into(), 1e-12, 1e9)?;
            let contact = kept.get([one, two, modulus], || {
                HertzContact::checked(one, two, modulus)
            })?;
            let ellipse = contact.at(load);
            Ok::<_, Refused>([
                contact.axis_ratio(),
                ellipse.semi_major,
                ellipse.semi_minor,
                ellipse.deflection,
                ellipse.max_pressure,
            ])
        })?;
    let [ratio, major, minor, deflection, pressure] = ellipse.arrays(py)?;
    result(py, "Ellipse", (ratio, major, minor, deflection, pressure))
}

/// Efficiency of a ball screw by the closed forms of Lin, Velinsky and Ravani 1994, and whether it locks.
///
/// Args:
///     lead_angle: rad.
///     contact_angle: rad.
///     friction: coefficient, 0 to 1.
///     ball_ratio: ball radius over pitch radius.
///     rolling_tangent: lever arm of rolling friction over ``ball_radius sin(contact_angle)``, 0 to 1.
///
/// Returns:
///     Efficiency: float32 and boolean arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
#[pyo3(signature = (lead_angle, contact_angle, friction, ball_ratio, rolling_tangent=None))]
pub fn efficiency<'py>(
    py: Python<'py>,
    lead_angle: Any<'py>,
    contact_angle: Any<'py>,
    friction: Any<'py>,
    ball_ratio: Any<'py>,
    rolling_tangent: Option<Any<'py>>,
) -> PyResult<Any<'py>> {
    let names = [
        "lead_angle",
        "contact_angle",
        "friction",
        "ball_ratio",
        "rolling_tangent",
    ];
    let rolling_tangent = rolling_tangent.unwrap_or_else(|| zero(py));
    let values = [
        &lead_angle,
        &contact_angle,
        &friction,
        &ball_ratio,
        &rolling_tangent,
    ];
    let mut kept = Kept::NONE;
    let efficiency =
        arguments(py, names, values)?.map(py, move |[lead, contact, f, ratio, t]: [f32; 5]| {
            within("friction", f.into(), 0.0, FRICTION_OR_NONE.maximum.into())?;
            within("rolling_tangent", t.into(), 0.0, 1.0)?;
            let geometry = kept.get([lead, contact, ratio], || {
                EfficiencyGeometry::new(lead, contact, ratio)
            })?;
            Ok::<_, Refused>([
                geometry.rolling_efficiency(f, t),
                geometry.sliding_efficiency(f),
                geometry.sliding_backdrive_efficiency(f),
                geometry.sliding_loss(f),
                f32::from(u8::from(geometry.locks(Drive::Driving, f))),
                f32::from(u8::from(geometry.locks(Drive::BackDriving, f))),
            ])
        })?;
    let [rolling, drive, backdrive, loss, locked, locked_backdrive] = efficiency.arrays(py)?;
    let locked = locked.call_method1("astype", ("bool",))?;
    let locked_backdrive = locked_backdrive.call_method1("astype", ("bool",))?;
    result(
        py,
        "Efficiency",
        (rolling, drive, backdrive, loss, locked, locked_backdrive),
    )
}

/// The number zero.
pub fn zero(py: Python<'_>) -> Bound<'_, PyAny> {
    pyo3::types::PyFloat::new(py, 0.0).into_any()
}

/// Friction of one contact that slips along the track and spins, normalised.
///
/// Args:
///     axis_ratio: semi-minor over semi-major axis, 0.005 to 1.
///     offset: distance of the centre of rotation from that of the contact, over the semi-major axis, -1e9 to 1e9.
///
/// Returns:
///     FrictionMap: float32 arrays of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
pub fn friction_map<'py>(
    py: Python<'py>,
    axis_ratio: Any<'py>,
    offset: Any<'py>,
) -> PyResult<Any<'py>> {
    let mut kept = Kept::NONE;
    let values = [&axis_ratio, &offset];
    let map = arguments(py, ["axis_ratio", "offset"], values)?.map(
        py,
        move |[ratio, offset]: [f32; 2]| {
            within("offset", offset.into(), -1e9, 1e9)?;
            let map = kept.get([ratio], || FrictionMap::new(ratio))?;
            let friction = map.evaluate(offset);
            Ok::<_, Refused>([friction.force, friction.moment, friction.power])
        },
    )?;
    let [force, moment, power] = map.arrays(py)?;
    result(py, "FrictionMap", (force, moment, power))
}
