//! The key map: one table from which the dispatcher, the palette, the help, the footer and the README are made.
//! What holds is [`Keys`]: the table with what the user's configuration puts in its place.
//!
//! Characters that can leak from an escape sequence torn apart on a slow line
//! (`[ O < ; ? ~ 0-9 A B C D F H I M P Q R S Z m`) are bound to actions that change no result; a test holds the
//! table to that.

use std::fmt::Write as _;

use super::action::{Action, Panel};

mod in_force;
mod name;

pub use in_force::{Bound, Keys, Meaning};
pub use name::{parsed, shown};

/// Where a binding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Context {
    /// Everywhere.
    Everywhere,
    /// Everywhere but in the panels that use the key themselves.
    View,
    /// Everywhere; it is about the current flag.
    Review,
    /// In the parameter panel.
    Parameters,
    /// In the queue.
    Queue,
}

impl Context {
    /// All of them, in the order of the help.
    pub const ALL: [Self; 5] = [Self::Everywhere, Self::View, Self::Review, Self::Parameters, Self::Queue];

    /// Its heading in the help.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Self::Everywhere => "everywhere",
            Self::View => "view",
            Self::Review => "review",
            Self::Parameters => "parameters (3)",
            Self::Queue => "queue (4)",
        }
    }

    /// The context that belongs to a panel with the keyboard, whose rows go first; none for panels without keys of
    /// their own.
    #[must_use]
    pub fn of(panel: Panel) -> Option<Self> {
        match panel {
            Panel::Parameters => Some(Self::Parameters),
            Panel::Queue => Some(Self::Queue),
            Panel::Trace | Panel::Residual | Panel::Card => None,
        }
    }

    /// True for the context of one panel, false for those that hold wherever the panel says nothing else.
    #[must_use]
    pub fn is_own(self) -> bool {
        Panel::ALL.into_iter().any(|panel| Self::of(panel) == Some(self))
    }

    /// Its word in the configuration: the first of its heading.
    #[must_use]
    pub fn word(self) -> &'static str {
        self.heading().split(' ').next().unwrap_or_default()
    }
}

/// One row of the key map.
#[derive(Debug)]
pub struct Binding {
    /// Where it holds.
    pub context: Context,
    /// The keys, each enough by itself; `g a` is one after the other.
    pub keys: &'static [&'static str],
    /// What they do.
    pub action: Action,
    /// What that is, in a few words.
    pub help: &'static str,
    /// One word for the footer; empty when it is not shown there.
    pub short: &'static str,
}

const fn row(
    context: Context,
    keys: &'static [&'static str],
    action: Action,
    help: &'static str,
    short: &'static str,
) -> Binding {
    Binding { context, keys, action, help, short }
}

/// The key map. Within a context, rows come in the order of help and footer.
pub static KEYMAP: &[Binding] = {
    use Action as A;
    use Context::{Everywhere, Parameters, Queue, Review, View};
    &[
        row(Review, &["n"], A::NextFlag, "next flag (keeps the zoom; g n for suspects)", "next"),
        row(Review, &["p"], A::PreviousFlag, "previous flag", "previous"),
        row(Review, &["N"], A::NextUnreviewed, "next undecided flag", ""),
        row(Review, &["P"], A::PreviousUnreviewed, "previous undecided flag", ""),
        row(Review, &["a"], A::Accept, "accept the flag (the sample is an outlier), go to the next", "accept"),
        row(Review, &["r"], A::Reject, "reject the flag (the sample is good), go to the next", "reject"),
        row(Review, &["space"], A::Toggle, "toggle between accepted and rejected", "toggle"),
        row(Review, &["x"], A::Clear, "clear the decision", ""),
        row(Review, &["v"], A::SelectRange, "select a range: move, then a, r, x, space or o; Esc leaves", "range"),
        row(Review, &["o"], A::ByHand, "flag the sample under the cursor by hand", "flag"),
        row(Review, &["c"], A::Note, "write a note on the decision, with a reason from a list", ""),
        row(Review, &["g a"], A::AcceptView, "accept all flags in view except suspects (one undo step)", ""),
        row(Review, &["g r"], A::RejectView, "reject all flags in view", ""),
        row(Review, &["g x"], A::ClearView, "clear all decisions in view", ""),
        row(Review, &["g n"], A::NextSuspect, "next suspect (only one direction objects)", ""),
        row(Review, &["g p"], A::PreviousSuspect, "previous suspect", ""),
        row(Review, &["g c"], A::NextConflict, "next conflict (the decision contradicts the method)", ""),
        row(Review, &["g C"], A::PreviousConflict, "previous conflict", ""),
        row(Review, &["g e"], A::Epoch, "decide on the epoch: the same row in all channels", ""),
        row(Review, &["K"], A::Unit, "review run by run, or sample by sample", ""),
        row(Review, &["g ."], A::AutoAdvance, "auto-advance to the next flag after a decision, on or off", ""),
        row(Review, &["s"], A::Sort, "sort the queue by time, ratio, state or run", ""),
        row(Review, &["J"], A::Journal, "history of all edits; enter goes back to one", ""),
        row(Everywhere, &["u"], A::Undo, "undo", "undo"),
        row(Everywhere, &["U", "ctrl-r"], A::Redo, "redo", ""),
        row(View, &["+", "="], A::ZoomIn, "zoom in at the cursor", "zoom"),
        row(View, &["-"], A::ZoomOut, "zoom out", ""),
        row(View, &["left", "h"], A::PanLeft, "pan left by a tenth", ""),
        row(View, &["right", "l"], A::PanRight, "pan right by a tenth", ""),
        row(View, &["shift-left", "pageup"], A::PanLeftFar, "pan left by half", ""),
        row(View, &["shift-right", "pagedown"], A::PanRightFar, "pan right by half", ""),
        row(View, &["0"], A::FitAll, "show the whole record", "all"),
        row(View, &["z"], A::ZoomFlag, "zoom to the current flag and its run", ""),
        row(View, &["Z"], A::PreviousView, "back to the previous view", ""),
        row(View, &["down", "j"], A::NextSample, "cursor to the next sample (or column)", ""),
        row(View, &["up", "k"], A::PreviousSample, "cursor to the previous sample (or column)", ""),
        row(View, &["home", "g g"], A::First, "cursor to the first sample", ""),
        row(View, &["end", "G"], A::Last, "cursor to the last sample", ""),
        row(View, &["y"], A::YFit, "vertical range: kept samples, all, robust, fixed (:y LOW HIGH)", ""),
        row(View, &["X"], A::XAxis, "x axis: time or sample number", ""),
        row(View, &["R"], A::NextLower, "plot below the trace: residual, histogram, time steps", ""),
        row(View, &["L"], A::LogScale, "logarithmic scale of the residual or the counts", ""),
        row(View, &["C"], A::Consensus, "run all methods: how many flag each sample", ""),
        row(View, &["g h"], A::NextAgreed, "next sample that a majority of the methods flags", ""),
        row(View, &["g v"], A::AdoptConsensus, "flag what a majority of the methods flags (one undo step)", ""),
        row(View, &["g m"], A::Detectability, "detectability: how small a wild point these settings find", ""),
        row(View, &["B"], A::Pin, "pin the result as A and continue with B, or unpin it", ""),
        row(View, &["g d"], A::NextDifference, "next difference between A and B", ""),
        row(View, &["g D"], A::PreviousDifference, "previous difference between A and B", ""),
        row(View, &["g b"], A::AdoptPinned, "back to the settings of A (one undo step)", ""),
        row(View, &["V"], A::Second, "second channel beside this one (160 columns or more)", ""),
        row(View, &["t"], A::Layers, "layers: all, no band, curve only (:layers -raw)", ""),
        row(View, &["T"], A::FilteredTrack, "filtered track: show what the method's model makes of the samples", ""),
        row(View, &["b"], A::BeforeAfter, "before and after repair", ""),
        row(View, &["d"], A::NextChannel, "next channel", "channel"),
        row(View, &["D"], A::Channels, "choose a channel from a list", ""),
        row(View, &["g o"], A::Overview, "overview of all channels: flags, state; to accept, copy settings, sort", ""),
        row(View, &["m"], A::Methods, "choose a method", "method"),
        row(View, &["e"], A::Repairs, "choose a repair", ""),
        row(View, &[","], A::StepDown, "active parameter one step down", "step"),
        row(View, &["."], A::StepUp, "active parameter one step up", ""),
        row(View, &[";"], A::NextKnob, "make the next parameter the active one", ""),
        row(View, &["f"], A::Suggested, "use the threshold suggested for this record", ""),
        row(View, &["g f"], A::SuggestedChecks, "add the checks and the period suggested for this record", ""),
        row(View, &["g k"], A::Checks, "switch all checks before the method off or on", ""),
        row(View, &["g t"], A::ExcludeDecided, "exclude accepted outliers from the method, on or off", ""),
        row(View, &["g s"], A::SettingsToAll, "copy the settings to all channels (method, parameters, repair)", ""),
        row(View, &["i"], A::Preset, "all parameters to the paper's values, or to the defaults", ""),
        row(Parameters, &["down", "j"], A::NextKnob, "next parameter", "choose"),
        row(Parameters, &["up", "k"], A::PreviousKnob, "previous parameter", ""),
        row(Parameters, &["right", "l"], A::StepUp, "one step up", "step"),
        row(Parameters, &["left", "h"], A::StepDown, "one step down", ""),
        row(Parameters, &["shift-right", "pagedown"], A::StepUpFar, "ten steps up", ""),
        row(Parameters, &["shift-left", "pageup"], A::StepDownFar, "ten steps down", ""),
        row(Parameters, &["enter"], A::TypeValue, "type a value", "type"),
        row(Parameters, &["backspace"], A::DefaultValue, "back to the default", "default"),
        row(Queue, &["down", "j"], A::NextInQueue, "next flag or suspect", "next"),
        row(Queue, &["up", "k"], A::PreviousInQueue, "previous flag or suspect", ""),
        row(Queue, &["enter"], A::ZoomFlag, "zoom to the flag", "zoom to it"),
        row(Everywhere, &["/"], A::Jump, "jump: a time, #row, +5s, y>8, state:suspect, a note", ""),
        row(Everywhere, &["\""], A::JumpAgain, "repeat the jump: the next match", ""),
        row(Everywhere, &["tab"], A::NextPanel, "focus the next panel", ""),
        row(Everywhere, &["backtab"], A::PreviousPanel, "focus the previous panel", ""),
        row(Everywhere, &["1"], A::Panel(Panel::Trace), "focus the trace", ""),
        row(Everywhere, &["2"], A::Panel(Panel::Residual), "focus the plot below the trace (R chooses it)", ""),
        row(Everywhere, &["3"], A::Panel(Panel::Parameters), "focus the parameters", ""),
        row(Everywhere, &["4"], A::Panel(Panel::Queue), "focus the queue", ""),
        row(Everywhere, &["5"], A::Panel(Panel::Card), "focus the card", ""),
        row(Everywhere, &["w"], A::Maximise, "maximise the focused panel, or restore it", ""),
        row(Everywhere, &["ctrl-s"], A::Save, "save the session (:w NAME to choose where)", "save"),
        row(Everywhere, &["ctrl-e"], A::Export, "write files: cleaned, flags, report, session", ""),
        row(Everywhere, &["ctrl-o"], A::Open, "open a record or a session (Tab: how to load it)", ""),
        row(Everywhere, &["W"], A::SaveAs, "save the session under another name", ""),
        row(Everywhere, &[":"], A::Command, "type a command", "command"),
        row(Everywhere, &["Y"], A::CommandLine, "copy the equivalent command", ""),
        row(Everywhere, &["M"], A::Mouse, "give the mouse to the terminal, or back to wildpoint", ""),
        row(Everywhere, &["?"], A::Help, "this help", "help"),
        row(Everywhere, &["q"], A::Quit, "quit; asks if there are unsaved changes", "quit"),
        row(Everywhere, &["esc"], A::Back, "go back one level", ""),
        row(Everywhere, &["ctrl-c"], A::Interrupt, "stop the running computation; again: quit", ""),
        row(Everywhere, &["ctrl-l"], A::Redraw, "draw the screen again", ""),
        row(Everywhere, &["ctrl-z"], A::Suspend, "suspend", ""),
    ]
};

/// Characters that can leak from an escape sequence torn apart on a slow line.
const TORN: &str = "[O<;?~0123456789ABCDFHIMPQRSZm";

/// True for a key that such a sequence can press: it must change no result.
#[must_use]
pub fn hazardous(key: &str) -> bool {
    key.chars().count() == 1 && key.chars().all(|c| TORN.contains(c))
}

/// The key table of the README.
#[must_use]
pub fn markdown() -> String {
    let mut out = String::from("| where | keys | what |\n|---|---|---|\n");
    for context in Context::ALL {
        for binding in KEYMAP.iter().filter(|b| b.context == context) {
            let keys: Vec<String> = binding.keys.iter().map(|k| format!("`{}`", shown(k))).collect();
            let _ = writeln!(out, "| {} | {} | {} |", context.heading(), keys.join(" "), binding.help);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for (i, a) in KEYMAP.iter().enumerate() {
            for b in &KEYMAP[i + 1..] {
                if a.context == b.context || (!a.context.is_own() && !b.context.is_own()) {
                    assert!(a.keys.iter().all(|k| !b.keys.contains(k)), "{:?} and {:?} share a key", a.keys, b.keys);
                }
            }
        }
    }

    #[test]
    fn every_key_of_the_table_is_written_as_the_configuration_would_have_it() {
        for key in KEYMAP.iter().flat_map(|b| b.keys) {
            assert_eq!(parsed(key).as_deref(), Ok(*key));
        }
    }

    #[test]
    fn an_action_has_one_row_in_a_context() {
        for (i, a) in KEYMAP.iter().enumerate() {
            assert!(KEYMAP[i + 1..].iter().all(|b| (a.context, a.action) != (b.context, b.action)), "{:?}", a.action);
        }
    }

    #[test]
    fn characters_of_torn_escape_sequences_change_no_result() {
        for binding in KEYMAP {
            for key in binding.keys {
                assert!(!hazardous(key) || !binding.action.changes_result(), "{key} does {:?}", binding.action);
            }
        }
        // The rule can fail.
        assert!(hazardous("C") && !hazardous("ctrl-c") && !hazardous("g C") && Action::Accept.changes_result());
    }
}
