//! Closed-form efficiencies in single precision, as the control interrupt computes them.

use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::ranges::FRICTION_OR_NONE;
use pyo3::prelude::*;

use crate::arrays::{Arguments, Results};
use crate::blocks::{Block, Kernel, Real};
use crate::errors::Refused;
use crate::kept::Kept;
use crate::numbers::{arguments, within, zero};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Efficiencies of geometries.
struct Efficiencies(Kept<3, EfficiencyGeometry>);

impl Kernel<f32, 5, 6> for Efficiencies {
    #[inline]
    fn one(
        &mut self,
        [lead, contact, friction, ratio, tangent]: [f32; 5],
    ) -> Result<[f32; 6], Refused> {
        within(
            "friction",
            friction.into(),
            0.0,
            FRICTION_OR_NONE.maximum.into(),
        )?;
        within("rolling_tangent", tangent.into(), 0.0, 1.0)?;
        let make = || EfficiencyGeometry::new(lead, contact, ratio);
        Ok(efficiency_at(
            self.0.get([lead, contact, ratio], make)?,
            friction,
            tangent,
        ))
    }

    /// One geometry with many friction coefficients.
    fn block(&mut self, block: &mut Block<'_, f32, 5, 6>) -> bool {
        let [lead, contact, friction, ratio, tangent] = block.inputs;
        let [lead, contact, ratio] = [lead[0], contact[0], ratio[0]];
        let make = || EfficiencyGeometry::new(lead, contact, ratio);
        let good = matches!(block.constant, [true, true, _, true, _])
            && friction
                .iter()
                .all(|friction| (0.0..=FRICTION_OR_NONE.maximum).contains(friction))
            && tangent.iter().all(|tangent| (0.0..=1.0).contains(tangent));
        let Some(geometry) = self
            .0
            .get([lead, contact, ratio], make)
            .ok()
            .filter(|_| good)
        else {
            return false;
        };
        if !block.constant[4] {
            return false;
        }
        all(geometry, friction, tangent[0], &mut block.outputs);
        true
    }
}

/// All closed forms at many friction coefficients, with the widest registers that the processor has; operations and their order are
/// the same in all.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2",
    "x86_64+avx+avx2+avx512f+avx512dq+avx512vl"
))]
fn all(
    geometry: &EfficiencyGeometry,
    friction: &[f32],
    tangent: f32,
    outputs: &mut [&mut [f32]; 6],
) {
    // Checked already; here it tells the compiler that a branch is never taken.
    if !(tangent >= 0.0) {
        return;
    }
    let [one, two, three, four, five, six] = outputs;
    let outputs = one
        .iter_mut()
        .zip(&mut **two)
        .zip(&mut **three)
        .zip(&mut **four)
        .zip(&mut **five)
        .zip(&mut **six);
    for (&friction, (((((one, two), three), four), five), six)) in friction.iter().zip(outputs) {
        [*one, *two, *three, *four, *five, *six] = efficiency_at(geometry, friction, tangent);
    }
}

/// All closed forms in the order of `results.Efficiency`.
#[inline]
fn efficiency_at(geometry: &EfficiencyGeometry, friction: f32, tangent: f32) -> [f32; 6] {
    let truth = |locks: bool| f32::from(u8::from(locks));
    [
        geometry.rolling_efficiency(friction, tangent),
        geometry.sliding_efficiency(friction),
        geometry.sliding_backdrive_efficiency(friction),
        geometry.sliding_loss(friction),
        truth(geometry.locks(Drive::Driving, friction)),
        truth(geometry.locks(Drive::BackDriving, friction)),
    ]
}

/// Names and values of arguments, in order; 0 for a rolling tangent that is not there.
pub fn geometries<'py>(
    py: Python<'py>,
    [lead_angle, contact_angle, friction, ball_ratio]: [&Any<'py>; 4],
    rolling_tangent: Option<Any<'py>>,
) -> PyResult<Arguments<'py, 5>> {
    let names = [
        "lead_angle",
        "contact_angle",
        "friction",
        "ball_ratio",
        "rolling_tangent",
    ];
    let rolling_tangent = rolling_tangent.unwrap_or_else(|| zero(py));
    let values = [
        lead_angle,
        contact_angle,
        friction,
        ball_ratio,
        &rolling_tangent,
    ];
    arguments(py, names, values)
}

/// All closed forms by their names; locked states as truth values.
pub fn efficiencies<T: Real>(py: Python<'_>, found: Results<T, 6>) -> PyResult<Any<'_>> {
    let [rolling, drive, backdrive, loss, locked, locked_backdrive] = found.arrays(py)?;
    let locked = locked.call_method1("astype", ("bool",))?;
    let locked_backdrive = locked_backdrive.call_method1("astype", ("bool",))?;
    result(
        py,
        "Efficiency",
        (rolling, drive, backdrive, loss, locked, locked_backdrive),
    )
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
    let values = [&lead_angle, &contact_angle, &friction, &ball_ratio];
    let efficiency =
        geometries(py, values, rolling_tangent)?.map_blocks(py, Efficiencies(Kept::NONE))?;
    efficiencies(py, efficiency)
}
