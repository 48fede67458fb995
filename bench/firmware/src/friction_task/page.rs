//! The calibration page: numbers that a tuner changes while the controller runs, and the checks that a page has to pass.

use epas_friction::stored::Fingerprint;

use super::table::table;

table! {
    /// Numbers that a tuner may change while the controller runs.
    pub struct Calibration, CALIBRATION {
        /// Nut speed beyond which the limit stands in for it
        largest_nut_speed: f32, "rad/s", 10.0 to 700.0;
        /// Axial load of either sign beyond which the limit stands in for it
        largest_axial_load: f32, "N", 1_000.0 to 50_000.0;
        /// Friction torque about the axis of the nut that is never exceeded
        largest_friction_torque: f32, "N m", 0.1 to 20.0;
        /// Friction coefficient of ball and groove at standstill
        friction_boundary: f32, "", 0.05 to 0.15;
        /// Friction coefficient of ball and groove at high speed, on a full film
        friction_full_film: f32, "", 0.05 to 0.15;
        /// Nut speed at which half of the film has formed, at 293.15 K
        half_share_speed: f32, "rad/s", 0.1 to 100.0;
        /// Factor of both friction coefficients at positive speed
        friction_forward: f32, "", 0.5 to 1.5;
        /// Factor of both friction coefficients at negative speed
        friction_backward: f32, "", 0.5 to 1.5;
        /// Torque of churned lubricant over its viscosity and the nut speed
        churning: f32, "m^3", 0.0 to 0.001;
        /// Reversal: nut angle after which friction has turned round, the high end of what was identified
        breakaway_angle: f32, "rad", 0.0005 to 0.05;
        /// Reversal: half width of the play that keeps the noise of the encoder from the friction
        angle_play: f32, "rad", 0.0001 to 0.01;
        /// Share of the friction torque that the motor outputs
        share: f32, "", 0.0 to 0.95;
        /// Age up to which a rack force counts as it is
        load_hold: f32, "s", 0.001 to 0.1;
        /// Time after that in which the rack force fades to none
        load_fade: f32, "s", 0.01 to 1.0;
        /// Temperature that stands in for one that is too old
        temperature_fallback: f32, "K", 250.0 to 400.0;
        /// Age up to which a temperature counts as it is
        temperature_hold: f32, "s", 0.1 to 600.0;
        /// Time after that in which the temperature fades to its fallback
        temperature_fade: f32, "s", 0.1 to 600.0;
        /// Time without a sound angle for which the torque stays
        torque_hold: f32, "s", 0.0 to 0.05;
        /// Time after that in which the torque fades to none, and in which it comes back
        torque_fade: f32, "s", 0.02 to 1.0;
        /// Fastest change of the torque output
        torque_slew: f32, "N m/s", 10.0 to 5_000.0;
        /// Least friction level that the adaptation may set
        least_level: f32, "", 0.1 to 1.0;
        /// Largest friction level that the adaptation may set
        largest_level: f32, "", 1.0 to 10.0;
    }
}

impl Calibration {
    /// What the flash holds: where the example starts, and what it goes back to.
    pub const REFERENCE: Self = Self {
        largest_nut_speed: 500.0,
        largest_axial_load: 20_000.0,
        largest_friction_torque: 5.0,
        friction_boundary: 0.12,
        friction_full_film: 0.05,
        half_share_speed: 15.35,
        friction_forward: 1.0,
        friction_backward: 1.0,
        churning: 0.0,
        breakaway_angle: 4e-3,
        angle_play: 3e-4,
        share: 0.8,
        load_hold: 0.01,
        load_fade: 0.09,
        temperature_fallback: 313.15,
        temperature_hold: 60.0,
        temperature_fade: 60.0,
        torque_hold: 0.01,
        torque_fade: 0.2,
        torque_slew: 800.0,
        least_level: 0.4,
        largest_level: 2.5,
    };
}

/// A page as it stands in memory.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CalibrationPage {
    /// Which numbers the page has, in which order: [`LAYOUT`].
    pub layout: u32,
    /// The numbers.
    pub numbers: Calibration,
    /// CRC-32 (as in zip files) of all bytes before it.
    pub checksum: u32,
}

/// Why a page was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// It is of another layout: of an older or newer program.
    Layout,
    /// Its checksum does not hold: it is damaged, or half written.
    Checksum,
    /// The number with this index in [`CALIBRATION`] is outside its limits or NaN.
    Range(u32),
    /// Every number is within its limits, and the model does not take them together.
    Together,
}

/// Checksum of names and units: another table is another layout.
pub const LAYOUT: u32 = {
    let mut sum = Fingerprint::NONE;
    let mut index = 0;
    while index < CALIBRATION.len() {
        sum.bytes(CALIBRATION[index].name.as_bytes());
        sum.bytes(CALIBRATION[index].unit.as_bytes());
        index += 1;
    }
    sum.value()
};

impl CalibrationPage {
    /// The page in flash.
    pub const REFERENCE: Self = Self::of(Calibration::REFERENCE);

    /// A sound page of these numbers.
    #[must_use]
    pub const fn of(numbers: Calibration) -> Self {
        let mut page = Self {
            layout: LAYOUT,
            numbers,
            checksum: 0,
        };
        page.checksum = page.sum();
        page
    }

    /// The checksum that it should have.
    #[must_use]
    pub const fn sum(&self) -> u32 {
        let mut sum = Fingerprint::NONE;
        sum.count(self.layout);
        let words = self.numbers.words();
        let mut rest = words.as_slice();
        while let Some((&word, others)) = rest.split_first() {
            sum.count(word);
            rest = others;
        }
        sum.value()
    }

    /// Its numbers, where every one may be taken.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn checked(&self) -> Result<Calibration, Refused> {
        if self.layout != LAYOUT {
            return Err(Refused::Layout);
        }
        if self.checksum != self.sum() {
            return Err(Refused::Checksum);
        }
        for ((index, field), word) in (0..).zip(&CALIBRATION).zip(self.numbers.words()) {
            let value = f32::from_bits(word);
            // NaN is within no limits.
            if !(field.minimum <= value && value <= field.maximum) {
                return Err(Refused::Range(index));
            }
        }
        Ok(self.numbers)
    }
}
