//! A model: a request with types, and what the crate and the reference answer to it.

use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};

use super::fields::{BadField, Fields, Object};

/// What the crate computes in f32, and what the float64 reference computes.
#[derive(Clone, Debug)]
pub struct Both<InLoop, Reference> {
    /// By the crate.
    pub in_loop: InLoop,
    /// By the reference.
    pub reference: Reference,
}

/// A request that has both answers.
pub trait Model: Serialize {
    /// Its name in a line of `eval`.
    const NAME: &'static str;
    /// What the crate answers; `()`, null in JSON, where only the reference has the model.
    type InLoop: Serialize;
    /// What the reference answers.
    type Reference: Serialize;

    /// Both answers.
    fn evaluate(&self) -> Result<Both<Self::InLoop, Self::Reference>, BadField>;

    /// The line that asks `eval` the same, with the id 0.
    fn line(&self) -> Result<String, BadField> {
        #[derive(Serialize)]
        struct Line<'a, T: ?Sized> {
            id: u8,
            model: &'static str,
            #[serde(flatten)]
            fields: &'a T,
        }
        let line = Line {
            id: 0,
            model: Self::NAME,
            fields: self,
        };
        Ok(json(&line)?.get().to_owned())
    }
}

/// Both answers in JSON.
pub type Answer = Both<Box<RawValue>, Box<RawValue>>;

impl<InLoop: Serialize, Reference: Serialize> Both<InLoop, Reference> {
    pub(crate) fn json(&self) -> Result<Answer, BadField> {
        Ok(Both {
            in_loop: json(&self.in_loop)?,
            reference: json(&self.reference)?,
        })
    }
}

/// Reads a request of a model, refuses what is left over, and answers it.
pub fn answer<M: Model + Object>(mut fields: Fields) -> Result<Answer, BadField> {
    let request = M::read(&mut fields)?;
    fields.finish()?;
    request.evaluate()?.json()
}

/// Writes numbers with the fewest digits that read back as the same float64, and those that are not
/// finite as null.
fn json(value: &impl Serialize) -> Result<Box<RawValue>, BadField> {
    to_raw_value(value).map_err(|error| BadField::request(error.to_string()))
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, from_str, to_value};

    use super::*;
    use crate::{
        answer_line, ball_screw_pair, caged_torque, contact_kinematics, efficiency, friction_map,
        groove_curvature, hertz, linear_train, steady_state,
    };

    const SCREW: &str = r#""pitch_radius":0.0165,"lead":0.02,"ball_radius":0.002778,"groove_radius":0.003254,
        "youngs_modulus":2.1e11,"poisson_ratio":0.28,"contact_angle":0.785,"friction":0.1,"clearance":0.0"#;

    /// Reads a request of these fields, and holds the line that it prints, and what `eval` answers to it, to the request.
    fn round_trip<M: Model + Object>(fields: &str) {
        let read = |text: &str| -> Value { from_str(text).unwrap() };
        let text = format!("{{{fields}}}");
        let mut fields = Fields::parse(&text).unwrap();
        let request = M::read(&mut fields).unwrap();
        fields.finish().unwrap();
        let line = request.line().unwrap();
        let mut expected = read(&text);
        expected["id"] = 0.into();
        expected["model"] = M::NAME.into();
        assert_eq!(read(&line), expected);
        let both = request.evaluate().unwrap();
        let mut expected = read(r#"{"id":0}"#);
        expected["in_loop"] = to_value(both.in_loop).unwrap();
        expected["reference"] = to_value(both.reference).unwrap();
        assert_eq!(read(&answer_line(&line)), expected);
    }

    #[test]
    fn formulas_are_answered_as_their_lines_are() {
        round_trip::<groove_curvature::Request>(
            r#""groove":"nut","pitch_radius":0.008,"lead_angle":0.2,"contact_angle":0.8,"groove_radius":0.0017,
            "offset_h":6e-5,"offset_l":6e-5,"ball_radius":0.0016"#,
        );
        round_trip::<groove_curvature::Request>(
            r#""groove":"screw","pitch_radius":0.008,"lead_angle":0.2,"contact_angle":0.8,"groove_radius":0.0017,
            "offset_h":6e-5,"offset_l":6e-5"#,
        );
        round_trip::<efficiency::Request>(
            r#""lead_angle":0.2,"contact_angle":0.8,"friction":0.1,"ball_ratio":0.2,"rolling_tangent":0.001"#,
        );
        round_trip::<steady_state::Request>(
            r#""lead_angle":0.2,"contact_angle":0.8,"friction":0.05,"ball_radius":0.004,"pitch_radius":0.024,
            "speed":200.0,"axial_load":2000.0,"ball_density":7700.0"#,
        );
        round_trip::<hertz::Request>(
            r#""relative_radius_1":0.003,"relative_radius_2":0.06,"load":100.0,"contact_modulus":1.1e11"#,
        );
        round_trip::<contact_kinematics::Request>(
            r#""ball_diameter":0.00635,"pitch_radius":0.016,"lead_angle":0.2,"groove_radius_screw":0.0034,
            "groove_radius_nut":0.0035,"contact_angle_screw":0.8,"contact_angle_nut":0.75,"pitch_angle":0.7,
            "yaw_angle":0.1,"rolling_radius_screw":0.0031,"rolling_radius_nut":0.0032,"speed":100.0,
            "semi_major_screw":4e-4,"semi_minor_screw":6e-5,"semi_major_nut":5e-4,"semi_minor_nut":7e-5"#,
        );
        round_trip::<friction_map::Request>(r#""axis_ratio":0.2,"offset":0.7"#);
    }

    #[test]
    fn balls_are_answered_as_their_lines_are() {
        round_trip::<linear_train::Request>(
            r#""ball_radius":0.005,"conformity":0.56,"nominal_contact_angle":0.785,"youngs_modulus":2.1e11,
            "poisson_ratio":0.3,"friction":0.1,"ball_friction":0.05,"speed":0.5,"balls":[
            {"contact_angles":[0.78,0.79,0.785,0.785],"contact_forces":[50.0,60.0,55.0,54.0]},
            {"contact_angles":[0.8,0.76,0.785,0.785],"contact_forces":[50.0,0.0,55.0,4.0]}]"#,
        );
        // At standstill nothing has to be solved.
        round_trip::<ball_screw_pair::Request>(&format!(
            r#"{SCREW},"ball_friction":0.1,"nut_speed":0.0,"balls":[
            {{"screw_deviation":0.0,"nut_deviation":0.0,"axial_load":-50.0}},
            {{"screw_deviation":0.01,"nut_deviation":-0.02,"axial_load":-60.0}}]"#
        ));
        round_trip::<caged_torque::Request>(&format!(
            r#"{SCREW},"axial_load":[0.0,50.0,-20.0],"direction":1.0"#
        ));
    }

    /// A density and a rolling tangent that a line leaves out are those of the typed default.
    #[test]
    fn what_is_left_out_has_its_value() {
        let fields = r#""id":0,"lead_angle":0.2,"contact_angle":0.8,"friction":0.05"#;
        let state = format!(
            r#"{{{fields},"model":"steady_state","ball_radius":0.004,"pitch_radius":0.024,"speed":200,"axial_load":2000"#
        );
        let given = format!(r#"{state},"ball_density":7800}}"#);
        assert_eq!(answer_line(&format!("{state}}}")), answer_line(&given));
        assert!(given.contains(&steady_state::BALL_DENSITY.to_string()));
        let screw = format!(r#"{{{fields},"model":"efficiency","ball_ratio":0.2"#);
        let given = format!(r#"{screw},"rolling_tangent":0}}"#);
        assert_eq!(answer_line(&format!("{screw}}}")), answer_line(&given));
    }
}
