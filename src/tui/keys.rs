//! The key map: one table from which the dispatcher, the help, the footer and the README are made.
//!
//! Characters that can leak from an escape sequence torn apart on a slow line
//! (`[ O < ; ? ~ 0-9 A B C D F H I M P Q R S Z m`) are bound to actions that change no result; a test holds the
//! table to that.

use std::fmt::Write as _;

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::{Action, Panel};

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
        row(Review, &["N"], A::NextUnreviewed, "next flag nobody decided on", ""),
        row(Review, &["P"], A::PreviousUnreviewed, "previous flag nobody decided on", ""),
        row(Review, &["a"], A::Accept, "accept the flag: the sample is wild; go on to the next", "accept"),
        row(Review, &["r"], A::Reject, "reject the flag: the sample is good; go on to the next", "reject"),
        row(Review, &["space"], A::Toggle, "toggle between accepted and rejected", "toggle"),
        row(Review, &["x"], A::Clear, "take the decision back", ""),
        row(Review, &["v"], A::SelectRange, "range: move, then a r x space o are about it; esc leaves", "range"),
        row(Review, &["o"], A::ByHand, "flag the sample under the cursor by hand", "flag"),
        row(Review, &["c"], A::Note, "write a note on the decision, with a reason from a list", ""),
        row(Review, &["g a"], A::AcceptView, "accept all flags in view but suspects (one undo step)", ""),
        row(Review, &["g r"], A::RejectView, "reject all flags in view", ""),
        row(Review, &["g x"], A::ClearView, "take back all decisions in view", ""),
        row(Review, &["g n"], A::NextSuspect, "next suspect (only one direction objects)", ""),
        row(Review, &["g p"], A::PreviousSuspect, "previous suspect", ""),
        row(Review, &["g c"], A::NextConflict, "next conflict (the method now says otherwise)", ""),
        row(Review, &["g C"], A::PreviousConflict, "previous conflict", ""),
        row(Review, &["g e"], A::Epoch, "decide on the epoch: the same row in all channels", ""),
        row(Review, &["K"], A::Unit, "adjacent flags as one run, or sample by sample", ""),
        row(Review, &["g ."], A::AutoAdvance, "auto-advance: decisions go on to the next flag, or stay", ""),
        row(Review, &["s"], A::Sort, "sort the queue by time, ratio, state or run", ""),
        row(Review, &["J"], A::Journal, "journal of all edits; enter goes back to one", ""),
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
        row(View, &["Z"], A::PreviousView, "back to the view before", ""),
        row(View, &["down", "j"], A::NextSample, "cursor to the next sample (or column)", ""),
        row(View, &["up", "k"], A::PreviousSample, "cursor to the previous sample (or column)", ""),
        row(View, &["home", "g g"], A::First, "cursor to the first sample", ""),
        row(View, &["end", "G"], A::Last, "cursor to the last sample", ""),
        row(View, &["y"], A::YFit, "vertical range: kept samples, all, robust, fixed (:y LOW HIGH)", ""),
        row(View, &["X"], A::XAxis, "x is time or the number of the sample", ""),
        row(View, &["R"], A::NextLower, "below the trace: residual, histogram, steps of time", ""),
        row(View, &["L"], A::LogScale, "logarithmic scale of the residual or of the counts", ""),
        row(View, &["C"], A::Consensus, "all methods at once: how many flag each sample", ""),
        row(View, &["g h"], A::NextAgreed, "next sample that half of the methods flag", ""),
        row(View, &["B"], A::Pin, "pin the result as A and go on with B, or unpin it", ""),
        row(View, &["g d"], A::NextDifference, "next difference between A and B", ""),
        row(View, &["g D"], A::PreviousDifference, "previous difference between A and B", ""),
        row(View, &["g b"], A::AdoptPinned, "back to the settings of A (one undo step)", ""),
        row(View, &["V"], A::Second, "the channel beside this one, from 160 columns on", ""),
        row(View, &["t"], A::Layers, "layers: all, without the band, curve alone (:layers -raw)", ""),
        row(View, &["b"], A::BeforeAfter, "before and after repair", ""),
        row(View, &["d"], A::NextChannel, "next channel", "channel"),
        row(View, &["D"], A::Channels, "choose a channel from a list", ""),
        row(View, &["m"], A::Methods, "choose a method", "method"),
        row(View, &["e"], A::Repairs, "choose a repair", ""),
        row(View, &[","], A::StepDown, "active parameter one step down", "step"),
        row(View, &["."], A::StepUp, "active parameter one step up", ""),
        row(View, &[";"], A::NextKnob, "make the next parameter the active one", ""),
        row(View, &["f"], A::Suggested, "take the threshold that the record itself suggests", ""),
        row(View, &["g s"], A::SettingsToAll, "settings to all channels (method, knobs, repair)", ""),
        row(View, &["i"], A::Preset, "all parameters to the paper's values, or back to the defaults", ""),
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
        row(Everywhere, &["/"], A::Jump, "jump to a time, or with # to a row", ""),
        row(Everywhere, &["tab"], A::NextPanel, "focus the next panel", ""),
        row(Everywhere, &["backtab"], A::PreviousPanel, "focus the previous panel", ""),
        row(Everywhere, &["1"], A::Panel(Panel::Trace), "focus the trace", ""),
        row(Everywhere, &["2"], A::Panel(Panel::Residual), "focus the picture below the trace (R chooses which)", ""),
        row(Everywhere, &["3"], A::Panel(Panel::Parameters), "focus the parameters", ""),
        row(Everywhere, &["4"], A::Panel(Panel::Queue), "focus the queue", ""),
        row(Everywhere, &["5"], A::Panel(Panel::Card), "focus the card", ""),
        row(Everywhere, &["w"], A::Maximise, "maximise the focused panel, or restore it", ""),
        row(Everywhere, &["ctrl-s"], A::Save, "save the session (:w NAME to choose where)", "save"),
        row(Everywhere, &["ctrl-e"], A::Export, "write the cleaned file (:export NAME to choose where)", ""),
        row(Everywhere, &[":"], A::Command, "type a command", "command"),
        row(Everywhere, &["?"], A::Help, "this help", "help"),
        row(Everywhere, &["q"], A::Quit, "quit; asks when something is not saved", "quit"),
        row(Everywhere, &["esc"], A::Back, "one level back", ""),
        row(Everywhere, &["ctrl-c"], A::Interrupt, "stop the running computation; again: quit", ""),
        row(Everywhere, &["ctrl-l"], A::Redraw, "draw the screen again", ""),
        row(Everywhere, &["ctrl-z"], A::Suspend, "suspend", ""),
    ]
};

/// What a key means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    /// An action.
    Action(Action),
    /// The first key of several: wait for the next.
    Prefix(char),
    /// Nothing.
    Nothing,
}

/// The meaning of a key after `prefix`, with the focus on `panel`. The panel's own rows go first.
#[must_use]
pub fn meaning(key: KeyEvent, prefix: Option<char>, panel: Panel) -> Meaning {
    let Some(name) = name_of(key) else { return Meaning::Nothing };
    let name = prefix.map_or(name.clone(), |p| format!("{p} {name}"));
    let own = match panel {
        Panel::Parameters => Some(Context::Parameters),
        Panel::Queue => Some(Context::Queue),
        Panel::Trace | Panel::Residual | Panel::Card => None,
    };
    let holds = |b: &&Binding| Some(b.context) == own || !matches!(b.context, Context::Parameters | Context::Queue);
    let matching: Vec<&Binding> = KEYMAP.iter().filter(holds).filter(|b| b.keys.contains(&name.as_str())).collect();
    if let Some(binding) = matching.iter().find(|b| Some(b.context) == own).or(matching.first()) {
        return Meaning::Action(binding.action);
    }
    let starts = |b: &Binding| b.keys.iter().any(|k| k.starts_with(&format!("{name} ")));
    match name.chars().next() {
        Some(first) if prefix.is_none() && KEYMAP.iter().any(starts) => Meaning::Prefix(first),
        _ => Meaning::Nothing,
    }
}

/// The name of a key as the table writes it.
fn name_of(key: KeyEvent) -> Option<String> {
    let shift = key.modifiers.contains(KeyModifiers::SHIFT);
    let name = match key.code {
        KeyCode::Char(' ') => "space".into(),
        // The character already says whether Shift was down.
        KeyCode::Char(c) if key.modifiers.contains(KeyModifiers::CONTROL) => format!("ctrl-{}", c.to_ascii_lowercase()),
        KeyCode::Char(c) if key.modifiers.contains(KeyModifiers::ALT) => format!("alt-{c}"),
        KeyCode::Char(c) => c.to_string(),
        KeyCode::Left if shift => "shift-left".into(),
        KeyCode::Right if shift => "shift-right".into(),
        KeyCode::Left => "left".into(),
        KeyCode::Right => "right".into(),
        KeyCode::Up => "up".into(),
        KeyCode::Down => "down".into(),
        KeyCode::Home => "home".into(),
        KeyCode::End => "end".into(),
        KeyCode::PageUp => "pageup".into(),
        KeyCode::PageDown => "pagedown".into(),
        KeyCode::Enter => "enter".into(),
        KeyCode::Backspace => "backspace".into(),
        KeyCode::Esc => "esc".into(),
        KeyCode::Tab => "tab".into(),
        KeyCode::BackTab => "backtab".into(),
        _ => return None,
    };
    Some(name)
}

/// A key as people write it: `Ctrl-S`, `Space`, `←`.
#[must_use]
pub fn shown(key: &str) -> String {
    let one = |k: &str| match k {
        "left" => "←".to_owned(),
        "right" => "→".to_owned(),
        "up" => "↑".to_owned(),
        "down" => "↓".to_owned(),
        "pageup" => "PgUp".to_owned(),
        "pagedown" => "PgDn".to_owned(),
        "backtab" => "Shift-Tab".to_owned(),
        "shift-left" => "Shift-←".to_owned(),
        "shift-right" => "Shift-→".to_owned(),
        "space" | "enter" | "backspace" | "esc" | "tab" | "home" | "end" => {
            let (first, rest) = k.split_at(1);
            first.to_uppercase() + rest
        }
        k => k.strip_prefix("ctrl-").map_or_else(|| k.to_owned(), |c| format!("Ctrl-{}", c.to_uppercase())),
    };
    key.split(' ').map(one).collect::<Vec<_>>().join("")
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

    fn plain(c: char) -> KeyEvent {
        KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE)
    }

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for (i, a) in KEYMAP.iter().enumerate() {
            for b in &KEYMAP[i + 1..] {
                let own = |c| matches!(c, Context::Parameters | Context::Queue);
                if a.context == b.context || (!own(a.context) && !own(b.context)) {
                    assert!(a.keys.iter().all(|k| !b.keys.contains(k)), "{:?} and {:?} share a key", a.keys, b.keys);
                }
            }
        }
    }

    #[test]
    fn characters_of_torn_escape_sequences_change_no_result() {
        let changes = |a: Action| {
            use Action as A;
            matches!(
                a,
                A::Undo
                    | A::StepUp
                    | A::StepDown
                    | A::StepUpFar
                    | A::StepDownFar
                    | A::DefaultValue
                    | A::Preset
                    | A::Suggested
                    | A::Accept
                    | A::Reject
                    | A::Toggle
                    | A::Clear
                    | A::ByHand
                    | A::AcceptView
                    | A::AdoptPinned
                    | A::RejectView
                    | A::ClearView
                    | A::Epoch
                    | A::SettingsToAll
                    | A::Save
                    | A::Export
                    | A::Quit
            )
        };
        for c in "[O<;?~0123456789ABCDFHIMPQRSZm".chars() {
            for panel in Panel::ALL {
                if let Meaning::Action(action) = meaning(plain(c), None, panel) {
                    assert!(!changes(action), "{c} does {action:?}");
                }
            }
        }
    }

    #[test]
    fn panels_use_arrows_for_themselves_and_g_waits() {
        let left = KeyEvent::new(KeyCode::Left, KeyModifiers::NONE);
        assert_eq!(meaning(left, None, Panel::Trace), Meaning::Action(Action::PanLeft));
        assert_eq!(meaning(left, None, Panel::Parameters), Meaning::Action(Action::StepDown));
        assert_eq!(meaning(plain('g'), None, Panel::Trace), Meaning::Prefix('g'));
        assert_eq!(meaning(plain('a'), Some('g'), Panel::Trace), Meaning::Action(Action::AcceptView));
        assert_eq!(meaning(plain('q'), Some('g'), Panel::Trace), Meaning::Nothing);
    }
}
