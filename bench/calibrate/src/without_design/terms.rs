//! What stands beside the law of friction in a model of a trace without a design.

/// What stands beside the law of friction.
// Each is a term that may be left out.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// Drag that differs between the directions.
    pub drag_of_each_direction: bool,
    /// Effort that grows with the position, as of a cable chain, and friction that does.
    pub position: bool,
    /// Period of a deviation along the way, rad or m.
    pub period: Option<f64>,
    /// What the load does.
    pub load: LoadTerm,
    /// Delay between the effort as it is written down and as it acts.
    pub delay: bool,
    /// Whether the trace moves at one speed: drag and level are one number.
    pub one_speed: bool,
}

/// What the load does. Where friction passes through zero, so does the loss: it is a part of the friction `T` of unit level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadTerm {
    /// There is none.
    #[default]
    None,
    /// An effort with a gain of its own.
    Gain,
    /// An effort with a gain of its own, and a loss in proportion to it that is the same for driving and back-driving.
    ///
    /// Driving takes `gain (1 + loss)` of the load, back-driving `gain (1 - loss)`: two numbers, of which a gain that is not known leaves
    /// one for the loss.
    LossAlike,
    /// The effort that the load is, with losses in proportion to it where the trace tells them.
    Losses {
        /// Whether the loss of driving is told.
        driving: bool,
        /// Whether the loss of back-driving is told.
        back_driving: bool,
    },
}

impl LoadTerm {
    /// The effort that the load is, without a loss.
    pub const GIVEN: Self = Self::Losses {
        driving: false,
        back_driving: false,
    };

    /// Whether the load's effort has a gain of its own.
    pub const fn has_gain(self) -> bool {
        matches!(self, Self::Gain | Self::LossAlike)
    }

    /// Which losses have a number: driving, back-driving.
    pub const fn losses(self) -> [bool; 2] {
        match self {
            Self::Losses {
                driving,
                back_driving,
            } => [driving, back_driving],
            Self::None | Self::Gain | Self::LossAlike => [false, false],
        }
    }

    /// Whether there is a loss at all.
    pub const fn loses(self) -> bool {
        let [driving, back_driving] = self.losses();
        driving || back_driving || matches!(self, Self::LossAlike)
    }

    /// The same load without its losses.
    #[must_use]
    pub const fn without_losses(self) -> Self {
        match self {
            Self::None => Self::None,
            Self::Gain | Self::LossAlike => Self::Gain,
            Self::Losses { .. } => Self::GIVEN,
        }
    }
}
