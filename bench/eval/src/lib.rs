//! `eval`: one JSON object a line in, one a line out, in order.

// The documentation of arguments is the program's help text, where back-quotes would be noise and
// square brackets are no links.
#![allow(
    clippy::doc_markdown,
    clippy::missing_errors_doc,
    rustdoc::broken_intra_doc_links,
    rustdoc::private_intra_doc_links
)]

pub mod ball_screw_pair;
mod ball_screw_train;
pub mod caged_torque;
pub mod contact_kinematics;
pub mod efficiency;
mod fields;
pub mod friction_map;
pub mod groove_curvature;
pub mod hertz;
pub mod linear_train;
mod lines;
mod model;
mod presliding;
mod static_load;
pub mod steady_state;
mod train;

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::value::RawValue;

use epas_page::failure::Failure;
pub use fields::BadField;
use fields::Fields;
#[doc(hidden)]
pub use groove_curvature::fit_range;
use lines::{Line, Lines};
use model::{Answer, answer};
pub use model::{Both, Model};
pub use train::ScrewNumbers;

/// Evaluates one model per line: JSON objects in, JSON objects out, in order.
///
/// A request is {"id": ANY, "model": NAME, ...fields}; its answer is {"id": ANY, "in_loop": {...}, "reference": {...}} with the
/// values of the f32 crate and of the float64 reference, or {"id": ANY, "error": {"field": "...", "message": "..."}}. A quantity
/// that does not exist is null. Blank lines are skipped.
///
/// A line that is no JSON object answers with a null id and the field "request". The exit code is 1 where any request was bad.
///
/// Models and fields (SI units, radians; those in brackets may be left out):
///
/// groove_curvature: groove ("screw" or "nut"), pitch_radius, lead_angle, contact_angle,
/// groove_radius, offset_h, offset_l, [ball_radius]; its fitted curvature is a fit for contact angles up to
/// 1.257 on a groove that a screw can have: nothing holds it where the groove is wider than the screw
///
/// efficiency: lead_angle, contact_angle, friction, ball_ratio, [rolling_tangent]
///
/// steady_state: lead_angle, contact_angle, friction, ball_radius, pitch_radius, speed, axial_load,
/// [ball_density]
///
/// hertz: relative_radius_1, relative_radius_2, load, contact_modulus
///
/// contact_kinematics: ball_diameter, pitch_radius, lead_angle, groove_radius_screw,
/// groove_radius_nut, contact_angle_screw, contact_angle_nut, pitch_angle, yaw_angle,
/// rolling_radius_screw, rolling_radius_nut, speed, semi_major_screw, semi_minor_screw,
/// semi_major_nut, semi_minor_nut
///
/// friction_map: axis_ratio, offset
///
/// linear_train: ball_radius, conformity, nominal_contact_angle, youngs_modulus, poisson_ratio, friction, [ball_friction], speed,
/// balls: a list, rear to front, of 1 to 64 {"contact_angles": [BL, BR, TR, TL], "contact_forces": [BL, BR, TR, TL]}; a force of
/// 0 is a lost contact. Answers with actual speeds, under the forces between the balls; at standstill the reference has none of
/// them.
///
/// `in_loop` has them twice: `scene` by the closed form that the scene of a linear bearing runs, and `analytic` by the same with
/// the printed slope 1.38 in the place of the exact one of the contact.
///
/// static_load: pitch_radius, lead, ball_radius, groove_radius, contact_angle, youngs_modulus, poisson_ratio, screw_length,
/// screw_diameter (outer), balls (their number), ball_spacing (angle), nut_position (axial centre of the balls), axial_load,
/// [ball_oversize (of the radius; a number, or a list with one for each ball)], [end_offset (x displacement forced on the right
/// end)].
///
/// The load acts on the left end, which moves only along the axis; the nut is rigid; the first ball stands at azimuth 0. No
/// in_loop: it is null.
///
/// ball_screw_train: pitch_radius, lead, ball_radius, groove_radius, youngs_modulus, poisson_ratio, friction, nut_speed, balls: a
/// list, rear to front in the direction of orbiting, of 1 to 64 {"contacts": {"SL": {"load", "contact_angle"}, ...}} with two to
/// four of SL, SR, NL, NR (screw or nut, left or right); a load of 0 is a lost contact.
///
/// Answers with the speeds of free balls, the forces between touching ones (none at standstill), and the power lost in grooves
/// and between balls; nothing where a ball is not loaded on both screw and nut.
///
/// `in_loop` finds the contacts itself, from the axial load of each ball and the deviations of its contact angles in either
/// groove, which are read off the given contacts.
///
/// It has them by the closed form of a row, which no step runs. load_mismatch (over the largest load of a ball) and
/// angle_mismatch say how far the given contacts are from those found.
///
/// Largest errors of the closed form over the stored balls and pairs: speeds 3e-3 of the nut's, force 1.6 %, power 5.0 %.
///
/// In rows of up to 64 of these balls 5 % of the largest force, and 17 % (power 9.3 %) where balls push each other until their third
/// contacts slide. Such forces are up to a factor of two too large at 100 N a ball.
///
/// All of it is null where a ball has four loaded contacts, where numbers of contacts differ from ball to ball, where balls are
/// loaded in different directions, and where a load or an angle is too far from those found.
///
/// Too far is 0.1 of the largest load, and 0.01 rad; contacts of a nut that turns the other way are. At standstill the closed form has
/// speeds and power (0) alone.
///
/// ball_screw_pair: pitch_radius, lead, ball_radius, groove_radius, contact_angle, youngs_modulus, poisson_ratio, friction,
/// [ball_friction (0)], clearance (radial gap of every contact at the centred ball and the unloaded screw: play above 0, oversize
/// below), nut_speed, balls: a list, rear to front in the direction of orbiting, of 2 to 64 {"screw_deviation", "nut_deviation",
/// "axial_load"}.
///
/// Contact angles are SL = contact_angle - screw_deviation, SR = contact_angle + screw_deviation, NL and NR likewise by
/// nut_deviation; a positive axial load is carried by SL and NR, a negative one by SR and NL.
///
/// Answers with free_speed (list, orbital over nut speed, no neighbour pressing), contact_force (list), groove_torque and
/// groove_torque_free (on the nut, all balls, pressing and none pressing) and loads (list of [SL, SR, NL, NR], none pressing).
///
/// groove_torque has all that friction between balls adds, in the grooves and between them; ball_torque is the part between them.
///
/// The reference has balls in elastic grooves with exact friction, by contact integrals of 32 nodes; its quantities are null at
/// standstill, for a ball without load and where no answer was found that meets every balance.
///
/// `in_loop` is what the law finds that the scene of a ball screw without cage evaluates, folded for the request: for deviations
/// up to the largest one in each groove, of either sign, and for 5 to 300 N a ball, or down and up to the next power of two where
/// the request needs more.
///
/// It has no loads and no ball_torque, and flagged beside the rest: whether a step flags this row, by the forces, the load, the friction forces
/// between balls and the grip.
///
/// It is null where the reference is for lack of speed or load, for loads of both signs, for a clearance outside -0.02 to 0.05
/// ball radii, for deviations above 0.1, and where no law holds these deviations and loads. A law takes some seconds; requests
/// with the same screw, friction, clearance and largest deviations share one.
///
/// Its object `closed_form` has the same by a closed form that no scene runs: it knows no play, preload and two-point contact,
/// and takes of them what is nearest to the clearance; with it balls that press do not change the torque.
///
/// presliding: form ("proportional" or "load_exact"), table (proportional: "slip4", "slip6", "slip8", "slip10", "spin4", "spin6",
/// "spin8" or "spin10") or largest_load (load_exact, eight elements), angle (list, over the breakaway angle, the first one the
/// start, where nothing is remembered), [load (list as long, over the reference load; 1)], limit_ratio ([forward, backward], over
/// the load).
///
/// Answers with torque, over the limit at the reference load, one for each angle, the first one 0. The reference also has exact:
/// what the elements stand for; null for proportional with a load.
///
/// caged_torque: pitch_radius, lead, ball_radius, groove_radius, contact_angle, youngs_modulus, poisson_ratio, friction,
/// clearance (as of ball_screw_pair), axial_load (list of up to 1000, N a ball; a positive one opposes the travel of a nut that
/// turns forward), direction (1 forward or -1).
///
/// Answers with torque, one for each load: the friction torque of one ball on the nut that has to be overcome, N m, positive in
/// either direction, without rolling resistance.
///
/// Of caged_torque the reference solves the elastic balance of the ball with exact friction, from the largest load down; where it finds no
/// answer, the list holds null. Where two torques are exact, because a contact opens later than it closes, it is that under a falling load.
/// Under no load the torque is 0, or that of the preload.
///
/// in_loop of caged_torque is what a step of the scene CagedBallScrew outputs, with a block folded for the request: over 5 to
/// 300 N a ball, or the range of the list where that is wider (from 0.01 N).
///
/// It is null for a clearance outside -0.02 to 0.05 ball radii, and for a design that cannot be folded. A request takes about a
/// second.
#[expect(
    clippy::doc_markdown,
    reason = "the text of the help, which has no markdown"
)]
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// File with the requests; stdin without it or for -
    file: Option<PathBuf>,
}

/// Reads a request from its fields, refuses what is left over, and answers it.
type Door = fn(Fields) -> Result<Answer, BadField>;

/// Every model by its name.
const MODELS: [(&str, Door); 12] = [
    (
        groove_curvature::Request::NAME,
        answer::<groove_curvature::Request>,
    ),
    (efficiency::Request::NAME, answer::<efficiency::Request>),
    (steady_state::Request::NAME, answer::<steady_state::Request>),
    (hertz::Request::NAME, answer::<hertz::Request>),
    (
        contact_kinematics::Request::NAME,
        answer::<contact_kinematics::Request>,
    ),
    (friction_map::Request::NAME, answer::<friction_map::Request>),
    (linear_train::Request::NAME, answer::<linear_train::Request>),
    ("static_load", static_load::evaluate),
    ("ball_screw_train", ball_screw_train::evaluate),
    (
        ball_screw_pair::Request::NAME,
        answer::<ball_screw_pair::Request>,
    ),
    ("presliding", presliding::evaluate),
    (caged_torque::Request::NAME, answer::<caged_torque::Request>),
];

/// A line of the output.
#[derive(Serialize)]
struct Reply<'a> {
    id: Option<&'a RawValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    in_loop: Option<Box<RawValue>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reference: Option<Box<RawValue>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<BadField>,
}

/// Answers every request of the file or of stdin.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let output = BufWriter::new(io::stdout().lock());
    let all_good = match &arguments.file {
        Some(path) if path.as_os_str() != "-" => {
            let file = File::open(path).map_err(|error| Failure::file("open", path, &error))?;
            answer_all(file, path, output)?
        }
        _ => answer_all(io::stdin().lock(), Path::new("stdin"), output)?,
    };
    if all_good {
        Ok(())
    } else {
        Err(Failure::Answered)
    }
}

/// Answers line by line, with no more than one line in memory; true where every request was good.
fn answer_all(input: impl Read, path: &Path, mut output: impl Write) -> Result<bool, Failure> {
    let mut lines = Lines::new(input);
    let mut all_good = true;
    loop {
        // A program that waits for its answer before it asks again gets it now.
        if lines.would_wait() {
            output.flush()?;
        }
        let line = match lines.next_line() {
            Ok(Some(line)) => line,
            Ok(None) => break,
            Err(error) => return Err(Failure::file("read", path, &error)),
        };
        let reply = match line {
            Line::Blank => continue,
            Line::Text(text) => Reply::to(text),
            Line::Unreadable(message) => Reply::of(None, Err(BadField::request(message))),
        };
        all_good &= reply.error.is_none();
        serde_json::to_writer(&mut output, &reply).map_err(io::Error::from)?;
        output.write_all(b"\n")?;
    }
    output.flush()?;
    Ok(all_good)
}

impl<'a> Reply<'a> {
    fn to(line: &'a str) -> Self {
        let read = Fields::parse(line).and_then(|fields| Ok((fields.id()?, fields)));
        match read {
            Ok((id, fields)) => Self::of(id, evaluate(fields)),
            Err(error) => Self::of(None, Err(error)),
        }
    }

    fn of(id: Option<&'a RawValue>, result: Result<Answer, BadField>) -> Self {
        let (answer, error) = match result {
            Ok(answer) => (Some(answer), None),
            Err(error) => (None, Some(error)),
        };
        let (in_loop, reference) = answer
            .map(|answer| (answer.in_loop, answer.reference))
            .unzip();
        Self {
            id,
            in_loop,
            reference,
            error,
        }
    }
}

/// The answer to one line, as a line of the output without its end.
pub fn answer_line(line: &str) -> String {
    serde_json::to_string(&Reply::to(line)).unwrap_or_default()
}

/// Answers one line; whether it was a good request.
pub fn accepts(line: &str) -> bool {
    Reply::to(line).error.is_none()
}

fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    fields.refuse_duplicate()?;
    let model = fields.choice("model", &MODELS)?;
    model(fields)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least friction coefficient of the crate is one that `eval` takes: single precision has it just below the decimal number.
    #[test]
    fn the_least_friction_of_the_crate_is_answered() {
        let least = f64::from(epas_friction::ranges::FRICTION.minimum);
        assert!(least < 1e-6);
        let ball = r#"{"contact_angles":[0.7,0.7,0.7,0.7],"contact_forces":[1,1,1,1]}"#;
        let linear = format!(
            r#"{{"id":1,"model":"linear_train","ball_radius":0.005,"conformity":0.56,"nominal_contact_angle":0.7854,"youngs_modulus":2.1e11,"poisson_ratio":0.3,"friction":{least:e},"speed":0.5,"balls":[{ball}]}}"#
        );
        let contact = r#"{"load":50,"contact_angle":0.7854}"#;
        let screw = format!(
            r#"{{"id":2,"model":"ball_screw_train","pitch_radius":0.0165,"lead":0.02,"ball_radius":0.002778,"groove_radius":0.003254,"youngs_modulus":2.1e11,"poisson_ratio":0.28,"friction":{least:e},"nut_speed":1,"balls":[{{"contacts":{{"SL":{contact},"NR":{contact}}}}},{{"contacts":{{"SL":{contact},"NR":{contact}}}}}]}}"#
        );
        for line in [linear, screw] {
            assert!(accepts(&line), "{}", answer_line(&line));
            let below = line.replace(&format!("{least:e}"), "9.9e-7");
            assert!(!accepts(&below), "{below}");
        }
    }
}
