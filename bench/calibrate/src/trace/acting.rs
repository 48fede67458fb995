//! What acts beside the motor: the load, and an effort that is known.

use std::f64::consts::TAU;

use crate::trace::columns::{Frame, take};
use crate::trace::table::{Column, Table};
use epas_traces::units::Quantity;

/// The load's column, and whether it is in the effort's own unit. With a design, a torque about the nut's axis is the axial load over the
/// lead.
///
/// # Errors
/// A load that is given twice, or as a torque where the effort is a force.
pub fn load(
    table: &mut Table,
    torque: bool,
    frame: Option<&Frame>,
) -> Result<(Option<Column>, bool), String> {
    let force = take(table, Quantity::Load);
    let moment = take(table, Quantity::LoadTorque);
    match (force, moment, frame) {
        (Some(force), Some(moment), _) => Err(format!(
            "columns {} and {}: give the load once",
            force.name, moment.name
        )),
        (_, Some(mut moment), Some(Frame { lead, .. })) => {
            for value in &mut moment.values {
                *value *= TAU / lead;
            }
            Ok((Some(moment), false))
        }
        (_, Some(moment), None) if !torque => Err(format!(
            "column {} and a motor_force: give the load as axial_load",
            moment.name
        )),
        (_, Some(moment), None) => Ok((Some(moment), true)),
        (force, None, _) => Ok((force, frame.is_none() && !torque)),
    }
}

/// The column of an effort that is known, of the motor's kind.
///
/// # Errors
/// A force beside a torque, or a torque beside a force.
pub fn known(table: &mut Table, torque: bool) -> Result<Option<Column>, String> {
    let force = take(table, Quantity::KnownForce);
    let moment = take(table, Quantity::KnownTorque);
    let (own, other, motor) = if torque {
        (moment, force, "motor_torque")
    } else {
        (force, moment, "motor_force")
    };
    match other {
        Some(other) => Err(format!(
            "column {} and a {motor}: give what is known as {}",
            other.name,
            motor.replace("motor", "known")
        )),
        None => Ok(own),
    }
}
