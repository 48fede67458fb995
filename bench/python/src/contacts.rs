//! Contacts in single precision, as the control interrupt computes them: ellipse and friction map.

use std::ops::RangeInclusive;

use epas_friction::contact::FrictionMap;
use epas_friction::hertz::HertzContact;
use pyo3::prelude::*;

use crate::blocks::{Block, Kernel};
use crate::errors::Refused;
use crate::kept::Kept;
use crate::numbers::{arguments, within};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Contacts under loads.
struct Ellipses(Kept<3, HertzContact>);

/// Loads, N.
const LOADS: RangeInclusive<f32> = 1e-12..=1e9;

impl Kernel<f32, 4, 5> for Ellipses {
    #[inline]
    fn one(&mut self, [one, two, load, modulus]: [f32; 4]) -> Result<[f32; 5], Refused> {
        if !LOADS.contains(&load) {
            return Err(Refused::range("load", load.into(), 1e-12, 1e9));
        }
        let make = || HertzContact::checked(one, two, modulus);
        Ok(ellipse_at(self.0.get([one, two, modulus], make)?, load))
    }

    /// One contact under many loads.
    fn block(&mut self, block: &mut Block<'_, f32, 4, 5>) -> bool {
        let [one, two, loads, modulus] = block.inputs;
        let [one, two, modulus] = [one[0], two[0], modulus[0]];
        let make = || HertzContact::checked(one, two, modulus);
        let good = matches!(block.constant, [true, true, _, true])
            && loads.iter().all(|load| LOADS.contains(load));
        let Some(contact) = self.0.get([one, two, modulus], make).ok().filter(|_| good) else {
            return false;
        };
        let [ratio, major, minor, deflection, pressure] = &mut block.outputs;
        ratio.fill(contact.axis_ratio());
        let outputs = major
            .iter_mut()
            .zip(&mut **minor)
            .zip(&mut **deflection)
            .zip(&mut **pressure);
        for (&load, (((major, minor), deflection), pressure)) in loads.iter().zip(outputs) {
            [_, *major, *minor, *deflection, *pressure] = ellipse_at(contact, load);
        }
        true
    }
}

/// The ellipse in the order of `results.Ellipse`.
#[inline]
pub fn ellipse_at(contact: &HertzContact, load: f32) -> [f32; 5] {
    let ellipse = contact.at(load);
    [
        contact.axis_ratio(),
        ellipse.semi_major,
        ellipse.semi_minor,
        ellipse.deflection,
        ellipse.max_pressure,
    ]
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
    let ellipse = arguments(py, names, values)?.map_blocks(py, Ellipses(Kept::NONE))?;
    let [ratio, major, minor, deflection, pressure] = ellipse.arrays(py)?;
    result(py, "Ellipse", (ratio, major, minor, deflection, pressure))
}

/// Friction maps at offsets.
struct Maps(Kept<1, FrictionMap>);

/// Largest offset.
const LARGEST_OFFSET: f32 = 1e9;

impl Kernel<f32, 2, 3> for Maps {
    #[inline]
    fn one(&mut self, [ratio, offset]: [f32; 2]) -> Result<[f32; 3], Refused> {
        within("offset", offset.into(), -1e9, 1e9)?;
        let friction = self
            .0
            .get([ratio], || FrictionMap::new(ratio))?
            .evaluate(offset);
        Ok([friction.force, friction.moment, friction.power])
    }

    /// One contact at many offsets.
    fn block(&mut self, block: &mut Block<'_, f32, 2, 3>) -> bool {
        let [ratio, offsets] = block.inputs;
        let ratio = ratio[0];
        let good = block.constant[0] && offsets.iter().all(|offset| offset.abs() <= LARGEST_OFFSET);
        let made = self.0.get([ratio], || FrictionMap::new(ratio));
        let Some(map) = made.ok().filter(|_| good) else {
            return false;
        };
        let [force, moment, power] = &mut block.outputs;
        for (place, &offset) in offsets.iter().enumerate() {
            let friction = map.evaluate(offset);
            (force[place], moment[place], power[place]) =
                (friction.force, friction.moment, friction.power);
        }
        true
    }
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
    let names = ["axis_ratio", "offset"];
    let map = arguments(py, names, [&axis_ratio, &offset])?.map_blocks(py, Maps(Kept::NONE))?;
    let [force, moment, power] = map.arrays(py)?;
    result(py, "FrictionMap", (force, moment, power))
}
