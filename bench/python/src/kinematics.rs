//! Motion of a ball between screw and nut, in single and in double precision.

use epas_friction::kinematics::{ContactKinematics, ContactSlip, KinematicsParameters, SlipRatios};
use epas_reference::kinematics::{self as exact, KinematicsInput, Revised};
use pyo3::prelude::*;

use crate::arrays::Arguments;
use crate::blocks::Real;
use crate::errors::Refused;
use crate::kept::Kept;
use crate::numbers::{arguments, within};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Gives a macro the arguments in their order; the speed stands apart.
macro_rules! with_arguments {
    ($macro:ident $($more:tt)*) => {
        $macro! {
            [
                ball_diameter pitch_radius lead_angle groove_radius_screw groove_radius_nut contact_angle_screw contact_angle_nut
                pitch_angle yaw_angle rolling_radius_screw rolling_radius_nut
            ]
            speed
            [semi_major_screw semi_minor_screw semi_major_nut semi_minor_nut]
            $($more)*
        }
    };
}

const SPEED: usize = 11;

/// Largest speed of the screw, rad/s.
const LARGEST_SPEED: f64 = 1e6;

/// Motion of the ball, then slip at the screw and at the nut.
const QUANTITIES: usize = 18;

/// Slip of one contact in the order of `results.ContactSlip`; no direction where nothing slides.
fn slip(slip: &ContactSlip, ratios: &SlipRatios) -> [f32; 8] {
    let slides = ratios.slide_to_roll > 0.0;
    [
        slip.rolling_slip,
        slip.side_slip,
        slip.spin,
        slip.entrainment_speed,
        ratios.entrainment_angle,
        ratios.slide_to_roll,
        if slides { ratios.slide_angle } else { f32::NAN },
        ratios.spin_to_roll,
    ]
}

/// The same of the reference.
fn exact_slip(contact: &exact::ContactKinematics) -> [f64; 8] {
    [
        contact.rolling_slip,
        contact.side_slip,
        contact.spin,
        contact.entrainment_speed,
        contact.entrainment_angle,
        contact.slide_to_roll,
        contact.slide_angle.unwrap_or(f64::NAN),
        contact.spin_to_roll,
    ]
}

/// Everything in one list.
fn together<T: Copy>(ball: [T; 2], screw: [T; 8], nut: [T; 8]) -> [T; QUANTITIES] {
    std::array::from_fn(|place| match place {
        0 | 1 => ball[place],
        2..10 => screw[place - 2],
        _ => nut[place - 10],
    })
}

macro_rules! inputs {
    ([$($before:ident)*] $speed:ident [$($after:ident)*]) => {
        const NAMES: [&str; 16] = [$(stringify!($before),)* stringify!($speed), $(stringify!($after)),*];

        /// Numbers in their order as the crate takes them.
        fn parameters(numbers: [f32; 16]) -> KinematicsParameters {
            let [$($before,)* _, $($after),*] = numbers;
            KinematicsParameters { $($before,)* $($after),* }
        }

        /// The same as the reference takes them.
        fn input(numbers: [f64; 16]) -> KinematicsInput {
            let [$($before,)* $speed, $($after),*] = numbers;
            KinematicsInput { $($before,)* $speed, $($after),* }
        }
    };
}

with_arguments!(inputs);

/// Runs a kernel over the arguments, and names what it gives.
fn evaluate<'py, T: Real>(
    py: Python<'py>,
    arguments: Arguments<'py, 16>,
    kernel: impl FnMut([T; 16]) -> Result<[T; QUANTITIES], Refused> + Send,
) -> PyResult<Any<'py>> {
    let arrays = arguments.map(py, kernel)?.arrays(py)?;
    let contact = |start: usize| {
        let part = pyo3::types::PyTuple::new(py, &arrays[start..start + 8])?;
        result(py, "ContactSlip", part)
    };
    let fields = (&arrays[0], &arrays[1], contact(2)?, contact(10)?);
    result(py, "ContactKinematics", fields)
}

/// A function of Python over these arguments, in single or in double precision.
macro_rules! function {
    ([$($before:ident)*] $speed:ident [$($after:ident)*] $name:ident, $summary:literal, $float:literal, $computed:path) => {
        #[doc = $summary]
        ///
        /// Args:
        ///     ball_diameter: m.
        ///     pitch_radius: m.
        ///     lead_angle: rad.
        ///     groove_radius_screw: m.
        ///     groove_radius_nut: m.
        ///     contact_angle_screw: rad.
        ///     contact_angle_nut: rad.
        ///     pitch_angle: of the ball's own axis, rad.
        ///     yaw_angle: of the ball's own axis, rad.
        ///     rolling_radius_screw: radius of the deformed contact, m.
        ///     rolling_radius_nut: the same at the nut, m.
        ///     speed: of the screw, rad/s, -1e6 to 1e6.
        ///     semi_major_screw: of the contact ellipse, m.
        ///     semi_minor_screw: m.
        ///     semi_major_nut: m.
        ///     semi_minor_nut: m.
        ///
        /// Returns:
        #[doc = concat!("    ContactKinematics: ", $float, " arrays of the broadcast shape.")]
        ///
        /// Raises:
        ///     Error: a value out of its range, with its place in the arrays.
        #[pyfunction]
        #[pyo3(signature = (*, $($before,)* $speed, $($after),*))]
        pub fn $name<'py>(py: Python<'py>, $($before: Any<'py>,)* $speed: Any<'py>, $($after: Any<'py>),*) -> PyResult<Any<'py>> {
            let values = [$(&$before,)* &$speed, $(&$after),*];
            $computed(py, arguments(py, NAMES, values)?)
        }
    };
}

with_arguments!(
    function contact_kinematics,
    "Motion of a ball, and slip, spin and entrainment at the centres of its two contacts.",
    "float32",
    single
);
with_arguments!(
    function reference_contact_kinematics,
    "Motion of a ball, and slip, spin and entrainment at the centres of its two contacts, in float64.",
    "float64",
    double
);

/// As the control interrupt computes it.
fn single<'py>(py: Python<'py>, arguments: Arguments<'py, 16>) -> PyResult<Any<'py>> {
    let mut kept = Kept::NONE;
    evaluate(py, arguments, move |numbers: [f32; 16]| {
        let speed = numbers[SPEED];
        within("speed", speed.into(), -LARGEST_SPEED, LARGEST_SPEED)?;
        let mut constants = numbers;
        constants[SPEED] = 0.0;
        let model = kept.get(constants, || ContactKinematics::new(&parameters(numbers)))?;
        let ball = model.tick(speed);
        Ok(together(
            [ball.orbital_speed, ball.spin_speed],
            slip(&ball.screw, &model.screw().ratios()),
            slip(&ball.nut, &model.nut().ratios()),
        ))
    })
}

/// By the reference.
fn double<'py>(py: Python<'py>, arguments: Arguments<'py, 16>) -> PyResult<Any<'py>> {
    evaluate(py, arguments, |numbers: [f64; 16]| {
        let speed = numbers[SPEED];
        within("speed", speed, -LARGEST_SPEED, LARGEST_SPEED)?;
        let ball = Revised::new(&input(numbers))?.evaluate();
        Ok(together(
            [ball.orbital_speed, ball.spin_speed],
            exact_slip(&ball.screw),
            exact_slip(&ball.nut),
        ))
    })
}
