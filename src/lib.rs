#![no_std]
//! Friction of the ball screw of an electric power steering, inside the control interrupt: how much, and why.
//!
//! `no_std`, f32, fixed-size state, bounded time, no panic. [`FrictionModel`] with a scene is what firmware steps:
//!
//! | scene | what | outputs |
//! |---|---|---|
//! | [`CagedBallScrew`] | a ball screw whose balls do not touch, by a block of constants from a host | torque, efficiency |
//! | [`ClosedFormScrew`] | the same by the closed forms of the papers | torque, efficiency |
//! | [`LoadProportionalScrew`] | any drive, by the friction and the losses that a trace without a design identifies | torque, efficiency |
//! | [`UncagedBallScrew`] | a ball screw whose balls press on each other, by a block of constants from a host | torques of grooves and balls, forces between balls |
//! | [`LinearBearingTrain`] | a linear bearing whose balls press on each other | forces |
//! | [`scene::WithMemory`] | any of them but `LoadProportionalScrew`, with friction that remembers | the same, and between two steps |
//!
//! # Conventions
//!
//! SI units and radians everywhere; a field's documentation names its unit and range. Angles: lead angle `alpha`, contact angle `beta` from the plane
//! normal to the axis. The normal of a groove points into its metal. A right-hand thread; the load is positive where it opposes the travel that a
//! positive nut speed makes.
//!
//! # Where things are, and where they run
//!
//! In the order of use: a module imports only from those above it. "Step": the control interrupt runs it; "set-up": once, or in the compiler; "around
//! ignition": firmware calls it outside the interrupt; "direct": no scene links it.
//!
//! | module | what | runs in |
//! |---|---|---|
//! | [`error`] | field, value and allowed range of what was refused | set-up |
//! | [`ranges`] | one range for one quantity: friction coefficient, load, radii | set-up |
//! | [`stored`] | state as bytes: layout, checksum, reasons to refuse a block | around ignition |
//! | [`math`] | square root, cube root, sine and cosine; elliptic integrals and arcsine | step; set-up |
//! | [`material`] | elastic constants | set-up |
//! | [`geometry`] | validated designs, built-in sizes | set-up |
//! | [`curvature`] | groove curvature: literature, circular groove, fitted, exact | set-up (the exact one); direct |
//! | [`hertz`] | contact ellipse, deflection, pressure | set-up; direct |
//! | [`contact`] | friction of one contact: along the track, across it, in any direction; rolling resistance | set-up; direct |
//! | [`train`] | a row of balls that push each other: free speeds and impedances in, forces and moves out | step of both trains |
//! | [`ball`] | one ball between its grooves: by a folded law in a ball screw, in closed form in a linear bearing | step of all scenes |
//! | [`efficiency`] | closed-form efficiency, self-locking | set-up of the scene by closed forms; direct |
//! | [`kinematics`] | rolling, side and spin slip of a contact, and their ratios | direct |
//! | [`law`] | friction that remembers; friction coefficient by speed and temperature | step of scenes with memory; direct |
//! | [`defaults`] | friction coefficient, clearance, rolling resistance and lubricant where nothing is measured | set-up |
//! | [`scene`] | what a mechanism needs and what it leaves out | step |
//! | [`model`] | [`FrictionModel`]: check inputs, compute, limit, count | step |
//! | [`adaptation`] | level of the friction, drag and sensor errors, found while the vehicle runs; health | beside the step |
//! | `hal` | adapters for `embedded-hal`: nut speed from an encoder, friction torque to a duty cycle | beside the step |
//!
//! Everything is set up once, with errors that name the field, its value and the allowed range; from
//! then on nothing returns a `Result`, nothing panics, and every output is finite and flagged.
//!
#![doc = include_str!("firmware.md")]
//!
#![doc = include_str!("nomenclature.md")]
//!
#![doc = include_str!("equations.md")]
// Symbols of the papers are no code.
#![allow(clippy::doc_markdown)]
// Every error names its field, the value and the allowed range.
#![allow(clippy::missing_errors_doc)]
// None over 60: see `.clippy.toml`.
#![warn(clippy::too_many_lines)]

/// The README's examples are compiled as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod adaptation;
pub mod ball;
pub mod contact;
pub mod curvature;
pub mod defaults;
pub mod efficiency;
pub mod error;
pub mod geometry;
#[cfg(feature = "embedded-hal")]
pub mod hal;
pub mod hertz;
pub mod kinematics;
pub mod law;
pub mod material;
pub mod math;
pub mod model;
pub mod ranges;
pub mod scene;
pub mod stored;
pub mod train;

pub use ball::{Clearance, LoadShare, LoadShares};
pub use contact::RollingResistance;
pub use error::{Error, Range};
pub use geometry::{
    BallScrew, BallScrewParameters, CATALOGUE, CatalogueSize, DISSERTATION_DESIGNS, GrooveSize,
    LinearBearing, LinearBearingParameters, NamedDesign,
};
pub use material::Material;
pub use model::FrictionModel;
pub use scene::{
    CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, CagedState, ClosedFormScrew,
    ClosedFormScrewConfiguration, ClosedFormScrewConstants, DeviationMap, Faults, FrictionBranch,
    Harmonic, Inputs, Limits, LinearBearingConfiguration, LinearBearingTrain, LinearConstants,
    LinearInputs, LinearLimits, LinearOutputs, LoadProportionalConfiguration,
    LoadProportionalConstants, LoadProportionalScrew, Outputs, Regime, Scene, UncagedBallScrew,
    UncagedBallScrewConfiguration, UncagedConstants, UncagedOutputs,
};
pub use stored::Refusal;
