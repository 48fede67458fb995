//! Groove curvature in single precision, as the control interrupt computes it.

use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{ContactAngle, Groove, GrooveProfile, HelixPath};
use pyo3::prelude::*;

use crate::blocks::{BLOCK, Block, Kernel};
use crate::errors::Refused;
use crate::kept::Kept;
use crate::numbers::{self, arguments, within};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Numbers of a groove with the contact angle, in the order of the functions' arguments.
const GROOVE: [&str; 6] = [
    "pitch_radius",
    "lead_angle",
    "contact_angle",
    "groove_radius",
    "offset_h",
    "offset_l",
];

/// Place of the contact angle among them.
const ANGLE: usize = 2;

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

    /// The groove of a block where it is one, with its contact angles; none where it is not, or where one of them is refused.
    fn of_block(
        &mut self,
        inputs: &[&[f32]; 6],
        constant: [bool; 6],
    ) -> Option<(GothicArch, [ContactAngle; BLOCK])> {
        if !matches!(constant, [true, true, _, true, true, true]) {
            return None;
        }
        let numbers = inputs.each_ref().map(|values| values[0]);
        let (mut least, mut largest) = (f32::INFINITY, f32::NEG_INFINITY);
        for &angle in inputs[ANGLE] {
            // False for NaN.
            if !(angle >= 0.0) {
                return None;
            }
            (least, largest) = (least.min(angle), largest.max(angle));
        }
        let mut at = |angle| {
            let mut numbers = numbers;
            numbers[ANGLE] = angle;
            self.at(numbers).ok()
        };
        // The surface's scale is linear in the cosine of the angle: where neither end is refused, nothing between is.
        let (arch, _) = at(least).and(at(largest))?;
        let mut angles = [ContactAngle { cos: 1.0, sin: 0.0 }; BLOCK];
        for (to, from) in angles.iter_mut().zip(inputs[ANGLE]) {
            *to = ContactAngle::new(*from);
        }
        Some((arch, angles))
    }
}

impl Kernel<f32, 6, 2> for Arches {
    #[inline]
    fn one(&mut self, numbers: [f32; 6]) -> Result<[f32; 2], Refused> {
        let (arch, angle) = self.at(numbers)?;
        let exact = arch.principal(angle);
        Ok([exact.kappa1, exact.kappa2])
    }

    /// One groove at many contact angles.
    fn block(&mut self, block: &mut Block<'_, f32, 6, 2>) -> bool {
        let Some((arch, angles)) = self.of_block(&block.inputs, block.constant) else {
            return false;
        };
        let [kappa1, kappa2] = &mut block.outputs;
        principal(&arch, &angles[..kappa1.len()], kappa1, kappa2);
        true
    }
}

/// Both curvatures at many angles, with the widest registers that the processor has; operations and their order are the same in all.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2",
    "x86_64+avx+avx2+avx512f+avx512dq+avx512vl"
))]
fn principal(arch: &GothicArch, angles: &[ContactAngle], kappa1: &mut [f32], kappa2: &mut [f32]) {
    for ((angle, kappa1), kappa2) in angles.iter().zip(kappa1).zip(kappa2) {
        let exact = arch.principal(*angle);
        (*kappa1, *kappa2) = (exact.kappa1, exact.kappa2);
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
    let arches = Arches::new(numbers::groove(py, groove)?);
    let values = [
        &pitch_radius,
        &lead_angle,
        &contact_angle,
        &groove_radius,
        &offset_h,
        &offset_l,
    ];
    let curvature = arguments(py, GROOVE, values)?.map_blocks(py, arches)?;
    let [kappa1, kappa2] = curvature.arrays(py)?;
    result(py, "PrincipalCurvature", (kappa1, kappa2))
}

/// Fits of grooves, each in the range of its contact angle.
struct Fits {
    arches: Arches,
    fit: Kept<6, FittedCurvature>,
}

impl Fits {
    #[inline]
    fn of(
        &mut self,
        arch: &GothicArch,
        [
            pitch_radius,
            lead_angle,
            contact_angle,
            groove_radius,
            offset_h,
            offset_l,
        ]: [f32; 6],
    ) -> Result<&FittedCurvature, Refused> {
        let range = fit_range(contact_angle);
        let constants = [
            pitch_radius,
            lead_angle,
            groove_radius,
            offset_h,
            offset_l,
            range,
        ];
        self.fit.get(constants, || {
            Ok::<_, Refused>(FittedCurvature::new(arch, range))
        })
    }
}

impl Kernel<f32, 6, 1> for Fits {
    #[inline]
    fn one(&mut self, numbers: [f32; 6]) -> Result<[f32; 1], Refused> {
        let (arch, angle) = self.arches.at(numbers)?;
        Ok([self.of(&arch, numbers)?.first(angle)])
    }

    /// One groove at many contact angles within the default range.
    fn block(&mut self, block: &mut Block<'_, f32, 6, 1>) -> bool {
        let largest = block.inputs[ANGLE]
            .iter()
            .fold(0.0, |most: f32, angle| most.max(*angle));
        if fit_range(largest) > fit_range(0.0) {
            return false;
        }
        let Some((arch, angles)) = self.arches.of_block(&block.inputs, block.constant) else {
            return false;
        };
        let numbers = block.inputs.map(|values| values[0]);
        let Ok(fit) = self.of(&arch, numbers) else {
            return false;
        };
        for (kappa1, angle) in block.outputs[0].iter_mut().zip(&angles) {
            *kappa1 = fit.first(*angle);
        }
        true
    }
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
    let fits = Fits {
        arches: Arches::new(numbers::groove(py, groove)?),
        fit: Kept::NONE,
    };
    let values = [
        &pitch_radius,
        &lead_angle,
        &contact_angle,
        &groove_radius,
        &offset_h,
        &offset_l,
    ];
    let curvature = arguments(py, GROOVE, values)?.map_blocks(py, fits)?;
    let [kappa1] = curvature.arrays(py)?;
    Ok(kappa1)
}

/// The default range of the fit, or as much more as puts this contact angle well inside.
fn fit_range(contact_angle: f32) -> f32 {
    epas_cli::bindings::fit_range(contact_angle)
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
    let mut arches = Arches::new(numbers::groove(py, groove)?);
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
    let groove = numbers::groove(py, groove)?;
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
