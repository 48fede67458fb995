//! A few ticks of every scene, logged through defmt.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use defmt_semihosting as _;
use epas_firmware::board::finish;
use epas_firmware::gears::GEAR_33X20;
use epas_firmware::scenes::{BALLS, CARRIAGE, UNCAGED_SCREW, course};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{
    BallScrew, BallScrewParameters, DISSERTATION_DESIGNS, Error, FrictionModel, Inputs,
    LinearBearingTrain, LinearInputs, UncagedBallScrew,
};

#[entry]
fn main() -> ! {
    match log() {
        Ok(()) => finish(true),
        Err(error) => {
            defmt::error!("refused: {}", error);
            finish(false)
        }
    }
}

fn log() -> Result<(), Error> {
    let configuration = UNCAGED_SCREW;
    defmt::info!("lead {}", configuration.folded.lead);
    // What an engineer gets wrong, and what the log says of it.
    let [_, design, _] = DISSERTATION_DESIGNS;
    let wrong = BallScrewParameters {
        lead: -1.0,
        ..design.parameters
    };
    if let Err(error) = BallScrew::new(wrong) {
        defmt::warn!("refused: {}", error);
    }
    let mut caged = FrictionModel::<CagedBallScrew, _>::of(&GEAR_33X20);
    let mut uncaged = FrictionModel::<UncagedBallScrew<BALLS>>::new(&configuration)?;
    let mut linear = FrictionModel::<LinearBearingTrain<24>>::new(&CARRIAGE)?;
    for tick in [100, 300, 500] {
        let (nut_speed, axial_load) = course(tick);
        let inputs = Inputs {
            nut_speed,
            axial_load,
        };
        defmt::info!("tick {=u32}: {}", tick, inputs);
        defmt::info!("caged {}", caged.step(inputs));
        defmt::info!("37 balls {}", uncaged.step(inputs));
        let inputs = LinearInputs {
            speed: 0.02 * nut_speed,
            normal_load: 1500.0,
            side_load: 0.02 * axial_load,
        };
        defmt::debug!("linear {}", linear.step(inputs));
    }
    let broken = Inputs {
        nut_speed: f32::NAN,
        axial_load: 0.0,
    };
    defmt::warn!("broken sensor: {}", caged.step(broken).faults);
    Ok(())
}
