//! A position controller with a speed loop inside it: `effort = V (P (reference - position) - speed)`.

use std::str::FromStr;

/// Gains of a controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controller {
    /// `P`, 1/s.
    pub gain_position: f64,
    /// `V`, N s/m or N m s/rad.
    pub gain_speed: f64,
}

impl FromStr for Controller {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut gains = [None; 2];
        for part in text.split(',') {
            let (name, value) = part
                .split_once('=')
                .ok_or_else(|| format!("{part}: expected gain_position=P,gain_speed=V"))?;
            let (name, value) = (name.trim(), value.trim());
            let place = NAMES
                .iter()
                .position(|known| *known == name)
                .ok_or_else(|| {
                    format!(
                        "{name} is no gain of the controller; it has gain_position and gain_speed"
                    )
                })?;
            let number = value.parse().ok().filter(|number: &f64| number.is_finite());
            let number = number
                .filter(|number| *number > 0.0)
                .ok_or_else(|| format!("{name} = {value} is out of range; allowed: above 0"))?;
            if gains[place].replace(number).is_some() {
                return Err(format!("{name} is given twice"));
            }
        }
        let of = |place: usize| gains[place].ok_or(format!("{} is missing", NAMES[place]));
        Ok(Self {
            gain_position: of(0)?,
            gain_speed: of(1)?,
        })
    }
}

const NAMES: [&str; 2] = ["gain_position", "gain_speed"];

impl Controller {
    /// Effort it asks for, N or N m.
    pub fn effort(&self, reference: f64, position: f64, speed: f64) -> f64 {
        self.gain_speed * (self.gain_position * (reference - position) - speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_are_read_and_wrong_ones_are_named() {
        let read: Controller = "gain_position=160.18,gain_speed=8557.4".parse().unwrap();
        assert_eq!(read.gain_position, 160.18);
        assert_eq!(read.gain_speed, 8557.4);
        for (text, word) in [
            ("", "expected"),
            ("gain_position=1", "gain_speed is missing"),
            ("gain_position=1,gain_speed=nan", "gain_speed"),
            ("gain_position=-1,gain_speed=1", "gain_position"),
            ("gain_position=1,gain_position=1", "twice"),
            ("gain=1,gain_speed=1", "gain is no gain"),
            ("gain_position=x,gain_speed=1", "above 0"),
        ] {
            let error = text.parse::<Controller>().unwrap_err();
            assert!(error.contains(word), "{text}: {error}");
        }
    }
}
