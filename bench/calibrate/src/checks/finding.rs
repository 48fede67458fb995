//! What a trace does not tell, or tells badly.

/// Kind of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FindingKind {
    /// There is no load.
    NoLoad,
    /// The load hardly changes: friction coefficient and load-free drag are one number.
    ConstantLoad,
    /// There is no temperature, or it hardly changes.
    ConstantTemperature,
    /// The speed hardly changes its size: neither viscous drag nor a Stribeck curve is seen.
    ConstantSpeed,
    /// The acceleration hardly does anything: the inertia is not seen.
    NoAcceleration,
    /// The motion goes one way only: friction and offset are one number.
    OneDirection,
    /// Few reversals: the behaviour between sliding one way and the other is seen badly.
    FewReversals,
    /// The motion is never slow enough to show what happens before sliding.
    CoarsePosition,
    /// Some of the effort stands at its limit.
    ClippedEffort,
    /// The effort is early or late against the motion, by less than is refused.
    ShiftedEffort,
    /// A shift between effort and motion would not be seen.
    ClockUnchecked,
    /// Neither signs nor clocks can be checked: the motion hardly slides.
    SignUnchecked,
    /// The measured speed is early or late against the position, and is not used.
    ShiftedSpeed,
    /// Much of the effort goes with nothing that is in the trace.
    Unexplained,
    /// A channel never changes, and is not used.
    DeadChannel,
    /// Samples that no mechanism makes were left out.
    LeftOut,
    /// The trace rests for some of its time.
    Rests,
    /// Samples were repaired.
    Repaired,
    /// Columns of the file were left aside.
    IgnoredColumns,
}

/// What limits what a trace can tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Kind.
    pub kind: FindingKind,
    /// The figure that it was found by: a share, a count, a delay in ticks.
    pub figure: f64,
    /// A sentence.
    pub message: String,
}

impl Finding {
    /// A finding.
    pub fn new(kind: FindingKind, figure: f64, message: impl Into<String>) -> Self {
        Self {
            kind,
            figure,
            message: message.into(),
        }
    }
}
