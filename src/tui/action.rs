//! Everything a key can mean.

/// A named action. Keys, palette and help refer to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is described once, by its row of the key map")]
pub enum Action {
    Help,
    Command,
    Jump,
    NextPanel,
    PreviousPanel,
    Panel(Panel),
    Maximise,
    Undo,
    Redo,
    Save,
    Export,
    Quit,
    Interrupt,
    Redraw,
    Suspend,
    Back,
    PanLeft,
    PanRight,
    PanLeftFar,
    PanRightFar,
    ZoomIn,
    ZoomOut,
    FitAll,
    ZoomFlag,
    PreviousView,
    NextSample,
    PreviousSample,
    First,
    Last,
    YFit,
    Layers,
    BeforeAfter,
    XAxis,
    NextLower,
    LogScale,
    Second,
    Pin,
    NextDifference,
    PreviousDifference,
    AdoptPinned,
    Consensus,
    NextAgreed,
    NextChannel,
    Channels,
    Methods,
    Repairs,
    StepUp,
    StepDown,
    StepUpFar,
    StepDownFar,
    NextKnob,
    PreviousKnob,
    TypeValue,
    DefaultValue,
    Preset,
    Suggested,
    NextFlag,
    PreviousFlag,
    NextUnreviewed,
    PreviousUnreviewed,
    NextSuspect,
    PreviousSuspect,
    NextInQueue,
    PreviousInQueue,
    NextConflict,
    PreviousConflict,
    Unit,
    AutoAdvance,
    Journal,
    SettingsToAll,
    Epoch,
    SelectRange,
    Accept,
    Reject,
    Toggle,
    Clear,
    ByHand,
    Note,
    Sort,
    AcceptView,
    RejectView,
    ClearView,
}

/// A part of the screen that can have the focus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Panel {
    /// The curve.
    Trace,
    /// The residuals.
    Residual,
    /// Method and parameters.
    Parameters,
    /// The list of flags.
    Queue,
    /// The card of the current flag.
    Card,
}

impl Panel {
    /// All of them, in the order of `Tab` and of the digits 1 to 5.
    pub const ALL: [Self; 5] = [Self::Trace, Self::Residual, Self::Parameters, Self::Queue, Self::Card];

    /// Its name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Trace => "trace",
            Self::Residual => "residual",
            Self::Parameters => "method & parameters",
            Self::Queue => "queue",
            Self::Card => "flag",
        }
    }

    /// Its digit, from 1.
    #[must_use]
    pub fn digit(self) -> usize {
        Self::ALL.iter().position(|p| *p == self).unwrap_or(0) + 1
    }
}
