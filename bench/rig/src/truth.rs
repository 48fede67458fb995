//! What a rig was made with, under the names that a calibration has for it.

use super::parameters::{Coefficient, Parameters};

/// Start of a line above a trace's headings that says a parameter: `# truth: friction = 0.115`.
pub const MARK: &str = "# truth: ";

impl Parameters {
    /// Parameters by the names of `calibrate`, in SI units; the preload is the force of a contact. Of physics that a calibration has no name
    /// for there is nothing.
    #[must_use]
    pub fn named(&self) -> Vec<(String, f64)> {
        let mut named = vec![("friction".to_owned(), self.boundary)];
        let mut add = |name: &str, value: f64| named.push((name.to_owned(), value));
        if let Coefficient::Rational {
            half_share_speed,
            reference_temperature,
            pole,
        } = self.coefficient
        {
            add("full_film_ratio", self.full_film / self.boundary);
            add("half_share_speed", half_share_speed);
            add("reference_temperature", reference_temperature);
            add("viscosity_pole", pole);
        }
        let [forward, backward] = self.directions;
        add(
            "direction_asymmetry",
            (forward - backward) / (forward + backward),
        );
        add(
            "preload",
            self.screw.contact_force(self.screw.axial_preload),
        );
        if self.spinning.is_none() {
            add("breakaway_angle", self.breakaway);
        }
        add("backlash", self.backlash);
        add("inertia", self.inertia);
        add("drag", self.viscous);
        add("offset", self.offset);
        add("gain", self.load_gain);
        for wave in &self.waves {
            add(&format!("cosine_{}", wave.order), wave.cosine);
            add(&format!("sine_{}", wave.order), wave.sine);
        }
        named
    }

    /// The same as lines of text, each of which a reader of traces skips.
    #[must_use]
    pub fn header(&self) -> String {
        let line = |(name, value): (String, f64)| format!("{MARK}{name} = {value}\n");
        self.named().into_iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_physics_have_no_name() {
        let names = |parameters: Parameters| -> Vec<String> {
            parameters
                .named()
                .into_iter()
                .map(|(name, _)| name)
                .collect()
        };
        let plain = names(Parameters::default());
        assert!(plain.contains(&"viscosity_pole".into()) && plain.contains(&"sine_2".into()));
        let other = names(Parameters::other_physics());
        assert!(!other.contains(&"viscosity_pole".into()));
        assert!(!other.contains(&"breakaway_angle".into()));
    }
}
