#![no_std]
#![doc = include_str!("../README.md")]
//!
//! # Conventions
//!
//! SI units and radians everywhere; a field's documentation names its unit and range. Angles: lead
//! angle `alpha`, contact angle `beta` or `phi` from the plane normal to the axis. The normal of a
//! groove points into its metal. A right-hand thread; the load is positive where it opposes the travel
//! that a positive nut speed makes.
//!
//! # Where things are
//!
//! | module | what |
//! |---|---|
//! | [`math`] | square root, cube root, sine and cosine |
//! | [`material`] | elastic constants |
//! | [`geometry`] | validated designs, built-in sizes |
//! | [`curvature`] | groove curvature: literature, circular groove, fitted, exact |
//! | [`hertz`] | contact ellipse, deflection, pressure |
//! | [`efficiency`] | closed-form efficiency, self-locking, optimum, design procedure |
//! | [`kinematics`] | rolling, side and spin slip of a contact, their ratios and friction power |
//! | [`contact`] | force, moment and power of one contact with slip and spin |
//! | [`ball`] | one ball in a linear or rotary four-point bearing: speed deviation, compliance, loss |
//! | [`scene`] | what a mechanism needs and what it leaves out |
//! | [`model`] | configured once, stepped in the interrupt |
//! | [`promises`] | domain, errors, behaviour outside and cost of every function, in one table |
//! | `hal` | adapters for `embedded-hal`: nut speed from an encoder, friction torque to a duty cycle |
//!
//! Everything is set up once, with errors that name the field, its value and the allowed range; from
//! then on nothing returns a `Result`, nothing panics, and every output is finite and flagged.

pub mod ball;
pub mod contact;
pub mod curvature;
pub mod efficiency;
pub mod error;
pub mod geometry;
#[cfg(feature = "embedded-hal")]
pub mod hal;
pub mod hertz;
pub mod kinematics;
pub mod material;
pub mod math;
pub mod model;
pub mod promises;
pub mod scene;
pub mod train;

pub use ball::{
    AnalyticLinearBall, BallChain, BallMotion, BallState, ContactMotion, FourPointBall,
    FourPointContacts, GrooveFit, LinearBallParameters, LoadShare, PUBLISHED_SLOPE, RotaryBall,
    RotaryBallParameters, RotaryMotion, ScrewBall, ScrewBallLoop, ScrewBallMotion, ScrewBallState,
    ScrewChain, ScrewContactMotion, ScrewContacts, ScrewRow, ScrewTick, SlipFriction, SlipMap,
    SpeedDeviation,
};
pub use contact::{Dissipation, FrictionMap, NormalizedFriction};
pub use curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature, PrincipalCurvatures,
    RelativeCurvatures,
};
pub use efficiency::{
    DesignFigures, DesignRequest, Drive, Duty, DynamicCorrection, EfficiencyGeometry,
    OptimumContactAngle, optimum_contact_angle, optimum_efficiency,
};
pub use error::{Error, Range};
pub use geometry::{
    BallBearing, BallBearingParameters, BallScrew, BallScrewParameters, CATALOGUE, CatalogueSize,
    ContactAngle, DISSERTATION_DESIGNS, Groove, GrooveProfile, GrooveSize, HelixPath,
    LinearBearing, LinearBearingParameters, NamedDesign,
};
#[cfg(feature = "embedded-hal")]
pub use hal::{
    AppliedDuty, Diagnostics, EncoderConfiguration, EncoderError, FaultReaction,
    FeedForwardConfiguration, FrictionFeedForward, MagneticEncoder, NutMotion, SensorErrors,
};
pub use hertz::{ContactEllipse, HertzContact};
pub use kinematics::{
    BallKinematics, ContactKinematics, ContactSlip, EllipticContact, FrictionPower,
    KinematicsParameters, PitchMethod, SlipRatios, SlipVector, TraditionalKinematics,
};
pub use material::{Material, contact_modulus};
pub use model::FrictionModel;
pub use scene::{
    CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, DeviationMap, Faults,
    FrictionBranch, Harmonic, Inputs, Limits, LinearBearingConfiguration, LinearBearingTrain,
    LinearConstants, LinearInputs, LinearLimits, Outputs, Regime, Scene, TrainOutputs,
    UncagedBallScrew, UncagedBallScrewConfiguration, UncagedConstants,
};
pub use train::{BallContact, Press, Train};
