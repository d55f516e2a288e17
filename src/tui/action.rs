//! Everything a key can mean.

/// A named action. Keys, palette and help refer to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is described once, by its row of the key map")]
pub enum Action {
    Help,
    Command,
    Jump,
    JumpAgain,
    CommandLine,
    Mouse,
    NextPanel,
    PreviousPanel,
    Panel(Panel),
    Maximise,
    Undo,
    Redo,
    Save,
    Export,
    Open,
    SaveAs,
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
    FilteredTrack,
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
    AdoptConsensus,
    Detectability,
    NextChannel,
    Channels,
    Overview,
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
    SuggestedChecks,
    Checks,
    ExcludeDecided,
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

impl Action {
    /// Its name in the palette and in the configuration, from that of the variant: `next-flag`, `panel-trace`.
    #[must_use]
    pub fn name(self) -> String {
        let mut name = String::new();
        for c in format!("{self:?}").chars() {
            match c {
                '(' | ')' => {}
                c if c.is_uppercase() => {
                    name.push_str(if name.is_empty() { "" } else { "-" });
                    name.extend(c.to_lowercase());
                }
                c => name.push(c),
            }
        }
        name
    }

    /// True when it can change a result, write a file or end the program: it is bound to no key that a torn escape
    /// sequence can press.
    #[must_use]
    pub fn changes_result(self) -> bool {
        use Action as A;
        matches!(
            self,
            A::Undo
                | A::StepUp
                | A::StepDown
                | A::StepUpFar
                | A::StepDownFar
                | A::DefaultValue
                | A::Preset
                | A::Suggested
                | A::SuggestedChecks
                | A::Checks
                | A::ExcludeDecided
                | A::Accept
                | A::Reject
                | A::Toggle
                | A::Clear
                | A::ByHand
                | A::AcceptView
                | A::AdoptPinned
                | A::AdoptConsensus
                | A::RejectView
                | A::ClearView
                | A::Epoch
                | A::SettingsToAll
                | A::Save
                | A::Export
                | A::Quit
        )
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_words_with_hyphens() {
        let names = [Action::NextFlag, Action::YFit, Action::Undo, Action::Panel(Panel::Trace)].map(Action::name);
        assert_eq!(names, ["next-flag", "y-fit", "undo", "panel-trace"]);
    }
}
