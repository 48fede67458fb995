//! A drive without a drawing as Rust constants for firmware.

use std::fmt::Write as _;

use epas_friction::{Limits, LoadProportionalConfiguration, LoadProportionalConstants};

use crate::outputs::constants::{SOUND, head};
use crate::without_design::drive::Numbers;
use epas_page::failure::Failure;

pub fn text(numbers: &Numbers, trace: &str) -> Result<String, Failure> {
    let configuration = configuration(numbers);
    LoadProportionalConstants::new(&configuration)
        .map_err(|error| Failure::Data(format!("no constants: {error}")))?;
    let mut text = head("A drive without a drawing", trace);
    for note in &numbers.notes {
        let _ = writeln!(text, "// {note}.");
    }
    let _ = write!(
        text,
        "
use epas_friction::{{Error, Limits, LoadProportionalConfiguration, LoadProportionalConstants}};
{SOUND}
/// The drive: for a `static` that stands in flash. Its limits are twice what the trace has.
pub const DRIVE: LoadProportionalConstants =
    sound(LoadProportionalConstants::new(&{configuration:#?}));
"
    );
    let others = [
        (
            "INERTIA",
            "Inertia of all that turns, kg m²",
            numbers.inertia,
        ),
        (
            "OFFSET",
            "Torque that the motor's channel shows without any, N m",
            numbers.offset,
        ),
    ];
    for (name, what, value) in others {
        if let Some(value) = value {
            let value = value as f32;
            let _ = write!(text, "\n/// {what}.\npub const {name}: f32 = {value:?};\n");
        }
    }
    Ok(text)
}

fn configuration(numbers: &Numbers) -> LoadProportionalConfiguration {
    let [driving_loss, back_driving_loss] = numbers.losses.map(|loss| loss as f32);
    let [nut_speed, axial_load, friction_torque] = numbers.limits.map(|limit| limit as f32);
    LoadProportionalConfiguration {
        load_lever: numbers.load_lever as f32,
        coulomb_friction: numbers.coulomb_friction as f32,
        viscous_friction: numbers.viscous_friction as f32,
        driving_loss,
        back_driving_loss,
        reversal_speed: numbers.reversal_speed as f32,
        limits: Limits {
            nut_speed,
            axial_load,
            friction_torque,
        },
    }
}
