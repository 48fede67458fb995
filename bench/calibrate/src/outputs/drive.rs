//! A drive without a drawing as Rust constants for firmware.

use std::fmt::Write as _;

use epas_friction::{Limits, LoadProportionalConfiguration, LoadProportionalConstants};

use crate::outputs::constants::{SOUND, head};
use crate::without_design::drive::{Drive, Numbers};
use epas_page::failure::Failure;

/// Constants of a drive, to be pasted.
pub fn text(drive: &Drive, trace: &str) -> Result<String, Failure> {
    let numbers = drive.numbers()?;
    let configuration = configuration(&numbers);
    LoadProportionalConstants::new(&configuration)
        .map_err(|error| Failure::Data(format!("no constants: {error}")))?;
    let mut text = head("A drive without a drawing", trace);
    for (told, name) in numbers.told.into_iter().zip(["driving", "back-driving"]) {
        if !told {
            let _ = writeln!(
                text,
                "// The trace does not tell the loss of {name}: it is 0 here."
            );
        }
    }
    if !numbers.reversal_speed.1 {
        text += "// The trace shows no speed over which friction reverses: a thousandth of its largest stands for it.\n";
    }
    let _ = write!(
        text,
        "
use epas_friction::{{Error, Limits, LoadProportionalConfiguration, LoadProportionalConstants}};
{SOUND}
/// The drive: for a `static` that stands in flash. Its limits are twice what the trace has.
pub const DRIVE: LoadProportionalConstants =
    sound(LoadProportionalConstants::new(&{configuration:#?}));

/// Inertia of all that turns, kg m².
pub const INERTIA: f32 = {:?};

/// Torque that the motor's channel shows without any, N m.
pub const OFFSET: f32 = {:?};
",
        numbers.inertia as f32, numbers.offset as f32,
    );
    Ok(text)
}

/// The scene's configuration.
fn configuration(numbers: &Numbers) -> LoadProportionalConfiguration {
    let [driving_loss, back_driving_loss] = numbers.losses.map(|loss| loss as f32);
    let [nut_speed, axial_load, friction_torque] = numbers.limits.map(|limit| limit as f32);
    LoadProportionalConfiguration {
        load_lever: numbers.load_lever as f32,
        coulomb_friction: numbers.coulomb_friction as f32,
        viscous_friction: numbers.viscous_friction as f32,
        driving_loss,
        back_driving_loss,
        reversal_speed: numbers.reversal_speed.0 as f32,
        limits: Limits {
            nut_speed,
            axial_load,
            friction_torque,
        },
    }
}
