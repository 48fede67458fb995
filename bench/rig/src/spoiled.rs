//! Traces as a careless measurement would have them: what a calibration must refuse, or must not be misled by.

use super::Trace;

/// What is wrong with a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spoiling {
    /// The motor's channel ends at half of its largest torque.
    ClippedTorque,
    /// The angle is in degrees in a column of radians.
    WrongUnits,
    /// The torque has the other sign.
    WrongSign,
    /// The load has the other sign.
    WrongLoadSign,
    /// The torque comes 25 ms later than the angle.
    ShiftedClock,
    /// The clock goes back by half a second in the middle.
    ClockGoesBack,
    /// Three torques are no numbers.
    NotANumber,
    /// Every hundredth sample is missing.
    DroppedSamples,
    /// A second is missing in the middle.
    Gap,
    /// The angle stands still: its sensor is dead.
    DeadAngle,
    /// The load stands still: its sensor is dead.
    DeadLoad,
}

impl Spoiling {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::ClippedTorque,
        Self::WrongUnits,
        Self::WrongSign,
        Self::WrongLoadSign,
        Self::ShiftedClock,
        Self::ClockGoesBack,
        Self::NotANumber,
        Self::DroppedSamples,
        Self::Gap,
        Self::DeadAngle,
        Self::DeadLoad,
    ];
}

impl Trace {
    /// The measured columns with this wrong; the truth stays as it was, but for samples that are missing.
    #[must_use]
    pub fn spoiled(mut self, by: Spoiling) -> Self {
        let samples = self.len();
        let middle = samples / 2;
        let tick =
            self.time.get(1).copied().unwrap_or(1e-3) - self.time.first().copied().unwrap_or(0.0);
        match by {
            Spoiling::ClippedTorque => {
                let largest = self
                    .motor_torque
                    .iter()
                    .fold(0.0_f64, |most, torque| most.max(torque.abs()));
                for torque in &mut self.motor_torque {
                    *torque = torque.clamp(-0.5 * largest, 0.5 * largest);
                }
            }
            Spoiling::WrongUnits => {
                for angle in &mut self.nut_position {
                    *angle = angle.to_degrees();
                }
            }
            Spoiling::WrongSign => {
                for torque in &mut self.motor_torque {
                    *torque = -*torque;
                }
            }
            Spoiling::WrongLoadSign => {
                for load in &mut self.axial_load {
                    *load = -*load;
                }
            }
            Spoiling::ShiftedClock => {
                let late = ((0.025 / tick).round() as usize).min(samples);
                let first = self.motor_torque.first().copied().unwrap_or(0.0);
                self.motor_torque.rotate_right(late);
                self.motor_torque[..late].fill(first);
            }
            Spoiling::ClockGoesBack => {
                for time in &mut self.time[middle..] {
                    *time -= 0.5;
                }
            }
            Spoiling::NotANumber => {
                for sample in [samples / 4, middle, 3 * samples / 4] {
                    self.motor_torque[sample] = f64::NAN;
                }
            }
            Spoiling::DroppedSamples => self.keep(|sample| sample % 100 != 50),
            Spoiling::Gap => {
                let second = (1.0 / tick).round() as usize;
                self.keep(|sample| !(middle..middle + second).contains(&sample));
            }
            Spoiling::DeadAngle => self.nut_position.fill(0.0),
            Spoiling::DeadLoad => self.axial_load.fill(0.0),
        }
        self
    }

    /// Only the samples that are wanted, without the parts' names.
    fn keep(&mut self, wanted: impl Fn(usize) -> bool) {
        let truth = &mut self.truth;
        for column in [
            &mut self.time,
            &mut self.nut_position,
            &mut self.motor_torque,
            &mut self.axial_load,
            &mut self.temperature,
            &mut truth.position,
            &mut truth.speed,
            &mut truth.acceleration,
            &mut truth.load,
            &mut truth.friction,
            &mut truth.torque,
        ] {
            let mut sample = 0;
            column.retain(|_| {
                sample += 1;
                wanted(sample - 1)
            });
        }
        self.parts.clear();
    }
}
